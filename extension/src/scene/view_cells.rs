//! `generate_view_cells`, and `refresh`, which computes those anew that edits concern.
//!
//! The view region is divided into squares, rows of the table `view_cell_block`. Each is locked, covered with
//! cells and marked as done in one transaction: several sessions share the work, and what was interrupted
//! is taken up by whoever calls next.

use super::job::Job;
use super::procedure::Procedure;
use super::squares::squares;
use super::workers::Workers;
use super::{failed, given, quoted, read_one, run, streets};
use crate::error::Refusal;
use crate::settings;
use crate::snapshot_read::sees_the_latest;
use crate::types::Box3d;
use crate::visibility::{Surroundings, pack_if_possible};
use pgrx::datum::DatumWithOid;
use pgrx::{PgSqlErrorCode, Spi, notice, pg_extern, pg_sys};
use std::collections::HashSet;
use std::time::Instant;

/// Names of the work, the first also in the table `job`.
const TASK: &str = "generate_view_cells";
const REFRESH: &str = "refresh";

/// Least edge of the squares that are computed in one transaction, metres.
const BLOCK: f64 = 32.0;

/// Computes what can be seen from everywhere in the streets of a scene.
#[pg_extern]
fn generate_view_cells(
    scene: Option<&str>,
    range: Option<f64>,
    smallest: Option<f64>,
    largest: Option<f64>,
    finest: Option<f64>,
    fcinfo: pg_sys::FunctionCallInfo,
) {
    let scene = given(scene, "scene");
    let asked = Asked::checked(range, smallest, largest, finest);
    let mut procedure = Procedure::begin(fcinfo, TASK);
    require_latest(TASK);
    run("SELECT occlusion.require_all_cells($1)", &[scene.into()]);
    let mut surroundings = Surroundings::new(scene, settings::generate_bytes());
    surroundings.require_log();
    let job = Job::new(scene, TASK);
    let blocks = Blocks::of(scene);
    if blocks.left(&asked) {
        notice!("going on where scene \"{scene}\" was left");
    } else {
        // Who is editing now may have begun before there was a log.
        blocks.lock_sources();
        blocks.plan(scene, &asked, "true", &job);
    }
    procedure.commit();
    compute(
        scene,
        &blocks,
        &mut surroundings,
        &job,
        &mut procedure,
        false,
    );
    procedure.end();
}

/// Brings what was derived from a scene up to date with its edits: tiles, and those view cells that were put out
/// of use, as they were asked for before.
#[pg_extern]
fn refresh(scene: Option<&str>, fcinfo: pg_sys::FunctionCallInfo) {
    let scene = given(scene, "scene");
    let mut procedure = Procedure::begin(fcinfo, REFRESH);
    bring_up_to_date(scene, &mut procedure);
    procedure.end();
}

/// The same, as part of other work.
pub fn bring_up_to_date(scene: &str, procedure: &mut Procedure) {
    require_latest(REFRESH);
    run("SELECT occlusion.require_all_cells($1)", &[scene.into()]);
    let blocks = Blocks::of(scene);
    pack_if_possible(scene);
    procedure.commit();
    // Locked first: when all are truncated edits are not logged.
    blocks.lock();
    let Some(asked) = blocks.asked() else {
        notice!("scene \"{scene}\" has no view cells");
        return;
    };
    let mut surroundings = Surroundings::new(scene, settings::generate_bytes());
    surroundings.require_log();
    let job = Job::new(scene, TASK);
    blocks.restamp();
    blocks.plan(scene, &asked, &blocks.concerned(), &job);
    procedure.commit();
    compute(scene, &blocks, &mut surroundings, &job, procedure, true);
}

/// Computes the cells of all squares that are not done; where deletions alone concern one, `repairs` it.
fn compute(
    scene: &str,
    blocks: &Blocks,
    surroundings: &mut Surroundings,
    job: &Job,
    procedure: &mut Procedure,
    repairs: bool,
) {
    let workers = Workers::start();
    let begun = Instant::now();
    let mut told = 0;
    let mut gone = HashSet::new();
    while let Some(block) = blocks.take() {
        let repaired = repairs
            .then(|| blocks.repair(&block, surroundings, &workers, scene))
            .flatten();
        let filled = repaired.unwrap_or_else(|| blocks.fill(&block, surroundings, &workers, scene));
        let made = match filled {
            Ok(made) => made,
            Err(features) => {
                // What is gone is not met again, unless the tiles were not told of it.
                let ghost = features.into_iter().find(|feature| !gone.insert(*feature));
                if let Some(ghost) = ghost {
                    refuse_ghost(scene, ghost);
                }
                procedure.commit();
                continue;
            }
        };
        let (done, total) = job.add(made);
        procedure.commit();
        let tenths = done * 10 / total.max(1);
        if tenths > told {
            told = tenths;
            notice!(
                "{done} of {total} squares, {:.0} s",
                begun.elapsed().as_secs_f64()
            );
        }
    }
    blocks.finish(job);
    procedure.commit();
}

