//! [`ViewSector`], the field of view of the 2004 report: a horizontal sector of any pitch.

use super::{RELATIVE_TOLERANCE, near_part, within};
use crate::Box3d;
use glam::{DVec2, DVec3};
use std::f64::consts::FRAC_PI_2;

/// Metres by which the sector's two sides are moved outward: rounding of the clip, in scenes
/// of any real size.
const SIDE_TOLERANCE: f64 = 1e-9;

/// A horizontal sector of view: the points within `range` of the eye whose azimuth is within
/// half the aperture of the heading, at any pitch. Points straight above and below belong.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewSector {
    eye: DVec3,
    heading: f64,
    half_angle: f64,
    range: f64,
}

impl ViewSector {
    /// A sector with its apex at `eye` (metres); `heading` clockwise from +y and `angle`, the
    /// full aperture, in radians; `range`, a distance in space, in metres.
    #[must_use]
    pub fn new(eye: DVec3, heading: f64, angle: f64, range: f64) -> Self {
        Self {
            eye,
            heading,
            half_angle: angle / 2.0,
            range,
        }
    }

    /// Whether sector and box share a point.
    #[must_use]
    pub fn meets(&self, target: &Box3d) -> bool {
        let Some(local) = near_part(self.eye, self.range, target) else {
            return false;
        };
        let height = 0.0_f64.clamp(local.min.z, local.max.z);
        self.wedges()
            .into_iter()
            .flatten()
            .any(|(heading, half_angle)| {
                nearest_2(&wedge_part(&local, heading, half_angle))
                    .is_some_and(|plan_2| within(plan_2 + height * height, self.range))
            })
    }

    /// The sector as one or two convex wedges, each a heading and a half angle.
    fn wedges(&self) -> [Option<(f64, f64)>; 2] {
        if self.half_angle <= FRAC_PI_2 {
            return [Some((self.heading, self.half_angle)), None];
        }
        let half = self.half_angle / 2.0;
        [
            Some((self.heading - half, half)),
            Some((self.heading + half, half)),
        ]
    }
}

/// The part of the box's plan rectangle that lies in a convex wedge at the origin.
fn wedge_part(local: &Box3d, heading: f64, half_angle: f64) -> Vec<DVec2> {
    let (min, max) = (local.min.truncate(), local.max.truncate());
    let rectangle = vec![min, DVec2::new(max.x, min.y), max, DVec2::new(min.x, max.y)];
    [-half_angle, half_angle]
        .into_iter()
        .fold(rectangle, |polygon, turn| {
            let azimuth = heading + turn;
            // The inward normal of the side at this azimuth.
            let inward = DVec2::new(azimuth.cos(), -azimuth.sin()) * -turn.signum();
            clip(&polygon, inward)
        })
}

/// The part of a convex polygon on the inner side of a line through the origin.
fn clip(polygon: &[DVec2], inward: DVec2) -> Vec<DVec2> {
    let depth = |p: DVec2| p.dot(inward) + SIDE_TOLERANCE + RELATIVE_TOLERANCE * p.length();
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (i, &a) in polygon.iter().enumerate() {
        let b = polygon[(i + 1) % polygon.len()];
        let (from, to) = (depth(a), depth(b));
        if from >= 0.0 {
            kept.push(a);
        }
        if (from >= 0.0) != (to >= 0.0) {
            kept.push(a + (b - a) * (from / (from - to)));
        }
    }
    kept
}

