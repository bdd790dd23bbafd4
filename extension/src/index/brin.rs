//! BRIN for `box3d`: core's inclusion class keeps a box around each range of blocks, and this
//! answers what such a box can hold. Core's own answer knows neither depth nor fields of view.

use super::query::Query;
use crate::direct_call::direct_function;
use crate::types::{Raw, read};
use engine::BoxRange;
use pgrx::pg_sys;

/// The beginning of core's `BrinValues`, which is the same in every version and which pgrx lacks.
#[repr(C)]
struct BrinValues {
    attribute: i16,
    has_nulls: bool,
    all_nulls: bool,
    values: *mut pg_sys::Datum,
}

/// Where core's inclusion class keeps the box around all.
const AROUND: usize = 0;

direct_function! {
    /// Whether a range of blocks may hold a row that satisfies a key. Core handles nulls before.
    fn box3d_brin_consistent(
        call: pg_sys::FunctionCallInfo,
        _index: Raw<u8>,
        range: Raw<BrinValues>,
        key: Raw<pg_sys::ScanKeyData>,
    ) -> bool {
        // SAFETY: BRIN passes the values of a range that holds some box, and a key whose argument is of
        // the type that the operator class gives its strategy. Boxes can always be merged, so that the
        // first value is the box around all.
        let (query, around) = unsafe {
            let key = &*key.as_ptr();
            let values = (*range.as_ptr()).values;
            (
                Query::of_type(key.sk_strategy, key.sk_subtype, key.sk_argument),
                read::<engine::Box3d>(*values.add(AROUND)),
            )
        };
        query.possible(call, &BoxRange::inside(&around))
    }
}
