//! Dividing a sample of boxes into groups.

use super::Group;
use crate::Box3d;
use std::collections::BinaryHeap;

/// Groups are not divided below this many boxes: fewer say little of where others lie.
const FEWEST: usize = 8;

/// Sides count by their spread in the group over their spread in the whole to this power. At 0,
/// metres alone decide and heights never part; at 1, heights part as often as plan coordinates,
/// and clusters too seldom. Of 0, 0.25, 0.5, 0.67 and 0.75, this has the best worst case
/// (`examples/statistics_figures.rs`).
const EVENNESS: f64 = 0.67;

/// A gap as wide as this share of a group's spread is cut along: the space between two streets or
/// clusters.
const GAP: f64 = 0.1;

/// One of the six coordinates of a box: the three lower ones, then the upper ones.
type Side = usize;

/// Divides the boxes into at most `most` groups: cuts the largest in two, across the side whose
/// coordinates are spread furthest, again and again. Boxes of other sizes part like boxes
/// elsewhere, as lower and upper sides count alike. Neighbours stay near each other in the order.
pub fn groups(boxes: &mut [Box3d], most: usize) -> Vec<Group> {
    let worth = worth(boxes);
    // Parts as length and start.
    let mut parts = BinaryHeap::from([(boxes.len(), 0)]);
    let mut done = Vec::new();
    while let Some((length, start)) = parts.pop() {
        if length >= 2 * FEWEST && parts.len() + done.len() + 1 < most {
            let left = divide(&mut boxes[start..start + length], &worth);
            parts.push((left, start));
            parts.push((length - left, start + left));
        } else if length > 0 {
            done.push((start, length));
        }
    }
    done.sort_unstable();
    done.iter()
        .map(|&(start, length)| Group::of(&boxes[start..start + length], boxes.len()))
        .collect()
}

/// Orders the boxes across their widest side, and says where to cut them: in a gap in the middle
/// third, or in the middle.
fn divide(boxes: &mut [Box3d], worth: &[f64; 6]) -> usize {
    let side = widest_side(boxes, worth);
    boxes.sort_unstable_by(|a, b| coordinate(a, side).total_cmp(&coordinate(b, side)));
    let count = boxes.len();
    let between = |i: usize, j: usize| {
        half_distance(coordinate(&boxes[i], side), coordinate(&boxes[j], side))
    };
    let gap = |at: &usize| between(at - 1, *at);
    (count / 3..=2 * count / 3)
        .max_by(|a, b| gap(a).total_cmp(&gap(b)))
        .filter(|at| gap(at) > GAP * between(0, count - 1))
        .unwrap_or(count / 2)
}

/// The side whose coordinates differ most, by what a metre of each is worth.
fn widest_side(boxes: &[Box3d], worth: &[f64; 6]) -> Side {
    let spread = |side: Side| {
        let (low, high) = boxes
            .iter()
            .map(|b| coordinate(b, side))
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), c| {
                (low.min(c), high.max(c))
            });
        half_distance(low, high) * worth[side]
    };
    (0..6)
        .map(|side| (spread(side), side))
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map_or(0, |(_, side)| side)
}

/// What a metre along each side is worth: more where the boxes lie closer together, outliers
/// apart; nothing where they are all at one place.
fn worth(boxes: &[Box3d]) -> [f64; 6] {
    std::array::from_fn(|side| {
        let mut along: Vec<f64> = boxes.iter().map(|b| coordinate(b, side)).collect();
        along.sort_unstable_by(f64::total_cmp);
        let tenth = along.len() / 10;
        match (along.get(tenth), along.iter().rev().nth(tenth)) {
            (Some(&low), Some(&high)) if low < high => half_distance(low, high).powf(-EVENNESS),
            _ => 0.0,
        }
    })
}

fn coordinate(of: &Box3d, side: Side) -> f64 {
    if side < 3 {
        of.min[side]
    } else {
        of.max[side - 3]
    }
}

/// Half of the distance, as the difference of two finite numbers need not be finite.
fn half_distance(low: f64, high: f64) -> f64 {
    high / 2.0 - low / 2.0
}
