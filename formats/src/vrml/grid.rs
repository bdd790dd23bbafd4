//! The grid that positions are written on, about an origin nearby: a position has the same text
//! wherever it is used, so that edges still pair, and fits the 32-bit numbers of other readers.

use std::fmt::Write;

use super::bridge::GridPoint;
use super::frame::to_file;

/// Steps of the grid in a metre. A hundredth of a millimetre is a tenth of the error allowed, and
/// leaves the rest to the 32-bit numbers, which have it up to a kilometre from the origin.
const STEPS: f64 = 1e5;

/// Digits of a step after the point.
const DIGITS: usize = 5;

/// Whole metres below all positions, so that origins themselves are exact in 32-bit numbers; zero
/// where there is none.
pub(super) fn origin(positions: impl Iterator<Item = [f64; 3]>) -> [f64; 3] {
    let lower =
        |low: [f64; 3], position: [f64; 3]| std::array::from_fn(|i| low[i].min(position[i]));
    let low = positions.fold([f64::INFINITY; 3], lower);
    low.map(|c| if c.is_finite() { c.floor() } else { 0.0 })
}

/// A position of the scene, from an origin, on the grid of the file's frame.
pub(super) fn on_grid(position: [f64; 3], origin: [f64; 3]) -> GridPoint {
    let local = std::array::from_fn(|i| position[i] - origin[i]);
    to_file(local).map(|c| (c * STEPS).round() as i64)
}

/// Writes a point of the grid in metres.
pub(super) fn write_point(text: &mut String, point: GridPoint) {
    for (i, steps) in point.into_iter().enumerate() {
        let (metres, rest) = (
            steps.unsigned_abs() / STEPS as u64,
            steps.unsigned_abs() % STEPS as u64,
        );
        let sign = if steps < 0 { "-" } else { "" };
        let blank = if i > 0 { " " } else { "" };
        // Writing to a string cannot fail.
        let _ = write!(text, "{blank}{sign}{metres}");
        if rest != 0 {
            let digits = format!("{rest:0DIGITS$}");
            let _ = write!(text, ".{}", digits.trim_end_matches('0'));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(point: GridPoint) -> String {
        let mut text = String::new();
        write_point(&mut text, point);
        text
    }

    #[test]
    fn points_are_written_as_short_as_they_are_exact() {
        assert_eq!(written([0, -1, 100_000]), "0 -0.00001 1");
        assert_eq!(written([123_456, -250_000, 50]), "1.23456 -2.5 0.0005");
    }

    #[test]
    fn origins_are_whole_metres_below() {
        let positions = [[85_000.7, -1.5, 3.0], [84_999.9, 2.0, 4.0]];
        assert_eq!(origin(positions.into_iter()), [84_999.0, -2.0, 3.0]);
        assert_eq!(origin(std::iter::empty()), [0.0; 3]);
        let point = on_grid(positions[0], [84_999.0, -2.0, 3.0]);
        assert_eq!(point, [170_000, 0, -50_000]);
    }
}
