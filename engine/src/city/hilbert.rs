//! The order in which a city grows.

use glam::I64Vec2;

/// Halvings of the square that the curve fills. Even, so that the curve's beginning is the same
/// whatever the number.
const LEVELS: u32 = 16;

/// The cell with a number on Hilbert's curve: consecutive cells are neighbours, and the first 4^k
/// fill a square. D. Hilbert, "Ueber die stetige Abbildung einer Linie auf ein Flächenstück",
/// Mathematische Annalen 38, 1891.
pub fn cell(number: u32) -> I64Vec2 {
    let mut place = I64Vec2::ZERO;
    for level in 0..LEVELS {
        let side = 1 << level;
        let digit = number >> (2 * level);
        let right = i64::from(digit >> 1 & 1);
        let up = i64::from(digit & 1) ^ right;
        if up == 0 {
            if right == 1 {
                place = I64Vec2::splat(side - 1) - place;
            }
            place = I64Vec2::new(place.y, place.x);
        }
        place += side * I64Vec2::new(right, up);
    }
    place
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn consecutive_cells_are_neighbours() {
        for number in 0..5000 {
            let step = (cell(number + 1) - cell(number)).abs();
            assert_eq!(step.x + step.y, 1, "after {number}");
        }
    }

    #[test]
    fn each_power_of_four_fills_a_square() {
        for side in [1, 2, 4, 8, 16, 32] {
            let mut seen = std::collections::BTreeSet::new();
            for number in 0..side * side {
                let at = cell(number);
                assert!(at.min_element() >= 0 && at.max_element() < i64::from(side));
                seen.insert(at.to_array());
            }
            assert_eq!(seen.len(), (side * side) as usize);
        }
    }
}
