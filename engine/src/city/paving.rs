//! The streets between blocks: one piece between two blocks, one at each crossing.

use std::collections::HashSet;

use geo::Polygon;
use glam::I64Vec2;

use super::cell::{Cell, Side};
use super::lattice::line_string;

const RIGHT: I64Vec2 = I64Vec2::X;
const UP: I64Vec2 = I64Vec2::Y;

/// Streets in the making. Their pieces fill the ground between the blocks without gap or overlap,
/// since all share their corners.
#[derive(Default)]
pub struct Paving {
    made: HashSet<(I64Vec2, Piece)>,
}

impl Paving {
    /// The pieces around a cell that were not made before.
    pub fn around(&mut self, at: I64Vec2, cell: impl Fn(I64Vec2) -> Cell) -> Vec<Polygon<f64>> {
        let pieces = [
            (at, Piece::Lower),
            (at + RIGHT, Piece::Left),
            (at + UP, Piece::Lower),
            (at, Piece::Left),
            (at, Piece::Crossing),
            (at + RIGHT, Piece::Crossing),
            (at + RIGHT + UP, Piece::Crossing),
            (at + UP, Piece::Crossing),
            (at, Piece::Diagonal),
        ];
        let new = pieces.into_iter().filter(|&piece| self.made.insert(piece));
        new.filter_map(|(at, piece)| polygon(at, piece, &cell))
            .collect()
    }
}

/// A piece of street that belongs to a cell.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Piece {
    /// Along its lower side.
    Lower,
    /// Along its left side.
    Left,
    /// At its lower left corner.
    Crossing,
    /// Across it.
    Diagonal,
}

fn polygon(at: I64Vec2, piece: Piece, cell: &impl Fn(I64Vec2) -> Cell) -> Option<Polygon<f64>> {
    let ring = match piece {
        Piece::Lower => between(cell(at).sides[0], cell(at - UP).sides[2]),
        Piece::Left => between(cell(at).sides[3], cell(at - RIGHT).sides[1]),
        Piece::Crossing => crossing(at, cell),
        Piece::Diagonal => {
            let [with, against] = cell(at).diagonal?;
            between(with, against)
        }
    };
    Some(Polygon::new(line_string(ring), Vec::new()))
}

/// The street between two sides that run against each other.
fn between(left: Side, right: Side) -> Vec<I64Vec2> {
    vec![left.end(), left.start, right.end(), right.start]
}

/// The crossing at the lower left corner of a cell: anticlockwise around it, the cut corners of
/// the blocks there.
fn crossing(at: I64Vec2, cell: &impl Fn(I64Vec2) -> Cell) -> Vec<I64Vec2> {
    let upper_right = cell(at);
    let upper_left = cell(at - RIGHT);
    let lower_left = cell(at - RIGHT - UP);
    let lower_right = cell(at - UP);
    let mut ring = Vec::new();
    // Each block at the crossing: the side that leaves it, and the one that comes to it.
    let mut cut = |leaving: Side, coming: Side| ring.extend([leaving.start, coming.end()]);
    let [lower, _, _, left] = upper_right.sides;
    match upper_right.diagonal {
        None => cut(lower, left),
        Some([with, against]) => {
            cut(lower, against);
            cut(with, left);
        }
    }
    cut(upper_left.sides[1], upper_left.sides[0]);
    let [_, right, upper, _] = lower_left.sides;
    match lower_left.diagonal {
        None => cut(upper, right),
        Some([with, against]) => {
            cut(upper, with);
            cut(against, right);
        }
    }
    cut(lower_right.sides[3], lower_right.sides[2]);
    ring.dedup();
    if ring.first() == ring.last() {
        ring.pop();
    }
    ring
}
