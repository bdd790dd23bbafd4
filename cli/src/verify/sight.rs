//! [`Checker`], what can truly be seen from an eye, held against an answer.

use std::collections::HashSet;

use oracle::Sight;
use postgres::GenericClient;
use rayon::prelude::*;
use renderer::{ItemBuffer, Seen, Sighting, pixel_direction};

use super::fault::Fault;
use super::truth::Truth;
use crate::failure::Failure;
use crate::scene::{Scene, number};
use crate::sql_types::Point3d;

/// The numbers of the features that the database says can be seen.
pub fn ask(
    client: &mut impl GenericClient,
    scene: &str,
    eye: [f64; 3],
    range: f64,
) -> Result<HashSet<i64>, Failure> {
    let statement = "SELECT feature_id FROM occlusion.visible_features($1, $2, $3)";
    let rows = client.query(statement, &[&scene, &Point3d(eye), &range])?;
    Ok(rows.iter().map(|row| row.get(0)).collect())
}

/// What one observer sees, in counts. All are features within range of the eye.
#[derive(Debug, Default)]
pub struct View {
    /// In range.
    pub in_range: usize,
    /// In the answer.
    pub returned: usize,
    /// Seen in the item buffer, or by a ray.
    pub visible: usize,
    /// Of these, returned and seen by a ray alone: the item buffer has no pixel there.
    pub seen_by_ray: usize,
    /// Not seen.
    pub hidden: usize,
    /// Hidden by a single convex piece.
    pub hidden_by_one: usize,
    /// Of these, missing from the answer.
    pub left_out_by_one: usize,
    /// Of the hidden ones, missing from the answer.
    pub left_out: usize,
    /// Seen in the item buffer and missing from the answer.
    pub disputed: usize,
    /// Rays that were aimed.
    pub rays: usize,
    /// False occlusions, confirmed exactly.
    pub faults: Vec<Fault>,
}

/// A feature within range.
struct Candidate {
    position: usize,
    returned: bool,
    sighting: Option<Sighting>,
    hidden_by_one: bool,
}

/// What was found out about a candidate.
#[derive(Default)]
struct Finding {
    rays: usize,
    seen_by_ray: bool,
    fault: Option<Fault>,
}

/// Looks around in one scene.
pub struct Checker<'a> {
    scene: &'a Scene,
    truth: &'a Truth,
    buffer: ItemBuffer<'a>,
    resolution: u32,
}

impl<'a> Checker<'a> {
    /// Looks by means of an item buffer of that resolution.
    pub fn new(
        scene: &'a Scene,
        truth: &'a Truth,
        buffer: ItemBuffer<'a>,
        resolution: u32,
    ) -> Self {
        Self {
            scene,
            truth,
            buffer,
            resolution,
        }
    }

    /// Holds an answer against what can be seen from an eye.
    pub fn look(
        &mut self,
        eye: [f64; 3],
        range: f64,
        answer: &HashSet<i64>,
    ) -> Result<View, Failure> {
        let seen = self.buffer.seen(eye)?;
        let candidates = self.candidates(eye, range, answer, &seen);
        let count = |is: fn(&Candidate) -> bool| candidates.iter().filter(|c| is(c)).count();
        let findings: Vec<Finding> = candidates
            .par_iter()
            .map(|candidate| self.examine(eye, candidate))
            .collect();
        let sum = |of: fn(&Finding) -> usize| findings.iter().map(of).sum::<usize>();
        let drawn = count(|c| c.sighting.is_some());
        let seen_by_ray = sum(|finding| usize::from(finding.seen_by_ray));
        Ok(View {
            in_range: candidates.len(),
            returned: answer.len(),
            visible: drawn + seen_by_ray,
            seen_by_ray,
            hidden: candidates.len() - drawn - seen_by_ray,
            hidden_by_one: count(|c| c.hidden_by_one),
            left_out_by_one: count(|c| c.hidden_by_one && !c.returned),
            left_out: count(|c| c.sighting.is_none() && !c.returned),
            disputed: count(|c| c.sighting.is_some() && !c.returned),
            rays: sum(|finding| finding.rays),
            faults: findings
                .into_iter()
                .filter_map(|finding| finding.fault)
                .collect(),
        })
    }

    fn candidates(
        &self,
        eye: [f64; 3],
        range: f64,
        answer: &HashSet<i64>,
        seen: &Seen,
    ) -> Vec<Candidate> {
        let features = self.scene.features.par_iter().enumerate();
        let in_range = features.filter(|(_, feature)| feature.envelope.distance(eye) <= range);
        in_range
            .map(|(position, feature)| {
                let hiding =
                    self.truth
                        .occluders
                        .hiding(eye, number(position), &feature.envelope.into());
                Candidate {
                    position,
                    returned: answer.contains(&feature.id),
                    sighting: seen.get(&number(position)).copied(),
                    hidden_by_one: hiding.is_some(),
                }
            })
            .collect()
    }

    /// Casts rays at a feature of which the item buffer does not say enough: that was left out, or
    /// returned and not drawn.
    fn examine(&self, eye: [f64; 3], candidate: &Candidate) -> Finding {
        if !candidate.returned {
            return self.challenge(eye, candidate);
        }
        if candidate.sighting.is_some() {
            return Finding::default();
        }
        let (rays, target) = self.aim(eye, candidate);
        Finding {
            rays,
            seen_by_ray: target.is_some(),
            fault: None,
        }
    }

    /// Tries to see a feature that was left out: through the pixel where it was drawn, and by rays
    /// all over its surface.
    fn challenge(&self, eye: [f64; 3], candidate: &Candidate) -> Finding {
        let fault = |target: [f64; 3], how| Fault::FalseOcclusion {
            feature: self.scene.features[candidate.position].to_string(),
            eye,
            target,
            how,
        };
        let id = number(candidate.position);
        if let Some(Sighting { face, x, y, .. }) = candidate.sighting {
            let direction = pixel_direction(face, x, y, self.resolution);
            let hit = self.truth.caster.first_hit(eye, direction);
            if hit.is_some_and(|hit| hit.ids.contains(&id)) {
                let target = std::array::from_fn(|axis| eye[axis] + direction[axis]);
                let how = "a pixel of the item buffer, recast exactly";
                return Finding {
                    rays: 1,
                    seen_by_ray: false,
                    fault: Some(fault(target, how)),
                };
            }
        }
        let (rays, target) = self.aim(eye, candidate);
        let how = "a ray at its surface, cast exactly";
        Finding {
            rays,
            seen_by_ray: false,
            fault: target.map(|target| fault(target, how)),
        }
    }

    /// Casts rays at points all over the surface of a feature until one gets there; returns how many
    /// it took, and which point can be seen.
    fn aim(&self, eye: [f64; 3], candidate: &Candidate) -> (usize, Option<[f64; 3]>) {
        let id = number(candidate.position);
        let targets = &self.truth.targets[candidate.position];
        let is_clear =
            |&target: &[f64; 3]| self.truth.caster.is_clear(eye, target, Some(id)) == Sight::Clear;
        match targets.iter().position(is_clear) {
            Some(place) => (place + 1, Some(targets[place])),
            None => (targets.len(), None),
        }
    }
}
