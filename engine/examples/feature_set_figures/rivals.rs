//! Forms that a set may have.

use engine::{FeatureSet, SetCollector};
use roaring::RoaringBitmap;

/// A form of sets of ascending numbers.
pub trait Codec {
    fn name(&self) -> &'static str;
    fn encode(&self, set: &[u32]) -> Vec<u8>;
    /// The sum of its numbers: what decoding alone costs.
    fn sum(&self, bytes: &[u8]) -> u64;
}

/// The form of this crate.
pub struct Ours;

impl Codec for Ours {
    fn name(&self) -> &'static str {
        "FeatureSet"
    }

    fn encode(&self, set: &[u32]) -> Vec<u8> {
        let mut collector = SetCollector::default();
        for &number in set {
            collector.add(i64::from(number)).expect("a small set");
        }
        collector.set().expect("a small set").bytes().to_vec()
    }

    fn sum(&self, bytes: &[u8]) -> u64 {
        let set = FeatureSet::trusted(bytes);
        set.numbers().map(i64::cast_unsigned).sum()
    }
}

/// `int4[]` without its header.
pub struct Plain;

impl Codec for Plain {
    fn name(&self) -> &'static str {
        "integer[]"
    }

    fn encode(&self, set: &[u32]) -> Vec<u8> {
        set.iter().flat_map(|number| number.to_le_bytes()).collect()
    }

    fn sum(&self, bytes: &[u8]) -> u64 {
        let (numbers, _) = bytes.as_chunks();
        numbers
            .iter()
            .map(|&four| u64::from(u32::from_le_bytes(four)))
            .sum()
    }
}

/// Differences less one, seven bits a byte.
pub struct DeltaVarint;

impl Codec for DeltaVarint {
    fn name(&self) -> &'static str {
        "delta-varint"
    }

    fn encode(&self, set: &[u32]) -> Vec<u8> {
        let mut bytes = Vec::new();
        for gap in gaps(set) {
            put(&mut bytes, gap);
        }
        bytes
    }

    fn sum(&self, mut bytes: &[u8]) -> u64 {
        let (mut next, mut sum) = (0, 0);
        while !bytes.is_empty() {
            next += get(&mut bytes);
            sum += u64::from(next);
            next += 1;
        }
        sum
    }
}

/// Delta-varints of runs: the gap before it with a bit that tells whether a length follows.
pub struct Runs;

impl Codec for Runs {
    fn name(&self) -> &'static str {
        "delta-varint with runs"
    }

    fn encode(&self, set: &[u32]) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut next = 0;
        for run in set.chunk_by(|a, b| a + 1 == *b) {
            let more = run.len() as u32 - 1;
            put(&mut bytes, (run[0] - next) << 1 | u32::from(more > 0));
            if more > 0 {
                put(&mut bytes, more);
            }
            next = run[0] + more + 1;
        }
        bytes
    }

    fn sum(&self, mut bytes: &[u8]) -> u64 {
        let (mut next, mut sum) = (0, 0);
        while !bytes.is_empty() {
            let head = get(&mut bytes);
            let more = if head & 1 == 1 { get(&mut bytes) } else { 0 };
            next += head >> 1;
            for number in next..=next + more {
                sum += u64::from(number);
            }
            next += more + 1;
        }
        sum
    }
}

/// Blocks of 32 differences, each with as many bits as the widest of its block needs.
pub struct PackedBlocks;

impl Codec for PackedBlocks {
    fn name(&self) -> &'static str {
        "packed blocks of 32"
    }

    fn encode(&self, set: &[u32]) -> Vec<u8> {
        let mut bytes = Vec::new();
        put(&mut bytes, set.len() as u32);
        let gaps: Vec<u32> = gaps(set).collect();
        for block in gaps.chunks(32) {
            let width = block.iter().map(|gap| 32 - gap.leading_zeros()).max();
            let width = width.unwrap_or(0);
            bytes.push(width as u8);
            let mut bits = BitWriter::new(&mut bytes);
            for &gap in block {
                bits.put(u64::from(gap), width);
            }
            bits.end();
        }
        bytes
    }

    fn sum(&self, mut bytes: &[u8]) -> u64 {
        let (mut next, mut sum) = (0, 0);
        let mut left = get(&mut bytes);
        while left > 0 {
            let width = u32::from(bytes[0]);
            let count = left.min(32);
            let mut bits = BitReader::new(&bytes[1..]);
            for _ in 0..count {
                next += bits.get(width);
                sum += next;
                next += 1;
            }
            bytes = &bytes[1 + (count * width).div_ceil(8) as usize..];
            left -= count;
        }
        sum
    }
}

