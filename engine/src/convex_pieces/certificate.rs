//! [`lies_inside`], the proof that a piece is solid.

use glam::DVec2;

use crate::predicates::turn;

/// Whether a strictly convex polygon lies wholly within the border whose edges are given, by exact
/// signs: no edge reaches into it, and a point in it is inside the border (even-odd rule).
pub fn lies_inside(piece: &[DVec2], mut edges: impl Iterator<Item = [DVec2; 2]> + Clone) -> bool {
    let Some(point) = point_within(piece) else {
        return false;
    };
    is_inside(point, edges.clone()) && edges.all(|edge| is_apart(piece, edge))
}

/// Whether a line parts the edge and the inside of the piece: that of one of its sides or that of
/// the edge, as for any two convex sets in the plane.
fn is_apart(piece: &[DVec2], [a, b]: [DVec2; 2]) -> bool {
    let by_side = sides(piece).any(|[p, q]| turn(p, q, a) <= 0.0 && turn(p, q, b) <= 0.0);
    by_side
        || piece.iter().all(|&corner| turn(a, b, corner) >= 0.0)
        || piece.iter().all(|&corner| turn(a, b, corner) <= 0.0)
}

/// A point strictly within a convex polygon, unless it is too thin to hold one.
fn point_within(piece: &[DVec2]) -> Option<DVec2> {
    let middle = piece.iter().sum::<DVec2>() / piece.len() as f64;
    sides(piece)
        .all(|[p, q]| turn(p, q, middle) > 0.0)
        .then_some(middle)
}

/// Whether a ray to the right crosses an odd number of edges; a point on an edge is not inside.
fn is_inside(point: DVec2, edges: impl Iterator<Item = [DVec2; 2]>) -> bool {
    let mut inside = false;
    for [a, b] in edges {
        if (a.y > point.y) == (b.y > point.y) {
            continue;
        }
        let side = if a.y < b.y {
            turn(a, b, point)
        } else {
            turn(b, a, point)
        };
        if side == 0.0 {
            return false;
        }
        inside ^= side > 0.0;
    }
    inside
}

fn sides(piece: &[DVec2]) -> impl Iterator<Item = [DVec2; 2]> {
    (0..piece.len()).map(|i| [piece[i], piece[(i + 1) % piece.len()]])
}