fn refuse_ghost(scene: &str, feature: i64) -> ! {
    Refusal::new(
        PgSqlErrorCode::ERRCODE_OBJECT_NOT_IN_PREREQUISITE_STATE,
        format!("tiles of scene \"{scene}\" hold feature {feature}, which was deleted"),
    )
    .detail("The deletion was not logged: triggers of the scene were disabled, perhaps.")
    .hint(format!(
        "TRUNCATE the table tile of the scene, then SELECT occlusion.pack_tiles('{scene}')."
    ))
    .raise()
}

/// What the user asked for, checked.
#[derive(Clone, Copy)]
pub struct Asked {
    pub range: f64,
    pub smallest: f64,
    pub largest: f64,
    pub finest: f64,
}

impl Asked {
    fn checked(
        range: Option<f64>,
        smallest: Option<f64>,
        largest: Option<f64>,
        finest: Option<f64>,
    ) -> Self {
        let asked = Self {
            range: between(given(range, "range"), "range", [1.0, 1e6]),
            smallest: between(given(smallest, "smallest"), "smallest", [0.5, 1e3]),
            largest: between(given(largest, "largest"), "largest", [0.5, 1e3]),
            finest: between(given(finest, "finest"), "finest", [0.05, 1e3]),
        };
        if asked.smallest > asked.largest {
            Refusal::new(
                PgSqlErrorCode::ERRCODE_INVALID_PARAMETER_VALUE,
                format!(
                    "smallest {} is larger than largest {}",
                    asked.smallest, asked.largest
                ),
            )
            .raise();
        }
        asked
    }

    /// As a row has it.
    fn of(row: [Option<f64>; 4]) -> Self {
        let [range, smallest, largest, finest] = row.map(Option::unwrap_or_default);
        Self {
            range,
            smallest,
            largest,
            finest,
        }
    }

    /// Edge of a block: cells fit in it.
    fn block(&self) -> f64 {
        let mut edge = self.largest;
        while edge < BLOCK {
            edge *= 2.0;
        }
        edge
    }

    fn arguments(&self) -> [DatumWithOid<'static>; 4] {
        [self.range, self.smallest, self.largest, self.finest].map(Into::into)
    }
}

fn between(value: f64, name: &str, [least, most]: [f64; 2]) -> f64 {
    if (least..=most).contains(&value) {
        return value;
    }
    Refusal::new(
        PgSqlErrorCode::ERRCODE_INVALID_PARAMETER_VALUE,
        format!("{name} {value} is out of bounds"),
    )
    .detail(format!("{name} is between {least} and {most} metres."))
    .raise()
}

/// Raises an error where statements would not see what others commit meanwhile.
fn require_latest(task: &str) {
    if !sees_the_latest() {
        Refusal::new(
            PgSqlErrorCode::ERRCODE_INVALID_TRANSACTION_STATE,
            format!("{task} runs in transactions that are READ COMMITTED"),
        )
        .hint("SET default_transaction_isolation = 'read committed';")
        .raise();
    }
}

/// The squares of a scene.
pub struct Blocks {
    /// Its name, quoted.
    pub scene: String,
    /// That a cell c lies in a square b.
    pub lies_in: String,
    /// That the cells of a square b are there, and hold what can be seen now.
    are_right: String,
}

/// One that is locked.
pub struct Block {
    pub id: i64,
    pub area: engine::Box3d,
    pub asked: Asked,
}

impl Blocks {
    fn of(scene: &str) -> Self {
        let condition = |query: &str, arguments: &[DatumWithOid]| {
            let text = read_one::<String>(query, arguments);
            text.unwrap_or_else(|| unreachable!("a condition is text"))
        };
        let valid = condition(
            "SELECT occlusion.valid_cells_condition($1)",
            &[scene.into()],
        );
        Self {
            scene: quoted(scene),
            lies_in: condition("SELECT occlusion.cell_in_block_condition()", &[]),
            are_right: format!(
                "b.done AND (b.cluster OPERATOR(pg_catalog.=) occlusion.cluster_identity()) IS TRUE AND {valid}"
            ),
        }
    }

