//! Visibility queries.

mod ahead;
mod base;
mod cache;
mod counters;
mod directions;
mod edit_log;
mod line_of_sight;
mod live;
mod pack;
mod packed_tile;
mod seen_from;
mod statements;
mod stored_mesh;
mod surfaces;
mod surroundings;
mod tables;
mod tiles;
mod view_cell;
mod view_cells;
mod witnesses;

pub use pack::pack_if_possible;
pub use statements::CELL_BITS;
pub use surroundings::{Around, Surroundings};

use crate::field_of_view::FieldOfView;
use crate::settings;
use crate::types::{Box3d, Frustum, Point3d, ViewCone, ViewSector};
use live::{Account, View};
use pgrx::iter::{SetOfIterator, TableIterator};
use pgrx::{name, pg_extern};

/// Rows of `visible_features`.
type Rows = TableIterator<
    'static,
    (
        name!(feature_id, i64),
        name!(class, String),
        name!(envelope, Box3d),
        name!(distance, f64),
    ),
>;

fn rows(scene: &str, view: &View) -> Rows {
    let (seen, _) = view.look(scene);
    TableIterator::new(seen.into_iter().map(|seen| {
        let envelope = Box3d(seen.envelope);
        (seen.id, seen.class, envelope, seen.distance)
    }))
}

/// The lines of `explain_sight`.
fn account(scene: &str, view: &View) -> SetOfIterator<'static, String> {
    let (seen, account) = view.look(scene);
    let Account {
        cell,
        tiles,
        read,
        cached,
        edited,
        above,
        in_view,
        hidden,
    } = account;
    let cell = match cell {
        Some((id, features)) => format!("View Cell: {id}  Features: {features}"),
        None => "View Cell: none".to_owned(),
    };
    let cell = settings::uses_cells().then_some(cell);
    let rest = [
        format!("Tiles in Range: {tiles}  Needed: {read}  Cached: {cached}"),
        format!("Features Edited Since Packing: {edited}"),
        format!("Features above the Horizon: {above}  In View: {in_view}"),
        format!("Features Hidden by Occlusion Volumes: {hidden}"),
        format!("Features Returned: {}", seen.len()),
    ];
    SetOfIterator::new(cell.into_iter().chain(rest))
}

#[pg_extern(stable, strict, parallel_safe)]
fn visible_features_cone(scene: &str, cone: ViewCone) -> Rows {
    rows(scene, &View::of(FieldOfView::Cone(cone)))
}

#[pg_extern(stable, strict, parallel_safe)]
fn visible_features_sector(scene: &str, sector: ViewSector) -> Rows {
    rows(scene, &View::of(FieldOfView::Sector(sector)))
}

#[pg_extern(stable, strict, parallel_safe)]
fn visible_features_frustum(scene: &str, view: Frustum) -> Rows {
    rows(scene, &View::of(FieldOfView::Frustum(view)))
}

#[pg_extern(stable, strict, parallel_safe)]
fn visible_features_all_round(scene: &str, observer: Point3d, range: f64) -> Rows {
    rows(
        scene,
        &View::all_round(observer.0, live::checked_range(range)),
    )
}

#[pg_extern(stable, strict, parallel_safe)]
fn explain_sight_cone(scene: &str, cone: ViewCone) -> SetOfIterator<'static, String> {
    account(scene, &View::of(FieldOfView::Cone(cone)))
}

#[pg_extern(stable, strict, parallel_safe)]
fn explain_sight_sector(scene: &str, sector: ViewSector) -> SetOfIterator<'static, String> {
    account(scene, &View::of(FieldOfView::Sector(sector)))
}

#[pg_extern(stable, strict, parallel_safe)]
fn explain_sight_frustum(scene: &str, view: Frustum) -> SetOfIterator<'static, String> {
    account(scene, &View::of(FieldOfView::Frustum(view)))
}

#[pg_extern(stable, strict, parallel_safe)]
fn explain_sight_all_round(
    scene: &str,
    observer: Point3d,
    range: f64,
) -> SetOfIterator<'static, String> {
    account(
        scene,
        &View::all_round(observer.0, live::checked_range(range)),
    )
}
