//! Triangles against open boxes, exactly.

use std::cmp::Ordering;

use crate::aabb::{Aabb, Point};
use crate::exact::Rational;
use crate::interval::Interval;
use crate::mesh::Triangle;
use crate::number::{Number, cross, difference, dot};

/// Whether the closed triangle meets the open box, both finite. Touching its boundary from
/// outside or running within a face does not.
pub(crate) fn triangle_meets_interior(triangle: &Triangle, aabb: &Aabb) -> bool {
    if !aabb.has_volume() || beside(triangle, aabb) {
        return false;
    }
    if triangle
        .iter()
        .any(|&corner| aabb.interior_contains(corner))
    {
        return true;
    }
    overlap::<Interval>(triangle, aabb)
        .or_else(|| overlap::<Rational>(triangle, aabb))
        // Rationals always decide.
        .unwrap_or(true)
}

/// Whether a face of the box keeps the triangle out.
fn beside([a, b, c]: &Triangle, aabb: &Aabb) -> bool {
    (0..3)
        .any(|i| a[i].max(b[i]).max(c[i]) <= aabb.min[i] || a[i].min(b[i]).min(c[i]) >= aabb.max[i])
}

/// The separating axis test (S. Gottschalk, M. C. Lin, D. Manocha, "OBBTree", 1996, section 5)
/// for a triangle that no face of the box separates: the open box is missed exactly when the two
/// are weakly separated along the normal or the cross product of an edge and an axis. `None`
/// where the arithmetic cannot tell.
fn overlap<N: Number>(triangle: &Triangle, aabb: &Aabb) -> Option<bool> {
    let origin = aabb.min.map(N::from_f64);
    let relative = |point: Point| difference(&point.map(N::from_f64), &origin);
    let corners = triangle.map(relative);
    let size = relative(aabb.max);
    let edges = [(0, 1), (1, 2), (2, 0)].map(|(i, j)| difference(&corners[j], &corners[i]));
    let normal = cross(&edges[0], &edges[1]);
    let sides = edges
        .iter()
        .flat_map(|edge| (0..3).map(|axis| cross(edge, &unit(axis))));
    let mut certain = true;
    for axis in std::iter::once(normal).chain(sides) {
        match separates(&axis, &corners, &size) {
            Some(true) => return Some(false),
            Some(false) => {}
            None => certain = false,
        }
    }
    certain.then_some(true)
}

/// Whether the projections on `axis` of the triangle and of the box from the origin to `size`
/// share no interior point.
fn separates<N: Number>(axis: &[N; 3], corners: &[[N; 3]; 3], size: &[N; 3]) -> Option<bool> {
    let zero = N::from_f64(0.0);
    let order = [0, 1, 2].map(|i| axis[i].compare(&zero));
    // A zero axis separates nothing; it stems from a degenerate triangle or a parallel edge.
    if order == [Some(Ordering::Equal); 3] {
        return Some(false);
    }
    let reach = [0, 1, 2].map(|i| axis[i].times(&size[i]));
    let low = reach
        .iter()
        .fold(zero.clone(), |sum, x| sum.plus(&x.smaller(&zero)));
    let high = reach
        .iter()
        .fold(zero.clone(), |sum, x| sum.plus(&x.larger(&zero)));
    let [a, b, c] = [0, 1, 2].map(|i| dot(axis, &corners[i]));
    let below = a.larger(&b).larger(&c).compare(&low);
    let above = a.smaller(&b).smaller(&c).compare(&high);
    match (below, above) {
        (Some(Ordering::Less | Ordering::Equal), _) => Some(true),
        (_, Some(Ordering::Greater | Ordering::Equal)) => Some(true),
        (Some(Ordering::Greater), Some(Ordering::Less)) => Some(false),
        _ => None,
    }
}

