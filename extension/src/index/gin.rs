//! GIN for `feature_set`: an entry for each number, so that "which sets hold this feature" is an
//! index scan.

use crate::types::{Raw, StoredSet};
use pgrx::{FromDatum, Internal, pg_extern, pg_sys};

/// Strategy numbers of `sql/15_feature_set.sql`.
mod strategy {
    pub const OVERLAPS: i16 = 1;
    pub const CONTAINS: i16 = 2;
    pub const CONTAINED_BY: i16 = 3;
    pub const EQUALS: i16 = 4;
    pub const CONTAINS_NUMBER: i16 = 5;
}

/// The keys of a row: the numbers of its set.
#[pg_extern(immutable, strict, parallel_safe)]
fn feature_set_gin_extract_value(set: StoredSet, count: Raw<i32>) -> Internal {
    let numbers: Vec<i64> = set.get().numbers().collect();
    // SAFETY: GIN passes a place for the count.
    unsafe { keys(&numbers, count.as_ptr()) }
}

/// The keys of a query.
#[pg_extern(immutable, strict, parallel_safe)]
fn feature_set_gin_extract_query(fcinfo: pg_sys::FunctionCallInfo) -> Internal {
    let strategy = argument(fcinfo, 2).value() as i16;
    let numbers = match strategy {
        strategy::CONTAINS_NUMBER => vec![argument(fcinfo, 0).value().cast_signed() as i64],
        // SAFETY: every other strategy has a set on its right, which is not null.
        _ => match unsafe { StoredSet::from_datum(argument(fcinfo, 0), false) } {
            Some(set) => set.get().numbers().collect(),
            None => Vec::new(),
        },
    };
    let mode = match strategy {
        strategy::CONTAINS if numbers.is_empty() => pg_sys::GIN_SEARCH_MODE_ALL,
        strategy::EQUALS if numbers.is_empty() => pg_sys::GIN_SEARCH_MODE_INCLUDE_EMPTY,
        strategy::CONTAINED_BY => pg_sys::GIN_SEARCH_MODE_INCLUDE_EMPTY,
        _ => pg_sys::GIN_SEARCH_MODE_DEFAULT,
    };
    // SAFETY: GIN passes places for the mode and for the count.
    unsafe {
        let place = argument(fcinfo, 6).cast_mut_ptr::<i32>();
        place.write(mode.cast_signed());
        keys(&numbers, argument(fcinfo, 1).cast_mut_ptr())
    }
}

/// Whether a row with some of the keys is an answer; where it may be, it is checked again.
#[pg_extern(immutable, strict, parallel_safe)]
fn feature_set_gin_consistent(fcinfo: pg_sys::FunctionCallInfo) -> bool {
    let answer = answer(fcinfo);
    // SAFETY: GIN passes a place for this.
    unsafe {
        let recheck = argument(fcinfo, 5).cast_mut_ptr::<bool>();
        recheck.write(answer == MAYBE);
    }
    answer != NO
}

/// The same when it is not known of all keys whether the row has them.
#[pg_extern(immutable, strict, parallel_safe)]
fn feature_set_gin_triconsistent(fcinfo: pg_sys::FunctionCallInfo) -> i8 {
    answer(fcinfo)
}

/// GIN's three answers.
const NO: i8 = 0;
/// See [`NO`].
const YES: i8 = 1;
/// See [`NO`].
const MAYBE: i8 = 2;

fn answer(fcinfo: pg_sys::FunctionCallInfo) -> i8 {
    // SAFETY: GIN passes an array of answers, one a key, and the number of keys.
    let keys = unsafe {
        let count = argument(fcinfo, 3).value();
        std::slice::from_raw_parts(argument(fcinfo, 0).cast_mut_ptr::<i8>(), count)
    };
    let all = || match (keys.contains(&NO), keys.contains(&MAYBE)) {
        (true, _) => NO,
        (false, true) => MAYBE,
        (false, false) => YES,
    };
    let any = || match (keys.contains(&YES), keys.contains(&MAYBE)) {
        (true, _) => YES,
        (false, true) => MAYBE,
        (false, false) => NO,
    };
    match argument(fcinfo, 1).value() as i16 {
        strategy::OVERLAPS => any(),
        strategy::CONTAINS | strategy::CONTAINS_NUMBER => all(),
        // The row may have other keys.
        strategy::EQUALS if all() == NO => NO,
        strategy::EQUALS | strategy::CONTAINED_BY => MAYBE,
        other => unknown(other),
    }
}

/// An argument of a GIN support function: a number may be 0, and a pointer that is not used null,
/// so neither has a type that would refuse it.
fn argument(fcinfo: pg_sys::FunctionCallInfo, position: usize) -> pg_sys::Datum {
    // SAFETY: GIN passes all arguments that its documentation lists; only those are asked for.
    unsafe { pgrx::fcinfo::pg_getarg_datum_raw(fcinfo, position) }
}

/// An array of keys for GIN, and their number.
///
/// # Safety
/// There must be a place for the count.
unsafe fn keys(numbers: &[i64], count: *mut i32) -> Internal {
    // SAFETY: the array is as long as the numbers and outlives the call in its memory context.
    unsafe {
        count.write(i32::try_from(numbers.len()).unwrap_or(i32::MAX));
        let keys = pg_sys::palloc(size_of_val(numbers)).cast::<pg_sys::Datum>();
        for (i, &number) in numbers.iter().enumerate() {
            keys.add(i).write(pg_sys::Datum::from(number));
        }
        Internal::from(Some(pg_sys::Datum::from(keys)))
    }
}

fn unknown(strategy: i16) -> ! {
    crate::error::Refusal::new(
        pgrx::PgSqlErrorCode::ERRCODE_INTERNAL_ERROR,
        format!("unknown strategy number {strategy} for feature_set"),
    )
    .raise()
}
