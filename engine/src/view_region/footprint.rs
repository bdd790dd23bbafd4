//! [`footprint`], what a mesh covers on the ground.

use geo::{Area, BoundingRect, ConvexHull, Coord, LineString, MultiPoint, MultiPolygon, Polygon};
use geo::{Orient, orient::Direction, unary_union};
use glam::DVec3;

use crate::TriangleMesh;

/// A triangle with less projected area than this is seen edge on, square metres: what a face
/// covers that is a metre high and vertical up to the 1 µm that the union resolves.
const EDGE_ON: f64 = 1e-6;

/// The area in which a mesh stands or hangs: the union of its triangles, projected along z.
///
/// Outer rings turn anticlockwise, holes clockwise. Vertical faces vanish, so the footprint of a
/// sheet without thickness is empty. If the union fails, the convex hull stands in: a footprint may
/// be too large, not too small.
#[must_use]
pub fn footprint(mesh: &TriangleMesh) -> MultiPolygon<f64> {
    let triangles: Vec<Polygon<f64>> = mesh.corners().filter_map(projected).collect();
    let union = unary_union(&triangles);
    // A union covers its largest part and no more than the sum of all.
    let areas = || triangles.iter().map(Area::unsigned_area);
    let (largest, sum) = (areas().fold(0.0, f64::max), areas().sum::<f64>());
    let area = union.unsigned_area();
    if area >= 0.99 * largest && area <= 1.01 * sum {
        return union.orient(Direction::Default);
    }
    hull(&triangles).into_iter().collect()
}

/// The triangle on the ground, turning anticlockwise; `None` when it is seen edge on.
fn projected(corners: [DVec3; 3]) -> Option<Polygon<f64>> {
    if !corners.iter().all(|corner| corner.is_finite()) {
        return None;
    }
    let [a, b, c] = corners.map(DVec3::truncate);
    let twice_area = (b - a).perp_dot(c - a);
    if twice_area.abs() < 2.0 * EDGE_ON {
        return None;
    }
    let ring = if twice_area > 0.0 {
        [a, b, c]
    } else {
        [a, c, b]
    };
    let ring = ring.map(|p| Coord { x: p.x, y: p.y });
    Some(Polygon::new(LineString::new(ring.to_vec()), Vec::new()))
}

/// The convex hull of all polygons; `None` when it has no area.
pub(super) fn hull<'a>(
    polygons: impl IntoIterator<Item = &'a Polygon<f64>>,
) -> Option<Polygon<f64>> {
    let points = polygons
        .into_iter()
        .flat_map(|polygon| polygon.exterior().points());
    let hull = MultiPoint::from_iter(points)
        .convex_hull()
        .orient(Direction::Default);
    let has_area = hull.bounding_rect().is_some() && hull.unsigned_area() > 0.0;
    has_area.then_some(hull)
}
