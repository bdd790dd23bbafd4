//! Input and output: `{1,2,7}`, as arrays have it.

use super::{StoredSet, within_bounds};
use crate::error::Refusal;
use crate::types::text::shortened;
use crate::types::{Raw, text_result, wire};
use engine::{FeatureSet, SetCollector};
use pgrx::{PgSqlErrorCode, pg_extern, pg_sys};
use std::ffi::{CStr, CString};
use std::fmt::Write;

#[pg_extern(immutable, strict, parallel_safe)]
fn feature_set_in(text: &CStr) -> Vec<u8> {
    let text = text.to_string_lossy();
    let inner = text
        .trim_matches(is_space)
        .strip_prefix('{')
        .and_then(|inner| inner.strip_suffix('}'))
        .unwrap_or_else(|| malformed(&text, "Expected numbers in braces, as in {1,2,7}."));
    let mut collector = SetCollector::default();
    if !inner.trim_matches(is_space).is_empty() {
        for word in inner.split(',') {
            within_bounds(collector.add(number(&text, word.trim_matches(is_space))));
        }
    }
    within_bounds(collector.set()).bytes().to_vec()
}

#[pg_extern(immutable, strict, parallel_safe)]
fn feature_set_out(set: StoredSet) -> CString {
    let mut text = String::from("{");
    for (i, number) in set.get().numbers().enumerate() {
        let comma = if i == 0 { "" } else { "," };
        // Writing to a String does not fail.
        let _ = write!(text, "{comma}{number}");
    }
    text.push('}');
    text_result(text)
}

#[pg_extern(immutable, strict, parallel_safe)]
fn feature_set_recv(message: Raw<pg_sys::StringInfoData>) -> Vec<u8> {
    let bytes = wire::rest(&message);
    if FeatureSet::read(bytes).is_err() {
        Refusal::new(
            PgSqlErrorCode::ERRCODE_INVALID_BINARY_REPRESENTATION,
            format!(
                "invalid binary value of type feature_set: {} bytes",
                bytes.len()
            ),
        )
        .detail("It must be in the one form that feature_set_send gives that set.")
        .raise();
    }
    bytes.to_vec()
}

/// White space as core's `isspace` has it.
fn is_space(letter: char) -> bool {
    letter.is_ascii_whitespace() || letter == '\x0b'
}

fn number(text: &str, word: &str) -> i64 {
    let digits = word.strip_prefix(['-', '+']).unwrap_or(word);
    if digits.is_empty() || !digits.bytes().all(|byte| byte.is_ascii_digit()) {
        malformed(text, &format!("\"{}\" is not a number.", shortened(word)));
    }
    word.parse().unwrap_or_else(|_| {
        Refusal::new(
            PgSqlErrorCode::ERRCODE_NUMERIC_VALUE_OUT_OF_RANGE,
            format!("number {} of feature_set is out of bounds", shortened(word)),
        )
        .detail(format!(
            "Numbers are between {} and {}.",
            i64::MIN,
            i64::MAX
        ))
        .raise()
    })
}

fn malformed(text: &str, detail: &str) -> ! {
    Refusal::new(
        PgSqlErrorCode::ERRCODE_INVALID_TEXT_REPRESENTATION,
        format!(
            "invalid input syntax for type feature_set: \"{}\"",
            shortened(text)
        ),
    )
    .detail(detail)
    .raise()
}

#[pg_extern(immutable, strict, parallel_safe)]
fn feature_set_send(set: StoredSet) -> Vec<u8> {
    set.get().bytes().to_vec()
}
