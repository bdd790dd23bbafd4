//! [`FeatureSet`], a set in its encoded form.

use super::MOST_IN_SET;
use super::word::Word;
use super::words::{Words, varint};
use super::writer::Writer;

/// A set of numbers, read from its encoded form as it is needed.
#[derive(Clone, Copy, Debug)]
pub struct FeatureSet<'a> {
    bytes: &'a [u8],
    count: u64,
    words: &'a [u8],
}

/// Bytes that are not the form of any set.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("not the one form of a set")]
pub struct MalformedSet;

impl<'a> FeatureSet<'a> {
    /// The set of bytes that were encoded here. Others give some set or other, never a panic.
    #[must_use]
    pub fn trusted(bytes: &'a [u8]) -> Self {
        let mut words = bytes;
        let count = varint(&mut words).unwrap_or(0);
        Self {
            bytes,
            count,
            words,
        }
    }

    /// The set of bytes from anywhere: they must be as the set would be encoded here.
    pub fn read(bytes: &'a [u8]) -> Result<Self, MalformedSet> {
        let set = Self::trusted(bytes);
        if set.count > MOST_IN_SET {
            return Err(MalformedSet);
        }
        let mut again = Writer::default();
        let mut left = set.count;
        let mut last = i64::MIN;
        for word in set.words() {
            let count = u64::from(word.bits.count_ones());
            let ascends = last < word.index && word.bits != 0;
            if !ascends || !Word::INDICES.contains(&word.index) || count > left {
                return Err(MalformedSet);
            }
            left -= count;
            last = word.index;
            again.push(word);
        }
        match again.finish() {
            Ok(form) if form == bytes => Ok(set),
            _ => Err(MalformedSet),
        }
    }

    /// The encoded form.
    #[must_use]
    pub fn bytes(&self) -> &'a [u8] {
        self.bytes
    }

    /// How many numbers it has.
    #[must_use]
    pub fn cardinality(&self) -> u64 {
        self.count
    }

    /// Its numbers, ascending.
    pub fn numbers(&self) -> impl Iterator<Item = i64> + use<'a> {
        self.words().flat_map(Word::numbers)
    }

    /// The least number.
    #[must_use]
    pub fn least(&self) -> Option<i64> {
        self.numbers().next()
    }

    /// The greatest number.
    #[must_use]
    pub fn greatest(&self) -> Option<i64> {
        self.words().last()?.numbers().last()
    }

    pub(super) fn words(&self) -> Words<'a> {
        Words::new(self.words)
    }
}
