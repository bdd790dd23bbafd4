//! Which features share a tile.

use super::tree::halve;
use crate::Box3d;

/// Features longer than this in plan, metres, are in tiles of their own kind: one of them would make
/// the box of its tile so large that the tile is read from everywhere.
const LONG: f64 = 200.0;

/// Groups of neighbours, as the positions of their outer envelopes: each position is in one group, and
/// a group weighs no more than `most`, unless a single feature does.
///
/// The groups are few and compact, in no order that means anything.
#[must_use]
pub fn neighbourhoods(
    boxes: &[Box3d],
    weight: impl Fn(usize) -> usize,
    most: usize,
) -> Vec<Vec<usize>> {
    let is_long = |&at: &usize| boxes[at].size().truncate().max_element() > LONG;
    let (long, usual) = (0..boxes.len()).partition(is_long);
    let mut groups = Vec::new();
    let mut open: Vec<Vec<usize>> = vec![long, usual];
    while let Some(mut group) = open.pop() {
        let weighs = group.iter().map(|&at| weight(at)).sum::<usize>();
        if group.len() > 1 && weighs > most {
            let middle = halve(boxes, &mut group);
            open.push(group.split_off(middle));
            open.push(group);
        } else if !group.is_empty() {
            groups.push(group);
        }
    }
    groups
}
