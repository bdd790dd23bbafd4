//! How many different boxes a column holds.

use crate::Box3d;

/// Estimates the number of different boxes among `total` rows from a random sample, which it
/// sorts.
///
/// Haas and Stokes 1998, "Estimating the number of classes in a finite population", estimator
/// Duj1, as PostgreSQL uses it: n·d / (n − f₁ + f₁·n / N), with d different boxes in the sample of
/// n, f₁ of them seen once.
#[must_use]
pub fn distinct_boxes(sample: &mut [Box3d], total: f64) -> f64 {
    let key = |b: &Box3d| [b.min.to_array(), b.max.to_array()];
    sample.sort_unstable_by(|a, b| {
        let (a, b) = (key(a), key(b));
        a.as_flattened()
            .iter()
            .zip(b.as_flattened())
            .map(|(a, b)| a.total_cmp(b))
            .find(|order| order.is_ne())
            .unwrap_or(std::cmp::Ordering::Equal)
    });
    let (mut different, mut once) = (0usize, 0usize);
    for equal in sample.chunk_by(|a, b| a == b) {
        different += 1;
        once += usize::from(equal.len() == 1);
    }
    let (n, d, f1) = (sample.len() as f64, different as f64, once as f64);
    let total = total.max(n);
    if n == 0.0 {
        return 0.0;
    }
    (n * d / (n - f1 + f1 * n / total)).clamp(d, total)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    fn sample(kinds: usize, rows: usize) -> Vec<Box3d> {
        (0..rows)
            .map(|i| Box3d::new(DVec3::ZERO, DVec3::splat((i % kinds) as f64)))
            .collect()
    }

    #[test]
    fn unique_boxes_grow_with_the_table() {
        assert_eq!(distinct_boxes(&mut sample(1_000, 1_000), 1e6), 1e6);
    }

    #[test]
    fn boxes_seen_often_are_all_there_are() {
        assert_eq!(distinct_boxes(&mut sample(10, 1_000), 1e6), 10.0);
        assert_eq!(distinct_boxes(&mut sample(1, 1_000), 1e6), 1.0);
        assert_eq!(distinct_boxes(&mut [], 0.0), 0.0);
    }
}
