//! `generate_occlusion_volumes`.

use super::procedure::Procedure;
use super::workers::Workers;
use super::{failed, quoted, require, streets};
use crate::error::Refusal;
use crate::types::Box3d;
use engine::{Occluder, OcclusionVolume, Street, VolumeOptions, VolumeSolver};
use pgrx::datum::DatumWithOid;
use pgrx::{PgSqlErrorCode, Spi, notice, pg_extern, pg_sys};
use rayon::prelude::*;
use std::collections::HashMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// Features computed and committed together.
const BATCH: usize = 64;

/// Name of the work in the table `job`.
const TASK: &str = "generate_occlusion_volumes";

/// Computes the occlusion volumes of all features of a scene.
#[pg_extern]
fn generate_occlusion_volumes(
    scene: Option<&str>,
    smallest: Option<f64>,
    range: Option<f64>,
    worth: Option<f64>,
    fcinfo: pg_sys::FunctionCallInfo,
) {
    let Some(scene) = scene else { missing("scene") };
    let asked = Asked::checked(smallest, range, worth);
    let mut procedure = Procedure::begin(fcinfo, TASK);
    require(scene);
    let job = Job::new(scene);
    let name = quoted(scene);
    let occluders =
        occluders(&format!("SELECT feature, box, grounded FROM {name}.inner_envelope"), &[]);
    let streets = streets::read(scene);
    // Those near each other in turn.
    let targets = targets(
        &format!("SELECT id, envelope FROM {name}.feature ORDER BY slot NULLS LAST, id"),
        &[],
    );
    if streets.is_empty() && !targets.is_empty() {
        Refusal::new(
            PgSqlErrorCode::ERRCODE_OBJECT_NOT_IN_PREREQUISITE_STATE,
            format!("scene \"{scene}\" has no streets"),
        )
        .hint(format!(
            "Make some from the open space with SELECT occlusion.generate_view_region('{scene}')."
        ))
        .raise();
    }
    notice!(
        "{} features, {} of them solid, seen from {} streets",
        targets.len(),
        occluders.len(),
        streets.len()
    );
    let workers = Workers::start();
    let options = asked.options(&streets);
    let solver = workers.run(|_| VolumeSolver::new(occluders.clone(), &streets, options));
    let seen = Seen::new(&occluders, &targets);
    job.start(targets.len());
    procedure.commit();

    let begun = Instant::now();
    let mut made = 0;
    let mut told = 0;
    for (number, batch) in targets.chunks(BATCH).enumerate() {
        let mut volumes = workers.run(|cancelled| solve(&solver, batch, cancelled));
        seen.drop_changed(scene, batch, &mut volumes);
        made += job.replace_volumes(batch, &volumes);
        let done = (number * BATCH + batch.len()).min(targets.len());
        job.advance(done, made);
        procedure.commit();
        let tenths = done * 10 / targets.len();
        if tenths > told {
            told = tenths;
            notice!(
                "{done} of {} features, {made} volumes, {:.0} s",
                targets.len(),
                begun.elapsed().as_secs_f64()
            );
        }
    }
    job.finish();
    procedure.commit();
    procedure.end();
}

/// What the user asked for, checked.
struct Asked {
    smallest: f64,
    range: Option<f64>,
    worth: Option<f64>,
}

impl Asked {
    fn checked(smallest: Option<f64>, range: Option<f64>, worth: Option<f64>) -> Self {
        let Some(smallest) = smallest else { missing("smallest") };
        Self {
            smallest: positive(smallest, "smallest"),
            range: range.map(|value| positive(value, "range")),
            worth: worth.map(|value| positive(value, "worth")),
        }
    }

    fn options(&self, streets: &[Street]) -> VolumeOptions {
        let usual = || VolumeOptions::usual_worth(self.smallest, streets);
        VolumeOptions {
            smallest: self.smallest,
            range: self.range,
            worth: self.worth.unwrap_or_else(usual),
        }
    }
}

