//! [`Plan`], the mesh seen from above: a triangulation in which every edge of the mesh and every
//! contour at a level is an edge.

use std::collections::{HashMap, HashSet};

use glam::{DVec2, DVec3};
use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

use super::facets::{Facet, Facets};
use super::outline::Corner;
use crate::{MeshDefect, TriangleMesh};

/// Most corners, and most crossings, of a plan: ten times those of the most intricate building of a
/// real city, and about a second of work.
const MOST_CORNERS: usize = 50_000;

/// A corner of the mesh this close to a level is on it, metres.
pub const ON_LEVEL: f64 = 1e-6;

/// A crossing this close to a corner is that corner, metres, or this share of the greatest
/// coordinate: rounding alone must not make corners, since lines between them cross again.
const SAME_CORNER: [f64; 2] = [1e-7, 1e-13];

type Cdt = ConstrainedDelaunayTriangulation<Point2<f64>>;
type Handle = FixedVertexHandle;

/// A triangulation of the mesh's convex hull in plan.
pub struct Plan {
    /// Places of the corners: those of the mesh's vertices first, bit for bit.
    pub places: Vec<DVec2>,
    /// How many of them are places of vertices. The others were computed, and are rounded.
    pub exact: usize,
    /// Corners of each triangle, anticlockwise.
    pub triangles: Vec<[usize; 3]>,
    /// The triangle across each edge, from each corner to the next; `None` at the rim.
    pub neighbours: Vec<[Option<usize>; 3]>,
    /// Whether each edge is on an edge of the mesh or a contour.
    pub is_line: Vec<[bool; 3]>,
}

impl Plan {
    /// The numbers of an edge's ends.
    pub fn edge(&self, triangle: usize, edge: usize) -> [usize; 2] {
        let corners = self.triangles[triangle];
        [corners[edge % 3], corners[(edge + 1) % 3]]
    }

    pub fn corner(&self, number: usize) -> Corner {
        Corner {
            number,
            place: self.places[number],
            is_exact: number < self.exact,
        }
    }

    /// # Errors
    /// [`MeshDefect`] when there are too many corners.
    pub fn new(mesh: &TriangleMesh, facets: &Facets, levels: &[f64]) -> Result<Self, MeshDefect> {
        let mut draft = Draft::new(mesh)?;
        let exact = draft.cdt.num_vertices();
        draft.add_facets(facets, levels)?;
        draft.add_lines()?;
        Ok(draft.finish(exact))
    }
}

/// A plan in the making.
struct Draft {
    cdt: Cdt,
    /// The corner above or below each vertex of the mesh.
    corners: Vec<Handle>,
    /// Corners on each line between two others, and how far along each is.
    lines: HashMap<[Handle; 2], Vec<(f64, Handle)>>,
    /// Corners by the square of a grid in which they are.
    squares: HashMap<[i64; 2], Vec<Handle>>,
    /// Contours.
    contours: Vec<[Handle; 2]>,
    /// Crossings so far.
    crossings: usize,
    /// Distance within which a crossing is at a corner.
    same_corner: f64,
}

impl Draft {
    fn new(mesh: &TriangleMesh) -> Result<Self, MeshDefect> {
        let coordinates = mesh
            .vertices
            .iter()
            .map(|v| v.truncate().abs().max_element());
        let greatest = coordinates.fold(0.0, f64::max);
        let mut draft = Self {
            cdt: Cdt::new(),
            corners: Vec::new(),
            lines: HashMap::new(),
            squares: HashMap::new(),
            contours: Vec::new(),
            crossings: 0,
            same_corner: SAME_CORNER[0].max(SAME_CORNER[1] * greatest),
        };
        for vertex in &mesh.vertices {
            let corner = draft.add_corner(vertex.truncate())?;
            draft.corners.push(corner);
        }
        Ok(draft)
    }

    fn add_corner(&mut self, place: DVec2) -> Result<Handle, MeshDefect> {
        if self.cdt.num_vertices() >= MOST_CORNERS {
            return Err(MeshDefect::TooIntricate {
                limit: MOST_CORNERS,
            });
        }
        // Spade refuses magnitudes whose products underflow; they are zero to any building.
        let flushed = place.map(|x| {
            if x.abs() < spade::MIN_ALLOWED_VALUE {
                0.0
            } else {
                x
            }
        });
        let count = self.cdt.num_vertices();
        let inserted = self.cdt.insert(Point2::new(flushed.x, flushed.y));
        let corner = inserted.map_err(|_| MeshDefect::NotFinite)?;
        if self.cdt.num_vertices() > count {
            self.squares
                .entry(self.square(place))
                .or_default()
                .push(corner);
        }
        Ok(corner)
    }

