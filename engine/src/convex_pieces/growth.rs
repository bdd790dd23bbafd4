//! [`piece_around`]: a large convex polygon within a border and around a place.

use glam::DVec2;

use crate::convex_polygon::{Side, area, clipped, side, sides};

/// Cuts of one piece at the most: what needs more is not worth having.
const MOST_CUTS: usize = 64;

/// An edge that reaches less than this into a piece does not count, metres: it does so by rounding.
const TOUCHING: f64 = 1e-7;

/// A directed edge with its line; the solid is on its left.
#[derive(Clone, Copy, Debug)]
pub struct Edge {
    line: Side,
    end: DVec2,
}

impl Edge {
    /// The edge between two points.
    pub fn new(from: DVec2, to: DVec2) -> Self {
        Self {
            line: side(from, to),
            end: to,
        }
    }

    /// How far a point is to the left of the edge's line.
    fn depth(&self, point: DVec2) -> f64 {
        self.line.offset - self.line.normal.dot(point)
    }

    /// Whether the line has the whole of `other` on its right.
    fn is_before(&self, other: &Self) -> bool {
        self.depth(other.line.corner) <= TOUCHING && self.depth(other.end) <= TOUCHING
    }

    /// Whether the edge reaches into the convex polygon with these sides.
    fn meets(&self, sides: &[Side]) -> bool {
        let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
        for Side { normal, offset, .. } in sides {
            let depth = |p: DVec2| offset - TOUCHING - normal.dot(p);
            let (a, b) = (depth(self.line.corner), depth(self.end));
            if a <= 0.0 && b <= 0.0 {
                return false;
            }
            if a < 0.0 {
                enter = enter.max(a / (a - b));
            } else if b < 0.0 {
                leave = leave.min(a / (a - b));
            }
        }
        enter < leave
    }

    fn distance_squared(&self, point: DVec2) -> f64 {
        let along = self.end - self.line.corner;
        let share = (point - self.line.corner).dot(along) / along.length_squared();
        let nearest = self.line.corner + along * share.clamp(0.0, 1.0);
        nearest.distance_squared(point)
    }
}

/// Cuts `hull` along lines of edges until no edge is left in it, always between `seed` and the
/// nearest edge that is, and always where the most is left. The nearest edge faces the seed, so its
/// own line can always serve; the line of another one often takes both away.
pub fn piece_around(seed: DVec2, edges: &[Edge], hull: &[DVec2]) -> Option<Vec<DVec2>> {
    let mut piece = hull.to_vec();
    let mut in_the_way = edges.to_vec();
    in_the_way.sort_by(|a, b| {
        a.distance_squared(seed)
            .total_cmp(&b.distance_squared(seed))
    });
    for _ in 0..MOST_CUTS {
        let around = sides(&piece);
        in_the_way.retain(|edge| edge.meets(&around));
        let Some(nearest) = in_the_way.first() else {
            return Some(piece);
        };
        piece = edges
            .iter()
            .filter(|edge| edge.depth(seed) > TOUCHING && edge.is_before(nearest))
            .map(|edge| clipped(&piece, edge.line.normal, edge.line.offset))
            .max_by(|a, b| area(a).total_cmp(&area(b)))?;
    }
    None
}
