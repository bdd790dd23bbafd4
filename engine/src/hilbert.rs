//! Positions of points along a curve that fills space: what is near on the curve is near in space.

use glam::DVec3;

/// Bits of each coordinate of a position.
const BITS: u32 = 42;
/// Cells of the curve in a metre: a sixteenth of a millimetre each, so that the curve reaches
/// 134,000 km either way; points beyond are on its border.
const CELLS_PER_METRE: f64 = 16_384.0;

/// Bits of each coordinate of a short position.
const SHORT_BITS: u32 = 21;
/// Cells of the short curve in a metre: it reaches 131 km either way.
const SHORT_CELLS_PER_METRE: f64 = 8.0;

/// The position of a point on Hilbert's curve through space, 126 bits.
#[must_use]
pub fn hilbert_key(point: DVec3) -> u128 {
    let [high, low] = curve::<BITS>(point.to_array().map(|x| cell::<BITS>(x * CELLS_PER_METRE)));
    u128::from(high) << 63 | u128::from(low)
}

/// The position on a coarser curve around the origin, 63 bits, for points near it.
#[must_use]
pub fn short_hilbert_key(point: DVec3) -> u64 {
    let cells = point
        .to_array()
        .map(|x| cell::<SHORT_BITS>(x * SHORT_CELLS_PER_METRE));
    curve::<SHORT_BITS>(cells)[1]
}

/// The position of a cell, of which each coordinate has `B` bits, 42 at the most; its upper and lower
/// 63 bits. By J. Skilling, "Programming the Hilbert curve", AIP Conference Proceedings 707, 2004.
fn curve<const B: u32>(mut x: [u64; 3]) -> [u64; 2] {
    let top = 1_u64 << (B - 1);
    // Undo the turns of the coarser levels on the finer ones.
    let mut bit = top;
    while bit > 1 {
        let below = bit - 1;
        for axis in 0..3 {
            if x[axis] & bit != 0 {
                x[0] ^= below;
            } else {
                let swap = (x[0] ^ x[axis]) & below;
                x[0] ^= swap;
                x[axis] ^= swap;
            }
        }
        bit >>= 1;
    }
    // Gray code.
    x[1] ^= x[0];
    x[2] ^= x[1];
    let mut flips = 0;
    bit = top;
    while bit > 1 {
        if x[2] & bit != 0 {
            flips ^= bit - 1;
        }
        bit >>= 1;
    }
    interleaved(x.map(|coordinate| coordinate ^ flips))
}

/// The cell of a coordinate that is counted in cells; 0 at the lower end of the curve's reach.
fn cell<const B: u32>(coordinate: f64) -> u64 {
    let half = 1_i64 << (B - 1);
    // The conversion of floats to integers saturates.
    let cell = coordinate.floor() as i64;
    (cell.clamp(-half, half - 1) + half).cast_unsigned()
}

/// The bits of three numbers in turn, those of the first one leading: of their upper and lower 21.
fn interleaved(numbers: [u64; 3]) -> [u64; 2] {
    let low = (1 << 21) - 1;
    [21, 0].map(|shift: u32| {
        let [a, b, c] = numbers.map(|number| spread(number >> shift & low));
        a << 2 | b << 1 | c
    })
}

/// The 21 bits of a number, two zeros between them.
fn spread(number: u64) -> u64 {
    let mut spread = number;
    spread = (spread | spread << 32) & 0x001f_0000_0000_ffff;
    spread = (spread | spread << 16) & 0x001f_0000_ff00_00ff;
    spread = (spread | spread << 8) & 0x100f_00f0_0f00_f00f;
    spread = (spread | spread << 4) & 0x10c3_0c30_c30c_30c3;
    (spread | spread << 2) & 0x1249_2492_4924_9249
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    /// A cube of cells at a corner of a curve, by position.
    fn cells(
        key: impl Fn(DVec3) -> u128,
        per_metre: f64,
        side: i32,
        at: DVec3,
    ) -> BTreeMap<u128, DVec3> {
        let mut cells = BTreeMap::new();
        for x in 0..side {
            for y in 0..side {
                for z in 0..side {
                    let steps = DVec3::new(x.into(), y.into(), z.into());
                    let point = at + (steps + 0.5) / per_metre;
                    cells.insert(key(point), steps);
                }
            }
        }
        cells
    }

    fn check(key: impl Fn(DVec3) -> u128, per_metre: f64, bits: u32) {
        let reach = (1_u64 << (bits - 1)) as f64 / per_metre;
        for corner in [
            DVec3::splat(-reach),
            DVec3::ZERO,
            DVec3::new(0.0, 0.0, -reach),
        ] {
            let cells = cells(&key, per_metre, 16, corner);
            assert_eq!(cells.len(), 4096, "every cell has a position of its own");
            let (first, last) = (cells.keys().next(), cells.keys().last());
            // An aligned cube of cells is one piece of the curve.
            assert_eq!(
                first.zip(last).map(|(first, last)| last - first),
                Some(4095)
            );
            let steps: Vec<_> = cells.values().collect();
            for pair in steps.windows(2) {
                assert_eq!((*pair[0] - *pair[1]).abs().element_sum(), 1.0);
            }
        }
    }

    #[test]
    fn consecutive_positions_are_neighbours_in_space() {
        check(hilbert_key, CELLS_PER_METRE, BITS);
        let short = |point| u128::from(short_hilbert_key(point));
        check(short, SHORT_CELLS_PER_METRE, SHORT_BITS);
    }

    #[test]
    fn points_out_of_reach_are_on_the_border() {
        let far = hilbert_key(DVec3::splat(1e300));
        assert_eq!(far, hilbert_key(DVec3::splat(1e9)));
        assert_ne!(far, hilbert_key(DVec3::splat(1e5)));
        assert!(far < 1 << 126);
    }
}
