//! Convex polygons in the plane, corners anticlockwise.

use glam::DVec2;

use crate::predicates::turn;

/// Corners nearer to each other than this are one, metres: a shorter side would have no direction
/// after rounding. Leaving a corner out of a convex polygon only makes it smaller.
const SHORTEST_SIDE: f64 = 1e-6;

/// A side of a polygon.
#[derive(Clone, Copy, Debug)]
pub struct Side {
    /// Where it begins, going anticlockwise.
    pub corner: DVec2,
    /// Unit vector outwards.
    pub normal: DVec2,
    /// Of its line `normal · p = offset`.
    pub offset: f64,
}

/// Whether a ring turns left at every vertex and goes around once, by exact signs.
pub fn is_strictly_convex(ring: &[DVec2]) -> bool {
    let [first, second, ref others @ ..] = ring[..] else {
        return false;
    };
    let left_everywhere = (0..ring.len()).all(|i| {
        let after = |steps: usize| ring[(i + steps) % ring.len()];
        turn(after(0), after(1), after(2)) > 0.0
    });
    // Seen from the first vertex, the others go by in one direction and within half a turn.
    let in_front = others.iter().all(|&v| turn(first, second, v) > 0.0);
    let in_order = ring[1..]
        .windows(2)
        .all(|pair| turn(first, pair[0], pair[1]) > 0.0);
    !others.is_empty() && left_everywhere && in_front && in_order
}

/// The sides without those that are too short.
pub fn sides(polygon: &[DVec2]) -> Vec<Side> {
    let mut corners: Vec<DVec2> = Vec::with_capacity(polygon.len());
    for &corner in polygon {
        let apart = |other: &DVec2| other.distance(corner) >= SHORTEST_SIDE;
        if corners.iter().all(apart) {
            corners.push(corner);
        }
    }
    (0..corners.len())
        .map(|i| side(corners[i], corners[(i + 1) % corners.len()]))
        .collect()
}

/// The side between two corners.
pub fn side(corner: DVec2, next: DVec2) -> Side {
    let normal = -(next - corner).perp().normalize_or_zero();
    Side {
        corner,
        normal,
        offset: normal.dot(corner),
    }
}

/// The part where `normal · p <= offset`.
pub fn clipped(polygon: &[DVec2], normal: DVec2, offset: f64) -> Vec<DVec2> {
    let depth = |p: DVec2| offset - normal.dot(p);
    let mut left = Vec::with_capacity(polygon.len() + 1);
    for (i, &from) in polygon.iter().enumerate() {
        let to = polygon[(i + 1) % polygon.len()];
        let (a, b) = (depth(from), depth(to));
        if a >= 0.0 {
            left.push(from);
        }
        if (a >= 0.0) != (b >= 0.0) {
            left.push(from + (to - from) * (a / (a - b)));
        }
    }
    left
}

/// The polygon less all that is within `margin` of its sides.
pub fn shrunk(polygon: Vec<DVec2>, margin: f64) -> Vec<DVec2> {
    sides(&polygon).iter().fold(polygon, |left, side| {
        clipped(&left, side.normal, side.offset - margin)
    })
}

/// Square metres.
pub fn area(polygon: &[DVec2]) -> f64 {
    let Some(&first) = polygon.first() else {
        return 0.0;
    };
    let doubled: f64 = polygon
        .windows(2)
        .map(|pair| (pair[0] - first).perp_dot(pair[1] - first))
        .sum();
    doubled / 2.0
}
