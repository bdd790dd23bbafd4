//! How much of a solid its columns hold, by sampling.

use fastrand::Rng;

use crate::aabb::{Aabb, Point};
use crate::column::Column;
use crate::mesh::Mesh;
use crate::solid::Solid;

/// Estimated volumes in cubic metres.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SolidVolumes {
    /// Of the solid that a mesh bounds; what its shells share counts once.
    pub solid: f64,
    /// Of the part of it that some column holds, without ground.
    pub in_columns: f64,
}

/// Estimates the volume of the solid that `mesh` bounds and of what `columns` hold of it, by one
/// random point in each of about `samples` equal cells of the box around the mesh; the same for the
/// same `seed`. Whether a point is inside is exact. `None` if the mesh is not closed.
#[must_use]
pub fn sample_volumes(
    mesh: &Mesh,
    columns: &[Column],
    samples: usize,
    seed: u64,
) -> Option<SolidVolumes> {
    let solid = Solid::new(mesh)?;
    let mut rng = Rng::with_seed(seed);
    let bounds = solid.bounds();
    let counts = cells(&bounds, samples);
    let [width, depth, height] = extent(&bounds);
    let cell = width * depth * height / counts.iter().product::<usize>() as f64;
    let mut volumes = SolidVolumes::default();
    for index in 0..counts.iter().product() {
        let point = random_point(&bounds, counts, index, &mut rng);
        if solid.winding(&point).is_some_and(|winding| winding >= 1) {
            volumes.solid += cell;
            if columns.iter().any(|column| column.holds(point)) {
                volumes.in_columns += cell;
            }
        }
    }
    Some(volumes)
}

fn extent(bounds: &Aabb) -> Point {
    std::array::from_fn(|axis| bounds.max[axis] - bounds.min[axis])
}

/// How many cells along each axis make about `samples` in all, as near to cubes as can be.
fn cells(bounds: &Aabb, samples: usize) -> [usize; 3] {
    let sides = extent(bounds);
    let mut left = samples.max(1);
    let mut counts = [1; 3];
    let mut axes = [0, 1, 2];
    axes.sort_by(|&i, &j| sides[i].total_cmp(&sides[j]));
    for (done, &axis) in axes.iter().enumerate() {
        let rest: f64 = axes[done..]
            .iter()
            .map(|&i| sides[axis] / sides[i])
            .product();
        let share = (left as f64 * rest).powf(1.0 / (3 - done) as f64);
        // A flat side divides by zero; it takes one cell.
        counts[axis] = (share.round() as usize).clamp(1, left);
        left /= counts[axis];
    }
    counts
}

/// A random point in one of the cells.
fn random_point(bounds: &Aabb, counts: [usize; 3], index: usize, rng: &mut Rng) -> Point {
    let sides = extent(bounds);
    let cell = [
        index % counts[0],
        index / counts[0] % counts[1],
        index / counts[0] / counts[1],
    ];
    std::array::from_fn(|axis| {
        let along = (cell[axis] as f64 + rng.f64()) / counts[axis] as f64;
        bounds.min[axis] + sides[axis] * along
    })
}
