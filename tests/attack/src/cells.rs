//! [`CellTrial`], one scene with view cells: what a cell leaves out may be seen from nowhere in it.

use std::sync::Arc;

use engine::{Box3d, CellQuery, CellScene, CellSolver, CellTile, Tile, TileFeature};
use fastrand::Rng;
use glam::DVec3;
use oracle::{JudgedFeature, LeftOut, PointJudge};

use crate::kind::between;
use crate::observer::random_eye;
use crate::scene::Scene;
use crate::tiling::parts;
use crate::trial::{Counts, Trial, range};

/// Cells of a scene.
pub const CELLS: u64 = 6;

/// Eyes in a cell from which its answer is judged.
const EYES: usize = 12;

/// Vertical planes to aim in, a feature that was left out.
const PLANES: usize = 12;

/// A scene and the cells that are solved in it.
pub struct CellTrial {
    number: u64,
    rng: Rng,
    scene: Scene,
    features: Vec<TileFeature>,
    judged: Vec<JudgedFeature>,
    pub counts: Counts,
    pub findings: Vec<String>,
}

impl CellTrial {
    /// That of this number.
    pub fn new(seed: u64, number: u64) -> Self {
        let trial = Trial::new(seed, number);
        Self {
            number,
            rng: Rng::with_seed(seed.rotate_left(32) ^ number),
            scene: trial.scene,
            features: trial.features,
            judged: trial.judged,
            counts: Counts::default(),
            findings: Vec::new(),
        }
    }

    /// Solves as many cells as are wanted, up to [`CELLS`].
    pub fn run(&mut self, solver: &mut CellSolver, cells: u64) {
        let tiles = parts(&mut self.rng, &self.features, false);
        let tile = |part: &Vec<TileFeature>| Arc::new(CellTile::new(Tile::new(part)));
        let scene = CellScene::new(tiles.iter().map(tile).collect());
        for cell in 0..cells.min(CELLS) {
            let query = CellQuery {
                bounds: self.random_cell(),
                range: range(&mut self.rng, if cell % 2 == 0 { 0 } else { 2 }),
                precision: [0.125, 0.25, 0.5, 1.0, 4.0][self.rng.usize(..5)],
            };
            let seen = solver.solve(&scene, &query, &|_| true, &|| false);
            let seen = seen.unwrap_or_default();
            let ids = seen.iter().map(|seen| scene.feature(seen.feature).0);
            let mut answer: Vec<i64> = ids.collect();
            answer.sort_unstable();
            self.counts.queries += 1;
            self.counts.returned += answer.len() as u64;
            self.judge(&query, &answer);
            if self.rng.bool() {
                self.demolish(solver, &tiles, &query, answer);
            }
        }
    }

    /// Takes away some features that a cell sees, and finds out what is seen in their place.
    fn demolish(
        &mut self,
        solver: &mut CellSolver,
        tiles: &[Vec<TileFeature>],
        query: &CellQuery,
        mut answer: Vec<i64>,
    ) {
        let gone: Vec<i64> = (0..self.rng.usize(1..=3))
            .filter_map(|_| self.rng.choice(&answer).copied())
            .collect();
        let left = |part: &Vec<TileFeature>| -> Vec<TileFeature> {
            let left = part.iter().filter(|feature| !gone.contains(&feature.id));
            left.cloned().collect()
        };
        let tile = |part: &Vec<TileFeature>| Arc::new(CellTile::new(Tile::new(&left(part))));
        let scene = CellScene::new(tiles.iter().map(tile).collect());
        let at = |id: &i64| usize::try_from(*id).unwrap_or_default();
        let places: Vec<Box3d> = gone
            .iter()
            .map(|id| self.features[at(id)].envelope)
            .collect();
        let is_known = |id: i64| answer.binary_search(&id).is_ok();
        let seen = solver.solve_behind(&scene, query, &places, &is_known, &|_| true, &|| false);
        let seen = seen.unwrap_or_default();
        let more = seen.iter().map(|seen| scene.feature(seen.feature).0);
        // Those that are gone stay in the answer: nothing is looked for there.
        answer.extend(more.collect::<Vec<i64>>());
        answer.sort_unstable();
        self.counts.queries += 1;
        let judged = self.judged.clone();
        for id in &gone {
            self.judged[at(id)].columns.clear();
        }
        self.judge(query, &answer);
        self.judged = judged;
    }

