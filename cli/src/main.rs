//! The command line of `pg_occlusion`: brings city models into a database, has occlusion volumes
//! computed there, asks what can be seen, draws it, and verifies that no visible feature is missing.
//! It holds no geometry of its own: `formats` reads, `engine` measures, the extension in the
//! database computes and answers, `oracle` and `renderer` check.
#![forbid(unsafe_code)]

mod bench;
mod database;
mod export;
mod failure;
mod field_of_view;
mod generate;
mod import;
mod query;
mod render;
mod scene;
mod sql_types;
mod terminal;
mod verify;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

use failure::{EXIT_STATUS, FOUND_FAULTS, Failure};
use terminal::BAD;

const EXAMPLES: &str = "Examples:
  occlusion import delft.city.jsonl --scene delft
  occlusion generate delft --range 500
  occlusion query delft --observer 85200,446800,1.7 --heading 45 --angle 90
  occlusion verify delft --observers 100
  occlusion render delft --observer 85200,446800,1.7 -o picture.png
  occlusion export delft --observer 85200,446800,1.7 -o visible.glb
  occlusion bench index --rows 100000";

/// Which features of a 3D city are visible from here, by index, with no false occlusion
#[derive(Parser, Debug)]
#[command(name = "occlusion", version, after_help = format!("{EXAMPLES}\n\n{EXIT_STATUS}"))]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand, Debug)]
enum Command {
    Import(import::Import),
    Generate(generate::Generate),
    Query(query::Query),
    Verify(verify::Verify),
    Render(render::Render),
    Export(export::Export),
    Bench(bench::Bench),
}

fn main() -> ExitCode {
    // Wrong usage ends here, with status 2.
    match run(Arguments::parse().command) {
        Ok(status) => status,
        Err(failure) => {
            anstream::eprintln!("{BAD}error:{BAD:#} {failure}");
            failure.exit_code().into()
        }
    }
}

fn run(command: Command) -> Result<ExitCode, Failure> {
    match command {
        Command::Import(import) => import.run()?,
        Command::Generate(generate) => generate.run()?,
        Command::Query(query) => query.run()?,
        Command::Render(render) => render.run()?,
        Command::Export(export) => export.run()?,
        Command::Verify(verify) if !verify.run()? => return Ok(FOUND_FAULTS.into()),
        Command::Bench(bench) if !bench.run()? => return Ok(FOUND_FAULTS.into()),
        Command::Verify(_) | Command::Bench(_) => {}
    }
    Ok(ExitCode::SUCCESS)
}
