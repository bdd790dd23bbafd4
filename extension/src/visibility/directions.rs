//! Where each feature is seen, what hides one, and the ground that is seen.

use super::live::{View, checked_range};
use super::statements::Statements;
use super::tables::Tables;
use super::tiles::Tiles;
use super::{base, live};
use crate::error::{Refusal, or_raise};
use crate::snapshot_read::Moment;
use crate::types::{Box3d, Path, Point3d, Ring};
use engine::{Extents, PointSolver, PointTarget, TargetShape, TileFeature};
use glam::DVec3;
use pgrx::iter::TableIterator;
use pgrx::{PgSqlErrorCode, name, pg_extern};
use std::cell::RefCell;

thread_local! {
    /// Its memory is kept from one query to the next.
    static EXTENTS: RefCell<Extents> = RefCell::new(Extents::default());
}

/// In which directions features may be seen, and what of their outlines faces the eye there.
#[pg_extern(stable, strict, parallel_safe)]
#[allow(clippy::type_complexity, reason = "the columns of the result")]
fn visible_extent(
    scene: &str,
    observer: Point3d,
    range: f64,
) -> TableIterator<
    'static,
    (
        name!(feature_id, i64),
        name!(class, String),
        name!(azimuth_from, f64),
        name!(azimuth_to, f64),
        name!(facade, Path),
    ),
> {
    let view = View::all_round(observer.0, checked_range(range));
    let mut tiles = Tiles::around(scene, &view.bounds());
    let mut extents = EXTENTS.take();
    let query = view.query();
    or_raise(live::with_solver(|solver| {
        solver.visible_extent(&query, &mut tiles, &mut extents)
    }));
    let hidden = tiles.hidden_by_volumes(observer.0);
    let mut rows = Vec::new();
    for (sighting, ranges) in extents.iter() {
        let Some(seen) = tiles
            .seen(&sighting)
            .filter(|seen| !hidden.contains_key(&seen.id))
        else {
            continue;
        };
        rows.extend(ranges.map(|range| {
            let (from, to) = (range.from.to_degrees(), range.to.to_degrees());
            let facade = Path(range.facade.to_vec());
            (seen.id, seen.class.clone(), from, to, facade)
        }));
    }
    EXTENTS.set(extents);
    TableIterator::new(rows)
}

/// Features that with nothing else hide one; none where it may be seen.
#[pg_extern(stable, strict, parallel_safe)]
fn hidden_by(
    scene: &str,
    feature_id: i64,
    observer: Point3d,
) -> TableIterator<
    'static,
    (
        name!(occluder, i64),
        name!(class, String),
        name!(envelope, Box3d),
        name!(distance, f64),
    ),
> {
    let statements = Statements::of(scene, &Tables::of(scene));
    let target = base::of(&statements, Moment::Query, &[feature_id]).pop();
    let target = target.unwrap_or_else(|| unknown(scene, feature_id)).feature;
    let mut tiles = Tiles::around(scene, &between(observer.0, &target.envelope));
    let found = or_raise(live::with_solver(|solver: &mut PointSolver| {
        for shape in shapes(&target) {
            let asked = PointTarget {
                id: target.id,
                envelope: target.envelope,
                shape,
            };
            let found = solver.hidden_by(observer.0, &asked, &mut tiles)?;
            if found.is_some() {
                return Ok(found);
            }
        }
        Ok(None)
    }));
    let row = |id, class, envelope, distance| (id, class, Box3d(envelope), distance);
    let together = found.unwrap_or_default().into_iter().filter_map(|hider| {
        let tile = tiles.get(hider.tile)?;
        let (id, envelope) = tile.tile.feature(hider.feature);
        Some(row(
            id,
            tile.class(hider.feature).to_owned(),
            envelope,
            hider.distance,
        ))
    });
    let mut rows: Vec<_> = together.collect();
    if rows.is_empty() {
        let alone = tiles.hidden_by_volumes(observer.0).remove(&feature_id);
        let alone = base::of(&statements, Moment::Query, alone.as_slice());
        rows.extend(alone.into_iter().map(|base| {
            let envelope = base.feature.envelope;
            let distance = envelope.distance_to_point(observer.0);
            row(base.feature.id, base.class, envelope, distance)
        }));
    }
    TableIterator::new(rows)
}

/// What can be seen of the plane at eye level.
#[pg_extern(stable, strict, parallel_safe)]
fn isovist(scene: &str, observer: Point3d, range: f64) -> Ring {
    let view = View::all_round(observer.0, checked_range(range));
    let mut tiles = Tiles::around(scene, &view.bounds());
    let mut corners = Vec::new();
    or_raise(live::with_solver(|solver| {
        solver.isovist(observer.0, range, &mut tiles, &mut corners)
    }));
    if corners.is_empty() {
        corners.push(observer.0.truncate());
    }
    Ring(corners)
}

/// What holds all of a feature, the tightest first: it is hidden when one of them is.
fn shapes(target: &TileFeature) -> impl Iterator<Item = TargetShape<'_>> {
    let roof = target.roof.as_ref().map(TargetShape::Roof);
    let prism = TargetShape::Prism(&target.outline);
    let prism = (!target.outline.is_empty()).then_some(prism);
    roof.into_iter().chain(prism).chain([TargetShape::Envelope])
}

/// A box that holds all that may hide a target from an eye: what is nearer in plan.
fn between(eye: DVec3, target: &engine::Box3d) -> engine::Box3d {
    let nearest = eye.clamp(target.min, target.max) - eye;
    let reach = nearest.truncate().abs().max_element();
    let reach = glam::DVec2::splat(reach);
    let plan = eye.truncate();
    engine::Box3d {
        min: (plan - reach).extend(f64::MIN),
        max: (plan + reach).extend(f64::MAX),
    }
}

fn unknown(scene: &str, feature: i64) -> ! {
    Refusal::new(
        PgSqlErrorCode::ERRCODE_NO_DATA_FOUND,
        format!("scene \"{scene}\" has no feature {feature}"),
    )
    .raise()
}
