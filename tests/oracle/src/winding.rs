//! Exact winding numbers of a mesh.

use std::cmp::Ordering;

use crate::aabb::{Point, is_finite};
use crate::mesh::{Mesh, Triangle};
use crate::test_point::TestPoint;

/// The axes of the plane that a vertical ray is seen in.
const PLAN: (usize, usize) = (0, 1);

impl Mesh {
    /// How often the surface winds around `point`: 1 inside a closed outward mesh, 0 outside, -1
    /// inside one that is inside out. `None` if the point lies on the surface, is not finite, or
    /// the mesh has an index out of range or a coordinate that is not finite.
    ///
    /// Exact: signed crossings of the upward ray from the point, moved sideways by an
    /// infinitesimal (ε, ε²) so that it passes through no edge (simulation of simplicity,
    /// Edelsbrunner and Mücke 1990). Only a closed mesh has winding numbers; for another the
    /// answer means nothing.
    #[must_use]
    pub fn winding_number(&self, point: Point) -> Option<i32> {
        if !is_finite(point) {
            return None;
        }
        winding_number(&self.corners()?, &point)
    }
}

/// The winding number of `triangles` around a finite `point`, `None` if it lies on one of them.
pub(crate) fn winding_number<'a>(
    triangles: impl IntoIterator<Item = &'a Triangle>,
    point: &impl TestPoint,
) -> Option<i32> {
    let nearest = point.nearest();
    let mut winding = 0;
    for triangle in triangles
        .into_iter()
        .filter(|triangle| may_cross(triangle, nearest))
    {
        if contains(triangle, point) {
            return None;
        }
        winding += crossing(triangle, point);
    }
    Some(winding)
}

/// Whether the closed upward ray can reach the triangle at all.
fn may_cross(triangle: &Triangle, point: Point) -> bool {
    let [a, b, c] = triangle;
    let beside = (0..2).any(|i| {
        (a[i] < point[i] && b[i] < point[i] && c[i] < point[i])
            || (a[i] > point[i] && b[i] > point[i] && c[i] > point[i])
    });
    !beside && (a[2] >= point[2] || b[2] >= point[2] || c[2] >= point[2])
}

/// Whether the point lies on the closed triangle, which may be degenerate.
fn contains(triangle: &Triangle, point: &impl TestPoint) -> bool {
    let [a, b, c] = *triangle;
    point.orientation(a, b, c) == Ordering::Equal
        && [(0, 1), (1, 2), (2, 0)]
            .iter()
            .all(|&axes| shadow_contains(triangle, point, axes))
}

/// The same in the plane of two axes. A point in the plane of a triangle lies on the triangle
/// exactly when it does so in all three projections, since one of them at least keeps its shape.
fn shadow_contains(triangle: &Triangle, point: &impl TestPoint, axes: (usize, usize)) -> bool {
    let [a, b, c] = *triangle;
    let within = [axes.0, axes.1].iter().all(|&i| {
        point.order(a[i].min(b[i]).min(c[i]), i) != Ordering::Greater
            && point.order(a[i].max(b[i]).max(c[i]), i) != Ordering::Less
    });
    let turns = [
        point.turn(a, b, axes),
        point.turn(b, c, axes),
        point.turn(c, a, axes),
    ];
    within && !(turns.contains(&Ordering::Less) && turns.contains(&Ordering::Greater))
}

/// 1 if the moved ray leaves through the triangle, -1 if it enters, 0 if it misses. The point is
/// not on the triangle.
fn crossing(triangle: &Triangle, point: &impl TestPoint) -> i32 {
    let [a, b, c] = *triangle;
    let side = moved_turn(a, b, point);
    if side == Ordering::Equal
        || moved_turn(b, c, point) != side
        || moved_turn(c, a, point) != side
        || point.orientation(a, b, c) != side
    {
        return 0;
    }
    if side == Ordering::Greater { 1 } else { -1 }
}

/// The turn from `a` over `b` to the moved point; equal only if the edge is vertical.
fn moved_turn(a: Point, b: Point, point: &impl TestPoint) -> Ordering {
    // The turn grows by -(b.y - a.y) ε + (b.x - a.x) ε².
    point
        .turn(a, b, PLAN)
        .then(order(a[1], b[1]))
        .then(order(b[0], a[0]))
}

/// The order of two finite numbers, -0 and 0 equal.
fn order(a: f64, b: f64) -> Ordering {
    a.partial_cmp(&b).unwrap_or(Ordering::Equal)
}
