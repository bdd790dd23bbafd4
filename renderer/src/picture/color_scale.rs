//! Numbers as colours, and the bar that tells which is which.

use super::legend::grouped;
use super::palette::{self, Rgb};
use super::shapes::fill_rect;
use super::sheet::Room;
use super::text::{Style, Weight};
use tiny_skia::Pixmap;

/// Colours of the numbers between two round ones: viridis, by Smith and van der Walt (2015), whose
/// equal steps look equal, to colour-blind readers and in grey too.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ColorScale {
    low: u64,
    high: u64,
    /// Between two ticks.
    step: u64,
}

/// About so many steps between ticks; rounding outwards may add two.
const STEPS: u64 = 7;

/// Sizes of the bar and of what is around it, in units.
const CAPTION: f32 = 14.0;
const CAPTION_LINE: f32 = 28.0;
const CAPTION_ROOM: f32 = 46.0;
const WIDTH: f32 = 18.0;
const HEIGHT: f32 = 260.0;
const TICK: f32 = 5.0;
const NUMBER: f32 = 13.0;

impl ColorScale {
    /// The least scale from a round number to a round number that has these on it.
    pub(super) fn over(numbers: impl IntoIterator<Item = u64>) -> Self {
        let ends = numbers.into_iter().fold(None, |ends, number| {
            let (low, high) = ends.unwrap_or((number, number));
            Some((number.min(low), number.max(high)))
        });
        let (low, high) = ends.unwrap_or_default();
        let step = round_step((high - low).div_ceil(STEPS));
        let low = low / step * step;
        Self {
            low,
            high: (high.div_ceil(step) * step).max(low + step),
            step,
        }
    }

    /// The colour of a number on it.
    pub(super) fn color(&self, number: u64) -> Rgb {
        shade(number.saturating_sub(self.low) as f64 / (self.high - self.low) as f64)
    }

    fn ticks(&self) -> impl Iterator<Item = u64> {
        (self.low..=self.high).step_by(usize::try_from(self.step).unwrap_or(usize::MAX))
    }

    /// Draws it upright, as high as there is room: the caption, the bar, a number at each tick.
    pub(super) fn draw(&self, pixmap: &mut Pixmap, caption: &str, room: &Room, unit: f32) {
        // On whole pixels, where no edge mixes colours.
        let [x, top] = room.at.map(f32::round);
        let style = |size: f32, weight| Style {
            size: size * unit,
            weight,
            color: palette::INK,
        };
        let line = top + CAPTION_LINE * unit;
        style(CAPTION, Weight::Regular).draw(pixmap, caption, x, line);
        let top = (top + CAPTION_ROOM * unit).round();
        let height = (HEIGHT * unit).min(room.at[1] + room.size[1] - top);
        let height = height.floor().max(0.0);
        let width = (WIDTH * unit).round();
        for line in 0..height as u32 {
            let share = 1.0 - (f64::from(line) + 0.5) / f64::from(height);
            let y = top + line as f32;
            fill_rect(pixmap, [x, y], [width, 1.0], shade(share), 1.0);
        }
        let number = style(NUMBER, Weight::Regular);
        for tick in self.ticks() {
            let share = (tick - self.low) as f32 / (self.high - self.low) as f32;
            let y = top + height * (1.0 - share);
            let thick = unit.max(1.0);
            let mark = [x + width, y - thick / 2.0];
            fill_rect(pixmap, mark, [TICK * unit, thick], palette::INK, 1.0);
            let label = grouped(usize::try_from(tick).unwrap_or(usize::MAX));
            let left = x + width + 2.0 * TICK * unit;
            number.draw(pixmap, &label, left, y + NUMBER * unit * 0.36);
        }
    }
}

fn shade(share: f64) -> Rgb {
    let color = colorous::VIRIDIS.eval_continuous(share.clamp(0.0, 1.0));
    Rgb(color.r, color.g, color.b)
}

/// The least of 1, 2, 5 times a power of ten that is not below `least`.
fn round_step(least: u64) -> u64 {
    let powers = (0..19).map(|exponent| 10_u64.pow(exponent));
    let mut steps =
        powers.flat_map(|power| [1, 2, 5].map(|digit: u64| digit.saturating_mul(power)));
    steps.find(|&step| step >= least).unwrap_or(u64::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ticks(numbers: &[u64]) -> Vec<u64> {
        ColorScale::over(numbers.iter().copied()).ticks().collect()
    }

    #[test]
    fn ticks_are_round_and_hold_all_numbers() {
        assert_eq!(ticks(&[23, 187, 40]), [0, 50, 100, 150, 200]);
        assert_eq!(ticks(&[101, 104]), [101, 102, 103, 104]);
        assert_eq!(
            ticks(&[2234, 8100]),
            [2000, 3000, 4000, 5000, 6000, 7000, 8000, 9000]
        );
        // One number, or none, has a scale too.
        assert_eq!(ticks(&[7, 7]), [7, 8]);
        assert_eq!(ticks(&[]), [0, 1]);
    }

    #[test]
    fn more_is_lighter() {
        let scale = ColorScale::over([0, 100]);
        let light = |number| {
            let Rgb(r, g, b) = scale.color(number);
            0.2 * f64::from(r) + 0.7 * f64::from(g) + 0.1 * f64::from(b)
        };
        assert!((0..100).all(|number| light(number) < light(number + 1)));
        assert_eq!(scale.color(0), Rgb(68, 1, 84));
        assert_eq!(scale.color(100), Rgb(253, 231, 37));
    }
}
