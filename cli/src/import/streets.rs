//! The streets of an import.

use engine::{Site, Street, TriangleMesh, ViewRegionOptions, covers_ground};
use geo::MultiPolygon;
use glam::DVec3;
use postgres::Transaction;
use postgres::fallible_iterator::FallibleIterator;
use rayon::prelude::*;

use super::level;
use crate::database::quoted;
use crate::failure::Failure;

/// Features whose footprints are computed together.
const CHUNK: usize = 1024;

/// A feature as streets see it.
struct Neighbour {
    class: String,
    is_solid: bool,
    mesh: TriangleMesh,
}

/// What roads cover, less what the solid features of the scene stand on, those of earlier imports
/// among them.
pub fn of_roads(
    transaction: &mut Transaction<'_>,
    scene: &str,
    roads: &[formats::Street],
) -> Result<Vec<Street>, Failure> {
    let surfaces: Vec<TriangleMesh> = roads
        .par_iter()
        .map(|road| level::mesh_of_surfaces(road.surfaces.iter()))
        .collect();
    let mut sites = Vec::new();
    let mut built = Vec::new();
    each_chunk(transaction, scene, |chunk| {
        let footprints: Vec<MultiPolygon<f64>> = chunk
            .par_iter()
            .map(|neighbour| engine::footprint(&neighbour.mesh))
            .collect();
        for (neighbour, footprint) in chunk.iter().zip(footprints) {
            if neighbour.is_solid {
                built.push(footprint.clone());
            }
            let foot = neighbour.mesh.envelope().map(|bounds| bounds.min.z);
            if let Some(foot) = foot.filter(|_| !covers_ground(&neighbour.class)) {
                sites.push(Site { footprint, foot });
            }
        }
    })?;
    let streets = engine::streets_from_surfaces(&surfaces, &sites, &ViewRegionOptions::default());
    Ok(engine::without_footprints(streets, &built))
}

/// Hands over all features of a scene that have a mesh, chunk by chunk.
fn each_chunk(
    transaction: &mut Transaction<'_>,
    scene: &str,
    mut heed: impl FnMut(&[Neighbour]),
) -> Result<(), Failure> {
    let schema = quoted(scene);
    let statement = format!(
        "SELECT f.class, m.defect IS NULL, m.vertices, m.triangles \
         FROM {schema}.feature AS f JOIN {schema}.mesh AS m ON m.feature = f.id"
    );
    let mut rows = transaction.query_raw(&statement, std::iter::empty::<&i64>())?;
    let mut chunk = Vec::with_capacity(CHUNK);
    while let Some(row) = rows.next()? {
        chunk.push(Neighbour {
            class: row.get(0),
            is_solid: row.get(1),
            mesh: mesh(row.get(2), row.get(3)),
        });
        if chunk.len() == CHUNK {
            heed(&chunk);
            chunk.clear();
        }
    }
    heed(&chunk);
    Ok(())
}

fn mesh(vertices: Vec<f64>, triangles: Vec<i32>) -> TriangleMesh {
    let (points, _) = vertices.as_chunks::<3>();
    let (corners, _) = triangles.as_chunks::<3>();
    TriangleMesh {
        vertices: points.iter().copied().map(DVec3::from).collect(),
        triangles: corners.iter().map(|t| t.map(i32::cast_unsigned)).collect(),
        untriangulable_faces: 0,
    }
}

/// Whether a scene has streets.
pub fn are_any(transaction: &mut Transaction<'_>, scene: &str) -> Result<bool, Failure> {
    let statement = format!("SELECT EXISTS (SELECT FROM {}.street)", quoted(scene));
    Ok(transaction.query_one(&statement, &[])?.get(0))
}

/// Makes a view region from the open space of a scene that has no streets; returns its size.
pub fn open_space(
    transaction: &mut Transaction<'_>,
    scene: &str,
) -> Result<Option<usize>, Failure> {
    if are_any(transaction, scene)? {
        return Ok(None);
    }
    let statement = "SELECT occlusion.generate_view_region($1)";
    let made: i64 = transaction.query_one(statement, &[&scene])?.get(0);
    Ok(usize::try_from(made).ok())
}
