//! Attacks the readers with mutated files, each within limits of time and memory.
#![forbid(unsafe_code)]

mod attack;
mod corpus;
mod mutation;
mod reader;

use std::process::ExitCode;
use std::time::Duration;

use clap::Parser;
use peak_alloc::PeakAlloc;

use attack::Attack;
use reader::Reader;

#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;

const EXAMPLES: &str = "Examples:
  fuzz                             all readers, 20 s each
  fuzz gltf vrml97 --seconds 600   two readers, ten minutes each
  fuzz ply --seed 7                another choice of mutations";

/// Feeds mutated files to readers: none may panic, hang, or take more than a gigabyte
///
/// Prints how many inputs each reader took. An input that fails is kept in the folder fuzz-failures,
/// and the exit status is 1.
#[derive(Parser, Debug)]
#[command(name = "fuzz", after_help = EXAMPLES)]
struct Arguments {
    /// Readers to attack; without any all of them
    #[arg(value_name = "READER")]
    readers: Vec<Reader>,
    /// How long to attack each, seconds
    #[arg(long, value_name = "SECONDS", default_value_t = 20)]
    seconds: u64,
    /// Which mutations to try
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let readers = if arguments.readers.is_empty() {
        Reader::ALL.to_vec()
    } else {
        arguments.readers
    };
    let time = Duration::from_secs(arguments.seconds);
    let withstood = |reader: &Reader| Attack::new(*reader, arguments.seed).run(time);
    // Every reader is attacked, whatever became of the others.
    match readers
        .iter()
        .map(withstood)
        .filter(|withstood| !withstood)
        .count()
    {
        0 => ExitCode::SUCCESS,
        _ => ExitCode::FAILURE,
    }
}
