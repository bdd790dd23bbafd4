//! [`ConvexPrism`], the simplest solid that hides.

use crate::Box3d;
use crate::convex_polygon::is_strictly_convex;
use glam::DVec2;

/// A vertical prism over a strictly convex polygon.
#[derive(Clone, Debug, PartialEq)]
pub struct ConvexPrism {
    footprint: Vec<DVec2>,
    bottom: f64,
    top: f64,
    grounded: bool,
}

impl ConvexPrism {
    /// Vertices of a footprint at the most: each one costs in every shadow.
    pub const MOST_VERTICES: usize = 12;

    /// The prism over `footprint`, anticlockwise, from `bottom` to `top`, metres. `grounded` says
    /// that the ground under it is solid down to any depth. `None` unless everything is finite, the
    /// height positive, and the footprint strictly convex with 3 to [`Self::MOST_VERTICES`]
    /// vertices.
    #[must_use]
    pub fn new(footprint: Vec<DVec2>, bottom: f64, top: f64, grounded: bool) -> Option<Self> {
        let finite = footprint.iter().all(|vertex| vertex.is_finite());
        let valid = finite
            && bottom < top
            && (top - bottom).is_finite()
            && footprint.len() <= Self::MOST_VERTICES
            && is_strictly_convex(&footprint);
        valid.then_some(Self {
            footprint,
            bottom,
            top,
            grounded,
        })
    }

    /// An axis-aligned box; `None` when it is flat.
    #[must_use]
    pub fn from_box(bounds: &Box3d, grounded: bool) -> Option<Self> {
        let Box3d { min, max } = bounds;
        let footprint = vec![
            min.truncate(),
            DVec2::new(max.x, min.y),
            max.truncate(),
            DVec2::new(min.x, max.y),
        ];
        Self::new(footprint, min.z, max.z, grounded)
    }

    /// The footprint, anticlockwise.
    #[must_use]
    pub fn footprint(&self) -> &[DVec2] {
        &self.footprint
    }

    /// Lowest height, metres.
    #[must_use]
    pub fn bottom(&self) -> f64 {
        self.bottom
    }

    /// Greatest height, metres.
    #[must_use]
    pub fn top(&self) -> f64 {
        self.top
    }

    /// Whether the ground under the prism is solid down to any depth.
    #[must_use]
    pub fn grounded(&self) -> bool {
        self.grounded
    }

    /// The smallest box around the prism.
    #[must_use]
    pub fn envelope(&self) -> Box3d {
        let (min, max) = self.footprint.iter().fold(
            (DVec2::INFINITY, DVec2::NEG_INFINITY),
            |(min, max), &vertex| (min.min(vertex), max.max(vertex)),
        );
        Box3d {
            min: min.extend(self.bottom),
            max: max.extend(self.top),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    fn prism(footprint: &[[f64; 2]]) -> Option<ConvexPrism> {
        let footprint = footprint.iter().map(|&v| DVec2::from(v)).collect();
        ConvexPrism::new(footprint, 0.0, 1.0, true)
    }

    #[test]
    fn only_strictly_convex_footprints_are_taken() {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        assert!(prism(&square).is_some());
        let clockwise: Vec<_> = square.iter().rev().copied().collect();
        assert_eq!(prism(&clockwise), None);
        assert_eq!(prism(&square[..2]), None);
        assert_eq!(
            prism(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [1.0, 1.0]]),
            None
        );
        let dart = [[0.0, 0.0], [2.0, 0.0], [0.5, 0.5], [0.0, 2.0]];
        assert_eq!(prism(&dart), None);
        assert_eq!(prism(&[[0.0, 0.0], [1.0, 0.0], [f64::NAN, 1.0]]), None);
    }

    #[test]
    fn a_star_that_turns_left_all_the_way_is_not_convex() {
        let star: Vec<[f64; 2]> = (0..5)
            .map(|i| {
                let angle = f64::from(2 * i) * std::f64::consts::TAU / 5.0;
                [angle.cos(), angle.sin()]
            })
            .collect();
        assert_eq!(prism(&star), None);
        let spiral = [0.0, 90.0, 180.0, 270.0, 360.0, 420.0_f64]
            .iter()
            .enumerate()
            .map(|(i, angle)| {
                let (sin, cos) = angle.to_radians().sin_cos();
                let radius = 1.0 + 0.1 * i as f64;
                [cos * radius, sin * radius]
            });
        let spiral: Vec<[f64; 2]> = std::iter::once([0.0, 0.0]).chain(spiral).collect();
        assert_eq!(prism(&spiral), None);
    }

    #[test]
    fn a_bend_of_one_bit_counts() {
        let x = 85_000.0_f64;
        let bent = [[x, 0.0], [x.next_up(), 1.0], [x, 2.0], [x - 1.0, 1.0]];
        assert!(prism(&bent).is_some());
        assert_eq!(prism(&[[x, 0.0], [x, 1.0], [x, 2.0], [x - 1.0, 1.0]]), None);
    }

    #[test]
    fn boxes_are_prisms_unless_they_are_flat() {
        let bounds = Box3d::new(DVec3::ZERO, DVec3::new(1.0, 2.0, 3.0));
        let prism = ConvexPrism::from_box(&bounds, false).expect("not flat");
        assert_eq!(prism.envelope(), bounds);
        let flat = Box3d::new(DVec3::ZERO, DVec3::new(1.0, 0.0, 3.0));
        assert_eq!(ConvexPrism::from_box(&flat, false), None);
    }
}
