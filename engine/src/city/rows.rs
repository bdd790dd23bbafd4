//! [`Rows`], row houses around one block.

use glam::I64Vec2;

use super::cell::{Block, Side};
use super::lattice::{are_apart, metres};
use super::random::SplitMix64;
use super::solid::{Roof, Solid};
use super::strip::Strip;

/// Least and greatest width of a house along its street, units.
const WIDTH: [i64; 2] = [metres(5), metres(12)];

/// How much wider than its narrowest house any house of a terrace is at the most, units.
const WIDER: i64 = metres(3);

/// Least and greatest depth of a house, units.
const DEPTH: [i64; 2] = [metres(8), metres(14)];

/// Least and greatest gap between two terraces that do not touch, units.
const GAP: [i64; 2] = [metres(2), metres(7)];

/// How far on the next try is where a house found no room, units.
const RETRY: [i64; 2] = [metres(1), metres(2)];

/// What heights are multiples of, units.
const RISER: i64 = metres(1) / 8;

/// Once in so many sides of blocks there is no row.
const EMPTY_SIDES: i64 = 5;

/// Once in so many houses one is much higher than its neighbours.
const TALL: i64 = 40;

/// The houses of one block, none of which overlaps another or a street.
pub struct Rows<'a> {
    block: &'a Block,
    taken: Vec<[I64Vec2; 4]>,
    pub solids: Vec<Solid>,
}

/// What the houses of a terrace have in common.
struct Terrace {
    /// Steps of the side from front to back.
    depth: i64,
    /// Least width of a house, units.
    width: i64,
    eaves: i64,
    gabled: bool,
    faces_front: bool,
}

impl<'a> Rows<'a> {
    pub fn new(block: &'a Block) -> Self {
        Self {
            block,
            taken: Vec::new(),
            solids: Vec::new(),
        }
    }

    /// Builds rows along a side, terrace by terrace; some touch, between others there is a gap.
    pub fn fill(&mut self, side: &Side, random: &mut SplitMix64) {
        if random.once_in(EMPTY_SIDES) {
            return;
        }
        let mut along = 0;
        while along < side.steps {
            along = self.fill_terrace(side, along, random);
            if random.once_in(2) {
                along += steps_between(side, GAP, random);
            }
        }
    }

    /// Builds a terrace until a house finds no room; returns where the next may begin.
    fn fill_terrace(&mut self, side: &Side, mut along: i64, random: &mut SplitMix64) -> i64 {
        let terrace = Terrace::new(side, random);
        for _ in 0..random.whole(2, 9) {
            let width = steps_between(side, [terrace.width, terrace.width + WIDER], random);
            let house = terrace.house(side, along, width, random);
            if along + width > side.steps || !self.place(house) {
                return along + steps_between(side, RETRY, random);
            }
            along += width;
        }
        along
    }

    /// Builds it where there is room in the block.
    pub fn place(&mut self, solid: Solid) -> bool {
        let Some(ground) = solid.footprint.quads().next() else {
            return false;
        };
        let free = self.block.holds(&ground) && self.taken.iter().all(|t| are_apart(t, &ground));
        if free {
            self.taken.push(ground);
            self.solids.push(solid);
        }
        free
    }
}

impl Terrace {
    fn new(side: &Side, random: &mut SplitMix64) -> Self {
        Self {
            depth: steps_between(side, DEPTH, random),
            width: random.whole(WIDTH[0], WIDTH[1] - WIDER),
            eaves: random.whole(metres(6) / RISER, metres(12) / RISER) * RISER,
            gabled: !random.once_in(3),
            faces_front: random.once_in(2),
        }
    }

    fn house(&self, side: &Side, along: i64, width: i64, random: &mut SplitMix64) -> Solid {
        let front = side.point(along, 0);
        let (across, inward) = (width * side.step, self.depth * side.step.perp());
        let higher = if random.once_in(TALL) {
            random.whole(metres(6) / RISER, metres(16) / RISER)
        } else {
            random.whole(0, metres(2) / RISER)
        };
        let rise = random.whole(metres(2) / RISER, metres(5) / RISER) * RISER;
        Solid {
            kind: "house",
            footprint: Strip::parallelogram(front, across, inward),
            eaves: self.eaves + higher * RISER,
            roof: if self.gabled {
                Roof::Gable {
                    rise,
                    faces_front: self.faces_front,
                }
            } else {
                Roof::Flat
            },
        }
    }
}

/// A random number of steps of a side whose length lies within bounds.
fn steps_between(side: &Side, [least, greatest]: [i64; 2], random: &mut SplitMix64) -> i64 {
    let step = side.step.as_dvec2().length();
    let low = (least as f64 / step).ceil() as i64;
    let high = (greatest as f64 / step).floor() as i64;
    random.whole(low, high)
}

/// A square tower in the middle of a block, turned as its first side.
pub fn tower(block: &Block, random: &mut SplitMix64) -> Solid {
    let side = &block.sides[0];
    let half = steps_between(side, [metres(6), metres(8)], random);
    let corner = block.middle() - half * (side.step + side.step.perp());
    Solid {
        kind: "tower",
        footprint: Strip::parallelogram(corner, 2 * half * side.step, 2 * half * side.step.perp()),
        eaves: random.whole(metres(25) / RISER, metres(40) / RISER) * RISER,
        roof: Roof::Flat,
    }
}
