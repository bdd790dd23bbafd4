//! Faces of `Extrusion`: clause 6.18.

use super::faces::{Faces, cross, dot, minus};
use super::frame::rotation;
use super::graph::Node;
use crate::error::Problem;

/// Sine of the angle below which three points of a spine count as one line: below it rounding
/// decides where their plane lies.
const COLLINEAR: f64 = 1e-9;

/// Axes x, y and z of the plane that a cross-section lies in; y is along the spine.
type Axes = [[f64; 3]; 3];

/// The sides and the caps of an `Extrusion`.
pub(super) fn add_extrusion(node: &Node<'_>, faces: &mut Faces<'_>) -> Result<(), Problem> {
    let (section, _) = node.numbers("crossSection").as_chunks::<2>();
    let (spine, _) = node.numbers("spine").as_chunks::<3>();
    if section.len() < 2 || spine.len() < 2 {
        return Ok(());
    }
    let (scales, _) = node.numbers("scale").as_chunks::<2>();
    let (orientations, _) = node.numbers("orientation").as_chunks::<4>();
    let axes = all_axes(spine);
    // Where there are fewer scales or orientations than points, the last one goes on.
    let ring = |i: usize| {
        let scale = scales.get(i).or(scales.last()).unwrap_or(&[1.0; 2]);
        let turn = orientations.get(i).or(orientations.last());
        let turn = rotation(*turn.unwrap_or(&[0.0; 4]));
        let place = |[x, z]: &[f64; 2]| {
            let flat = turn.apply([x * scale[0], 0.0, z * scale[1]]);
            let along = |k: usize| {
                (0..3)
                    .map(|axis| flat[axis] * axes[i][axis][k])
                    .sum::<f64>()
            };
            std::array::from_fn(|k| spine[i][k] + along(k))
        };
        section.iter().map(place).collect::<Vec<[f64; 3]>>()
    };
    let begin = ring(0);
    let mut lower = begin.clone();
    for i in 1..spine.len() {
        let upper = ring(i);
        for (low, up) in lower.windows(2).zip(upper.windows(2)) {
            faces.add_quadrangle([low[0], low[1], up[1], up[0]])?;
        }
        lower = upper;
    }
    if node.is("beginCap") {
        faces.add(begin.into_iter().rev().collect())?;
    }
    match node.is("endCap") {
        true => faces.add(lower),
        false => Ok(()),
    }
}

/// The axes at every point of a spine of two points or more.
fn all_axes(spine: &[[f64; 3]]) -> Vec<Axes> {
    let (along, across) = (directions(spine), normals(spine));
    let Some(first) = across.iter().flatten().next() else {
        let whole = along.iter().flatten().next();
        return vec![straight_axes(*whole.unwrap_or(&[0.0, 1.0, 0.0])); spine.len()];
    };
    let (mut y, mut z) = (along.iter().flatten().next().copied(), *first);
    let axes_at = |(along, across): (&Option<[f64; 3]>, &Option<[f64; 3]>)| {
        y = along.or(y);
        let next = across.unwrap_or(z);
        z = if dot(next, z) < 0.0 {
            next.map(|c| -c)
        } else {
            next
        };
        let y = y.unwrap_or([0.0, 1.0, 0.0]);
        [unit(cross(y, z)).unwrap_or([1.0, 0.0, 0.0]), y, z]
    };
    along.iter().zip(&across).map(axes_at).collect()
}

fn is_closed(spine: &[[f64; 3]]) -> bool {
    spine.len() > 2 && spine.first() == spine.last()
}

/// The direction of the spine at each point, from the points beside it; none where these are one.
fn directions(spine: &[[f64; 3]]) -> Vec<Option<[f64; 3]>> {
    let last = spine.len() - 1;
    let direction = |i: usize| match (i == 0 || i == last, is_closed(spine)) {
        (true, true) => unit(minus(spine[1], spine[last - 1])),
        _ => unit(minus(spine[(i + 1).min(last)], spine[i.saturating_sub(1)])),
    };
    (0..=last).map(direction).collect()
}

/// The normal of the plane through each point and those beside it; none where they are in line.
fn normals(spine: &[[f64; 3]]) -> Vec<Option<[f64; 3]>> {
    let last = spine.len() - 1;
    let normal = |before: usize, i: usize, after: usize| {
        let (to, from) = (
            unit(minus(spine[after], spine[i]))?,
            minus(spine[before], spine[i]),
        );
        let normal = cross(to, unit(from)?);
        (dot(normal, normal).sqrt() > COLLINEAR).then(|| unit(normal))?
    };
    let at = |i: usize| match (i == 0 || i == last, is_closed(spine)) {
        (true, true) => normal(last - 1, 0, 1),
        (true, false) if last == 1 => None,
        (true, false) => {
            let inner = if i == 0 { 1 } else { last - 1 };
            normal(inner - 1, inner, inner + 1)
        }
        _ => normal(i - 1, i, i + 1),
    };
    (0..=last).map(at).collect()
}

/// The axes of a straight spine: those of the file, turned the short way so that y is along it.
fn straight_axes(along: [f64; 3]) -> Axes {
    let axis = cross([0.0, 1.0, 0.0], along);
    let sine = dot(axis, axis).sqrt();
    let axis = if sine == 0.0 { [1.0, 0.0, 0.0] } else { axis };
    let turn = rotation([axis[0], axis[1], axis[2], sine.atan2(along[1])]);
    [
        turn.apply([1.0, 0.0, 0.0]),
        along,
        turn.apply([0.0, 0.0, 1.0]),
    ]
}

fn unit(v: [f64; 3]) -> Option<[f64; 3]> {
    let length = dot(v, v).sqrt();
    (length > 0.0 && length.is_finite()).then(|| v.map(|c| c / length))
}
