//! The view region of a scene without streets: the open space between its features.

use super::{failed, quoted, require, streets};
use crate::error::Refusal;
use engine::{Site, TriangleMesh, ViewRegionOptions, covers_ground, footprint, open_space};
use geo::{Coord, MultiPolygon, Rect};
use glam::DVec3;
use pgrx::{PgSqlErrorCode, Spi, pg_extern};

/// Rows fetched at once, to bound memory.
const BATCH: i64 = 1000;

/// Replaces the streets of a scene by its open space.
#[pg_extern(volatile, strict)]
fn generate_view_region(scene: &str, eye_low: f64, eye_high: f64, tile: f64) -> i64 {
    require(scene);
    let valid = eye_low.is_finite() && eye_high.is_finite() && eye_low <= eye_high;
    if !valid {
        Refusal::new(
            PgSqlErrorCode::ERRCODE_INVALID_PARAMETER_VALUE,
            format!("eye heights {eye_low} to {eye_high} are out of order"),
        )
        .raise();
    }
    if !(tile.is_finite() && tile >= 1.0) {
        Refusal::new(
            PgSqlErrorCode::ERRCODE_INVALID_PARAMETER_VALUE,
            format!("tile of {tile} metres is out of bounds"),
        )
        .detail("A tile is at least 1 metre wide.")
        .raise();
    }
    let options = ViewRegionOptions {
        tile,
        eye_low,
        eye_high,
    };
    streets::replace(scene, &open_space(&sites(scene), &options))
}

/// Where the features of a scene stand: by their meshes, or their envelopes where they have none.
fn sites(scene: &str) -> Vec<Site> {
    let query = format!(
        "SELECT f.class, m.vertices, m.triangles, \
                occlusion.x(occlusion.lower(f.envelope)), occlusion.y(occlusion.lower(f.envelope)), \
                occlusion.z(occlusion.lower(f.envelope)), \
                occlusion.x(occlusion.upper(f.envelope)), occlusion.y(occlusion.upper(f.envelope)) \
         FROM {scene}.feature AS f LEFT JOIN {scene}.mesh AS m ON m.feature = f.id",
        scene = quoted(scene)
    );
    let sites = Spi::connect(|client| {
        let mut cursor = client.open_cursor(&query, &[]);
        let mut sites = Vec::new();
        loop {
            let rows = cursor.fetch(BATCH)?;
            if rows.is_empty() {
                return Ok::<_, pgrx::spi::Error>(sites);
            }
            for row in rows {
                let class: String = row.get(1)?.unwrap_or_default();
                if covers_ground(&class) {
                    continue;
                }
                let number = |column: usize| -> Result<f64, pgrx::spi::Error> {
                    Ok(row.get(column)?.unwrap_or_default())
                };
                let vertices: Option<Vec<f64>> = row.get(2)?;
                let triangles: Option<Vec<i32>> = row.get(3)?;
                let mesh = vertices.zip(triangles).map(|(v, t)| mesh(&v, &t));
                let footprint = match mesh {
                    Some(mesh) => footprint(&mesh),
                    None => rectangle([number(4)?, number(5)?], [number(7)?, number(8)?]),
                };
                sites.push(Site {
                    footprint,
                    foot: number(6)?,
                });
            }
        }
    });
    sites.unwrap_or_else(|error: pgrx::spi::Error| failed(&error))
}

/// A mesh as the table `mesh` holds it.
fn mesh(vertices: &[f64], triangles: &[i32]) -> TriangleMesh {
    TriangleMesh::from_triangles(triangles.chunks_exact(3).filter_map(|triangle| {
        let corner = |number: i32| {
            let start = usize::try_from(number).ok()?.checked_mul(3)?;
            vertices.get(start..start + 3).map(DVec3::from_slice)
        };
        Some([
            corner(triangle[0])?,
            corner(triangle[1])?,
            corner(triangle[2])?,
        ])
    }))
}

fn rectangle(min: [f64; 2], max: [f64; 2]) -> MultiPolygon<f64> {
    let corner = |[x, y]: [f64; 2]| Coord { x, y };
    Rect::new(corner(min), corner(max)).to_polygon().into()
}