    /// Notes the lines of all facets and their contours.
    fn add_facets(&mut self, facets: &Facets, levels: &[f64]) -> Result<(), MeshDefect> {
        let flat = edges_within_levels(facets);
        let mut crossings = HashMap::new();
        for facet in &facets.list {
            for edge in edges(facet) {
                let [from, to] = edge.map(|(number, _)| self.corners[number as usize]);
                if from != to && !flat.contains(&edge.map(|(number, _)| number)) {
                    self.lines.entry(ordered([from, to])).or_default();
                }
            }
            let [low, high] = facet.heights();
            if !facet.is_broad || high - low <= 2.0 * ON_LEVEL {
                continue;
            }
            let from = levels.partition_point(|&z| z <= low + ON_LEVEL);
            let to = levels.partition_point(|&z| z < high - ON_LEVEL);
            for (number, &level) in levels.iter().enumerate().take(to).skip(from) {
                self.add_contour(facet, number, level, &mut crossings)?;
            }
        }
        Ok(())
    }

    /// Notes where a slope is at a level.
    fn add_contour(
        &mut self,
        facet: &Facet,
        number: usize,
        level: f64,
        crossings: &mut HashMap<([u32; 2], usize), Handle>,
    ) -> Result<(), MeshDefect> {
        let mut ends = Vec::new();
        for (vertex, corner) in facet.vertices.iter().zip(&facet.corners) {
            if (corner.z - level).abs() <= ON_LEVEL {
                ends.push(self.corners[*vertex as usize]);
            }
        }
        for [(a, from), (b, to)] in edges(facet) {
            let is_on = |corner: DVec3| (corner.z - level).abs() <= ON_LEVEL;
            if is_on(from) || is_on(to) || (from.z < level) == (to.z < level) {
                continue;
            }
            if let Some(&crossing) = crossings.get(&([a, b], number)) {
                ends.push(crossing);
                continue;
            }
            let along = (level - from.z) / (to.z - from.z);
            let place = from.truncate().lerp(to.truncate(), along);
            let crossing = self.add_computed(place)?;
            crossings.insert(([a, b], number), crossing);
            ends.push(crossing);
            let line = [a, b].map(|number| self.corners[number as usize]);
            if line[0] != line[1] {
                let key = ordered(line);
                let along = if key == line { along } else { 1.0 - along };
                self.lines.entry(key).or_default().push((along, crossing));
            }
        }
        if let [from, to] = ends[..]
            && from != to
        {
            self.contours.push([from, to]);
        }
        Ok(())
    }

    /// Makes all lines and contours edges of the triangulation.
    fn add_lines(&mut self) -> Result<(), MeshDefect> {
        let mut lines: Vec<_> = std::mem::take(&mut self.lines).into_iter().collect();
        lines.sort_unstable_by_key(|(ends, _)| ends.map(|end| end.index()));
        for ([from, to], mut stops) in lines {
            stops.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
            let mut last = from;
            for stop in stops.into_iter().map(|(_, stop)| stop).chain([to]) {
                self.add_line([last, stop])?;
                last = stop;
            }
        }
        for contour in std::mem::take(&mut self.contours) {
            self.add_line(contour)?;
        }
        Ok(())
    }

    /// Adds a line, and a corner wherever it crosses another.
    fn add_line(&mut self, line: [Handle; 2]) -> Result<(), MeshDefect> {
        let mut left = vec![line];
        while let Some([from, to]) = left.pop() {
            if from == to || !self.cdt.try_add_constraint(from, to).is_empty() {
                continue;
            }
            // Rounding may move lines across each other again and again.
            self.crossings += 1;
            if self.crossings > MOST_CORNERS {
                return Err(MeshDefect::TooIntricate {
                    limit: MOST_CORNERS,
                });
            }
            let crossed = self
                .cdt
                .get_conflicting_edges_between_vertices(from, to)
                .next();
            let Some(crossed) = crossed.map(|edge| edge.as_undirected()) else {
                continue;
            };
            let (edge, [a, b]) = (crossed.fix(), crossed.vertices().map(|v| v.fix()));
            let ends = [from, to, a, b].map(|corner| self.place(corner));
            let corner = self.add_computed(crossing(ends))?;
            if corner != a && corner != b {
                self.cdt.remove_constraint_edge(edge);
                left.extend([[a, corner], [corner, b]]);
            }
            if corner == from || corner == to {
                left.push([from, to]);
            } else {
                left.extend([[from, corner], [corner, to]]);
            }
        }
        Ok(())
    }

