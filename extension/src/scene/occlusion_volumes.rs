//! `generate_occlusion_volumes`.

use super::job::Job;
use super::procedure::Procedure;
use super::snapshot::{Snapshot, Target};
use super::workers::Workers;
use super::{count, given, quoted, require, run, streets};
use crate::error::Refusal;
use engine::{OcclusionVolume, Street, VolumeOptions, VolumeSolver};
use pgrx::{PgSqlErrorCode, notice, pg_extern, pg_sys};
use rayon::prelude::*;
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
    let scene = given(scene, "scene");
    let asked = Asked::checked(smallest, range, worth);
    let mut procedure = Procedure::begin(fcinfo, TASK);
    require(scene);
    let job = Job::new(scene, TASK);
    let snapshot = Snapshot::read(scene);
    let targets = &snapshot.targets;
    let streets = streets::read(scene);
    if streets.is_empty() && !targets.is_empty() {
        streets::refuse_none(scene);
    }
    notice!(
        "{} features, {} of them solid, seen from {} streets",
        targets.len(),
        snapshot.solids.features(),
        streets.len()
    );
    let workers = Workers::start();
    let options = asked.options(&streets);
    let solver = workers.run(|_| VolumeSolver::new(snapshot.solids.occluders(), &streets, options));
    job.start(targets.len());
    procedure.commit();

    let begun = Instant::now();
    let mut made = 0;
    let mut told = 0;
    for (number, batch) in targets.chunks(BATCH).enumerate() {
        let mut volumes = workers.run(|cancelled| solve(&solver, batch, cancelled));
        touch(scene);
        snapshot.drop_changed(scene, batch, &mut volumes);
        made += replace_volumes(scene, batch, &volumes);
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
        Self {
            smallest: positive(given(smallest, "smallest"), "smallest"),
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

/// Updates the one row of `scene_info`, so that an edit whose snapshot is older than this batch
/// fails rather than overlooks its volumes (`require_all_volumes` in `sql/40_scene.sql`). Comes
/// before all other locks of the batch: it is the only one that may have to wait for an edit.
fn touch(scene: &str) {
    let scene = quoted(scene);
    run(
        &format!("UPDATE {scene}.scene_info SET format_version = format_version"),
        &[],
    );
}

/// Replaces the volumes of a batch; returns how many there are now. Old ones that an edit is about
/// to drop are left to it: waiting for it could be a deadlock, and if it does not come to pass they
/// are as right as they were.
fn replace_volumes(scene: &str, batch: &[Target], volumes: &[OcclusionVolume]) -> i64 {
    let features: Vec<i64> = batch.iter().map(|(feature, _)| *feature).collect();
    run(
        &format!(
            "DELETE FROM {0}.occlusion_volume WHERE occludee OPERATOR(pg_catalog.=) ANY ($1) \
             AND ctid OPERATOR(pg_catalog.=) ANY (ARRAY( \
                 SELECT ctid FROM {0}.occlusion_volume \
                 WHERE occludee OPERATOR(pg_catalog.=) ANY ($1) FOR UPDATE SKIP LOCKED))",
            quoted(scene)
        ),
        &[features.into()],
    );
    let column =
        |pick: fn(&OcclusionVolume) -> f64| -> Vec<f64> { volumes.iter().map(pick).collect() };
    let occluders: Vec<i64> = volumes.iter().map(|v| v.occluder).collect();
    let occludees: Vec<i64> = volumes.iter().map(|v| v.occludee).collect();
    run(
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
            quoted(scene)
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