    /// Locks the table against others who begin, not against those at work.
    fn lock(&self) {
        run(
            &format!(
                "LOCK TABLE {}.view_cell_block IN SHARE UPDATE EXCLUSIVE MODE",
                self.scene
            ),
            &[],
        );
    }

    /// Waits for those who are editing, and lets nobody else begin.
    fn lock_sources(&self) {
        run(
            &format!(
                "LOCK TABLE {0}.feature, {0}.solid_column, {0}.inner_envelope, {0}.mesh, {0}.street \
                 IN SHARE MODE",
                self.scene
            ),
            &[],
        );
    }

    /// What was asked for last; `None` if nothing was.
    fn asked(&self) -> Option<Asked> {
        let query = format!(
            "SELECT range, smallest, largest, finest FROM {}.view_cell_block LIMIT 1",
            self.scene
        );
        let asked = Spi::connect_mut(|client| {
            let row = client.update(&query, None, &[])?.first();
            if row.is_empty() {
                return Ok(None);
            }
            Ok::<_, pgrx::spi::Error>(Some(Asked::of([
                row.get(1)?,
                row.get(2)?,
                row.get(3)?,
                row.get(4)?,
            ])))
        });
        asked.unwrap_or_else(|error| failed(&error))
    }

    /// That edits concern a square b.
    fn concerned(&self) -> String {
        format!("NOT ({})", self.are_right)
    }

    /// Of cells that no edit so far concerns, takes down that they hold these edits, too.
    fn restamp(&self) {
        run(
            &format!(
                "UPDATE {0}.view_cell_block AS b SET snapshot = pg_catalog.pg_current_snapshot() \
                 WHERE EXISTS (SELECT FROM {0}.change) AND {1}",
                self.scene, self.are_right
            ),
            &[],
        );
    }

    /// Locks the table; whether there is work left of the same kind.
    fn left(&self, asked: &Asked) -> bool {
        self.lock();
        let query = format!(
            "SELECT EXISTS (SELECT FROM {}.view_cell_block WHERE NOT done AND {IS_ASKED})",
            self.scene
        );
        one(&query, &asked.arguments()).unwrap_or(false)
    }

    /// Plans new squares, and anew those b of the others for which a condition holds. Cells that are there stay
    /// until their square is done, unless they are of another kind or where no street is any more.
    fn plan(&self, scene: &str, asked: &Asked, anew: &str, job: &Job) {
        let streets = streets::read(scene);
        let query = format!("SELECT EXISTS (SELECT FROM {}.feature)", self.scene);
        if streets.is_empty() && one(&query, &[]).unwrap_or(false) {
            streets::refuse_none(scene);
        }
        run("SELECT occlusion.assign_slots($1)", &[scene.into()]);
        let squares = squares(streets, asked.block());
        let ids: Vec<i64> = squares.iter().map(|square| square.id).collect();
        run(
            &format!(
                "DELETE FROM {}.view_cell_block \
                 WHERE NOT ({IS_ASKED}) OR id OPERATOR(pg_catalog.<>) ALL ($5)",
                self.scene
            ),
            &asked
                .arguments()
                .into_iter()
                .chain([ids.clone().into()])
                .collect::<Vec<_>>(),
        );
        run(
            &format!(
                "DELETE FROM {0}.view_cell AS c WHERE NOT EXISTS ( \
                     SELECT FROM {0}.view_cell_block AS b WHERE {1})",
                self.scene, self.lies_in
            ),
            &[],
        );
        let column = |pick: fn(&engine::Box3d) -> f64| -> Vec<f64> {
            squares.iter().map(|square| pick(&square.area)).collect()
        };
        let corners: [DatumWithOid; 4] = [
            column(|square| square.min.x).into(),
            column(|square| square.min.y).into(),
            column(|square| square.max.x).into(),
            column(|square| square.max.y).into(),
        ];
        let arguments = asked
            .arguments()
            .into_iter()
            .chain([ids.into()])
            .chain(corners);
        run(
            &format!(
                "INSERT INTO {}.view_cell_block AS b (id, area, range, smallest, largest, finest) \
                 SELECT s.id, occlusion.box3d(occlusion.point3d(s.x0, s.y0, '{:?}'), \
                                              occlusion.point3d(s.x1, s.y1, '{:?}')), $1, $2, $3, $4 \
                 FROM ROWS FROM (pg_catalog.unnest($5), pg_catalog.unnest($6), pg_catalog.unnest($7), \
                                 pg_catalog.unnest($8), pg_catalog.unnest($9)) AS s (id, x0, y0, x1, y1) \
                 ON CONFLICT (id) DO UPDATE SET done = false WHERE {anew}",
                self.scene,
                f64::MIN,
                f64::MAX
            ),
            &arguments.collect::<Vec<_>>(),
        );
        let query = format!(
            "SELECT pg_catalog.count(*) FROM {}.view_cell_block WHERE NOT done",
            self.scene
        );
        let open = one::<i64>(&query, &[]).and_then(|open| usize::try_from(open).ok());
        let (open, all) = (open.unwrap_or(0), squares.len());
        match open == all {
            true => notice!("{all} squares of {} m", asked.block()),
            false => notice!("{open} of {all} squares of {} m", asked.block()),
        }
        job.start(open);
    }

