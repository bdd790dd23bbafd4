//! Mutations of files.

use fastrand::Rng;

/// Numbers that are often forgotten.
const NUMBERS: [&str; 14] = [
    "0",
    "-1",
    "1",
    "255",
    "65535",
    "65536",
    "2147483647",
    "4294967295",
    "4294967296",
    "1e308",
    "-1e308",
    "1e-308",
    "NaN",
    "18446744073709551615",
];

/// Bytes that are often forgotten.
const BYTES: [u8; 8] = [0x00, 0x01, 0x0a, 0x20, 0x7f, 0x80, 0xfe, 0xff];

/// Most bytes of an input: long ones take time and find nothing that short ones do not.
const LONGEST: usize = 1 << 20;

/// A file with one to eight changes; `others` lend pieces, `words` are those of the format.
pub fn mutated(seed: &[u8], others: &[Vec<u8>], words: &[&str], rng: &mut Rng) -> Vec<u8> {
    let mut bytes = seed.to_vec();
    for _ in 0..rng.usize(1..=8) {
        mutate(&mut bytes, others, words, rng);
        bytes.truncate(LONGEST);
    }
    bytes
}

fn mutate(bytes: &mut Vec<u8>, others: &[Vec<u8>], words: &[&str], rng: &mut Rng) {
    let range = range(bytes.len(), rng);
    match rng.u32(..11) {
        0 => {
            if let Some(byte) = bytes.get_mut(range.start) {
                *byte ^= 1 << rng.u32(..8);
            }
        }
        1 => {
            if let Some(byte) = bytes.get_mut(range.start) {
                *byte = BYTES[rng.usize(..BYTES.len())];
            }
        }
        2 => bytes[range].iter_mut().for_each(|byte| *byte = rng.u8(..)),
        3 => drop(bytes.drain(range)),
        4 => {
            let piece = bytes[range.clone()].to_vec();
            let times = rng.usize(1..=16);
            bytes.splice(range.start..range.start, piece.repeat(times));
        }
        5 => {
            let number = rng.u32(..).to_le_bytes();
            let number = if rng.bool() {
                number
            } else {
                [0xff, 0xff, 0xff, rng.u8(..)]
            };
            let end = bytes.len().min(range.start + 4);
            bytes.splice(range.start..end, number);
        }
        6 => {
            let number = number_near(bytes, range.start);
            bytes.splice(number, NUMBERS[rng.usize(..NUMBERS.len())].bytes());
        }
        7 | 8 => {
            if let Some(word) = rng.choice(words) {
                let end = if rng.bool() { range.start } else { range.end };
                bytes.splice(range.start..end, word.bytes());
            }
        }
        9 => {
            if let Some(other) = rng.choice(others) {
                let piece = self::range(other.len(), rng);
                bytes.splice(range, other[piece].iter().copied());
            }
        }
        _ => bytes.truncate(range.start),
    }
}

/// A random range, mostly a short one.
fn range(length: usize, rng: &mut Rng) -> std::ops::Range<usize> {
    let start = rng.usize(..=length);
    let most = [4, 32, 1024][rng.usize(..3)];
    start..length.min(start + rng.usize(..=most))
}

/// The digits at or after a place; empty where there are none.
fn number_near(bytes: &[u8], start: usize) -> std::ops::Range<usize> {
    let is_digit = |byte: &u8| byte.is_ascii_digit();
    let Some(first) = bytes[start..].iter().position(is_digit) else {
        return start..start;
    };
    let first = start + first;
    let length = bytes[first..]
        .iter()
        .take_while(|byte| is_digit(byte))
        .count();
    first..first + length
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mutations_repeat_with_their_seed_and_differ() {
        let seed = b"point [ 1 2 3, 40 50 60 ]";
        let run = |number: u64| {
            let mut rng = Rng::with_seed(number);
            (0..100)
                .map(|_| mutated(seed, &[b"other".to_vec()], &["USE"], &mut rng))
                .collect::<Vec<_>>()
        };
        assert_eq!(run(1), run(1));
        assert_ne!(run(1), run(2));
        assert!(
            run(3)
                .iter()
                .filter(|bytes| bytes.as_slice() != seed)
                .count()
                > 80
        );
    }

    #[test]
    fn nothing_can_be_mutated() {
        let mut rng = Rng::with_seed(1);
        (0..10_000).for_each(|_| drop(mutated(b"", &[], &[], &mut rng)));
    }
}
