//! Compressed sets of numbers: the features that can be seen from somewhere.
//!
//! **The form.** Numbers are cut into words of 64: the number `n` is bit `n mod 64` of word
//! `n div 64`, both floored. A set is the count of its numbers as a varint, then its words that are
//! not empty, in ascending order. A word begins with a varint: how many empty words precede it (for
//! the first: its index, zigzag), times four, plus how the word is written:
//!
//! | way | follows |
//! | --- | --- |
//! | 0, listed | ascending runs, a byte for a single number and two for a longer run |
//! | 1, octets | a byte that tells which of its 8 octets are not empty, then those |
//! | 2, full | a varint: how many more full words come straight after this one |
//! | 3, whole | its 8 bytes, the least significant first |
//!
//! The shortest way is taken, of equal ones the first. So a set has exactly one form, and sets are
//! equal when their bytes are. Neighbours share the gap that leads to their word: in a thick set a
//! number takes 2 to 3 bits, alone it takes as many bytes as a delta-varint or one more.

mod algebra;
mod bytes;
mod collector;
mod order;
mod word;
mod words;
mod writer;

pub use bytes::{FeatureSet, MalformedSet};
pub use collector::SetCollector;
pub use writer::OversizedSet;

/// Most numbers of a set, so that all of them fit an array of half a gigabyte, and a few bytes that
/// claim an endless run are refused.
pub const MOST_IN_SET: u64 = 1 << 26;
