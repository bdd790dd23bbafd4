//! Proof that a box is inside a mesh.

use glam::DVec3;

use super::triangle_mesh::TriangleMesh;
use crate::Box3d;

/// How far a slanted triangle must stay from the box, as a share of the mesh's longest side.
///
/// Separation along a slanted axis is computed with an error of some 1e-15 of the distances
/// involved, so this leaves a factor of a million; larger would only cost volume.
const SEPARATION: f64 = 1e-9;

/// A winding number is a whole number for a closed mesh; computed ones are that close to it unless
/// the point is next to the surface.
const WINDING_TOLERANCE: f64 = 0.01;

/// Whether no triangle meets the open box and the mesh winds around its centre, for a closed mesh:
/// so the open box is inside the solid.
///
/// Triangles that touch the box in an axis-aligned plane are told apart by exact comparison;
/// others must keep the separation. Never `true` wrongly.
pub fn is_inside(bounds: &Box3d, mesh: &TriangleMesh) -> bool {
    let Some(envelope) = mesh.envelope() else {
        return false;
    };
    let separation = SEPARATION * envelope.size().max_element();
    bounds.min.cmplt(bounds.max).all()
        && mesh
            .corners()
            .all(|triangle| is_apart(bounds, &triangle, separation))
        && winds_around(mesh, bounds.center())
}

/// Whether the winding number at `point` is 1 or more; `false` when in doubt.
pub fn winds_around(mesh: &TriangleMesh, point: DVec3) -> bool {
    let winding = mesh.winding_number(point);
    (winding - winding.round()).abs() < WINDING_TOLERANCE && winding.round() >= 1.0
}

/// Whether the triangle misses the open box: any axis that separates the two is proof.
fn is_apart(bounds: &Box3d, triangle: &[DVec3; 3], separation: f64) -> bool {
    let [a, b, c] = *triangle;
    if a.min(b).min(c).cmpge(bounds.max).any() || a.max(b).max(c).cmple(bounds.min).any() {
        return true;
    }
    let (ab, bc, ca) = (b - a, c - b, a - c);
    let normal = ab.cross(ca);
    let across = [ab, bc, ca]
        .into_iter()
        .flat_map(|e| DVec3::AXES.map(|axis| e.cross(axis)));
    std::iter::once(normal)
        .chain(across)
        .any(|axis| separates(axis, bounds, triangle, separation))
}

/// Whether the box and the triangle are `separation` apart along `axis`, which needs no length and
/// need not be accurate: separation along any axis is proof.
fn separates(axis: DVec3, bounds: &Box3d, triangle: &[DVec3; 3], separation: f64) -> bool {
    let axis = axis.normalize_or_zero();
    if axis == DVec3::ZERO {
        return false;
    }
    let origin = triangle[0];
    let (low, high) = (bounds.min - origin, bounds.max - origin);
    let (near, far) = (axis * low, axis * high);
    let (least, greatest) = (near.min(far).element_sum(), near.max(far).element_sum());
    let along = triangle.map(|corner| axis.dot(corner - origin));
    let below = along.iter().all(|&t| t <= least - separation);
    let above = along.iter().all(|&t| t >= greatest + separation);
    below || above
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOUNDS: Box3d = Box3d {
        min: DVec3::ZERO,
        max: DVec3::ONE,
    };

    #[test]
    fn flush_is_apart_to_the_last_bit() {
        let wall = |x: f64| {
            [
                DVec3::new(x, 0.0, 0.0),
                DVec3::new(x, 1.0, 0.0),
                DVec3::new(x, 0.0, 1.0),
            ]
        };
        assert!(is_apart(&BOUNDS, &wall(1.0), 1e-9));
        assert!(!is_apart(&BOUNDS, &wall(1.0_f64.next_down()), 1e-9));
        assert!(is_apart(&BOUNDS, &wall(0.0), 1e-9));
        assert!(!is_apart(&BOUNDS, &wall(0.0_f64.next_up()), 1e-9));
    }

    #[test]
    fn slanted_contact_needs_separation() {
        // A plane past the upper corner, at x + y + z = sum.
        let roof = |sum: f64| DVec3::AXES.map(|axis| axis * sum);
        assert!(is_apart(&BOUNDS, &roof(3.0 + 1e-6), 1e-9));
        assert!(!is_apart(&BOUNDS, &roof(3.0), 1e-9));
        // An edge that crosses over an edge of the box.
        let beam = |lift: f64| {
            let top = DVec3::new(1.0, 0.5, 1.0) + lift;
            [
                top - DVec3::new(5.0, 0.0, -5.0),
                top + DVec3::new(5.0, 0.0, -5.0),
                top + 9.0,
            ]
        };
        assert!(is_apart(&BOUNDS, &beam(1e-6), 1e-9));
        assert!(!is_apart(&BOUNDS, &beam(-1e-6), 1e-9));
    }

    #[test]
    fn triangles_without_area_are_no_proof() {
        let through = [DVec3::splat(-1.0), DVec3::splat(2.0), DVec3::splat(0.5)];
        assert!(!is_apart(&BOUNDS, &through, 1e-9));
        let point = [DVec3::splat(0.5); 3];
        assert!(!is_apart(&BOUNDS, &point, 1e-9));
        let beside = [
            DVec3::new(2.0, -1.0, 0.5),
            DVec3::new(-1.0, 3.0, 0.5),
            DVec3::new(0.5, 1.0, 0.5),
        ];
        assert!(is_apart(
            &BOUNDS,
            &[beside[0] + 1.0, beside[1] + 1.0, beside[2] + 1.0],
            1e-9
        ));
    }
}
