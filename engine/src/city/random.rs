//! [`SplitMix64`], random numbers that are the same everywhere.

/// What each step adds to the state: 2^64 divided by the golden ratio, odd.
const STEP: u64 = 0x9E37_79B9_7F4A_7C15;

/// Steele, Lea, Flood 2014, "Fast splittable pseudorandom number generators": integer steps only,
/// so that a seed means the same city everywhere and forever.
pub struct SplitMix64(u64);

impl SplitMix64 {
    /// The sequence of a seed, from its number `skipped` on.
    pub fn new(seed: u64, skipped: u64) -> Self {
        Self(seed.wrapping_add(skipped.wrapping_mul(STEP)))
    }

    /// A sequence of its own for each key, so that parts of a city need not know each other.
    pub fn keyed(seed: u64, key: [i64; 3]) -> Self {
        key.into_iter().fold(Self(seed), |mut random, part| {
            Self(random.next() ^ part.cast_unsigned())
        })
    }

    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(STEP);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// A number in [0, 1) with 53 random bits.
    pub fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A number from `low` to `high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + self.unit() * (high - low)
    }

    /// A whole number from `low` to `high`, both included; `low` where there is none.
    pub fn whole(&mut self, low: i64, high: i64) -> i64 {
        let choices = (high.max(low) - low + 1) as f64;
        low + (self.unit() * choices) as i64
    }

    /// `true` once in `times`.
    pub fn once_in(&mut self, times: i64) -> bool {
        self.whole(1, times) == 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_generator_gives_its_published_numbers() {
        let mut random = SplitMix64::new(1_234_567, 0);
        assert_eq!(random.next(), 6_457_827_717_110_365_317);
        assert_eq!(random.next(), 3_203_168_211_198_807_973);
        let mut later = SplitMix64::new(1_234_567, 1);
        assert_eq!(later.next(), 3_203_168_211_198_807_973);
    }

    #[test]
    fn every_part_of_a_key_counts() {
        let first = |seed, key| SplitMix64::keyed(seed, key).next();
        let same = first(1, [0, 1, 2]);
        for other in [
            first(2, [0, 1, 2]),
            first(1, [1, 1, 2]),
            first(1, [0, 2, 1]),
            first(1, [0, 1, -2]),
        ] {
            assert_ne!(same, other);
        }
    }

    #[test]
    fn whole_numbers_reach_both_bounds() {
        let mut random = SplitMix64::new(1, 0);
        let drawn: Vec<i64> = (0..200).map(|_| random.whole(-1, 2)).collect();
        assert_eq!(drawn.iter().min(), Some(&-1));
        assert_eq!(drawn.iter().max(), Some(&2));
        assert_eq!(random.whole(3, 2), 3);
    }
}
