//! [`Solid`], what a feature of a file is made of.

use engine::{Box3d, ColumnOptions, Hides, OuterPrism};
use formats::{Feature, Problem};
use glam::DVec3;

use super::level::{Level, best_geometries, mesh};

/// What a feature is made of.
#[derive(Debug)]
pub struct Solid {
    /// Holds every surface of every level of detail, as delivered.
    pub envelope: Box3d,
    /// The same, tighter in plan.
    pub prism: Option<OuterPrism>,
    /// The best level of detail that is in the mesh.
    pub level_of_detail: f64,
    /// Its surface, and what hides others.
    pub solid: engine::Solid,
    /// Its models, the best level of detail last.
    pub levels: Vec<Level>,
}

impl Solid {
    /// Triangulates a feature and looks for what hides others in it.
    pub fn of(feature: &Feature, options: &ColumnOptions) -> Result<Self, Problem> {
        let best = best_geometries(feature);
        let delivered = mesh(best.iter().copied());
        let levels = Level::of(feature, &delivered)?;
        let points = points(feature);
        let envelope = Box3d::around(points.iter().copied());
        let level = best.iter().map(|geometry| geometry.level_of_detail);
        Ok(Self {
            // The reader gives no feature without a surface.
            envelope: envelope.unwrap_or(Box3d::new(DVec3::ZERO, DVec3::ZERO)),
            prism: OuterPrism::around(points),
            level_of_detail: level.fold(f64::NEG_INFINITY, f64::max),
            solid: engine::Solid::of(delivered, &feature.class, options),
            levels,
        })
    }

    /// What hides others, if something does.
    pub fn hides(&self) -> Option<&Hides> {
        self.solid.hides.as_ref().ok()
    }
}

/// Every position of every level of detail, those that a GLB rounds to included.
fn points(feature: &Feature) -> Vec<DVec3> {
    let exact = feature.geometries.iter().flat_map(|geometry| {
        let surfaces = geometry.surfaces();
        let rings = surfaces.iter().flat_map(|surface| &surface.rings);
        rings.flatten().copied().collect::<Vec<_>>()
    });
    exact
        .chain(formats::delivered_positions(&feature.geometries))
        .map(DVec3::from)
        .collect()
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use formats::{Geometry, Shape, Surface};

    use super::*;

    /// The faces of a box from `min` with this size; the first is the bottom.
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
            ..Surface::default()
        })
        .to_vec()
    }

    fn geometry(level_of_detail: f64, part: &str, surfaces: Vec<Surface>) -> Geometry {
        Geometry {
            level_of_detail,
            part: Some(part.to_owned()),
            shape: Arc::new(Shape {
                surfaces,
                ..Shape::default()
            }),
            placement: None,
        }
    }

    fn solid(geometries: Vec<Geometry>) -> Solid {
        let feature = Feature {
            name: "house".to_owned(),
            class: "Building".to_owned(),
            attributes: serde_json::json!({}),
            parts: Vec::new(),
            geometries,
        };
        Solid::of(&feature, &ColumnOptions::default()).unwrap()
    }

    /// A footprint, and two parts of which one is delivered twice.
    fn house() -> Vec<Geometry> {
        let footprint = block([0.0; 3], 30.0).remove(0);
        vec![
            geometry(0.0, "house", vec![footprint]),
            geometry(1.2, "a", block([0.0; 3], 12.0)),
            geometry(2.2, "a", block([0.0; 3], 10.0)),
            geometry(1.2, "b", block([20.0, 0.0, 0.0], 5.0)),
        ]
    }

    #[test]
    fn every_level_is_in_the_envelope_and_the_best_in_the_mesh() {
        let solid = solid(house());
        assert_eq!(solid.envelope.max, DVec3::new(30.0, 30.0, 12.0));
        assert_eq!(solid.solid.mesh.triangles.len(), 24);
        assert_eq!(solid.level_of_detail, 2.2);
        let hides = solid.hides().unwrap();
        let inner = hides.inner.unwrap();
        assert_eq!(
            (inner.bounds.max, inner.grounded),
            (DVec3::splat(10.0), true)
        );
        let columns = &hides.columns.columns;
        assert_eq!(columns.len(), 2);
        assert!(
            columns
                .iter()
                .all(|column| column.grounded && column.bottom == 0.0)
        );
    }

    #[test]
    fn every_level_shows_all_parts() {
        let solid = solid(house());
        let levels: Vec<f64> = solid
            .levels
            .iter()
            .map(|level| level.level_of_detail)
            .collect();
        assert_eq!(levels, [0.0, 1.2, 2.2]);
        let errors: Vec<f64> = solid
            .levels
            .iter()
            .filter_map(|l| l.geometric_error)
            .collect();
        assert_eq!(errors[1..], [12f64.sqrt(), 0.0]);
    }

    #[test]
    fn footprints_count_where_there_is_nothing_else() {
        let mut footprint = house();
        footprint.truncate(1);
        let solid = solid(footprint);
        assert_eq!(solid.solid.mesh.triangles.len(), 2);
        assert!(solid.hides().is_none());
    }

    #[test]
    fn a_missing_bottom_is_added() {
        let open = solid(vec![geometry(1.0, "a", block([0.0; 3], 10.0).split_off(1))]);
        assert_eq!(
            open.solid
                .repair
                .map(|repair| (repair.foot, repair.triangles)),
            Some((0.0, 2))
        );
        assert_eq!(open.hides().unwrap().columns.columns.len(), 1);
        let unroofed = [0, 2, 3, 4, 5].map(|face| block([0.0; 3], 10.0)[face].clone());
        let unroofed = solid(vec![geometry(1.0, "a", unroofed.to_vec())]);
        assert_eq!(unroofed.solid.repair, None);
        assert!(unroofed.hides().is_none());
    }
}
