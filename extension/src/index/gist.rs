//! GiST for `box3d`: Guttman's R-tree with the keys as they are, so that a scan needs no recheck
//! and may be index-only.

use super::query::{Nearest, Query};
use super::split::split;
use crate::direct_call::direct_function;
use crate::types::{Box3d, Raw, read};
use engine::BoxRange;
use pgrx::pg_sys;

direct_function! {
    unguarded
    /// Whether a subtree (or, at a leaf, a row) can satisfy the query; exact in every case.
    ///
    /// The query's SQL type follows from the strategy, so it comes as a bare pointer.
    fn box3d_gist_consistent(
        call: pg_sys::FunctionCallInfo,
        entry: Raw<pg_sys::GISTENTRY>,
        query: Raw<u8>,
        strategy: i16,
        _subtype: pg_sys::Oid,
        recheck: Raw<bool>,
    ) -> bool {
        // SAFETY: GiST passes an entry of ours, a place for the answer, and an argument of the type
        // that the operator class gives the strategy.
        let (key, leaf, query) = unsafe {
            recheck.as_ptr().write(false);
            let entry = &*entry.as_ptr();
            let query = Query::of(strategy.cast_unsigned(), query.as_ptr().into());
            (key(entry), is_leaf(entry.page), query)
        };
        if leaf {
            query.holds(call, &key)
        } else {
            query.possible(call, &BoxRange::inside(&key))
        }
    }
}

direct_function! {
    unguarded
    /// The distance of a key from the query, for scans that return the nearest first.
    fn box3d_gist_distance(
        entry: Raw<pg_sys::GISTENTRY>,
        query: Raw<u8>,
        strategy: i16,
        _subtype: pg_sys::Oid,
        recheck: Raw<bool>,
    ) -> f64 {
        // SAFETY: as for box3d_gist_consistent.
        unsafe {
            recheck.as_ptr().write(false);
            let nearest = Nearest::of(strategy.cast_unsigned(), query.as_ptr().into());
            nearest.distance(&key(&*entry.as_ptr()))
        }
    }
}

direct_function! {
    /// The smallest box around all entries.
    fn box3d_gist_union(entries: Raw<pg_sys::GistEntryVector>, _size: Raw<i32>) -> Box3d {
        let keys = keys(&entries, 0);
        Box3d(around(&keys))
    }
}

direct_function! {
    /// How much worse a subtree gets by taking an entry: growth in volume, and, where that is
    /// nothing (all boxes flat), in margin.
    fn box3d_gist_penalty(
        original: Raw<pg_sys::GISTENTRY>,
        added: Raw<pg_sys::GISTENTRY>,
        penalty: Raw<f32>,
    ) -> *mut f32 {
        // SAFETY: GiST passes two entries of ours and a place for the answer.
        unsafe {
            let (original, added) = (key(&*original.as_ptr()), key(&*added.as_ptr()));
            let grown = original.union(&added);
            let by_volume = grown.volume() - original.volume();
            let growth = if by_volume > 0.0 {
                by_volume
            } else {
                (grown.margin() - original.margin()) * 1e-6
            };
            penalty.as_ptr().write(growth as f32);
        }
        penalty.as_ptr()
    }
}

direct_function! {
    /// Divides the entries of a full page in two.
    fn box3d_gist_picksplit(
        entries: Raw<pg_sys::GistEntryVector>,
        result: Raw<pg_sys::GIST_SPLITVEC>,
    ) -> *mut pg_sys::GIST_SPLITVEC {
        // Offsets count from 1: slot 0 is unused.
        let keys = keys(&entries, 1);
        let halves = split(&keys);
        // SAFETY: GiST passes a GIST_SPLITVEC to fill; the arrays are palloc'd, large enough and
        // outlive the call in its memory context.
        unsafe {
            let result_ptr = result.as_ptr();
            (*result_ptr).spl_left = offsets(&halves[0]);
            (*result_ptr).spl_nleft = count(&halves[0]);
            (*result_ptr).spl_ldatum = boxed(&keys, &halves[0]);
            (*result_ptr).spl_right = offsets(&halves[1]);
            (*result_ptr).spl_nright = count(&halves[1]);
            (*result_ptr).spl_rdatum = boxed(&keys, &halves[1]);
        }
        result.as_ptr()
    }
}

