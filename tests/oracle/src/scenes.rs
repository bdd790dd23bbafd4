//! Random points for the tests: a coarse grid, where touching, coplanar and collinear are the rule,
//! in frames from the unit cube to city coordinates and far beyond.

use proptest::prelude::*;

use crate::aabb::{Aabb, Point};
use crate::column::Column;

/// `N` points of one frame.
pub(crate) fn points<const N: usize>() -> impl Strategy<Value = [Point; N]> {
    let frame = prop_oneof![
        4 => Just(([0.0; 3], 1.0, 0.0)),
        2 => Just(([85_000.0, 447_000.0, 1.5], 0.1, 0.0)),
        2 => Just(([85_000.0, 447_000.0, 1.5], 5.0, 2.0)),
        1 => Just(([1e15, -1e15, 1e15], 0.25, 0.0)),
        1 => Just(([0.0; 3], 1e15, 0.0)),
        1 => Just(([0.0; 3], 1e-160, 0.0)),
    ];
    let cells = proptest::array::uniform(proptest::array::uniform3((-3..4i32, -1.0..1.0)));
    (frame, cells).prop_map(
        |((origin, step, noise), cells): (_, [[(i32, f64); 3]; N])| {
            cells.map(|cell| {
                std::array::from_fn(|axis| {
                    let (grid, random) = cell[axis];
                    origin[axis] + f64::from(grid) * step + random * noise
                })
            })
        },
    )
}

/// `cases` cases, with room for inputs that a property does not speak of.
pub(crate) fn cases(cases: u32) -> ProptestConfig {
    ProptestConfig {
        cases,
        max_global_rejects: 1_000_000,
        ..ProptestConfig::default()
    }
}

/// A column around a rectangular hole with its sides at the coordinates of four points, and four
/// boxes that overlap at its corners and whose interiors together are its interior. `None` if two
/// points share a coordinate.
pub(crate) fn ring(points: [Point; 4]) -> Option<(Column, [Aabb; 4])> {
    let sorted = |axis: usize| {
        let mut values = points.map(|point| point[axis]);
        values.sort_by(f64::total_cmp);
        values
    };
    let ([x0, x1, x2, x3], [y0, y1, y2, y3]) = (sorted(0), sorted(1));
    let [bottom, .., top] = sorted(2);
    let outer = vec![[x0, y0], [x3, y0], [x3, y3], [x0, y3]];
    let hole = vec![[x1, y1], [x1, y2], [x2, y2], [x2, y1]];
    let column = Column::new(&[outer, hole], bottom, top, false).ok()?;
    let bar = |west, south, east, north| Aabb::new([west, south, bottom], [east, north, top]);
    let bars = [
        bar(x0, y0, x3, y1),
        bar(x0, y2, x3, y3),
        bar(x0, y0, x1, y3),
        bar(x2, y0, x3, y3),
    ];
    Some((column, bars))
}
