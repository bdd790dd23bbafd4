//! [`Trial`], what answers are worth, and item buffers beside them.

mod report;
mod score;

use std::collections::HashSet;
use std::time::{Duration, Instant};

use embree::Device;
use indicatif::ProgressBar;
use postgres::{Client, Row};

use super::SCHEMA;
use super::contender::{Claim, Contender};
use super::race::milliseconds;
use crate::bench::item_buffer::{ItemBuffer, Sightings};
use crate::bench::surroundings::Surroundings;
use crate::bench::truth::Truth;
use crate::failure::Failure;
use crate::scene::{Feature, Surfaces};
use crate::sql_types::Box3d;
use score::Score;

/// Pixels along a side of each face of the item buffers, ascending. The truth begins with the last.
const RESOLUTIONS: [u32; 3] = [128, 512, 2048];

/// A way that has taken longer is asked no more.
const PATIENCE: Duration = Duration::from_secs(20);

/// What came out for some observers of a scene.
pub struct Trial {
    /// Of each way that is judged.
    ways: Vec<Option<Score>>,
    /// Of each resolution.
    buffers: Vec<Buffer>,
    /// What is missing from answers that claim to be complete.
    pub false_occlusions: Vec<String>,
    /// Triangles around observers, and milliseconds to read them and to build Embree's tree.
    triangles: Vec<f64>,
    reading: Vec<f64>,
    building: Vec<f64>,
}

/// An item buffer of one resolution.
struct Buffer {
    name: String,
    score: Score,
    /// Milliseconds for each observer.
    times: Vec<f64>,
}

/// Holds the ways against the truth for the first so many observers, one after the other, so that no
/// more than the surroundings of one is in memory.
pub fn run(
    client: &mut Client,
    scene: &str,
    range: f64,
    contenders: &[Contender],
    observers: usize,
    bar: &ProgressBar,
) -> Result<Trial, Failure> {
    let device = Device::new();
    let mut trial = Trial::new(contenders);
    let mut spent = vec![Duration::ZERO; contenders.len()];
    for (id, eye) in eyes(client, observers)? {
        let began = Instant::now();
        let place = Box3d { min: eye, max: eye };
        let around = Surroundings::load(client, scene, &place, range)?;
        let surfaces = Surfaces::seen_from(&around.features, std::iter::once(eye[2]));
        trial.reading.push(milliseconds(began));
        let began = Instant::now();
        let buffer = ItemBuffer::new(&device, eye, &surfaces.triangles);
        trial.building.push(milliseconds(began));
        trial.triangles.push(surfaces.triangles.len() as f64);
        let (shown, finest) = trial.look(&around, &buffer);
        let truth = Truth::new(&around.features, &surfaces)?;
        let in_range = |feature: &Feature| around.is_in_range(feature, eye);
        let visible = truth.visible(&buffer, &finest, in_range);
        for (buffer, shown) in trial.buffers.iter_mut().zip(&shown) {
            buffer.score.add(shown, &visible);
        }
        for (way, contender) in contenders.iter().enumerate() {
            if trial.ways[way].is_none() || spent[way] > PATIENCE {
                continue;
            }
            let began = Instant::now();
            let rows = client.query(&contender.single(), &[&id])?;
            spent[way] += began.elapsed();
            let answer = rows.iter().map(|row| row.get(0)).collect();
            trial.judge(way, contender, &answer, &visible, &around, eye);
        }
        bar.inc(1);
    }
    Ok(trial)
}

impl Trial {
    fn new(contenders: &[Contender]) -> Self {
        let score =
            |contender: &Contender| (contender.claim != Claim::OfAPart).then(Score::default);
        let buffer = |resolution| Buffer {
            name: format!("Embree item buffer, 6 × {resolution}²"),
            score: Score::default(),
            times: Vec::new(),
        };
        Self {
            ways: contenders.iter().map(score).collect(),
            buffers: RESOLUTIONS.map(buffer).into(),
            false_occlusions: Vec::new(),
            triangles: Vec::new(),
            reading: Vec::new(),
            building: Vec::new(),
        }
    }

    /// What each resolution shows, and all of the finest.
    fn look(
        &mut self,
        around: &Surroundings,
        buffer: &ItemBuffer,
    ) -> (Vec<HashSet<i64>>, Sightings) {
        // Warms the caches; the finest is kept.
        let mut last = buffer.look(RESOLUTIONS[0]);
        let look = |(figures, resolution): (&mut Buffer, u32)| {
            let began = Instant::now();
            last = buffer.look(resolution);
            let shown = around.shown(&last, buffer.eye);
            figures.times.push(milliseconds(began));
            shown
        };
        let shown = self.buffers.iter_mut().zip(RESOLUTIONS).map(look).collect();
        (shown, last)
    }

    fn judge(
        &mut self,
        way: usize,
        contender: &Contender,
        answer: &HashSet<i64>,
        visible: &HashSet<i64>,
        around: &Surroundings,
        eye: [f64; 3],
    ) {
        if let Some(score) = &mut self.ways[way] {
            score.add(answer, visible);
        }
        if contender.claim != Claim::Complete {
            return;
        }
        let missing = around
            .features
            .iter()
            .filter(|feature| visible.contains(&feature.id) && !answer.contains(&feature.id));
        let [x, y, z] = eye;
        self.false_occlusions.extend(missing.map(|feature| {
            format!(
                "\"{}\" leaves out {feature}, which is seen from {x}, {y}, {z}",
                contender.name
            )
        }));
    }
}

/// The first so many observers.
fn eyes(client: &mut Client, observers: usize) -> Result<Vec<(i32, [f64; 3])>, Failure> {
    let statement =
        format!("SELECT id, x, y, z FROM {SCHEMA}.observer WHERE id < {observers} ORDER BY id");
    let rows = client.query(&statement, &[])?;
    let eye = |row: &Row| (row.get(0), [row.get(1), row.get(2), row.get(3)]);
    Ok(rows.iter().map(eye).collect())
}
