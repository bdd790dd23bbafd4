//! [`Importer`], a scene that is being filled.

use std::collections::HashSet;
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
use super::{rows, streets, update};
use crate::database::quoted;
use crate::failure::Failure;
use crate::terminal;

/// A scene that is being filled, within a transaction.
pub struct Importer<'a> {
    transaction: Transaction<'a>,
    scene: &'a str,
    options: ColumnOptions,
    updates: bool,
    frame: Frame,
    names: Names,
    /// Files whose remarks are those of this import.
    sources: HashSet<String>,
    ids: Vec<i64>,
    roads: Vec<formats::Street>,
    tally: Tally,
}

impl<'a> Importer<'a> {
    /// Makes sure that the scene is there. If it `updates`, features of the scene may be replaced.
    pub fn begin(
        mut transaction: Transaction<'a>,
        scene: &'a str,
        srid: Option<i32>,
        options: ColumnOptions,
        updates: bool,
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
        if updates {
            update::prepare(&mut transaction, scene)?;
        }
        Ok(Self {
            transaction,
            scene,
            options,
            updates,
            frame: Frame::new(srid, known),
            names: Names::default(),
            sources: HashSet::new(),
            ids: Vec::new(),
            roads: Vec::new(),
            tally: Tally::of(updates),
        })
    }

    /// EPSG code of the coordinates, as far as it is known.
    pub fn srid(&self) -> Option<i32> {
        self.frame.srid()
    }

    /// Writes a batch of a file.
    pub fn add(&mut self, path: &Path, mut batch: SceneDescription) -> Result<(), Failure> {
        self.frame.agree(batch.srid, path)?;
        self.names.take(path, &batch.features)?;
        let source = path.display().to_string();
        self.forget_remarks(&source)?;
        let options = &self.options;
        let solid = |feature: &Feature| {
            Solid::of(feature, options).map_err(|problem| {
                let place = format!("{}, object {:?}", path.display(), feature.name);
                Failure::Input(format!("{place}: {problem}"))
            })
        };
        let mut solids: Vec<Solid> = batch
            .features
            .par_iter()
            .map(solid)
            .collect::<Result<_, _>>()?;
        if self.updates {
            self.update(&mut batch.features, &mut solids)?;
        } else {
            self.insert(&batch.features, &solids)?;
        }
        let (skipped, changed) = (&batch.skipped, &batch.changed);
        rows::remarks(&mut self.transaction, self.scene, &source, skipped, changed)?;
        self.tally.add(&batch, &solids);
        self.roads.extend(batch.streets);
        Ok(())
    }

    /// Remarks about a file that is imported once more are those of this time.
    fn forget_remarks(&mut self, source: &str) -> Result<(), Failure> {
        if self.updates && self.sources.insert(source.to_owned()) {
            let statement = format!(
                "DELETE FROM {}.import_remark WHERE source = $1",
                quoted(self.scene)
            );
            self.transaction.execute(&statement, &[&source])?;
        }
        Ok(())
    }

    /// Writes features, none of which may be there.
    fn insert(&mut self, features: &[Feature], solids: &[Solid]) -> Result<(), Failure> {
        let (transaction, scene) = (&mut self.transaction, self.scene);
        let known = rows::known(transaction, scene, features)?;
        if let Some(name) = known.keys().min() {
            return Err(Failure::Input(format!(
                "scene \"{scene}\" holds {} of these features already, such as \"{name}\"\n  \
                 hint: --update replaces those that changed, --replace drops the scene first",
                known.len()
            )));
        }
        let ids = rows::new_ids(transaction, scene, features.len())?;
        let first_slot = rows::first_slot(transaction, scene)?;
        rows::features(transaction, scene, &ids, first_slot, features, solids)?;
        rows::shapes(transaction, scene, &ids, solids)?;
        rows::models(transaction, scene, &ids, solids)?;
        self.ids.extend(ids);
        Ok(())
    }

    /// Writes features that are new or changed, and leaves no others in the batch.
    fn update(
        &mut self,
        features: &mut Vec<Feature>,
        solids: &mut Vec<Solid>,
    ) -> Result<(), Failure> {
        let outcome = update::write(&mut self.transaction, self.scene, features, solids)?;
        self.tally.count(&outcome);
        let is_written: Vec<bool> = outcome
            .ids
            .iter()
            .map(|id| !outcome.same.contains(id))
            .collect();
        retain(features, &is_written);
        retain(solids, &is_written);
        let mut ids = outcome.ids;
        retain(&mut ids, &is_written);
        self.ids.extend(ids);
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
        // Streets of a scene that is updated stay: nobody knows which of them came from these files.
        let keeps_streets = self.updates && streets::are_any(&mut self.transaction, self.scene)?;
        if !self.roads.is_empty() && !keeps_streets {
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
            streets: (!keeps_streets).then_some(made),
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

/// Keeps those of which `is_kept` says so.
fn retain<T>(all: &mut Vec<T>, is_kept: &[bool]) {
    let mut is_kept = is_kept.iter();
    all.retain(|_| is_kept.next() == Some(&true));
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
