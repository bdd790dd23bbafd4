//! One formula, two arithmetics: what a predicate needs of a number.

use std::cmp::Ordering;

/// A number that a predicate can be evaluated in: an interval or an exact rational.
pub(crate) trait Number: Clone {
    /// The exact value of a finite `f64`.
    fn from_f64(value: f64) -> Self;
    /// The sum.
    fn plus(&self, other: &Self) -> Self;
    /// The difference.
    fn minus(&self, other: &Self) -> Self;
    /// The product.
    fn times(&self, other: &Self) -> Self;
    /// The quotient; of a rational only by what is not zero.
    fn over(&self, divisor: &Self) -> Self;
    /// The order of the exact values; `None` where this arithmetic cannot tell.
    fn compare(&self, other: &Self) -> Option<Ordering>;
    /// The smaller of two.
    fn smaller(&self, other: &Self) -> Self;
    /// The larger of two.
    fn larger(&self, other: &Self) -> Self;
    /// The numbers in ascending order; `None` where this arithmetic cannot tell.
    fn sorted(numbers: Vec<Self>) -> Option<Vec<Self>>;
}

/// The sign of a number, as its order against zero.
pub(crate) fn sign_of<N: Number>(number: &N) -> Option<Ordering> {
    number.compare(&N::from_f64(0.0))
}

/// The number halfway between two.
pub(crate) fn middle<N: Number>(a: &N, b: &N) -> N {
    a.plus(b).times(&N::from_f64(0.5))
}

/// The cross product.
pub(crate) fn cross<N: Number>(a: &[N; 3], b: &[N; 3]) -> [N; 3] {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| a[i].times(&b[j]).minus(&a[j].times(&b[i])))
}

/// The scalar product.
pub(crate) fn dot<N: Number>(a: &[N; 3], b: &[N; 3]) -> N {
    a[0].times(&b[0])
        .plus(&a[1].times(&b[1]))
        .plus(&a[2].times(&b[2]))
}

/// The difference of two vectors.
pub(crate) fn difference<N: Number>(a: &[N; 3], b: &[N; 3]) -> [N; 3] {
    std::array::from_fn(|axis| a[axis].minus(&b[axis]))
}
