//! GiST for `box3d`: Guttman's R-tree with the keys as they are, so that a scan needs no recheck
//! and may be index-only.

use super::split::split;
use crate::types::{Box3d, Point3d, Raw, ViewCone, ViewSector};
use pgrx::{Internal, pg_extern, pg_sys};

/// Strategy numbers of `sql/30_gist.sql`.
mod strategy {
    pub const OVERLAPS: i16 = 3;
    pub const SAME: i16 = 6;
    pub const CONTAINS: i16 = 7;
    pub const CONTAINED_BY: i16 = 8;
    pub const EQUALS: i16 = 18;
    pub const DISTANCE_TO_POINT: i16 = 25;
    pub const CONTAINS_POINT: i16 = 27;
    pub const MEETS_CONE: i16 = 33;
    pub const MEETS_SECTOR: i16 = 43;
}

/// Whether a subtree (or, at a leaf, a row) can satisfy the query; exact in every case.
///
/// The query's SQL type follows from the strategy, so it comes as a bare pointer.
#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_gist_consistent(
    entry: Raw<pg_sys::GISTENTRY>,
    query: Raw<u8>,
    strategy: i16,
    _subtype: pg_sys::Oid,
    recheck: Raw<bool>,
) -> bool {
    // SAFETY: GiST passes an entry of ours and a place for the answer.
    let (key, leaf) = unsafe {
        recheck.as_ptr().write(false);
        let entry = &*entry.as_ptr();
        (key(entry), is_leaf(entry.page))
    };
    match strategy {
        strategy::OVERLAPS => key.overlaps(&argument::<Box3d>(&query).0),
        strategy::SAME | strategy::EQUALS if leaf => key == argument::<Box3d>(&query).0,
        strategy::SAME | strategy::EQUALS | strategy::CONTAINS => {
            key.contains(&argument::<Box3d>(&query).0)
        }
        strategy::CONTAINED_BY if leaf => argument::<Box3d>(&query).0.contains(&key),
        strategy::CONTAINED_BY => key.overlaps(&argument::<Box3d>(&query).0),
        strategy::CONTAINS_POINT => key.contains_point(argument::<Point3d>(&query).0),
        strategy::MEETS_CONE => argument::<ViewCone>(&query).in_radians().meets(&key),
        strategy::MEETS_SECTOR => argument::<ViewSector>(&query).in_radians().meets(&key),
        other => unknown(other),
    }
}

/// The distance of a key from the query, for scans that return the nearest first.
#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_gist_distance(
    entry: Raw<pg_sys::GISTENTRY>,
    query: Raw<u8>,
    strategy: i16,
    _subtype: pg_sys::Oid,
    recheck: Raw<bool>,
) -> f64 {
    // SAFETY: GiST passes an entry of ours and a place for the answer.
    let key = unsafe {
        recheck.as_ptr().write(false);
        key(&*entry.as_ptr())
    };
    match strategy {
        strategy::DISTANCE_TO_POINT => key.distance_to_point(argument::<Point3d>(&query).0),
        _ => key.distance(&argument::<Box3d>(&query).0),
    }
}

/// The smallest box around all entries.
#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_gist_union(entries: Raw<pg_sys::GistEntryVector>, _size: Raw<i32>) -> Box3d {
    let keys = keys(&entries, 0);
    Box3d(around(&keys))
}

/// How much worse a subtree gets by taking an entry: growth in volume, and, where that is
/// nothing (all boxes flat), in margin.
#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_gist_penalty(
    original: Raw<pg_sys::GISTENTRY>,
    added: Raw<pg_sys::GISTENTRY>,
    penalty: Raw<f32>,
) -> Internal {
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
        Internal::from(Some(pg_sys::Datum::from(penalty.as_ptr())))
    }
}

/// Divides the entries of a full page in two.
#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_gist_picksplit(
    entries: Raw<pg_sys::GistEntryVector>,
    result: Raw<pg_sys::GIST_SPLITVEC>,
) -> Internal {
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
        Internal::from(Some(pg_sys::Datum::from(result_ptr)))
    }
}

/// Whether two keys are equal.
#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_gist_same(a: Box3d, b: Box3d, result: Raw<bool>) -> Internal {
    // SAFETY: GiST passes a place for the answer.
    unsafe { result.as_ptr().write(a.0 == b.0) };
    Internal::from(Some(pg_sys::Datum::from(result.as_ptr())))
}

/// The value of a key: the key itself.
#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_gist_fetch(entry: Raw<pg_sys::GISTENTRY>) -> Internal {
    Internal::from(Some(pg_sys::Datum::from(entry.as_ptr())))
}

/// The box of an entry.
///
/// # Safety
/// The entry's key must be a datum of type `box3d`.
unsafe fn key(entry: &pg_sys::GISTENTRY) -> engine::Box3d {
    // SAFETY: such a datum points to the box.
    unsafe { entry.key.cast_mut_ptr::<engine::Box3d>().read() }
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

/// The query as the type that its strategy implies.
fn argument<T: Copy>(query: &Raw<u8>) -> T {
    // SAFETY: the operator class ties each strategy to one type, all passed by reference.
    unsafe { query.as_ptr().cast::<T>().read() }
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

fn unknown(strategy: i16) -> ! {
    crate::error::Refusal::new(
        pgrx::PgSqlErrorCode::ERRCODE_INTERNAL_ERROR,
        format!("unknown strategy number {strategy} for box3d"),
    )
    .raise()
}
