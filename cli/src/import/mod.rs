//! `occlusion import`: files into a scene, in one transaction.

mod file;
mod frame;
mod ground;
mod importer;
mod level;
mod memory;
mod morton;
mod names;
mod report;
mod rows;
mod solid;
mod streets;
mod tally;
mod update;

use std::ops::ControlFlow;
use std::path::PathBuf;
use std::time::Instant;

use clap::Args;
use engine::ColumnOptions;
use formats::ReadOptions;

use crate::database::Database;
use crate::failure::{EXIT_STATUS, Failure};
use crate::terminal;
use importer::Importer;
use memory::Memory;

const EXAMPLES: &str = "Examples:
  occlusion import delft.city.jsonl --scene delft
  occlusion import helsinki.osm.pbf --scene helsinki
  occlusion import north.json south.glb --scene town --srid 28992 --replace
  occlusion import delft-2026.city.jsonl --scene delft --update";

/// Reads city models into a scene
///
/// The format of each file shows in its content: CityJSON 1.1 and 2.0, CityJSONSeq, OpenStreetMap
/// PBF, VRML97, glTF and GLB, OBJ, PLY, GeoJSON. Buildings with their parts become features, roads
/// become streets. A scene without streets gets its view region from the open space between its
/// features. All files go in together, or nothing does.
#[derive(Args, Debug)]
#[command(after_help = format!("{EXAMPLES}\n\n{EXIT_STATUS}"))]
pub struct Import {
    /// Files to read
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Scene to fill; made if it does not exist
    #[arg(long, value_name = "NAME")]
    scene: String,
    /// EPSG code of the coordinates, instead of what the files say; geographic ones are projected
    /// into it
    #[arg(long, value_name = "N")]
    srid: Option<i32>,
    /// Drop the scene first, with all that is in it
    #[arg(long, conflicts_with = "update")]
    replace: bool,
    /// Features of the scene that the files hold, too, take their new shapes and keep their numbers; those that are as
    /// they were are not touched, others and the streets stay
    #[arg(long)]
    update: bool,
    /// Solid columns of one feature at the most: fewer take less room, more hide more
    #[arg(long, value_name = "N", default_value_t = ColumnOptions::default().most)]
    most_columns: usize,
    /// Share of a feature's volume that is enough inside its columns
    #[arg(long, value_name = "SHARE", default_value_t = ColumnOptions::default().share)]
    column_share: f64,
    /// Memory to read files with, such as 500MB or 2GB, where a format can be read in pieces
    #[arg(long, value_name = "SIZE", default_value = "1GB")]
    memory: Memory,
    #[command(flatten)]
    database: Database,
}

impl Import {
    /// Runs the command.
    pub fn run(&self) -> Result<(), Failure> {
        let began = Instant::now();
        let mut files = file::open_all(&self.files)?;
        let mut client = self
            .database
            .connect_heeding(|notice| anstream::eprintln!("notice: {notice}"))?;
        let mut transaction = client.transaction()?;
        if self.replace {
            drop_scene(&mut transaction, &self.scene)?;
        }
        let bar = terminal::bytes(files.iter().map(|file| file.bytes).sum());
        let options = self.columns()?;
        let mut importer =
            Importer::begin(transaction, &self.scene, self.srid, options, self.update)?;
        for file in &mut files {
            let path = file.path.clone();
            let mut failure = None;
            let options = ReadOptions {
                srid: importer.srid(),
                batch_bytes: self.memory.batch_bytes(),
                companion: &|name| file::companion(&path, name),
            };
            let format = file.read(
                &bar,
                &options,
                &mut |batch| match importer.add(&path, batch) {
                    Ok(()) => ControlFlow::Continue(()),
                    Err(error) => {
                        failure = Some(error);
                        ControlFlow::Break(())
                    }
                },
            );
            failure.map_or(Ok(()), Err)?;
            importer.end_file(&path, format?);
        }
        bar.finish_and_clear();
        let mut report = importer.finish()?;
        report.seconds = began.elapsed().as_secs_f64();
        anstream::println!("{report}");
        Ok(())
    }

    fn columns(&self) -> Result<ColumnOptions, Failure> {
        if !(0.0..=1.0).contains(&self.column_share) {
            return Err(Failure::Input(format!(
                "column share {} is not between 0 and 1",
                self.column_share
            )));
        }
        Ok(ColumnOptions {
            share: self.column_share,
            most: self.most_columns,
            ..ColumnOptions::default()
        })
    }
}

/// Drops a scene, if there is one.
fn drop_scene(transaction: &mut postgres::Transaction<'_>, scene: &str) -> Result<(), Failure> {
    let exists = "SELECT FROM pg_catalog.pg_namespace WHERE nspname = $1";
    if transaction.query_opt(exists, &[&scene])?.is_some() {
        transaction.execute("SELECT occlusion.drop_scene($1)", &[&scene])?;
    }
    Ok(())
}
