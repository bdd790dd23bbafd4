//! [`ViewSector`], the field of view of the 2004 report: a horizontal sector of any pitch.

use super::{PlanWedge, RELATIVE_TOLERANCE, near_part, within};
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
    /// The sector as one or two convex wedges.
    wedges: [Option<Wedge>; 2],
    plan_wedge: Option<PlanWedge>,
    range: f64,
}

impl ViewSector {
    /// A sector with its apex at `eye` (metres); `heading` clockwise from +y and `angle`, the
    /// full aperture, in radians; `range`, a distance in space, in metres.
    #[must_use]
    pub fn new(eye: DVec3, heading: f64, angle: f64, range: f64) -> Self {
        let half = angle / 2.0;
        let wedges = if half <= FRAC_PI_2 {
            [Some(Wedge::new(heading, half)), None]
        } else {
            [-half, half].map(|turn| Some(Wedge::new(heading + turn / 2.0, half / 2.0)))
        };
        Self {
            eye,
            wedges,
            plan_wedge: PlanWedge::around(heading, half),
            range,
        }
    }

    /// The directions in plan that it holds; `None` if these are all, or may be.
    #[must_use]
    pub fn plan_wedge(&self) -> Option<PlanWedge> {
        self.plan_wedge
    }

    /// Whether sector and box share a point.
    #[must_use]
    pub fn meets(&self, target: &Box3d) -> bool {
        let Some(local) = near_part(self.eye, self.range, target) else {
            return false;
        };
        let height = 0.0_f64.clamp(local.min.z, local.max.z);
        let (min, max) = (local.min.truncate(), local.max.truncate());
        let nearest = DVec2::ZERO.clamp(min, max);
        // The nearest point of the box is in range.
        self.wedges.iter().flatten().any(|wedge| {
            wedge.holds(nearest)
                || !wedge.misses(min, max)
                    && nearest_2(wedge.part(min, max).corners())
                        .is_some_and(|plan_2| within(plan_2 + height * height, self.range))
        })
    }
}

/// A convex wedge at the origin of the plan: what is on the inner side of two lines.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Wedge {
    inward: [DVec2; 2],
}

impl Wedge {
    /// The wedge within `half_angle`, at most a quarter turn, of a heading, radians.
    fn new(heading: f64, half_angle: f64) -> Self {
        let inward = [-half_angle, half_angle].map(|turn| {
            let azimuth = heading + turn;
            DVec2::new(azimuth.cos(), -azimuth.sin()) * -turn.signum()
        });
        Self { inward }
    }

    /// Whether a point is inside, or so near that it may be.
    fn holds(&self, point: DVec2) -> bool {
        self.inward
            .iter()
            .all(|&inward| depth(point, inward) >= 0.0)
    }

    /// Whether a rectangle is wholly on the outer side of one of the lines.
    fn misses(&self, min: DVec2, max: DVec2) -> bool {
        self.inward.iter().any(|&inward| {
            let innermost = DVec2::select(inward.cmpge(DVec2::ZERO), max, min);
            // Its depth is the greatest but for the slack, which grows with the distance.
            innermost.dot(inward) + slack(min.abs().max(max.abs())) < 0.0
        })
    }

    /// The part of a rectangle that is inside.
    fn part(&self, min: DVec2, max: DVec2) -> Polygon {
        let rectangle = [min, DVec2::new(max.x, min.y), max, DVec2::new(min.x, max.y)];
        let whole = Polygon::of(&rectangle);
        self.inward
            .iter()
            .fold(whole, |part, &inward| part.clipped(inward))
    }
}

/// How far inside of a line through the origin a point is, the slack included.
fn depth(point: DVec2, inward: DVec2) -> f64 {
    point.dot(inward) + slack(point)
}

/// By how much a point may be outside and still count as inside.
fn slack(point: DVec2) -> f64 {
    SIDE_TOLERANCE + RELATIVE_TOLERANCE * point.length()
}

/// Corners of a rectangle after two cuts. A cut adds at most half as many as there were: the slack
/// bends its line, so that it may cross every edge.
const MOST_CORNERS: usize = 9;

/// A convex polygon with few corners.
#[derive(Clone, Copy)]
struct Polygon {
    corners: [DVec2; MOST_CORNERS],
    count: usize,
}

impl Polygon {
    fn of(corners: &[DVec2]) -> Self {
        let mut polygon = Self {
            corners: [DVec2::ZERO; MOST_CORNERS],
            count: 0,
        };
        for &corner in corners {
            polygon.push(corner);
        }
        polygon
    }

    fn push(&mut self, corner: DVec2) {
        self.corners[self.count] = corner;
        self.count += 1;
    }

    fn corners(&self) -> &[DVec2] {
        &self.corners[..self.count]
    }

    /// The part on the inner side of a line through the origin.
    fn clipped(&self, inward: DVec2) -> Self {
        let mut kept = Self::of(&[]);
        let corners = self.corners();
        for (i, &a) in corners.iter().enumerate() {
            let b = corners[(i + 1) % corners.len()];
            let (from, to) = (depth(a, inward), depth(b, inward));
            if from >= 0.0 {
                kept.push(a);
            }
            if (from >= 0.0) != (to >= 0.0) {
                kept.push(a + (b - a) * (from / (from - to)));
            }
        }
        kept
    }
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

    /// A sector's numbers, for a test of points that shares nothing with the one of boxes.
    #[derive(Clone, Copy, Debug)]
    struct Given {
        eye: DVec3,
        heading: f64,
        half_angle: f64,
        range: f64,
    }

    impl Given {
        fn sector(&self) -> ViewSector {
            ViewSector::new(self.eye, self.heading, self.half_angle * 2.0, self.range)
        }
    }

    fn holds(sector: &Given, point: DVec3) -> bool {
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

    fn scene() -> impl Strategy<Value = (Given, Box3d)> {
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
                let sector = Given {
                    eye: origin,
                    heading: f64::from(h) * step,
                    half_angle: f64::from(a) * step / 2.0,
                    range: f64::from(r),
                };
                (sector, Box3d::new(origin + corner, origin + corner + size))
            },
        )
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]
        #[test]
        fn never_misses_a_box_with_a_point_inside((sector, target) in scene()) {
            if grid(&target, 8).any(|p| holds(&sector, p)) {
                prop_assert!(sector.sector().meets(&target));
            }
        }

        #[test]
        fn claims_only_boxes_that_a_slightly_wider_sector_holds((sector, target) in scene()) {
            let wider = Given {
                half_angle: sector.half_angle + 0.08,
                range: sector.range * 1.05 + 0.2,
                ..sector
            };
            if sector.sector().meets(&target) {
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
