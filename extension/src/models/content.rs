//! Stored models, unpacked.

use crate::error::Refusal;
use formats::{Feature, Geometry, Placement, ReadOptions};
use pgrx::PgSqlErrorCode;
use std::sync::Arc;

/// What a row of `model` says, or of `mesh` where there is none.
pub enum Content<'a> {
    /// Geometries as imports write them.
    Packed(&'a [u8]),
    /// An instance of a packed shape.
    Instance(&'a [u8], Vec<f64>),
    /// A whole file, as a user stored it.
    File(&'a [u8]),
    /// Vertices and triangles.
    Mesh(Vec<f64>, Vec<i32>),
}

impl Content<'_> {
    /// Fills a feature with the parts and geometries that it stands for.
    pub fn fill(&self, feature: &mut Feature, level_of_detail: f64) -> Result<(), Refusal> {
        match self {
            Self::Packed(bytes) => {
                let (parts, geometries) =
                    formats::unpack(bytes).map_err(|e| damaged(feature, &e))?;
                feature.parts = parts;
                feature.geometries = geometries;
            }
            Self::Instance(bytes, placement) => {
                let shape = formats::unpack_shape(bytes).map_err(|e| damaged(feature, &e))?;
                let rows = placement.as_chunks::<4>().0;
                let rows = <[[f64; 4]; 3]>::try_from(rows).unwrap_or(Placement::IDENTITY.rows);
                feature.geometries = vec![Geometry {
                    level_of_detail,
                    part: None,
                    shape: Arc::new(shape),
                    placement: Some(Placement { rows }),
                }];
            }
            Self::File(bytes) => {
                let name = format!("model of feature \"{}\"", feature.name);
                let read = formats::read_bytes(&name, bytes, &ReadOptions::default());
                let read = read.map_err(|e| damaged(feature, &e))?;
                for other in read.features {
                    feature.parts.extend(other.parts);
                    feature.geometries.extend(other.geometries);
                }
            }
            Self::Mesh(vertices, triangles) => {
                let corners = corners(vertices, triangles);
                feature.geometries = vec![Geometry::of_triangles(level_of_detail, corners)];
            }
        }
        Ok(())
    }
}

/// The corners of the triangles of a mesh; those that name a vertex that is not there are left out.
fn corners(vertices: &[f64], triangles: &[i32]) -> impl Iterator<Item = [[f64; 3]; 3]> {
    let vertices = vertices.as_chunks::<3>().0;
    let vertex = |number: i32| vertices.get(usize::try_from(number).ok()?).copied();
    let triangles = triangles.as_chunks::<3>().0.iter();
    triangles.filter_map(move |&[a, b, c]| Some([vertex(a)?, vertex(b)?, vertex(c)?]))
}

fn damaged(feature: &Feature, why: &dyn std::fmt::Display) -> Refusal {
    Refusal::new(
        PgSqlErrorCode::ERRCODE_DATA_CORRUPTED,
        format!("the model of feature \"{}\" cannot be read", feature.name),
    )
    .detail(format!("{why}."))
}
