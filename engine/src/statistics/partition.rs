//! Dividing a sample of boxes into groups.

use super::Group;
use crate::Box3d;

/// Divides the boxes into groups of at most `most` boxes, all nearly as large: halves them by the
/// side whose coordinates are spread furthest, again and again. Boxes of other sizes part like
/// boxes elsewhere, as lower and upper sides count alike. Neighbours stay next to each other.
pub fn groups(boxes: &mut [Box3d], most: usize) -> Vec<Group> {
    let mut made = Vec::new();
    divide(boxes, most.max(1), boxes.len(), &mut made);
    made
}

fn divide(boxes: &mut [Box3d], most: usize, total: usize, made: &mut Vec<Group>) {
    if boxes.len() <= most {
        if !boxes.is_empty() {
            made.push(Group::of(boxes, total));
        }
        return;
    }
    let side = widest_side(boxes);
    let half = boxes.len() / 2;
    boxes.select_nth_unstable_by(half, |a, b| coordinate(a, side).total_cmp(&coordinate(b, side)));
    let (left, right) = boxes.split_at_mut(half);
    divide(left, most, total, made);
    divide(right, most, total, made);
}

/// One of the six coordinates of a box: the three lower ones, then the upper ones.
fn coordinate(of: &Box3d, side: usize) -> f64 {
    if side < 3 {
        of.min[side]
    } else {
        of.max[side - 3]
    }
}

/// The side whose coordinates differ most.
fn widest_side(boxes: &[Box3d]) -> usize {
    let spread = |side: usize| {
        let (low, high) = boxes
            .iter()
            .map(|b| coordinate(b, side))
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), c| {
                (low.min(c), high.max(c))
            });
        // Halves, as the difference of two finite numbers need not be finite.
        high / 2.0 - low / 2.0
    };
    (0..6)
        .map(|side| (side, spread(side)))
        .max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0)))
        .map_or(0, |(side, _)| side)
}
