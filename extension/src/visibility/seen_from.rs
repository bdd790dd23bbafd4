//! From where a feature can be seen: `visible_from` and `visible_from_area`.

use super::statements::{Ask, Statements};
use super::tables::Tables;
use super::view_cell::cluster_identity;
use crate::error::Refusal;
use crate::scene::read_one;
use crate::snapshot_read::{Moment, argument};
use crate::types::{Box3d, Ring};
use engine::plan_of_boxes;
use geo::LineString;
use glam::DVec2;
use pgrx::iter::TableIterator;
use pgrx::pg_sys::Datum;
use pgrx::{IntoDatum, PgSqlErrorCode, name, pg_extern};

/// View cells from which a feature may be seen. Of squares that are not computed or out of date, nothing is known
/// but how far one sees from them.
#[pg_extern(stable, strict, parallel_safe)]
fn visible_from(
    scene: &str,
    feature_id: i64,
) -> TableIterator<'static, (name!(bounds, Box3d), name!(proven, bool))> {
    let cells = cells(scene, feature_id).into_iter();
    TableIterator::new(cells.map(|(bounds, proven)| (Box3d(bounds), proven)))
}

/// The plan of these cells.
#[pg_extern(stable, strict, parallel_safe)]
fn visible_from_area(
    scene: &str,
    feature_id: i64,
) -> TableIterator<'static, (name!(area, Vec<Ring>), name!(proven, bool))> {
    let cells = cells(scene, feature_id);
    let rows = [true, false].into_iter().flat_map(|kind| {
        let of_kind = cells.iter().filter(|(_, proven)| *proven == kind);
        let boxes: Vec<engine::Box3d> = of_kind.map(|(bounds, _)| *bounds).collect();
        plan_of_boxes(&boxes).into_iter().map(move |polygon| {
            let rings = std::iter::once(polygon.exterior()).chain(polygon.interiors());
            (rings.map(ring).collect::<Vec<Ring>>(), kind)
        })
    });
    TableIterator::new(rows.collect::<Vec<_>>())
}

/// The boxes of cells from which a feature may be seen, and whether that is proven.
fn cells(scene: &str, feature: i64) -> Vec<(engine::Box3d, bool)> {
    let tables = Tables::of(scene);
    if !tables.can_have_cells() || !tables.shows_all_of_cells() {
        // It knows what is wrong, and says it.
        read_one::<String>(
            "SELECT occlusion.require_all_cells($1)::pg_catalog.text",
            &[scene.into()],
        );
    }
    let statements = Statements::of(scene, &tables);
    let mut sought = None;
    let asked = statements.get(Ask::Sought);
    asked.read(Moment::Query, &argument(feature), |row| {
        sought = row
            .get::<Box3d>(1)
            .map(|envelope| (envelope, row.get::<i64>(2)));
    });
    let Some((envelope, slot)) = sought else {
        Refusal::new(
            PgSqlErrorCode::ERRCODE_NO_DATA_FOUND,
            format!("scene \"{scene}\" has no feature {feature}"),
        )
        .raise()
    };
    let with_cluster = |value: Option<Datum>| -> Vec<Datum> {
        value
            .into_iter()
            .chain(argument(cluster_identity()))
            .collect()
    };
    let mut cells = Vec::new();
    // In no set is a feature without a slot.
    if slot.is_some() {
        let seen = statements.get(Ask::SeenFrom);
        seen.read(Moment::Query, &with_cluster(slot.into_datum()), |row| {
            let cell = row.get::<Box3d>(1).zip(row.get::<bool>(2));
            cells.extend(cell.map(|(bounds, proven)| (bounds.0, proven)));
        });
    }
    let unknown = statements.get(Ask::UnknownFrom);
    unknown.read(Moment::Query, &with_cluster(envelope.into_datum()), |row| {
        cells.extend(row.get::<Box3d>(1).map(|bounds| (bounds.0, false)));
    });
    cells
}

fn ring(ring: &LineString) -> Ring {
    let corners = ring.coords().skip(1);
    Ring(
        corners
            .map(|corner| DVec2::new(corner.x, corner.y))
            .collect(),
    )
}