fn positive(value: f64, name: &str) -> f64 {
    if value.is_finite() && value > 0.0 {
        return value;
    }
    Refusal::new(
        PgSqlErrorCode::ERRCODE_INVALID_PARAMETER_VALUE,
        format!("{name} {value} is out of bounds"),
    )
    .detail(format!("{name} is a finite number above 0."))
    .raise()
}

fn missing(parameter: &str) -> ! {
    Refusal::new(
        PgSqlErrorCode::ERRCODE_NULL_VALUE_NOT_ALLOWED,
        format!("parameter {parameter} must not be null"),
    )
    .raise()
}

/// A feature to be hidden: its number and outer envelope.
type Target = (i64, engine::Box3d);

/// All volumes of a batch of features.
fn solve(solver: &VolumeSolver, batch: &[Target], cancelled: &AtomicBool) -> Vec<OcclusionVolume> {
    let stop = || cancelled.load(Ordering::Relaxed);
    batch
        .par_iter()
        .flat_map_iter(|(feature, envelope)| {
            solver.volumes(*feature, envelope, stop).unwrap_or_default()
        })
        .collect()
}

/// The occluders that a query of feature, box, grounded returns.
fn occluders(query: &str, arguments: &[DatumWithOid]) -> Vec<Occluder> {
    // A read-only query may not lock rows.
    let rows = Spi::connect_mut(|client| {
        client
            .update(query, None, arguments)?
            .map(|row| Ok((row.get::<i64>(1)?, row.get::<Box3d>(2)?, row.get::<bool>(3)?)))
            .collect::<Result<Vec<_>, pgrx::spi::Error>>()
    });
    rows.unwrap_or_else(|error| failed(&error))
        .into_iter()
        .filter_map(|(feature, bounds, grounded)| {
            Some(Occluder { feature: feature?, bounds: bounds?.0, grounded: grounded? })
        })
        .collect()
}

/// The features that a query of id, envelope returns.
fn targets(query: &str, arguments: &[DatumWithOid]) -> Vec<Target> {
    // A read-only query may not lock rows.
    let rows = Spi::connect_mut(|client| {
        client
            .update(query, None, arguments)?
            .map(|row| Ok((row.get::<i64>(1)?, row.get::<Box3d>(2)?)))
            .collect::<Result<Vec<_>, pgrx::spi::Error>>()
    });
    rows.unwrap_or_else(|error| failed(&error))
        .into_iter()
        .filter_map(|(feature, bounds)| Some((feature?, bounds?.0)))
        .collect()
}

/// Features as they were when the work began.
struct Seen {
    occluders: HashMap<i64, Occluder>,
    envelopes: HashMap<i64, engine::Box3d>,
}

impl Seen {
    fn new(occluders: &[Occluder], targets: &[Target]) -> Self {
        Self {
            occluders: occluders.iter().map(|occluder| (occluder.feature, *occluder)).collect(),
            envelopes: targets.iter().copied().collect(),
        }
    }

    /// Drops the volumes whose features have changed or gone meanwhile. The others' rows stay
    /// locked until the commit, after which triggers take care of their volumes.
    fn drop_changed(&self, scene: &str, batch: &[Target], volumes: &mut Vec<OcclusionVolume>) {
        let names: Vec<i64> = batch.iter().map(|(feature, _)| *feature).collect();
        let lock = "OPERATOR(pg_catalog.=) ANY ($1) FOR SHARE";
        let scene = quoted(scene);
        let envelopes: HashMap<i64, engine::Box3d> = targets(
            &format!("SELECT id, envelope FROM {scene}.feature WHERE id {lock}"),
            &[names.into()],
        )
        .into_iter()
        .collect();
        let mut names: Vec<i64> = volumes.iter().map(|volume| volume.occluder).collect();
        names.sort_unstable();
        names.dedup();
        let occluders: HashMap<i64, Occluder> = occluders(
            &format!(
                "SELECT feature, box, grounded FROM {scene}.inner_envelope WHERE feature {lock}"
            ),
            &[names.into()],
        )
        .into_iter()
        .map(|occluder| (occluder.feature, occluder))
        .collect();
        volumes.retain(|volume| {
            envelopes.get(&volume.occludee) == self.envelopes.get(&volume.occludee)
                && occluders.get(&volume.occluder) == self.occluders.get(&volume.occluder)
        });
    }
}

