//! SP-GiST for `box3d`: an inner node holds a [`BoxSplit`], and a scan knows the [`BoxCell`] of the
//! boxes below it.

use super::query::{Nearest, Query};
use super::spgist_sys::{
    SPG_MATCH_NODE, SpgChooseIn, SpgChooseOut, SpgConfigOut, SpgInnerConsistentIn,
    SpgInnerConsistentOut, SpgLeafConsistentIn, SpgLeafConsistentOut, SpgPickSplitIn,
    SpgPickSplitOut,
};
use crate::direct_call::direct_function;
use crate::types::{Box3d, Raw, read};
use engine::{BoxCell, BoxSplit};
use glam::DVec3;
use pgrx::{IntoDatum, pg_sys};
use std::ffi::c_int;

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
                number(stored(given.prefix).part_of(&read(given.leaf)))
            };
        }
    }
}

direct_function! {
    /// Splits the boxes of a full page.
    fn box3d_spgist_picksplit(given: Raw<SpgPickSplitIn>, split: Raw<SpgPickSplitOut>) {
        // SAFETY: SP-GiST passes boxes and a place for the answer; what is allocated lives in its
        // memory context.
        unsafe {
            let (given, split) = (&*given.as_ptr(), &mut *split.as_ptr());
            let count = usize::try_from(given.count).unwrap_or(0);
            let datums = std::slice::from_raw_parts(given.datums, count);
            let boxes: Vec<engine::Box3d> = datums.iter().map(|&datum| read(datum)).collect();
            let parts = BoxSplit::of(&boxes);
            split.has_prefix = true;
            split.prefix = prefix(&parts);
            split.node_count = number(BoxSplit::PARTS);
            split.node_labels = std::ptr::null_mut();
            split.nodes = array(boxes.iter().map(|key| number(parts.part_of(key))));
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
        // SAFETY: SP-GiST passes a node of ours, the cell of its boxes that we gave it, or null at the
        // root, keys of our operator class, and a place for the answer.
        unsafe {
            let (given, visit) = (&*given.as_ptr(), &mut *visit.as_ptr());
            let cell = given.cell.cast::<BoxCell>().as_ref().copied();
            let cell = cell.unwrap_or(BoxCell::EVERYTHING);
            let queries = queries(given.keys, given.key_count);
            let nearest = nearest(given.orders, given.order_count);
            // Where all children are the same, boxes are in any of them, and the prefix says nothing.
            let split = (!given.all_the_same).then(|| stored(given.prefix));
            let parts = (0..usize::try_from(given.node_count).unwrap_or(0)).filter_map(|node| {
                let part = match split {
                    Some(split) => split.part(&cell, node)?,
                    None => cell,
                };
                Some((node, part))
            });
            let chosen: Vec<(usize, BoxCell)> = parts
                .filter(|(_, part)| queries.iter().all(|query| query.possible(call, &part.range)))
                .collect();
            let distances = |part: &BoxCell| {
                let bounds = part.range.bounds();
                array(nearest.iter().map(|nearest| nearest.distance(&bounds)))
            };
            let remember = |part: &BoxCell| {
                let room = pg_sys::MemoryContextAlloc(given.cell_context, size_of::<BoxCell>());
                room.cast::<BoxCell>().write(*part);
                room
            };
            visit.node_count = number(chosen.len());
            visit.nodes = array(chosen.iter().map(|(node, _)| number(*node)));
            visit.cells = array(chosen.iter().map(|(_, part)| remember(part)));
            if !nearest.is_empty() {
                visit.distances = array(chosen.iter().map(|(_, part)| distances(part)));
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

/// A split as the prefix of a node. A `box3d` is six numbers, and so is a split.
fn prefix(split: &BoxSplit) -> pg_sys::Datum {
    let [a, b, c, d, e, f] = split.to_numbers();
    let numbers = Box3d(engine::Box3d {
        min: DVec3::new(a, b, c),
        max: DVec3::new(d, e, f),
    });
    numbers.into_datum().unwrap_or(pg_sys::Datum::null())
}

/// The split of a node.
///
/// # Safety
/// It must be a prefix that [`prefix`] made.
unsafe fn stored(prefix: pg_sys::Datum) -> BoxSplit {
    // SAFETY: as the caller says.
    let engine::Box3d { min, max } = unsafe { read(prefix) };
    BoxSplit::from_numbers([min.x, min.y, min.z, max.x, max.y, max.z])
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
