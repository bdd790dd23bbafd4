//! Operators as relations between a box and a query.

use engine::BoxRelation;
use pgrx::pg_sys;
use std::ffi::CStr;

/// What an operator of ours asks; `None` for one that is not estimated.
pub fn relation_of(operator: pg_sys::Oid) -> Option<BoxRelation> {
    // SAFETY: the name, if the operator exists, is a palloc'd string.
    let name = unsafe {
        let name = pg_sys::get_opname(operator);
        if name.is_null() {
            return None;
        }
        CStr::from_ptr(name)
    };
    match name.to_bytes() {
        b"&&" => Some(BoxRelation::Overlaps),
        b"@>" => Some(BoxRelation::Contains),
        b"<@" => Some(BoxRelation::ContainedBy),
        b"<<" => Some(BoxRelation::Before(0)),
        b"&<" => Some(BoxRelation::NotAfter(0)),
        b"&>" => Some(BoxRelation::NotBefore(0)),
        b">>" => Some(BoxRelation::After(0)),
        b"<<|" => Some(BoxRelation::Before(1)),
        b"&<|" => Some(BoxRelation::NotAfter(1)),
        b"|&>" => Some(BoxRelation::NotBefore(1)),
        b"|>>" => Some(BoxRelation::After(1)),
        b"<</" => Some(BoxRelation::Before(2)),
        b"&</" => Some(BoxRelation::NotAfter(2)),
        b"/&>" => Some(BoxRelation::NotBefore(2)),
        b"/>>" => Some(BoxRelation::After(2)),
        _ => None,
    }
}

/// The share of rows when nothing is known: those of core's geometric types.
pub fn usual_share(relation: Option<BoxRelation>) -> f64 {
    match relation {
        Some(BoxRelation::Contains | BoxRelation::ContainedBy) => 0.001,
        Some(BoxRelation::Overlaps | BoxRelation::Equals) | None => 0.005,
        Some(_) => 0.1,
    }
}
