//! Operators as relations between a box and a query.

use engine::Relation;
use pgrx::pg_sys;
use std::ffi::CStr;

/// What an operator of ours asks; `None` for one that is not estimated.
pub fn relation_of(operator: pg_sys::Oid) -> Option<Relation> {
    // SAFETY: the name, if the operator exists, is a palloc'd string.
    let name = unsafe {
        let name = pg_sys::get_opname(operator);
        if name.is_null() {
            return None;
        }
        CStr::from_ptr(name)
    };
    match name.to_bytes() {
        b"&&" => Some(Relation::Overlaps),
        b"@>" => Some(Relation::Contains),
        b"<@" => Some(Relation::ContainedBy),
        _ => None,
    }
}

/// The share of rows when nothing is known: those of core's geometric types.
pub fn usual_share(relation: Option<Relation>) -> f64 {
    match relation {
        Some(Relation::Contains | Relation::ContainedBy) => 0.001,
        Some(Relation::Overlaps) | None => 0.005,
    }
}
