//! [`Cell`], one mesh of the street network, and what is left of it between the streets.

use geo::Polygon;
use glam::{DVec2, I64Vec2};

use super::lattice::{edges, left_or_on, line_string, nearest};

/// One side of a block: houses stand on its left, a street runs on its right.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Side {
    /// Where it begins.
    pub start: I64Vec2,
    /// A short vector along it.
    pub step: I64Vec2,
    /// How many steps it is long.
    pub steps: i64,
}

impl Side {
    /// The lattice point so many steps along it and to its left.
    pub fn point(&self, along: i64, inward: i64) -> I64Vec2 {
        self.start + along * self.step + inward * self.step.perp()
    }

    /// Where it ends.
    pub fn end(&self) -> I64Vec2 {
        self.point(self.steps, 0)
    }
}

/// The sides of the block or two blocks between the four streets of a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell {
    /// Along the lower, right, upper and left street, anticlockwise.
    pub sides: [Side; 4],
    /// Where a street crosses the cell from its lower left to its upper right corner: the sides on
    /// its left, which runs with it, and on its right, which runs against it.
    pub diagonal: Option<[Side; 2]>,
}

impl Cell {
    /// The blocks of the cell, each by its sides, anticlockwise.
    pub fn blocks(&self) -> Vec<Block> {
        let [lower, right, upper, left] = self.sides;
        match self.diagonal {
            None => vec![Block::new(vec![lower, right, upper, left])],
            Some([with, against]) => vec![
                Block::new(vec![lower, right, against]),
                Block::new(vec![with, upper, left]),
            ],
        }
    }
}

/// A piece of ground that streets surround.
pub struct Block {
    /// Anticlockwise; corners are cut off where one does not begin at the end of the last.
    pub sides: Vec<Side>,
    ring: Vec<I64Vec2>,
}

impl Block {
    fn new(sides: Vec<Side>) -> Self {
        let mut ring: Vec<I64Vec2> = sides.iter().flat_map(|s| [s.start, s.end()]).collect();
        ring.dedup();
        if ring.first() == ring.last() {
            ring.pop();
        }
        Self { sides, ring }
    }

    /// The ground itself, metres, with a hole or none.
    pub fn polygon(&self, hole: Option<&Polygon<f64>>) -> Polygon<f64> {
        let holes = hole.map(|hole| hole.exterior().0.iter().rev().copied().collect());
        Polygon::new(
            line_string(self.ring.iter().copied()),
            holes.into_iter().collect(),
        )
    }

    /// Whether all points lie on the inner side of every edge, or on it.
    pub fn holds(&self, points: &[I64Vec2]) -> bool {
        edges(&self.ring).all(|(from, to)| points.iter().all(|&p| left_or_on(from, to, p)))
    }

    /// The mean of its corners.
    pub fn middle(&self) -> I64Vec2 {
        self.ring.iter().sum::<I64Vec2>() / self.ring.len() as i64
    }
}

/// The sides of the block inside a convex ring of street axes, anticlockwise: each keeps
/// `half_widths` from its axis, and `corner` from where it would meet the next.
///
/// A side follows a vector of about `grain`, so that its points lie on the lattice and on one
/// straight line; its direction is off that of its axis by less than 1 to `grain`.
pub fn sides<const N: usize>(
    axes: [I64Vec2; N],
    half_widths: [i64; N],
    corner: i64,
    grain: i64,
) -> [Side; N] {
    let axis = |i: usize| {
        let from = axes[i].as_dvec2();
        let along = (axes[(i + 1) % N].as_dvec2() - from).normalize();
        (from + along.perp() * half_widths[i] as f64, along)
    };
    let meeting = |i: usize| crossing(axis((i + N - 1) % N), axis(i));
    std::array::from_fn(|i| {
        let (_, along) = axis(i);
        let (from, to) = (meeting(i), meeting((i + 1) % N));
        let step = nearest(along * grain as f64);
        let room = (to - from).dot(along) - 2.0 * corner as f64;
        Side {
            start: nearest(from + along * corner as f64),
            step,
            steps: ((room / step.as_dvec2().length()).floor() as i64).max(0),
        }
    })
}

/// Where two lines, each a point and a direction, cross.
fn crossing((p, u): (DVec2, DVec2), (q, v): (DVec2, DVec2)) -> DVec2 {
    p + u * ((q - p).perp_dot(v) / u.perp_dot(v))
}
