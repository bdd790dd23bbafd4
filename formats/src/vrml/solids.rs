//! Faces of the solid primitives: clauses 6.6, 6.10, 6.13 and 6.48.

use std::f64::consts::{PI, TAU};

use super::faces::Faces;
use super::graph::Node;
use crate::error::Problem;

/// Facets around a cone, a cylinder or a sphere. They have their corners on the true surface and
/// lie inside it, by 1 - cos(pi / 24), 0.9 % of the radius: what they hide, the true solid hides.
const FACETS: usize = 24;

/// Bands of facets of a sphere from pole to pole.
const SPHERE_BANDS: usize = FACETS / 2;

/// A box about the origin.
pub(super) fn add_box(node: &Node<'_>, faces: &mut Faces<'_>) -> Result<(), Problem> {
    let half: [f64; 3] = node.vector("size").map(|size: f64| size.abs() / 2.0);
    let corner = |bits: usize| std::array::from_fn(|i| [-half[i], half[i]][bits >> i & 1]);
    let sides = [
        [0, 4, 6, 2],
        [1, 3, 7, 5],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 2, 3, 1],
        [4, 5, 7, 6],
    ];
    sides
        .iter()
        .try_for_each(|side| faces.add(side.map(corner).to_vec()))
}

/// A cone about the y axis.
pub(super) fn add_cone(node: &Node<'_>, faces: &mut Faces<'_>) -> Result<(), Problem> {
    let half = node.number("height").abs() / 2.0;
    let base = circle(node.number("bottomRadius").abs(), -half);
    if node.is("side") {
        for (a, b) in sides(&base) {
            faces.add(vec![a, b, [0.0, half, 0.0]])?;
        }
    }
    match node.is("bottom") {
        true => faces.add(base.into_iter().rev().collect()),
        false => Ok(()),
    }
}

/// A cylinder about the y axis.
pub(super) fn add_cylinder(node: &Node<'_>, faces: &mut Faces<'_>) -> Result<(), Problem> {
    let (radius, half) = (
        node.number("radius").abs(),
        node.number("height").abs() / 2.0,
    );
    let (bottom, top) = (circle(radius, -half), circle(radius, half));
    if node.is("side") {
        for ((a, b), (d, c)) in sides(&bottom).zip(sides(&top)) {
            faces.add(vec![a, b, c, d])?;
        }
    }
    if node.is("top") {
        faces.add(top)?;
    }
    match node.is("bottom") {
        true => faces.add(bottom.into_iter().rev().collect()),
        false => Ok(()),
    }
}

/// A sphere about the origin.
pub(super) fn add_sphere(node: &Node<'_>, faces: &mut Faces<'_>) -> Result<(), Problem> {
    let radius = node.number("radius").abs();
    let parallel = |band: usize| match band {
        0 => vec![[0.0, -radius, 0.0]; FACETS],
        SPHERE_BANDS => vec![[0.0, radius, 0.0]; FACETS],
        _ => {
            let (sin, cos) = (PI * band as f64 / SPHERE_BANDS as f64).sin_cos();
            circle(radius * sin, -radius * cos)
        }
    };
    for band in 0..SPHERE_BANDS {
        let (lower, upper) = (parallel(band), parallel(band + 1));
        for ((a, b), (d, c)) in sides(&lower).zip(sides(&upper)) {
            // At the poles two of the corners are one, which leaves a triangle.
            faces.add(vec![a, b, c, d])?;
        }
    }
    Ok(())
}

/// Points on a circle about the y axis, anticlockwise as seen from above.
fn circle(radius: f64, y: f64) -> Vec<[f64; 3]> {
    let point = |i: usize| {
        let (sin, cos) = (TAU * i as f64 / FACETS as f64).sin_cos();
        [radius * sin, y, radius * cos]
    };
    (0..FACETS).map(point).collect()
}

/// Each point with the next one, around.
fn sides(points: &[[f64; 3]]) -> impl Iterator<Item = ([f64; 3], [f64; 3])> {
    points
        .iter()
        .copied()
        .zip(points.iter().copied().cycle().skip(1))
}
