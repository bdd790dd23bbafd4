//! [`prisms`], the proven columns over a piece of a plan.

use std::collections::{HashMap, HashSet};

use geo::Polygon;

use super::cells::Cells;
use super::certificate::Certificate;
use super::outline::{Corner, Outline};
use super::plan::Plan;

/// How far computed corners are pulled inward, metres: a thousand times their rounding at national
/// coordinates, and less than any survey resolves. Doubled while the proof fails.
const PULL: f64 = 4e-6;

/// From this pull on, cells that are not proven are cut out instead, metres.
const MOST_PULL: f64 = 1e-3;

/// A prism narrower than this is dropped, metres: it hides nothing.
const LEAST_WIDTH: f64 = 0.02;

/// A proven column.
pub struct Prism {
    pub footprint: Polygon<f64>,
    pub area: f64,
    pub bottom: f64,
    pub top: f64,
}

/// The prisms over nearly all of a piece of the plan that hangs together: mostly one.
pub fn prisms(
    plan: &Plan,
    triangles: &[usize],
    heights: [f64; 2],
    certificate: &mut Certificate,
) -> Vec<Prism> {
    let Some(outline) = outline(plan, triangles) else {
        return Vec::new();
    };
    let whole = proven(&outline, heights, certificate)
        .or_else(|| proven_with_seams(plan, triangles, &outline, heights, certificate));
    if let Some(whole) = whole {
        return whole.into_iter().collect();
    }
    let parts = parts_between_walls(plan, triangles, heights, certificate);
    let prisms = parts
        .iter()
        .filter_map(|part| self::outline(plan, part))
        .map(|outline| match proven(&outline, heights, certificate) {
            Some(prism) => prism.into_iter().collect(),
            None => shrunk(&outline, heights, certificate),
        });
    prisms
        .collect::<Vec<Vec<Prism>>>()
        .into_iter()
        .flatten()
        .collect()
}

fn outline(plan: &Plan, triangles: &[usize]) -> Option<Outline> {
    let around = triangles.iter().map(|&t| plan.triangles[t]);
    Outline::around(around, |number| plan.corner(number))
}

/// The prism over the outline if it is proven, and nothing if that is too narrow.
fn proven(
    outline: &Outline,
    heights: [f64; 2],
    certificate: &mut Certificate,
) -> Option<Option<Prism>> {
    let straight = outline.straightened()?.pulled(PULL);
    let mut cells = Cells::new(&straight, &[])?;
    cells
        .prove(heights, certificate)
        .then(|| prism(&straight, heights))
}

/// The same with cells that end at the lines of the plan, so that walls between solid and solid
/// run between cells.
fn proven_with_seams(
    plan: &Plan,
    triangles: &[usize],
    outline: &Outline,
    heights: [f64; 2],
    certificate: &mut Certificate,
) -> Option<Option<Prism>> {
    let pulled = outline.pulled(PULL);
    let corners = pulled.rings.iter().flatten();
    let moved: HashMap<usize, Corner> = corners.map(|corner| (corner.number, *corner)).collect();
    let follow = |number| *moved.get(&number).unwrap_or(&plan.corner(number));
    let seams: Vec<_> = inner_edges(plan, triangles)
        .filter(|&(triangle, edge, _)| plan.is_line[triangle][edge])
        .map(|(triangle, edge, _)| plan.edge(triangle, edge).map(follow))
        .collect();
    let mut cells = Cells::new(&pulled, &seams)?;
    cells
        .prove(heights, certificate)
        .then(|| prism(&pulled, heights))
}

/// The piece divided where walls stand.
fn parts_between_walls(
    plan: &Plan,
    triangles: &[usize],
    heights: [f64; 2],
    certificate: &Certificate,
) -> Vec<Vec<usize>> {
    let mut beside: HashMap<usize, Vec<usize>> = HashMap::new();
    for (triangle, edge, across) in inner_edges(plan, triangles) {
        let ends = plan.edge(triangle, edge).map(|number| plan.places[number]);
        if !(plan.is_line[triangle][edge] && certificate.has_wall(ends, heights)) {
            beside.entry(triangle).or_default().push(across);
            beside.entry(across).or_default().push(triangle);
        }
    }
    let mut taken = HashSet::new();
    let mut parts = Vec::new();
    for &first in triangles {
        let mut part = Vec::new();
        let mut left = vec![first];
        while let Some(triangle) = left.pop() {
            if taken.insert(triangle) {
                part.push(triangle);
                left.extend(beside.get(&triangle).into_iter().flatten());
            }
        }
        parts.push(part);
    }
    parts
}

/// Edges between two of the triangles: the triangle with the lower number, the edge in it, and the
/// triangle across.
fn inner_edges<'a>(
    plan: &'a Plan,
    triangles: &'a [usize],
) -> impl Iterator<Item = (usize, usize, usize)> + 'a {
    let inside: HashSet<usize> = triangles.iter().copied().collect();
    let edges = triangles
        .iter()
        .flat_map(|&triangle| (0..3).map(move |edge| (triangle, edge)));
    edges.filter_map(move |(triangle, edge)| {
        let across = plan.neighbours[triangle][edge]?;
        (triangle < across && inside.contains(&across)).then_some((triangle, edge, across))
    })
}

/// Proven prisms over most of the outline: corners are pulled further and the heights too, and last
/// the cells that fail are left out.
fn shrunk(outline: &Outline, [bottom, top]: [f64; 2], certificate: &mut Certificate) -> Vec<Prism> {
    let mut best = Vec::new();
    let Some(outline) = outline.straightened() else {
        return best;
    };
    let mut pull = 2.0 * PULL;
    while pull < MOST_PULL {
        let pulled = outline.pulled(pull);
        let heights = [bottom + pull, top - pull];
        pull *= 2.0;
        let Some(mut cells) = Cells::new(&pulled, &[]) else {
            continue;
        };
        if cells.prove(heights, certificate) {
            return prism(&pulled, heights).into_iter().collect();
        }
        let outlines = cells.outlines();
        let prisms: Vec<Prism> = outlines.iter().filter_map(|o| prism(o, heights)).collect();
        let area = |prisms: &[Prism]| prisms.iter().map(|prism| prism.area).sum::<f64>();
        if area(&prisms) > area(&best) {
            best = prisms;
        }
    }
    best
}

fn prism(outline: &Outline, [bottom, top]: [f64; 2]) -> Option<Prism> {
    (outline.width() >= LEAST_WIDTH).then(|| Prism {
        footprint: outline.polygon(),
        area: outline.area(),
        bottom,
        top,
    })
}
