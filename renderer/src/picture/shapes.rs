//! Shapes that the pictures share.

use super::palette::{self, Rgb};
use tiny_skia::{FillRule, Path, PathBuilder, Pixmap, Rect, Stroke, Transform};

/// The mark of the observer: a dark dot with a white ring, `unit` pixels to the point.
pub(crate) fn draw_eye(pixmap: &mut Pixmap, [x, y]: [f32; 2], unit: f32) {
    for (radius, color) in [
        (9.0, palette::INK),
        (7.5, palette::WHITE),
        (5.0, palette::INK),
    ] {
        if let Some(circle) = PathBuilder::from_circle(x, y, radius * unit) {
            fill(pixmap, &circle, color, 1.0);
        }
    }
}

/// Fills a polygon.
pub(crate) fn draw_polygon(pixmap: &mut Pixmap, points: &[[f32; 2]], color: Rgb) {
    let mut path = PathBuilder::new();
    path.move_to(points[0][0], points[0][1]);
    points[1..].iter().for_each(|p| path.line_to(p[0], p[1]));
    path.close();
    if let Some(path) = path.finish() {
        fill(pixmap, &path, color, 1.0);
    }
}

/// Fills the union of a path's loops of one orientation.
pub(crate) fn fill(pixmap: &mut Pixmap, path: &Path, color: Rgb, alpha: f32) {
    pixmap.fill_path(
        path,
        &color.paint(alpha),
        FillRule::Winding,
        Transform::identity(),
        None,
    );
}

/// Draws along a path, `width` pixels wide.
pub(crate) fn stroke(pixmap: &mut Pixmap, path: &Path, color: Rgb, alpha: f32, width: f32) {
    let stroke = Stroke {
        width,
        line_join: tiny_skia::LineJoin::Round,
        ..Default::default()
    };
    pixmap.stroke_path(
        path,
        &color.paint(alpha),
        &stroke,
        Transform::identity(),
        None,
    );
}

/// Fills an upright rectangle.
pub(crate) fn fill_rect(pixmap: &mut Pixmap, at: [f32; 2], size: [f32; 2], color: Rgb, alpha: f32) {
    if let Some(rect) = Rect::from_xywh(at[0], at[1], size[0], size[1]) {
        pixmap.fill_rect(rect, &color.paint(alpha), Transform::identity(), None);
    }
}

/// Fills a rectangle with round corners.
pub(crate) fn fill_round(
    pixmap: &mut Pixmap,
    at: [f32; 2],
    size: [f32; 2],
    radius: f32,
    color: Rgb,
    alpha: f32,
) {
    if let Some(path) = round(at, size, radius) {
        fill(pixmap, &path, color, alpha);
    }
}

/// Draws along a rectangle with round corners.
pub(crate) fn outline_round(
    pixmap: &mut Pixmap,
    at: [f32; 2],
    size: [f32; 2],
    radius: f32,
    color: Rgb,
    width: f32,
) {
    if let Some(path) = round(at, size, radius) {
        stroke(pixmap, &path, color, 1.0, width);
    }
}

fn round([x, y]: [f32; 2], [w, h]: [f32; 2], r: f32) -> Option<Path> {
    let mut path = PathBuilder::new();
    path.move_to(x + r, y);
    for [corner, end] in [
        [[x + w, y], [x + w, y + r]],
        [[x + w, y + h], [x + w - r, y + h]],
        [[x, y + h], [x, y + h - r]],
        [[x, y], [x + r, y]],
    ] {
        let start = path.last_point()?;
        let to_corner = [corner[0] - start.x, corner[1] - start.y];
        let length = to_corner[0].hypot(to_corner[1]).max(r);
        let turn = [
            corner[0] - to_corner[0] * r / length,
            corner[1] - to_corner[1] * r / length,
        ];
        path.line_to(turn[0], turn[1]);
        path.quad_to(corner[0], corner[1], end[0], end[1]);
    }
    path.close();
    path.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn round_corners_are_cut_and_the_rest_is_full() {
        let mut pixmap = Pixmap::new(20, 20).unwrap();
        fill_round(
            &mut pixmap,
            [2.0, 2.0],
            [16.0, 16.0],
            6.0,
            palette::INK,
            1.0,
        );
        let alpha = |x, y| pixmap.pixel(x, y).unwrap().alpha();
        for (x, y) in [(10, 2), (2, 10), (17, 10), (10, 17), (10, 10)] {
            assert_eq!(alpha(x, y), 255, "{x}, {y}");
        }
        for (x, y) in [(2, 2), (17, 2), (2, 17), (17, 17), (0, 10)] {
            assert!(alpha(x, y) < 40, "{x}, {y}");
        }
    }

    #[test]
    fn windings_of_one_orientation_are_united() {
        let mut path = PathBuilder::new();
        path.push_rect(Rect::from_xywh(1.0, 1.0, 6.0, 6.0).unwrap());
        path.push_rect(Rect::from_xywh(3.0, 3.0, 6.0, 6.0).unwrap());
        let mut pixmap = Pixmap::new(10, 10).unwrap();
        fill(&mut pixmap, &path.finish().unwrap(), palette::INK, 1.0);
        assert_eq!(pixmap.pixel(5, 5).unwrap().alpha(), 255);
    }
}
