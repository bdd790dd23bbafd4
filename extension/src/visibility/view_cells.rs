//! Queries that view cells answer.

use super::counters::count_set;
use super::statements::Statements;
use super::tables::Tables;
use super::view_cell::{self, ViewCell};
use crate::types::{Box3d, Point3d};
use pgrx::iter::TableIterator;
use pgrx::{name, pg_extern};

/// Rows of `visible_set`; a set as the type `feature_set` holds it.
type Rows = TableIterator<
    'static,
    (
        name!(visible, Vec<u8>),
        name!(bounds, Box3d),
        name!(range, f64),
    ),
>;

#[pg_extern(stable, strict, parallel_safe)]
fn visible_set(scene: &str, observer: Point3d) -> Rows {
    let tables = Tables::of(scene);
    let mut rows = Vec::new();
    if tables.has_cells() {
        let cell = ViewCell::around(observer.0, &Statements::of(scene, &tables));
        rows.extend(cell.map(|cell| {
            let set = cell.visible().bytes().to_vec();
            (set, Box3d(cell.bounds), cell.range)
        }));
    }
    count_set(tables.namespace(), !rows.is_empty());
    TableIterator::new(rows)
}

#[pg_extern(stable, parallel_safe)]
fn cluster_identity() -> i64 {
    view_cell::cluster_identity()
}