/// Golomb-Rice codes: a difference in unary above `k` bits, `k` as is best for the set.
pub struct Rice;

impl Codec for Rice {
    fn name(&self) -> &'static str {
        "Golomb-Rice"
    }

    fn encode(&self, set: &[u32]) -> Vec<u8> {
        let cost = |k: u32| {
            gaps(set)
                .map(|gap| u64::from((gap >> k) + 1 + k))
                .sum::<u64>()
        };
        let k = (0..20).min_by_key(|&k| cost(k)).unwrap_or(0);
        let mut bytes = Vec::new();
        put(&mut bytes, set.len() as u32);
        bytes.push(k as u8);
        let mut bits = BitWriter::new(&mut bytes);
        for gap in gaps(set) {
            for _ in 0..gap >> k {
                bits.put(0, 1);
            }
            bits.put(1, 1);
            bits.put(u64::from(gap) & ((1 << k) - 1), k);
        }
        bits.end();
        bytes
    }

    fn sum(&self, mut bytes: &[u8]) -> u64 {
        let count = get(&mut bytes);
        let k = u32::from(bytes[0]);
        let mut bits = BitReader::new(&bytes[1..]);
        let (mut next, mut sum) = (0, 0);
        for _ in 0..count {
            next += bits.zeros() << k;
            next += bits.get(k);
            sum += next;
            next += 1;
        }
        sum
    }
}

/// Elias and Fano's: low bits as they are, high bits in unary.
pub struct EliasFano;

impl Codec for EliasFano {
    fn name(&self) -> &'static str {
        "Elias-Fano"
    }

    fn encode(&self, set: &[u32]) -> Vec<u8> {
        let first = set[0];
        let range = u64::from(set[set.len() - 1] - first) + 1;
        let low = (range / set.len() as u64).checked_ilog2().unwrap_or(0);
        let mut bytes = Vec::new();
        put(&mut bytes, set.len() as u32);
        put(&mut bytes, first);
        bytes.push(low as u8);
        let mut bits = BitWriter::new(&mut bytes);
        for number in set {
            bits.put(u64::from(number - first) & ((1 << low) - 1), low);
        }
        bits.end();
        let mut bits = BitWriter::new(&mut bytes);
        let mut high = 0;
        for number in set {
            let next = (number - first) >> low;
            for _ in high..next {
                bits.put(0, 1);
            }
            bits.put(1, 1);
            high = next;
        }
        bits.end();
        bytes
    }

    fn sum(&self, mut bytes: &[u8]) -> u64 {
        let count = get(&mut bytes);
        let first = u64::from(get(&mut bytes));
        let low = u32::from(bytes[0]);
        let mut lows = BitReader::new(&bytes[1..]);
        let mut highs = BitReader::new(&bytes[1 + (count * low).div_ceil(8) as usize..]);
        let (mut high, mut sum) = (0, 0);
        for _ in 0..count {
            high += highs.zeros();
            sum += first + (high << low | lows.get(low));
        }
        sum
    }
}

/// A tree of octets: a bit for each of eight parts that is not empty, then those parts.
pub struct Tree;

/// Levels of the tree: 8^7 numbers.
const LEVELS: u32 = 7;

