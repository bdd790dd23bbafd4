//! [`Outline`], the rings around joined triangles of a plan.

use std::collections::HashMap;

use geo::{Coord, LineString, Polygon};
use glam::DVec2;

use crate::predicates::turn;

/// A computed corner this close to the line between its neighbours is left out, metres: it is on
/// that line but for rounding.
const STRAIGHT: f64 = 1e-6;

/// An exact corner is left out this close to that line where leaving it out makes the outline no
/// larger, metres: it is meant to be on the line, and the plan bends lines by half of this.
const FLAT: f64 = 2e-7;

/// A needle narrower than this at its foot is cut off, metres.
const NEEDLE: f64 = 1e-3;

/// A corner moves by no more than this many times the distance that its edges move.
const SHARPEST: f64 = 4.0;

/// A corner of an outline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// Number in the plan.
    pub number: usize,
    pub place: DVec2,
    /// Whether the place is that of a vertex of the mesh, bit for bit.
    pub is_exact: bool,
}

/// The outer ring, anticlockwise, and the holes, clockwise.
#[derive(Clone, Debug)]
pub struct Outline {
    pub rings: Vec<Vec<Corner>>,
}

impl Outline {
    /// The outline of triangles that hang together by edges; `None` when they have no area.
    pub fn around(
        triangles: impl IntoIterator<Item = [usize; 3]>,
        corner: impl Fn(usize) -> Corner,
    ) -> Option<Self> {
        let rings = rings(triangles).into_iter();
        Self::new(
            rings
                .map(|ring| ring.into_iter().map(&corner).collect())
                .collect(),
        )
    }

    /// Sorts rings into one that turns anticlockwise and holes.
    pub fn new(mut rings: Vec<Vec<Corner>>) -> Option<Self> {
        rings.retain(|ring| ring.len() > 2 && signed_area(ring) != 0.0);
        let outer = rings.iter().position(|ring| signed_area(ring) > 0.0)?;
        rings.swap(0, outer);
        let is_simple = rings[1..].iter().all(|ring| signed_area(ring) < 0.0);
        is_simple.then_some(Self { rings })
    }

    /// Without corners that only divide a straight edge or end a needle.
    pub fn straightened(&self) -> Option<Self> {
        Self::new(self.rings.iter().map(|ring| straightened(ring)).collect())
    }

    /// With computed corners moved inward, so that edges that they end stay `distance` away.
    pub fn pulled(&self, distance: f64) -> Self {
        let pull = |ring: &Vec<Corner>| {
            let count = ring.len();
            let pulled = |i: usize| {
                let [before, corner, after] = [i + count - 1, i, i + 1].map(|i| ring[i % count]);
                if corner.is_exact {
                    return corner;
                }
                let inward = inward([before.place, corner.place, after.place]);
                Corner {
                    place: corner.place + inward * distance,
                    ..corner
                }
            };
            (0..count).map(pulled).collect()
        };
        Self {
            rings: self.rings.iter().map(pull).collect(),
        }
    }

    pub fn area(&self) -> f64 {
        self.rings.iter().map(|ring| signed_area(ring)).sum()
    }

    /// Twice the area over the length of the rings: half the width of a long strip.
    pub fn width(&self) -> f64 {
        let length = |ring: &Vec<Corner>| -> f64 {
            edges(ring)
                .map(|(from, to)| from.place.distance(to.place))
                .sum()
        };
        2.0 * self.area() / self.rings.iter().map(length).sum::<f64>()
    }

    pub fn polygon(&self) -> Polygon<f64> {
        let line = |ring: &Vec<Corner>| {
            let coord = |corner: &Corner| Coord {
                x: corner.place.x,
                y: corner.place.y,
            };
            let mut line: Vec<Coord> = ring.iter().map(coord).collect();
            line.extend(line.first().copied());
            LineString::new(line)
        };
        let mut rings = self.rings.iter().map(line);
        let outer = rings.next().unwrap_or_else(|| LineString::new(Vec::new()));
        Polygon::new(outer, rings.collect())
    }
}

