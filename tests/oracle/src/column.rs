//! Solid columns.

use std::cmp::Ordering;

use crate::aabb::{Aabb, Point, is_finite};
use crate::exact::Rational;
use crate::footprint::{Footprint, ShapeFault, check_heights};
use crate::interval::Interval;
use crate::number::Number;
use crate::plane::{Edge, Outline, Place, PlanPoint, any_piece, place, spot};

/// A footprint, a polygon with holes, times a range of heights, claimed to be solid.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    pub(crate) footprint: Footprint,
    pub(crate) bottom: f64,
    pub(crate) top: f64,
    pub(crate) grounded: bool,
}

impl Column {
    /// The column over `rings`, the outer one anticlockwise, then holes clockwise, none with its
    /// first corner repeated; `grounded` if the ground under it is claimed solid down to any depth.
    ///
    /// # Errors
    /// The first fault of its shape: rings that are not simple, that turn the wrong way, or a hole
    /// that leaves the outer ring or overlaps another; a top that is not above the bottom.
    pub fn new(
        rings: &[Vec<PlanPoint>],
        bottom: f64,
        top: f64,
        grounded: bool,
    ) -> Result<Self, ShapeFault> {
        check_heights(bottom, top)?;
        Ok(Self {
            footprint: Footprint::new(rings)?,
            bottom,
            top,
            grounded,
        })
    }

    /// The box around it, down to minus infinity if it is grounded.
    pub(crate) fn solid_bounds(&self) -> Aabb {
        let ([west, south], [east, north]) = (self.footprint.min, self.footprint.max);
        Aabb::new([west, south, self.solid_bottom()], [east, north, self.top])
    }

    /// The bottom, at minus infinity if the column is grounded.
    pub(crate) fn solid_bottom(&self) -> f64 {
        if self.grounded {
            f64::NEG_INFINITY
        } else {
            self.bottom
        }
    }

    /// Whether the closed column, without ground, holds the point. Exact.
    pub(crate) fn holds(&self, [x, y, z]: Point) -> bool {
        self.bottom <= z && z <= self.top && self.footprint.place([x, y]) != Place::Outside
    }

    /// Whether the point lies strictly inside the column or its ground. Exact.
    pub(crate) fn interior_contains(&self, [x, y, z]: Point) -> bool {
        self.solid_bottom() < z && z < self.top && self.footprint.place([x, y]) == Place::Inside
    }

    /// Whether the closed column, with its ground, has a point within `margin` of another; decided in
    /// `f64` but for points inside, so to some roundings.
    pub(crate) fn is_within(&self, [x, y, z]: Point, margin: f64) -> bool {
        let above = (z - self.top).max(self.solid_bottom() - z).max(0.0);
        if above > margin {
            return false;
        }
        let in_plan = if self.footprint.place([x, y]) == Place::Outside {
            let edges = self.footprint.edges.iter();
            edges
                .map(|edge| distance(*edge, [x, y]))
                .fold(f64::INFINITY, f64::min)
        } else {
            0.0
        };
        in_plan.hypot(above) <= margin
    }

    /// Whether the open segment from `p` to `q` meets the open column or its ground. Exact.
    #[must_use]
    pub fn meets_segment(&self, p: Point, q: Point) -> bool {
        if !is_finite(p) || !is_finite(q) || p == q || self.is_beside(p, q) {
            return false;
        }
        self.any_part(p, q, |place| place == Place::Inside)
    }

    /// Whether a part of the segment from `p` to `q` that has some length lies in the closed column
    /// or its ground, on the surface or inside. Exact.
    #[must_use]
    pub(crate) fn touches_along(&self, p: Point, q: Point) -> bool {
        let bounds = self.solid_bounds();
        let is_apart =
            (0..3).any(|i| p[i].max(q[i]) < bounds.min[i] || p[i].min(q[i]) > bounds.max[i]);
        is_finite(p)
            && is_finite(q)
            && p != q
            && !is_apart
            && self.any_part(p, q, |place| place != Place::Outside)
    }

    /// Whether a part of the segment that is between bottom and top is in a wanted place in plan.
    fn any_part(&self, p: Point, q: Point, wanted: fn(Place) -> bool) -> bool {
        let outline = Outline::around(&[[p[0], p[1]], [q[0], q[1]]], &self.footprint.edges);
        self.meets::<Interval>(&outline, p, q, wanted)
            .or_else(|| self.meets::<Rational>(&outline, p, q, wanted))
            // Rationals always decide.
            .unwrap_or(false)
    }

