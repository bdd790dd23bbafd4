//! Triangle meshes and whether they close.

use std::collections::HashMap;

use crate::aabb::{Aabb, Point, is_finite};

/// The corners of a triangle.
pub type Triangle = [Point; 3];

/// A triangle mesh; triangles turn anticlockwise seen from outside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Positions, in metres.
    pub vertices: Vec<Point>,
    /// Positions in `vertices`, three a triangle.
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// A mesh of separate triangles, each with three vertices of its own.
    #[must_use]
    pub fn from_triangles(triangles: &[Triangle]) -> Self {
        let count = u32::try_from(triangles.len())
            .unwrap_or(u32::MAX / 3)
            .min(u32::MAX / 3);
        Self {
            vertices: triangles
                .iter()
                .take(count as usize)
                .flatten()
                .copied()
                .collect(),
            triangles: (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
        }
    }

    /// Whether the mesh bounds a solid: vertices of equal coordinates taken as one, every directed
    /// edge is balanced by its opposite. A mesh without triangles, with an index out of range or
    /// with a coordinate that is not finite is not closed.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        let Some(welded) = self.welded_triangles() else {
            return false;
        };
        !welded.is_empty() && unbalanced_edges(&welded).is_empty()
    }

    /// The corners of every triangle, or `None` if an index is out of range or a coordinate is not
    /// finite.
    #[must_use]
    pub fn corners(&self) -> Option<Vec<Triangle>> {
        self.triangles
            .iter()
            .map(|indices| self.triangle(*indices))
            .collect()
    }

    /// The box around the vertices in use.
    pub(crate) fn bounds(triangles: &[Triangle]) -> Aabb {
        Aabb::around(triangles.as_flattened())
    }

    /// The triangles with one index for each distinct position.
    pub(crate) fn welded_triangles(&self) -> Option<Vec<[u32; 3]>> {
        let mut numbers = HashMap::new();
        let corners = self.corners()?;
        let mut number = |point: Point| {
            // Adding zero makes -0 and 0 the same bits.
            let bits = point.map(|coordinate| (coordinate + 0.0).to_bits());
            let next = numbers.len() as u32;
            *numbers.entry(bits).or_insert(next)
        };
        Some(
            corners
                .iter()
                .map(|triangle| triangle.map(&mut number))
                .collect(),
        )
    }

    fn triangle(&self, indices: [u32; 3]) -> Option<Triangle> {
        let mut corners = [[0.0; 3]; 3];
        for (corner, index) in corners.iter_mut().zip(indices) {
            *corner = *self.vertices.get(index as usize)?;
        }
        corners
            .iter()
            .all(|corner| is_finite(*corner))
            .then_some(corners)
    }
}

/// The directed edges that occur more often than their opposites.
pub(crate) fn unbalanced_edges(triangles: &[[u32; 3]]) -> Vec<[u32; 2]> {
    let mut balance: HashMap<[u32; 2], i64> = HashMap::with_capacity(2 * triangles.len());
    for &[a, b, c] in triangles {
        for [from, to] in [[a, b], [b, c], [c, a]] {
            let (edge, step) = if from < to {
                ([from, to], 1)
            } else {
                ([to, from], -1)
            };
            // The edge of a vertex to itself is its own opposite.
            *balance.entry(edge).or_default() += if from == to { 0 } else { step };
        }
    }
    let mut edges: Vec<_> = balance
        .into_iter()
        .filter(|(_, count)| *count != 0)
        .map(|([a, b], count)| if count > 0 { [a, b] } else { [b, a] })
        .collect();
    edges.sort_unstable();
    edges
}
