//! Exact arithmetic on `f64` values, and exact signs.

use std::cmp::Ordering;

use glam::{DVec2, DVec3};

use crate::predicates::{side, turn};

/// An exact rational. It takes out common factors of two only, which keeps what `f64` values make
/// short.
pub type Rational = dashu_ratio::Relaxed;

/// A vector of exact rationals.
pub type Vector = [Rational; 3];

/// Adaptive signs hold as long as no product of coordinates leaves the range of `f64`: for
/// magnitudes up to this and, but for zero, down to its reciprocal. Others are decided by rationals.
const LARGEST_FOR_ADAPTIVE: f64 = 1e60;

/// The exact value of a finite number.
pub fn rational(value: f64) -> Rational {
    Rational::try_from(value).unwrap_or(Rational::ZERO)
}

/// The exact place of a point.
pub fn vector(point: DVec3) -> Vector {
    point.to_array().map(rational)
}

/// The vector from `b` to `a`.
pub fn difference(a: &Vector, b: &Vector) -> Vector {
    std::array::from_fn(|axis| &a[axis] - &b[axis])
}

/// The scalar product.
pub fn dot(a: &Vector, b: &Vector) -> Rational {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

/// The vector product.
pub fn cross(a: &Vector, b: &Vector) -> Vector {
    let component = |i: usize, j: usize| &a[i] * &b[j] - &a[j] * &b[i];
    [component(1, 2), component(2, 0), component(0, 1)]
}

/// The sign of `a · (b × c)`.
pub fn determinant_sign(a: &Vector, b: &Vector, c: &Vector) -> Ordering {
    sign(&dot(a, &cross(b, c)))
}

/// The sign of a number, as its order against zero.
pub fn sign(value: &Rational) -> Ordering {
    value.cmp(&Rational::ZERO)
}

/// Whether all components are zero.
pub fn is_zero(vector: &Vector) -> bool {
    vector.iter().all(|component| component.is_zero())
}

/// The nearest `f64`.
pub fn rounded(value: &Rational) -> f64 {
    value.to_f64().value()
}

/// The side of a triangle that a point is on: `Greater` where it turns anticlockwise.
pub fn side_of(triangle: &[DVec3; 3], point: DVec3) -> Ordering {
    if is_adaptive(triangle.iter().chain([&point]).flat_map(DVec3::as_ref)) {
        return order(side(triangle, point));
    }
    let [u, v, w] = triangle.map(|corner| difference(&vector(corner), &vector(point)));
    determinant_sign(&w, &v, &u)
}

/// `Greater` where `a`, `b`, `c` turn anticlockwise.
pub fn turn_of(a: DVec2, b: DVec2, c: DVec2) -> Ordering {
    if is_adaptive([a, b, c].iter().flat_map(DVec2::as_ref)) {
        return order(turn(a, b, c));
    }
    let [a, b, c] = [a, b, c].map(|p| [rational(p.x), rational(p.y)]);
    let [u, v] = [b, c].map(|p| [&p[0] - &a[0], &p[1] - &a[1]]);
    sign(&(&u[0] * &v[1] - &u[1] * &v[0]))
}

fn is_adaptive<'a>(coordinates: impl IntoIterator<Item = &'a f64>) -> bool {
    coordinates.into_iter().all(|coordinate| {
        let size = coordinate.abs();
        size == 0.0 || (1.0 / LARGEST_FOR_ADAPTIVE..=LARGEST_FOR_ADAPTIVE).contains(&size)
    })
}

/// The sign of a number that is no NaN.
fn order(value: f64) -> Ordering {
    value.partial_cmp(&0.0).unwrap_or(Ordering::Equal)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_ways_to_a_sign_agree() {
        let triangle = [
            DVec3::new(85_000.1, 447_000.3, 0.0),
            DVec3::new(85_010.0, 447_000.0, 0.2),
            DVec3::new(85_003.0, 447_007.7, 1.0),
        ];
        for (z, expected) in [(9.0, Ordering::Greater), (-9.0, Ordering::Less)] {
            let point = DVec3::new(85_004.0, 447_002.0, z);
            let huge = 2f64.powi(300);
            assert_eq!(side_of(&triangle, point), expected);
            assert_eq!(side_of(&triangle.map(|c| c * huge), point * huge), expected);
            let tiny = 2f64.powi(-500);
            assert_eq!(side_of(&triangle.map(|c| c * tiny), point * tiny), expected);
        }
        let [a, b, c] = triangle.map(DVec3::truncate);
        assert_eq!(turn_of(a, b, c), Ordering::Greater);
        assert_eq!(turn_of(a * 1e300, c * 1e300, b * 1e300), Ordering::Less);
        assert_eq!(turn_of(a * 1e-300, b * 1e-300, b * 1e-300), Ordering::Equal);
    }
}
