//! [`TriangleMesh`], the surface of a feature.

use std::collections::HashMap;

use glam::DVec3;

use super::mesh_defect::MeshDefect;
use super::triangulate::{fan, triangulate};
use super::winding_number::triangle_winding;
use crate::Box3d;

/// A triangle soup with shared vertices, metres. Seen from outside a solid its triangles turn
/// anticlockwise.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TriangleMesh {
    /// Each position once, bit for bit.
    pub vertices: Vec<DVec3>,
    /// Three positions in `vertices` a triangle. Triangles without area are kept: they close the
    /// gap between an edge and its parts.
    pub triangles: Vec<[u32; 3]>,
    /// How many faces had no faithful triangulation and are covered by a fan instead. Such a mesh
    /// hides nothing.
    pub untriangulable_faces: usize,
}

/// Whether a surface bounds a solid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Closedness {
    /// Each directed edge has its opposite, so every point off the surface has a whole winding
    /// number. Holds for solids that share edges, too.
    Closed,
    /// Some directed edges have none.
    Open {
        /// How many.
        unpaired: usize,
    },
}

impl TriangleMesh {
    /// The mesh of planar polygons, each an outer ring and its holes (see
    /// [`triangulate`](crate::triangulate)). Polygons that have no triangulation are covered by a
    /// fan and counted.
    #[must_use]
    pub fn from_polygons<P: AsRef<[Vec<DVec3>]>>(polygons: impl IntoIterator<Item = P>) -> Self {
        let mut weld = Weld::default();
        for polygon in polygons {
            let rings = polygon.as_ref();
            let triangles = triangulate(rings).unwrap_or_else(|_| {
                weld.mesh.untriangulable_faces += 1;
                fan(rings)
            });
            let numbers: Vec<u32> = rings.iter().flatten().map(|&p| weld.number(p)).collect();
            weld.mesh
                .triangles
                .extend(triangles.iter().map(|t| t.map(|i| numbers[i])));
        }
        weld.mesh
    }

    /// The mesh of triangles given by their corners.
    #[must_use]
    pub fn from_triangles(triangles: impl IntoIterator<Item = [DVec3; 3]>) -> Self {
        let mut weld = Weld::default();
        for triangle in triangles {
            let numbers = triangle.map(|corner| weld.number(corner));
            weld.mesh.triangles.push(numbers);
        }
        weld.mesh
    }

    /// The smallest box that holds all vertices; `None` when there are none.
    #[must_use]
    pub fn envelope(&self) -> Option<Box3d> {
        Box3d::around(self.vertices.iter().copied())
    }

    /// The triangles by their corners. Those that name a vertex that is not there are left out.
    pub fn corners(&self) -> impl Iterator<Item = [DVec3; 3]> {
        self.triangles.iter().filter_map(|&[a, b, c]| {
            let corner = |number: u32| self.vertices.get(number as usize).copied();
            Some([corner(a)?, corner(b)?, corner(c)?])
        })
    }

    /// Whether each directed edge is balanced by its opposite.
    #[must_use]
    pub fn closedness(&self) -> Closedness {
        let edges = self
            .triangles
            .iter()
            .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        // An edge is its two ends in order, with +1 along and -1 against.
        let mut balance: Vec<(u32, u32, i64)> = edges
            .map(|[from, to]| {
                (
                    from.min(to),
                    from.max(to),
                    i64::from(to > from) - i64::from(to < from),
                )
            })
            .collect();
        balance.sort_unstable_by_key(|&(low, high, _)| (low, high));
        let same = balance.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1));
        let unpaired: u64 = same
            .map(|edge| {
                edge.iter()
                    .map(|&(_, _, turn)| turn)
                    .sum::<i64>()
                    .unsigned_abs()
            })
            .sum();
        match unpaired {
            0 => Closedness::Closed,
            unpaired => Closedness::Open {
                unpaired: unpaired as usize,
            },
        }
    }

    /// The volume inside in cubic metres, negative when the mesh is inside out; meaningful for a
    /// closed mesh.
    #[must_use]
    pub fn signed_volume(&self) -> f64 {
        let origin = self.vertices.first().copied().unwrap_or_default();
        self.corners()
            .map(|triangle| triangle.map(|corner| corner - origin))
            .map(|[a, b, c]| a.dot(b.cross(c)) / 6.0)
            .sum()
    }

    /// How often the surface winds around `point`: 1 inside one solid, 0 outside, whole for a
    /// closed mesh up to rounding. Means nothing for a point on the surface.
    #[must_use]
    pub fn winding_number(&self, point: DVec3) -> f64 {
        self.corners()
            .map(|triangle| triangle_winding(&triangle, point))
            .sum()
    }

    /// Checks that the surface is closed and known, so that winding numbers tell in from out.
    pub(crate) fn check_closed(&self) -> Result<(), MeshDefect> {
        if self.triangles.is_empty() {
            return Err(MeshDefect::NoFaces);
        }
        if !self.vertices.iter().all(|v| v.is_finite()) {
            return Err(MeshDefect::NotFinite);
        }
        if self.untriangulable_faces > 0 {
            return Err(MeshDefect::UntriangulableFaces {
                faces: self.untriangulable_faces,
            });
        }
        match self.closedness() {
            Closedness::Closed => Ok(()),
            Closedness::Open { unpaired } => Err(MeshDefect::Open { edges: unpaired }),
        }
    }
}

