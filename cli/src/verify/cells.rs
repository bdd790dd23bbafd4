//! [`CellChecker`], which holds view cells against what can truly be seen from them.

use std::collections::HashMap;

use fastrand::Rng;
use oracle::{RayCaster, Sight};
use rayon::prelude::*;

use super::fault::Fault;
use super::observers::Streets;
use super::truth::Truth;
use crate::failure::Failure;
use crate::scene::{Feature, Scene, ViewCell, Witness, number};

/// Random eyes in each cell, besides those on its corners and edges.
const INSIDE: usize = 4;

/// Points of a surface that each eye aims at: all eyes of a cell together aim at many.
const AIMS: usize = 8;

/// What was checked of the cells.
#[derive(Debug, Default)]
pub struct CellTally {
    /// Cells.
    pub cells: usize,
    /// Features in their sets.
    pub visible: usize,
    /// Of these, proven by a witness that holds.
    pub proven: usize,
    /// Eyes that looked for more.
    pub eyes: usize,
    /// Rays that they cast.
    pub rays: usize,
}

/// Checks view cells of one scene.
pub struct CellChecker<'a> {
    scene: &'a Scene,
    truth: &'a Truth,
    streets: Streets<'a>,
    /// Of the surfaces alone, without the ground under them.
    surfaces: RayCaster,
    positions: HashMap<i64, usize>,
    seed: u64,
    /// What was checked so far.
    pub tally: CellTally,
}

impl<'a> CellChecker<'a> {
    /// A checker that looks from places by a seed.
    pub fn new(scene: &'a Scene, truth: &'a Truth, seed: u64) -> Result<Self, Failure> {
        let numbered = scene.features.iter().enumerate();
        let triangles: Vec<_> = numbered
            .flat_map(|(position, feature)| {
                let surface = feature.surface().unwrap_or_default();
                surface.into_iter().map(move |t| (number(position), t))
            })
            .collect();
        Ok(Self {
            scene,
            truth,
            streets: Streets::new(&scene.streets),
            surfaces: RayCaster::new(&triangles).map_err(Failure::machine)?,
            positions: scene.positions(),
            seed,
            tally: CellTally::default(),
        })
    }

    /// Everything that is wrong with a cell: witnesses that do not hold, and features that it leaves out
    /// and that can be seen from its corners, its edges, or places inside.
    pub fn check(&mut self, cell: &ViewCell, witnesses: &[Witness]) -> Vec<Fault> {
        let wrong = witnesses
            .par_iter()
            .filter_map(|witness| self.refute(cell, witness));
        let mut faults: Vec<Fault> = wrong.map(Fault::Stored).collect();
        self.tally.cells += 1;
        self.tally.visible += cell.visible.len();
        self.tally.proven += witnesses.len() - faults.len();
        let eyes = self.eyes(cell);
        self.tally.eyes += eyes.len();
        let looks: Vec<(usize, Option<Fault>)> = self
            .left_out(cell)
            .par_iter()
            .map(|&position| self.look(cell, &eyes, position))
            .collect();
        for (rays, fault) in looks {
            self.tally.rays += rays;
            faults.extend(fault);
        }
        faults
    }

    /// Why a witness proves nothing.
    fn refute(&self, cell: &ViewCell, witness: &Witness) -> Option<String> {
        let why = self.flaw(cell, witness)?;
        let feature = match self.positions.get(&witness.feature) {
            Some(&position) => self.scene.features[position].to_string(),
            None => format!("feature {}", witness.feature),
        };
        Some(format!(
            "view cell {}: {feature} is not proven to be visible: {why}",
            cell.id
        ))
    }

