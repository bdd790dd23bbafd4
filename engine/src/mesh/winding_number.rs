//! How often a surface winds around a point.
//!
//! Jacobson, Kavan, Sorkine-Hornung, "Robust inside-outside segmentation using generalized winding
//! numbers", SIGGRAPH 2013, section 4: the sum of the triangles' signed solid angles over 4π.

use std::f64::consts::TAU;

use glam::DVec3;

/// Signed solid angle of a triangle over 4π, seen from `point`: positive when its anticlockwise
/// side faces away from the point.
///
/// Van Oosterom and Strackee, "The solid angle of a plane triangle", IEEE Transactions on
/// Biomedical Engineering 30(2), 1983, equation 8.
#[must_use]
pub fn triangle_winding(triangle: &[DVec3; 3], point: DVec3) -> f64 {
    let [a, b, c] = triangle.map(|corner| corner - point);
    let (la, lb, lc) = (a.length(), b.length(), c.length());
    let determinant = a.dot(b.cross(c));
    let divisor = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    // The half-angle formula gives half of the solid angle, so 4π becomes one full turn.
    determinant.atan2(divisor) / TAU
}
