//! The plan: the scene from above, north up.

use super::legend::{Legend, Shows};
use super::palette::{self, Rgb};
use super::shapes::{draw_eye, fill, fill_rect, stroke};
use super::text::{Style, Weight};
use super::{Area, Image, Observer, PictureFeature, PictureScene, Status};
use crate::error::{Error, Result};
use tiny_skia::{FillRule, Path, PathBuilder, Pixmap, Transform};

/// Size and extent of a plan.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlanView {
    /// Pixels across, the legend included.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Opposite corners of what to show in metres; `None` for the whole scene. Grown along one
    /// axis to the shape of the picture.
    pub window: Option<([f64; 2], [f64; 2])>,
}

/// The longest side of a plan in pixels.
const LARGEST: u32 = 16_384;

/// The part of the whole width that the legend takes, with bounds in units.
const LEGEND_SHARE: f32 = 0.24;

/// What a plan shows.
const SHOWS: Shows = Shows {
    street: palette::STREET,
    rectangles: true,
    observer: true,
    columns: false,
};

/// Free space around the whole scene, as a part of its size.
const MARGIN: f64 = 0.02;

/// Draws the scene from above: streets, field of view, occlusion volumes, footprints in the colour
/// of their status, the observer; beside it the legend, a scale bar and the attribution.
///
/// # Errors
/// [`Error::View`] for a picture without pixels or with more than 16,384 along a side, and for a
/// window that is empty or not finite.
pub fn plan(scene: &PictureScene, view: &PlanView) -> Result<Image> {
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
    map.draw_streets(&mut pixmap, &scene.streets);
    if let Some(observer) = &scene.observer {
        map.draw_field_of_view(&mut pixmap, observer, unit);
    }
    map.draw_rectangles(&mut pixmap, &scene.rectangles, unit);
    map.draw_features(&mut pixmap, &scene.features, unit);
    if let Some(observer) = &scene.observer {
        map.outline_field_of_view(&mut pixmap, observer, unit);
        map.draw_observer(&mut pixmap, observer, unit);
    }
    draw_side(&mut pixmap, scene, &map, [map_width, legend_width], unit);
    Ok(Image::from_pixmap(pixmap))
}

/// Pixels to the typographic point: text keeps its share of the picture.
pub(crate) fn unit(width: u32, height: u32) -> f32 {
    (width as f32 / 1280.0)
        .min(height as f32 / 800.0)
        .clamp(0.4, 8.0)
}

/// From metres to pixels.
struct Map {
    low: [f64; 2],
    pixels_a_metre: f64,
    size: [f32; 2],
}

impl Map {
    fn new(scene: &PictureScene, view: &PlanView, size: [f32; 2]) -> Result<Self> {
        let (a, b) = view
            .window
            .or_else(|| with_margin(scene))
            .unwrap_or(([0.0; 2], [1.0; 2]));
        let extent = [0, 1].map(|axis| (b[axis] - a[axis]).abs());
        if !extent.iter().all(|&side| side > 0.0 && side.is_finite()) {
            return Err(Error::View(format!("a window from {a:?} to {b:?}")));
        }
        let [across, down] = size.map(f64::from);
        let pixels_a_metre = (across / extent[0]).min(down / extent[1]);
        let low = [(0, across), (1, down)]
            .map(|(axis, side)| (a[axis] + b[axis] - side / pixels_a_metre) / 2.0);
        Ok(Self {
            low,
            pixels_a_metre,
            size,
        })
    }

    fn pixel(&self, [x, y]: [f64; 2]) -> [f32; 2] {
        let right = (x - self.low[0]) * self.pixels_a_metre;
        let up = (y - self.low[1]) * self.pixels_a_metre;
        [right as f32, self.size[1] - up as f32]
    }

    /// A closed loop; nothing when a point is not finite.
    fn push_ring(&self, path: &mut PathBuilder, ring: impl IntoIterator<Item = [f64; 2]>) {
        let points: Vec<[f32; 2]> = ring.into_iter().map(|p| self.pixel(p)).collect();
        if points.len() < 3 || !points.iter().flatten().all(|c| c.is_finite()) {
            return;
        }
        path.move_to(points[0][0], points[0][1]);
        points[1..].iter().for_each(|p| path.line_to(p[0], p[1]));
        path.close();
    }

    fn path<R: IntoIterator<Item = [f64; 2]>>(
        &self,
        rings: impl Iterator<Item = R>,
    ) -> Option<Path> {
        let mut path = PathBuilder::new();
        rings.for_each(|ring| self.push_ring(&mut path, ring));
        path.finish()
    }

    fn draw_streets(&self, pixmap: &mut Pixmap, streets: &[Area]) {
        let paths: Vec<Path> = streets
            .iter()
            .filter_map(|street| self.street(street))
            .collect();
        // Edges first: where streets meet, no line is left between them.
        paths
            .iter()
            .for_each(|path| stroke(pixmap, path, palette::STREET_EDGE, 1.0, 1.5));
        for path in &paths {
            let paint = palette::STREET.paint(1.0);
            pixmap.fill_path(path, &paint, FillRule::EvenOdd, Transform::identity(), None);
        }
    }

    fn street(&self, street: &Area) -> Option<Path> {
        let rings = std::iter::once(&street.exterior).chain(&street.holes);
        self.path(rings.map(|ring| ring.iter().copied()))
    }

    fn draw_field_of_view(&self, pixmap: &mut Pixmap, observer: &Observer, unit: f32) {
        if let Some(path) = self.path(std::iter::once(observer.field_of_view())) {
            fill(
                pixmap,
                &path,
                palette::FIELD_OF_VIEW,
                palette::FIELD_OF_VIEW_ALPHA,
            );
            stroke(pixmap, &path, palette::FIELD_OF_VIEW_EDGE, 0.9, 1.2 * unit);
        }
    }

