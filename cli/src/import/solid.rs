//! [`Solid`], what a feature of a file is made of.

use engine::{Box3d, InnerEnvelope, LocalGround, MeshDefect, TriangleMesh};
use formats::{Feature, Geometry, Surface};
use glam::DVec3;

/// What a feature is made of.
#[derive(Debug)]
pub struct Solid {
    /// Holds every surface of every level of detail.
    pub envelope: Box3d,
    /// The best level of detail that is in the mesh.
    pub level_of_detail: f64,
    /// Its surface.
    pub mesh: TriangleMesh,
    /// What hides others, or why there is no such thing.
    pub inner: Result<InnerEnvelope, MeshDefect>,
}

impl Solid {
    /// Triangulates a feature and looks for its inner envelope.
    pub fn of(feature: &Feature) -> Self {
        let all = feature
            .geometries
            .iter()
            .flat_map(|geometry| &geometry.surfaces);
        let points = all.flat_map(|surface| surface.rings.iter().flatten());
        let envelope = Box3d::around(points.map(|&point| DVec3::from(point)));
        let best = best_geometries(&feature.geometries);
        let mesh = mesh(best.iter().flat_map(|geometry| &geometry.surfaces));
        let levels = best.iter().map(|geometry| geometry.level_of_detail);
        Self {
            // The reader gives no feature without a surface.
            envelope: envelope.unwrap_or(Box3d::new(DVec3::ZERO, DVec3::ZERO)),
            level_of_detail: levels.fold(f64::NEG_INFINITY, f64::max),
            inner: engine::inner_envelope(&mesh),
            mesh,
        }
    }

    /// Leaves the inner envelope grounded only where the feature is of a class that stands on the
    /// ground, and does.
    pub fn keep_ground(&mut self, class: &str, ground: &LocalGround) {
        let Some(mesh) = self.mesh.envelope() else {
            return;
        };
        if let Ok(inner) = &mut self.inner {
            inner.grounded &=
                class.starts_with("Building") && ground.holds(&self.envelope, mesh.min.z);
        }
    }
}

/// The highest level of detail of each part. Level 0 is a footprint, a stand-in for the surface:
/// it counts only where a feature has nothing else.
fn best_geometries(geometries: &[Geometry]) -> Vec<&Geometry> {
    let only_footprints = geometries
        .iter()
        .all(|geometry| geometry.level_of_detail < 1.0);
    let candidates = || {
        geometries
            .iter()
            .filter(move |geometry| only_footprints || geometry.level_of_detail >= 1.0)
    };
    let is_best = |geometry: &&Geometry| {
        let same_part = candidates().filter(|other| other.part == geometry.part);
        same_part
            .into_iter()
            .all(|other| other.level_of_detail <= geometry.level_of_detail)
    };
    candidates().filter(is_best).collect()
}

/// The triangles of surfaces.
pub fn mesh<'a>(surfaces: impl Iterator<Item = &'a Surface>) -> TriangleMesh {
    let ring = |ring: &Vec<[f64; 3]>| ring.iter().map(|&point| DVec3::from(point)).collect();
    TriangleMesh::from_polygons(
        surfaces.map(|surface| surface.rings.iter().map(ring).collect::<Vec<Vec<DVec3>>>()),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The faces of a box from `min` with this size.
    fn block(min: [f64; 3], size: f64) -> Vec<Surface> {
        let corners = Box3d::new(min.into(), DVec3::from(min) + size).corners();
        [
            [0, 2, 3, 1],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 4, 6, 2],
            [1, 3, 7, 5],
        ]
        .map(|face: [usize; 4]| Surface {
            rings: vec![
                face.iter()
                    .map(|&corner| corners[corner].to_array())
                    .collect(),
            ],
        })
        .to_vec()
    }

    fn geometry(level_of_detail: f64, part: &str, surfaces: Vec<Surface>) -> Geometry {
        Geometry {
            level_of_detail,
            part: part.to_owned(),
            surfaces,
        }
    }

    fn feature(geometries: Vec<Geometry>) -> Feature {
        Feature {
            name: "house".to_owned(),
            class: "Building".to_owned(),
            attributes: serde_json::json!({}),
            geometries,
            source: String::new(),
        }
    }

    /// A footprint, and two parts of which one is delivered twice.
    fn house() -> Feature {
        let footprint = block([0.0; 3], 30.0).remove(0);
        feature(vec![
            geometry(0.0, "house", vec![footprint]),
            geometry(1.2, "a", block([0.0; 3], 12.0)),
            geometry(2.2, "a", block([0.0; 3], 10.0)),
            geometry(1.2, "b", block([20.0, 0.0, 0.0], 5.0)),
        ])
    }

    #[test]
    fn every_level_is_in_the_envelope_and_the_best_in_the_mesh() {
        let solid = Solid::of(&house());
        assert_eq!(solid.envelope.max, DVec3::new(30.0, 30.0, 12.0));
        assert_eq!(solid.mesh.triangles.len(), 24);
        assert_eq!(solid.level_of_detail, 2.2);
        let inner = solid.inner.unwrap();
        assert_eq!(
            (inner.bounds.max, inner.grounded),
            (DVec3::splat(10.0), true)
        );
    }

    #[test]
    fn footprints_count_where_there_is_nothing_else() {
        let mut footprint = house();
        footprint.geometries.truncate(1);
        let solid = Solid::of(&footprint);
        assert_eq!(solid.mesh.triangles.len(), 2);
        assert!(solid.inner.is_err());
    }

    #[test]
    fn only_buildings_on_the_ground_are_grounded() {
        let grounded = |class: &str, others: &[f64]| {
            let mut solid = Solid::of(&house());
            let neighbour = |&z: &f64| Box3d::new(DVec3::new(0.0, 40.0, z), DVec3::splat(50.0));
            let envelopes: Vec<Box3d> = others
                .iter()
                .map(neighbour)
                .chain([solid.envelope])
                .collect();
            solid.keep_ground(class, &LocalGround::new(&envelopes));
            solid.inner.unwrap().grounded
        };
        assert!(grounded("Building", &[0.0, 0.0]) && grounded("BuildingPart", &[0.0, 0.0]));
        assert!(!grounded("Bridge", &[0.0, 0.0]));
        assert!(!grounded("Building", &[-6.0, -6.0]));
    }
}
