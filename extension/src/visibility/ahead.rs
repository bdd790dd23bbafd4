//! `visible_ahead`, what may be seen on a way.

use super::base::{column_of, upright};
use super::live::{RANGE_MARGIN, checked_range, within_reach};
use super::statements::{Ask, Statements};
use super::tables::Tables;
use super::view_cell::cluster_identity;
use crate::error::Refusal;
use crate::scene::near_streets;
use crate::snapshot_read::{Moment, argument};
use crate::types::{Box3d, Point3d, StoredSet, shortest};
use engine::{EYE_MARGIN, FeatureSet, SolidColumn, ViewRegion, Way};
use pgrx::iter::TableIterator;
use pgrx::pg_sys::Datum;
use pgrx::{IntoDatum, PgSqlErrorCode, name, pg_extern};
use std::collections::HashSet;

/// Longest part of a way that is looked at as a whole, metres, unless there would be too many.
const PART: f64 = 1.0;

/// Most parts.
const MOST_PARTS: usize = 1000;

/// Most neighbouring parts that are asked for together.
const MOST_TOGETHER: usize = 64;

/// Features that may be seen from somewhere on the way of an observer.
#[pg_extern(stable, strict, parallel_safe)]
#[allow(clippy::type_complexity, reason = "the columns of the result")]
fn visible_ahead(
    scene: &str,
    observer: Point3d,
    velocity: Point3d,
    seconds: f64,
    range: f64,
) -> TableIterator<
    'static,
    (
        name!(feature_id, i64),
        name!(class, String),
        name!(envelope, Box3d),
        name!(distance, f64),
    ),
> {
    let range = checked_range(range);
    let way = Way {
        from: observer.0,
        to: observer.0 + velocity.0 * checked_seconds(seconds),
    };
    if !way.length().is_finite() {
        Refusal::new(
            PgSqlErrorCode::ERRCODE_NUMERIC_VALUE_OUT_OF_RANGE,
            "the way ends beyond all numbers",
        )
        .raise();
    }
    let tables = Tables::of(scene);
    let statements = Statements::of(scene, &tables);
    let count = (way.length() / PART).ceil().clamp(1.0, MOST_PARTS as f64);
    let parts: Vec<Way> = way.parts(count as usize).collect();
    let known = match tables.has_cells() && tables.may_read_cells() {
        true => Known::around(&way, range, scene, &statements),
        false => Known::default(),
    };
    let mut rows = Vec::new();
    let features = statements.get(Ask::FeaturesOf);
    let ids = argument(candidates(&parts, &known, range, &statements));
    features.read(Moment::Query, &ids, |row| {
        let (Some(id), Some(class), Some(envelope)) = (row.get(1), row.get(2), row.get::<Box3d>(3))
        else {
            return;
        };
        let distances = parts.iter().map(|part| envelope.0.distance(&part.bounds()));
        let distance = distances.fold(f64::INFINITY, f64::min);
        if distance <= range + RANGE_MARGIN {
            rows.push((id, class, envelope, distance));
        }
    });
    TableIterator::new(rows)
}

/// The features that may be seen from some parts of a way, and perhaps some out of range.
fn candidates(parts: &[Way], known: &Known, range: f64, statements: &Statements) -> Vec<i64> {
    let mut slots = HashSet::new();
    let is_open = |part: &Way| !known.add(part, &mut slots);
    let mut open: Vec<bool> = parts.iter().map(is_open).collect();
    let mut ids = HashSet::new();
    match with_slots(statements, &slots) {
        Some(features) => ids.extend(features),
        None => open.fill(true),
    }
    // Neighbours of which nothing is known are asked for together.
    let together =
        |a: usize, b: usize| open[a] && open[b] && a / MOST_TOGETHER == b / MOST_TOGETHER;
    let numbers: Vec<usize> = (0..parts.len()).collect();
    for run in numbers.chunk_by(|a, b| together(*a, *b)) {
        let (first, last) = (run[0], run[run.len() - 1]);
        if open[first] {
            let run = Way {
                from: parts[first].from,
                to: parts[last].to,
            };
            ids.extend(near(statements, &run, range));
        }
    }
    ids.into_iter().collect()
}

