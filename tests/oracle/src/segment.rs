//! Open segments against open boxes: the one predicate behind *hidden*.

use crate::aabb::{Aabb, Point, is_finite};
use crate::exact::{Rational, rational};
use crate::interval::Interval;

/// Whether the open segment from `p` to `q` meets the open box.
///
/// Exact. Touching, grazing and running within a face do not meet it, and neither do a segment of
/// no length, a box without volume, or anything with a NaN: whatever cannot hide is no obstacle.
#[must_use]
pub fn segment_meets_interior(p: Point, q: Point, aabb: &Aabb) -> bool {
    if !aabb.has_volume() || !is_finite(p) || !is_finite(q) {
        return false;
    }
    if p == q || on_one_side(p, q, aabb) {
        return false;
    }
    filtered(p, q, aabb).unwrap_or_else(|| exact(p, q, aabb))
}

/// Whether both ends lie on or beyond the same face, which keeps the segment out of the interior.
#[inline]
fn on_one_side(p: Point, q: Point, aabb: &Aabb) -> bool {
    (0..3).any(|axis| {
        p[axis].max(q[axis]) <= aabb.min[axis] || p[axis].min(q[axis]) >= aabb.max[axis]
    })
}

/// The slab test in intervals: the parameters at which the segment is between each pair of faces.
/// `None` where rounding leaves a doubt.
#[inline]
fn filtered(p: Point, q: Point, aabb: &Aabb) -> Option<bool> {
    let mut enter = Interval { lo: 0.0, hi: 0.0 };
    let mut leave = Interval { lo: 1.0, hi: 1.0 };
    for axis in 0..3 {
        // Parallel to this pair of faces, and between them since `on_one_side` is false.
        if p[axis] == q[axis] {
            continue;
        }
        let span = Interval::difference(q[axis], p[axis]);
        let (near, far) = ordered_faces(p, q, aabb, axis);
        if near.is_finite() {
            let t = Interval::difference(near, p[axis]).divide(span);
            enter = Interval {
                lo: enter.lo.max(t.lo),
                hi: enter.hi.max(t.hi),
            };
        }
        if far.is_finite() {
            let t = Interval::difference(far, p[axis]).divide(span);
            leave = Interval {
                lo: leave.lo.min(t.lo),
                hi: leave.hi.min(t.hi),
            };
        }
    }
    if enter.hi < leave.lo {
        Some(true)
    } else if enter.lo >= leave.hi {
        Some(false)
    } else {
        None
    }
}

/// The same slab test in rationals.
fn exact(p: Point, q: Point, aabb: &Aabb) -> bool {
    let mut enter = Rational::ZERO;
    let mut leave = Rational::ONE;
    for axis in 0..3 {
        if p[axis] == q[axis] {
            continue;
        }
        let start = rational(p[axis]);
        let span = rational(q[axis]) - &start;
        let (near, far) = ordered_faces(p, q, aabb, axis);
        if near.is_finite() {
            enter = enter.max((rational(near) - &start) / &span);
        }
        if far.is_finite() {
            leave = leave.min((rational(far) - &start) / &span);
        }
    }
    enter < leave
}

/// The face that the segment enters by and the one that it leaves by.
fn ordered_faces(p: Point, q: Point, aabb: &Aabb, axis: usize) -> (f64, f64) {
    if q[axis] > p[axis] {
        (aabb.min[axis], aabb.max[axis])
    } else {
        (aabb.max[axis], aabb.min[axis])
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::overlap::triangle_meets_interior;
    use crate::scenes::{cases, points};

    proptest! {
        #![proptest_config(cases(6000))]
        #[test]
        fn filter_never_disagrees([p, q, a, b] in points(), grounded in any::<bool>()) {
            let mut aabb = Aabb::around(&[a, b]);
            if grounded {
                aabb = aabb.extended_down();
            }
            prop_assume!(aabb.has_volume() && p != q && !on_one_side(p, q, &aabb));
            if let Some(answer) = filtered(p, q, &aabb) {
                prop_assert_eq!(answer, exact(p, q, &aabb));
            }
        }

        #[test]
        fn direction_does_not_matter([p, q, a, b] in points()) {
            let aabb = Aabb::around(&[a, b]);
            prop_assert_eq!(
                segment_meets_interior(p, q, &aabb),
                segment_meets_interior(q, p, &aabb)
            );
        }

        #[test]
        fn agrees_with_separating_axes([p, q, a, b] in points()) {
            let aabb = Aabb::around(&[a, b]);
            prop_assume!(aabb.has_volume());
            // Another method: a segment is a degenerate triangle; its closed form differs from the
            // open one by the ends, which meet the open box only together with points between.
            prop_assert_eq!(
                segment_meets_interior(p, q, &aabb),
                p != q && triangle_meets_interior(&[p, q, p], &aabb)
            );
        }
    }
}
