//! `occlusion verify`: holds every claim of a scene against code that shares nothing with what made
//! it.

mod cells;
mod fault;
mod lottery;
mod observers;
mod report;
mod sight;
mod stored;
mod tally;
mod truth;

use std::time::Instant;

use clap::Args;
use clap::builder::RangedU64ValueParser;
use postgres::{IsolationLevel, Transaction};
use renderer::Renderer;

use crate::database::{Database, literal, shell_word};
use crate::failure::{EXIT_STATUS, Failure};
use crate::scene::{self, Scene, Surfaces};
use crate::terminal;
use cells::{CellChecker, CellTally};
use fault::Fault;
use lottery::Lottery;
use report::Report;
use sight::Checker;
use tally::Tally;
use truth::Truth;

const EXAMPLES: &str = "Examples:
  occlusion verify delft
  occlusion verify delft --observers 10 --resolution 4096 --json
  occlusion verify delft --observers 0 --cells";

/// Proves that nothing visible is missing from the answers, or shows what is
///
/// Every stored occlusion volume, solid column, inner and outer envelope is checked by exact arithmetic. From
/// observers in the streets, half of them on corners and edges of volumes, the real meshes are drawn
/// as cube maps of feature numbers, and rays are aimed at each feature that the answer left out, or has
/// though no pixel shows it.
/// What is disputed is recast exactly.
///
/// With --cells every witness of every view cell is checked by exact arithmetic, and rays are aimed at what
/// the cell leaves out, from its corners and edges, the top and the bottom of its eyes, and places inside.
#[derive(Args, Debug)]
#[command(after_help = format!("{EXAMPLES}\n\n{EXIT_STATUS}"))]
pub struct Verify {
    /// Scene
    scene: String,
    /// How many observers
    #[arg(long, value_name = "N", default_value_t = 100)]
    observers: usize,
    /// Seed of all random choices
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// How far observers see, metres
    #[arg(long, value_name = "METRES", default_value_t = 500.0)]
    range: f64,
    /// How far above eyes in the streets observers look from, metres
    #[arg(
        long,
        value_name = "METRES",
        default_value_t = 0.0,
        allow_negative_numbers = true
    )]
    above: f64,
    /// Pixels along a side of each of the six faces
    #[arg(long, value_name = "PIXELS", default_value_t = 1024,
          value_parser = RangedU64ValueParser::<u32>::new().range(1..))]
    resolution: u32,
    /// Rays at each feature that an answer left out, or has though no pixel shows it
    #[arg(long, value_name = "N", default_value_t = 64)]
    rays: usize,
    /// Points all over the solid columns that must be inside, besides the proofs
    #[arg(long, value_name = "N", default_value_t = 100_000)]
    samples: usize,
    /// Check every view cell, too
    #[arg(long)]
    cells: bool,
    /// Print JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    database: Database,
}

