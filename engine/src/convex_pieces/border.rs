//! [`Border`], the footprint of a column as its edges.

use geo::{ConvexHull, LineString, Polygon};
use glam::DVec2;

use super::growth::Edge;
use crate::mesh::triangulate;

/// The edges of a polygon with holes, the inside to their left.
pub struct Border {
    /// Near the polygon, so that differences keep their digits.
    pub origin: DVec2,
    /// Vertices ring by ring, absolute.
    rings: Vec<Vec<DVec2>>,
    /// Relative to the origin.
    pub edges: Vec<Edge>,
    /// Convex hull, anticlockwise, relative.
    pub hull: Vec<DVec2>,
}

impl Border {
    /// `None` for a polygon that has no area, is not finite, or has more than `most` vertices.
    pub fn new(polygon: &Polygon<f64>, most: usize) -> Option<Self> {
        let all = || std::iter::once(polygon.exterior()).chain(polygon.interiors());
        let vertices: usize = all().map(|ring| ring.0.len()).sum();
        let rings: Vec<Vec<DVec2>> = all().map(ring).collect();
        let origin = *rings.first()?.first()?;
        if vertices > most || !rings.iter().flatten().all(|vertex| vertex.is_finite()) {
            return None;
        }
        let mut hull = ring(polygon.convex_hull().exterior());
        hull.iter_mut().for_each(|corner| *corner -= origin);
        let edges = edges(&rings)
            .map(|[from, to]| Edge::new(from - origin, to - origin))
            .collect();
        (hull.len() >= 3).then_some(Self {
            origin,
            rings,
            edges,
            hull,
        })
    }

    /// The edges, absolute.
    pub fn edges(&self) -> impl Iterator<Item = [DVec2; 2]> + Clone {
        edges(&self.rings)
    }

    /// The vertex within `reach` of a relative place.
    pub fn vertex_near(&self, place: DVec2, reach: f64) -> Option<DVec2> {
        let near = |v: &&DVec2| (**v - self.origin).distance_squared(place) <= reach * reach;
        self.rings.iter().flatten().find(near).copied()
    }

    /// Places inside, relative, those with the most room around them first: the middles of the
    /// circles in a triangulation's triangles.
    pub fn seeds(&self) -> impl Iterator<Item = DVec2> {
        let vertices: Vec<Vec<_>> = self
            .rings
            .iter()
            .map(|ring| {
                ring.iter()
                    .map(|&v| (v - self.origin).extend(0.0))
                    .collect()
            })
            .collect();
        let flat = vertices.concat();
        let mut circles: Vec<(DVec2, f64)> = triangulate(&vertices)
            .unwrap_or_default()
            .into_iter()
            .map(|triangle| inscribed_circle(triangle.map(|i| flat[i].truncate())))
            .filter(|(_, radius)| *radius > 0.0)
            .collect();
        circles.sort_by(|a, b| b.1.total_cmp(&a.1));
        circles.into_iter().map(|(middle, _)| middle)
    }
}

/// The vertices of a ring, without repetitions in a row.
fn ring(line: &LineString<f64>) -> Vec<DVec2> {
    let mut vertices: Vec<DVec2> = line.coords().map(|c| DVec2::new(c.x, c.y)).collect();
    vertices.dedup();
    if vertices.len() > 1 && vertices.first() == vertices.last() {
        vertices.pop();
    }
    vertices
}

fn edges(rings: &[Vec<DVec2>]) -> impl Iterator<Item = [DVec2; 2]> + Clone {
    rings
        .iter()
        .flat_map(|ring| (0..ring.len()).map(|i| [ring[i], ring[(i + 1) % ring.len()]]))
}

/// Middle and radius.
fn inscribed_circle([a, b, c]: [DVec2; 3]) -> (DVec2, f64) {
    let [p, q, r] = [(b, c), (c, a), (a, b)].map(|(from, to)| from.distance(to));
    let border = p + q + r;
    let doubled_area = (b - a).perp_dot(c - a).abs();
    ((a * p + b * q + c * r) / border, doubled_area / border)
}
