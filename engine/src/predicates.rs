//! Exact orientation of points: the sign is that of the exact value, whatever the coordinates.

use glam::{DVec2, DVec3};
use robust::{Coord, Coord3D};

/// Positive where `a`, `b`, `c` turn anticlockwise, zero exactly where they are on one line.
pub fn turn(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    let coord = |p: DVec2| Coord { x: p.x, y: p.y };
    robust::orient2d(coord(a), coord(b), coord(c))
}

/// Positive where `point` is on the side from which the triangle turns anticlockwise, zero exactly
/// where it is in the triangle's plane.
pub fn side([a, b, c]: &[DVec3; 3], point: DVec3) -> f64 {
    let coord = |p: DVec3| Coord3D {
        x: p.x,
        y: p.y,
        z: p.z,
    };
    -robust::orient3d(coord(*a), coord(*b), coord(*c), coord(point))
}