impl Codec for Tree {
    fn name(&self) -> &'static str {
        "tree of octets"
    }

    fn encode(&self, set: &[u32]) -> Vec<u8> {
        fn part(set: &[u32], level: u32, bytes: &mut Vec<u8>) {
            let at = bytes.len();
            bytes.push(0);
            for child in set.chunk_by(|a, b| a >> (3 * level) == b >> (3 * level)) {
                bytes[at] |= 1 << (child[0] >> (3 * level) & 7);
                if level > 0 {
                    part(child, level - 1, bytes);
                }
            }
            // A full part is written as an empty one, which there is not.
            if set.len() == 8 << (3 * level) {
                bytes.truncate(at);
                bytes.push(0);
            }
        }
        let mut bytes = Vec::new();
        part(set, LEVELS - 1, &mut bytes);
        bytes
    }

    fn sum(&self, mut bytes: &[u8]) -> u64 {
        fn part(bytes: &mut &[u8], level: u32, base: u64) -> u64 {
            let mut mask = bytes[0];
            *bytes = &bytes[1..];
            if mask == 0 {
                let size = 8 << (3 * level);
                return size * base + size * (size - 1) / 2;
            }
            let mut sum = 0;
            while mask != 0 {
                let child = base + (u64::from(mask.trailing_zeros()) << (3 * level));
                sum += if level == 0 {
                    child
                } else {
                    part(bytes, level - 1, child)
                };
                mask &= mask - 1;
            }
            sum
        }
        part(&mut bytes, LEVELS - 1, 0)
    }
}

/// The crate `roaring`, in its serialized form, which is read into memory first.
pub struct Roaring {
    pub runs: bool,
}

impl Codec for Roaring {
    fn name(&self) -> &'static str {
        if self.runs {
            "roaring with runs"
        } else {
            "roaring"
        }
    }

    fn encode(&self, set: &[u32]) -> Vec<u8> {
        let mut bitmap: RoaringBitmap = set.iter().copied().collect();
        if self.runs {
            bitmap.optimize();
        }
        let mut bytes = Vec::new();
        bitmap.serialize_into(&mut bytes).expect("memory");
        bytes
    }

    fn sum(&self, bytes: &[u8]) -> u64 {
        let bitmap = RoaringBitmap::deserialize_unchecked_from(bytes).expect("a bitmap");
        bitmap.iter().map(u64::from).sum()
    }
}

fn gaps(set: &[u32]) -> impl Iterator<Item = u32> {
    let mut next = 0;
    set.iter().map(move |&number| {
        let gap = number - next;
        next = number + 1;
        gap
    })
}

fn put(bytes: &mut Vec<u8>, mut value: u32) {
    while value >= 0x80 {
        bytes.push(value as u8 | 0x80);
        value >>= 7;
    }
    bytes.push(value as u8);
}

fn get(bytes: &mut &[u8]) -> u32 {
    let (mut value, mut shift) = (0, 0);
    loop {
        let byte = bytes[0];
        *bytes = &bytes[1..];
        value |= u32::from(byte & 0x7f) << shift;
        if byte & 0x80 == 0 {
            return value;
        }
        shift += 7;
    }
}

/// Writes bits, the least significant first.
struct BitWriter<'a> {
    bytes: &'a mut Vec<u8>,
    held: u64,
    count: u32,
}

impl<'a> BitWriter<'a> {
    fn new(bytes: &'a mut Vec<u8>) -> Self {
        Self {
            bytes,
            held: 0,
            count: 0,
        }
    }

    fn put(&mut self, value: u64, width: u32) {
        self.held |= value << self.count;
        self.count += width;
        while self.count >= 8 {
            self.bytes.push(self.held as u8);
            self.held >>= 8;
            self.count -= 8;
        }
    }

    fn end(self) {
        if self.count > 0 {
            self.bytes.push(self.held as u8);
        }
    }
}

/// Reads them.
struct BitReader<'a> {
    bytes: &'a [u8],
    held: u64,
    count: u32,
}

impl<'a> BitReader<'a> {
    fn new(bytes: &'a [u8]) -> Self {
        Self {
            bytes,
            held: 0,
            count: 0,
        }
    }

    fn fill(&mut self) {
        while self.count <= 56
            && let Some((first, left)) = self.bytes.split_first()
        {
            self.held |= u64::from(*first) << self.count;
            self.count += 8;
            self.bytes = left;
        }
    }

    fn get(&mut self, width: u32) -> u64 {
        if self.count < width {
            self.fill();
        }
        let value = self.held & ((1 << width) - 1);
        self.held >>= width;
        self.count -= width;
        value
    }

    /// How many zeros come before the next one, which is taken too.
    fn zeros(&mut self) -> u64 {
        let mut zeros = 0;
        while self.held == 0 {
            zeros += self.count;
            self.count = 0;
            self.fill();
        }
        let here = self.held.trailing_zeros();
        self.held = self.held >> here >> 1;
        self.count -= here + 1;
        u64::from(zeros + here)
    }
}
