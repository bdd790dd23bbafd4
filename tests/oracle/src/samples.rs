//! Points on the surface of a feature, to aim rays at.

use std::collections::HashSet;

use fastrand::Rng;

use crate::aabb::{Point, is_finite};
use crate::determinant::subtract;
use crate::mesh::Triangle;

/// How far, in metres, samples at a vertex or an edge are pulled towards the centroid of their
/// triangle: far enough from the silhouette that rounding does not decide, near enough that what
/// peeks over a roof is seen.
pub const SAMPLE_INSET: f64 = 0.001;

/// `n` points on `triangles`, the surface of one feature; the same for the same `seed`.
///
/// Where the surface is rich enough, an eighth each lies a millimetre from the highest vertices, a
/// millimetre from vertices all over, a millimetre from the middles of edges, and at centroids; the
/// rest is random, stratified by area. Points are rounded to `f64` and not moved otherwise, so they
/// lie on the surface up to rounding, on either side of it. Triangles with a coordinate that is not
/// finite are passed over; without any other the result is empty.
#[must_use]
pub fn surface_samples(triangles: &[Triangle], n: usize, seed: u64) -> Vec<Point> {
    let usable: Vec<Triangle> = triangles
        .iter()
        .filter(|triangle| triangle.iter().all(|&corner| is_finite(corner)))
        .copied()
        .collect();
    if usable.is_empty() {
        return Vec::new();
    }
    let share = n / 8;
    let corners = distinct_corners(&usable);
    let mut samples: Vec<Point> = corners.iter().take(share).map(|c| c.inset).collect();
    samples.extend(spread(corners.len(), share).map(|i| corners[i].inset));
    samples.extend(spread(3 * usable.len(), share).map(|i| near_edge(&usable[i / 3], i % 3)));
    samples.extend(spread(usable.len(), share).map(|i| centroid(&usable[i])));
    let rest = n - samples.len();
    samples.extend(stratified(&usable, rest, &mut Rng::with_seed(seed)));
    samples
}

/// A vertex of the surface and the sample beside it.
struct Corner {
    vertex: Point,
    inset: Point,
}

/// Every vertex once, the highest first.
fn distinct_corners(triangles: &[Triangle]) -> Vec<Corner> {
    let mut seen = HashSet::new();
    let mut corners: Vec<Corner> = triangles
        .iter()
        .flat_map(|triangle| {
            triangle.map(|vertex| Corner {
                vertex,
                inset: pulled_in(vertex, triangle),
            })
        })
        .filter(|corner| seen.insert(corner.vertex.map(f64::to_bits)))
        .collect();
    corners.sort_by(|a, b| b.vertex[2].total_cmp(&a.vertex[2]));
    corners
}

/// At most `count` positions out of `len`, evenly spread.
fn spread(len: usize, count: usize) -> impl Iterator<Item = usize> {
    let count = count.min(len);
    (0..count).map(move |i| i * len / count)
}

fn near_edge(triangle: &Triangle, edge: usize) -> Point {
    let (a, b) = (triangle[edge], triangle[(edge + 1) % 3]);
    pulled_in(
        std::array::from_fn(|axis| 0.5 * a[axis] + 0.5 * b[axis]),
        triangle,
    )
}

/// `point` moved by the inset, or half of the way, towards the centroid.
fn pulled_in(point: Point, triangle: &Triangle) -> Point {
    let way = subtract(centroid(triangle), point);
    let distance = length(way);
    if distance == 0.0 {
        return point;
    }
    let step = (SAMPLE_INSET / distance).min(0.5);
    std::array::from_fn(|axis| point[axis] + step * way[axis])
}

fn centroid([a, b, c]: &Triangle) -> Point {
    std::array::from_fn(|axis| a[axis] / 3.0 + b[axis] / 3.0 + c[axis] / 3.0)
}

/// One random point in each of `count` strata of equal area.
fn stratified(triangles: &[Triangle], count: usize, rng: &mut Rng) -> Vec<Point> {
    let mut areas: Vec<f64> = triangles.iter().map(area).collect();
    if areas.iter().sum::<f64>() == 0.0 {
        areas.fill(1.0);
    }
    let total: f64 = areas.iter().sum();
    let mut samples = Vec::with_capacity(count);
    let (mut current, mut before) = (0, 0.0);
    for stratum in 0..count {
        let along = (stratum as f64 + rng.f64()) / count as f64 * total;
        while current + 1 < areas.len() && before + areas[current] < along {
            before += areas[current];
            current += 1;
        }
        samples.push(random_point(&triangles[current], rng));
    }
    samples
}

/// A point uniform over the triangle (R. Osada et al., "Shape distributions", 2002, section 4.2).
fn random_point([a, b, c]: &Triangle, rng: &mut Rng) -> Point {
    let (root, t) = (rng.f64().sqrt(), rng.f64());
    let weights = [1.0 - root, root * (1.0 - t), root * t];
    std::array::from_fn(|axis| weights[0] * a[axis] + weights[1] * b[axis] + weights[2] * c[axis])
}

fn area([a, b, c]: &Triangle) -> f64 {
    let (u, v) = (subtract(*b, *a), subtract(*c, *a));
    let normal = [(1, 2), (2, 0), (0, 1)].map(|(i, j)| u[i] * v[j] - u[j] * v[i]);
    0.5 * length(normal)
}

fn length([x, y, z]: Point) -> f64 {
    x.hypot(y).hypot(z)
}
