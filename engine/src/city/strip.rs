//! [`Strip`], the footprint of a generated building.

use geo::Polygon;
use glam::I64Vec2;

use super::lattice::{line_string, position};
use crate::TriangleMesh;

/// The ground between an outer and an inner line that have as many points: a rectangle, a bent
/// wing, or, where it is closed, a ring around a courtyard.
///
/// The outer line runs anticlockwise around the building; the quadrilateral between two steps of
/// the lines is convex.
#[derive(Clone, Debug, PartialEq)]
pub struct Strip {
    pub outer: Vec<I64Vec2>,
    pub inner: Vec<I64Vec2>,
    pub closed: bool,
}

impl Strip {
    /// The rectangle or parallelogram on the left of an edge.
    pub fn parallelogram(start: I64Vec2, along: I64Vec2, inward: I64Vec2) -> Self {
        Self {
            outer: vec![start, start + along],
            inner: vec![start + inward, start + along + inward],
            closed: false,
        }
    }

    /// The footprint with its courtyard, metres.
    pub fn polygon(&self) -> Polygon<f64> {
        let points: Vec<I64Vec2> = self.points().collect();
        let mut rings = self
            .rings()
            .into_iter()
            .map(|ring| line_string(ring.into_iter().map(|number| points[number])));
        let outer = rings.next().expect("a strip has an outer ring");
        Polygon::new(outer, rings.collect())
    }

    /// The convex quadrilaterals that make it up, each anticlockwise with its outer edge first.
    pub fn quads(&self) -> impl Iterator<Item = [I64Vec2; 4]> {
        let points: Vec<I64Vec2> = self.points().collect();
        self.numbered_quads()
            .into_iter()
            .map(move |quad| quad.map(|number| points[number]))
    }

    /// The closed surface of the building with flat roof, from the ground to `top` metres.
    pub fn prism(&self, top: f64) -> TriangleMesh {
        let points: Vec<_> = self.points().map(position).collect();
        let above = points.len();
        let mut triangles = Vec::new();
        for [a, b, c, d] in self.numbered_quads() {
            triangles.extend([[a, c, b], [a, d, c]]);
            triangles.extend([[a, b, c], [a, c, d]].map(|t| t.map(|number| number + above)));
        }
        for ring in self.rings() {
            let next = ring.iter().cycle().skip(1);
            for (&from, &to) in ring.iter().zip(next) {
                triangles.extend([[from, to, to + above], [from, to + above, from + above]]);
            }
        }
        let level = |z: f64| points.iter().map(move |p| p.extend(z));
        TriangleMesh {
            vertices: level(0.0).chain(level(top)).collect(),
            triangles: triangles
                .into_iter()
                .map(|t| t.map(|number| number as u32))
                .collect(),
            untriangulable_faces: 0,
        }
    }

    /// The outer points, then the inner ones.
    fn points(&self) -> impl Iterator<Item = I64Vec2> {
        self.outer.iter().chain(&self.inner).copied()
    }

    /// Outer ring anticlockwise, then the courtyard clockwise.
    fn rings(&self) -> Vec<Vec<usize>> {
        let count = self.outer.len();
        let (outer, inner) = (0..count, (count..2 * count).rev());
        if self.closed {
            vec![outer.collect(), inner.collect()]
        } else {
            vec![outer.chain(inner).collect()]
        }
    }

    fn numbered_quads(&self) -> Vec<[usize; 4]> {
        let count = self.outer.len();
        let steps = if self.closed { count } else { count - 1 };
        (0..steps)
            .map(|from| (from, (from + 1) % count))
            .map(|(from, to)| [from, to, count + to, count + from])
            .collect()
    }
}
