//! Points to test against triangles: of `f64` values, or anywhere between.

use std::cmp::Ordering;

use crate::aabb::Point;
use crate::determinant::{orientation, turn};
use crate::exact::{Rational, Vector, vector};
use crate::interval::Interval;
use crate::number::{Number, cross, difference, dot, middle, sign_of};

/// A point whose side of any line or plane through `f64` points is known exactly.
pub(crate) trait TestPoint {
    /// The nearest `f64` point. Rounding keeps the order of each coordinate against `f64` values,
    /// but for making unequal ones equal.
    fn nearest(&self) -> Point;
    /// The order of a value against a coordinate of the point.
    fn order(&self, value: f64, axis: usize) -> Ordering;
    /// Greater if `a`, `b` and the point turn anticlockwise in the plane of the axes.
    fn turn(&self, a: Point, b: Point, axes: (usize, usize)) -> Ordering;
    /// Greater if the point lies below the plane through `a`, `b`, `c` that turn anticlockwise.
    fn orientation(&self, a: Point, b: Point, c: Point) -> Ordering;
}

impl TestPoint for Point {
    fn nearest(&self) -> Point {
        *self
    }

    fn order(&self, value: f64, axis: usize) -> Ordering {
        value.partial_cmp(&self[axis]).unwrap_or(Ordering::Equal)
    }

    fn turn(&self, a: Point, b: Point, axes: (usize, usize)) -> Ordering {
        turn(a, b, *self, axes)
    }

    fn orientation(&self, a: Point, b: Point, c: Point) -> Ordering {
        orientation(a, b, c, *self)
    }
}

/// A point of rational coordinates, with what the filter needs.
#[derive(Clone, Debug)]
pub(crate) struct ExactPoint {
    exact: Vector,
    around: [Interval; 3],
    nearest: Point,
}

impl ExactPoint {
    /// The point of these coordinates.
    pub(crate) fn new(exact: Vector) -> Self {
        let nearest = exact.each_ref().map(|x| x.to_f64().value());
        Self {
            exact,
            around: nearest.map(|x| Interval::outward(x, x)),
            nearest,
        }
    }
}

impl TestPoint for ExactPoint {
    fn nearest(&self) -> Point {
        self.nearest
    }

    fn order(&self, value: f64, axis: usize) -> Ordering {
        let exact = || Rational::from_f64(value).cmp(&self.exact[axis]);
        Interval::from_f64(value)
            .compare(&self.around[axis])
            .unwrap_or_else(exact)
    }

    fn turn(&self, a: Point, b: Point, axes: (usize, usize)) -> Ordering {
        turn_around(&self.around, a, b, axes)
            .or_else(|| turn_around(&self.exact, a, b, axes))
            // Rationals always decide.
            .unwrap_or(Ordering::Equal)
    }

    fn orientation(&self, a: Point, b: Point, c: Point) -> Ordering {
        let corners = [a, b, c];
        orientation_around(&self.around, corners)
            .or_else(|| orientation_around(&self.exact, corners))
            // Rationals always decide.
            .unwrap_or(Ordering::Equal)
    }
}

fn turn_around<N: Number>(
    point: &[N; 3],
    a: Point,
    b: Point,
    (i, j): (usize, usize),
) -> Option<Ordering> {
    let from = |corner: Point, axis: usize| N::from_f64(corner[axis]).minus(&point[axis]);
    sign_of(
        &from(a, i)
            .times(&from(b, j))
            .minus(&from(a, j).times(&from(b, i))),
    )
}

fn orientation_around<N: Number>(point: &[N; 3], corners: [Point; 3]) -> Option<Ordering> {
    let [u, v, w] = corners.map(|corner| difference(&corner.map(N::from_f64), point));
    sign_of(&dot(&u, &cross(&v, &w)))
}

/// The exact point above a spot in plan.
pub(crate) fn raised(spot: &[Rational; 2], height: Rational) -> ExactPoint {
    let [x, y] = spot.clone();
    ExactPoint::new([x, y, height])
}

/// The exact point halfway between two.
pub(crate) fn halfway(a: Point, b: Point) -> ExactPoint {
    let (a, b) = (vector(a), vector(b));
    ExactPoint::new(std::array::from_fn(|axis| middle(&a[axis], &b[axis])))
}
