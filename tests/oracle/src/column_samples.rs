//! Points of a column, held against the solid one by one.

use fastrand::Rng;

use crate::aabb::{Point, is_finite};
use crate::column::Column;
use crate::column_check::ColumnFault;
use crate::exact::{Rational, rational, vector};
use crate::mesh::Mesh;
use crate::plane::{Edge, PlanPoint, between, spot};
use crate::solid::Solid;
use crate::test_point::{ExactPoint, TestPoint, halfway, raised};

/// Steps that an edge is cut into where it is sampled: a power of two, so that samples are exact.
const EDGE_STEPS: u32 = 1 << 20;

/// Checks that points of the column are inside the solid that `mesh` bounds or on its surface:
/// every corner, the middle of every edge, and random points, the same for the same `seed`: half
/// of `samples` inside, a quarter on the walls, an eighth each on top and bottom, stratified along
/// y or by the length of walls. Points are of the column exactly; where rounding would put a random
/// one outside, it is left out.
///
/// It shows less than [`check_column`](crate::check_column) and shares nothing with it but the
/// winding number. Returns the fault of every point outside, or that the mesh has no inside.
#[must_use]
pub fn sample_column(mesh: &Mesh, column: &Column, samples: usize, seed: u64) -> Vec<ColumnFault> {
    let Some(solid) = Solid::new(mesh) else {
        return vec![ColumnFault::OpenMesh];
    };
    let mut rng = Rng::with_seed(seed);
    let on_edges = corners_and_middles(column);
    let walls = wall_points(column, samples / 4, &mut rng);
    let exact = on_edges.iter().chain(&walls);
    let mut faults: Vec<ColumnFault> = exact.filter_map(|point| fault(&solid, point)).collect();
    let plain = [
        (samples / 8, [column.top; 2]),
        (samples / 8, [column.bottom; 2]),
        (samples - samples / 2, [column.bottom, column.top]),
    ];
    for (count, heights) in plain {
        let points = (0..count).filter_map(|i| flat_point(column, i, count, heights, &mut rng));
        faults.extend(points.filter_map(|point| fault(&solid, &point)));
    }
    faults
}

/// The fault of a point that is outside.
fn fault(solid: &Solid, point: &impl TestPoint) -> Option<ColumnFault> {
    let winding = solid.winding(point).filter(|winding| *winding < 1)?;
    Some(ColumnFault::PointOutside {
        point: point.nearest(),
        winding,
    })
}

/// Every corner, and the middle of every edge.
fn corners_and_middles(column: &Column) -> Vec<ExactPoint> {
    let at = |[x, y]: PlanPoint, z: f64| [x, y, z];
    let (bottom, top) = (column.bottom, column.top);
    let around = |[u, v]: &Edge| {
        [
            ExactPoint::new(vector(at(*u, bottom))),
            ExactPoint::new(vector(at(*u, top))),
            halfway(at(*u, bottom), at(*u, top)),
            halfway(at(*u, bottom), at(*v, bottom)),
            halfway(at(*u, top), at(*v, top)),
        ]
    };
    column.footprint.edges.iter().flat_map(around).collect()
}

/// One random point in each of `count` strata of equal length along the walls.
fn wall_points(column: &Column, count: usize, rng: &mut Rng) -> Vec<ExactPoint> {
    let edges = &column.footprint.edges;
    let lengths: Vec<f64> = edges
        .iter()
        .map(|[u, v]| (v[0] - u[0]).hypot(v[1] - u[1]))
        .collect();
    let total: f64 = lengths.iter().sum();
    let (mut current, mut before) = (0, 0.0);
    let mut points = Vec::with_capacity(count);
    for stratum in 0..count {
        let along = (stratum as f64 + rng.f64()) / count as f64 * total;
        while current + 1 < edges.len() && before + lengths[current] < along {
            before += lengths[current];
            current += 1;
        }
        let height = random_height([column.bottom, column.top], rng);
        points.push(wall_point(&edges[current], height, rng));
    }
    points
}

/// A random point of a wall at a height.
fn wall_point(&[u, v]: &Edge, height: f64, rng: &mut Rng) -> ExactPoint {
    let at = Rational::from(rng.u32(0..=EDGE_STEPS)) / Rational::from(EDGE_STEPS);
    raised(&between(&spot(u), &spot(v), &at), rational(height))
}

/// A random point of the column between two heights, in one of `count` strata of equal width along
/// y; `None` if rounding puts it outside.
fn flat_point(
    column: &Column,
    stratum: usize,
    count: usize,
    heights: [f64; 2],
    rng: &mut Rng,
) -> Option<Point> {
    let (south, north) = (column.footprint.min[1], column.footprint.max[1]);
    let y = south + (north - south) * ((stratum as f64 + rng.f64()) / count as f64);
    let x = random_abscissa(&column.footprint.edges, y, rng)?;
    let point = [x, y, random_height(heights, rng)];
    (is_finite(point) && column.holds(point)).then_some(point)
}

/// A random x inside the polygon on the line of all points with this y.
fn random_abscissa(edges: &[Edge], y: f64, rng: &mut Rng) -> Option<f64> {
    let mut crossings: Vec<f64> = edges
        .iter()
        .filter(|[u, v]| (u[1] <= y) != (v[1] <= y))
        .map(|[u, v]| u[0] + (v[0] - u[0]) * ((y - u[1]) / (v[1] - u[1])))
        .collect();
    crossings.sort_by(f64::total_cmp);
    let chords = crossings.chunks_exact(2);
    let total: f64 = chords.clone().map(|chord| chord[1] - chord[0]).sum();
    let mut along = rng.f64() * total;
    for chord in chords {
        if along <= chord[1] - chord[0] {
            return Some(chord[0] + along);
        }
        along -= chord[1] - chord[0];
    }
    None
}

/// A random height between two, both included.
fn random_height([bottom, top]: [f64; 2], rng: &mut Rng) -> f64 {
    (bottom + (top - bottom) * rng.f64()).clamp(bottom, top)
}
