//! [`Trial`], one scene with its eyes, and [`Counts`], what came of it.

use std::ops::AddAssign;

use engine::{PointQuery, PointSolver, TileFeature};
use fastrand::Rng;
use oracle::{JudgedFeature, LeftOut, PointJudge};

use crate::finding::Finding;
use crate::observer::random_eye;
use crate::scene::Scene;
use crate::tiling::Tiling;

/// Eyes in a scene.
pub const EYES: usize = 6;

/// Fields of an eye: two ranges, by boxes and by prisms.
pub const FIELDS: usize = 4;

/// Queries of a scene.
pub const QUERIES: u64 = (EYES * FIELDS) as u64;

/// Vertical planes to aim in, a feature that was left out.
const PLANES: usize = 24;

/// One eye in this many is judged in all planes.
const THOROUGH: u8 = 40;

/// What was counted.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Counts {
    /// Answers.
    pub queries: u64,
    /// Features that answers were about: those in range.
    pub features: u64,
    /// Features that answers returned.
    pub returned: u64,
    /// Features in range that answers left out.
    pub left_out: u64,
    /// Features of which a witness was found, among returned ones that were looked at.
    pub seen: u64,
    /// Returned features that were looked at for a witness.
    pub looked_at: u64,
    /// Points aimed at of what was left out.
    pub aims: u64,
    /// Features left out that can be seen.
    pub false_occlusions: u64,
}

impl AddAssign for Counts {
    fn add_assign(&mut self, other: Self) {
        self.queries += other.queries;
        self.features += other.features;
        self.returned += other.returned;
        self.left_out += other.left_out;
        self.seen += other.seen;
        self.looked_at += other.looked_at;
        self.aims += other.aims;
        self.false_occlusions += other.false_occlusions;
    }
}

/// A scene and all that is asked of it.
pub struct Trial {
    number: u64,
    rng: Rng,
    pub scene: Scene,
    pub features: Vec<TileFeature>,
    pub judged: Vec<JudgedFeature>,
    pub counts: Counts,
    pub findings: Vec<Finding>,
}

impl Trial {
    /// The scene of this number.
    pub fn new(seed: u64, number: u64) -> Self {
        let mut rng = Rng::with_seed(
            seed.wrapping_mul(0x9E37_79B9_7F4A_7C15)
                .wrapping_add(number),
        );
        let mut scene = Scene::random(&mut rng);
        // Roundings far from the origin may make a shape improper; such a feature is left away.
        let mut judged = Vec::new();
        scene.features.retain(|feature| {
            let proper = feature.for_judge();
            let is_proper = proper.is_some();
            judged.extend(proper);
            is_proper
        });
        let ids = 0..;
        let features = scene
            .features
            .iter()
            .zip(ids)
            .map(|(feature, id)| feature.for_solver(id))
            .collect();
        Self {
            number,
            rng,
            scene,
            features,
            judged,
            counts: Counts::default(),
            findings: Vec::new(),
        }
    }

    /// Asks as many queries as are wanted, up to [`QUERIES`].
    pub fn run(&mut self, solver: &mut PointSolver, queries: u64) {
        let mut tiling = Tiling::random(&mut self.rng, &self.features);
        let judged = std::mem::take(&mut self.judged);
        for _ in 0..EYES {
            let eye = random_eye(&mut self.rng, &self.scene);
            let mut judge = PointJudge::new(&judged, eye);
            let planes = if self.rng.u8(..THOROUGH) == 0 {
                usize::MAX
            } else {
                PLANES
            };
            for field in 0..FIELDS {
                if self.counts.queries == queries {
                    return;
                }
                let query = PointQuery {
                    eye: eye.into(),
                    range: range(&mut self.rng, field),
                    prisms: field % 2 == 1,
                    wedge: None,
                };
                let answer = tiling.answer(solver, &query);
                self.counts.queries += 1;
                self.judge(&mut judge, &query, &answer, planes);
            }
        }
    }

    fn judge(&mut self, judge: &mut PointJudge, query: &PointQuery, answer: &[i64], planes: usize) {
        self.counts.returned += answer.len() as u64;
        for (at, id) in (0..self.features.len()).zip(0..) {
            let left_out = LeftOut {
                feature: at,
                prism: query.prisms,
                range: query.range,
            };
            // A little wider than the solver's own test, so that the ones at the limit are judged.
            if self.features[at].envelope.distance_to_point(query.eye) > query.range + 1e-6 {
                continue;
            }
            self.counts.features += 1;
            if answer.binary_search(&id).is_ok() {
                if self.rng.u8(..16) == 0 {
                    self.counts.looked_at += 1;
                    let search = judge.search(&left_out, planes, &mut self.rng);
                    self.counts.seen += u64::from(search.witness.is_some());
                }
                continue;
            }
            self.counts.left_out += 1;
            let search = judge.search(&left_out, planes, &mut self.rng);
            self.counts.aims += search.aims as u64;
            if let Some(witness) = search.witness {
                self.counts.false_occlusions += 1;
                self.findings
                    .push(Finding::new(&self.scene, self.number, query, at, witness));
            }
        }
    }
}

/// The range of a field.
pub fn range(rng: &mut Rng, field: usize) -> f64 {
    match field {
        0 | 1 => f64::INFINITY,
        _ => [3.0, 5.0, 10.0, 20.0, 100.0][rng.usize(..5)],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kind::Kind;

    fn run(number: u64) -> Trial {
        let mut trial = Trial::new(3, number);
        trial.run(&mut PointSolver::default(), QUERIES);
        trial
    }

    #[test]
    fn every_kind_is_made_and_of_each_something_is_left_out_and_something_returned() {
        let mut of_kinds = Kind::ALL.map(|kind| (kind, Counts::default()));
        for number in 0..300 {
            let trial = run(number);
            assert!(trial.findings.is_empty(), "{}", trial.findings[0]);
            assert_eq!(trial.counts.queries, QUERIES);
            for (kind, counts) in &mut of_kinds {
                if *kind == trial.scene.kind {
                    *counts += trial.counts;
                }
            }
        }
        for (kind, counts) in of_kinds {
            assert!(counts.left_out > 0, "{kind:?}");
            assert!(counts.returned > 0, "{kind:?}");
            // What is returned can mostly be seen, so aiming finds witnesses.
            assert!(2 * counts.seen > counts.looked_at, "{kind:?}: {counts:?}");
        }
    }

    #[test]
    fn the_same_number_makes_the_same_trial() {
        assert_eq!(run(7).counts, run(7).counts);
        assert_ne!(run(7).counts, run(8).counts);
    }

    #[test]
    fn what_an_answer_loses_is_found() {
        let mut trial = Trial::new(3, 1);
        let judged = trial.judged.clone();
        let query = PointQuery {
            eye: glam::DVec3::new(-40.0, -40.0, 60.0),
            range: f64::INFINITY,
            prisms: false,
            wedge: None,
        };
        let mut judge = PointJudge::new(&judged, query.eye.to_array());
        // An answer of nothing loses all that stands out.
        trial.judge(&mut judge, &query, &[], usize::MAX);
        assert!(trial.counts.false_occlusions > 0);
        assert_eq!(trial.counts.false_occlusions, trial.findings.len() as u64);
        assert!(
            trial.findings[0]
                .to_string()
                .starts_with("false occlusion in scene 1 ")
        );
    }
}
