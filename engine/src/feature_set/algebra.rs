//! Sets made of two sets, and what they have in common: one pass over both, word by word.

use super::bytes::FeatureSet;
use super::word::Word;
use super::words::Words;
use super::writer::{OversizedSet, Writer};

impl FeatureSet<'_> {
    /// What is in either, encoded.
    pub fn union(self, other: FeatureSet) -> Result<Vec<u8>, OversizedSet> {
        self.merged(other, |a, b| a | b)
    }

    /// What is in both, encoded.
    pub fn intersection(self, other: FeatureSet) -> Result<Vec<u8>, OversizedSet> {
        self.merged(other, |a, b| a & b)
    }

    /// What is in this one and not in the other, encoded.
    pub fn difference(self, other: FeatureSet) -> Result<Vec<u8>, OversizedSet> {
        self.merged(other, |a, b| a & !b)
    }

    /// Whether all of the other is in this one.
    #[must_use]
    pub fn contains(self, other: FeatureSet) -> bool {
        other.cardinality() <= self.cardinality()
            && Pairs::new(self, other).all(|pair| pair.b & !pair.a == 0)
    }

    /// Whether the number is in this set.
    #[must_use]
    pub fn contains_number(self, number: i64) -> bool {
        let wanted = Word::of(number);
        self.words()
            .find(|word| word.index >= wanted.index)
            .is_some_and(|word| word.index == wanted.index && word.bits & wanted.bits != 0)
    }

    /// Whether a number is in both.
    #[must_use]
    pub fn overlaps(self, other: FeatureSet) -> bool {
        Pairs::new(self, other).any(|pair| pair.a & pair.b != 0)
    }

    fn merged(
        self,
        other: FeatureSet,
        bits: impl Fn(u64, u64) -> u64,
    ) -> Result<Vec<u8>, OversizedSet> {
        let mut writer = Writer::default();
        for pair in Pairs::new(self, other) {
            let bits = bits(pair.a, pair.b);
            if bits != 0 {
                writer.push(Word {
                    index: pair.index,
                    bits,
                });
            }
        }
        writer.finish()
    }
}

/// A word of two sets: the bits of each, 0 where it has no such word.
#[derive(Clone, Copy)]
pub struct Pair {
    pub index: i64,
    pub a: u64,
    pub b: u64,
}

/// The words that either of two sets has, ascending.
pub struct Pairs<'a, 'b> {
    a: Words<'a>,
    b: Words<'b>,
    next_a: Option<Word>,
    next_b: Option<Word>,
}

impl<'a, 'b> Pairs<'a, 'b> {
    pub fn new(a: FeatureSet<'a>, b: FeatureSet<'b>) -> Self {
        let (mut a, mut b) = (a.words(), b.words());
        Self {
            next_a: a.next(),
            next_b: b.next(),
            a,
            b,
        }
    }
}

impl Iterator for Pairs<'_, '_> {
    type Item = Pair;

    fn next(&mut self) -> Option<Pair> {
        let index = match (self.next_a, self.next_b) {
            (None, None) => return None,
            (Some(word), None) | (None, Some(word)) => word.index,
            (Some(a), Some(b)) => a.index.min(b.index),
        };
        Some(Pair {
            index,
            a: take(&mut self.next_a, &mut self.a, index),
            b: take(&mut self.next_b, &mut self.b, index),
        })
    }
}

/// The bits of the next word if it has that index, and then the one after it comes next.
fn take(next: &mut Option<Word>, words: &mut Words, index: i64) -> u64 {
    match *next {
        Some(word) if word.index == index => {
            *next = words.next();
            word.bits
        }
        _ => 0,
    }
}
