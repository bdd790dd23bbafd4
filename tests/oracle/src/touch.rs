//! How segments and rays meet a triangle: a certified filter for the plain cases, rationals else.

use std::cmp::Ordering;

use crate::aabb::Point;
use crate::contact::{Line, Touch, exact_contact};
use crate::determinant::{Estimate, estimate, subtract};
use crate::exact::{Rational, sign};
use crate::interval::Interval;
use crate::mesh::Triangle;
use crate::number::Number;

/// How the open segment from `p` to `q` meets the closed triangle.
#[inline]
pub(crate) fn segment_touch(line: &Line, q: Point, triangle: &Triangle) -> Option<Touch> {
    match passage(line, triangle) {
        Passage::Misses => None,
        Passage::Pierces(pierced) => {
            let [u, v, w] = triangle.map(|corner| subtract(corner, q));
            match (pierced.side.sign(), estimate(u, v, w).sign()) {
                (Some(near), Some(far)) if near == far => None,
                (Some(_), Some(_)) => Some(Touch::Crossing),
                _ => exact_segment_touch(line, triangle),
            }
        }
        Passage::Unsure => exact_segment_touch(line, triangle),
    }
}

/// Where the ray from the origin, without the origin itself, first meets the closed triangle: an
/// interval that holds the parameter.
pub(crate) fn ray_parameter(line: &Line, triangle: &Triangle) -> Option<Interval> {
    match passage(line, triangle) {
        Passage::Misses => return None,
        Passage::Pierces(pierced) => {
            let t = pierced.parameter();
            if t.hi < 0.0 {
                return None;
            }
            if t.lo > 0.0 {
                return Some(t);
            }
        }
        Passage::Unsure => {}
    }
    let exact = exact_ray_parameter(line, triangle)?;
    let nearest = exact.to_f64().value();
    Some(Interval::outward(nearest, nearest))
}

/// The same, exactly. A ray that starts on the triangle and runs in its plane meets it at 0.
pub(crate) fn exact_ray_parameter(line: &Line, triangle: &Triangle) -> Option<Rational> {
    let contact = exact_contact(line, triangle)?;
    (sign(&contact.last) == Ordering::Greater).then(|| contact.first.max(Rational::ZERO))
}

/// The segment test in rationals.
fn exact_segment_touch(line: &Line, triangle: &Triangle) -> Option<Touch> {
    let contact = exact_contact(line, triangle)?;
    let meets = sign(&contact.last) == Ordering::Greater && contact.first < Rational::ONE;
    meets.then_some(contact.touch)
}

/// What the filter knows about a line and a triangle.
enum Passage {
    Misses,
    Pierces(Pierced),
    Unsure,
}

/// The determinants of a line that surely passes through the relative interior.
struct Pierced {
    /// The side of the plane that the origin is on.
    side: Estimate,
    /// The turns of the line around the three edges, of one sign.
    turns: [Estimate; 3],
}

impl Pierced {
    /// The parameter of the piercing point, `A · (B x C)` over the sum of the turns, which is
    /// direction · normal.
    fn parameter(&self) -> Interval {
        let [a, b, c] = self.turns.each_ref().map(Estimate::interval);
        self.side.interval().over(&a.plus(&b).plus(&c))
    }
}

