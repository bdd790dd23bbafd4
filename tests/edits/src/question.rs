//! [`Question`], what is asked of a scene, and whether its answer left out something that can be seen.

use std::collections::HashSet;
use std::ops::AddAssign;

use fastrand::Rng;
use oracle::{LeftOut, PointJudge};
use serde_json::Value;

use crate::plan::{Bounds, point_sql};
use crate::thing::{BLOCKS, PITCH};
use crate::truth::Truth;

/// How far observers see, and view cells reach, metres.
pub const RANGE: f64 = 40.0;

/// Vertical planes to aim in, a feature that was left out.
const PLANES: usize = 12;

/// One returned feature in so many is looked at, to see that looking finds what can be seen.
const LOOKED_AT: u8 = 32;

/// What was counted.
#[derive(Clone, Copy, Debug, Default)]
pub struct Counts {
    /// Answers, by kind: live or through a cell, visible sets, along a way, from where.
    pub answers: [u64; 4],
    /// Visible sets that were asked for where no cell could be used.
    pub unused: u64,
    /// Features that answers left out, and that were judged.
    pub left_out: u64,
    /// Returned features that were looked at, and of these, seen.
    pub looked_at: u64,
    pub seen: u64,
    pub false_occlusions: u64,
}

impl AddAssign for Counts {
    fn add_assign(&mut self, other: Self) {
        for (count, more) in self.answers.iter_mut().zip(other.answers) {
            *count += more;
        }
        self.unused += other.unused;
        self.left_out += other.left_out;
        self.looked_at += other.looked_at;
        self.seen += other.seen;
        self.false_occlusions += other.false_occlusions;
    }
}

/// What one observer asks.
#[derive(Clone, Debug)]
pub struct Question {
    eye: [f64; 3],
    /// Where the observer goes in ten seconds.
    way: [f64; 2],
    /// A feature to ask from where it can be seen.
    feature: i64,
}

impl Question {
    /// From the streets mostly, else from anywhere, also from inside of houses.
    pub fn random(rng: &mut Rng, truth: &Truth) -> Self {
        let side = PITCH * f64::from(BLOCKS);
        let anywhere = [0, 1].map(|_| rng.f64() * side);
        let eye = match rng.choice(&truth.streets) {
            Some(street) if rng.u8(..4) > 0 => {
                let (near, far) = (street.ring[0], street.ring[2]);
                let [x, y] = [0, 1].map(|axis| {
                    let share = rng.f64();
                    near[axis] * (1.0 - share) + far[axis] * share
                });
                let [low, high] = street.eyes;
                [x, y, [low, high, (low + high) / 2.0][rng.usize(..3)]]
            }
            _ => [
                anywhere[0],
                anywhere[1],
                [0.1, 1.7, 6.0, 25.0][rng.usize(..4)],
            ],
        };
        Self {
            eye,
            way: [0, 1].map(|_| (rng.f64() - 0.5) * 20.0),
            feature: truth.any(rng).map_or(0, |known| known.id),
        }
    }

    /// Expressions of JSON that ask it.
    pub fn expressions(&self, scene: &str) -> Vec<String> {
        let eye = point_sql(self.eye);
        let [x, y] = self.way.map(|metres| metres / 10.0);
        vec![
            format!("(SELECT json_agg(feature_id) FROM occlusion.visible_features('{scene}', {eye}, {RANGE:?}))"),
            format!(
                "(SELECT json_build_array((SELECT json_agg(slot) FROM occlusion.unnest(s.visible) AS u (slot)), s.box::text, s.range)
                  FROM occlusion.visible_set('{scene}', {eye}) AS s)"
            ),
            format!(
                "(SELECT json_agg(feature_id) FROM occlusion.visible_ahead('{scene}', {eye}, {}, 10, {RANGE:?}))",
                point_sql([x, y, 0.0])
            ),
            // Whoever deleted it since has no answer.
            format!(
                "(SELECT json_agg(v.box::text) FROM {scene}.feature AS f
                  CROSS JOIN LATERAL occlusion.visible_from('{scene}', f.id) AS v WHERE f.id = {})",
                self.feature
            ),
        ]
    }

    /// Judges the answers to these expressions; what is wrong, in words.
    pub fn judge(
        &self,
        truth: &Truth,
        answers: &[Value],
        rng: &mut Rng,
        counts: &mut Counts,
    ) -> Vec<String> {
        let mut work = Judgement {
            truth,
            rng,
            counts,
            findings: Vec::new(),
        };
        work.answer("visible_features", &[self.eye], &ids(&answers[0]), RANGE);
        work.counts.answers[0] += 1;
        work.set(self.eye, &answers[1]);
        let way: Vec<[f64; 3]> = [0.0, work.rng.f64(), 1.0]
            .map(|share| {
                let [x, y, z] = self.eye;
                [x + self.way[0] * share, y + self.way[1] * share, z]
            })
            .to_vec();
        work.answer("visible_ahead", &way, &ids(&answers[2]), RANGE);
        work.counts.answers[2] += 1;
        work.seen_from(self.eye, self.feature, &answers[3]);
        work.findings
    }
}

