//! The sheet that maps are drawn on: the map on the left, what explains it in a column on the right.

use super::PictureScene;
use super::legend::{Legend, Row};
use super::palette;
use super::plan::{Map, PlanView};
use super::shapes::{draw_polygon, fill_rect};
use super::text::{Style, Weight};
use crate::error::{Error, Result};
use tiny_skia::Pixmap;

/// The longest side of a plan in pixels.
const LARGEST: u32 = 16_384;

/// The part of the whole width that the legend takes, with bounds in units.
const LEGEND_SHARE: f32 = 0.24;

/// Height of the north arrow with its letter, in units.
const NORTH: f32 = 40.0;

/// A picture with a map in it.
pub(super) struct Sheet {
    pub(super) pixmap: Pixmap,
    pub(super) map: Map,
    /// Pixels to the typographic point.
    pub(super) unit: f32,
}

/// What is left free in the column on the right: an upper left corner and a size in pixels.
pub(super) struct Room {
    pub(super) at: [f32; 2],
    pub(super) size: [f32; 2],
}

impl Sheet {
    /// Paper, and where what is on it.
    ///
    /// # Errors
    /// [`Error::View`] as [`super::plan`].
    pub(super) fn new(scene: &PictureScene, view: &PlanView) -> Result<Self> {
        let PlanView { width, height, .. } = *view;
        let mut pixmap = (width.max(height) <= LARGEST)
            .then(|| Pixmap::new(width, height))
            .flatten()
            .ok_or_else(|| Error::View(format!("a plan of {width} x {height} pixels")))?;
        let unit = unit(width, height);
        let legend_width = (LEGEND_SHARE * width as f32).clamp(150.0 * unit, 290.0 * unit);
        let map_width = (width as f32 - legend_width).max(1.0);
        let map = Map::new(scene, view, [map_width, height as f32])?;
        pixmap.fill(palette::PAPER.alpha(1.0));
        Ok(Self { pixmap, map, unit })
    }

    /// Draws the column on the right, over what of the map goes beyond its edge: the legend, the
    /// scale bar, the north arrow and the attribution. Returns what is free between.
    pub(super) fn draw_side(&mut self, scene: &PictureScene, rows: Vec<Row>) -> Room {
        let Self { pixmap, map, unit } = self;
        let unit = *unit;
        let [left, height] = map.size;
        let width = pixmap.width() as f32 - left;
        fill_rect(pixmap, [left, 0.0], [width, height], palette::WHITE, 1.0);
        fill_rect(
            pixmap,
            [left, 0.0],
            [unit.max(1.0), height],
            palette::RULE,
            1.0,
        );
        let pad = 20.0 * unit;
        let (x, inner) = (left + pad, width - 2.0 * pad);
        let legend = Legend::new(scene, rows, unit, inner);
        legend.draw(pixmap, x, pad);
        let attribution = height - pad - legend.attribution_height();
        legend.draw_attribution(pixmap, x, attribution);
        let bar = attribution - 26.0 * unit;
        draw_scale_bar(pixmap, map, [x, bar], inner - 40.0 * unit, unit);
        let north = bar - NORTH * unit;
        draw_north(pixmap, [x + inner - 10.0 * unit, bar], unit);
        let top = pad + legend.height();
        Room {
            at: [x, top],
            size: [inner, (north - pad - top).max(0.0)],
        }
    }
}

/// Pixels to the typographic point: text keeps its share of the picture.
pub(crate) fn unit(width: u32, height: u32) -> f32 {
    (width as f32 / 1280.0)
        .min(height as f32 / 800.0)
        .clamp(0.4, 8.0)
}

/// A bar of 1, 2 or 5 times a power of ten metres, at most `room` pixels long.
fn draw_scale_bar(pixmap: &mut Pixmap, map: &Map, [x, y]: [f32; 2], room: f32, unit: f32) {
    let metres = round_length(f64::from(room) / map.pixels_a_metre);
    let length = (metres * map.pixels_a_metre) as f32;
    fill_rect(pixmap, [x, y], [length, 4.0 * unit], palette::INK, 1.0);
    fill_rect(
        pixmap,
        [x + length / 2.0, y + unit],
        [length / 2.0 - unit, 2.0 * unit],
        palette::WHITE,
        1.0,
    );
    let style = Style {
        size: 12.0 * unit,
        weight: Weight::Regular,
        color: palette::INK,
    };
    style.draw(pixmap, &length_label(metres), x, y - 6.0 * unit);
}

/// The largest of 1, 2, 5 times a power of ten that is not above `most`.
fn round_length(most: f64) -> f64 {
    let power = 10.0_f64.powf(most.log10().floor());
    [5.0, 2.0]
        .into_iter()
        .map(|step| step * power)
        .find(|&length| length <= most)
        .unwrap_or(power)
}

fn length_label(metres: f64) -> String {
    match metres {
        m if m >= 1000.0 => format!("{} km", m / 1000.0),
        m if m >= 1.0 => format!("{m} m"),
        m => format!("{m:.0e} m"),
    }
}

fn draw_north(pixmap: &mut Pixmap, [x, y]: [f32; 2], unit: f32) {
    let tip = y - 24.0 * unit;
    let foot = y + 4.0 * unit;
    let (half, notch) = (7.0 * unit, foot - 6.0 * unit);
    draw_polygon(
        pixmap,
        &[[x, tip], [x - half, foot], [x, notch]],
        palette::INK,
    );
    draw_polygon(
        pixmap,
        &[[x, tip], [x + half, foot], [x, notch]],
        palette::FADED_INK,
    );
    let style = Style {
        size: 12.0 * unit,
        weight: Weight::Bold,
        color: palette::INK,
    };
    let half = style.width("N") / 2.0;
    style.draw(pixmap, "N", x - half, tip - 4.0 * unit);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_round() {
        for (most, length) in [
            (1.0, 1.0),
            (4.9, 2.0),
            (99.0, 50.0),
            (100.0, 100.0),
            (700.0, 500.0),
        ] {
            assert!((round_length(most) - length).abs() < 1e-9, "{most}");
        }
        assert_eq!(length_label(2000.0), "2 km");
        assert_eq!(length_label(50.0), "50 m");
    }
}
