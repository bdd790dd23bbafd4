//! Exact signs of 3 x 3 determinants of differences: every orientation predicate is one.

use std::cmp::Ordering;

use crate::aabb::Point;
use crate::exact::{sign, vector};
use crate::interval::Interval;
use crate::number::{cross, difference, dot};

/// Relative error of a determinant whose entries are differences rounded once. A term of three
/// entries takes 3 rounded entries, 2 products and 3 sums or differences, so at most 8 roundings
/// of 2^-53 each; twice that also covers the rounding of the bound itself. (J. R. Shewchuk,
/// "Adaptive precision floating-point arithmetic", 1997, section 4.3, has the sharper
/// 7 roundings; the looser one costs nothing here.)
const RELATIVE_ERROR: f64 = 8.0 * f64::EPSILON;

/// A row of a determinant, the exact difference `head - tail`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Row {
    pub(crate) head: Point,
    pub(crate) tail: Point,
}

impl Row {
    /// The row `head - tail`.
    pub(crate) fn new(head: Point, tail: Point) -> Self {
        Self { head, tail }
    }

    /// The difference, rounded once.
    pub(crate) fn rounded(&self) -> Point {
        subtract(self.head, self.tail)
    }
}

/// A determinant in floating point, with a bound on its error.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Estimate {
    pub(crate) value: f64,
    pub(crate) error: f64,
}

impl Estimate {
    /// The sign of the exact value, if the error leaves no doubt.
    pub(crate) fn sign(&self) -> Option<Ordering> {
        if self.value > self.error {
            Some(Ordering::Greater)
        } else if self.value < -self.error {
            Some(Ordering::Less)
        } else {
            None
        }
    }

    /// An interval that holds the exact value.
    pub(crate) fn interval(&self) -> Interval {
        Interval::outward(self.value - self.error, self.value + self.error)
    }
}

/// The difference of two points, rounded once.
#[inline]
pub(crate) fn subtract(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// `u · (v x w)` for vectors whose entries were rounded once. An overflow gives infinity or NaN,
/// for which no sign is certain.
#[inline]
pub(crate) fn estimate(u: Point, v: Point, w: Point) -> Estimate {
    let products = [
        v[1] * w[2],
        v[2] * w[1],
        v[2] * w[0],
        v[0] * w[2],
        v[0] * w[1],
        v[1] * w[0],
    ];
    let value = u[0] * (products[0] - products[1])
        + u[1] * (products[2] - products[3])
        + u[2] * (products[4] - products[5]);
    let heads = u.map(f64::abs);
    let permanent = heads[0] * (products[0].abs() + products[1].abs())
        + heads[1] * (products[2].abs() + products[3].abs())
        + heads[2] * (products[4].abs() + products[5].abs());
    // A product that underflows is off by less than MIN_POSITIVE, then multiplied by an entry of u.
    let underflow = f64::MIN_POSITIVE * (1.0 + heads[0] + heads[1] + heads[2]);
    Estimate {
        value,
        error: RELATIVE_ERROR * permanent + underflow,
    }
}

/// The exact sign of the determinant of three rows of finite coordinates.
pub(crate) fn determinant_sign(rows: [Row; 3]) -> Ordering {
    let [u, v, w] = rows.map(|row| row.rounded());
    estimate(u, v, w).sign().unwrap_or_else(|| exact_sign(rows))
}

/// The same by rational arithmetic alone.
fn exact_sign(rows: [Row; 3]) -> Ordering {
    let [u, v, w] = rows.map(|row| difference(&vector(row.head), &vector(row.tail)));
    sign(&dot(&u, &cross(&v, &w)))
}

/// Greater if `d` lies below the plane through `a`, `b`, `c`, seen so that they turn anticlockwise
/// from above; less if above; equal if in the plane.
pub(crate) fn orientation(a: Point, b: Point, c: Point, d: Point) -> Ordering {
    determinant_sign([Row::new(a, d), Row::new(b, d), Row::new(c, d)])
}

/// Greater if `a`, `b`, `c` turn anticlockwise in the plane of the axes `i` and `j`.
pub(crate) fn turn(a: Point, b: Point, c: Point, axes: (usize, usize)) -> Ordering {
    determinant_sign(turn_rows(a, b, c, axes))
}

/// Twice the area of the triangle `a`, `b`, `c` in plan, positive if they turn anticlockwise.
#[inline]
pub(crate) fn plan_estimate(a: Point, b: Point, c: Point) -> Estimate {
    let [u, v, w] = turn_rows(a, b, c, (0, 1)).map(|row| row.rounded());
    estimate(u, v, w)
}

#[inline]
fn turn_rows(a: Point, b: Point, c: Point, (i, j): (usize, usize)) -> [Row; 3] {
    let flat = |p: Point| [p[i], p[j], 0.0];
    let up = Row::new([0.0, 0.0, 1.0], [0.0; 3]);
    [Row::new(flat(a), flat(c)), Row::new(flat(b), flat(c)), up]
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::scenes::{cases, points};

    proptest! {
        #![proptest_config(cases(3000))]
        #[test]
        fn filter_never_disagrees([a, b, c, d] in points()) {
            let rows = [Row::new(a, d), Row::new(b, d), Row::new(c, d)];
            prop_assert_eq!(determinant_sign(rows), exact_sign(rows));
        }

        #[test]
        fn filter_never_disagrees_near_a_plane(
            [a, b, c] in points(), s in 0.0..1.0, t in 0.0..1.0,
        ) {
            let d = std::array::from_fn(|i| a[i] + s * (b[i] - a[i]) + t * (c[i] - a[i]));
            let rows = [Row::new(a, d), Row::new(b, d), Row::new(c, d)];
            prop_assert_eq!(determinant_sign(rows), exact_sign(rows));
        }

        #[test]
        fn filter_survives_any_finite_coordinate(coordinates in proptest::array::uniform12(
            any::<f64>().prop_filter("finite", |x| x.is_finite())
        )) {
            let [a, b, c, d] =
                [0, 3, 6, 9].map(|i| [coordinates[i], coordinates[i + 1], coordinates[i + 2]]);
            let rows = [Row::new(a, d), Row::new(b, d), Row::new(c, d)];
            prop_assert_eq!(determinant_sign(rows), exact_sign(rows));
        }
    }

    #[test]
    fn one_unit_in_the_last_place_is_seen() {
        let (a, b, c) = (
            [85_000.0, 447_000.0, 7.0],
            [85_010.0, 447_000.0, 7.0],
            [85_000.0, 447_010.0, 7.0],
        );
        let above = |z| orientation(a, b, c, [85_003.3, 447_003.3, z]);
        assert_eq!(above(7.0), Ordering::Equal);
        assert_eq!(above(7f64.next_up()), Ordering::Less);
        assert_eq!(above(7f64.next_down()), Ordering::Greater);
    }

    #[test]
    fn turns_are_exact() {
        let (a, b) = ([0.0, 0.0, 9.0], [1e15, 1e15, 0.0]);
        assert_eq!(turn(a, b, [0.5, 0.5, 3.0], (0, 1)), Ordering::Equal);
        assert_eq!(
            turn(a, b, [0.5, 0.5f64.next_up(), 3.0], (0, 1)),
            Ordering::Greater
        );
        assert_eq!(
            turn(a, b, [0.5, 0.5f64.next_down(), 3.0], (0, 1)),
            Ordering::Less
        );
    }
}
