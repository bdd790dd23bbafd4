//! Where observers stand.

use fastrand::Rng;

use crate::kind::{between, whole};
use crate::plan::{Column, Feature, Place};
use crate::scene::Scene;

/// A random eye in a scene.
pub fn random_eye(rng: &mut Rng, scene: &Scene) -> [f64; 3] {
    if let Some([x, y]) = scene.eye
        && rng.u8(..4) != 0
    {
        return [x, y, between(rng, 0.0, 2.0)];
    }
    let features = &scene.features;
    let with_columns: Vec<&Feature> = features
        .iter()
        .filter(|feature| !feature.columns.is_empty())
        .collect();
    if with_columns.is_empty() {
        return [0.0, 0.0, 1.75];
    }
    let feature = with_columns[rng.usize(..with_columns.len())];
    let column = &feature.columns[rng.usize(..feature.columns.len())];
    let ring = &column.rings[rng.usize(..column.rings.len())];
    let at = rng.usize(..ring.len());
    let (from, to) = (ring[at], ring[(at + 1) % ring.len()]);
    let [x, y] = in_plan(rng, column, from, to);
    let z = height(rng, column);
    [x, y, z]
}

fn in_plan(rng: &mut Rng, column: &Column, from: Place, to: Place) -> Place {
    let on_line = |share: f64| [0, 1].map(|axis| from[axis] + (to[axis] - from[axis]) * share);
    let length = (to[0] - from[0]).hypot(to[1] - from[1]).max(1e-9);
    let out = [(to[1] - from[1]) / length, (from[0] - to[0]) / length];
    let beside = |[x, y]: Place, distance: f64| [x + out[0] * distance, y + out[1] * distance];
    match rng.u8(..20) {
        // On a wall, and at a corner.
        0 => on_line(0.5),
        1 => on_line(rng.f64()),
        2 => from,
        // On the line of a wall, exactly where coordinates allow.
        3 => on_line(whole(rng, -3, 4)),
        4 => on_line(2.0 * between(rng, -3.0, 4.0).round() + 0.5),
        // Next to that line.
        5 => {
            let share = between(rng, -4.0, 5.0);
            let distance =
                [1e-3, 1e-4, 1e-6, 1e-9, -1e-3, -1e-4, -1e-6, -1e-9, 0.01][rng.usize(..9)];
            beside(on_line(share), distance)
        }
        // In front of a wall: within a margin and a little more.
        6 => {
            let share = rng.f64();
            beside(
                on_line(share),
                [5e-4, 9.9e-4, 1.01e-3, 2e-3, 0.05, 0.3][rng.usize(..6)],
            )
        }
        7 => beside(
            from,
            [5e-4, 9.9e-4, 1.01e-3, 2e-3, 0.05, 0.3][rng.usize(..6)],
        ),
        8 | 9 => {
            let share = rng.f64();
            beside(on_line(share), between(rng, 0.0, 4.0))
        }
        // Somewhere over or under the column, or in its courtyard.
        10..=12 => {
            let outer = &column.rings[rng.usize(..column.rings.len())];
            let opposite = outer[outer.len() / 2];
            let (u, v) = (rng.f64(), rng.f64());
            [
                outer[0][0] + (opposite[0] - outer[0][0]) * u,
                outer[0][1] + (opposite[1] - outer[0][1]) * v,
            ]
        }
        // Whole and half steps from a corner.
        13..=15 => [from[0] + whole(rng, -8, 8), from[1] + whole(rng, -8, 8)],
        16 => [
            from[0] + whole(rng, -16, 16) / 2.0,
            from[1] + whole(rng, -16, 16) / 2.0,
        ],
        // Far outside.
        17 => {
            let distance = [60.0, 500.0, 4000.0][rng.usize(..3)];
            let azimuth = between(rng, 0.0, std::f64::consts::TAU);
            [
                from[0] + distance * azimuth.cos(),
                from[1] + distance * azimuth.sin(),
            ]
        }
        _ => [
            from[0] + between(rng, -12.0, 12.0),
            from[1] + between(rng, -12.0, 12.0),
        ],
    }
}

fn height(rng: &mut Rng, column: &Column) -> f64 {
    let (bottom, top) = (column.bottom, column.top);
    match rng.u8(..20) {
        // At roofs, just above and just below.
        0 => top,
        1 => top + [1e-9, 5e-4, 1.1e-3, 0.01, 0.5][rng.usize(..5)],
        2 => top - [1e-9, 5e-4, 1.1e-3, 0.01, 0.5][rng.usize(..5)],
        3 => top + 1.75,
        4 => top + between(rng, 0.0, 30.0),
        // At feet and decks.
        5 => bottom,
        6 => bottom - between(rng, 0.0, 2.0),
        7 => between(rng, bottom, top),
        8 => whole(rng, 0, 8),
        9 => -1.0,
        10..=12 => bottom + 0.5,
        13 => between(rng, 0.0, 4.0),
        _ => 1.75,
    }
}
