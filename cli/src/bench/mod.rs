//! `occlusion bench`: measures this extension against others.

mod cells;
mod edits;
mod format;
mod index;
#[cfg(feature = "embree")]
mod item_buffer;
mod observers;
mod point;
mod quantile;
mod surroundings;
mod table;
#[cfg(feature = "embree")]
mod truth;

use clap::{Args, Subcommand};

use crate::failure::{EXIT_STATUS, Failure};

const EXAMPLES: &str = "Examples:
  occlusion bench index --rows 100000
  occlusion bench index --format markdown
  occlusion bench point delft --range 500
  occlusion bench cells delft --cells 20
  occlusion bench edits town --rows 1 --rows 1000";

/// Measures this extension against others, in one run
#[derive(Args, Debug)]
#[command(after_help = format!("{EXAMPLES}\n\n{EXIT_STATUS}"))]
pub struct Bench {
    #[command(subcommand)]
    benchmark: Benchmark,
}

#[derive(Subcommand, Debug)]
enum Benchmark {
    Index(index::Index),
    Point(point::Point),
    Cells(cells::Cells),
    Edits(edits::Edits),
}

impl Bench {
    /// Runs the benchmark; whether all answers are right.
    pub fn run(&self) -> Result<bool, Failure> {
        match &self.benchmark {
            Benchmark::Index(index) => index.run(),
            Benchmark::Point(point) => point.run(),
            Benchmark::Cells(cells) => cells.run(),
            Benchmark::Edits(edits) => edits.run(),
        }
    }
}
