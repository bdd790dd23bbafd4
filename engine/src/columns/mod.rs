//! [`solid_columns`], the prisms inside a closed mesh.
//!
//! The columns solid over [z0, z1] are the places above which no face part lies between the two
//! heights and the mesh winds once or more there. All these regions are read from one plan: a
//! triangulation in which each edge of the mesh and each contour of a slope at a candidate level
//! is an edge. Over each of its triangles the faces lie in a fixed order, and counting how they
//! face gives the stretches of height that are solid; a region is the triangles with a stretch
//! from z0 to z1, and no polygons are ever overlaid. Which levels to use is a small dynamic
//! programme ([`staircase`]). Vertices of the mesh keep their bits, so the columns of houses that
//! touch share their wall; computed corners are pulled inward by micrometres.
//!
//! Nothing of this is trusted: each column is divided into cells and given out only where every
//! cell is proven to be solid ([`certificate`]).

mod cells;
mod certificate;
mod facets;
mod levels;
mod options;
mod outline;
mod plan;
mod prism;
mod stacks;
mod staircase;

use certificate::Certificate;
use facets::Facets;
use plan::Plan;
use prism::prisms;
use stacks::{Stretch, stacks};
use staircase::{Goal, Staircase};

pub use options::ColumnOptions;

use crate::mesh::why_no_seed;
use crate::{GROUND_TOLERANCE, MeshDefect, SolidColumn, TriangleMesh};

/// Columns that add less than this share of the solid volume are not sought, whatever the options,
/// so that their search ends.
const LEAST_GAIN: f64 = 1e-5;

/// A level is tried if it adds this part of what a column must: steps are then at nearly the best
/// heights for each connected piece.
const LEVEL_GAIN: f64 = 0.5;

/// Share of the space under its roofs that a solid fills at least, for the worth of levels.
const LEAST_FILLED: f64 = 1e-2;

/// How much more than that a level must add where the plan turns out too intricate.
const COARSENESS: [f64; 4] = [1.0, 16.0, 256.0, 4096.0];

/// The columns of a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct SolidColumns {
    /// The columns, each one connected piece. Those over the same bottom are nested.
    pub columns: Vec<SolidColumn>,
    /// Volume inside the union of the columns over the solid volume.
    pub share: f64,
    /// The solid volume, cubic metres.
    pub volume: f64,
}

/// Prisms inside a closed mesh that cover most of its volume.
///
/// *Always inside*: each closed column is in the closure of the solid, the points around which the
/// mesh winds once or more. Overlapping parts count as solid and hollows do not; faces with solid
/// on both sides that are level or vertical bound nothing.
///
/// *Most of the volume, few columns*: see [`ColumnOptions`].
///
/// # Errors
/// [`MeshDefect`] when the mesh bounds no solid, or one too thin or too intricate.
pub fn solid_columns(
    mesh: &TriangleMesh,
    options: &ColumnOptions,
) -> Result<SolidColumns, MeshDefect> {
    mesh.check_closed()?;
    let envelope = mesh.envelope().ok_or(MeshDefect::NoFaces)?;
    if !envelope.size().is_finite() {
        return Err(MeshDefect::NotFinite);
    }
    let facets = Facets::new(mesh);
    let heights = [envelope.min.z, envelope.max.z];
    let least_gain = options.least_gain.max(LEAST_GAIN);
    let view = View::new(mesh, &facets, heights, least_gain)?;
    let volume: f64 = view.stretches.iter().map(|stretch| stretch.volume).sum();
    let mut search = Search {
        view: &view,
        lowest: envelope.min.z,
        certificate: Certificate::new(&facets),
        volume,
        covered: 0.0,
        columns: Vec::new(),
    };
    search.run(options, volume * least_gain);
    if search.columns.is_empty() {
        // Of very many parts each may be less than is asked.
        search.run(options, volume * LEAST_GAIN);
    }
    if search.columns.is_empty() && options.most > 0 || volume <= 0.0 {
        return Err(why_no_seed(mesh, &envelope));
    }
    Ok(SolidColumns {
        share: search.covered / volume,
        volume,
        columns: search.columns,
    })
}

/// A mesh seen from above.
struct View {
    levels: Vec<f64>,
    plan: Plan,
    stretches: Vec<Stretch>,
}

