//! Operators and functions on sets. Equality and hashes are core's, of the bytes.

use super::{StoredSet, within_bounds};
use pgrx::iter::SetOfIterator;
use pgrx::{pg_extern, pg_sys};

/// Bytes that hold the count at the beginning of a set: at most 2^26.
const COUNT_BYTES: i32 = 4;

#[pg_extern(immutable, strict, parallel_safe)]
fn feature_set_union(a: StoredSet, b: StoredSet) -> Vec<u8> {
    within_bounds(a.get().union(b.get()))
}

#[pg_extern(immutable, strict, parallel_safe)]
fn feature_set_intersection(a: StoredSet, b: StoredSet) -> Vec<u8> {
    within_bounds(a.get().intersection(b.get()))
}

#[pg_extern(immutable, strict, parallel_safe)]
fn feature_set_difference(a: StoredSet, b: StoredSet) -> Vec<u8> {
    within_bounds(a.get().difference(b.get()))
}

#[pg_extern(immutable, strict, parallel_safe)]
fn feature_set_contains(a: StoredSet, b: StoredSet) -> bool {
    a.get().contains(b.get())
}

#[pg_extern(immutable, strict, parallel_safe)]
fn feature_set_contained_by(a: StoredSet, b: StoredSet) -> bool {
    b.get().contains(a.get())
}

#[pg_extern(immutable, strict, parallel_safe)]
fn feature_set_contains_number(set: StoredSet, number: i64) -> bool {
    set.get().contains_number(number)
}

#[pg_extern(immutable, strict, parallel_safe)]
fn feature_set_number_contained_by(number: i64, set: StoredSet) -> bool {
    set.get().contains_number(number)
}

#[pg_extern(immutable, strict, parallel_safe)]
fn feature_set_overlaps(a: StoredSet, b: StoredSet) -> bool {
    a.get().overlaps(b.get())
}

#[pg_extern(immutable, strict, parallel_safe)]
fn feature_set_compare(a: StoredSet, b: StoredSet) -> i32 {
    a.get().cmp(&b.get()) as i32
}

#[pg_extern(immutable, strict, parallel_safe)]
fn feature_set_less(a: StoredSet, b: StoredSet) -> bool {
    a.get() < b.get()
}

#[pg_extern(immutable, strict, parallel_safe)]
fn feature_set_less_or_equal(a: StoredSet, b: StoredSet) -> bool {
    a.get() <= b.get()
}

#[pg_extern(immutable, strict, parallel_safe)]
fn feature_set_greater(a: StoredSet, b: StoredSet) -> bool {
    a.get() > b.get()
}

#[pg_extern(immutable, strict, parallel_safe)]
fn feature_set_greater_or_equal(a: StoredSet, b: StoredSet) -> bool {
    a.get() >= b.get()
}

#[pg_extern(immutable, strict, parallel_safe)]
fn feature_set_cardinality(fcinfo: pg_sys::FunctionCallInfo) -> i64 {
    // SAFETY: the function is strict and has one argument, a set.
    let datum = unsafe { pgrx::fcinfo::pg_getarg_datum_raw(fcinfo, 0) };
    let count = StoredSet::beginning(datum, COUNT_BYTES).get().cardinality();
    count.cast_signed()
}

#[pg_extern(immutable, strict, parallel_safe)]
fn feature_set_least(set: StoredSet) -> Option<i64> {
    set.get().least()
}

#[pg_extern(immutable, strict, parallel_safe)]
fn feature_set_greatest(set: StoredSet) -> Option<i64> {
    set.get().greatest()
}

#[pg_extern(immutable, strict, parallel_safe)]
fn feature_set_unnest(set: StoredSet) -> SetOfIterator<'static, i64> {
    SetOfIterator::new(set.get().numbers().collect::<Vec<i64>>())
}
