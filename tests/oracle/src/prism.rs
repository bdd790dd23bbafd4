//! Convex prisms: what hides in an occlusion volume.

use std::cmp::Ordering;

use crate::aabb::{Aabb, Point};
use crate::determinant::plan_estimate;
use crate::exact::Rational;
use crate::footprint::{ShapeFault, check_corners, check_heights};
use crate::interval::Interval;
use crate::number::{Number, sign_of};
use crate::plane::{Edge, PlanPoint, doubled_area, plan_turn, ring_edges, spot};

/// A convex polygon times a range of heights, and the ground below if it is grounded.
#[derive(Clone, Debug, PartialEq)]
pub struct Prism {
    pub(crate) edges: Vec<Edge>,
    pub(crate) bottom: f64,
    pub(crate) top: f64,
    pub(crate) grounded: bool,
    /// Down to minus infinity if grounded.
    pub(crate) bounds: Aabb,
}

/// How far inside each face of a prism a point lies, times some positive factor.
pub(crate) struct Depths<N>(Vec<N>);

impl Prism {
    /// The prism over an anticlockwise convex polygon, its first corner not repeated; `grounded` if
    /// the ground under it is solid down to any depth.
    ///
    /// # Errors
    /// The first fault of its shape: a polygon that is not convex or has no area, a top that is not
    /// above the bottom.
    pub fn new(
        corners: &[PlanPoint],
        bottom: f64,
        top: f64,
        grounded: bool,
    ) -> Result<Self, ShapeFault> {
        check_heights(bottom, top)?;
        check_corners(&[corners.to_vec()])?;
        let edges: Vec<Edge> = ring_edges(corners).collect();
        check_convex(corners, &edges)?;
        let floor = if grounded { f64::NEG_INFINITY } else { bottom };
        let ends = corners
            .iter()
            .flat_map(|&[x, y]| [[x, y, floor], [x, y, top]])
            .collect::<Vec<Point>>();
        Ok(Self {
            edges,
            bottom,
            top,
            grounded,
            bounds: Aabb::around(&ends),
        })
    }

    /// The prism that is a box.
    ///
    /// # Errors
    /// The fault of a box that is flat, not finite, or has its corners out of order.
    pub fn of_box(aabb: &Aabb, grounded: bool) -> Result<Self, ShapeFault> {
        let ([west, south, bottom], [east, north, top]) = (aabb.min, aabb.max);
        let corners = [[west, south], [east, south], [east, north], [west, north]];
        Self::new(&corners, bottom, top, grounded)
    }

    /// The depths of a point of finite coordinates, by the filter.
    pub(crate) fn depths(&self, point: Point) -> Depths<Interval> {
        let [x, y, _] = point;
        self.depths_by(point, |[u, v]| {
            let quick = plan_estimate([u[0], u[1], 0.0], [v[0], v[1], 0.0], [x, y, 0.0]);
            match quick.sign() {
                Some(_) => quick.interval(),
                // Intervals know zero where a side is parallel to an axis.
                None => doubled_area(&spot(*u), &spot(*v), &spot([x, y])),
            }
        })
    }

    /// The same in rationals.
    fn exact_depths(&self, point: Point) -> Depths<Rational> {
        let at = spot([point[0], point[1]]);
        self.depths_by(point, |[u, v]| doubled_area(&spot(*u), &spot(*v), &at))
    }

    fn depths_by<N: Number>(
        &self,
        [_, _, z]: Point,
        depth_of_side: impl Fn(&Edge) -> N,
    ) -> Depths<N> {
        let height = N::from_f64(z);
        let below_top = N::from_f64(self.top).minus(&height);
        let above_bottom = (!self.grounded).then(|| height.minus(&N::from_f64(self.bottom)));
        let mut depths = Vec::with_capacity(self.edges.len() + 2);
        depths.extend(self.edges.iter().map(depth_of_side));
        depths.push(below_top);
        depths.extend(above_bottom);
        Depths(depths)
    }

    /// Whether the open segment between two finite points meets the interior; `depths` are theirs,
    /// of the filter. Exact.
    pub(crate) fn meets(&self, [p, q]: [Point; 2], depths: [&Depths<Interval>; 2]) -> bool {
        if p == q {
            return false;
        }
        passes(depths[0], depths[1])
            .or_else(|| passes(&self.exact_depths(p), &self.exact_depths(q)))
            // Rationals always decide.
            .unwrap_or(false)
    }

    /// Whether a finite point lies strictly inside. Exact.
    pub(crate) fn interior_contains(&self, point: Point) -> bool {
        is_deep(&self.depths(point))
            .or_else(|| is_deep(&self.exact_depths(point)))
            // Rationals always decide.
            .unwrap_or(false)
    }
}

/// Checks that an outline turns anticlockwise around an area that it is the convex hull of.
fn check_convex(corners: &[PlanPoint], edges: &[Edge]) -> Result<(), ShapeFault> {
    let is_wrong = |&&[u, v]: &&Edge| {
        let turns = || corners.iter().map(|&corner| plan_turn(u, v, corner));
        turns().any(|turn| turn == Ordering::Less) || turns().all(|turn| turn == Ordering::Equal)
    };
    match edges.iter().find(is_wrong) {
        Some(&edge) => Err(ShapeFault::NotConvex { edge }),
        None => Ok(()),
    }
}

/// Whether a point is strictly inside all faces.
fn is_deep<N: Number>(depths: &Depths<N>) -> Option<bool> {
    let mut certain = true;
    for depth in &depths.0 {
        match sign_of(depth) {
            Some(Ordering::Greater) => {}
            Some(_) => return Some(false),
            None => certain = false,
        }
    }
    certain.then_some(true)
}

/// Whether the open segment between two points of these depths meets the interior: the segment
/// clipped by all faces is longer than a point. `None` where the arithmetic cannot tell.
fn passes<N: Number>(from: &Depths<N>, to: &Depths<N>) -> Option<bool> {
    let (mut enter, mut leave) = (N::from_f64(0.0), N::from_f64(1.0));
    let mut certain = true;
    for (start, end) in from.0.iter().zip(&to.0) {
        let at = || start.over(&start.minus(end));
        match (sign_of(start), sign_of(end)) {
            (Some(Ordering::Less | Ordering::Equal), Some(Ordering::Less | Ordering::Equal)) => {
                return Some(false);
            }
            (Some(Ordering::Less), Some(Ordering::Greater)) => enter = enter.larger(&at()),
            (Some(Ordering::Greater), Some(Ordering::Less)) => leave = leave.smaller(&at()),
            (Some(_), Some(_)) => {}
            _ => certain = false,
        }
    }
    match enter.compare(&leave) {
        // Faces left out for doubt could only shorten what is left.
        Some(Ordering::Greater | Ordering::Equal) => Some(false),
        Some(Ordering::Less) if certain => Some(true),
        _ => None,
    }
}