/// The boundary of triangles as rings that pass each corner once, the triangles on their left.
fn rings(triangles: impl IntoIterator<Item = [usize; 3]>) -> Vec<Vec<usize>> {
    let mut balance: HashMap<[usize; 2], i32> = HashMap::new();
    for [a, b, c] in triangles {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let (key, turn) = if from < to {
                ([from, to], 1)
            } else {
                ([to, from], -1)
            };
            *balance.entry(key).or_default() += turn;
        }
    }
    let mut rim: Vec<[usize; 2]> = balance
        .into_iter()
        .filter(|(_, turns)| *turns != 0)
        .map(|([from, to], turns)| if turns > 0 { [from, to] } else { [to, from] })
        .collect();
    rim.sort_unstable();
    let mut next: HashMap<usize, Vec<usize>> = HashMap::new();
    for [from, to] in rim.iter().rev() {
        next.entry(*from).or_default().push(*to);
    }
    let mut rings = Vec::new();
    for [start, _] in rim {
        let mut path = vec![start];
        let mut at = start;
        while let Some(to) = next.get_mut(&at).and_then(Vec::pop) {
            // Back at a corner of the path: a ring is closed.
            if let Some(first) = path.iter().position(|&corner| corner == to) {
                rings.push(path.split_off(first));
            }
            path.push(to);
            at = to;
        }
    }
    rings
}

/// The ring without corners that only divide a straight edge or end a needle.
fn straightened(ring: &[Corner]) -> Vec<Corner> {
    // Exact corners last, when they are seen against exact neighbours.
    let computed = without(ring.to_vec(), |corner| !corner.is_exact);
    without(computed, |_| true)
}

/// The ring without needless corners of a kind.
fn without(mut ring: Vec<Corner>, kind: impl Fn(&Corner) -> bool) -> Vec<Corner> {
    loop {
        let count = ring.len();
        let mut kept: Vec<Corner> = Vec::with_capacity(count);
        for (i, &corner) in ring.iter().enumerate() {
            let before = kept.last().unwrap_or(&ring[count - 1]);
            if !(kind(&corner) && is_needless([before, &corner, &ring[(i + 1) % count]])) {
                kept.push(corner);
            }
        }
        if kept.len() == count {
            return ring;
        }
        ring = kept;
    }
}

fn is_needless([before, corner, after]: [&Corner; 3]) -> bool {
    let (to, from) = (corner.place - before.place, after.place - corner.place);
    let turn = turn(before.place, corner.place, after.place);
    if to.dot(from) <= 0.0 {
        return 0.0 <= turn && turn <= NEEDLE * to.length().max(from.length());
    }
    let chord = after.place.distance(before.place);
    let [reach, reach_outside] = if corner.is_exact {
        [FLAT, 0.0]
    } else {
        [STRAIGHT; 2]
    };
    -reach_outside * chord <= turn && turn <= reach * chord
}

/// How far a corner moves for its edges to move inward, to their left, by 1.
fn inward([before, corner, after]: [DVec2; 3]) -> DVec2 {
    let left = |from: DVec2, to: DVec2| (to - from).normalize_or_zero().perp();
    let (one, other) = (left(before, corner), left(corner, after));
    let reach = (one + other) / (1.0 + one.dot(other));
    if reach.is_finite() {
        reach.clamp_length_max(SHARPEST)
    } else {
        // Back along a needle.
        (before - corner).normalize_or_zero() * SHARPEST
    }
}

fn signed_area(ring: &[Corner]) -> f64 {
    let origin = ring.first().map_or(DVec2::ZERO, |corner| corner.place);
    let doubled = |(from, to): (Corner, Corner)| (from.place - origin).perp_dot(to.place - origin);
    edges(ring).map(doubled).sum::<f64>() / 2.0
}

fn edges(ring: &[Corner]) -> impl Iterator<Item = (Corner, Corner)> {
    ring.iter()
        .copied()
        .zip(ring.iter().copied().cycle().skip(1))
}
