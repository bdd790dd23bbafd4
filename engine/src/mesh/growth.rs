//! Grows a box inside a mesh until it touches.

use glam::DVec3;

use super::clip::Clip;
use crate::Box3d;

/// How far a side stays from a contact whose place is computed, in metres: far above the rounding
/// of coordinates of some 1e6 m, far below any use.
const CONTACT_GAP: f64 = 1e-6;

/// Least relative gain in volume for which another round of growth is tried.
const LEAST_GAIN: f64 = 1e-4;

/// The orders in which axes may be grown.
const ORDERS: [[usize; 3]; 6] = [
    [0, 1, 2],
    [0, 2, 1],
    [1, 0, 2],
    [1, 2, 0],
    [2, 0, 1],
    [2, 1, 0],
];

/// One way of giving up length to win it back elsewhere: the axis and which of its sides move in.
const RETREATS: [(usize, bool, bool); 9] = [
    (0, true, false),
    (0, false, true),
    (0, true, true),
    (1, true, false),
    (1, false, true),
    (1, true, true),
    (2, true, false),
    (2, false, true),
    (2, true, true),
];

/// The triangles around a growing box.
pub struct Growth {
    triangles: Vec<Bounded>,
    envelope: Box3d,
    clip: Clip,
}

struct Bounded {
    corners: [DVec3; 3],
    min: DVec3,
    max: DVec3,
}

impl Growth {
    /// Growth among `triangles`, no farther than their `envelope`.
    pub fn new(triangles: impl Iterator<Item = [DVec3; 3]>, envelope: Box3d) -> Self {
        let triangles = triangles
            .map(|corners| {
                let [a, b, c] = corners;
                Bounded {
                    corners,
                    min: a.min(b).min(c),
                    max: a.max(b).max(c),
                }
            })
            .collect();
        Self {
            triangles,
            envelope,
            clip: Clip::default(),
        }
    }

    /// The largest of the boxes reached from `seed`, whose open box no triangle meets: each side in
    /// turn goes to its limit, in every order of axes, then lengths are traded against each other
    /// for at most `trades` halvings of the step.
    pub fn grow(&mut self, seed: Box3d, trades: usize) -> Box3d {
        let mut best = seed;
        for order in ORDERS {
            let grown = self.grow_in_order(seed, order);
            if grown.volume() > best.volume() {
                best = grown;
            }
        }
        self.trade(best, trades)
    }

    /// Rounds of growth, axis by axis, until a round wins nothing.
    fn grow_in_order(&mut self, mut bounds: Box3d, order: [usize; 3]) -> Box3d {
        loop {
            let before = bounds.volume();
            for axis in order {
                self.grow_axis(&mut bounds, axis);
            }
            let gains = bounds.volume() > before * (1.0 + LEAST_GAIN);
            if !gains {
                return bounds;
            }
        }
    }

    /// Hill climbing: pulls sides in by a step, lets the other axes grow into the room that this
    /// makes, and keeps what is larger.
    fn trade(&mut self, mut best: Box3d, halvings: usize) -> Box3d {
        let mut share = 0.25;
        for _ in 0..halvings {
            for (axis, low, high) in RETREATS {
                let step = share * best.size()[axis] * 0.5;
                let mut start = best;
                start.min[axis] += if low { step } else { 0.0 };
                start.max[axis] -= if high { step } else { 0.0 };
                let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
                for order in [[next, last, axis], [last, next, axis]] {
                    let mut grown = start;
                    for axis in order {
                        self.grow_axis(&mut grown, axis);
                    }
                    if grown.volume() > best.volume() * (1.0 + LEAST_GAIN) {
                        best = self.grow_in_order(grown, order);
                    }
                }
            }
            share *= 0.5;
        }
        best
    }

    fn grow_axis(&mut self, bounds: &mut Box3d, axis: usize) {
        bounds.max[axis] = self.limit_above(bounds, axis);
        bounds.min[axis] = self.limit_below(bounds, axis);
    }

    /// How far the upper side may move until the open box would meet a triangle.
    fn limit_above(&mut self, bounds: &Box3d, axis: usize) -> f64 {
        let start = bounds.max[axis];
        let mut limit = self.envelope.max[axis];
        for triangle in &self.triangles {
            if triangle.max[axis] < start || triangle.min[axis] >= limit {
                continue;
            }
            let Some((contact, far)) = piece_in_prism(&mut self.clip, triangle, bounds, axis)
            else {
                continue;
            };
            if far >= start {
                let exact = contact == triangle.min[axis];
                limit = limit.min(if exact {
                    contact
                } else {
                    contact - CONTACT_GAP
                });
            }
        }
        limit.max(start)
    }

    /// How far the lower side may move until the open box would meet a triangle.
    fn limit_below(&mut self, bounds: &Box3d, axis: usize) -> f64 {
        let start = bounds.min[axis];
        let mut limit = self.envelope.min[axis];
        for triangle in &self.triangles {
            if triangle.min[axis] > start || triangle.max[axis] <= limit {
                continue;
            }
            let Some((far, contact)) = piece_in_prism(&mut self.clip, triangle, bounds, axis)
            else {
                continue;
            };
            if far <= start {
                let exact = contact == triangle.max[axis];
                limit = limit.max(if exact {
                    contact
                } else {
                    contact + CONTACT_GAP
                });
            }
        }
        limit.min(start)
    }
}

/// Extent along `axis` of the part of the triangle that is in the box's open prism along it.
fn piece_in_prism(
    clip: &mut Clip,
    triangle: &Bounded,
    bounds: &Box3d,
    axis: usize,
) -> Option<(f64, f64)> {
    let others = [(axis + 1) % 3, (axis + 2) % 3];
    let apart = |side: usize| {
        triangle.max[side] <= bounds.min[side] || triangle.min[side] >= bounds.max[side]
    };
    if others.into_iter().any(apart) {
        return None;
    }
    clip.reset(&triangle.corners);
    for side in others {
        clip.cut(side, bounds.min[side], bounds.max[side]);
    }
    let meets = |side: usize| clip.meets_open_slab(side, bounds.min[side], bounds.max[side]);
    if others.into_iter().all(meets) {
        clip.extent(axis)
    } else {
        None
    }
}
