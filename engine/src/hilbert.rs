//! Positions of points along a curve that fills space: what is near on the curve is near in space.

use glam::DVec3;

/// Bits of each coordinate of a position.
const BITS: u32 = 42;
/// Cells of the curve in a metre: a sixteenth of a millimetre each, so that the curve reaches
/// 134,000 km either way; points beyond are on its border.
const CELLS_PER_METRE: f64 = 16_384.0;

/// Bits of x and y in a position in plan, and of the height after it.
const PLAN_BITS: u32 = 24;
const HEIGHT_BITS: u32 = 16;
/// Cells of the curve in plan in a metre: it reaches 1,048 km either way, heights 4 km.
const PLAN_CELLS_PER_METRE: f64 = 8.0;

/// Bits of both coordinates of a square of a grid in plan.
const SQUARE_BITS: u32 = 20;

/// The position of a point on Hilbert's curve through space, 126 bits.
#[must_use]
pub fn hilbert_key(point: DVec3) -> u128 {
    let cells = (point * CELLS_PER_METRE).to_array().map(cell::<BITS>);
    interleaved(transposed::<3, BITS>(cells))
}

/// The position of a point near the origin on Hilbert's curve through the plane, and then its height:
/// 64 bits. Cities are flat: along a curve through space, what is low and what is high in one street
/// would come apart.
#[must_use]
pub fn plan_key(point: DVec3) -> u64 {
    let [x, y, z] = (point * PLAN_CELLS_PER_METRE).to_array();
    let plan = along_plane::<PLAN_BITS>([x, y].map(cell::<PLAN_BITS>));
    plan << HEIGHT_BITS | cell::<HEIGHT_BITS>(z)
}

/// The position of a square of a grid on Hilbert's curve through the plane, 40 bits; `None` beyond 524,288
/// squares from the origin.
#[must_use]
pub fn square_key(place: [i64; 2]) -> Option<u64> {
    let half = 1 << (SQUARE_BITS - 1);
    let is_near = place.iter().all(|at| (-half..half).contains(at));
    is_near.then(|| along_plane::<SQUARE_BITS>(place.map(|at| (at + half).cast_unsigned())))
}

/// The position of a cell on Hilbert's curve through the plane.
fn along_plane<const B: u32>(cells: [u64; 2]) -> u64 {
    let [x, y] = transposed::<2, B>(cells);
    let bits = (0..B).rev();
    bits.fold(0, |plan, bit| {
        plan << 2 | (x >> bit & 1) << 1 | y >> bit & 1
    })
}

/// The position of a cell on Hilbert's curve through `N` dimensions, of which each coordinate has `B`
/// bits: the bits of the result in turn, those of the first number leading. By J. Skilling,
/// "Programming the Hilbert curve", AIP Conference Proceedings 707, 2004.
fn transposed<const N: usize, const B: u32>(mut x: [u64; N]) -> [u64; N] {
    let top = 1_u64 << (B - 1);
    // Undo the turns of the coarser levels on the finer ones.
    let mut bit = top;
    while bit > 1 {
        let below = bit - 1;
        for axis in 0..N {
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
    for axis in 1..N {
        x[axis] ^= x[axis - 1];
    }
    let mut flips = 0;
    bit = top;
    while bit > 1 {
        if x[N - 1] & bit != 0 {
            flips ^= bit - 1;
        }
        bit >>= 1;
    }
    x.map(|coordinate| coordinate ^ flips)
}

/// The cell of a coordinate that is counted in cells; 0 at the lower end of the curve's reach.
fn cell<const B: u32>(coordinate: f64) -> u64 {
    let half = 1_i64 << (B - 1);
    // The conversion of floats to integers saturates.
    let cell = coordinate.floor() as i64;
    (cell.clamp(-half, half - 1) + half).cast_unsigned()
}

/// The bits of three numbers in turn, those of the first one leading.
fn interleaved(numbers: [u64; 3]) -> u128 {
    let low = (1 << 21) - 1;
    let part = |shift: u32| {
        let [a, b, c] = numbers.map(|number| spread(number >> shift & low));
        a << 2 | b << 1 | c
    };
    u128::from(part(21)) << 63 | u128::from(part(0))
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

    /// A square or a cube of cells at a corner of a curve, by position.
    fn cells(
        key: impl Fn(DVec3) -> u128,
        per_metre: f64,
        sides: [i32; 3],
        at: DVec3,
    ) -> BTreeMap<u128, DVec3> {
        let mut cells = BTreeMap::new();
        for x in 0..sides[0] {
            for y in 0..sides[1] {
                for z in 0..sides[2] {
                    let steps = DVec3::new(x.into(), y.into(), z.into());
                    let point = at + (steps + 0.5) / per_metre;
                    cells.insert(key(point), steps);
                }
            }
        }
        cells
    }

    fn check(key: impl Fn(DVec3) -> u128, per_metre: f64, bits: u32, sides: [i32; 3]) {
        let reach = (1_u64 << (bits - 1)) as f64 / per_metre;
        for corner in [
            DVec3::splat(-reach),
            DVec3::ZERO,
            DVec3::new(0.0, -reach, 0.0),
        ] {
            let cells = cells(&key, per_metre, sides, corner);
            let count = sides.iter().product::<i32>().cast_unsigned();
            assert_eq!(
                cells.len(),
                count as usize,
                "every cell has its own position"
            );
            let (first, last) = (cells.keys().next(), cells.keys().last());
            // An aligned square or cube of cells is one piece of the curve.
            let length = first.zip(last).map(|(first, last)| last - first);
            assert_eq!(length, Some(u128::from(count) - 1));
            let steps: Vec<_> = cells.values().collect();
            for pair in steps.windows(2) {
                assert_eq!((*pair[0] - *pair[1]).abs().element_sum(), 1.0);
            }
        }
    }

    #[test]
    fn consecutive_positions_are_neighbours() {
        check(hilbert_key, CELLS_PER_METRE, BITS, [16; 3]);
        let in_plan = |point| u128::from(plan_key(point) >> HEIGHT_BITS);
        check(in_plan, PLAN_CELLS_PER_METRE, PLAN_BITS, [64, 64, 1]);
        let of_squares = |point: DVec3| {
            let place = [point.x, point.y].map(|at| at.floor() as i64);
            u128::from(square_key(place).expect("it is in reach"))
        };
        check(of_squares, 1.0, SQUARE_BITS, [64, 64, 1]);
    }

    #[test]
    fn squares_out_of_reach_have_no_position() {
        let half = 1 << (SQUARE_BITS - 1);
        assert!(square_key([-half, half - 1]).is_some());
        assert_eq!([[half, 0], [0, -half - 1]].map(square_key), [None; 2]);
    }

    #[test]
    fn height_comes_last() {
        let at = |x, y, z| plan_key(DVec3::new(x, y, z));
        assert!(at(5.0, 5.0, -3.0) < at(5.0, 5.0, 8.0));
        assert_eq!(
            at(5.0, 5.0, -3.0) < at(60.0, 5.0, 0.0),
            at(5.0, 5.0, 8.0) < at(60.0, 5.0, -9.0)
        );
    }

    #[test]
    fn points_out_of_reach_are_on_the_border() {
        let far = hilbert_key(DVec3::splat(1e300));
        assert_eq!(far, hilbert_key(DVec3::splat(1e9)));
        assert_ne!(far, hilbert_key(DVec3::splat(1e5)));
        assert!(far < 1 << 126);
    }
}