/// The signs of the turns of the line around the three edges, in floating point.
#[inline]
fn passage(line: &Line, triangle: &Triangle) -> Passage {
    let [a, b, c] = triangle.map(|corner| subtract(corner, line.origin));
    let turns = [
        estimate(line.direction, a, b),
        estimate(line.direction, b, c),
        estimate(line.direction, c, a),
    ];
    let signs = turns.each_ref().map(Estimate::sign);
    let (mut left, mut right, mut unsure) = (false, false, false);
    for sign in signs {
        left |= sign == Some(Ordering::Greater);
        right |= sign == Some(Ordering::Less);
        unsure |= sign.is_none();
    }
    if left && right {
        Passage::Misses
    } else if unsure {
        Passage::Unsure
    } else {
        Passage::Pierces(Pierced {
            side: estimate(a, b, c),
            turns,
        })
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::determinant::{Row, determinant_sign, orientation};
    use crate::scenes::{cases, points};

    /// The segment test by orientations alone, for a triangle whose plane does not hold `p` and `q`.
    fn touch_by_orientations(p: Point, q: Point, [a, b, c]: Triangle) -> Option<Touch> {
        let sides = [orientation(a, b, c, p), orientation(a, b, c, q)];
        if sides[0] == sides[1] || sides.contains(&Ordering::Equal) {
            return None;
        }
        let turns = [(a, b), (b, c), (c, a)]
            .map(|(u, v)| determinant_sign([Row::new(q, p), Row::new(u, p), Row::new(v, p)]));
        if turns.contains(&Ordering::Less) && turns.contains(&Ordering::Greater) {
            None
        } else if turns.contains(&Ordering::Equal) {
            Some(Touch::Grazing)
        } else {
            Some(Touch::Crossing)
        }
    }

    proptest! {
        #![proptest_config(cases(6000))]
        #[test]
        fn filter_never_disagrees([p, q, a, b, c] in points()) {
            let (line, triangle) = (Line::through(p, q), [a, b, c]);
            prop_assert_eq!(
                segment_touch(&line, q, &triangle),
                exact_segment_touch(&line, &triangle)
            );
            let exact = exact_ray_parameter(&line, &triangle);
            let filtered = ray_parameter(&line, &triangle);
            prop_assert_eq!(filtered.is_some(), exact.is_some());
            if let (Some(t), Some(exact)) = (filtered, exact) {
                prop_assert!(Rational::try_from(t.lo).is_ok_and(|lo| lo <= exact));
                prop_assert!(Rational::try_from(t.hi).is_ok_and(|hi| exact <= hi));
            }
        }

        #[test]
        fn agrees_with_orientations([p, q, a, b, c] in points()) {
            let in_plane = [p, q].iter().all(|&x| orientation(a, b, c, x) == Ordering::Equal);
            prop_assume!(p != q && !in_plane);
            prop_assert_eq!(
                segment_touch(&Line::through(p, q), q, &[a, b, c]),
                touch_by_orientations(p, q, [a, b, c])
            );
        }
    }

    const TRIANGLE: Triangle = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];

    fn touch(p: Point, q: Point, triangle: Triangle) -> Option<Touch> {
        segment_touch(&Line::through(p, q), q, &triangle)
    }

    #[test]
    fn degenerate_segments_and_triangles() {
        let graze = Some(Touch::Grazing);
        let cases = [
            (
                "through the middle",
                [1.0, 1.0, -1.0],
                [1.0, 1.0, 1.0],
                Some(Touch::Crossing),
            ),
            ("through an edge", [2.0, 2.0, -1.0], [2.0, 2.0, 1.0], graze),
            ("through a vertex", [4.0, 0.0, -1.0], [4.0, 0.0, 1.0], graze),
            (
                "past an edge",
                [2.0, 2.0f64.next_up(), -1.0],
                [2.0, 2.0f64.next_up(), 1.0],
                None,
            ),
            ("ends on the face", [1.0, 1.0, 1.0], [1.0, 1.0, 0.0], None),
            ("starts on an edge", [2.0, 0.0, 0.0], [2.0, -1.0, 1.0], None),
            (
                "in the plane, across",
                [-1.0, 1.0, 0.0],
                [9.0, 1.0, 0.0],
                graze,
            ),
            (
                "in the plane, inside",
                [1.0, 1.0, 0.0],
                [1.5, 1.0, 0.0],
                graze,
            ),
            (
                "in the plane, along an edge",
                [-1.0, 0.0, 0.0],
                [9.0, 0.0, 0.0],
                graze,
            ),
            (
                "in the plane, up to a vertex",
                [9.0, 0.0, 0.0],
                [4.0, 0.0, 0.0],
                None,
            ),
            (
                "in the plane, at a vertex",
                [4.0, -1.0, 0.0],
                [4.0, 1.0, 0.0],
                graze,
            ),
            (
                "in the plane, beside",
                [5.0, -1.0, 0.0],
                [5.0, 1.0, 0.0],
                None,
            ),
            (
                "parallel above",
                [-1.0, 1.0, 1e-300],
                [9.0, 1.0, 1e-300],
                None,
            ),
        ];
        for (what, p, q, expected) in cases {
            assert_eq!(touch(p, q, TRIANGLE), expected, "{what}");
            assert_eq!(touch(q, p, TRIANGLE), expected, "{what}, backwards");
        }
        let needle = [[0.0; 3], [4.0, 0.0, 0.0], [1.0, 0.0, 0.0]];
        assert_eq!(touch([3.0, 0.0, -1.0], [3.0, 0.0, 1.0], needle), graze);
        assert_eq!(touch([5.0, 0.0, -1.0], [5.0, 0.0, 1.0], needle), None);
        assert_eq!(touch([9.0, 0.0, 0.0], [3.5, 0.0, 0.0], needle), graze);
        assert_eq!(touch([9.0, 0.0, 0.0], [4.0, 0.0, 0.0], needle), None);
        let dot = [[1.0, 0.0, 0.0]; 3];
        assert_eq!(touch([0.0; 3], [2.0, 0.0, 0.0], dot), graze);
        assert_eq!(touch([0.0; 3], [1.0, 0.0, 0.0], dot), None);
    }
}
