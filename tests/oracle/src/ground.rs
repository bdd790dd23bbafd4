//! The solid ground under a building, derived from its mesh alone.

use std::cmp::Ordering;
use std::collections::HashMap;

use crate::aabb::Point;
use crate::determinant::turn;
use crate::exact::rational;
use crate::mesh::{Mesh, Triangle, unbalanced_edges};

/// How far, in metres, above the lowest vertex of its mesh a face or a box still counts as standing
/// at the building's own foot: a centimetre, the rounding of surveyed models. A larger tolerance
/// would claim solid ground under passages with a low floor.
pub const GROUND_TOLERANCE: f64 = 0.01;

/// The walls of the solid ground under a building, from its foot down to the height `down_to`.
///
/// The foot is the set of downward-facing triangles whose vertices all lie within
/// [`GROUND_TOLERANCE`] of the lowest vertex of the mesh. Below every edge of the foot that no other
/// triangle of the foot shares hangs a vertical rectangle of two triangles, facing outward. The
/// result has no top (the foot itself) and no bottom. It is empty for a mesh that is not closed,
/// and below a bottom face that slants by more than the tolerance there is no ground.
#[must_use]
pub fn solid_ground(mesh: &Mesh, down_to: f64) -> Vec<Triangle> {
    let (Some(corners), Some(welded)) = (mesh.corners(), mesh.welded_triangles()) else {
        return Vec::new();
    };
    if !mesh.is_closed() || !down_to.is_finite() {
        return Vec::new();
    }
    let level = rational(Mesh::bounds(&corners).min[2]) + rational(GROUND_TOLERANCE);
    let is_foot = |triangle: &Triangle| {
        let [a, b, c] = *triangle;
        turn(a, b, c, (0, 1)) == Ordering::Less
            && triangle.iter().all(|corner| rational(corner[2]) <= level)
    };
    let foot: Vec<usize> = (0..corners.len())
        .filter(|&i| is_foot(&corners[i]))
        .collect();
    let indices: Vec<[u32; 3]> = foot.iter().map(|&i| welded[i]).collect();
    let positions: HashMap<u32, Point> = foot
        .iter()
        .flat_map(|&i| welded[i].into_iter().zip(corners[i]))
        .collect();
    unbalanced_edges(&indices)
        .iter()
        .filter_map(|[a, b]| Some((*positions.get(a)?, *positions.get(b)?)))
        .filter(|(a, b)| a[2] > down_to && b[2] > down_to)
        .flat_map(|(a, b)| {
            let (below_a, below_b) = ([a[0], a[1], down_to], [b[0], b[1], down_to]);
            [[a, b, below_b], [a, below_b, below_a]]
        })
        .collect()
}
