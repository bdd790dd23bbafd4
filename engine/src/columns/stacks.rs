//! [`stacks`], what is solid above each triangle of a plan.

use glam::DVec2;

use super::facets::Facets;
use super::plan::{ON_LEVEL, Plan};
use crate::MeshDefect;

/// Most facets above and below all triangles together.
const MOST_LAYERS: usize = 4_000_000;

/// A triangle narrower than this is made by rounding, metres: what is over it cannot be told.
const SLIVER: f64 = 1e-7;

/// The stretches over a triangle; `None` where they cannot be told.
type Stack = Option<Vec<Stretch>>;

/// A stretch of height over a triangle of the plan in which the mesh winds once or more.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// The triangle.
    pub triangle: usize,
    /// Area of the triangle.
    pub area: f64,
    /// From this level on all is solid.
    pub from: usize,
    /// Up to this level all is solid; not below `from`.
    pub to: usize,
    /// The volume between the facets that bound it.
    pub volume: f64,
}

impl Stretch {
    /// The part below a level within it.
    pub fn up_to(&self, level: usize, levels: &[f64]) -> Self {
        Self {
            to: level,
            volume: self.area * (levels[level] - levels[self.from]),
            ..*self
        }
    }
}

/// A facet over a triangle: its heights there at the corners and at the middle.
struct Layer {
    heights: [f64; 3],
    middle: f64,
    faces: i32,
    is_level: bool,
}

/// All stretches of each triangle, upwards.
///
/// # Errors
/// [`MeshDefect`] when there are too many layers.
pub fn stacks(plan: &Plan, facets: &Facets, levels: &[f64]) -> Result<Vec<Stretch>, MeshDefect> {
    let mut stacks: Vec<Stack> = Vec::with_capacity(plan.triangles.len());
    let mut seen = 0;
    for (triangle, corners) in plan.triangles.iter().enumerate() {
        let corners = corners.map(|corner| plan.places[corner]);
        let [ab, bc, ca] = [0, 1, 2].map(|i| corners[(i + 1) % 3] - corners[i]);
        let area = ab.perp_dot(bc) / 2.0;
        let longest = ab.length().max(bc.length()).max(ca.length());
        if 2.0 * area < SLIVER * longest {
            stacks.push(None);
            continue;
        }
        let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
        let mut layers: Vec<Layer> = layers_over(facets, corners, middle).collect();
        seen += layers.len();
        if seen > MOST_LAYERS {
            return Err(MeshDefect::TooIntricate { limit: MOST_LAYERS });
        }
        layers.sort_unstable_by(|a, b| a.middle.total_cmp(&b.middle));
        remove_inner_levels(&mut layers);
        let found = solid_between(&layers, levels).map(|(from, to, height)| Stretch {
            triangle,
            area,
            from,
            to,
            volume: area * height,
        });
        stacks.push(Some(found.collect()));
    }
    let slivers = in_slivers(plan, &stacks);
    Ok(stacks
        .into_iter()
        .flatten()
        .flatten()
        .chain(slivers)
        .collect())
}

/// The stretches of slivers: what is solid all round those that hang together, so that they neither
/// divide a region nor add a rim to one.
fn in_slivers(plan: &Plan, stacks: &[Stack]) -> Vec<Stretch> {
    let mut stretches = Vec::new();
    let mut is_taken = vec![false; stacks.len()];
    for first in (0..stacks.len()).filter(|&triangle| stacks[triangle].is_none()) {
        let mut slivers = Vec::new();
        let mut sides: Vec<&[Stretch]> = Vec::new();
        let mut left = vec![first];
        while let Some(sliver) = left.pop() {
            if std::mem::replace(&mut is_taken[sliver], true) {
                continue;
            }
            slivers.push(sliver);
            for side in plan.neighbours[sliver] {
                match side.map(|side| (side, &stacks[side])) {
                    Some((side, None)) => left.push(side),
                    Some((_, Some(stack))) => sides.push(stack),
                    None => sides.push(&[]),
                }
            }
        }
        let common = common(&sides);
        for triangle in slivers {
            stretches.extend(common.iter().map(|stretch| Stretch {
                triangle,
                area: 0.0,
                volume: 0.0,
                ..*stretch
            }));
        }
    }
    stretches
}

/// The stretches that are in all stacks.
fn common(stacks: &[&[Stretch]]) -> Vec<Stretch> {
    let Some((first, others)) = stacks.split_first() else {
        return Vec::new();
    };
    others.iter().fold(first.to_vec(), |common, stack| {
        let pairs = common
            .iter()
            .flat_map(|a| stack.iter().map(move |b| (a, b)));
        let both = pairs.map(|(a, b)| Stretch {
            from: a.from.max(b.from),
            to: a.to.min(b.to),
            ..*a
        });
        both.filter(|both| both.from < both.to).collect()
    })
}

fn layers_over(facets: &Facets, corners: [DVec2; 3], middle: DVec2) -> impl Iterator<Item = Layer> {
    let over = facets
        .near(&[middle])
        .filter(move |facet| facet.covers(middle));
    over.map(move |facet| Layer {
        heights: corners.map(|corner| facet.height(corner)),
        middle: facet.height(middle),
        faces: facet.faces,
        is_level: facet.is_level(),
    })
}

/// Removes level layers that have solid on both sides: they bound nothing.
fn remove_inner_levels(layers: &mut Vec<Layer>) {
    let mut winding = 0;
    let mut is_kept = Vec::with_capacity(layers.len());
    for same in layers.chunk_by(|a, b| a.middle == b.middle) {
        let above = winding - same.iter().map(|layer| layer.faces).sum::<i32>();
        let bounds = winding < 1 || above < 1 || !same.iter().all(|layer| layer.is_level);
        is_kept.extend(std::iter::repeat_n(bounds, same.len()));
        winding = above;
    }
    let mut is_kept = is_kept.into_iter();
    layers.retain(|_| is_kept.next().unwrap_or(true));
}

/// First and last level, and mean height, of each solid stretch between sorted layers.
fn solid_between(layers: &[Layer], levels: &[f64]) -> impl Iterator<Item = (usize, usize, f64)> {
    let mut above = vec![f64::INFINITY; layers.len() + 1];
    for (i, layer) in layers.iter().enumerate().rev() {
        let least = layer.heights.into_iter().fold(f64::INFINITY, f64::min);
        above[i] = above[i + 1].min(least);
    }
    let mut winding = 0;
    let mut below = f64::NEG_INFINITY;
    layers.windows(2).enumerate().filter_map(move |(i, pair)| {
        // The greatest of linear functions is no greater between the corners than at them.
        below = pair[0].heights.into_iter().fold(below, f64::max);
        winding -= pair[0].faces;
        let from = levels.partition_point(|&z| z < below - ON_LEVEL);
        let to = levels
            .partition_point(|&z| z <= above[i + 1] + ON_LEVEL)
            .checked_sub(1)?;
        let height = pair[1].middle - pair[0].middle;
        (winding >= 1 && height > 0.0).then_some((from, to.max(from), height))
    })
}
