//! [`BaseFeature`], a feature as the tables of a scene have it.

use super::statements::{Ask, Statements};
use super::stored_mesh::mesh_of;
use crate::scene::polygon;
use crate::snapshot_read::{Moment, Row};
use crate::types::{Box3d, ring, rings};
use engine::{Roof, SolidColumn, TileFeature, TriangleMesh};
use geo::orient::Direction;
use geo::{Coord, CoordsIter, LineString, Orient, Polygon};
use glam::DVec2;
use pgrx::IntoDatum;
use pgrx::pg_sys::Datum;
use std::collections::HashMap;

/// A feature with its class and what hides in it.
pub struct BaseFeature {
    pub feature: TileFeature,
    pub class: String,
}

impl BaseFeature {
    /// Corners of what hides in it, and of its roof.
    pub fn corners(&self) -> usize {
        let footprints = self.feature.columns.iter().map(|column| &column.footprint);
        let roof = self.feature.roof.as_ref();
        footprints.map(CoordsIter::coords_count).sum::<usize>()
            + roof.map_or(0, |roof| roof.corners.len())
    }
}

/// All features that meet a box.
pub fn near(statements: &Statements, moment: Moment, bounds: &engine::Box3d) -> Vec<BaseFeature> {
    let argument = Box3d(*bounds).into_datum();
    read(statements, moment, Ask::FeaturesNear, argument)
}

/// The features with these ids, as far as there are such.
pub fn of(statements: &Statements, moment: Moment, ids: &[i64]) -> Vec<BaseFeature> {
    read(
        statements,
        moment,
        Ask::FeaturesOf,
        ids.to_vec().into_datum(),
    )
}

fn read(
    statements: &Statements,
    moment: Moment,
    ask: Ask,
    argument: Option<Datum>,
) -> Vec<BaseFeature> {
    let mut features = Vec::new();
    let arguments: Vec<Datum> = argument.into_iter().collect();
    statements.get(ask).read(moment, &arguments, |row| {
        features.extend(feature_of(row));
    });
    add_columns(statements, moment, &mut features);
    add_roofs(statements, moment, &mut features);
    features
}

/// A row of id, class, envelope, outline; `None` if one that must be there is null.
fn feature_of(row: &Row) -> Option<BaseFeature> {
    let (outline, has_none) = row.datum(4);
    let outline = if has_none {
        Vec::new()
    } else {
        // SAFETY: the statement casts the column to `polygon`.
        unsafe { ring(outline) }
    };
    Some(BaseFeature {
        feature: TileFeature {
            id: row.get(1)?,
            envelope: row.get::<Box3d>(3)?.0,
            outline,
            roof: None,
            columns: Vec::new(),
        },
        class: row.get(2)?,
    })
}

/// Adds what hides: solid columns, or the inner envelope where none is grounded.
fn add_columns(statements: &Statements, moment: Moment, features: &mut [BaseFeature]) {
    if features.is_empty() {
        return;
    }
    let position: HashMap<i64, usize> = features
        .iter()
        .enumerate()
        .map(|(position, base)| (base.feature.id, position))
        .collect();
    let ids: Vec<i64> = features.iter().map(|base| base.feature.id).collect();
    let ids: Vec<Datum> = ids.into_datum().into_iter().collect();
    statements.get(Ask::Columns).read(moment, &ids, |row| {
        let of = row.get::<i64>(1).and_then(|id| position.get(&id).copied());
        if let Some((of, column)) = of.zip(column_of(row)) {
            features[of].feature.columns.push(column);
        }
    });
    let has_columns: Vec<bool> = features
        .iter()
        .map(|base| base.feature.columns.iter().any(|column| column.grounded))
        .collect();
    statements
        .get(Ask::InnerEnvelopes)
        .read(moment, &ids, |row| {
            let of = row.get::<i64>(1).and_then(|id| position.get(&id).copied());
            if let Some((of, bounds)) = of.zip(row.get::<Box3d>(2))
                && !has_columns[of]
            {
                features[of].feature.columns.push(upright(&bounds.0));
            }
        });
}

/// Adds where features are seen highest, by their meshes.
fn add_roofs(statements: &Statements, moment: Moment, features: &mut [BaseFeature]) {
    if features.is_empty() || !statements.may_read_meshes() {
        return;
    }
    let ids: Vec<i64> = features.iter().map(|base| base.feature.id).collect();
    let ids: Vec<Datum> = ids.into_datum().into_iter().collect();
    let mut meshes: HashMap<i64, Vec<(TriangleMesh, bool)>> = HashMap::new();
    statements.get(Ask::Meshes).read(moment, &ids, |row| {
        if let (Some(id), Some(mesh)) = (row.get(1), mesh_of(row)) {
            let is_solid = row.get(4).unwrap_or(false);
            let with_kind = mesh.map(|mesh| (mesh, is_solid));
            meshes.entry(id).or_default().extend(with_kind);
        }
    });
    for BaseFeature { feature, .. } in features {
        // Two meshes of one feature would be a damage.
        if let Some([(mesh, is_solid)]) = meshes.get(&feature.id).map(Vec::as_slice) {
            let roof = Roof::of(mesh, &feature.envelope);
            feature.roof = roof.map(|roof| Roof {
                hides: roof.hides && *is_solid,
                ..roof
            });
        }
    }
}

/// A row of feature, footprint, bottom, top, grounded.
pub fn column_of(row: &Row) -> Option<SolidColumn> {
    let (footprint, is_null) = row.datum(2);
    if is_null {
        return None;
    }
    // SAFETY: the statement casts the column to `polygon[]`.
    let mut rings = unsafe { rings(footprint) }?.into_iter().map(closed);
    let footprint = Polygon::new(rings.next()?, rings.collect());
    Some(SolidColumn {
        // Whoever fills the table by hand may turn rings either way.
        footprint: footprint.orient(Direction::Default),
        bottom: row.get(3)?,
        top: row.get(4)?,
        grounded: row.get(5)?,
    })
}

/// A box as a column.
pub fn upright(bounds: &engine::Box3d) -> SolidColumn {
    SolidColumn {
        footprint: polygon::rectangle(bounds),
        bottom: bounds.min.z,
        top: bounds.max.z,
        grounded: true,
    }
}

fn closed(corners: Vec<DVec2>) -> LineString<f64> {
    let corners = corners.into_iter().map(|c| Coord { x: c.x, y: c.y });
    let mut ring: LineString<f64> = corners.collect();
    ring.close();
    ring
}