impl View {
    /// With as many levels as pay, or fewer where that would be too intricate.
    fn new(
        mesh: &TriangleMesh,
        facets: &Facets,
        heights: [f64; 2],
        least_gain: f64,
    ) -> Result<Self, MeshDefect> {
        // Parts that are inside out may leave nothing of the signed volume.
        let [low, high] = heights;
        let roofs = facets.list.iter().filter(|facet| facet.faces == 1);
        let under_roofs = (high - low) * roofs.map(|facet| facet.area).sum::<f64>();
        let volume = mesh.signed_volume().max(LEAST_FILLED * under_roofs);
        let least_gain = LEVEL_GAIN * least_gain * volume;
        let mut last = 0;
        let mut result = Err(MeshDefect::ZeroVolume);
        for coarseness in COARSENESS {
            let levels = levels::levels(facets, heights, coarseness * least_gain);
            if levels.len() == last {
                continue;
            }
            last = levels.len();
            result = Self::at_levels(mesh, facets, levels);
            if !matches!(result, Err(MeshDefect::TooIntricate { .. })) {
                break;
            }
        }
        result
    }

    fn at_levels(
        mesh: &TriangleMesh,
        facets: &Facets,
        levels: Vec<f64>,
    ) -> Result<Self, MeshDefect> {
        let plan = Plan::new(mesh, facets, &levels)?;
        let stretches = stacks(&plan, facets, &levels)?;
        Ok(Self {
            levels,
            plan,
            stretches,
        })
    }
}

/// The search in one mesh.
struct Search<'a> {
    view: &'a View,
    lowest: f64,
    certificate: Certificate<'a>,
    volume: f64,
    covered: f64,
    columns: Vec<SolidColumn>,
}

impl Search<'_> {
    /// Fills stretches from the foot up, then those that it does not reach from the bottom that
    /// promises most, until enough is covered.
    fn run(&mut self, options: &ColumnOptions, least_gain: f64) {
        let mut left = self.view.stretches.clone();
        let mut bottom = Some(0);
        while let Some(from) = bottom
            && self.columns.len() < options.most
            && self.covered < self.volume * options.share
        {
            let (reached, mut others): (Vec<Stretch>, Vec<Stretch>) = left
                .into_iter()
                .partition(|stretch| stretch.from <= from && from < stretch.to);
            self.fill(from, &reached, least_gain, options);
            let below = reached.iter().filter(|stretch| stretch.from < from);
            others.extend(below.map(|stretch| stretch.up_to(from, &self.view.levels)));
            left = others;
            bottom = self.best_bottom(&left, least_gain);
        }
    }

    /// The level from which most of the stretches' volume is reached.
    fn best_bottom(&self, left: &[Stretch], least_gain: f64) -> Option<usize> {
        let mut reached: Vec<f64> = vec![0.0; self.view.levels.len()];
        for stretch in left {
            let inside = reached.iter_mut().zip(&self.view.levels).take(stretch.to);
            for (volume, level) in inside.skip(stretch.from) {
                *volume += stretch.area * (self.view.levels[stretch.to] - level);
            }
        }
        let (best, volume) = reached
            .into_iter()
            .enumerate()
            .max_by(|a, b| a.1.total_cmp(&b.1))?;
        (volume > least_gain).then_some(best)
    }

    /// Adds the columns that stand on a level, within stretches that are solid there.
    fn fill(&mut self, from: usize, reached: &[Stretch], least: f64, options: &ColumnOptions) {
        let goal = Goal {
            enough: options.share * reached.iter().map(|stretch| stretch.volume).sum::<f64>(),
            least_gain: least,
            most: options.most.saturating_sub(self.columns.len()),
        };
        let bottom = self.view.levels[from];
        let staircase = Staircase::new(&self.view.plan, &self.view.levels, from, reached);
        let steps = staircase.choose(&goal);
        // Up to where each step and those that hold it really reach.
        let mut tops: Vec<f64> = Vec::with_capacity(steps.len());
        for step in steps {
            let below = step.below.map_or(bottom, |below| tops[below]);
            let triangles = staircase.triangles(step.piece);
            let mut top = below;
            let heights = [bottom, self.view.levels[step.level]];
            for prism in prisms(&self.view.plan, &triangles, heights, &mut self.certificate) {
                if self.columns.len() == options.most {
                    return;
                }
                self.covered += prism.area * (prism.top - below).max(0.0);
                top = prism.top;
                self.columns.push(SolidColumn {
                    footprint: prism.footprint,
                    bottom: prism.bottom,
                    top: prism.top,
                    grounded: prism.bottom - self.lowest <= GROUND_TOLERANCE,
                });
            }
            tops.push(top);
        }
    }
}
