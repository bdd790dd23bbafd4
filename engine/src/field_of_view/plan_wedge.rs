//! [`PlanWedge`], the directions in plan that a field of view holds.

use glam::DVec2;
use std::f64::consts::PI;

/// Radians by which a wedge is wider on each side than computed: some million roundings.
const SLACK: f64 = 1e-9;

/// Sine of the least angle by which directions must stay below half a turn to bound a wedge, and of that
/// between a ray and the upright: a field of view that comes near may look straight up or down.
const LEAST_GAP: f64 = 1e-6;

/// A wedge of directions in plan, less than a whole turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanWedge {
    /// Where it begins.
    pub right: DVec2,
    /// Where it ends, anticlockwise.
    pub left: DVec2,
}

impl PlanWedge {
    /// The directions within `half` of a heading, radians clockwise from +y; `None` if these are all.
    pub(super) fn around(heading: f64, half: f64) -> Option<Self> {
        let half = half + SLACK;
        (half < PI).then(|| Self {
            right: toward(heading + half),
            left: toward(heading - half),
        })
    }

    /// The wedge that holds the plans of some rays, each a metre long or more, and all between them;
    /// `None` if they do not lie in less than half a turn, or one is all but upright.
    pub(super) fn holding(directions: &[DVec2]) -> Option<Self> {
        if directions.iter().any(|plan| plan.length() < LEAST_GAP) {
            return None;
        }
        let directions: Vec<DVec2> = directions.iter().map(|plan| plan.normalize()).collect();
        // Whether one turns less than half a turn from the one to the other, anticlockwise.
        let reaches = |from: DVec2, to: DVec2| {
            let turn = from.perp_dot(to);
            turn > LEAST_GAP || turn >= 0.0 && from.dot(to) > 0.0
        };
        let is_right = |from: &&DVec2| directions.iter().all(|&to| reaches(**from, to));
        let is_left = |to: &&DVec2| directions.iter().all(|&from| reaches(from, **to));
        let right = directions.iter().find(is_right)?;
        let left = directions.iter().find(is_left)?;
        Some(Self {
            right: DVec2::from_angle(-SLACK).rotate(*right),
            left: DVec2::from_angle(SLACK).rotate(*left),
        })
    }
}

/// The direction of a heading.
fn toward(heading: f64) -> DVec2 {
    DVec2::new(heading.sin(), heading.cos())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wedge_holds_its_directions_and_no_half_turn() {
        let wedge = PlanWedge::holding(&[DVec2::new(1.0, 1.0), DVec2::X, DVec2::Y]).unwrap();
        assert!(wedge.right.abs_diff_eq(DVec2::X, 1e-8) && wedge.right.y < 0.0);
        assert!(wedge.left.abs_diff_eq(DVec2::Y, 1e-8) && wedge.left.x < 0.0);
        assert_eq!(PlanWedge::holding(&[DVec2::X, DVec2::NEG_X]), None);
        assert_eq!(PlanWedge::holding(&[DVec2::X, DVec2::ZERO]), None);
        let turned = |angle| DVec2::from_angle(angle);
        assert_eq!(
            PlanWedge::holding(&[DVec2::X, turned(2.0), turned(4.0)]),
            None
        );
        let north = PlanWedge::around(0.0, 0.1).unwrap();
        assert!(north.right.x > 0.0 && north.left.x < 0.0);
        assert_eq!(PlanWedge::around(1.0, PI), None);
    }
}
