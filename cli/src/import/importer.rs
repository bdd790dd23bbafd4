//! [`Importer`], a scene that is being filled.

use std::path::Path;

use engine::ColumnOptions;
use formats::{Feature, Format, SceneDescription};
use postgres::Transaction;
use rayon::prelude::*;

use super::frame::Frame;
use super::ground;
use super::names::Names;
use super::report::Report;
use super::solid::Solid;
use super::tally::Tally;
use super::{rows, streets};
use crate::database::quoted;
use crate::failure::Failure;
use crate::terminal;

/// A scene that is being filled, within a transaction.
pub struct Importer<'a> {
    transaction: Transaction<'a>,
    scene: &'a str,
    options: ColumnOptions,
    frame: Frame,
    names: Names,
    ids: Vec<i64>,
    roads: Vec<formats::Street>,
    tally: Tally,
}

impl<'a> Importer<'a> {
    /// Makes sure that the scene is there.
    pub fn begin(
        mut transaction: Transaction<'a>,
        scene: &'a str,
        srid: Option<i32>,
        options: ColumnOptions,
    ) -> Result<Self, Failure> {
        let exists = "SELECT FROM pg_catalog.pg_namespace WHERE nspname = $1";
        let mut known = None;
        if transaction.query_opt(exists, &[&scene])?.is_some() {
            transaction.execute("SELECT occlusion.require_scene($1)", &[&scene])?;
            let statement = format!("SELECT srid FROM {}.scene_info", quoted(scene));
            known = transaction
                .query_opt(&statement, &[])?
                .map(|row| row.get(0));
            refuse_other_frame(scene, srid, known)?;
        } else {
            transaction.execute("SELECT occlusion.create_scene($1)", &[&scene])?;
        }
        Ok(Self {
            transaction,
            scene,
            options,
            frame: Frame::new(srid, known),
            names: Names::default(),
            ids: Vec::new(),
            roads: Vec::new(),
            tally: Tally::default(),
        })
    }

    /// EPSG code of the coordinates, as far as it is known.
    pub fn srid(&self) -> Option<i32> {
        self.frame.srid()
    }

    /// Writes a batch of a file.
    pub fn add(&mut self, path: &Path, batch: SceneDescription) -> Result<(), Failure> {
        self.frame.agree(batch.srid, path)?;
        self.names
            .take(&mut self.transaction, self.scene, path, &batch.features)?;
        let options = &self.options;
        let solid = |feature: &Feature| {
            Solid::of(feature, options).map_err(|problem| {
                let place = format!("{}, object {:?}", path.display(), feature.name);
                Failure::Input(format!("{place}: {problem}"))
            })
        };
        let solids: Vec<Solid> = batch
            .features
            .par_iter()
            .map(solid)
            .collect::<Result<_, _>>()?;
        let ids = rows::features(&mut self.transaction, self.scene, &batch.features, &solids)?;
        rows::shapes(&mut self.transaction, self.scene, &ids, &solids)?;
        rows::models(&mut self.transaction, self.scene, &ids, &solids)?;
        let source = path.display().to_string();
        let (skipped, changed) = (&batch.skipped, &batch.changed);
        rows::remarks(&mut self.transaction, self.scene, &source, skipped, changed)?;
        self.ids.extend(ids);
        self.tally.add(&batch, &solids);
        self.roads.extend(batch.streets);
        Ok(())
    }

    /// Notes that a file came to its end.
    pub fn end_file(&mut self, path: &Path, format: Format) {
        let file = format!("{} ({format})", path.display());
        self.tally.files.push(file);
    }

    /// Does what needs the whole scene, and commits.
    pub fn finish(mut self) -> Result<Report<'a>, Failure> {
        let spinner = terminal::spinner("streets");
        let hanging = ground::settle(&mut self.transaction, self.scene, &self.ids)?;
        self.tally.take_down(&hanging);
        let mut made = 0;
        if !self.roads.is_empty() {
            let streets = streets::of_roads(&mut self.transaction, self.scene, &self.roads)?;
            made = streets.len();
            let rows: Vec<_> = streets
                .into_iter()
                .map(|street| ("road", street.area, [street.eye_low, street.eye_high]))
                .collect();
            rows::streets(&mut self.transaction, self.scene, &rows)?;
        }
        spinner.set_message("view region");
        let open_space = streets::open_space(&mut self.transaction, self.scene)?;
        spinner.set_message("tiles");
        let pack = "SELECT occlusion.pack_tiles($1, optional => true)";
        self.transaction.execute(pack, &[&self.scene])?;
        self.describe()?;
        self.transaction.commit()?;
        spinner.finish_and_clear();
        Ok(Report {
            scene: self.scene,
            srid: self.frame.srid(),
            tally: self.tally,
            streets: made,
            open_space,
            seconds: 0.0,
        })
    }

    /// Says what the scene is, and tells the planner what is there now.
    fn describe(&mut self) -> Result<(), Failure> {
        let schema = quoted(self.scene);
        if let Some(srid) = self.frame.srid() {
            let statement = format!("UPDATE {schema}.scene_info SET srid = $1 WHERE srid <> $1");
            self.transaction.execute(&statement, &[&srid])?;
        }
        let statement = format!(
            "UPDATE {schema}.scene_info SET attribution = concat_ws('; ', attribution, $1::text) \
             WHERE position($1 IN coalesce(attribution, '')) = 0"
        );
        for attribution in &self.tally.attributions {
            self.transaction.execute(&statement, &[attribution])?;
        }
        let tables = [
            "feature",
            "mesh",
            "model",
            "inner_envelope",
            "solid_column",
            "street",
            "tile",
        ];
        let tables = tables.map(|table| format!("{schema}.{table}")).join(", ");
        Ok(self
            .transaction
            .batch_execute(&format!("ANALYZE {tables}"))?)
    }
}

/// Coordinates of two frames do not mix; an unknown frame goes with any.
fn refuse_other_frame(scene: &str, asked: Option<i32>, known: Option<i32>) -> Result<(), Failure> {
    match (asked, known) {
        (Some(srid), Some(known)) if known != 0 && srid != known => Err(Failure::Input(format!(
            "scene \"{scene}\" has SRID {known}, not {srid}"
        ))),
        _ => Ok(()),
    }
}
