//! Exact rational arithmetic on `f64` values.

use std::cmp::Ordering;

use crate::aabb::Point;
use crate::number::Number;

/// An exact rational number. `Relaxed` takes out common factors of two only, which keeps the
/// dyadic rationals that `f64` values make in lowest terms without a greatest common divisor.
pub(crate) type Rational = dashu_ratio::Relaxed;

/// A vector of exact rationals.
pub(crate) type Vector = [Rational; 3];

/// The exact value of a finite `f64`. Callers refuse infinities and NaN before they come here.
pub(crate) fn rational(value: f64) -> Rational {
    debug_assert!(value.is_finite(), "not a finite number: {value}");
    Rational::try_from(value).unwrap_or(Rational::ZERO)
}

/// The exact coordinates of a finite point.
pub(crate) fn vector(point: Point) -> Vector {
    point.map(rational)
}

/// The sign of a rational, as its order against zero.
pub(crate) fn sign(value: &Rational) -> Ordering {
    value.cmp(&Rational::ZERO)
}

/// Whether all three coordinates are zero.
pub(crate) fn is_zero(vector: &Vector) -> bool {
    vector.iter().all(|coordinate| coordinate.is_zero())
}

impl Number for Rational {
    fn from_f64(value: f64) -> Self {
        rational(value)
    }

    fn plus(&self, other: &Self) -> Self {
        self + other
    }

    fn minus(&self, other: &Self) -> Self {
        self - other
    }

    fn times(&self, other: &Self) -> Self {
        self * other
    }

    fn over(&self, divisor: &Self) -> Self {
        debug_assert!(!divisor.is_zero(), "a quotient by zero");
        self / divisor
    }

    fn compare(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }

    fn smaller(&self, other: &Self) -> Self {
        self.min(other).clone()
    }

    fn larger(&self, other: &Self) -> Self {
        self.max(other).clone()
    }

    fn sorted(mut numbers: Vec<Self>) -> Option<Vec<Self>> {
        numbers.sort();
        Some(numbers)
    }
}
