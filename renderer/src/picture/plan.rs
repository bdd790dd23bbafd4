//! The plan: the scene from above, north up.

use super::legend::{Shows, rows};
use super::palette::{self, Rgb};
use super::shapes::{draw_eye, draw_polygon, fill, stroke};
use super::sheet::Sheet;
use super::{Area, Image, Observer, PictureFeature, PictureScene, Status, bounds};
use crate::error::{Error, Result};
use tiny_skia::{FillRule, IntRect, Path, PathBuilder, Pixmap, Transform};

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
    let mut sheet = Sheet::new(scene, view)?;
    let Sheet { pixmap, map, unit } = &mut sheet;
    map.draw_streets(pixmap, &scene.streets);
    if let Some(observer) = &scene.observer {
        map.draw_field_of_view(pixmap, observer, *unit);
    }
    map.draw_rectangles(pixmap, &scene.rectangles, *unit);
    map.draw_features(pixmap, &scene.features, *unit);
    if let Some(observer) = &scene.observer {
        map.outline_field_of_view(pixmap, observer, *unit);
        map.draw_observer(pixmap, observer, *unit);
    }
    sheet.draw_side(scene, rows(scene, SHOWS));
    Ok(Image::from_pixmap(sheet.pixmap))
}

/// From metres to pixels.
pub(super) struct Map {
    low: [f64; 2],
    pub(super) pixels_a_metre: f64,
    pub(super) size: [f32; 2],
}

impl Map {
    pub(super) fn new(scene: &PictureScene, view: &PlanView, size: [f32; 2]) -> Result<Self> {
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

    pub(super) fn draw_streets(&self, pixmap: &mut Pixmap, streets: &[Area]) {
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
            self.draw_feature(pixmap, feature, palette::fill(feature.status), unit);
        }
    }

    /// The union of the projected triangles, as one path: no seam shows between them. What of the
    /// outline lies inside is covered by the fill.
    pub(super) fn draw_feature(
        &self,
        pixmap: &mut Pixmap,
        feature: &PictureFeature,
        color: Rgb,
        unit: f32,
    ) {
        let seen = feature.triangles.iter().map(|t| t.map(|[x, y, _]| [x, y]));
        let seen = seen.filter(|triangle| self.shows(triangle));
        if let Some(path) = self.path(seen.filter_map(anticlockwise)) {
            stroke(pixmap, &path, palette::outline(color), 1.0, 1.3 * unit);
            fill(pixmap, &path, color, 1.0);
        }
    }

    /// A ring around a feature, by which it is found where it is small.
    pub(super) fn draw_ring(
        &self,
        pixmap: &mut Pixmap,
        feature: &PictureFeature,
        color: Rgb,
        unit: f32,
    ) {
        let corners = feature.triangles.iter().flatten();
        let Some((low, high)) = bounds(corners.map(|&[x, y, _]| [x, y])) else {
            return;
        };
        let [p, q] = [low, high].map(|corner| self.pixel(corner));
        let radius = (q[0] - p[0]).hypot(q[1] - p[1]) / 2.0 + 6.0 * unit;
        let [x, y] = [0, 1].map(|axis| (p[axis] + q[axis]) / 2.0);
        if let Some(ring) = PathBuilder::from_circle(x, y, radius) {
            stroke(pixmap, &ring, palette::WHITE, 1.0, 5.0 * unit);
            stroke(pixmap, &ring, color, 1.0, 2.5 * unit);
        }
    }

    /// Where a rectangle is, rounded to whole pixels so that no line shows between neighbours;
    /// `None` beside the map, and where it is not finite.
    pub(super) fn rectangle(&self, (a, b): ([f64; 2], [f64; 2])) -> Option<IntRect> {
        let (p, q) = (self.pixel(a), self.pixel(b));
        if !p.iter().chain(&q).all(|c| c.is_finite()) {
            return None;
        }
        let [[left, right], [top, bottom]] = [0, 1].map(|axis| {
            let ends = [p[axis].min(q[axis]), p[axis].max(q[axis])];
            ends.map(|end| end.clamp(0.0, self.size[axis]).round() as i32)
        });
        IntRect::from_ltrb(left, top, right, bottom)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_windings_become_anticlockwise() {
        let [a, b, c] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        assert_eq!(anticlockwise([a, b, c]), Some([a, b, c]));
        assert_eq!(anticlockwise([a, c, b]), Some([a, b, c]));
        assert_eq!(anticlockwise([a, a, c]), None);
        assert_eq!(anticlockwise([a, [f64::NAN; 2], c]), None);
    }
}