    /// Whether both ends lie on or beyond the same side of the box around the column.
    fn is_beside(&self, p: Point, q: Point) -> bool {
        let bounds = self.solid_bounds();
        (0..3).any(|i| p[i].max(q[i]) <= bounds.min[i] || p[i].min(q[i]) >= bounds.max[i])
    }

    fn meets<N: Number>(
        &self,
        outline: &Outline,
        p: Point,
        q: Point,
        wanted: fn(Place) -> bool,
    ) -> Option<bool> {
        let (from, to) = ([p[0], p[1]], [q[0], q[1]]);
        let [enter, leave]: [N; 2] = self.heights(p[2], q[2]);
        if from == to {
            return Some(wanted(place::<N>(&outline.right, &spot(from))?));
        }
        if enter.compare(&leave)? != Ordering::Less {
            return Some(false);
        }
        any_piece(outline, [&spot(from), &spot(to)], [enter, leave], wanted)
    }

    /// The parameters between which a segment from height `p` to height `q`, not both on one side,
    /// is between bottom and top.
    fn heights<N: Number>(&self, p: f64, q: f64) -> [N; 2] {
        let (bottom, top) = (self.solid_bottom(), self.top);
        let at = |height: f64| {
            let [start, end, height] = [p, q, height].map(N::from_f64);
            height.minus(&start).over(&end.minus(&start))
        };
        // The face that the end at height `z` lies beyond.
        let beyond = |z: f64| {
            if z < bottom {
                Some(bottom)
            } else {
                (z > top).then_some(top)
            }
        };
        [
            beyond(p).map_or(N::from_f64(0.0), at),
            beyond(q).map_or(N::from_f64(1.0), at),
        ]
    }
}

/// How far a point is from an edge in plan.
fn distance([u, v]: Edge, [x, y]: PlanPoint) -> f64 {
    let (way, from) = ([v[0] - u[0], v[1] - u[1]], [x - u[0], y - u[1]]);
    let along = (way[0] * from[0] + way[1] * from[1]) / (way[0] * way[0] + way[1] * way[1]);
    let along = along.clamp(0.0, 1.0);
    (from[0] - way[0] * along).hypot(from[1] - way[1] * along)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::prism::Prism;
    use crate::scenes::{cases, points, ring};
    use crate::segment::segment_meets_interior;

    proptest! {
        #![proptest_config(cases(4000))]
        #[test]
        fn a_ring_is_its_bars([p, q, a, b, c, d] in points(), grounded in any::<bool>()) {
            let Some((mut column, bars)) = ring([a, b, c, d]) else {
                return Ok(());
            };
            column.grounded = grounded;
            let meets = |bar: &Aabb| {
                segment_meets_interior(p, q, &Prism::of_box(bar, grounded).unwrap())
            };
            prop_assert_eq!(column.meets_segment(p, q), bars.iter().any(meets));
        }

        #[test]
        fn agrees_with_half_spaces([p, q, a, b, c] in points(), grounded in any::<bool>()) {
            let corners = [a, b, c].map(|[x, y, _]| [x, y]);
            let (bottom, top) = (a[2].min(b[2]), a[2].max(b[2]));
            let Ok(prism) = Prism::new(&corners, bottom, top, grounded) else {
                return Ok(());
            };
            let column = Column::new(&[corners.to_vec()], bottom, top, grounded).unwrap();
            prop_assert_eq!(column.meets_segment(p, q), segment_meets_interior(p, q, &prism));
            prop_assert_eq!(column.interior_contains(p), prism.interior_contains(p));
        }

        #[test]
        fn filter_never_disagrees([p, q, a, b, c, d] in points()) {
            let Some((column, _)) = ring([a, b, c, d]) else {
                return Ok(());
            };
            prop_assume!(p != q && !column.is_beside(p, q));
            let ends = [p, q].map(|[x, y, _]| [x, y]);
            let outline = Outline::around(&ends, &column.footprint.edges);
            let inside = |place| place == Place::Inside;
            if let Some(answer) = column.meets::<Interval>(&outline, p, q, inside) {
                prop_assert_eq!(Some(answer), column.meets::<Rational>(&outline, p, q, inside));
            }
        }
    }
}
