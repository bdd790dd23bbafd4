//! The layout `streets`: rows of houses along streets in all directions.

use glam::{DVec2, I64Vec2};

use super::cell::{Block, Cell, Side, sides};
use super::generated::{Plan, Quarter};
use super::lattice::{metres, nearest};
use super::random::SplitMix64;
use super::rows::{Rows, tower};
use super::solid::Solid;

/// Length and width of a cell before it is bent, units.
const PITCH: [f64; 2] = [metres(190) as f64, metres(158) as f64];

/// How far a crossing is moved at random, as a share of a cell. With [`BEND`] no edge of a cell is
/// turned by more than 34 degrees, so blocks stay convex and keep room between the widest streets.
const JITTER: f64 = 0.06;

/// How far whole quarters are moved, as a share of a cell, and how many cells a side they have:
/// this bends the streets over long distances.
const BEND: (f64, i64) = (0.7, 6);

/// Every so many streets is an avenue.
const AVENUES: i64 = 5;

/// Every so many diagonals through the cells is a street.
const DIAGONALS: i64 = 6;

/// How far from the meeting of two fronts a block's corner is cut, units.
const CORNER: i64 = metres(3);

/// Length of the vectors that rows follow, units: houses are some multiple of 12.5 cm wide, and a
/// row of 150 m is less than 1 m off the axis of its street.
const GRAIN: i64 = metres(1) / 8;

/// A diagonal street is left out where it would leave a block with a side shorter than this.
const SHORTEST_SIDE: i64 = metres(24);

/// Once in so many cells without diagonal there is a square.
const SQUARES: i64 = 11;

/// Once in so many blocks there is a tower in the courtyard.
const TOWERS: i64 = 14;

/// What a random sequence is for.
const CROSSING: i64 = 0;
const QUARTER: i64 = 1;
const BENDING: i64 = 2;
const WIDTH: [i64; 2] = [3, 4];

/// A turned grid of streets whose crossings are moved about, with some diagonal streets.
pub struct Streets {
    seed: u64,
    /// From one crossing to the next along each family of streets, units.
    grid: [DVec2; 2],
}

impl Streets {
    pub fn new(seed: u64) -> Self {
        let mut random = SplitMix64::keyed(seed, [BENDING, i64::MAX, i64::MAX]);
        // A direction without sine and cosine: anywhere but near the centre of a square.
        let direction = std::iter::repeat_with(|| {
            DVec2::new(random.between(-1.0, 1.0), random.between(-1.0, 1.0))
        })
        .find(|d| d.length_squared() > 0.25)
        .unwrap_or(DVec2::X)
        .normalize();
        Self {
            seed,
            grid: [direction * PITCH[0], direction.perp() * PITCH[1]],
        }
    }

    /// The place of a crossing.
    fn crossing(&self, at: I64Vec2) -> I64Vec2 {
        let place = at.as_dvec2() + self.shift(CROSSING, at, JITTER) + self.bend(at);
        nearest(self.grid[0] * place.x + self.grid[1] * place.y)
    }

    /// How far streets are bent away from the grid at a crossing: bilinear between random places.
    fn bend(&self, at: I64Vec2) -> DVec2 {
        let (most, side) = BEND;
        let corner = at.div_euclid(I64Vec2::splat(side));
        let within = at.rem_euclid(I64Vec2::splat(side)).as_dvec2() / side as f64;
        let row = |y: i64| {
            let ends = [0, 1].map(|x| self.shift(BENDING, corner + I64Vec2::new(x, y), most));
            ends[0].lerp(ends[1], within.x)
        };
        row(0).lerp(row(1), within.y)
    }

    fn shift(&self, purpose: i64, at: I64Vec2, most: f64) -> DVec2 {
        let mut random = SplitMix64::keyed(self.seed, [purpose, at.x, at.y]);
        DVec2::new(random.between(-most, most), random.between(-most, most))
    }

    /// Half the width of a street: `family` 0 runs along the first grid vector, 1 along the other.
    fn half_width(&self, family: usize, number: i64) -> i64 {
        let mut random = SplitMix64::keyed(self.seed, [WIDTH[family], number, 0]);
        if number.rem_euclid(AVENUES) == 0 {
            random.whole(metres(7), metres(10))
        } else {
            random.whole(metres(3), metres(7))
        }
    }

    fn wants_diagonal(&self, at: I64Vec2) -> bool {
        (at.x - at.y).rem_euclid(DIAGONALS) == 0
    }
}

impl Plan for Streets {
    fn cell(&self, at: I64Vec2) -> Cell {
        let [a, b, c, d] =
            [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(x, y)| self.crossing(at + I64Vec2::new(x, y)));
        let lower = self.half_width(0, at.y);
        let right = self.half_width(1, at.x + 1);
        let upper = self.half_width(0, at.y + 1);
        let left = self.half_width(1, at.x);
        let across = metres(6);
        if self.wants_diagonal(at) {
            let below = sides([a, b, c], [lower, right, across], CORNER, GRAIN);
            let above = sides([a, c, d], [across, upper, left], CORNER, GRAIN);
            let long = |side: &Side| side.steps * GRAIN >= SHORTEST_SIDE;
            if below.iter().chain(&above).all(long) {
                return Cell {
                    sides: [below[0], below[1], above[1], above[2]],
                    diagonal: Some([above[0], below[2]]),
                };
            }
        }
        Cell {
            sides: sides([a, b, c, d], [lower, right, upper, left], CORNER, GRAIN),
            diagonal: None,
        }
    }

    fn quarter(&self, at: I64Vec2) -> Quarter {
        let mut random = SplitMix64::keyed(self.seed, [QUARTER, at.x, at.y]);
        let blocks = self.cell(at).blocks();
        if let [block] = blocks.as_slice()
            && random.once_in(SQUARES)
        {
            return square(block, &mut random);
        }
        Quarter {
            solids: blocks.iter().flat_map(|b| built(b, &mut random)).collect(),
            square: None,
        }
    }
}

/// An open square, sometimes with a tower in its middle.
fn square(block: &Block, random: &mut SplitMix64) -> Quarter {
    let tower = random.once_in(2).then(|| tower(block, random));
    let hole = tower.as_ref().map(|tower| tower.footprint.polygon());
    Quarter {
        square: Some(block.polygon(hole.as_ref())),
        solids: tower.into_iter().collect(),
    }
}

fn built(block: &Block, random: &mut SplitMix64) -> Vec<Solid> {
    let mut rows = Rows::new(block);
    if random.once_in(TOWERS) {
        rows.place(tower(block, random));
    }
    for side in &block.sides {
        rows.fill(side, random);
    }
    rows.solids
}
