//! Which features of a visible set are proven to be visible.

use std::collections::VecDeque;

use glam::{DVec2, DVec3};

use super::scene::{CellScene, Stage};
use super::solver::{CellQuery, CellSighting, CellSolver, half, parts, top};
use crate::point_visibility::{Known, Sifting, Spot};
use crate::{Box3d, Sought, Surfaces, Witness};

/// Metres between the eyes on a cell's edges and between them, at the most.
const SPACING: f64 = 4.0;

/// How one looks from a grid of eyes, from the corners of a cell on: most features are seen from there.
const FROM_GRID: Effort = Effort {
    tops: 8,
    anywhere: 1,
};

/// How one looks for what is not proven then, from where it may be seen.
const FROM_WITHIN: Effort = Effort {
    tops: 24,
    anywhere: 4,
};

/// Parts of a cell from whose middles one looks have half edges no shorter than this, metres.
const LEAST: f64 = 0.25;

/// How often a cell is divided for them, at the most: there are 1,365 of them then.
const MOST_DIVISIONS: u32 = 5;

/// How much one looks for a feature: see [`Sought`].
#[derive(Clone, Copy)]
struct Effort {
    tops: usize,
    anywhere: usize,
}

impl CellSolver {
    /// The witnesses of those features of a visible set that are proven to be visible from somewhere in the
    /// cell where an eye may be; `None` as soon as `cancelled` says so.
    ///
    /// First from a grid of eyes. What is not seen from there is looked for once more, from near the eye that
    /// it was found with.
    pub fn prove(
        &mut self,
        scene: &CellScene,
        surfaces: &Surfaces,
        query: &CellQuery,
        visible: &[CellSighting],
        is_open: &dyn Fn(&Box3d) -> bool,
        cancelled: &dyn Fn() -> bool,
    ) -> Option<Vec<Option<Witness>>> {
        let within = reach(query);
        let tiles: Vec<usize> = (scene.len()..2 * scene.len()).collect();
        let mut stage = Stage::new(scene, None);
        let mut witnesses = vec![None; visible.len()];
        let mut open: Vec<(Spot, Box3d)> = visible
            .iter()
            .map(|CellSighting { feature, .. }| {
                let (tile, position) = *feature;
                let spot = Spot {
                    tile,
                    feature: position,
                };
                (spot, scene.feature(*feature).1)
            })
            .collect();
        let is_eye = |eye: DVec3| is_open(&Box3d::new(eye, eye)) && !scene.holds(eye);
        for eye in grid(&query.bounds).filter(|eye| is_eye(*eye)) {
            if cancelled() {
                return None;
            }
            if open.is_empty() {
                break;
            }
            let sifting = Sifting {
                eye,
                near: Box3d::new(eye, eye),
                range: f64::INFINITY,
                first_hiding: scene.len(),
                known: Some(Known {
                    features: &open,
                    tiles: &tiles,
                }),
                through: None,
            };
            let mut seen = Vec::new();
            let found = |spot: Spot, _| seen.push(spot);
            let Ok(_) = self.points.sift(&sifting, &mut stage, |_| false, found);
            for spot in seen {
                let place = (spot.tile, spot.feature);
                let sought = FROM_GRID.on(scene.feature(place).0, &within);
                if let Some(witness) = surfaces.witness(eye, &sought) {
                    let at = visible.binary_search_by_key(&place, |sighting| sighting.feature);
                    witnesses[at.expect("only these are sifted")] = Some(witness);
                    open.retain(|(other, _)| *other != spot);
                }
            }
        }
        for (sighting, witness) in visible.iter().zip(&mut witnesses) {
            if cancelled() {
                return None;
            }
            let eye = near(&query.bounds, sighting.eye);
            if witness.is_none() && is_eye(eye) {
                let (id, _) = scene.feature(sighting.feature);
                *witness = surfaces.witness(eye, &FROM_WITHIN.on(id, &within));
            }
        }
        Some(witnesses)
    }
}

/// The witness that a feature can be seen from somewhere in a cell: one is found for all that are proven
/// by [`CellSolver::prove`], as long as nothing was changed.
#[must_use]
pub fn witness(
    surfaces: &Surfaces,
    query: &CellQuery,
    feature: i64,
    is_eye: &dyn Fn(DVec3) -> bool,
) -> Option<Witness> {
    let within = reach(query);
    let from = |eye: DVec3, effort: Effort| {
        let sought = effort.on(feature, &within);
        is_eye(eye)
            .then(|| surfaces.witness(eye, &sought))
            .flatten()
    };
    grid(&query.bounds)
        .find_map(|eye| from(eye, FROM_GRID))
        .or_else(|| middles(&query.bounds).find_map(|eye| from(eye, FROM_WITHIN)))
}

/// Where sight lines from a cell may be.
fn reach(query: &CellQuery) -> Box3d {
    Box3d {
        min: query.bounds.min - query.range,
        max: query.bounds.max + query.range,
    }
}

impl Effort {
    fn on(self, feature: i64, within: &Box3d) -> Sought<'_> {
        Sought {
            feature,
            within,
            tops: self.tops,
            anywhere: self.anywhere,
        }
    }
}

/// The corners of the upper face of a cell, and places between them.
fn grid(cell: &Box3d) -> impl Iterator<Item = DVec3> + use<> {
    let cell = *cell;
    let count = (2.0 * half(&cell) / SPACING).ceil().max(1.0) as usize;
    (0..(count + 1) * (count + 1)).map(move |at| {
        let steps = DVec2::new((at % (count + 1)) as f64, (at / (count + 1)) as f64);
        let share = steps / count as f64;
        let (low, high) = (cell.min.truncate(), cell.max.truncate());
        (low * (1.0 - share) + high * share).extend(cell.max.z)
    })
}

/// The middle of the part of a cell, or of its parts and so on, in which a place is.
fn near(cell: &Box3d, place: DVec3) -> DVec3 {
    let mut cell = *cell;
    for division in 0..MOST_DIVISIONS {
        if let Some(part) = divided(&cell, division).find(|part| part.contains_point(place)) {
            cell = part;
        }
    }
    top(&cell)
}

/// The middles of a cell, of its parts, and so on: all that [`near`] may be.
fn middles(cell: &Box3d) -> impl Iterator<Item = DVec3> + use<> {
    let mut open = VecDeque::from([(*cell, 0)]);
    std::iter::from_fn(move || {
        let (cell, divisions) = open.pop_front()?;
        open.extend(divided(&cell, divisions).map(|part| (part, divisions + 1)));
        Some(top(&cell))
    })
}

/// The parts of what is left of a cell after some divisions, unless they are too small.
fn divided(cell: &Box3d, divisions: u32) -> impl Iterator<Item = Box3d> + use<> {
    let is_large = half(cell) >= 2.0 * LEAST && divisions < MOST_DIVISIONS;
    parts(cell).filter(move |_| is_large)
}
