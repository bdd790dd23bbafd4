//! [`Writer`], which encodes a set word by word.

use super::MOST_IN_SET;
use super::word::{FULL, LISTED, MORE, OCTETS, RUN, Word, octet_mask, runs};

/// A set of more than [`MOST_IN_SET`] numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a set has at most {MOST_IN_SET} numbers")]
pub struct OversizedSet;

/// Writes words, which come in ascending order and are not empty.
#[derive(Default)]
pub struct Writer {
    bytes: Vec<u8>,
    count: u64,
    /// Index of the next word if no empty one precedes it; nothing before the first.
    next: Option<i64>,
    /// Full words seen since the last one that was written.
    full: u64,
}

impl Writer {
    /// Adds a word.
    pub fn push(&mut self, word: Word) {
        self.count += u64::from(word.bits.count_ones());
        let follows = self.next == Some(word.index);
        if self.full > 0 && follows && word.bits == u64::MAX {
            self.full += 1;
        } else {
            self.end_full();
            self.begin(word);
        }
        self.next = Some(word.index.wrapping_add(1));
    }

    /// The encoded set.
    pub fn finish(mut self) -> Result<Vec<u8>, OversizedSet> {
        if self.count > MOST_IN_SET {
            return Err(OversizedSet);
        }
        self.end_full();
        let mut set = Vec::with_capacity(self.bytes.len() + 4);
        put_varint(&mut set, self.count);
        set.append(&mut self.bytes);
        Ok(set)
    }

    fn begin(&mut self, word: Word) {
        let gap = match self.next {
            None => zigzag(word.index),
            Some(next) => word.index.wrapping_sub(next).cast_unsigned(),
        };
        let way = word.way();
        put_varint(&mut self.bytes, gap << 2 | way);
        match way {
            LISTED => self.list(word.bits),
            OCTETS => {
                self.bytes.push(octet_mask(word.bits));
                let octets = word.bits.to_le_bytes();
                self.bytes
                    .extend(octets.iter().filter(|octet| **octet != 0));
            }
            FULL => self.full = 1,
            _ => self.bytes.extend(word.bits.to_le_bytes()),
        }
    }

    fn list(&mut self, bits: u64) {
        let mut runs = runs(bits).peekable();
        while let Some(run) = runs.next() {
            let more = runs.peek().map_or(0, |_| MORE);
            if run.first == run.last {
                self.bytes.push(run.first | more);
            } else {
                self.bytes.extend([run.first | RUN, run.last | more]);
            }
        }
    }

    fn end_full(&mut self) {
        if self.full > 0 {
            put_varint(&mut self.bytes, self.full - 1);
            self.full = 0;
        }
    }
}

/// Seven bits a byte, the least significant first.
fn put_varint(bytes: &mut Vec<u8>, mut value: u64) {
    while value >= 0x80 {
        bytes.push(value as u8 | 0x80);
        value >>= 7;
    }
    bytes.push(value as u8);
}

/// 0, -1, 1, -2, … to 0, 1, 2, 3, …
fn zigzag(value: i64) -> u64 {
    (value << 1 ^ value >> 63).cast_unsigned()
}
