//! [`SetCollector`], which makes one set of many numbers and sets.

use super::bytes::FeatureSet;
use super::word::Word;
use super::writer::{OversizedSet, Writer};

/// Loose numbers that are kept before they are made a set: 64 kB of them.
const LOOSE: usize = 8192;

/// Numbers and sets on their way into one set. Sets wait in a stack, each more than twice as long
/// as the next one, so that every byte is merged a logarithmic number of times.
#[derive(Default)]
pub struct SetCollector {
    loose: Vec<i64>,
    sets: Vec<Vec<u8>>,
}

impl SetCollector {
    /// Adds a number.
    pub fn add(&mut self, number: i64) -> Result<(), OversizedSet> {
        self.loose.push(number);
        if self.loose.len() < LOOSE {
            return Ok(());
        }
        self.settle()
    }

    /// Adds all of a set.
    pub fn add_set(&mut self, set: FeatureSet) -> Result<(), OversizedSet> {
        self.sets.push(set.bytes().to_vec());
        while let [.., long, short] = &self.sets[..]
            && long.len() <= 2 * short.len()
        {
            self.merge_last()?;
        }
        Ok(())
    }

    /// Everything that was added, encoded. More may be added afterwards.
    pub fn set(&mut self) -> Result<FeatureSet<'_>, OversizedSet> {
        self.settle()?;
        while self.sets.len() > 1 {
            self.merge_last()?;
        }
        Ok(FeatureSet::trusted(
            self.sets.last().map_or(&[0], |set| &set[..]),
        ))
    }

    fn settle(&mut self) -> Result<(), OversizedSet> {
        if self.loose.is_empty() {
            return Ok(());
        }
        let mut loose = std::mem::take(&mut self.loose);
        let set = encode(&mut loose)?;
        loose.clear();
        self.loose = loose;
        self.add_set(FeatureSet::trusted(&set))
    }

    fn merge_last(&mut self) -> Result<(), OversizedSet> {
        if let (Some(b), Some(a)) = (self.sets.pop(), self.sets.pop()) {
            let union = FeatureSet::trusted(&a).union(FeatureSet::trusted(&b))?;
            self.sets.push(union);
        }
        Ok(())
    }
}

/// The set of some numbers, which are sorted.
fn encode(numbers: &mut [i64]) -> Result<Vec<u8>, OversizedSet> {
    numbers.sort_unstable();
    let mut writer = Writer::default();
    for chunk in numbers.chunk_by(|a, b| a >> 6 == b >> 6) {
        let bits = chunk.iter().fold(0, |bits, &n| bits | Word::of(n).bits);
        writer.push(Word {
            index: chunk[0] >> 6,
            bits,
        });
    }
    writer.finish()
}