/// A mesh in the making, which finds a vertex by its bits.
#[derive(Default)]
struct Weld {
    mesh: TriangleMesh,
    numbers: HashMap<[u64; 3], u32>,
}

impl Weld {
    fn number(&mut self, position: DVec3) -> u32 {
        // Adding zero makes −0 equal to 0.
        let position = position + DVec3::ZERO;
        *self
            .numbers
            .entry(position.to_array().map(f64::to_bits))
            .or_insert_with(|| {
                self.mesh.vertices.push(position);
                (self.mesh.vertices.len() - 1) as u32
            })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FAR: DVec3 = DVec3::new(85_000.0, 447_000.0, -3.0);

    /// The faces of a box as polygons.
    fn box_faces(min: DVec3, size: f64) -> Vec<Vec<Vec<DVec3>>> {
        let corners = Box3d::new(min, min + size).corners();
        [
            [0, 2, 3, 1],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 4, 6, 2],
            [1, 3, 7, 5],
        ]
        .map(|face| vec![face.map(|i: usize| corners[i]).to_vec()])
        .to_vec()
    }

    #[test]
    fn box_is_closed_and_winds_once() {
        let mesh = TriangleMesh::from_polygons(box_faces(FAR, 10.0));
        assert_eq!((mesh.vertices.len(), mesh.triangles.len()), (8, 12));
        assert_eq!(mesh.closedness(), Closedness::Closed);
        assert!((mesh.signed_volume() - 1000.0).abs() < 1e-9);
        assert!((mesh.winding_number(FAR + 0.01) - 1.0).abs() < 1e-12);
        assert!((mesh.winding_number(FAR - 0.01)).abs() < 1e-12);
    }

    #[test]
    fn missing_face_leaves_its_edges_unpaired() {
        let mesh = TriangleMesh::from_polygons(&box_faces(FAR, 10.0)[1..]);
        assert_eq!(mesh.closedness(), Closedness::Open { unpaired: 4 });
    }

    #[test]
    fn turned_face_leaves_its_edges_unpaired_twice() {
        let mut faces = box_faces(FAR, 10.0);
        faces[3][0].reverse();
        let mesh = TriangleMesh::from_polygons(faces);
        assert_eq!(mesh.closedness(), Closedness::Open { unpaired: 8 });
    }

    #[test]
    fn solids_that_share_an_edge_are_closed() {
        let (one, other) = (
            box_faces(FAR, 10.0),
            box_faces(FAR + DVec3::new(10.0, 10.0, 0.0), 10.0),
        );
        let mesh = TriangleMesh::from_polygons([one, other].concat());
        assert_eq!(mesh.vertices.len(), 14);
        assert_eq!(mesh.closedness(), Closedness::Closed);
    }

    #[test]
    fn vertices_weld_by_value_of_zero() {
        let mesh = TriangleMesh::from_triangles([
            [DVec3::ZERO, DVec3::X, DVec3::Y],
            [-DVec3::ZERO, DVec3::Y, DVec3::X],
        ]);
        assert_eq!(mesh.vertices.len(), 3);
        assert_eq!(mesh.closedness(), Closedness::Closed);
    }

    #[test]
    fn triangles_that_name_no_vertex_are_left_out() {
        let mesh = TriangleMesh {
            triangles: vec![[0, 1, 2]],
            ..TriangleMesh::default()
        };
        assert_eq!(mesh.corners().count(), 0);
        assert_eq!(mesh.envelope(), None);
    }
}
