//! The layout `blocks`: a grid of city blocks with courtyards, free-standing buildings and squares.

use glam::I64Vec2;

use super::cell::{Cell, Side};
use super::generated::{Plan, Quarter};
use super::lattice::metres;
use super::perimeter::Perimeter;
use super::random::SplitMix64;
use super::solid::{Roof, Solid};
use super::strip::Strip;

/// From one street's axis to the next along x and y before it is moved, units.
const PITCH: [i64; 2] = [metres(112), metres(88)];

/// How far an axis is moved at the most, units.
const SHIFT: i64 = metres(9);

/// Every so many streets is an avenue.
const AVENUES: i64 = 4;

/// What plan coordinates and heights are multiples of, units.
const GRAIN: i64 = metres(1) / 8;

/// Wide enough for a free-standing building and the lawn around it, units.
const LOT: i64 = metres(27);

/// What a random sequence is for.
const QUARTER: i64 = 0;
const AXIS: [i64; 2] = [1, 2];

/// A grid of streets along x and y.
pub struct Blocks {
    pub seed: u64,
}

impl Blocks {
    /// Where the street with a number runs along an axis, and half its width.
    fn street(&self, axis: usize, number: i64) -> (i64, i64) {
        let mut random = SplitMix64::keyed(self.seed, [AXIS[axis], number, 0]);
        let place = number * PITCH[axis] + multiple(-SHIFT, SHIFT, &mut random);
        let half_width = if number.rem_euclid(AVENUES) == 0 {
            multiple(metres(10), metres(16), &mut random)
        } else {
            multiple(metres(3), metres(8), &mut random)
        };
        (place, half_width)
    }

    /// From the end of one street's width to the beginning of the next one's.
    fn between(&self, axis: usize, number: i64) -> [i64; 2] {
        let (low, low_half) = self.street(axis, number);
        let (high, high_half) = self.street(axis, number + 1);
        [low + low_half, high - high_half]
    }
}

impl Plan for Blocks {
    fn cell(&self, at: I64Vec2) -> Cell {
        let ([left, right], [lower, upper]) = (self.between(0, at.x), self.between(1, at.y));
        let side = |x: i64, y: i64, direction: I64Vec2, length: i64| Side {
            start: I64Vec2::new(x, y),
            step: direction * GRAIN,
            steps: length / GRAIN,
        };
        let (width, depth) = (right - left, upper - lower);
        Cell {
            sides: [
                side(left, lower, I64Vec2::X, width),
                side(right, lower, I64Vec2::Y, depth),
                side(right, upper, I64Vec2::NEG_X, width),
                side(left, upper, I64Vec2::NEG_Y, depth),
            ],
            diagonal: None,
        }
    }

    fn quarter(&self, at: I64Vec2) -> Quarter {
        let mut random = SplitMix64::keyed(self.seed, [QUARTER, at.x, at.y]);
        let cell = self.cell(at);
        let solids = match random.whole(0, 99) {
            0..8 => {
                let square = cell.blocks().first().map(|block| block.polygon(None));
                return Quarter {
                    square,
                    ..Quarter::default()
                };
            }
            8..18 => perimeter(&cell, Perimeter::whole, &mut random),
            18..32 => perimeter(&cell, Perimeter::in_large_parts, &mut random),
            32..82 => perimeter(&cell, Perimeter::in_parts, &mut random),
            _ => free_standing(&cell, &mut random),
        };
        Quarter {
            solids,
            square: None,
        }
    }
}

/// Closed perimeter buildings around a courtyard.
fn perimeter(
    cell: &Cell,
    parts: impl Fn(&Perimeter, &mut SplitMix64) -> Vec<Strip>,
    random: &mut SplitMix64,
) -> Vec<Solid> {
    let depth = multiple(metres(10), metres(14), random) / GRAIN;
    let usual = random.whole(metres(9), metres(24));
    parts(&Perimeter::new(cell.sides, depth, GRAIN), random)
        .into_iter()
        .map(|footprint| {
            let height = multiple(usual - metres(3), usual + metres(3), random);
            building("building", footprint, height)
        })
        .collect()
}

/// Buildings with lawn all around: towers, slabs, and some of L or U shape.
fn free_standing(cell: &Cell, random: &mut SplitMix64) -> Vec<Solid> {
    let origin = cell.sides[0].start;
    let size = cell.sides[1].end() - origin;
    let lots = (size / LOT).max(I64Vec2::ONE);
    let lot = size / lots / GRAIN * GRAIN;
    let places = (0..lots.y).flat_map(|y| (0..lots.x).map(move |x| I64Vec2::new(x, y)));
    let corners = places.map(|place| origin + place * lot);
    corners.map(|corner| on_lot(corner, lot, random)).collect()
}

fn on_lot(corner: I64Vec2, lot: I64Vec2, random: &mut SplitMix64) -> Solid {
    let mut lawn = || {
        let [x, y] = [0; 2].map(|_| multiple(metres(2), metres(5), random));
        I64Vec2::new(x, y)
    };
    let (before, behind) = (lawn(), lawn());
    let corner = corner + before;
    let room = lot - before - behind;
    let low = multiple(metres(6), metres(18), random);
    match random.whole(0, 9) {
        0..4 => {
            let side = multiple(metres(14), metres(17), random);
            let high = multiple(metres(24), metres(40), random);
            building("tower", upright(corner, I64Vec2::splat(side)), high)
        }
        4 => building("building", bent(corner, room, &L_SHAPE, random), low),
        5 => building("building", bent(corner, room, &U_SHAPE, random), low),
        _ => building("building", upright(corner, room), low),
    }
}

fn upright(corner: I64Vec2, size: I64Vec2) -> Strip {
    Strip::parallelogram(corner, I64Vec2::X * size.x, I64Vec2::Y * size.y)
}

/// Corners of a lot that a bent building passes, and from each the direction to its inner line.
type Shape = [[[i64; 2]; 2]];

const L_SHAPE: [[[i64; 2]; 2]; 3] = [[[0, 1], [1, 0]], [[0, 0], [1, 1]], [[1, 0], [0, 1]]];

const U_SHAPE: [[[i64; 2]; 2]; 4] = [
    [[0, 1], [1, 0]],
    [[0, 0], [1, 1]],
    [[1, 0], [-1, 1]],
    [[1, 1], [-1, 0]],
];

/// A building along two or three sides of its lot.
fn bent(corner: I64Vec2, size: I64Vec2, shape: &Shape, random: &mut SplitMix64) -> Strip {
    let wing = multiple(metres(5), metres(6), random);
    let outer = |[place, _]: &[[i64; 2]; 2]| corner + I64Vec2::from_array(*place) * size;
    let inner = |[_, inward]: &[[i64; 2]; 2]| I64Vec2::from_array(*inward) * wing;
    Strip {
        outer: shape.iter().map(outer).collect(),
        inner: shape.iter().map(|c| outer(c) + inner(c)).collect(),
        closed: false,
    }
}

fn building(kind: &'static str, footprint: Strip, height: i64) -> Solid {
    Solid {
        kind,
        footprint,
        eaves: height,
        roof: Roof::Flat,
    }
}

/// A random multiple of the grain from `low` to `high`.
fn multiple(low: i64, high: i64, random: &mut SplitMix64) -> i64 {
    random.whole(low.div_euclid(GRAIN), high.div_euclid(GRAIN)) * GRAIN
}
