//! Meshes as the table `mesh` has them.

use crate::snapshot_read::Row;
use engine::TriangleMesh;
use glam::DVec3;

/// The mesh of a row of feature, vertices, triangles. `None` where there is none; `Some(None)` where what is
/// stored is no mesh.
pub fn mesh_of(row: &Row) -> Option<Option<TriangleMesh>> {
    let vertices: Vec<Option<f64>> = row.get(2)?;
    let triangles: Vec<Option<i32>> = row.get(3)?;
    Some(mesh(&vertices, &triangles))
}

fn mesh(vertices: &[Option<f64>], triangles: &[Option<i32>]) -> Option<TriangleMesh> {
    let (vertices, no_number) = vertices.as_chunks::<3>();
    let (triangles, no_corner) = triangles.as_chunks::<3>();
    let corner = |number: &Option<i32>| u32::try_from((*number)?).ok();
    let is_whole = no_number.is_empty() && no_corner.is_empty();
    is_whole.then_some(TriangleMesh {
        vertices: vertices
            .iter()
            .map(|&[x, y, z]| Some(DVec3::new(x?, y?, z?)))
            .collect::<Option<_>>()?,
        triangles: triangles
            .iter()
            .map(|[a, b, c]| Some([corner(a)?, corner(b)?, corner(c)?]))
            .collect::<Option<_>>()?,
        untriangulable_faces: 0,
    })
}
