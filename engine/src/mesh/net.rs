//! [`Net`], the constrained Delaunay triangulation of rings in the plane.

use std::collections::{HashMap, VecDeque};

use glam::{DVec2, DVec3};
use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

use super::triangulate::{PolygonDefect, edges};

/// The constrained Delaunay triangulation of flattened rings.
pub struct Net {
    cdt: ConstrainedDelaunayTriangulation<Point2<f64>>,
    /// The polygon's vertex behind each vertex of the triangulation.
    numbers: Vec<usize>,
    /// How often each stretch between two vertices is a ring edge, less how often against it.
    turns: HashMap<[FixedVertexHandle; 2], i32>,
    /// Triangles without area, where a ring edge runs through vertices.
    seams: Vec<[usize; 3]>,
}

impl Net {
    /// Lays out rings of vertex numbers, flattened; inside is on the left of their edges.
    pub fn new(
        rings: &[Vec<usize>],
        vertices: &[&DVec3],
        flatten: impl Fn(DVec3) -> DVec2,
    ) -> Result<Self, PolygonDefect> {
        let cdt = ConstrainedDelaunayTriangulation::new();
        let mut net = Self {
            cdt,
            numbers: Vec::new(),
            turns: HashMap::new(),
            seams: Vec::new(),
        };
        let mut handles = Vec::new();
        // All vertices first: a vertex that lands on a constraint would split it unseen.
        for ring in rings {
            let ring: Result<Vec<_>, _> = ring
                .iter()
                .map(|&number| net.add_vertex(number, vertices, &flatten))
                .collect();
            handles.push(ring?);
        }
        for (from, to) in handles.iter().flat_map(|ring| edges(ring)) {
            net.add_edge(from, to)?;
        }
        Ok(net)
    }

    fn add_vertex(
        &mut self,
        number: usize,
        vertices: &[&DVec3],
        flatten: impl Fn(DVec3) -> DVec2,
    ) -> Result<FixedVertexHandle, PolygonDefect> {
        let place = flatten(*vertices[number]);
        // Spade refuses magnitudes whose products underflow; they are zero to any polygon.
        let place = place.map(|x| {
            if x.abs() < spade::MIN_ALLOWED_VALUE {
                0.0
            } else {
                x
            }
        });
        let handle = self
            .cdt
            .insert(Point2::new(place.x, place.y))
            .map_err(|_| PolygonDefect::NotFinite)?;
        if handle.index() == self.numbers.len() {
            self.numbers.push(number);
        } else if vertices[self.numbers[handle.index()]] != vertices[number] {
            return Err(PolygonDefect::Folded);
        }
        Ok(handle)
    }

    /// Adds a ring edge, in stretches when it runs through other vertices.
    fn add_edge(
        &mut self,
        from: FixedVertexHandle,
        to: FixedVertexHandle,
    ) -> Result<(), PolygonDefect> {
        let stretches = self.cdt.try_add_constraint(from, to);
        let ends = stretches
            .iter()
            .map(|&stretch| self.cdt.directed_edge(stretch).to().fix());
        let stops: Vec<_> = std::iter::once(from).chain(ends).collect();
        if stops.last() != Some(&to) {
            return Err(PolygonDefect::Crossing);
        }
        for stretch in stops.windows(2) {
            *self.turns.entry([stretch[0], stretch[1]]).or_default() += 1;
            *self.turns.entry([stretch[1], stretch[0]]).or_default() -= 1;
        }
        let number = |stop: FixedVertexHandle| self.numbers[stop.index()];
        // A fan over the stretches, turned so that its edges undo theirs and leave the whole edge.
        let seams = stops[1..]
            .windows(2)
            .map(|s| [number(from), number(s[1]), number(s[0])]);
        self.seams.extend(seams);
        Ok(())
    }

    /// The faces that the rings wind around once.
    pub fn triangles(self) -> Result<Vec<[usize; 3]>, PolygonDefect> {
        let mut windings = vec![None; self.cdt.num_all_faces()];
        // Directed edges whose left side is known, from the outside inward.
        let mut queue: VecDeque<_> = self
            .cdt
            .directed_edges()
            .filter(|edge| edge.is_outer_edge())
            .map(|e| (e, 0))
            .collect();
        while let Some((edge, left)) = queue.pop_front() {
            let Some(beyond) = edge.rev().face().as_inner() else {
                continue;
            };
            let winding = &mut windings[beyond.index()];
            if winding.is_none() {
                let ends = [edge.from().fix(), edge.to().fix()];
                let right = left - self.turns.get(&ends).copied().unwrap_or(0);
                *winding = Some(right);
                queue.extend(beyond.adjacent_edges().map(|edge| (edge, right)));
            }
        }
        let mut triangles = Vec::new();
        for face in self.cdt.inner_faces() {
            match windings[face.index()] {
                Some(0) => {}
                Some(1) => triangles.push(
                    face.vertices()
                        .map(|vertex| self.numbers[vertex.fix().index()]),
                ),
                _ => return Err(PolygonDefect::Overlapping),
            }
        }
        triangles.extend(self.seams);
        Ok(triangles)
    }
}
