//! Random points for the tests: a coarse grid, where touching, coplanar and collinear are the rule,
//! in frames from the unit cube to city coordinates and far beyond.

use proptest::prelude::*;

use crate::aabb::Point;

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
