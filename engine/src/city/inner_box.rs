//! The largest axis-aligned rectangle inside a footprint.

use glam::{DVec2, I64Vec2};

use super::lattice::{edges, left_or_on};
use super::strip::Strip;

/// Least and greatest corner of the largest axis-aligned rectangle found in the footprint.
///
/// A wing of a bent footprint holds the box around its own quadrilateral, since the corners of
/// generated footprints are square; a rectangle that is turned is searched for the largest box.
pub fn largest_rectangle(footprint: &Strip) -> [I64Vec2; 2] {
    let quads = footprint.quads();
    let rectangles = quads.map(|quad| match is_upright(&quad) {
        true => around(&quad),
        false => in_turned(&quad),
    });
    rectangles
        .max_by_key(|[min, max]| (max - min).element_product())
        .unwrap_or_default()
}

/// Whether the outer edge runs along an axis.
fn is_upright(quad: &[I64Vec2; 4]) -> bool {
    let edge = quad[1] - quad[0];
    edge.x == 0 || edge.y == 0
}

fn around(quad: &[I64Vec2; 4]) -> [I64Vec2; 2] {
    let [a, b, c, d] = *quad;
    [a.min(b).min(c).min(d), a.max(b).max(c).max(d)]
}

/// The largest axis-aligned rectangle in a turned one, all of it off the edges.
fn in_turned(quad: &[I64Vec2; 4]) -> [I64Vec2; 2] {
    let [a, b, c, d] = *quad;
    let center = (a + c).as_dvec2() / 2.0;
    let half = largest_size((b - a).as_dvec2(), (d - a).as_dvec2()) / 2.0;
    let mut min = (center - half).ceil().as_i64vec2();
    let mut max = (center + half).floor().as_i64vec2();
    // Rounding may have put a corner on an edge or outside; the centre is far from all edges.
    while !is_within(quad, min, max) {
        min += 1;
        max -= 1;
    }
    [min, max]
}

/// Size of the largest axis-aligned rectangle in a rectangle with these two edges.
///
/// Either two opposite corners touch the long edges, or all four touch the four edges.
fn largest_size(one: DVec2, other: DVec2) -> DVec2 {
    let (long, short) = if one.length_squared() >= other.length_squared() {
        (one, other)
    } else {
        (other, one)
    };
    let (width, height) = (long.length(), short.length());
    let direction = long.abs() / width;
    let (cosine, sine) = (direction.x, direction.y);
    let double_cosine = cosine * cosine - sine * sine;
    if height <= 2.0 * sine * cosine * width || double_cosine == 0.0 {
        return DVec2::new(0.5 * height / sine, 0.5 * height / cosine);
    }
    DVec2::new(
        (width * cosine - height * sine) / double_cosine,
        (height * cosine - width * sine) / double_cosine,
    )
}

/// Whether the rectangle's corners lie inside the quadrilateral, none on an edge.
fn is_within(quad: &[I64Vec2; 4], min: I64Vec2, max: I64Vec2) -> bool {
    let corners = [
        min,
        I64Vec2::new(max.x, min.y),
        max,
        I64Vec2::new(min.x, max.y),
    ];
    edges(quad).all(|(from, to)| corners.iter().all(|&corner| !left_or_on(to, from, corner)))
}
