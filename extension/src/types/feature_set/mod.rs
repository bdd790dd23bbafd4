//! `feature_set`, a compressed set of numbers of features, of variable length. A value is the
//! encoded form of `engine::FeatureSet`, on the wire too.

mod aggregate;
mod array;
mod operators;
mod stored;
mod text;

pub use stored::StoredSet;

use crate::error::{Refusal, or_raise};
use engine::OversizedSet;
use pgrx::PgSqlErrorCode;

/// What was encoded, or the error that it is too much.
fn within_bounds<T>(set: Result<T, OversizedSet>) -> T {
    or_raise(set.map_err(|oversized| {
        Refusal::new(
            PgSqlErrorCode::ERRCODE_PROGRAM_LIMIT_EXCEEDED,
            "feature_set is too large",
        )
        .detail(format!("{}.", capitalized(&oversized.to_string())))
    }))
}

fn capitalized(sentence: &str) -> String {
    let mut letters = sentence.chars();
    let first = letters.next().map(|letter| letter.to_ascii_uppercase());
    first.into_iter().chain(letters).collect()
}
