//! The sun: where it stands, and the box of the scene that its shadows are drawn for.

use super::surface::SurfaceVertex;
use super::view::{cross, dot, unit};

/// In the south-east, rather high, so that streets are lit.
const DIRECTION: [f64; 3] = [0.48, -0.62, 0.78];

/// Pixels along a side of the shadow map.
const RESOLUTION: u32 = 4096;

/// Shadows are drawn this many metres around the eye, plus a multiple of its height above the
/// lowest feature: near enough to be sharp in a street, far enough to be whole from the air.
const REACH: f64 = 350.0;
const REACH_PER_HEIGHT: f64 = 6.0;

/// The sun's orthographic view in eye-relative coordinates: axis, and offset in the fourth.
pub(crate) struct Sun {
    pub direction: [f64; 3],
    pub right: [f64; 4],
    pub up: [f64; 4],
    pub depth: [f64; 4],
    /// Metres a shadow texel.
    pub texel: f64,
    pub resolution: u32,
}

impl Sun {
    /// A sun over the features near the eye.
    pub(crate) fn over(features: &[SurfaceVertex], limit: u32) -> Self {
        let direction = unit(DIRECTION).expect("the sun has a direction");
        let right = unit(cross([0.0, 0.0, 1.0], direction)).expect("the sun is not in the zenith");
        let up = cross(direction, right);
        let positions = || features.iter().map(|vertex| vertex.position.map(f64::from));
        let lowest = positions().map(|p| p[2]).fold(0.0, f64::min);
        let reach = REACH + REACH_PER_HEIGHT * -lowest;
        let near = move |p: &[f64; 3]| p[0].abs().max(p[1].abs()) <= reach;
        let extent = |axis: [f64; 3]| {
            positions()
                .filter(near)
                .map(|p| dot(axis, p))
                .fold((f64::MAX, f64::MIN), |(a, b), c| (a.min(c), b.max(c)))
        };
        let resolution = RESOLUTION.min(limit);
        let [r, u, d] = [right, up, direction].map(extent).map(or_unit);
        let texel = (r.1 - r.0).max(u.1 - u.0) / f64::from(resolution);
        Self {
            direction,
            right: plane(right, r, [-1.0, 1.0]),
            up: plane(up, u, [-1.0, 1.0]),
            // Nearest to the sun is 0.
            depth: plane(direction, d, [0.99, 0.01]),
            texel,
            resolution,
        }
    }
}

/// Any interval for a scene without features.
fn or_unit((low, high): (f64, f64)) -> (f64, f64) {
    if high > low { (low, high) } else { (-1.0, 1.0) }
}

/// Maps an interval along an axis linearly.
fn plane(axis: [f64; 3], (low, high): (f64, f64), [to_low, to_high]: [f64; 2]) -> [f64; 4] {
    let scale = (to_high - to_low) / (high - low);
    let [x, y, z] = axis.map(|c| c * scale);
    [x, y, z, to_low - low * scale]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scene_fits_the_shadow_map() {
        let corner = |position| SurfaceVertex {
            position,
            ..Default::default()
        };
        let features = [[-30.0, 5.0, -2.0], [40.0, 8.0, 30.0], [3.0, -60.0, -2.0]].map(corner);
        let sun = Sun::over(&features, 1024);
        for vertex in features {
            let [x, y, z] = vertex.position.map(f64::from);
            let [r, u, d] =
                [sun.right, sun.up, sun.depth].map(|p| p[0] * x + p[1] * y + p[2] * z + p[3]);
            assert!(r.abs() <= 1.0 + 1e-9 && u.abs() <= 1.0 + 1e-9 && (0.0..=1.0).contains(&d));
        }
        assert_eq!(sun.resolution, 1024);
        assert!(Sun::over(&[], 64).texel.is_finite());
    }
}