    /// Locks a square that is not done, and that nobody else is at.
    fn take(&self) -> Option<Block> {
        let query = format!(
            "SELECT id, area, range, smallest, largest, finest FROM {}.view_cell_block \
             WHERE NOT done ORDER BY id LIMIT 1 FOR UPDATE SKIP LOCKED",
            self.scene
        );
        let block = Spi::connect_mut(|client| {
            let row = client.update(&query, None, &[])?.first();
            if row.is_empty() {
                return Ok(None);
            }
            let block = row.get::<i64>(1)?.zip(row.get::<Box3d>(2)?);
            let asked = Asked::of([row.get(3)?, row.get(4)?, row.get(5)?, row.get(6)?]);
            Ok::<_, pgrx::spi::Error>(block.map(|(id, area)| Block {
                id,
                area: area.0,
                asked,
            }))
        });
        block.unwrap_or_else(|error| failed(&error))
    }

    /// The snapshot of now, as text.
    pub fn snapshot() -> Option<String> {
        one(
            "SELECT pg_catalog.pg_current_snapshot()::pg_catalog.text",
            &[],
        )
    }

    /// Takes down that the cells of a square are there, and hold all edits that a snapshot shows.
    pub fn finish_square(&self, block: &Block, snapshot: Option<String>) {
        run(
            &format!(
                "UPDATE {0}.view_cell_block AS b \
                 SET done = true, snapshot = $2::pg_catalog.pg_snapshot, cluster = occlusion.cluster_identity(), \
                     (visible, box) = ( \
                         SELECT coalesce(occlusion.feature_set_union(c.visible), '{{}}'), occlusion.extent(c.box) \
                         FROM {0}.view_cell AS c WHERE {1}) \
                 WHERE id OPERATOR(pg_catalog.=) $1",
                self.scene, self.lies_in
            ),
            &[block.id.into(), snapshot.into()],
        );
    }

    /// Ends the work if no square is left, and forgets the changes that all cells hold.
    fn finish(&self, job: &Job) {
        let query = format!(
            "SELECT EXISTS (SELECT FROM {}.view_cell_block WHERE NOT done)",
            self.scene
        );
        if one(&query, &[]).unwrap_or(true) {
            notice!("the last squares are being computed by others");
            return;
        }
        job.finish();
        run(
            &format!(
                "DELETE FROM {0}.change WHERE transaction OPERATOR(pg_catalog.<) ( \
                     SELECT pg_catalog.pg_snapshot_xmin(b.snapshot) FROM {0}.view_cell_block AS b \
                     WHERE b.cluster OPERATOR(pg_catalog.=) occlusion.cluster_identity() \
                     ORDER BY 1 LIMIT 1)",
                self.scene
            ),
            &[],
        );
    }
}

/// That a block is of the kind that the first four arguments ask for.
const IS_ASKED: &str = "range OPERATOR(pg_catalog.=) $1 AND smallest OPERATOR(pg_catalog.=) $2 \
    AND largest OPERATOR(pg_catalog.=) $3 AND finest OPERATOR(pg_catalog.=) $4";

/// The one value of a query.
fn one<T: pgrx::FromDatum + pgrx::IntoDatum>(query: &str, arguments: &[DatumWithOid]) -> Option<T> {
    let value =
        Spi::connect_mut(|client| client.update(query, None, arguments)?.first().get::<T>(1));
    value.unwrap_or_else(|error| failed(&error))
}