    fn outline_field_of_view(&self, pixmap: &mut Pixmap, observer: &Observer, unit: f32) {
        if let Some(path) = self.path(std::iter::once(observer.field_of_view())) {
            stroke(pixmap, &path, palette::FIELD_OF_VIEW_EDGE, 0.55, 1.2 * unit);
        }
    }

    fn draw_rectangles(&self, pixmap: &mut Pixmap, all: &[([f64; 2], [f64; 2])], unit: f32) {
        for &(a, b) in all {
            let ring = [a, [b[0], a[1]], b, [a[0], b[1]]];
            if let Some(path) = self.path(std::iter::once(ring)) {
                fill(pixmap, &path, palette::RECTANGLE, palette::RECTANGLE_ALPHA);
                stroke(pixmap, &path, palette::RECTANGLE, 0.45, 0.8 * unit);
            }
        }
    }

    /// Grey ones first, so that they never cover an answer.
    fn draw_features(&self, pixmap: &mut Pixmap, features: &[PictureFeature], unit: f32) {
        let (outside, inside): (Vec<_>, Vec<_>) = features
            .iter()
            .partition(|feature| feature.status == Status::Outside);
        for feature in outside.into_iter().chain(inside) {
            self.draw_feature(pixmap, feature, unit);
        }
    }

    /// The union of the projected triangles, as one path: no seam shows between them. What of the
    /// outline lies inside is covered by the fill.
    fn draw_feature(&self, pixmap: &mut Pixmap, feature: &PictureFeature, unit: f32) {
        let seen = feature.triangles.iter().map(|t| t.map(|[x, y, _]| [x, y]));
        let seen = seen.filter(|triangle| self.shows(triangle));
        if let Some(path) = self.path(seen.filter_map(anticlockwise)) {
            stroke(
                pixmap,
                &path,
                palette::outline(palette::fill(feature.status)),
                1.0,
                1.3 * unit,
            );
            fill(pixmap, &path, palette::fill(feature.status), 1.0);
        }
    }

    /// False for a triangle beside the map.
    fn shows(&self, triangle: &[[f64; 2]; 3]) -> bool {
        let pixels = triangle.map(|corner| self.pixel(corner));
        [0, 1].iter().all(|&axis| {
            pixels.iter().any(|p| p[axis] > -2.0)
                && pixels.iter().any(|p| p[axis] < self.size[axis] + 2.0)
        })
    }

    fn draw_observer(&self, pixmap: &mut Pixmap, observer: &Observer, unit: f32) {
        let [x, y, _] = observer.eye;
        let at = self.pixel([x, y]);
        if !observer.is_all_round() {
            let (sin, cos) = (observer.heading.to_radians() as f32).sin_cos();
            let along = |forward: f32, right: f32| {
                let (f, r) = (forward * unit, right * unit);
                [at[0] + f * sin + r * cos, at[1] - f * cos + r * sin]
            };
            draw_polygon(
                pixmap,
                &[along(25.0, 0.0), along(9.0, -7.0), along(9.0, 7.0)],
                palette::INK,
            );
        }
        draw_eye(pixmap, at, unit);
    }
}

/// A triangle turned anticlockwise; `None` for one that is upright, hence a line from above.
fn anticlockwise([a, b, c]: [[f64; 2]; 3]) -> Option<[[f64; 2]; 3]> {
    let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    match area.partial_cmp(&0.0)? {
        std::cmp::Ordering::Greater => Some([a, b, c]),
        std::cmp::Ordering::Less => Some([a, c, b]),
        std::cmp::Ordering::Equal => None,
    }
}

fn with_margin(scene: &PictureScene) -> Option<([f64; 2], [f64; 2])> {
    let (low, high) = scene.bounds()?;
    let margin = MARGIN * (high[0] - low[0]).max(high[1] - low[1]).max(1.0);
    Some((low.map(|c| c - margin), high.map(|c| c + margin)))
}

fn draw_polygon(pixmap: &mut Pixmap, points: &[[f32; 2]], color: Rgb) {
    let mut path = PathBuilder::new();
    path.move_to(points[0][0], points[0][1]);
    points[1..].iter().for_each(|p| path.line_to(p[0], p[1]));
    path.close();
    if let Some(path) = path.finish() {
        fill(pixmap, &path, color, 1.0);
    }
}

/// The legend's column on the right, with the scale bar, the north arrow and the attribution.
fn draw_side(
    pixmap: &mut Pixmap,
    scene: &PictureScene,
    map: &Map,
    [left, width]: [f32; 2],
    unit: f32,
) {
    let height = pixmap.height() as f32;
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
    let legend = Legend::new(scene, SHOWS, unit, inner);
    legend.draw(pixmap, x, pad);
    let attribution = height - pad - legend.attribution_height();
    legend.draw_attribution(pixmap, x, attribution);
    let bar = attribution - 26.0 * unit;
    draw_scale_bar(pixmap, map, [x, bar], inner - 40.0 * unit, unit);
    draw_north(pixmap, [x + inner - 10.0 * unit, bar], unit);
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

    #[test]
    fn both_windings_become_anticlockwise() {
        let [a, b, c] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        assert_eq!(anticlockwise([a, b, c]), Some([a, b, c]));
        assert_eq!(anticlockwise([a, c, b]), Some([a, b, c]));
        assert_eq!(anticlockwise([a, a, c]), None);
        assert_eq!(anticlockwise([a, [f64::NAN; 2], c]), None);
    }
}