    fn flaw(&self, cell: &ViewCell, witness: &Witness) -> Option<&'static str> {
        let Some([eye, target]) = witness.line else {
            return Some("the database has no witness");
        };
        let Some(&position) = self.positions.get(&witness.feature) else {
            return Some("there is no such feature");
        };
        if !cell.bounds.holds(eye) {
            return Some("the eye is not in the cell");
        }
        let id = number(position);
        if self.surfaces.is_clear(eye, target, Some(id)) != Sight::Clear {
            return Some("another feature is in the way");
        }
        match self.surfaces.is_clear(eye, target, None) {
            Sight::Blocked { .. } => None,
            _ => Some("the line does not meet the feature"),
        }
    }

    /// Features within range of all of the cell that it says cannot be seen.
    fn left_out(&self, cell: &ViewCell) -> Vec<usize> {
        let features = self.scene.features.iter().enumerate();
        features
            .filter(|(_, feature)| !cell.visible.contains(&feature.id))
            .filter(|(_, feature)| feature.envelope.gap(&cell.bounds) <= cell.range)
            .map(|(position, _)| position)
            .collect()
    }

    /// Looks for a feature from all eyes; how many rays it took, and the fault if it is seen.
    fn look(&self, cell: &ViewCell, eyes: &[[f64; 3]], position: usize) -> (usize, Option<Fault>) {
        let feature = &self.scene.features[position];
        let targets = &self.truth.targets[position];
        let mut rays = 0;
        for (turn, eye) in eyes.iter().enumerate() {
            if targets.is_empty() || feature.envelope.distance(*eye) > cell.range {
                continue;
            }
            for at in 0..AIMS.min(targets.len()) {
                let target = targets[(turn * AIMS + at) % targets.len()];
                rays += 1;
                let sight = self
                    .truth
                    .caster
                    .is_clear(*eye, target, Some(number(position)));
                if sight == Sight::Clear {
                    let fault = Fault::FalseOcclusion {
                        feature: feature.to_string(),
                        eye: *eye,
                        target,
                        how: "a ray from its view cell, cast exactly",
                    };
                    return (rays, Some(fault));
                }
            }
        }
        (rays, None)
    }

    /// Eyes of the view region in a cell: at the ends and middles of its edges, its middle, and anywhere,
    /// as low and as high as eyes may be.
    fn eyes(&self, cell: &ViewCell) -> Vec<[f64; 3]> {
        let mut rng = Rng::with_seed(self.seed ^ cell.id.cast_unsigned());
        let (min, max) = (cell.bounds.min, cell.bounds.max);
        let on_grid = (0..9)
            .flat_map(|at| [0.0, 1.0].map(|z| [(at % 3) as f64 / 2.0, (at / 3) as f64 / 2.0, z]));
        let shares: Vec<[f64; 3]> = on_grid
            .chain((0..INSIDE).map(|_| [rng.f64(), rng.f64(), rng.f64()]))
            .collect();
        let place = |share: [f64; 3]| -> [f64; 3] {
            std::array::from_fn(|axis| min[axis] * (1.0 - share[axis]) + max[axis] * share[axis])
        };
        let features = self.scene.features.iter();
        let near: Vec<&Feature> = features
            .filter(|feature| feature.envelope.gap(&cell.bounds) == 0.0)
            .collect();
        let is_eye = |eye: &[f64; 3]| {
            let [x, y, z] = *eye;
            let is_solid = || near.iter().any(|feature| feature.is_solid_at(*eye));
            self.streets.eyes_at([x, y], [z, z]).is_some() && !is_solid()
        };
        shares.into_iter().map(place).filter(is_eye).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Street, Surfaces};
    use crate::sql_types::{Box3d, Ring};

    fn feature(id: i64, min: [f64; 3], max: [f64; 3]) -> Feature {
        Feature::of_box(id, Box3d { min, max })
    }

    /// A street in the south, a wall, and a shed behind it.
    fn scene() -> Scene {
        let ring = Ring(vec![[0.0, 0.0], [20.0, 0.0], [20.0, 4.0], [0.0, 4.0]]);
        Scene {
            features: vec![
                feature(1, [0.0, 10.0, 0.0], [20.0, 12.0, 8.0]),
                feature(2, [8.0, 20.0, 0.0], [12.0, 22.0, 3.0]),
            ],
            streets: Street::new(vec![ring], 1.5, 2.0).into_iter().collect(),
            attribution: None,
        }
    }

    fn cell(visible: &[i64]) -> ViewCell {
        ViewCell {
            id: 1,
            bounds: Box3d {
                min: [8.0, 0.0, 1.5],
                max: [12.0, 4.0, 2.0],
            },
            range: 100.0,
            visible: visible.iter().copied().collect(),
        }
    }

    fn faults(cell: &ViewCell, witnesses: &[Witness]) -> Vec<String> {
        let scene = scene();
        let truth = Truth::new(&scene, &Surfaces::of(&scene), 64, 1).unwrap();
        let mut checker = CellChecker::new(&scene, &truth, 1).unwrap();
        let faults = checker.check(cell, witnesses);
        faults.iter().map(ToString::to_string).collect()
    }

    fn witness(feature: i64, eye: [f64; 3], target: [f64; 3]) -> Witness {
        Witness {
            feature,
            line: Some([eye, target]),
        }
    }

    #[test]
    fn what_is_right_has_no_faults() {
        let seen = witness(1, [8.0, 0.0, 2.0], [9.0, 11.0, 4.0]);
        assert_eq!(faults(&cell(&[1]), &[seen]), [""; 0]);
    }

    #[test]
    fn a_feature_that_is_left_out_and_seen_is_a_false_occlusion() {
        let faults = faults(&cell(&[2]), &[]);
        assert!(
            faults[0].starts_with("false occlusion: Building 1"),
            "{faults:?}"
        );
    }

    #[test]
    fn fabricated_witnesses_are_refuted() {
        let hidden = witness(2, [9.0, 1.0, 1.75], [10.0, 21.0, 1.0]);
        let elsewhere = witness(1, [20.0, 0.0, 2.0], [19.0, 11.0, 4.0]);
        let short = witness(1, [9.0, 1.0, 1.75], [9.0, 9.9, 1.75]);
        let none = Witness {
            feature: 1,
            line: None,
        };
        let unknown = witness(7, [9.0, 1.0, 1.75], [9.0, 11.0, 1.75]);
        for (witness, why) in [
            (hidden, "another feature is in the way"),
            (elsewhere, "the eye is not in the cell"),
            (short, "the line does not meet the feature"),
            (none, "the database has no witness"),
            (unknown, "there is no such feature"),
        ] {
            let faults = faults(&cell(&[1, 2]), &[witness]);
            assert_eq!(faults.len(), 1, "{faults:?}");
            assert!(faults[0].ends_with(why), "{faults:?}");
        }
    }
}
