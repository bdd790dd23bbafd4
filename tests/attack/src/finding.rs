//! [`Finding`], a false occlusion, with as few features as still show it.

use std::fmt::{Display, Formatter, Result};

use engine::{PointQuery, PointSolver};

use crate::kind::Kind;
use crate::plan::Feature;
use crate::scene::Scene;
use crate::tiling::Tiling;

/// Something that was left out and can be seen.
#[derive(Clone, Debug)]
pub struct Finding {
    kind: Kind,
    scene: u64,
    query: PointQuery,
    /// What was left out, and what else is needed to have it left out.
    target: Feature,
    others: Vec<Feature>,
    witness: [f64; 3],
    /// Whether it is left out by a new solver and from one tile too.
    plain: bool,
}

impl Finding {
    /// The finding that a witness of a feature makes.
    pub fn new(
        scene: &Scene,
        number: u64,
        query: &PointQuery,
        feature: usize,
        witness: [f64; 3],
    ) -> Self {
        let mut others = scene.features.clone();
        let target = others.remove(feature);
        let mut finding = Self {
            kind: scene.kind,
            scene: number,
            query: *query,
            plain: is_left_out(query, &target, &others),
            target,
            others,
            witness,
        };
        if finding.plain {
            finding.shrink();
        }
        finding
    }

    /// Leaves features and columns away as long as the target stays left out: the witness sees it all
    /// the better.
    fn shrink(&mut self) {
        let mut at = 0;
        while at < self.others.len() {
            let mut fewer = self.others.clone();
            fewer.remove(at);
            if is_left_out(&self.query, &self.target, &fewer) {
                self.others = fewer;
            } else {
                at += 1;
            }
        }
        for at in 0..self.others.len() {
            let mut column = 0;
            while column < self.others[at].columns.len() {
                let mut fewer = self.others.clone();
                fewer[at].columns.remove(column);
                if is_left_out(&self.query, &self.target, &fewer) {
                    self.others = fewer;
                } else {
                    column += 1;
                }
            }
        }
        let mut bare = self.target.clone();
        bare.columns.clear();
        if is_left_out(&self.query, &bare, &self.others) {
            self.target = bare;
        }
    }
}

fn is_left_out(query: &PointQuery, target: &Feature, others: &[Feature]) -> bool {
    let features: Vec<_> = std::iter::once(target)
        .chain(others)
        .zip(0..)
        .map(|(feature, id)| feature.for_solver(id))
        .collect();
    let answer = Tiling::single(&features).answer(&mut PointSolver::default(), query);
    !answer.contains(&0)
}

impl Display for Finding {
    fn fmt(&self, f: &mut Formatter) -> Result {
        writeln!(
            f,
            "false occlusion in scene {} ({:?}): from {:?}, range {}, prisms {}, one can see {:?} of",
            self.scene,
            self.kind,
            self.query.eye.to_array(),
            self.query.range,
            self.query.prisms,
            self.witness
        )?;
        writeln!(f, "  {:?}", self.target)?;
        if self.plain {
            writeln!(f, "which is left out with")?;
        } else {
            writeln!(
                f,
                "which is left out, but not by a new solver from one tile, with"
            )?;
        }
        for other in &self.others {
            writeln!(f, "  {other:?}")?;
        }
        Ok(())
    }
}
