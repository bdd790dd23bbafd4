//! [`Words`], the words of an encoded set as they are read.

use super::MOST_IN_SET;
use super::word::{FULL, LISTED, MORE, NUMBER, OCTETS, RUN, Run, Word};

/// More full words than a set can hold.
const MOST_FULL: u64 = MOST_IN_SET / 64;

/// Reads the words of a set in ascending order, allocating nothing. What is malformed ends it early.
#[derive(Clone)]
pub struct Words<'a> {
    left: &'a [u8],
    /// Index of the next word if no empty one precedes it; nothing before the first.
    next: Option<i64>,
    /// Full words that still follow at `next`.
    full: u64,
}

impl<'a> Words<'a> {
    /// The words in these bytes, which come after the count.
    pub fn new(bytes: &'a [u8]) -> Self {
        Self {
            left: bytes,
            next: None,
            full: 0,
        }
    }

    fn byte(&mut self) -> Option<u8> {
        let (first, left) = self.left.split_first()?;
        self.left = left;
        Some(*first)
    }

    fn index(&mut self, gap: u64) -> Option<i64> {
        match self.next {
            None => Some(unzigzag(gap)),
            Some(next) => next.checked_add_unsigned(gap),
        }
    }

    fn bits(&mut self, way: u64) -> Option<u64> {
        match way {
            LISTED => self.listed(),
            OCTETS => self.octets(),
            FULL => {
                // More than any set holds is malformed, and would take ages to walk.
                self.full = varint(&mut self.left).filter(|&words| words <= MOST_FULL)?;
                Some(u64::MAX)
            }
            _ => {
                let (whole, left) = self.left.split_first_chunk()?;
                self.left = left;
                Some(u64::from_le_bytes(*whole))
            }
        }
    }

    fn listed(&mut self) -> Option<u64> {
        let mut bits = 0;
        loop {
            let head = self.byte()?;
            let mut tail = head;
            if head & RUN != 0 {
                tail = self.byte()?;
            }
            let run = Run {
                first: head & NUMBER,
                last: tail & NUMBER,
            };
            bits |= run.bits();
            if tail & MORE == 0 {
                return Some(bits);
            }
        }
    }

    fn octets(&mut self) -> Option<u64> {
        let mut mask = self.byte()?;
        let mut bits = 0;
        while mask != 0 {
            bits |= u64::from(self.byte()?) << (8 * mask.trailing_zeros());
            mask &= mask - 1;
        }
        Some(bits)
    }

    fn full(&mut self) -> Word {
        let index = self.next.unwrap_or(0);
        self.full -= 1;
        self.next = Some(index.wrapping_add(1));
        Word {
            index,
            bits: u64::MAX,
        }
    }
}

impl Iterator for Words<'_> {
    type Item = Word;

    fn next(&mut self) -> Option<Word> {
        if self.full > 0 {
            return Some(self.full());
        }
        let head = varint(&mut self.left)?;
        let index = self.index(head >> 2)?;
        let bits = self.bits(head & 3)?;
        self.next = Some(index.wrapping_add(1));
        Some(Word { index, bits })
    }
}

/// Takes a varint from the front: seven bits a byte, the least significant first.
pub fn varint(bytes: &mut &[u8]) -> Option<u64> {
    let mut value = 0;
    let mut left = *bytes;
    for shift in (0..64).step_by(7) {
        let (byte, rest) = left.split_first()?;
        left = rest;
        value |= u64::from(byte & 0x7f) << shift;
        if byte & 0x80 == 0 {
            *bytes = left;
            return Some(value);
        }
    }
    None
}

/// 0, 1, 2, 3, … back to 0, -1, 1, -2, …
fn unzigzag(value: u64) -> i64 {
    (value >> 1).cast_signed() ^ -(value & 1).cast_signed()
}
