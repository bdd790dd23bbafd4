//! How often a closed surface winds around a point, exactly.
//!
//! Counts the triangles above the point. To lie on nothing and under no edge, the point is first moved
//! by infinitesimals, each far smaller than the one before: Edelsbrunner and Mücke, "Simulation of
//! simplicity", ACM Transactions on Graphics 9(1), 1990.

use std::cmp::Ordering;

use glam::DVec3;

use super::exact::{
    Rational, Vector, cross, difference, dot, rational, rounded, side_of, sign, turn_of, vector,
};

/// The last moves of every point: along y, x and z.
const AXES: [DVec3; 3] = [DVec3::Y, DVec3::X, DVec3::Z];

/// A point, and on which side of things it is once moved.
pub trait Place {
    /// The nearest point of `f64` coordinates: rounding keeps their order against such numbers, but
    /// for making unequal ones equal.
    fn nearest(&self) -> DVec3;
    /// `Greater` where, in plan, `a`, `b` and the point turn anticlockwise; equal only for an edge
    /// without extent in plan.
    fn turn(&self, a: DVec3, b: DVec3) -> Ordering;
    /// `Greater` on the side from which the triangle, which is not upright, turns anticlockwise.
    fn side(&self, triangle: &[DVec3; 3]) -> Ordering;
}

/// Off the surface.
impl Place for DVec3 {
    fn nearest(&self) -> DVec3 {
        *self
    }

    fn turn(&self, a: DVec3, b: DVec3) -> Ordering {
        // Moved, it grows by (b.x - a.x) ε - (b.y - a.y) ε².
        turn_of(a.truncate(), b.truncate(), self.truncate())
            .then(order(b.x, a.x))
            .then(order(a.y, b.y))
    }

    fn side(&self, triangle: &[DVec3; 3]) -> Ordering {
        side_of(triangle, *self)
    }
}

/// A point anywhere.
pub struct ExactPlace<'a> {
    point: &'a Vector,
    /// The first moves.
    moves: Vec<Vector>,
}

impl<'a> ExactPlace<'a> {
    /// A point that is first moved in some directions.
    pub fn new(point: &'a Vector, moves: impl IntoIterator<Item = Vector>) -> Self {
        Self {
            point,
            moves: moves.into_iter().chain(AXES.map(vector)).collect(),
        }
    }

    /// The sign of what is `value` at the point and grows by `growth` of each move.
    fn sign(&self, value: &Rational, growth: impl Fn(&Vector) -> Rational) -> Ordering {
        self.moves
            .iter()
            .map(|way| sign(&growth(way)))
            .fold(sign(value), Ordering::then)
    }
}

impl Place for ExactPlace<'_> {
    fn nearest(&self) -> DVec3 {
        DVec3::from_array(self.point.each_ref().map(rounded))
    }

    fn turn(&self, a: DVec3, b: DVec3) -> Ordering {
        let edge = [0, 1].map(|axis| rational(b[axis]) - rational(a[axis]));
        let [x, y] = [0, 1].map(|axis| &self.point[axis] - rational(a[axis]));
        self.sign(&(&edge[0] * y - &edge[1] * x), |way| {
            &edge[0] * &way[1] - &edge[1] * &way[0]
        })
    }

    fn side(&self, triangle: &[DVec3; 3]) -> Ordering {
        let [a, b, c] = triangle.map(vector);
        let normal = cross(&difference(&b, &a), &difference(&c, &a));
        self.sign(&dot(&normal, &difference(self.point, &a)), |way| {
            dot(&normal, way)
        })
    }
}

/// The winding number of closed, outward triangles around a point.
pub fn winding(triangles: &[[DVec3; 3]], place: &impl Place) -> i64 {
    let nearest = place.nearest();
    triangles
        .iter()
        .filter(|triangle| may_be_above(triangle, nearest))
        .map(|triangle| step(triangle, place))
        .sum()
}

fn may_be_above([a, b, c]: &[DVec3; 3], point: DVec3) -> bool {
    let (min, max) = (a.min(*b).min(*c), a.max(*b).max(*c));
    min.truncate().cmple(point.truncate()).all() && max.cmpge(point).all()
}

/// 1 where the way up leaves through the triangle, -1 where it enters, 0 where it misses.
fn step(triangle: &[DVec3; 3], place: &impl Place) -> i64 {
    let [a, b, c] = *triangle;
    let turn = place.turn(a, b);
    let is_above = turn != Ordering::Equal
        && place.turn(b, c) == turn
        && place.turn(c, a) == turn
        && place.side(triangle) == turn.reverse();
    match turn {
        Ordering::Greater if is_above => 1,
        Ordering::Less if is_above => -1,
        _ => 0,
    }
}

/// The order of two finite numbers, −0 and 0 equal.
fn order(a: f64, b: f64) -> Ordering {
    a.partial_cmp(&b).unwrap_or(Ordering::Equal)
}