/// The row of `job` that tells others how far this is, and the table that it fills.
struct Job {
    scene: String,
}

impl Job {
    fn new(scene: &str) -> Self {
        Self { scene: quoted(scene) }
    }

    fn start(&self, total: usize) {
        self.run(
            &format!(
                "INSERT INTO {}.job AS j \
                     (task, backend, started, updated, done, total, made, finished) \
                 VALUES ($1, pg_catalog.pg_backend_pid(), pg_catalog.clock_timestamp(), \
                         pg_catalog.clock_timestamp(), 0, $2, 0, false) \
                 ON CONFLICT (task) DO UPDATE SET backend = EXCLUDED.backend, \
                     started = EXCLUDED.started, updated = EXCLUDED.updated, done = 0, \
                     total = EXCLUDED.total, made = 0, finished = false",
                self.scene
            ),
            &[TASK.into(), count(total).into()],
        );
    }

    fn advance(&self, done: usize, made: i64) {
        self.run(
            &format!(
                "UPDATE {}.job SET done = $2, made = $3, updated = pg_catalog.clock_timestamp() \
                 WHERE task OPERATOR(pg_catalog.=) $1",
                self.scene
            ),
            &[TASK.into(), count(done).into(), made.into()],
        );
    }

    fn finish(&self) {
        self.run(
            &format!(
                "UPDATE {}.job SET finished = true, updated = pg_catalog.clock_timestamp() \
                 WHERE task OPERATOR(pg_catalog.=) $1",
                self.scene
            ),
            &[TASK.into()],
        );
    }

    /// Replaces the volumes of a batch; returns how many there are now.
    fn replace_volumes(&self, batch: &[Target], volumes: &[OcclusionVolume]) -> i64 {
        let features: Vec<i64> = batch.iter().map(|(feature, _)| *feature).collect();
        self.run(
            &format!("DELETE FROM {}.occlusion_volume WHERE occludee OPERATOR(pg_catalog.=) ANY ($1)", self.scene),
            &[features.into()],
        );
        let column = |pick: fn(&OcclusionVolume) -> f64| -> Vec<f64> {
            volumes.iter().map(pick).collect()
        };
        let occluders: Vec<i64> = volumes.iter().map(|v| v.occluder).collect();
        let occludees: Vec<i64> = volumes.iter().map(|v| v.occludee).collect();
        self.run(
            &format!(
                "INSERT INTO {}.occlusion_volume (occluder, occludee, box) \
                 SELECT v.occluder, v.occludee, \
                        occlusion.box3d(occlusion.point3d(v.x0, v.y0, v.z0), \
                                        occlusion.point3d(v.x1, v.y1, v.z1)) \
                 FROM ROWS FROM (pg_catalog.unnest($1), pg_catalog.unnest($2), \
                                 pg_catalog.unnest($3), pg_catalog.unnest($4), \
                                 pg_catalog.unnest($5), pg_catalog.unnest($6), \
                                 pg_catalog.unnest($7), pg_catalog.unnest($8)) \
                      AS v (occluder, occludee, x0, y0, z0, x1, y1, z1)",
                self.scene
            ),
            &[
                occluders.into(),
                occludees.into(),
                column(|v| v.bounds.min.x).into(),
                column(|v| v.bounds.min.y).into(),
                column(|v| v.bounds.min.z).into(),
                column(|v| v.bounds.max.x).into(),
                column(|v| v.bounds.max.y).into(),
                column(|v| v.bounds.max.z).into(),
            ],
        );
        count(volumes.len())
    }

    fn run(&self, statement: &str, arguments: &[DatumWithOid]) {
        if let Err(error) = Spi::run_with_args(statement, arguments) {
            failed(&error);
        }
    }
}

fn count(number: usize) -> i64 {
    i64::try_from(number).unwrap_or(i64::MAX)
}
