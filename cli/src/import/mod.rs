//! `occlusion import`: files into a scene, in one transaction.

mod model;
mod morton;
mod reading;
mod report;
mod solid;
mod store;
mod streets;

use std::path::PathBuf;
use std::time::Instant;

use clap::Args;
use indicatif::ParallelProgressIterator;
use rayon::prelude::*;

use crate::database::Database;
use crate::failure::{EXIT_STATUS, Failure};
use crate::terminal;
use model::Model;
use report::Report;
use solid::Solid;

const EXAMPLES: &str = "Examples:
  occlusion import delft.city.jsonl --scene delft
  occlusion import north.json south.json --scene town --srid 28992 --replace";

/// Reads city models into a scene
///
/// The format of each file shows in its content: CityJSON 1.1 and 2.0, CityJSONSeq. Buildings with
/// their parts become features, roads become streets. A scene without streets gets its view region
/// from the open space between its features. All files go in together, or nothing does.
#[derive(Args, Debug)]
#[command(after_help = format!("{EXAMPLES}\n\n{EXIT_STATUS}"))]
pub struct Import {
    /// Files to read
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Scene to fill; made if it does not exist
    #[arg(long, value_name = "NAME")]
    scene: String,
    /// EPSG code of the coordinates, instead of what the files say
    #[arg(long, value_name = "N")]
    srid: Option<i32>,
    /// Drop the scene first, with all that is in it
    #[arg(long)]
    replace: bool,
    #[command(flatten)]
    database: Database,
}

impl Import {
    /// Runs the command.
    pub fn run(&self) -> Result<(), Failure> {
        let began = Instant::now();
        let model = reading::read(&self.files, self.srid)?;
        let mut client = self.database.connect()?;
        let mut transaction = client.transaction()?;
        let neighbours = store::prepare(&mut transaction, &self.scene, &model, self.replace)?;
        let solids = solids(&model, &neighbours);
        let streets = streets::of_roads(&model, &solids);
        let writing = terminal::spinner("writing");
        let ids = store::features(&mut transaction, &self.scene, &model, &solids)?;
        store::shapes(&mut transaction, &self.scene, &model, &solids, &ids)?;
        store::streets(&mut transaction, &self.scene, &streets)?;
        writing.set_message("view region");
        let open_space = store::view_region(&mut transaction, &self.scene)?;
        store::analyze(&mut transaction, &self.scene)?;
        transaction.commit()?;
        writing.finish_and_clear();
        let report = Report {
            scene: &self.scene,
            model: &model,
            solids: &solids,
            streets: streets.len(),
            open_space,
            seconds: began.elapsed().as_secs_f64(),
        };
        anstream::println!("{report}");
        Ok(())
    }
}

/// What each feature is made of, computed on all cores.
fn solids(model: &Model, neighbours: &[engine::Box3d]) -> Vec<Solid> {
    let bar = terminal::bar(model.features.len(), "inner envelopes");
    let features = model.features.par_iter().progress_with(bar);
    let mut solids: Vec<Solid> = features.map(Solid::of).collect();
    let envelopes: Vec<engine::Box3d> = solids
        .iter()
        .map(|solid| solid.envelope)
        .chain(neighbours.iter().copied())
        .collect();
    let ground = engine::LocalGround::new(&envelopes);
    for (solid, feature) in solids.iter_mut().zip(&model.features) {
        solid.keep_ground(&feature.class, &ground);
    }
    solids
}
