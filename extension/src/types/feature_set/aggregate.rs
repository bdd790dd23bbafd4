//! The aggregates, which collect numbers or sets into one set.

use super::{StoredSet, within_bounds};
use crate::error::Refusal;
use engine::{FeatureSet, SetCollector};
use pgrx::{Internal, PgMemoryContexts, PgSqlErrorCode, pg_extern, pg_sys};

#[pg_extern(immutable, parallel_safe)]
fn feature_set_collect_number(
    mut state: Internal,
    number: Option<i64>,
    fcinfo: pg_sys::FunctionCallInfo,
) -> Internal {
    if let Some(number) = number {
        within_bounds(collector(&mut state, fcinfo).add(number));
    }
    state
}

#[pg_extern(immutable, parallel_safe)]
fn feature_set_collect_set(
    mut state: Internal,
    set: Option<StoredSet>,
    fcinfo: pg_sys::FunctionCallInfo,
) -> Internal {
    if let Some(set) = set {
        within_bounds(collector(&mut state, fcinfo).add_set(set.get()));
    }
    state
}

#[pg_extern(immutable, parallel_safe)]
fn feature_set_collect_combine(
    mut state: Internal,
    mut other: Internal,
    fcinfo: pg_sys::FunctionCallInfo,
) -> Internal {
    if other.initialized() {
        let set = within_bounds(collector(&mut other, fcinfo).set());
        within_bounds(collector(&mut state, fcinfo).add_set(set));
    }
    state
}

/// The end of an aggregate, and how its state travels between workers: the set so far.
#[pg_extern(immutable, parallel_safe)]
fn feature_set_collected(mut state: Internal, fcinfo: pg_sys::FunctionCallInfo) -> Option<Vec<u8>> {
    if !state.initialized() {
        return None;
    }
    let set = within_bounds(collector(&mut state, fcinfo).set());
    Some(set.bytes().to_vec())
}

#[pg_extern(immutable, strict, parallel_safe)]
fn feature_set_collect_resume(
    bytes: &[u8],
    _context: Internal,
    fcinfo: pg_sys::FunctionCallInfo,
) -> Internal {
    let mut state = Internal::default();
    within_bounds(collector(&mut state, fcinfo).add_set(FeatureSet::trusted(bytes)));
    state
}

/// The collector of a state, made in the aggregate's memory if there is none yet.
fn collector(state: &mut Internal, fcinfo: pg_sys::FunctionCallInfo) -> &mut SetCollector {
    let mut memory = std::ptr::null_mut();
    // SAFETY: asks of a valid call; `memory` is written to when it is one of an aggregate.
    if unsafe { pg_sys::AggCheckCallContext(fcinfo, &mut memory) } == 0 {
        Refusal::new(
            PgSqlErrorCode::ERRCODE_FEATURE_NOT_SUPPORTED,
            "this function is part of an aggregate",
        )
        .hint("Call feature_set_agg or feature_set_union.")
        .raise();
    }
    // SAFETY: the memory of an aggregate outlives its states, which only these functions make; the
    // type `internal` keeps users from making one.
    unsafe {
        let mut context = PgMemoryContexts::For(memory);
        if !state.initialized() {
            let made = context.leak_and_drop_on_delete(SetCollector::default());
            *state = Internal::from(Some(pg_sys::Datum::from(made)));
        }
        match state.get_mut() {
            Some(collector) => collector,
            None => unreachable!("it has just been made"),
        }
    }
}
