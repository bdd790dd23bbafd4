//! Queries that view cells answer.

use super::statements::{Ask, Statements};
use super::tables::Tables;
use crate::snapshot_read::Moment;
use crate::types::{Box3d, Point3d, StoredSet};
use pgrx::iter::TableIterator;
use pgrx::pg_sys::{self, Datum};
use pgrx::{IntoDatum, name, pg_extern};

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
        let arguments = [observer.into_datum(), cluster_identity().into_datum()];
        let arguments: Vec<Datum> = arguments.into_iter().flatten().collect();
        let statements = Statements::of(scene, &tables);
        let cell = statements.get(Ask::ViewCell);
        cell.read(Moment::Query, &arguments, |row| {
            let set = row.get::<StoredSet>(1);
            let set = set.map(|set| set.get().bytes().to_vec());
            let rest = row.get::<Box3d>(2).zip(row.get::<f64>(3));
            if let Some((set, (bounds, range))) = set.zip(rest) {
                rows.push((set, bounds, range));
            }
        });
    }
    TableIterator::new(rows)
}

/// What is particular to the cluster, as a number of SQL.
#[pg_extern(stable, parallel_safe)]
fn cluster_identity() -> i64 {
    // SAFETY: reads what the server knows from its start on.
    unsafe { pg_sys::GetSystemIdentifier() }.cast_signed()
}
