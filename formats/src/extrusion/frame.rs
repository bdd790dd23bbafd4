//! [`Frame`], the directions that a roof follows.

use geo::{LineString, MinimumRotatedRect, Polygon};

use super::footprint::line_string;
use super::{Footprint, Plan};

/// The smallest rectangle around a footprint.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    /// Where distances are measured from: the first vertex, so that they keep their digits.
    pub(super) origin: Plan,
    /// Unit vector along the longer side.
    pub(super) along: Plan,
    /// Lengths of the longer and the shorter side.
    pub(super) sides: [f64; 2],
}

impl Frame {
    /// The frame of a footprint; none for one that is too thin to have sides.
    pub(super) fn of(footprint: &Footprint) -> Option<Self> {
        let outer = footprint.rings().first()?;
        let origin = *outer.first()?;
        let local: Vec<Plan> = outer.iter().map(|p| minus(*p, origin)).collect();
        let ring: LineString = line_string(&local);
        let rectangle = Polygon::new(ring, vec![]).minimum_rotated_rect()?;
        let corners: Vec<Plan> = rectangle.exterior().coords().map(|c| [c.x, c.y]).collect();
        let &[a, b, c, ..] = corners.as_slice() else {
            return None;
        };
        let (mut long, mut short) = (minus(b, a), minus(c, b));
        if length(long) < length(short) {
            std::mem::swap(&mut long, &mut short);
        }
        let sides = [length(long), length(short)];
        (sides[1] > 0.0 && sides[0].is_finite()).then(|| Self {
            origin,
            along: [long[0] / sides[0], long[1] / sides[0]],
            sides,
        })
    }
}

/// A quarter turn anticlockwise.
pub(super) fn left([x, y]: Plan) -> Plan {
    [-y, x]
}

/// The difference of two positions.
pub(super) fn minus(a: Plan, b: Plan) -> Plan {
    [a[0] - b[0], a[1] - b[1]]
}

/// The scalar product.
pub(super) fn dot(a: Plan, b: Plan) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// The length of a vector.
pub(super) fn length(a: Plan) -> f64 {
    a[0].hypot(a[1])
}
