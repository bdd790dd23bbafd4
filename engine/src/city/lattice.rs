//! Plan coordinates as whole numbers.
//!
//! Every corner of a generated city lies on a lattice, so that "on a line", "touches" and "inside"
//! are decided without rounding, here and by everybody who computes with the coordinates in f64.

use geo::{Coord, LineString};
use glam::{DVec2, I64Vec2};

/// Lattice units in a metre: a power of two, so that f64 holds each position exactly.
const UNITS: i64 = 1024;

/// Whole metres in lattice units.
pub const fn metres(whole: i64) -> i64 {
    whole * UNITS
}

/// A length in metres.
pub fn length(units: i64) -> f64 {
    units as f64 / UNITS as f64
}

/// A point in metres.
pub fn position(point: I64Vec2) -> DVec2 {
    point.as_dvec2() / UNITS as f64
}

/// The lattice point nearest to a place given in units.
pub fn nearest(place: DVec2) -> I64Vec2 {
    place.round().as_i64vec2()
}

/// Whether `point` lies on the left of the line from `from` to `to`, or on it.
pub fn left_or_on(from: I64Vec2, to: I64Vec2, point: I64Vec2) -> bool {
    (to - from).perp_dot(point - from) >= 0
}

/// Whether two convex rings, anticlockwise, share no inner point: one has an edge with all of the
/// other on its outer side.
pub fn are_apart(a: &[I64Vec2], b: &[I64Vec2]) -> bool {
    let parts = |ring: &[I64Vec2], other: &[I64Vec2]| {
        edges(ring).any(|(from, to)| other.iter().all(|&point| left_or_on(to, from, point)))
    };
    parts(a, b) || parts(b, a)
}

/// The directed edges of a ring.
pub fn edges(ring: &[I64Vec2]) -> impl Iterator<Item = (I64Vec2, I64Vec2)> {
    let next = ring.iter().cycle().skip(1);
    ring.iter().copied().zip(next.copied())
}

/// A ring of points in metres, closed.
pub fn line_string(ring: impl IntoIterator<Item = I64Vec2>) -> LineString<f64> {
    let coordinates = ring.into_iter().map(position);
    let mut ring: LineString<f64> = coordinates.map(|p| Coord { x: p.x, y: p.y }).collect();
    ring.close();
    ring
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: i64, y: i64) -> [I64Vec2; 4] {
        [(0, 0), (4, 1), (3, 5), (-1, 4)].map(|(u, v)| I64Vec2::new(x + u, y + v))
    }

    #[test]
    fn rings_that_touch_are_apart_and_one_unit_more_is_not() {
        let ring = square(0, 0);
        assert!(are_apart(&ring, &square(4, 1)));
        assert!(are_apart(&ring, &square(3, 5)));
        assert!(!are_apart(&ring, &square(3, 1)));
        assert!(!are_apart(&ring, &ring));
    }
}
