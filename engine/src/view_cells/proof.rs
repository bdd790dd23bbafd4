//! Which features of a visible set are proven to be visible.

use glam::{DVec2, DVec3};

use super::scene::{CellScene, Stage};
use super::solver::{CellQuery, CellSolver};
use crate::point_visibility::{Known, Sifting, Spot};
use crate::{Box3d, Sought, Surfaces, Witness};

/// From how many eyes along each edge of a cell one looks, and how hard: first from few, from where most
/// features are seen, then from more.
const ROUNDS: [Round; 3] = [
    Round {
        eyes: 2,
        tops: 8,
        anywhere: 1,
    },
    Round {
        eyes: 3,
        tops: 24,
        anywhere: 4,
    },
    Round {
        eyes: 5,
        tops: 48,
        anywhere: 8,
    },
];

/// How one looks.
#[derive(Clone, Copy)]
struct Round {
    /// Along each edge.
    eyes: usize,
    /// See [`Sought`].
    tops: usize,
    anywhere: usize,
}

impl CellSolver {
    /// The witnesses of those features of a visible set, by the positions of their tiles and their own, that
    /// are proven to be visible from somewhere in the cell where an eye may be; `None` as soon as
    /// `cancelled` says so.
    pub fn prove(
        &mut self,
        scene: &CellScene,
        surfaces: &Surfaces,
        query: &CellQuery,
        visible: &[(usize, usize)],
        is_open: &dyn Fn(&Box3d) -> bool,
        cancelled: &dyn Fn() -> bool,
    ) -> Option<Vec<Option<Witness>>> {
        let within = reach(query);
        let tiles: Vec<usize> = (scene.len()..2 * scene.len()).collect();
        let mut stage = Stage::new(scene, None);
        let mut witnesses = vec![None; visible.len()];
        let spot = |&(tile, feature): &(usize, usize)| Spot { tile, feature };
        let mut open: Vec<(Spot, Box3d)> = visible
            .iter()
            .map(|place| (spot(place), scene.feature(*place).1))
            .collect();
        for (eye, round) in looks(&query.bounds) {
            if cancelled() {
                return None;
            }
            if open.is_empty() {
                break;
            }
            if !is_open(&Box3d::new(eye, eye)) || scene.holds(eye) {
                continue;
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
            };
            let mut seen = Vec::new();
            let found = |spot: Spot, _| seen.push(spot);
            let Ok(_) = self.points.sift(&sifting, &mut stage, |_| false, found);
            for spot in seen {
                let place = (spot.tile, spot.feature);
                let sought = round.seeks(scene.feature(place).0, &within);
                if let Some(witness) = surfaces.witness(eye, &sought) {
                    let at = visible.binary_search(&place);
                    witnesses[at.expect("only these are sifted")] = Some(witness);
                    open.retain(|(other, _)| *other != spot);
                }
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
    looks(&query.bounds)
        .filter(|(eye, _)| is_eye(*eye))
        .find_map(|(eye, round)| surfaces.witness(eye, &round.seeks(feature, &within)))
}

/// Where sight lines from a cell may be.
fn reach(query: &CellQuery) -> Box3d {
    Box3d {
        min: query.bounds.min - query.range,
        max: query.bounds.max + query.range,
    }
}

impl Round {
    fn seeks(self, feature: i64, within: &Box3d) -> Sought<'_> {
        Sought {
            feature,
            within,
            tops: self.tops,
            anywhere: self.anywhere,
        }
    }
}

/// Eyes on the upper face of a cell, its corners first, and how hard each looks.
fn looks(cell: &Box3d) -> impl Iterator<Item = (DVec3, Round)> + use<> {
    let cell = *cell;
    ROUNDS.into_iter().flat_map(move |round| {
        let count = round.eyes;
        (0..count * count).map(move |at| {
            let share = DVec2::new((at % count) as f64, (at / count) as f64) / (count - 1) as f64;
            let (low, high) = (cell.min.truncate(), cell.max.truncate());
            let place = low * (1.0 - share) + high * share;
            (place.extend(cell.max.z), round)
        })
    })
}
