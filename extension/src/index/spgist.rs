//! SP-GiST for `box3d`: a box is a point of six dimensions, and an inner node splits space in 64 at
//! the medians of the six (as core does for plane boxes, in four).

use super::query::{Nearest, Query};
use super::spgist_sys::{
    SPG_MATCH_NODE, SpgChooseIn, SpgChooseOut, SpgConfigOut, SpgInnerConsistentIn,
    SpgInnerConsistentOut, SpgLeafConsistentIn, SpgLeafConsistentOut, SpgPickSplitIn,
    SpgPickSplitOut,
};
use crate::direct_call::direct_function;
use crate::types::{Box3d, Raw, read};
use engine::BoxRange;
use glam::DVec3;
use pgrx::{IntoDatum, pg_sys};
use std::ffi::c_int;

/// Children of a node: each of the six numbers is above the median or not.
const CHILDREN: usize = 64;

/// Boxes that are all there can be.
const EVERYWHERE: engine::Box3d = engine::Box3d {
    min: DVec3::NEG_INFINITY,
    max: DVec3::INFINITY,
};

direct_function! {
    /// What nodes and leaves hold.
    fn box3d_spgist_config(_given: Raw<u8>, config: Raw<SpgConfigOut>) {
        // SAFETY: SP-GiST passes a place for the answer.
        let config = unsafe { &mut *config.as_ptr() };
        config.prefix_type = Box3d::type_oid();
        config.label_type = pg_sys::VOIDOID;
        config.can_return_data = true;
        config.long_values_ok = false;
    }
}

direct_function! {
    /// The child that takes a new box.
    fn box3d_spgist_choose(given: Raw<SpgChooseIn>, choice: Raw<SpgChooseOut>) {
        // SAFETY: SP-GiST passes a node of ours, a box and a place for the answer.
        unsafe {
            let (given, choice) = (&*given.as_ptr(), &mut *choice.as_ptr());
            choice.result_type = SPG_MATCH_NODE;
            choice.match_node.level_add = 0;
            choice.match_node.rest = given.leaf;
            // Where all children are the same, SP-GiST chooses.
            choice.match_node.node = if given.all_the_same {
                0
            } else {
                number(child(&read(given.prefix), &read(given.leaf)))
            };
        }
    }
}

direct_function! {
    /// Splits the boxes of a full page at the medians of their numbers.
    fn box3d_spgist_picksplit(given: Raw<SpgPickSplitIn>, split: Raw<SpgPickSplitOut>) {
        // SAFETY: SP-GiST passes boxes and a place for the answer; what is allocated lives in its
        // memory context.
        unsafe {
            let (given, split) = (&*given.as_ptr(), &mut *split.as_ptr());
            let count = usize::try_from(given.count).unwrap_or(0);
            let datums = std::slice::from_raw_parts(given.datums, count);
            let boxes: Vec<engine::Box3d> = datums.iter().map(|&datum| read(datum)).collect();
            let medians = medians(&boxes);
            split.has_prefix = true;
            split.prefix = Box3d(medians).into_datum().unwrap_or(pg_sys::Datum::null());
            split.node_count = number(CHILDREN);
            split.node_labels = std::ptr::null_mut();
            split.nodes = array(boxes.iter().map(|key| number(child(&medians, key))));
            split.leaves = array(datums.iter().copied());
        }
    }
}

direct_function! {
    /// The children that can hold what a scan looks for.
    fn box3d_spgist_inner_consistent(
        call: pg_sys::FunctionCallInfo,
        given: Raw<SpgInnerConsistentIn>,
        visit: Raw<SpgInnerConsistentOut>,
    ) {
        // SAFETY: SP-GiST passes a node of ours, the range of its boxes that we gave it, or null at the
        // root, keys of our operator class, and a place for the answer.
        unsafe {
            let (given, visit) = (&*given.as_ptr(), &mut *visit.as_ptr());
            let range = given.range.cast::<BoxRange>().as_ref().copied();
            let range = range.unwrap_or(BoxRange::inside(&EVERYWHERE));
            let queries = queries(given.keys, given.key_count);
            let nearest = nearest(given.orders, given.order_count);
            let ranges = (0..usize::try_from(given.node_count).unwrap_or(0)).map(|node| {
                let whole = given.all_the_same;
                let range = if whole {
                    range
                } else {
                    part(&range, &read(given.prefix), node)
                };
                (node, range)
            });
            let chosen: Vec<(usize, BoxRange)> = ranges
                .filter(|(_, range)| queries.iter().all(|query| query.possible(call, range)))
                .collect();
            let distances = |range: &BoxRange| {
                let bounds = range.bounds();
                array(nearest.iter().map(|nearest| nearest.distance(&bounds)))
            };
            let remember = |range: &BoxRange| {
                let room = pg_sys::MemoryContextAlloc(given.range_context, size_of::<BoxRange>());
                room.cast::<BoxRange>().write(*range);
                room
            };
            visit.node_count = number(chosen.len());
            visit.nodes = array(chosen.iter().map(|(node, _)| number(*node)));
            visit.ranges = array(chosen.iter().map(|(_, range)| remember(range)));
            if !nearest.is_empty() {
                visit.distances = array(chosen.iter().map(|(_, range)| distances(range)));
            }
        }
    }
}