fn checked_seconds(seconds: f64) -> f64 {
    if (0.0..f64::INFINITY).contains(&seconds) {
        return seconds;
    }
    Refusal::new(
        PgSqlErrorCode::ERRCODE_INVALID_PARAMETER_VALUE,
        format!("seconds {} is out of bounds", shortest(seconds)),
    )
    .detail("A time ahead is a finite number of seconds, 0 or more.")
    .raise()
}

/// What was computed ahead near a way.
#[derive(Default)]
struct Known {
    cells: Vec<(engine::Box3d, Vec<u8>)>,
    region: Option<ViewRegion>,
    solids: Vec<SolidColumn>,
}

impl Known {
    fn around(way: &Way, range: f64, scene: &str, statements: &Statements) -> Self {
        let bounds = within_reach(&way.bounds(), EYE_MARGIN);
        let place = Box3d(bounds).into_datum();
        let arguments: Vec<Datum> = place
            .into_iter()
            .chain(argument(cluster_identity()))
            .collect();
        let mut cells = Vec::new();
        statements
            .get(Ask::CellsNear)
            .read(Moment::Query, &arguments, |row| {
                let place = row.get::<Box3d>(1).zip(row.get::<f64>(2));
                let set = row.get::<StoredSet>(3);
                if let Some(((bounds, reach), set)) = place.zip(set)
                    && reach >= range
                {
                    cells.push((bounds.0, set.get().bytes().to_vec()));
                }
            });
        let mut solids = Vec::new();
        let place = argument(Box3d(bounds));
        statements
            .get(Ask::ColumnsNear)
            .read(Moment::Query, &place, |row| {
                solids.extend(column_of(row));
            });
        statements
            .get(Ask::InnerEnvelopesNear)
            .read(Moment::Query, &place, |row| {
                solids.extend(row.get::<Box3d>(2).map(|bounds| upright(&bounds.0)));
            });
        Self {
            cells,
            region: Some(ViewRegion::new(near_streets(scene, Moment::Query, &bounds))),
            solids,
        }
    }

    /// Adds what may be seen from a part of the way; whether that is known.
    fn add(&self, part: &Way, slots: &mut HashSet<i32>) -> bool {
        let Some(region) = &self.region else {
            return false;
        };
        let bounds = within_reach(&part.bounds(), EYE_MARGIN);
        let here = || self.cells.iter().filter(|(cell, _)| cell.overlaps(&bounds));
        let is_known = part.is_in_boxes(here().map(|(cell, _)| cell))
            && part.is_in_streets(region.within(&bounds))
            && self.solids.iter().all(|solid| part.is_clear_of(solid));
        if is_known {
            for (_, set) in here() {
                let numbers = FeatureSet::trusted(set).numbers();
                slots.extend(numbers.filter_map(|slot| i32::try_from(slot).ok()));
            }
        }
        is_known
    }
}

/// The features with some slots; `None` unless each slot has one.
fn with_slots(statements: &Statements, slots: &HashSet<i32>) -> Option<Vec<i64>> {
    let mut ids = Vec::with_capacity(slots.len());
    let asked: Vec<i32> = slots.iter().copied().collect();
    let slotted = statements.get(Ask::Slotted);
    slotted.read(Moment::Query, &argument(asked), |row| {
        ids.extend(row.get::<i64>(1))
    });
    (ids.len() == slots.len()).then_some(ids)
}

/// All features within range of a way.
fn near(statements: &Statements, way: &Way, range: f64) -> Vec<i64> {
    let mut ids = Vec::new();
    let bounds = argument(Box3d(within_reach(&way.bounds(), range)));
    let features = statements.get(Ask::FeaturesNear);
    features.read(Moment::Query, &bounds, |row| ids.extend(row.get::<i64>(1)));
    ids
}
