//! Casts from and to `bigint[]`. They keep the numbers as they are: a value knows of no scene.

use super::{StoredSet, within_bounds};
use crate::error::Refusal;
use engine::SetCollector;
use pgrx::{Array, PgSqlErrorCode, pg_extern};

#[pg_extern(immutable, strict, parallel_safe)]
fn feature_set_from_array(numbers: Array<i64>) -> Vec<u8> {
    let mut collector = SetCollector::default();
    for number in numbers.iter() {
        match number {
            Some(number) => within_bounds(collector.add(number)),
            None => refuse_null(),
        }
    }
    within_bounds(collector.set()).bytes().to_vec()
}

#[pg_extern(immutable, strict, parallel_safe)]
fn feature_set_to_array(set: StoredSet) -> Vec<i64> {
    set.get().numbers().collect()
}

fn refuse_null() -> ! {
    Refusal::new(
        PgSqlErrorCode::ERRCODE_NULL_VALUE_NOT_ALLOWED,
        "feature_set must not contain nulls",
    )
    .hint("array_remove(numbers, NULL) leaves them out.")
    .raise()
}