/// Squared distance from the origin to a convex polygon; `None` for an empty one.
fn nearest_2(polygon: &[DVec2]) -> Option<f64> {
    let edges = || (0..polygon.len()).map(|i| (polygon[i], polygon[(i + 1) % polygon.len()]));
    if polygon.len() > 2 && edges().all(|(a, b)| a.perp_dot(b) >= 0.0) {
        return Some(0.0);
    }
    edges()
        .map(|(a, b)| {
            let along = b - a;
            let t = (-a.dot(along) / along.length_squared()).clamp(0.0, 1.0);
            if t.is_nan() {
                a.length_squared()
            } else {
                (a + along * t).length_squared()
            }
        })
        .min_by(f64::total_cmp)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn holds(sector: &ViewSector, point: DVec3) -> bool {
        let q = point - sector.eye;
        let azimuth = q.x.atan2(q.y);
        let turn = (azimuth - sector.heading).rem_euclid(std::f64::consts::TAU);
        q.length() <= sector.range
            && (q.truncate() == DVec2::ZERO
                || turn <= sector.half_angle
                || turn >= std::f64::consts::TAU - sector.half_angle)
    }

    fn grid(target: &Box3d, steps: usize) -> impl Iterator<Item = DVec3> + use<> {
        let (min, size, side) = (target.min, target.size(), steps + 1);
        (0..side * side * side).map(move |i| {
            let at = DVec3::new(
                (i % side) as f64,
                (i / side % side) as f64,
                (i / side / side) as f64,
            );
            min + size * at / steps as f64
        })
    }

    fn scene() -> impl Strategy<Value = (ViewSector, Box3d)> {
        let corner = prop::array::uniform3(-20i32..20).prop_map(|c| DVec3::from(c.map(f64::from)));
        let size = prop::array::uniform3(0i32..15).prop_map(|c| DVec3::from(c.map(f64::from)));
        (corner, size, 0i32..24, 1i32..24, 1i32..40, any::<bool>()).prop_map(
            |(corner, size, h, a, r, far)| {
                let origin = if far {
                    DVec3::new(85_000.0, 447_000.0, 3.0)
                } else {
                    DVec3::ZERO
                };
                let step = 15f64.to_radians();
                let sector = ViewSector::new(
                    origin,
                    f64::from(h) * step,
                    f64::from(a) * step,
                    f64::from(r),
                );
                (sector, Box3d::new(origin + corner, origin + corner + size))
            },
        )
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]
        #[test]
        fn never_misses_a_box_with_a_point_inside((sector, target) in scene()) {
            if grid(&target, 8).any(|p| holds(&sector, p)) {
                prop_assert!(sector.meets(&target));
            }
        }

        #[test]
        fn claims_only_boxes_that_a_slightly_wider_sector_holds((sector, target) in scene()) {
            let wider = ViewSector {
                half_angle: sector.half_angle + 0.08,
                range: sector.range * 1.05 + 0.2,
                ..sector
            };
            if sector.meets(&target) {
                let nearest = sector.eye.clamp(target.min, target.max);
                prop_assert!(grid(&target, 60).chain([nearest]).any(|p| holds(&wider, p)));
            }
        }
    }

    #[test]
    fn a_box_straight_above_belongs_to_every_heading() {
        let above = Box3d::new(DVec3::new(-1.0, -1.0, 5.0), DVec3::new(1.0, 1.0, 6.0));
        for heading in 0..8 {
            let sector = ViewSector::new(DVec3::ZERO, f64::from(heading), 0.3, 5.0);
            assert!(sector.meets(&above));
            assert!(!ViewSector::new(DVec3::ZERO, f64::from(heading), 0.3, 4.9).meets(&above));
        }
    }

    #[test]
    fn a_box_of_enormous_extent_is_met_where_a_small_part_of_it_is() {
        let small = Box3d::new(DVec3::new(108.0, 108.0, 0.0), DVec3::new(109.0, 109.0, 1.0));
        let large = Box3d::new(
            DVec3::new(-1e15, 0.0, -1.0),
            DVec3::new(1e300, 1e15 + 1.0, 50.0),
        );
        let eye = DVec3::new(110.0, 110.0, 0.5);
        let sector = ViewSector::new(eye, 225f64.to_radians(), 0.02, 5.0);
        assert!(large.contains(&small) && sector.meets(&small) && sector.meets(&large));
    }

    #[test]
    fn range_is_a_distance_in_space() {
        let tower = Box3d::new(DVec3::new(3.0, 10.0, 4.0), DVec3::new(5.0, 12.0, 40.0));
        let reach = DVec3::new(3.0, 10.0, 4.0).length();
        assert!(ViewSector::new(DVec3::ZERO, 0.0, 3.0, reach).meets(&tower));
        assert!(!ViewSector::new(DVec3::ZERO, 0.0, 3.0, reach - 0.01).meets(&tower));
    }
}
