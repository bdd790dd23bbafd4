//! `witnesses`, the sight lines behind what a view cell says is proven.

use super::statements::{Ask, Statements};
use super::surroundings::{Around, Surroundings};
use super::tables::Tables;
use crate::error::Refusal;
use crate::scene::{near_streets, read_one};
use crate::settings;
use crate::snapshot_read::{Moment, argument};
use crate::types::{Box3d, Point3d};
use engine::{CellQuery, ViewRegion, witness};
use pgrx::iter::TableIterator;
use pgrx::{PgSqlErrorCode, check_for_interrupts, name, pg_extern};

/// For each feature that is proven to be visible from a cell an eye in the cell, and the end of a line from
/// there that crosses the surface of the feature and meets no other; null where none is found any more.
#[pg_extern(volatile, strict)]
#[allow(clippy::type_complexity, reason = "the columns of the result")]
fn witnesses(
    scene: &str,
    cell: i64,
) -> TableIterator<
    'static,
    (
        name!(feature_id, i64),
        name!(eye, Option<Point3d>),
        name!(target, Option<Point3d>),
    ),
> {
    read_one::<String>(
        "SELECT occlusion.require_all_cells($1)::pg_catalog.text",
        &[scene.into()],
    );
    let statements = Statements::of(scene, &Tables::of(scene));
    let query = query_of(&statements, scene, cell);
    let mut proven: Vec<i64> = Vec::new();
    let asked = statements.get(Ask::Proven);
    asked.read(Moment::Now, &argument(cell), |row| {
        proven.extend(row.get::<i64>(1))
    });
    let Around {
        scene: around,
        surfaces,
    } = Surroundings::new(scene, settings::generate_bytes()).around(&query.bounds, query.range);
    let region = ViewRegion::new(near_streets(scene, Moment::Query, &query.bounds));
    let is_eye = |eye| region.touches(&engine::Box3d::new(eye, eye)) && !around.holds(eye);
    let rows = proven.into_iter().map(|feature| {
        check_for_interrupts!();
        let found = witness(&surfaces, &query, feature, &is_eye);
        let ends = found.map(|found| (Point3d(found.eye), Point3d(found.end)));
        let (eye, target) = ends.unzip();
        (feature, eye, target)
    });
    TableIterator::new(rows.collect::<Vec<_>>())
}

/// What was asked for a cell. How finely it was divided makes no difference to its witnesses.
fn query_of(statements: &Statements, scene: &str, cell: i64) -> CellQuery {
    let mut query = None;
    let asked = statements.get(Ask::CellQuery);
    asked.read(Moment::Now, &argument(cell), |row| {
        query = row.get::<Box3d>(1).zip(row.get::<f64>(2));
    });
    match query {
        Some((bounds, range)) => CellQuery {
            bounds: bounds.0,
            range,
            precision: 0.0,
        },
        None => Refusal::new(
            PgSqlErrorCode::ERRCODE_NO_DATA_FOUND,
            format!("scene \"{scene}\" has no view cell {cell}"),
        )
        .raise(),
    }
}
