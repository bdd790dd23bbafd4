//! Features along a space-filling curve.

use engine::Box3d;
use glam::DVec3;

/// Cells a side of the grid that the curve runs through: 2^21, so that three coordinates fit 63 bits.
const CELLS: f64 = (1u64 << 21) as f64;

/// The position of each box along Morton's curve through their centres: a permutation of
/// `0..boxes.len()` (G. M. Morton, "A computer oriented geodetic data base", 1966).
pub fn ranks(boxes: &[Box3d]) -> Vec<usize> {
    let Some(extent) = Box3d::around(boxes.iter().map(Box3d::center)) else {
        return Vec::new();
    };
    let size = extent.size().max_element();
    let mut order: Vec<usize> = (0..boxes.len()).collect();
    order.sort_by_key(|&i| code((boxes[i].center() - extent.min) / size));
    let mut ranks = vec![0; boxes.len()];
    for (rank, position) in order.into_iter().enumerate() {
        ranks[position] = rank;
    }
    ranks
}

/// The cell of a place within the unit cube, its bits interleaved.
fn code(place: DVec3) -> u64 {
    // A cast from NaN or from beyond the range stays within it.
    let cell = (place * CELLS)
        .min(DVec3::splat(CELLS - 1.0))
        .to_array()
        .map(|c| c as u64);
    (0..21).fold(0, |code, bit| {
        let bits = [0, 1, 2].map(|axis| (cell[axis] >> bit & 1) << (3 * bit + axis));
        code | bits[0] | bits[1] | bits[2]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cell(x: f64, y: f64) -> Box3d {
        let min = DVec3::new(85_000.0 + x, 447_000.0 + y, 0.0);
        Box3d::new(min, min + 1.0)
    }

    #[test]
    fn a_square_is_walked_in_a_z() {
        let square = [
            cell(0.0, 0.0),
            cell(9.0, 9.0),
            cell(9.0, 0.0),
            cell(0.0, 9.0),
        ];
        assert_eq!(ranks(&square), [0, 3, 1, 2]);
    }

    #[test]
    fn every_rank_is_given_once() {
        assert!(ranks(&[]).is_empty());
        assert_eq!(ranks(&[cell(1.0, 1.0)]), [0]);
        let mut same = ranks(&[cell(1.0, 1.0); 5]);
        same.sort_unstable();
        assert_eq!(same, [0, 1, 2, 3, 4]);
    }
}
