//! What SP-GiST passes to an operator class: `access/spgist.h`, the same in PostgreSQL 14 to 18,
//! which pgrx lacks.

use pgrx::pg_sys::{Datum, MemoryContext, Oid, ScanKeyData};
use std::ffi::{c_int, c_void};

/// `spgMatchNode`: descend into a child that is there.
pub const SPG_MATCH_NODE: c_int = 1;

/// `spgConfigOut`.
#[repr(C)]
pub struct SpgConfigOut {
    pub prefix_type: Oid,
    pub label_type: Oid,
    pub leaf_type: Oid,
    pub can_return_data: bool,
    pub long_values_ok: bool,
}

/// `spgChooseIn`.
#[repr(C)]
pub struct SpgChooseIn {
    pub datum: Datum,
    pub leaf: Datum,
    pub level: c_int,
    pub all_the_same: bool,
    pub has_prefix: bool,
    pub prefix: Datum,
    pub node_count: c_int,
    pub node_labels: *mut Datum,
}

/// `spgChooseOut` for [`SPG_MATCH_NODE`]; its other results are longer, and not used.
#[repr(C)]
pub struct SpgChooseOut {
    pub result_type: c_int,
    pub match_node: SpgMatchNode,
}

/// The child to descend into.
#[repr(C)]
pub struct SpgMatchNode {
    pub node: c_int,
    pub level_add: c_int,
    pub rest: Datum,
}

/// `spgPickSplitIn`.
#[repr(C)]
pub struct SpgPickSplitIn {
    pub count: c_int,
    pub datums: *mut Datum,
    pub level: c_int,
}

/// `spgPickSplitOut`.
#[repr(C)]
pub struct SpgPickSplitOut {
    pub has_prefix: bool,
    pub prefix: Datum,
    pub node_count: c_int,
    pub node_labels: *mut Datum,
    pub nodes: *mut c_int,
    pub leaves: *mut Datum,
}

/// `spgInnerConsistentIn`; the traversal value is the cell of the boxes below.
#[repr(C)]
pub struct SpgInnerConsistentIn {
    pub keys: *mut ScanKeyData,
    pub orders: *mut ScanKeyData,
    pub key_count: c_int,
    pub order_count: c_int,
    pub reconstructed: Datum,
    pub cell: *mut c_void,
    pub cell_context: MemoryContext,
    pub level: c_int,
    pub return_data: bool,
    pub all_the_same: bool,
    pub has_prefix: bool,
    pub prefix: Datum,
    pub node_count: c_int,
    pub node_labels: *mut Datum,
}

/// `spgInnerConsistentOut`.
#[repr(C)]
pub struct SpgInnerConsistentOut {
    pub node_count: c_int,
    pub nodes: *mut c_int,
    pub level_adds: *mut c_int,
    pub reconstructed: *mut Datum,
    pub cells: *mut *mut c_void,
    pub distances: *mut *mut f64,
}

/// `spgLeafConsistentIn`.
#[repr(C)]
pub struct SpgLeafConsistentIn {
    pub keys: *mut ScanKeyData,
    pub orders: *mut ScanKeyData,
    pub key_count: c_int,
    pub order_count: c_int,
    pub reconstructed: Datum,
    pub cell: *mut c_void,
    pub level: c_int,
    pub return_data: bool,
    pub leaf: Datum,
}

/// `spgLeafConsistentOut`.
#[repr(C)]
pub struct SpgLeafConsistentOut {
    pub value: Datum,
    pub recheck: bool,
    pub recheck_distances: bool,
    pub distances: *mut f64,
}
