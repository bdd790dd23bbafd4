//! The order in which a sorted build packs boxes onto pages: that of their centres on Hilbert's
//! curve, so that neighbours share a page (I. Kamel and C. Faloutsos, "On packing R-trees", 1993).

use super::query::read;
use crate::types::Raw;
use pgrx::{pg_extern, pg_sys};
use std::cmp::Ordering;
use std::ffi::c_int;

/// Tells a sort how to compare boxes: by the first 64 bits of the position on the curve, which are
/// computed once for each box, and only among equal ones by all of it.
#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_gist_sortsupport(sort: Raw<pg_sys::SortSupportData>) {
    // SAFETY: a sort passes its own state to fill.
    let sort = unsafe { &mut *sort.as_ptr() };
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
    _: pg_sys::SortSupport,
) -> pg_sys::Datum {
    // SAFETY: a sort of boxes passes boxes.
    let key = position(&unsafe { read::<engine::Box3d>(key) });
    let leading = (key >> 62) as u64;
    pg_sys::Datum::from(leading as usize)
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

unsafe extern "C-unwind" fn compare(
    a: pg_sys::Datum,
    b: pg_sys::Datum,
    _: pg_sys::SortSupport,
) -> c_int {
    // SAFETY: a sort of boxes passes boxes.
    let (a, b) = unsafe { (read::<engine::Box3d>(a), read::<engine::Box3d>(b)) };
    // Equal positions are common among boxes around one centre: those of one size stay together.
    let by_size = || {
        let (a, b) = (a.size().to_array(), b.size().to_array());
        a.partial_cmp(&b).unwrap_or(Ordering::Equal)
    };
    position(&a).cmp(&position(&b)).then_with(by_size) as c_int
}

fn position(key: &engine::Box3d) -> u128 {
    engine::hilbert_key(key.min * 0.5 + key.max * 0.5)
}
