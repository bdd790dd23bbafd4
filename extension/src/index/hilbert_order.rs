//! The order in which a sorted build packs boxes onto pages: that of their centres on Hilbert's
//! curve in plan, so that neighbours share a page (I. Kamel and C. Faloutsos, "On packing R-trees",
//! 1993).

use crate::types::{Box3d, Raw, read};
use glam::DVec3;
use pgrx::{pg_extern, pg_sys};
use std::cmp::Ordering;
use std::ffi::c_int;

/// Tells a sort how to compare boxes: by a position on a curve around the first of them, which is
/// computed once for each box, and only among equal ones by more.
#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_gist_sortsupport(sort: Raw<pg_sys::SortSupportData>) {
    // SAFETY: a sort passes its own state to fill; `ssup_extra` is ours to use, and lives in its
    // memory context.
    let sort = unsafe {
        let sort = &mut *sort.as_ptr();
        let origin = pg_sys::MemoryContextAlloc(sort.ssup_cxt, size_of::<Option<DVec3>>());
        origin.cast::<Option<DVec3>>().write(None);
        sort.ssup_extra = origin;
        sort
    };
    if sort.abbreviate {
        sort.comparator = Some(compare_abbreviated);
        sort.abbrev_converter = Some(abbreviate);
        sort.abbrev_abort = Some(never_abort);
        sort.abbrev_full_comparator = Some(compare);
    } else {
        sort.comparator = Some(compare);
    }
}

unsafe extern "C-unwind" fn abbreviate(
    key: pg_sys::Datum,
    sort: pg_sys::SortSupport,
) -> pg_sys::Datum {
    // SAFETY: a sort of boxes passes boxes, and the state that was filled above.
    let position = unsafe { position(&center(key), sort) };
    pg_sys::Datum::from(position as usize)
}

unsafe extern "C-unwind" fn compare_abbreviated(
    a: pg_sys::Datum,
    b: pg_sys::Datum,
    _: pg_sys::SortSupport,
) -> c_int {
    a.value().cmp(&b.value()) as c_int
}

unsafe extern "C-unwind" fn never_abort(_: c_int, _: pg_sys::SortSupport) -> bool {
    false
}

/// Boxes around one centre, which are common, are ordered by size: those of one size stay together.
unsafe extern "C-unwind" fn compare(
    a: pg_sys::Datum,
    b: pg_sys::Datum,
    sort: pg_sys::SortSupport,
) -> c_int {
    // SAFETY: a sort of boxes passes boxes, and the state that was filled above.
    unsafe {
        let (p, q) = (center(a), center(b));
        let coarse = position(&p, sort).cmp(&position(&q, sort));
        let fine = || {
            if p == q {
                Ordering::Equal
            } else {
                engine::hilbert_key(p).cmp(&engine::hilbert_key(q))
            }
        };
        let by_size = || {
            let [a, b] = [a, b].map(|key| read::<Box3d>(key).0.size().to_array());
            a.partial_cmp(&b).unwrap_or(Ordering::Equal)
        };
        coarse.then_with(fine).then_with(by_size) as c_int
    }
}

/// The middle of a box.
///
/// # Safety
/// The datum must be one.
unsafe fn center(key: pg_sys::Datum) -> DVec3 {
    // SAFETY: as the caller says.
    unsafe { read::<Box3d>(key) }.center()
}

/// The position of a point on the curve around the first point of the sort.
///
/// # Safety
/// The sort must be one that `box3d_gist_sortsupport` has filled.
unsafe fn position(point: &DVec3, sort: pg_sys::SortSupport) -> u64 {
    // SAFETY: as the caller says.
    let origin = unsafe { &mut *(*sort).ssup_extra.cast::<Option<DVec3>>() };
    engine::plan_key(*point - *origin.get_or_insert(*point))
}
