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
    let around = triangles.iter().map(|&t| plan.triangles[t]);
    let Some(outline) = Outline::around(around, |number| plan.corner(number)) else {
        return Vec::new();
    };
    if let Some(straight) = outline.straightened() {
        let straight = straight.pulled(PULL);
        let cells = Cells::new(&straight, &[]);
        if cells.is_some_and(|mut cells| cells.prove(heights, certificate)) {
            return prism(&straight, heights).into_iter().collect();
        }
    }
    prisms_with_seams(&outline, &seams(plan, triangles), heights, certificate)
}

/// The same where faces within the piece, or rounding, ask for more care: cells end at all lines,
/// then corners are pulled further and the heights too, and last the cells that fail are cut out.
fn prisms_with_seams(
    outline: &Outline,
    seams: &[[Corner; 2]],
    [bottom, top]: [f64; 2],
    certificate: &mut Certificate,
) -> Vec<Prism> {
    let mut best = Vec::new();
    let (mut pull, mut shrink) = (PULL, 0.0);
    while pull < MOST_PULL {
        let pulled = outline.pulled(pull);
        let heights = [bottom + shrink, top - shrink];
        pull *= 2.0;
        shrink = pull;
        let moved: HashMap<usize, Corner> = pulled
            .rings
            .iter()
            .flatten()
            .map(|corner| (corner.number, *corner))
            .collect();
        let follow = |corner: Corner| *moved.get(&corner.number).unwrap_or(&corner);
        let seams: Vec<_> = seams.iter().map(|seam| seam.map(follow)).collect();
        let Some(mut cells) = Cells::new(&pulled, &seams) else {
            continue;
        };
        if cells.prove(heights, certificate) {
            return prism(&pulled, heights).into_iter().collect();
        }
        let outlines = cells.outlines();
        let prisms: Vec<Prism> = outlines.iter().filter_map(|o| prism(o, heights)).collect();
        let area = |prisms: &[Prism]| prisms.iter().map(|prism| prism.area).sum::<f64>();
        if best.is_empty() || area(&prisms) > area(&best) {
            best = prisms;
        }
    }
    best
}

/// Lines of the plan between the triangles.
fn seams(plan: &Plan, triangles: &[usize]) -> Vec<[Corner; 2]> {
    let inside: HashSet<usize> = triangles.iter().copied().collect();
    let mut seams = Vec::new();
    for &triangle in triangles {
        for edge in 0..3 {
            let is_inside = plan.neighbours[triangle][edge]
                .is_some_and(|across| triangle < across && inside.contains(&across));
            if is_inside && plan.is_line[triangle][edge] {
                let ends = [edge, (edge + 1) % 3].map(|i| plan.triangles[triangle][i]);
                seams.push(ends.map(|number| plan.corner(number)));
            }
        }
    }
    seams
}

fn prism(outline: &Outline, [bottom, top]: [f64; 2]) -> Option<Prism> {
    (outline.width() >= LEAST_WIDTH).then(|| Prism {
        footprint: outline.polygon(),
        area: outline.area(),
        bottom,
        top,
    })
}