impl Verify {
    /// Runs the command; whether all is well.
    pub fn run(&self) -> Result<bool, Failure> {
        let began = Instant::now();
        let mut client = self.database.connect()?;
        let mut transaction = client
            .build_transaction()
            .isolation_level(IsolationLevel::RepeatableRead)
            .read_only(true)
            .start()?;
        let loading = terminal::spinner("loading the scene");
        let scene = scene::load(&mut transaction, &self.scene)?;
        let count = scene::count_volumes(&mut transaction, &self.scene)?;
        loading.finish_and_clear();
        self.require_streets(&scene)?;
        let mut faults = stored::check_features(&scene, self.samples);
        let mut lottery = Lottery::new(self.observers * observers::TRIES, self.seed);
        let checker = stored::VolumeChecker::new(&scene);
        let bar = terminal::bar(count, "volumes");
        scene::stream_volumes(&mut transaction, &self.scene, |volumes| {
            faults.extend(checker.check(volumes));
            lottery.enter(volumes);
            bar.inc(volumes.len() as u64);
        })?;
        bar.finish_and_clear();
        let stored_seconds = began.elapsed().as_secs_f64();
        let renderer = Renderer::new()?;
        let surfaces = Surfaces::of(&scene);
        let truth = Truth::new(&scene, &surfaces, self.rays, self.seed)?;
        let of_cells = match self.cells {
            true => Some(self.check_cells(&mut transaction, &scene, &truth, &mut faults)?),
            false => None,
        };
        let mesh = surfaces.mesh();
        let buffer = renderer.item_buffer(&mesh, self.resolution)?;
        let mut checker = Checker::new(&scene, &truth, buffer, self.resolution);
        let mut observers =
            observers::choose(&scene, &lottery.winners(), self.observers, self.seed);
        for eye in &mut observers.eyes {
            eye[2] += self.above;
        }
        let bar = terminal::bar(observers.eyes.len(), "observers");
        let mut tally = Tally::default();
        for eye in &observers.eyes {
            let answer = sight::ask(&mut transaction, &self.scene, *eye, self.range)?;
            let view = checker.look(*eye, self.range, &answer)?;
            tally.add(&view);
            faults.extend(view.faults);
            bar.inc(1);
        }
        bar.finish_and_clear();
        let report = Report {
            verify: self,
            counts: counts(&scene, count),
            on_volumes: observers.on_volumes,
            tally,
            of_cells,
            faults: &faults,
            adapter: renderer.adapter_name(),
            stored_seconds,
            seconds: began.elapsed().as_secs_f64(),
        };
        match self.json {
            true => println!("{:#}", report.json()),
            false => anstream::print!("{report}"),
        }
        Ok(faults.is_empty())
    }

    fn check_cells(
        &self,
        client: &mut Transaction<'_>,
        scene: &Scene,
        truth: &Truth,
        faults: &mut Vec<Fault>,
    ) -> Result<CellTally, Failure> {
        let cells = scene::view_cells(client, &self.scene)?;
        if cells.is_empty() {
            return Err(scene::no_view_cells(&self.scene));
        }
        let mut checker = CellChecker::new(scene, truth, self.seed)?;
        let bar = terminal::bar(cells.len(), "view cells");
        for cell in &cells {
            let witnesses = scene::witnesses(client, &self.scene, cell.id)?;
            faults.extend(checker.check(cell, &witnesses));
            bar.inc(1);
        }
        bar.finish_and_clear();
        Ok(checker.tally)
    }

    fn require_streets(&self, scene: &Scene) -> Result<(), Failure> {
        if self.observers == 0 || !scene.streets.is_empty() {
            return Ok(());
        }
        Err(Failure::Unready(format!(
            "scene \"{}\" has no streets, so there is no place for observers\n  \
             hint: SELECT occlusion.generate_view_region({}) makes some from the open space",
            self.scene,
            literal(&self.scene)
        )))
    }

    /// The command that shows what an observer sees.
    fn picture_of(&self, fault: &Fault) -> Option<String> {
        let Fault::FalseOcclusion {
            eye: [x, y, z],
            target,
            ..
        } = fault
        else {
            return None;
        };
        let (east, north) = (target[0] - x, target[1] - y);
        let heading = east.atan2(north).to_degrees();
        let pitch = (target[2] - z).atan2(east.hypot(north)).to_degrees();
        Some(format!(
            "occlusion render {} --observer={x},{y},{z} --heading={heading:.2} --pitch={pitch:.2} \
             --angle 60 --range {}{}",
            shell_word(&self.scene),
            self.range,
            self.database.as_argument()
        ))
    }
}

/// How much was checked.
fn counts(scene: &Scene, volumes: usize) -> [(&'static str, usize); 5] {
    let features = || scene.features.iter();
    [
        ("features", features().count()),
        (
            "meshes",
            features().filter(|feature| feature.mesh.is_some()).count(),
        ),
        (
            "inner envelopes",
            features().filter(|feature| feature.inner.is_some()).count(),
        ),
        (
            "solid columns",
            features().map(|feature| feature.columns.len()).sum(),
        ),
        ("occlusion volumes", volumes),
    ]
}