    /// The corner at a computed place: a new one, or one that is there.
    fn add_computed(&mut self, place: DVec2) -> Result<Handle, MeshDefect> {
        let square = self.square(place);
        let around = (-1..=1).flat_map(|x| (-1..=1).map(move |y| [x, y]));
        let mut near = around
            .filter_map(|[x, y]| self.squares.get(&[square[0] + x, square[1] + y]))
            .flatten();
        let same = near.find(|&&corner| self.place(corner).distance(place) <= self.same_corner);
        same.copied().map_or_else(|| self.add_corner(place), Ok)
    }

    /// The square of a place in a grid as wide as corners are apart. Far away they are as wide as
    /// numbers can tell.
    fn square(&self, place: DVec2) -> [i64; 2] {
        // At least half the range of whole numbers is left for neighbours.
        let number = |x: f64| (x / self.same_corner).clamp(-4e18, 4e18) as i64;
        [number(place.x), number(place.y)]
    }

    fn place(&self, corner: Handle) -> DVec2 {
        let place = self.cdt.vertex(corner).position();
        DVec2::new(place.x, place.y)
    }

    fn finish(self, exact: usize) -> Plan {
        let places = self.cdt.vertices().map(|v| self.place(v.fix())).collect();
        let mut plan = Plan {
            places,
            exact,
            triangles: Vec::new(),
            neighbours: Vec::new(),
            is_line: Vec::new(),
        };
        // The outer face has the first number.
        let number = |index: usize| index.checked_sub(1);
        for face in self.cdt.inner_faces() {
            let edges = face.adjacent_edges();
            plan.triangles
                .push(edges.map(|edge| edge.from().fix().index()));
            plan.neighbours.push(edges.map(|edge| {
                edge.rev()
                    .face()
                    .as_inner()
                    .and_then(|face| number(face.index()))
            }));
            plan.is_line
                .push(edges.map(|edge| edge.is_constraint_edge()));
        }
        plan
    }
}

/// The edges of a facet, each from its lower numbered vertex.
fn edges(facet: &Facet) -> [[(u32, DVec3); 2]; 3] {
    [0, 1, 2].map(|i| {
        let end = |i: usize| (facet.vertices[i % 3], facet.corners[i % 3]);
        let (from, to) = (end(i), end(i + 1));
        if from.0 <= to.0 {
            [from, to]
        } else {
            [to, from]
        }
    })
}

/// Edges between two level facets that continue each other: they bound nothing.
fn edges_within_levels(facets: &Facets) -> HashSet<[u32; 2]> {
    let mut faces: HashMap<[u32; 2], (usize, i32)> = HashMap::new();
    for facet in &facets.list {
        let faced = if facet.is_level() { facet.faces } else { 0 };
        for edge in edges(facet) {
            let (count, sum) = faces.entry(edge.map(|(number, _)| number)).or_default();
            *count += 1;
            *sum += faced;
        }
    }
    let within = faces
        .into_iter()
        .filter(|(_, (count, sum))| *count == 2 && sum.abs() == 2);
    within.map(|(edge, _)| edge).collect()
}

fn ordered([a, b]: [Handle; 2]) -> [Handle; 2] {
    if a.index() <= b.index() {
        [a, b]
    } else {
        [b, a]
    }
}

/// Where the line from the first to the second place crosses that through the others, nearly.
fn crossing([from, to, a, b]: [DVec2; 4]) -> DVec2 {
    let (run, across) = (to - from, b - a);
    let along = (a - from).perp_dot(across) / run.perp_dot(across);
    // Lines that are all but parallel may give anything.
    let along = if along.is_finite() {
        along.clamp(0.0, 1.0)
    } else {
        0.5
    };
    from.lerp(to, along)
}
