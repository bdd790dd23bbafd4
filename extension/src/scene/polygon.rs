//! Polygons, and core's `polygon` as text: `((x,y),(x,y),…)`.

use geo::{Coord, LineString, Polygon, Rect};
use glam::DVec2;

/// A ring as core writes it; the closing vertex is left out.
fn ring_text(ring: &LineString<f64>) -> String {
    let vertices = &ring.0[..ring.0.len().saturating_sub(1)];
    let corners: Vec<DVec2> = vertices.iter().map(|c| DVec2::new(c.x, c.y)).collect();
    corners_text(&corners)
}

/// A ring of corners as core writes it.
pub fn corners_text(corners: &[DVec2]) -> String {
    let points: Vec<String> = corners
        .iter()
        .map(|c| format!("({:?},{:?})", c.x, c.y))
        .collect();
    format!("({})", points.join(","))
}

/// The rings of a polygon as core writes them, the outer one first.
pub fn area_text(area: &Polygon<f64>) -> Vec<String> {
    std::iter::once(area.exterior())
        .chain(area.interiors())
        .map(ring_text)
        .collect()
}

/// The polygon whose rings, the outer one first, core wrote; `None` for other text.
pub fn area(rings: &[String]) -> Option<Polygon<f64>> {
    let mut rings = rings.iter().map(|text| ring(text));
    let outer = rings.next()??;
    Some(Polygon::new(outer, rings.collect::<Option<_>>()?))
}

/// The plan of a box.
pub fn rectangle(bounds: &engine::Box3d) -> Polygon<f64> {
    let corner = |x: f64, y: f64| Coord { x, y };
    Rect::new(
        corner(bounds.min.x, bounds.min.y),
        corner(bounds.max.x, bounds.max.y),
    )
    .to_polygon()
}

fn ring(text: &str) -> Option<LineString<f64>> {
    let numbers: Vec<f64> = text
        .split(['(', ')', ','])
        .filter(|word| !word.is_empty())
        .map(|word| word.parse().ok())
        .collect::<Option<_>>()?;
    let pairs = numbers.chunks_exact(2);
    pairs
        .remainder()
        .is_empty()
        .then(|| pairs.map(|c| Coord { x: c[0], y: c[1] }).collect())
}
