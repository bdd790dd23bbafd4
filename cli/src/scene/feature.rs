//! [`Feature`], a feature with its stored shapes.

use std::fmt;

use engine::{ConvexPieceOptions, ConvexPrism, SolidColumn, convex_pieces};
use geo::{Coord, Intersects, Rect};
use oracle::{Mesh, Prism, ShapeFault, Triangle};

use crate::sql_types::Box3d;

/// A feature with everything that is stored of its shape.
#[derive(Clone, Debug)]
pub struct Feature {
    /// Its number.
    pub id: i64,
    /// Its identifier in the source.
    pub name: Option<String>,
    /// Its class.
    pub class: String,
    /// Its outer envelope.
    pub envelope: Box3d,
    /// Its surface, if it has a model.
    pub mesh: Option<Mesh>,
    /// Its inner envelope, if it has one.
    pub inner: Option<InnerEnvelope>,
    /// Its solid columns.
    pub columns: Vec<SolidColumn>,
}

/// What hides, as stored.
#[derive(Clone, Copy, Debug)]
pub struct InnerEnvelope {
    /// The box.
    pub bounds: Box3d,
    /// Whether the ground under it is solid.
    pub grounded: bool,
}

impl Feature {
    /// Everything of it that is solid, as columns.
    pub fn solids(&self) -> impl Iterator<Item = SolidColumn> {
        let inner = self.inner.iter().map(InnerEnvelope::column);
        self.columns.iter().cloned().chain(inner)
    }

    /// Whether a place is in or on something of it that is solid.
    pub fn is_solid_at(&self, place: [f64; 3]) -> bool {
        let [x, y, z] = place;
        let holds = |solid: SolidColumn| {
            (solid.bottom..=solid.top).contains(&z) && solid.footprint.intersects(&Coord { x, y })
        };
        self.envelope.distance(place) == 0.0 && self.solids().any(holds)
    }

    /// The convex pieces of it that cast occlusion volumes. They are made as the database makes
    /// them, and the checks find out whether they are what they should be.
    pub fn pieces(&self, options: &ConvexPieceOptions) -> Vec<Prism> {
        let solids: Vec<SolidColumn> = self.solids().collect();
        let pieces = convex_pieces(&solids, options);
        pieces
            .iter()
            .filter_map(|piece| prism(piece).ok())
            .collect()
    }

    /// Its true surface: the triangles of its mesh, or, where it has none, the faces of its inner
    /// envelope. `None` when the mesh cannot be drawn: an index or a coordinate is wrong.
    pub fn surface(&self) -> Option<Vec<Triangle>> {
        match (&self.mesh, &self.inner) {
            (Some(mesh), _) => mesh.corners(),
            (None, Some(inner)) => Some(faces(&inner.bounds)),
            (None, None) => Some(Vec::new()),
        }
    }

    /// The solid ground under it, down to a height.
    pub fn ground(&self, down_to: f64) -> Vec<Triangle> {
        match &self.mesh {
            Some(mesh) if self.solids().any(|solid| solid.grounded) => {
                oracle::solid_ground(mesh, down_to)
            }
            _ => Vec::new(),
        }
    }
}

impl fmt::Display for Feature {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.name {
            Some(name) => write!(f, "{} {} ({name:?})", self.class, self.id),
            None => write!(f, "{} {}", self.class, self.id),
        }
    }
}

impl InnerEnvelope {
    /// The same as a column.
    fn column(&self) -> SolidColumn {
        let Box3d { min, max } = self.bounds;
        let corner = |[x, y, _]: [f64; 3]| Coord { x, y };
        SolidColumn {
            footprint: Rect::new(corner(min), corner(max)).to_polygon(),
            bottom: min[2],
            top: max[2],
            grounded: self.grounded,
        }
    }
}

fn prism(piece: &ConvexPrism) -> Result<Prism, ShapeFault> {
    let corners: Vec<[f64; 2]> = piece.footprint().iter().map(|c| c.to_array()).collect();
    Prism::new(&corners, piece.bottom(), piece.top(), piece.grounded())
}

/// The twelve triangles of a box.
fn faces(bounds: &Box3d) -> Vec<Triangle> {
    const FACES: [[usize; 4]; 6] = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let corners = oracle::Aabb::from(*bounds).corners();
    FACES
        .iter()
        .map(|face| face.map(|corner| corners[corner]))
        .flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]])
        .collect()
}

#[cfg(test)]
impl Feature {
    /// A building of which nothing but the box that it fills is known.
    pub fn of_box(id: i64, bounds: Box3d) -> Self {
        Self {
            id,
            name: None,
            class: "Building".to_owned(),
            envelope: bounds,
            mesh: None,
            inner: Some(InnerEnvelope {
                bounds,
                grounded: true,
            }),
            columns: Vec::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn feature() -> Feature {
        let bounds = Box3d {
            min: [0.0; 3],
            max: [2.0, 3.0, 4.0],
        };
        Feature::of_box(7, bounds)
    }

    #[test]
    fn without_a_mesh_the_inner_envelope_is_the_surface() {
        let surface = feature().surface().unwrap();
        let mesh = Mesh::from_triangles(&surface);
        assert!(mesh.is_closed());
        let inner = oracle::Aabb::from(feature().envelope);
        assert_eq!(oracle::check_inner_envelope(&mesh, &inner, true), Ok(()));
    }

    #[test]
    fn only_grounded_features_have_ground() {
        let mut feature = feature();
        feature.mesh = feature
            .surface()
            .map(|triangles| Mesh::from_triangles(&triangles));
        assert_eq!(feature.ground(-10.0).len(), 8);
        feature.inner.as_mut().unwrap().grounded = false;
        assert!(feature.ground(-10.0).is_empty());
    }

    #[test]
    fn a_mesh_that_names_no_vertex_has_no_surface() {
        let mut feature = feature();
        feature.mesh = Some(Mesh {
            vertices: vec![[0.0; 3]],
            triangles: vec![[0, 0, 1]],
        });
        assert_eq!(feature.surface(), None);
    }
}
