//! Attacks the solvers from a point and from view cells with random scenes: nothing that they leave out
//! may be seen.
#![forbid(unsafe_code)]

mod cells;
#[cfg(test)]
mod directions;
mod finding;
#[cfg(test)]
mod hiders;
#[cfg(test)]
mod isovists;
mod kind;
mod observer;
mod plan;
mod roofs;
mod scene;
mod tiling;
mod trial;

use std::process::ExitCode;
use std::sync::Mutex;
use std::time::Instant;

use clap::Parser;
use engine::{CellSolver, PointSolver};
use indicatif::{ParallelProgressIterator, ProgressBar, ProgressStyle};
use rayon::prelude::*;

use cells::{CELLS, CellTrial};
use roofs::RoofTrial;
use trial::{Counts, QUERIES, Trial};

/// One scene in so many is of houses with roofs.
const WITH_ROOFS: u64 = 5;

/// Findings to print.
const PRINTED: usize = 5;

const EXAMPLES: &str = "Examples:
  attack                                the 250,000 queries of the test suite
  attack --queries 10000000 --seed 7    a long run over other scenes
  attack --cells 6000                   view cells instead of single eyes
  attack --scene 1234                   one scene of seed 1 again";

/// Asks what can be seen in random scenes, and judges exactly all that is left out
///
/// A query is an answer for one eye, range and kind of test, or for one view cell and range. The exit status is 1 if something left
/// out can be seen, or if too little was left out for the attack to mean anything.
#[derive(Parser, Debug)]
#[command(name = "attack", after_help = EXAMPLES)]
struct Arguments {
    /// How many queries to ask
    #[arg(long, value_name = "N", default_value_t = 250_000)]
    queries: u64,
    /// Solve so many view cells instead, and judge each from several eyes in it
    #[arg(long, value_name = "N", conflicts_with = "queries")]
    cells: Option<u64>,
    /// Which scenes to make
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Only this scene
    #[arg(long, value_name = "NUMBER")]
    scene: Option<u64>,
    /// Stop at the first false occlusion
    #[arg(long)]
    stop: bool,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let began = Instant::now();
    let (counts, findings) = run(&arguments);
    for finding in findings.iter().take(PRINTED) {
        println!("{finding}");
    }
    if findings.len() > PRINTED {
        println!("and {} more", findings.len() - PRINTED);
    }
    report(&counts, began.elapsed().as_secs_f64());
    // An answer of everything would withstand any attack.
    let means_something = counts.left_out * 10 > counts.features;
    if !means_something {
        println!("less than a tenth was left out: the solver, or the scenes, hide too little");
    }
    if counts.false_occlusions == 0 && means_something {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    }
}

fn run(arguments: &Arguments) -> (Counts, Vec<String>) {
    let (wanted, of_a_scene) = match arguments.cells {
        Some(cells) => (cells, CELLS),
        None => (arguments.queries, QUERIES),
    };
    let scenes = match arguments.scene {
        Some(scene) => scene..scene + 1,
        None => 0..wanted.div_ceil(of_a_scene),
    };
    let total = Mutex::new((Counts::default(), Vec::new()));
    let bar = ProgressBar::new(scenes.end - scenes.start).with_style(
        ProgressStyle::with_template("{bar:40} {pos}/{len} scenes, {eta} left")
            .unwrap_or_else(|_| ProgressStyle::default_bar()),
    );
    scenes.into_par_iter().progress_with(bar).for_each_init(
        || (PointSolver::default(), CellSolver::default()),
        |(points, cells), number| {
            if arguments.stop && !lock(&total).1.is_empty() {
                return;
            }
            let wanted = match arguments.scene {
                Some(_) => of_a_scene,
                None => wanted.saturating_sub(number * of_a_scene).min(of_a_scene),
            };
            let (counts, findings) = match arguments.cells {
                Some(_) => run_cells(arguments.seed, number, cells, wanted),
                None => run_scene(arguments.seed, number, points, wanted),
            };
            let mut total = lock(&total);
            total.0 += counts;
            total.1.extend(findings);
        },
    );
    total
        .into_inner()
        .unwrap_or_else(std::sync::PoisonError::into_inner)
}

/// One scene; what was found as it is printed.
fn run_scene(
    seed: u64,
    number: u64,
    solver: &mut PointSolver,
    queries: u64,
) -> (Counts, Vec<String>) {
    if number % WITH_ROOFS == WITH_ROOFS - 1 {
        let mut trial = RoofTrial::new(seed, number);
        trial.run(solver, queries);
        let findings = trial.findings.iter().map(ToString::to_string);
        return (trial.counts, findings.collect());
    }
    let mut trial = Trial::new(seed, number);
    trial.run(solver, queries);
    let findings = trial.findings.iter().map(ToString::to_string);
    (trial.counts, findings.collect())
}

/// The cells of one scene; what was found as it is printed.
fn run_cells(
    seed: u64,
    number: u64,
    solver: &mut CellSolver,
    wanted: u64,
) -> (Counts, Vec<String>) {
    let mut trial = CellTrial::new(seed, number);
    trial.run(solver, wanted);
    (trial.counts, trial.findings)
}

fn lock<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex
        .lock()
        .unwrap_or_else(std::sync::PoisonError::into_inner)
}

fn report(counts: &Counts, seconds: f64) {
    println!(
        "{} queries about {} features in range: {} returned, {} left out",
        counts.queries, counts.features, counts.returned, counts.left_out
    );
    println!(
        "of {} returned features that were looked at, {} were seen; {} aims at what was left out",
        counts.looked_at, counts.seen, counts.aims
    );
    println!(
        "{} false occlusions, {seconds:.1} s",
        counts.false_occlusions
    );
}