/// One judging.
struct Judgement<'a> {
    truth: &'a Truth,
    rng: &'a mut Rng,
    counts: &'a mut Counts,
    findings: Vec<String>,
}

impl Judgement<'_> {
    /// Looks from the eyes for everything that an answer has not.
    fn answer(&mut self, what: &str, eyes: &[[f64; 3]], returned: &HashSet<i64>, range: f64) {
        self.look(what, eyes, range, |known| returned.contains(&known.id));
    }

    fn look(
        &mut self,
        what: &str,
        eyes: &[[f64; 3]],
        range: f64,
        is_returned: impl Fn(&crate::truth::Known) -> bool,
    ) {
        for &eye in eyes {
            let mut judge = PointJudge::new(&self.truth.judged, eye);
            for (feature, known) in self.truth.known.iter().enumerate() {
                // A little wider than the range, so that those at its end are judged.
                if known.thing.envelope.distance(eye) > range + 1e-6 {
                    continue;
                }
                let left_out = LeftOut {
                    feature,
                    prism: true,
                    range,
                };
                if is_returned(known) {
                    if self.rng.u8(..LOOKED_AT) == 0 {
                        self.counts.looked_at += 1;
                        let search = judge.search(&left_out, PLANES, self.rng);
                        self.counts.seen += u64::from(search.witness.is_some());
                    }
                    continue;
                }
                self.counts.left_out += 1;
                if let Some(witness) = judge.search(&left_out, PLANES, self.rng).witness {
                    self.counts.false_occlusions += 1;
                    self.findings.push(format!(
                        "{what} leaves out feature {} (slot {:?}), which is seen from {eye:?} at {witness:?}",
                        known.id, known.slot
                    ));
                }
            }
        }
    }

    /// A visible set, from the eye that asked and from others in the box.
    fn set(&mut self, eye: [f64; 3], answer: &Value) {
        self.counts.answers[1] += 1;
        let Some(parts) = answer.as_array() else {
            self.counts.unused += 1;
            return;
        };
        let slots = ids(&parts[0]);
        let bounds = Bounds::parse(parts[1].as_str().expect("a box"));
        let range = parts[2].as_f64().expect("a range");
        let others = (0..2).map(|_| {
            std::array::from_fn(|axis| {
                let share = self.rng.f64();
                bounds.min[axis] * (1.0 - share) + bounds.max[axis] * share
            })
        });
        let eyes: Vec<[f64; 3]> = std::iter::once(eye).chain(others).collect();
        let can_be = |eye: &[f64; 3]| {
            self.truth.is_in_streets(*eye) && PointJudge::new(&self.truth.judged, *eye).is_outside()
        };
        let eyes: Vec<[f64; 3]> = eyes.into_iter().filter(can_be).collect();
        self.look("visible_set", &eyes, range, |known| {
            known.slot.is_some_and(|slot| slots.contains(&slot))
        });
    }

    /// Whether the eye, if it sees the feature, is in one of the boxes from which that may be seen.
    fn seen_from(&mut self, eye: [f64; 3], id: i64, answer: &Value) {
        self.counts.answers[3] += 1;
        let Some(feature) = self.truth.known.iter().position(|known| known.id == id) else {
            return;
        };
        let boxes = answer.as_array().into_iter().flatten();
        let is_held = boxes
            .filter_map(Value::as_str)
            .any(|text| Bounds::parse(text).is_over(eye));
        let mut judge = PointJudge::new(&self.truth.judged, eye);
        if is_held || !self.truth.is_in_streets(eye) || !judge.is_outside() {
            return;
        }
        let left_out = LeftOut {
            feature,
            prism: true,
            range: RANGE,
        };
        self.counts.left_out += 1;
        if let Some(witness) = judge.search(&left_out, PLANES, self.rng).witness {
            self.counts.false_occlusions += 1;
            self.findings.push(format!(
                "visible_from has no box for feature {id}, which is seen from {eye:?} at {witness:?}"
            ));
        }
    }
}

/// The numbers of an array, or none.
fn ids(answer: &Value) -> HashSet<i64> {
    let values = answer.as_array().into_iter().flatten();
    values.filter_map(Value::as_i64).collect()
}
