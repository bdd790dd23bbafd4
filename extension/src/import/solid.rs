//! [`Solid`], a row turned into a solid.

use super::row::{Shape, Source};
use engine::{Box3d, ColumnOptions, OuterPrism, TriangleMesh};
use formats::Geometry;
use glam::DVec3;

/// A row turned into a solid.
pub struct Solid {
    /// Holds all of it.
    pub envelope: Box3d,
    /// The same, tighter in plan.
    pub prism: Option<OuterPrism>,
    /// Its surface, and what hides others.
    pub solid: engine::Solid,
    /// Level of detail of the surface.
    pub level_of_detail: f64,
}

impl Solid {
    /// Builds it, or says why it cannot be built.
    pub fn of(source: &Source) -> Result<Self, String> {
        let (solid, level_of_detail) = match &source.shape {
            Shape::Raised(footprints, bottom, top) => {
                let solid = engine::Solid::raised(footprints, *bottom, *top);
                (solid.map_err(|defect| format!("footprint: {defect}"))?, 1.0)
            }
            Shape::Surfaces(binary) => {
                let surfaces = formats::read_wkb(binary).map_err(|problem| problem.to_string())?;
                let ring = |ring: &Vec<[f64; 3]>| ring.iter().copied().map(DVec3::from).collect();
                let mesh = TriangleMesh::from_polygons(
                    surfaces
                        .iter()
                        .map(|s| s.rings.iter().map(ring).collect::<Vec<Vec<_>>>()),
                );
                let options = ColumnOptions::default();
                (engine::Solid::of(mesh, source.class(), &options), 2.0)
            }
            Shape::Nothing(why) => return Err(why.clone()),
        };
        let points = points(&solid.mesh, level_of_detail);
        Ok(Self {
            envelope: Box3d::around(points.iter().copied()).ok_or("no surface")?,
            prism: OuterPrism::around(points),
            solid,
            level_of_detail,
        })
    }
}

/// Every vertex of a surface, and where a GLB rounds it to.
fn points(mesh: &TriangleMesh, level_of_detail: f64) -> Vec<DVec3> {
    let triangles = mesh.corners().map(|corners| corners.map(DVec3::into));
    let delivered = Geometry::of_triangles(level_of_detail, triangles);
    let delivered = formats::delivered_positions(std::slice::from_ref(&delivered));
    let exact = mesh.vertices.iter().copied();
    exact.chain(delivered.map(DVec3::from)).collect()
}