    /// A box near where an eye would be: thin, flat, a point, or as large as a building.
    fn random_cell(&mut self) -> Box3d {
        let middle = DVec3::from(random_eye(&mut self.rng, &self.scene));
        let edge = [0.0, 0.01, 0.1, 0.5, 1.0, 2.0, 4.0, 8.0][self.rng.usize(..8)];
        let other = [edge, edge, edge, 0.5 * edge, 0.0, 0.01][self.rng.usize(..6)];
        let height = [0.0, 0.25, 0.5, 2.0, 10.0][self.rng.usize(..5)];
        let size = match self.rng.bool() {
            true => DVec3::new(edge, other, height),
            false => DVec3::new(other, edge, height),
        };
        // Around the eye, or with it at a corner.
        let share = [0.0, 0.5, 1.0].map(|share| share * size);
        let min = middle - share[self.rng.usize(..3)];
        Box3d::new(min, min + size)
    }

    fn judge(&mut self, query: &CellQuery, answer: &[i64]) {
        let judged = std::mem::take(&mut self.judged);
        for _ in 0..EYES {
            let eye = self.random_eye_in(&query.bounds);
            let mut judge = PointJudge::new(&judged, eye.to_array()).joined();
            // Of an eye in a solid no cell speaks.
            if !judge.is_outside() {
                continue;
            }
            for (at, id) in (0..self.features.len()).zip(0..) {
                let envelope = &self.features[at].envelope;
                if envelope.distance_to_point(eye) > query.range + 1e-6 {
                    continue;
                }
                self.counts.features += 1;
                if answer.binary_search(&id).is_ok() {
                    continue;
                }
                self.counts.left_out += 1;
                let left_out = LeftOut {
                    feature: at,
                    prism: true,
                    range: query.range,
                };
                let search = judge.search(&left_out, PLANES, &mut self.rng);
                self.counts.aims += search.aims as u64;
                if let Some(witness) = search.witness {
                    self.counts.false_occlusions += 1;
                    self.findings.push(self.finding(query, eye, at, witness));
                }
            }
        }
        self.judged = judged;
    }

    /// A point of a box: mostly corners and edges, mostly at its top, where most is seen.
    fn random_eye_in(&mut self, bounds: &Box3d) -> DVec3 {
        let mut share = || match self.rng.u8(..8) {
            0..=2 => 0.0,
            3..=5 => 1.0,
            6 => 0.5,
            _ => between(&mut self.rng, 0.0, 1.0),
        };
        let [x, y] = [share(), share()];
        let z = share().max(share());
        let eye = bounds.min + bounds.size() * DVec3::new(x, y, z);
        eye.clamp(bounds.min, bounds.max)
    }

    fn finding(&self, query: &CellQuery, eye: DVec3, feature: usize, witness: [f64; 3]) -> String {
        let Box3d { min, max } = query.bounds;
        let scene = &self.scene;
        format!(
            "false occlusion in scene {} ({:?}): from {:?} in the cell {:?} to {:?}, range {}, precision {}, one can see {witness:?} of\n  {:?}\nbetween {} others",
            self.number,
            scene.kind,
            eye.to_array(),
            min.to_array(),
            max.to_array(),
            query.range,
            query.precision,
            scene.features[feature],
            scene.features.len() - 1
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_leave_out_much_and_nothing_that_is_seen() {
        let mut counts = Counts::default();
        let mut solver = CellSolver::default();
        for number in 0..150 {
            let mut trial = CellTrial::new(5, number);
            trial.run(&mut solver, CELLS);
            assert!(trial.findings.is_empty(), "{}", trial.findings[0]);
            counts += trial.counts;
        }
        assert!(10 * counts.left_out > counts.features, "{counts:?}");
    }

    #[test]
    fn what_a_cell_loses_is_found() {
        let mut trial = CellTrial::new(3, 1);
        let query = CellQuery {
            bounds: Box3d::new(
                DVec3::new(-40.0, -40.0, 60.0),
                DVec3::new(-39.0, -39.0, 61.0),
            ),
            range: f64::INFINITY,
            precision: 0.5,
        };
        trial.judge(&query, &[]);
        assert!(trial.counts.false_occlusions > 0);
        assert!(trial.findings[0].starts_with("false occlusion in scene 1 "));
    }
}
