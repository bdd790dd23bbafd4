//! [`Word`], 64 consecutive numbers.

use std::ops::RangeInclusive;

/// Ways to write a word; the two low bits of what leads to it.
pub const LISTED: u64 = 0;
/// See [`LISTED`].
pub const OCTETS: u64 = 1;
/// See [`LISTED`].
pub const FULL: u64 = 2;
/// See [`LISTED`].
pub const WHOLE: u64 = 3;

/// In a listing: another number follows in this word.
pub const MORE: u8 = 0x40;
/// In a listing: a run begins here, and the next byte has its end.
pub const RUN: u8 = 0x80;
/// In a listing: the bits of the number.
pub const NUMBER: u8 = 0x3f;

/// Which of the numbers `64 * index ..= 64 * index + 63` are in a set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Word {
    /// The numbers divided by 64, floored.
    pub index: i64,
    /// A bit a number, never 0.
    pub bits: u64,
}

impl Word {
    /// The indices of the words that numbers fall into.
    pub const INDICES: RangeInclusive<i64> = i64::MIN >> 6..=i64::MAX >> 6;

    /// The word that holds nothing but this number.
    pub fn of(number: i64) -> Self {
        Self {
            index: number >> 6,
            bits: 1 << (number & 63),
        }
    }

    /// Its numbers, ascending.
    pub fn numbers(self) -> impl Iterator<Item = i64> + use<> {
        let base = self.index << 6;
        bits(self.bits).map(move |bit| base | i64::from(bit))
    }

    /// The shortest way to write it.
    pub fn way(self) -> u64 {
        if self.bits == u64::MAX {
            return FULL;
        }
        let listed = runs(self.bits).map(Run::bytes).sum::<u32>();
        let octets = 1 + octet_mask(self.bits).count_ones();
        if listed <= octets.min(8) {
            LISTED
        } else if octets <= 8 {
            OCTETS
        } else {
            WHOLE
        }
    }
}

/// The positions of the bits that are set.
fn bits(mut left: u64) -> impl Iterator<Item = u32> {
    std::iter::from_fn(move || {
        let bit = (left != 0).then(|| left.trailing_zeros());
        left &= left.wrapping_sub(1);
        bit
    })
}

/// Which octets of a word have a bit set.
pub fn octet_mask(bits: u64) -> u8 {
    let octets = bits.to_le_bytes();
    (0..8).fold(0, |mask, i| mask | u8::from(octets[i] != 0) << i)
}

/// Consecutive numbers of a word, `first ..= last`.
#[derive(Clone, Copy)]
pub struct Run {
    pub first: u8,
    pub last: u8,
}

impl Run {
    fn bytes(self) -> u32 {
        1 + u32::from(self.first != self.last)
    }

    /// Its bits; none if it ends before it begins.
    pub fn bits(self) -> u64 {
        let to_last = u64::MAX >> (63 - self.last);
        to_last & (u64::MAX << self.first)
    }
}

/// The maximal runs of a word, ascending.
pub fn runs(mut left: u64) -> impl Iterator<Item = Run> {
    std::iter::from_fn(move || {
        if left == 0 {
            return None;
        }
        let first = left.trailing_zeros();
        let last = first + (left >> first).trailing_ones() - 1;
        let run = Run {
            first: first as u8,
            last: last as u8,
        };
        left &= !run.bits();
        Some(run)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_are_maximal_and_add_up() {
        for bits in [
            1,
            0b1011,
            u64::MAX,
            u64::MAX << 1,
            u64::MAX >> 1,
            1 << 63,
            0x5555 << 40,
        ] {
            let found: Vec<Run> = runs(bits).collect();
            assert_eq!(found.iter().map(|run| run.bits()).sum::<u64>(), bits);
            assert!(
                found
                    .windows(2)
                    .all(|pair| pair[0].last + 1 < pair[1].first)
            );
        }
    }

    #[test]
    fn the_shortest_way_is_taken_and_of_equal_ones_the_first() {
        let way = |bits| Word { index: 0, bits }.way();
        assert_eq!(way(1), LISTED);
        assert_eq!(way(u64::MAX), FULL);
        assert_eq!(way(u64::MAX >> 1), LISTED);
        assert_eq!(way(0b0101), LISTED);
        assert_eq!(way(0b0001_0101), OCTETS);
        assert_eq!(way(0x5555_5555_5555_5555), WHOLE);
        assert_eq!(way(0x5555_5555_5555_5500), OCTETS);
        assert_eq!(way(0x0101_0101_0101_0101), LISTED);
    }

    #[test]
    fn numbers_keep_their_sign() {
        for number in [i64::MIN, -65, -64, -1, 0, 63, 64, i64::MAX] {
            assert_eq!(Word::of(number).numbers().collect::<Vec<_>>(), [number]);
        }
    }
}
