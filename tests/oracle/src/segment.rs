//! Open segments against open prisms: the one predicate behind *hidden*.

use crate::aabb::{Point, is_finite};
use crate::prism::Prism;

/// Whether the open segment from `p` to `q` meets the open prism, which reaches down without bound
/// if it is grounded.
///
/// Exact. Touching, grazing and running within a face do not meet it, and neither do a segment of
/// no length or anything with a NaN: whatever cannot hide is no obstacle.
#[must_use]
pub fn segment_meets_interior(p: Point, q: Point, prism: &Prism) -> bool {
    is_finite(p)
        && is_finite(q)
        && !is_beside(p, q, prism)
        && prism.meets([p, q], [&prism.depths(p), &prism.depths(q)])
}

/// Whether both ends lie on or beyond the same side of the box around the prism.
#[inline]
fn is_beside(p: Point, q: Point, prism: &Prism) -> bool {
    let bounds = &prism.bounds;
    (0..3).any(|axis| {
        p[axis].max(q[axis]) <= bounds.min[axis] || p[axis].min(q[axis]) >= bounds.max[axis]
    })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::aabb::Aabb;
    use crate::overlap::triangle_meets_interior;
    use crate::scenes::{cases, points};

    proptest! {
        #![proptest_config(cases(6000))]
        #[test]
        fn direction_does_not_matter([p, q, a, b] in points(), grounded in any::<bool>()) {
            let Ok(prism) = Prism::of_box(&Aabb::around(&[a, b]), grounded) else {
                return Ok(());
            };
            prop_assert_eq!(
                segment_meets_interior(p, q, &prism),
                segment_meets_interior(q, p, &prism)
            );
        }

        #[test]
        fn agrees_with_separating_axes([p, q, a, b] in points()) {
            let aabb = Aabb::around(&[a, b]);
            prop_assume!(aabb.has_volume());
            let prism = Prism::of_box(&aabb, false).unwrap();
            // Another method: a segment is a degenerate triangle; its closed form differs from the
            // open one by the ends, which meet the open box only together with points between.
            prop_assert_eq!(
                segment_meets_interior(p, q, &prism),
                p != q && triangle_meets_interior(&[p, q, p], &aabb)
            );
        }
    }
}
