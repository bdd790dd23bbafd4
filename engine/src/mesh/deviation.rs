//! [`deviation`], how far one surface strays from another.

use glam::DVec3;
use rstar::primitives::CachedEnvelope;
use rstar::{AABB, PointDistance, RTree, RTreeObject};

use super::triangle_mesh::TriangleMesh;

/// The greatest distance in metres from a sample of either surface to the other: the error of a
/// level of detail against the best one. The samples are all vertices, middles of edges and
/// centroids, so the true Hausdorff distance may be a little greater. `None` when a mesh is empty.
#[must_use]
pub fn deviation(a: &TriangleMesh, b: &TriangleMesh) -> Option<f64> {
    let one_way = greatest_distance(a, b)?;
    Some(one_way.max(greatest_distance(b, a)?))
}

fn greatest_distance(from: &TriangleMesh, to: &TriangleMesh) -> Option<f64> {
    let faces = to
        .corners()
        .map(|corners| CachedEnvelope::new(Face(corners)));
    let surface = RTree::bulk_load(faces.collect());
    let mut greatest_2 = None;
    for sample in samples(from).map(|sample| sample.to_array()) {
        // Most samples are near enough to some face, which is soon found.
        let is_near = |within_2| {
            surface
                .locate_within_distance(sample, within_2)
                .next()
                .is_some()
        };
        if !greatest_2.is_some_and(is_near) {
            let nearest = surface.nearest_neighbor(sample)?;
            greatest_2 = Some(
                nearest
                    .distance_2(&sample)
                    .max(greatest_2.unwrap_or_default()),
            );
        }
    }
    greatest_2.map(f64::sqrt)
}

/// All vertices, middles of edges and centroids.
fn samples(mesh: &TriangleMesh) -> impl Iterator<Item = DVec3> {
    let inner = mesh.corners().flat_map(|[a, b, c]| {
        let edges = [[a, b], [b, c], [c, a]];
        // An edge has two triangles, but for the border, whose ends are vertices.
        let once = edges
            .into_iter()
            .filter(|[from, to]| from.to_array() < to.to_array());
        let middles = once.map(|[from, to]| (from + to) / 2.0);
        middles.chain([(a + b + c) / 3.0])
    });
    mesh.vertices.iter().copied().chain(inner)
}

/// A triangle that knows how far it is.
struct Face([DVec3; 3]);

impl RTreeObject for Face {
    type Envelope = AABB<[f64; 3]>;

    fn envelope(&self) -> Self::Envelope {
        let corners = self.0.map(|corner| corner.to_array());
        AABB::from_points(&corners)
    }
}

impl PointDistance for Face {
    fn distance_2(&self, point: &[f64; 3]) -> f64 {
        let point = DVec3::from(*point);
        closest_point(&self.0, point).distance_squared(point)
    }
}

/// The point of a triangle that is closest to `p`: in the inside where `p` projects there, or else
/// on one of the edges.
fn closest_point(&[a, b, c]: &[DVec3; 3], p: DVec3) -> DVec3 {
    let normal = (b - a).cross(c - a);
    let is_left_of = |from: DVec3, to: DVec3| (to - from).cross(p - from).dot(normal) >= 0.0;
    if normal != DVec3::ZERO && is_left_of(a, b) && is_left_of(b, c) && is_left_of(c, a) {
        let unit = normal.normalize();
        return p - unit * unit.dot(p - a);
    }
    [[a, b], [b, c], [c, a]]
        .map(|[from, to]| closest_on_edge(from, to, p))
        .into_iter()
        .min_by(|x, y| x.distance_squared(p).total_cmp(&y.distance_squared(p)))
        .unwrap_or(a)
}

fn closest_on_edge(from: DVec3, to: DVec3, p: DVec3) -> DVec3 {
    let along = to - from;
    let length_2 = along.length_squared();
    if length_2 == 0.0 {
        return from;
    }
    from + along * ((p - from).dot(along) / length_2).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    const FAR: DVec3 = DVec3::new(85_000.0, 447_000.0, 3.0);

    fn square(lift: f64) -> TriangleMesh {
        let corner = |x: f64, y: f64| FAR + DVec3::new(x, y, lift);
        TriangleMesh::from_polygons([vec![vec![
            corner(0.0, 0.0),
            corner(10.0, 0.0),
            corner(10.0, 10.0),
            corner(0.0, 10.0),
        ]]])
    }

    #[test]
    fn parallel_sheets_are_their_distance_apart() {
        assert_eq!(deviation(&square(0.0), &square(2.5)), Some(2.5));
        assert_eq!(deviation(&square(0.0), &square(0.0)), Some(0.0));
        assert_eq!(deviation(&square(0.0), &TriangleMesh::default()), None);
    }

    #[test]
    fn it_counts_both_ways() {
        let mut larger = square(0.0);
        larger.triangles.push([0, 1, 4]);
        larger.vertices.push(FAR + DVec3::new(5.0, -7.0, 0.0));
        assert_eq!(deviation(&square(0.0), &larger), Some(7.0));
        assert_eq!(deviation(&larger, &square(0.0)), Some(7.0));
    }

    #[test]
    fn the_closest_point_is_inside_on_an_edge_or_at_a_corner() {
        let triangle = [
            DVec3::ZERO,
            DVec3::new(4.0, 0.0, 0.0),
            DVec3::new(0.0, 4.0, 0.0),
        ];
        let closest = |x: f64, y: f64, z: f64| closest_point(&triangle, DVec3::new(x, y, z));
        assert_eq!(closest(1.0, 1.0, 5.0), DVec3::new(1.0, 1.0, 0.0));
        assert_eq!(closest(2.0, -3.0, 1.0), DVec3::new(2.0, 0.0, 0.0));
        assert_eq!(closest(4.0, 4.0, 1.0), DVec3::new(2.0, 2.0, 0.0));
        assert_eq!(closest(-1.0, -1.0, 0.0), DVec3::ZERO);
        let flat = [DVec3::ZERO, DVec3::X, DVec3::X * 2.0];
        assert_eq!(
            closest_point(&flat, DVec3::new(3.0, 1.0, 0.0)),
            DVec3::X * 2.0
        );
    }
}
