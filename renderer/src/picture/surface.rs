//! Shaded triangles for the perspective, relative to its eye.

use super::palette::Rgb;
use super::view::{cross, unit};
use super::{PictureFeature, PictureScene, Status};
use crate::scene_mesh::is_drawable;
use bytemuck::{Pod, Zeroable};

/// A corner for the perspective's shader.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub(crate) struct SurfaceVertex {
    /// Metres from the eye.
    pub position: [f32; 3],
    pub normal: [f32; 3],
    /// Linear, with straight alpha.
    pub color: [f32; 4],
    /// 0 for the ground, otherwise the feature.
    pub surface: u32,
}

/// Feet of at most this many metres above the ground are drawn down to it: models end at the
/// terrain, and the picture's ground is flat.
const LARGEST_STEP: f64 = 4.0;

/// Corners within this height of a feature's lowest belong to its foot.
const FOOT_HEIGHT: f64 = 0.6;

/// Of all feet, the share that the picture's ground lies above: a few models reach into the soil.
const BURIED_SHARE: f64 = 0.1;

/// Height of the flat ground: a low one of the features' feet.
pub(crate) fn ground_height(scene: &PictureScene) -> f64 {
    let mut feet: Vec<f64> = scene.features.iter().filter_map(foot).collect();
    feet.sort_by(f64::total_cmp);
    let at = (BURIED_SHARE * feet.len() as f64) as usize;
    feet.get(at).copied().unwrap_or(0.0)
}

/// The triangles that can be drawn.
fn drawable(feature: &PictureFeature) -> impl Iterator<Item = &[[f64; 3]; 3]> {
    feature
        .triangles
        .iter()
        .filter(|triangle| triangle.iter().all(is_drawable))
}

fn foot(feature: &PictureFeature) -> Option<f64> {
    drawable(feature)
        .flatten()
        .map(|corner| corner[2])
        .reduce(f64::min)
}

/// All features, standing on the ground, each in the colour of its status.
pub(crate) fn features(
    scene: &PictureScene,
    eye: [f64; 3],
    ground: f64,
    fill: fn(Status) -> Rgb,
) -> Vec<SurfaceVertex> {
    let mut vertices = Vec::new();
    for (surface, feature) in (1..).zip(&scene.features) {
        let color = linear(fill(feature.status), 1.0);
        let foot = foot(feature).unwrap_or(ground);
        for triangle in drawable(feature) {
            let Some(normal) = normal(triangle) else {
                continue;
            };
            vertices.extend(triangle.map(|corner| SurfaceVertex {
                position: relative(stand(corner, foot, ground), eye),
                normal,
                color,
                surface,
            }));
        }
    }
    vertices
}

/// Moves the corners of a foot down to the ground, and what is below the ground up to it.
pub(crate) fn stand([x, y, z]: [f64; 3], foot: f64, ground: f64) -> [f64; 3] {
    let is_foot = z < foot + FOOT_HEIGHT && foot - ground < LARGEST_STEP;
    [x, y, if is_foot || z < ground { ground } else { z }]
}

pub(crate) fn normal([a, b, c]: &[[f64; 3]; 3]) -> Option<[f32; 3]> {
    let edge = |to: &[f64; 3]| std::array::from_fn(|axis| to[axis] - a[axis]);
    unit(cross(edge(b), edge(c))).map(|normal| normal.map(|c| c as f32))
}

/// Eye-relative, subtracted in f64.
pub(crate) fn relative(point: [f64; 3], eye: [f64; 3]) -> [f32; 3] {
    std::array::from_fn(|axis| (point[axis] - eye[axis]) as f32)
}

/// From sRGB to linear light.
pub(crate) fn linear(Rgb(r, g, b): Rgb, alpha: f32) -> [f32; 4] {
    let [r, g, b] = [r, g, b].map(to_linear);
    [r, g, b, alpha]
}

/// IEC 61966-2-1.
pub(crate) fn to_linear(channel: u8) -> f32 {
    let c = f32::from(channel) / 255.0;
    if c <= 0.040_45 {
        c / 12.92
    } else {
        ((c + 0.055) / 1.055).powf(2.4)
    }
}

/// The inverse of [`to_linear`].
pub(crate) fn from_linear(light: f32) -> u8 {
    let l = light.clamp(0.0, 1.0);
    let c = if l <= 0.003_130_8 {
        l * 12.92
    } else {
        1.055 * l.powf(1.0 / 2.4) - 0.055
    };
    (c * 255.0).round() as u8
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::palette;

    #[test]
    fn light_survives_the_round_trip() {
        assert!((0..=255).all(|channel| from_linear(to_linear(channel)) == channel));
    }

    #[test]
    fn feet_reach_the_ground_and_bridges_stay_up() {
        assert_eq!(stand([1.0, 2.0, 3.2], 3.0, 1.0), [1.0, 2.0, 1.0]);
        assert_eq!(stand([1.0, 2.0, 9.0], 3.0, 1.0), [1.0, 2.0, 9.0]);
        assert_eq!(stand([1.0, 2.0, 8.0], 8.0, 1.0), [1.0, 2.0, 8.0]);
        assert_eq!(stand([1.0, 2.0, -2.0], -2.0, 1.0), [1.0, 2.0, 1.0]);
    }

    #[test]
    fn what_cannot_be_drawn_is_left_out() {
        let whole = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 5.0]];
        let broken = [[f64::NAN; 3]; 3];
        let flat = [[0.0; 3]; 3];
        let feature = PictureFeature {
            status: Status::Visible,
            triangles: vec![whole, broken, flat],
            columns: vec![],
        };
        let scene = PictureScene {
            features: vec![feature],
            ..Default::default()
        };
        assert_eq!(features(&scene, [0.0; 3], 0.0, palette::fill).len(), 3);
        assert_eq!(ground_height(&scene), 0.0);
    }
}