direct_function! {
    /// Whether two keys are equal.
    fn box3d_gist_same(a: Box3d, b: Box3d, result: Raw<bool>) -> *mut bool {
        // SAFETY: GiST passes a place for the answer.
        unsafe { result.as_ptr().write(a.0 == b.0) };
        result.as_ptr()
    }
}

direct_function! {
    /// The value of a key: the key itself.
    fn box3d_gist_fetch(entry: Raw<pg_sys::GISTENTRY>) -> *mut pg_sys::GISTENTRY {
        entry.as_ptr()
    }
}

/// The box of an entry.
///
/// # Safety
/// The entry's key must be a datum of type `box3d`.
unsafe fn key(entry: &pg_sys::GISTENTRY) -> engine::Box3d {
    // SAFETY: as the caller says.
    unsafe { read(entry.key) }
}

/// Whether a page of the index is a leaf.
///
/// # Safety
/// The page must be one of a GiST index.
unsafe fn is_leaf(page: pg_sys::Page) -> bool {
    // SAFETY: such pages end in GiST's own data.
    let opaque =
        unsafe { &*pg_sys::PageGetSpecialPointer(page).cast::<pg_sys::GISTPageOpaqueData>() };
    u32::from(opaque.flags) & pg_sys::F_LEAF != 0
}

/// The boxes of a vector of entries, from slot `first` on.
fn keys(entries: &Raw<pg_sys::GistEntryVector>, first: usize) -> Vec<engine::Box3d> {
    // SAFETY: GiST passes a vector of `n` entries whose keys are of our type.
    unsafe {
        let vector = &*entries.as_ptr();
        let slots = vector
            .vector
            .as_slice(usize::try_from(vector.n).unwrap_or(0));
        slots[first..].iter().map(|entry| key(entry)).collect()
    }
}

/// The box around some boxes.
fn around(keys: &[engine::Box3d]) -> engine::Box3d {
    keys.iter()
        .copied()
        .reduce(|a, b| a.union(&b))
        .unwrap_or_else(|| unreachable!("no entries"))
}

/// Positions as page offsets, in memory of the current context.
///
/// # Safety
/// Must run in a memory context that outlives the use of the result.
unsafe fn offsets(positions: &[usize]) -> *mut pg_sys::OffsetNumber {
    // SAFETY: allocates room for each offset, and writes no more than that.
    unsafe {
        let room = pg_sys::palloc(size_of::<pg_sys::OffsetNumber>() * (positions.len() + 1))
            .cast::<pg_sys::OffsetNumber>();
        for (slot, position) in positions.iter().enumerate() {
            room.add(slot)
                .write(u16::try_from(position + 1).unwrap_or(u16::MAX));
        }
        room
    }
}

fn count(positions: &[usize]) -> i32 {
    i32::try_from(positions.len()).unwrap_or(i32::MAX)
}

/// The box around some of the keys, as a datum in memory of the current context.
///
/// # Safety
/// Must run in a memory context that outlives the use of the result.
unsafe fn boxed(keys: &[engine::Box3d], positions: &[usize]) -> pg_sys::Datum {
    let chosen: Vec<engine::Box3d> = positions.iter().map(|&p| keys[p]).collect();
    // SAFETY: allocates room for one box and writes it.
    unsafe {
        let room = pg_sys::palloc(size_of::<engine::Box3d>()).cast::<engine::Box3d>();
        room.write(around(&chosen));
        pg_sys::Datum::from(room)
    }
}