/// The unit vector of an axis.
fn unit<N: Number>(axis: usize) -> [N; 3] {
    std::array::from_fn(|i| N::from_f64(if i == axis { 1.0 } else { 0.0 }))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::exact::{Vector, rational, vector};
    use crate::scenes::{cases, points};

    /// Another method: clip the triangle by the six half-spaces in rationals. What is left of it
    /// is convex, so it meets the open box exactly when its centroid is strictly inside.
    fn clipped_meets_interior(triangle: &Triangle, aabb: &Aabb) -> bool {
        let mut polygon: Vec<Vector> = triangle.iter().map(|&corner| vector(corner)).collect();
        for axis in 0..3 {
            polygon = clip(&polygon, axis, &rational(aabb.min[axis]), false);
            polygon = clip(&polygon, axis, &rational(aabb.max[axis]), true);
        }
        let Some(count) = u32::try_from(polygon.len()).ok().filter(|count| *count > 0) else {
            return false;
        };
        (0..3).all(|axis| {
            let sum = polygon.iter().fold(Rational::ZERO, |sum, p| sum + &p[axis]);
            let centre = sum / Rational::from(count);
            rational(aabb.min[axis]) < centre && centre < rational(aabb.max[axis])
        })
    }

    fn clip(polygon: &[Vector], axis: usize, bound: &Rational, below: bool) -> Vec<Vector> {
        let inside = |p: &Vector| {
            if below {
                p[axis] <= *bound
            } else {
                p[axis] >= *bound
            }
        };
        let mut kept = Vec::new();
        for (i, p) in polygon.iter().enumerate() {
            let q = &polygon[(i + 1) % polygon.len()];
            if inside(p) {
                kept.push(p.clone());
            }
            if inside(p) != inside(q) {
                let t = (bound - &p[axis]) / (&q[axis] - &p[axis]);
                kept.push(std::array::from_fn(|k| &p[k] + (&q[k] - &p[k]) * &t));
            }
        }
        kept
    }

    proptest! {
        #![proptest_config(cases(3000))]
        #[test]
        fn agrees_with_clipping([a, b, c, d, e] in points()) {
            let aabb = Aabb::around(&[d, e]);
            prop_assume!(aabb.has_volume());
            prop_assert_eq!(
                triangle_meets_interior(&[a, b, c], &aabb),
                clipped_meets_interior(&[a, b, c], &aabb)
            );
        }

        #[test]
        fn filter_never_disagrees([a, b, c, d, e] in points()) {
            let aabb = Aabb::around(&[d, e]);
            prop_assume!(aabb.has_volume() && !beside(&[a, b, c], &aabb));
            if let Some(answer) = overlap::<Interval>(&[a, b, c], &aabb) {
                prop_assert_eq!(Some(answer), overlap::<Rational>(&[a, b, c], &aabb));
            }
        }
    }

    const UNIT: Aabb = Aabb {
        min: [0.0; 3],
        max: [1.0; 3],
    };

    #[test]
    fn touching_is_no_overlap() {
        // In a face, through an edge, at a corner, and a slanted plane over an edge.
        let outside = [
            [[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]],
            [[-1.0, 1.0, 0.5], [1.0, 3.0, 0.5], [-1.0, 1.0, 9.0]],
            [[1.0, 1.0, 1.0], [2.0, 2.0, 2.0], [3.0, 1.0, 1.0]],
            [[-1.0, 0.5, 2.0], [0.5, 0.5, 0.5 + 1.0], [2.0, 0.0, 1.0]],
            [[2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [1.0, 1.0, 5.0]],
        ];
        for triangle in outside {
            assert!(!triangle_meets_interior(&triangle, &UNIT), "{triangle:?}");
        }
    }

    #[test]
    fn a_hair_inside_is_seen() {
        let dent = 1f64.next_down();
        let roof = [[-9.0, -9.0, dent], [9.0, -9.0, dent], [0.0, 9.0, dent]];
        assert!(triangle_meets_interior(&roof, &UNIT));
        let corner = [
            [2.0f64.next_down(), 0.0, 0.0],
            [0.0, 2.0, 0.0],
            [1.0, 1.0, 5.0],
        ];
        assert!(triangle_meets_interior(&corner, &UNIT));
        let needle = [[0.5, 0.5, -1.0], [0.5, 0.5, 2.0], [0.5, 0.5, -1.0]];
        assert!(triangle_meets_interior(&needle, &UNIT));
    }
}