direct_function! {
    /// Whether a box is what a scan looks for; exact.
    fn box3d_spgist_leaf_consistent(
        call: pg_sys::FunctionCallInfo,
        given: Raw<SpgLeafConsistentIn>,
        answer: Raw<SpgLeafConsistentOut>,
    ) -> bool {
        // SAFETY: SP-GiST passes a box, keys of our operator class, and a place for the answer.
        unsafe {
            let (given, answer) = (&*given.as_ptr(), &mut *answer.as_ptr());
            let key: engine::Box3d = read(given.leaf);
            answer.value = given.leaf;
            answer.recheck = false;
            answer.recheck_distances = false;
            let mut queries = queries(given.keys, given.key_count).into_iter();
            let found = queries.all(|query| query.holds(call, &key));
            if found && given.order_count > 0 {
                let nearest = nearest(given.orders, given.order_count);
                answer.distances = array(nearest.iter().map(|nearest| nearest.distance(&key)));
            }
            found
        }
    }
}

/// The child of a node with these medians that a box belongs to.
fn child(medians: &engine::Box3d, key: &engine::Box3d) -> usize {
    let least = key.min.cmpgt(medians.min).bitmask();
    let greatest = key.max.cmpgt(medians.max).bitmask();
    (least | greatest << 3) as usize
}

/// The part of a range that belongs to a child.
fn part(range: &BoxRange, medians: &engine::Box3d, child: usize) -> BoxRange {
    let mut part = *range;
    for axis in 0..3 {
        for (bounds, median, bit) in [
            (&mut part.least, medians.min[axis], axis),
            (&mut part.greatest, medians.max[axis], axis + 3),
        ] {
            if child >> bit & 1 == 1 {
                bounds.min[axis] = bounds.min[axis].max(median);
            } else {
                bounds.max[axis] = bounds.max[axis].min(median);
            }
        }
    }
    part
}

/// The median of each of the six numbers.
fn medians(boxes: &[engine::Box3d]) -> engine::Box3d {
    let median = |number: &dyn Fn(&engine::Box3d) -> f64| {
        let mut numbers: Vec<f64> = boxes.iter().map(number).collect();
        let middle = numbers.len() / 2;
        *numbers.select_nth_unstable_by(middle, f64::total_cmp).1
    };
    engine::Box3d {
        min: DVec3::from([0, 1, 2].map(|axis| median(&|key| key.min[axis]))),
        max: DVec3::from([0, 1, 2].map(|axis| median(&|key| key.max[axis]))),
    }
}

/// What the keys of a scan look for.
///
/// # Safety
/// They must be `count` keys of our operator class.
unsafe fn queries<'a>(keys: *mut pg_sys::ScanKeyData, count: c_int) -> Vec<Query<'a>> {
    // SAFETY: as the caller says.
    unsafe {
        let keys = slice(keys, count).iter();
        keys.map(|key| Query::of(key.sk_strategy, key.sk_argument))
            .collect()
    }
}

/// What the orders of a scan measure from.
///
/// # Safety
/// They must be `count` ordering keys of our operator class.
unsafe fn nearest(keys: *mut pg_sys::ScanKeyData, count: c_int) -> Vec<Nearest> {
    // SAFETY: as the caller says.
    unsafe {
        let keys = slice(keys, count).iter();
        keys.map(|key| Nearest::of(key.sk_strategy, key.sk_argument))
            .collect()
    }
}

/// # Safety
/// There must be `count` values, or none.
unsafe fn slice<'a, T>(values: *mut T, count: c_int) -> &'a [T] {
    match usize::try_from(count) {
        // SAFETY: as the caller says.
        Ok(count) if count > 0 => unsafe { std::slice::from_raw_parts(values, count) },
        _ => &[],
    }
}

/// Values in memory of the current context.
fn array<T>(values: impl ExactSizeIterator<Item = T>) -> *mut T {
    // SAFETY: there is room for all of them; an iterator that is longer than it said is cut.
    unsafe {
        let count = values.len();
        let room = pg_sys::palloc(size_of::<T>() * count.max(1)).cast::<T>();
        for (place, value) in values.take(count).enumerate() {
            room.add(place).write(value);
        }
        room
    }
}

fn number(count: usize) -> c_int {
    c_int::try_from(count).unwrap_or(c_int::MAX)
}
