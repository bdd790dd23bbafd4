//! How often scenes were asked, and how they were answered.

use crate::settings;
use crate::shared::{self, Count, Place};
use pgrx::iter::TableIterator;
use pgrx::pg_sys::Oid;
use pgrx::{name, pg_extern};

/// Where a scene is counted; `None` if it is not.
fn place(namespace: Oid) -> Option<&'static Place> {
    settings::tracks_scenes()
        .then(|| Place::of(namespace))
        .flatten()
}

/// Counts one answer.
pub fn count_answer(namespace: Oid, is_by_cell: bool, is_by_volumes: bool, features: usize) {
    let Some(place) = place(namespace) else {
        return;
    };
    let kind = if is_by_cell {
        Count::ByCell
    } else {
        Count::Live
    };
    place.add(kind, 1);
    if is_by_volumes {
        place.add(Count::ByVolumes, 1);
    }
    place.add(Count::Features, features);
}

/// Counts one question for a visible set.
pub fn count_set(namespace: Oid, is_known: bool) {
    if let Some(place) = place(namespace) {
        let kind = if is_known {
            Count::Sets
        } else {
            Count::SetsMissing
        };
        place.add(kind, 1);
    }
}

/// What was counted in this database, a scene a row, each by the number of its schema.
#[pg_extern(volatile, strict, parallel_safe)]
fn scene_counters() -> TableIterator<
    'static,
    (
        name!(namespace, Oid),
        name!(live, i64),
        name!(by_cell, i64),
        name!(by_volumes, i64),
        name!(features, i64),
        name!(sets, i64),
        name!(sets_missing, i64),
    ),
> {
    let rows = shared::counted().into_iter();
    TableIterator::new(rows.map(|(namespace, counts)| {
        let [live, by_cell, by_volumes, features, sets, sets_missing] = counts;
        (
            namespace,
            live,
            by_cell,
            by_volumes,
            features,
            sets,
            sets_missing,
        )
    }))
}

/// Begins to count anew for all scenes of this database.
#[pg_extern(volatile, strict)]
fn reset_scene_counters() {
    shared::reset();
}
