//! The real surfaces of features, as the tables of a scene have them.

use super::base::{column_of, upright};
use super::statements::{Ask, Statements};
use super::stored_mesh::mesh_of;
use crate::snapshot_read::{Moment, Row, argument};
use crate::types::Box3d;
use engine::{SolidColumn, Surface, TriangleMesh, extruded};
use glam::DVec3;
use std::collections::HashMap;

/// The surfaces of some features: their meshes, the faces of the columns of those that have none, or of the
/// boxes of those that have no columns either.
pub fn of(statements: &Statements, moment: Moment, features: &[i64]) -> Vec<Surface> {
    let mut surfaces = Vec::new();
    let mut bare = Vec::new();
    let meshes = statements.get(Ask::Meshes);
    meshes.read(moment, &argument(features.to_vec()), |row| {
        let Some(id) = row.get(1) else { return };
        match mesh_of(row) {
            None => bare.push(id),
            Some(mesh) => surfaces.push(Surface {
                id,
                triangles: mesh.iter().flat_map(TriangleMesh::corners).collect(),
            }),
        }
    });
    let columns = solids(statements, moment, Ask::Columns, &bare, column_of);
    bare.retain(|feature| !columns.contains_key(feature));
    let boxes = solids(statements, moment, Ask::AllInnerEnvelopes, &bare, |row| {
        row.get::<Box3d>(2).map(|bounds| upright(&bounds.0))
    });
    let of_solids = columns.into_iter().chain(boxes);
    surfaces.extend(of_solids.map(|(id, triangles)| Surface { id, triangles }));
    surfaces
}

/// The triangles around the solids of each feature that has some.
pub fn solids(
    statements: &Statements,
    moment: Moment,
    ask: Ask,
    features: &[i64],
    solid: fn(&Row) -> Option<SolidColumn>,
) -> HashMap<i64, Vec<[DVec3; 3]>> {
    let mut solids: HashMap<i64, Vec<[DVec3; 3]>> = HashMap::new();
    if !features.is_empty() {
        let asked = statements.get(ask);
        asked.read(moment, &argument(features.to_vec()), |row| {
            if let Some(feature) = row.get(1) {
                let triangles = solids.entry(feature).or_default();
                let mesh = solid(row).and_then(|solid| surface_of(&solid));
                triangles.extend(mesh.iter().flat_map(TriangleMesh::corners));
            }
        });
    }
    solids
}

/// The surface of a column; `None` where its footprint is no polygon, or it is flat.
fn surface_of(column: &SolidColumn) -> Option<TriangleMesh> {
    let solid = extruded(&column.footprint, column.bottom, column.top).ok()?;
    Some(solid.mesh)
}
