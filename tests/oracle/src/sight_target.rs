//! [`SightTarget`], what an eye looks for.

use std::cmp::Ordering;

use crate::aabb::{Aabb, Point};
use crate::plane::{PlanPoint, plan_turn, ring_edges};

/// A convex polygon in plan over a range of heights, closed: the outer box of a feature, or its outer
/// prism.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SightTarget {
    /// Anticlockwise; of a box four, some equal where it is flat; of a prism two where all of it is on
    /// one line in plan, one where it is a point.
    pub(crate) corners: Vec<PlanPoint>,
    pub(crate) bounds: Aabb,
}

impl SightTarget {
    /// All of a box.
    pub(crate) fn of_box(bounds: &Aabb) -> Self {
        let ([west, south, _], [east, north, _]) = (bounds.min, bounds.max);
        Self {
            corners: vec![[west, south], [east, south], [east, north], [west, north]],
            bounds: *bounds,
        }
    }

    /// The prism over a convex outline, between the heights of a box.
    pub(crate) fn of_prism(outline: &[PlanPoint], bounds: &Aabb) -> Self {
        Self {
            corners: outline.to_vec(),
            bounds: *bounds,
        }
    }

    /// Whether it holds a point. Exact.
    pub(crate) fn holds(&self, point: Point) -> bool {
        let [x, y, z] = point;
        let in_bounds = (0..3).all(|axis| {
            self.bounds.min[axis] <= point[axis] && point[axis] <= self.bounds.max[axis]
        });
        in_bounds && z.is_finite() && self.holds_in_plan([x, y])
    }

    fn holds_in_plan(&self, point: PlanPoint) -> bool {
        let is_within = |[u, v]: [PlanPoint; 2]| {
            (0..2).all(|axis| {
                u[axis].min(v[axis]) <= point[axis] && point[axis] <= u[axis].max(v[axis])
            })
        };
        match self.corners[..] {
            [] => false,
            [only] => point == only,
            [u, v] => is_within([u, v]) && plan_turn(u, v, point) == Ordering::Equal,
            _ => ring_edges(&self.corners)
                .filter(|[u, v]| u != v)
                .all(|[u, v]| plan_turn(u, v, point) != Ordering::Less),
        }
    }

    /// The mean of its corners in plan, which it holds but for roundings.
    pub(crate) fn middle(&self) -> PlanPoint {
        let count = self.corners.len() as f64;
        [0, 1].map(|axis| {
            let sum: f64 = self.corners.iter().map(|corner| corner[axis]).sum();
            sum / count
        })
    }

    /// The point of the target that a rounded point stands for: within its box, and moved a little to
    /// the middle where that is not yet enough.
    pub(crate) fn nearest(&self, point: PlanPoint) -> Option<PlanPoint> {
        let middle = self.middle();
        [0.0, 1e-15, 1e-13, 1e-10].into_iter().find_map(|share| {
            let moved = [0, 1].map(|axis| {
                let value = point[axis] + (middle[axis] - point[axis]) * share;
                value.clamp(self.bounds.min[axis], self.bounds.max[axis])
            });
            self.holds_in_plan(moved).then_some(moved)
        })
    }
}
