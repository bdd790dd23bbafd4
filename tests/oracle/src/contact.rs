//! Where a line meets a closed triangle, in rationals.

use std::cmp::Ordering;

use crate::aabb::Point;
use crate::determinant::Row;
use crate::exact::{Rational, Vector, is_zero, sign, vector};
use crate::mesh::Triangle;
use crate::number::{cross, difference, dot};

/// A line `origin + t (heading.head - heading.tail)`, exact, with its direction rounded once.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line {
    pub(crate) origin: Point,
    heading: Row,
    pub(crate) direction: Point,
}

impl Line {
    /// The line from `p` at parameter 0 to `q` at parameter 1.
    pub(crate) fn through(p: Point, q: Point) -> Self {
        let heading = Row::new(q, p);
        Self {
            origin: p,
            heading,
            direction: heading.rounded(),
        }
    }

    /// The line from `origin` in `direction`.
    pub(crate) fn towards(origin: Point, direction: Point) -> Self {
        Self {
            origin,
            heading: Row::new(direction, [0.0; 3]),
            direction,
        }
    }
}

/// How an open segment meets a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Touch {
    /// It passes from one side to the other through the relative interior.
    Crossing,
    /// It meets an edge or a vertex only, runs in the plane, or the triangle has no area.
    Grazing,
}

/// The part of a line that lies in a triangle, by exact parameters.
#[derive(Clone, Debug)]
pub(crate) struct Contact {
    pub(crate) first: Rational,
    pub(crate) last: Rational,
    /// Crossing only if the line passes through the relative interior from side to side.
    pub(crate) touch: Touch,
}

/// The part of the whole line that lies in the closed triangle, exactly; also for a triangle
/// without area. `None` if there is none or the line has no direction.
pub(crate) fn exact_contact(line: &Line, triangle: &Triangle) -> Option<Contact> {
    let origin = vector(line.origin);
    let direction = difference(&vector(line.heading.head), &vector(line.heading.tail));
    if is_zero(&direction) {
        return None;
    }
    let corners = triangle.map(|corner| difference(&vector(corner), &origin));
    let edges = [(0, 1), (1, 2), (2, 0)].map(|(i, j)| difference(&corners[j], &corners[i]));
    let normal = cross(&edges[0], &edges[1]);
    if is_zero(&normal) {
        return contact_with_edges(&direction, &corners, &edges);
    }
    let slope = dot(&normal, &direction);
    if slope.is_zero() {
        return contact_in_plane(&direction, &corners, &edges, &normal);
    }
    let turns = [(0, 1), (1, 2), (2, 0)]
        .map(|(i, j)| sign(&dot(&direction, &cross(&corners[i], &corners[j]))));
    if turns.contains(&Ordering::Less) && turns.contains(&Ordering::Greater) {
        return None;
    }
    let t = dot(&normal, &corners[0]) / slope;
    let touch = if turns.contains(&Ordering::Equal) {
        Touch::Grazing
    } else {
        Touch::Crossing
    };
    Some(Contact {
        first: t.clone(),
        last: t,
        touch,
    })
}

/// The contact with a triangle whose plane the line is parallel to: the line clipped by the inner
/// sides of the three edges.
fn contact_in_plane(
    direction: &Vector,
    corners: &[Vector; 3],
    edges: &[Vector; 3],
    normal: &Vector,
) -> Option<Contact> {
    if !dot(normal, &corners[0]).is_zero() {
        return None;
    }
    let (mut first, mut last): (Option<Rational>, Option<Rational>) = (None, None);
    for (edge, corner) in edges.iter().zip(corners) {
        let inward = cross(normal, edge);
        let (start, gain) = (-dot(&inward, corner), dot(&inward, direction));
        // Inside where start + t gain >= 0.
        match sign(&gain) {
            Ordering::Equal if sign(&start) == Ordering::Less => return None,
            Ordering::Equal => {}
            Ordering::Greater => first = first.max(Some(-start / gain)),
            Ordering::Less => {
                let bound = -start / gain;
                last = Some(last.map_or(bound.clone(), |last| last.min(bound)));
            }
        }
    }
    let (first, last) = (first?, last?);
    (first <= last).then_some(Contact {
        first,
        last,
        touch: Touch::Grazing,
    })
}

/// The contact with a triangle without area, the union of its edges.
fn contact_with_edges(
    direction: &Vector,
    corners: &[Vector; 3],
    edges: &[Vector; 3],
) -> Option<Contact> {
    let parts = corners
        .iter()
        .zip(edges)
        .filter_map(|(from, edge)| contact_with_edge(direction, from, edge));
    let (first, last) = parts.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))?;
    Some(Contact {
        first,
        last,
        touch: Touch::Grazing,
    })
}

/// The parameters at which the line from the zero point is on the closed edge.
fn contact_with_edge(
    direction: &Vector,
    from: &Vector,
    edge: &Vector,
) -> Option<(Rational, Rational)> {
    let across = cross(direction, edge);
    if is_zero(&across) {
        return contact_along_edge(direction, from, edge);
    }
    if !dot(&across, from).is_zero() {
        return None;
    }
    // t direction = from + s edge; the cross products with the edge and the direction leave t, s.
    let scale = dot(&across, &across);
    let s = dot(&cross(from, direction), &across) / &scale;
    let t = dot(&cross(from, edge), &across) / scale;
    (sign(&s) != Ordering::Less && s <= Rational::ONE).then(|| (t.clone(), t))
}

/// The same for an edge parallel to the line, or of no length.
fn contact_along_edge(
    direction: &Vector,
    from: &Vector,
    edge: &Vector,
) -> Option<(Rational, Rational)> {
    if !is_zero(&cross(from, direction)) {
        return None;
    }
    let scale = dot(direction, direction);
    let start = dot(from, direction) / &scale;
    let end = &start + dot(edge, direction) / scale;
    Some(if start <= end {
        (start, end)
    } else {
        (end, start)
    })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::scenes::{cases, points};

    /// Whether the point of the line at `t` lies on the closed triangle, which has an area.
    fn is_on(line: &Line, t: &Rational, triangle: &Triangle) -> bool {
        let direction = difference(&vector(line.heading.head), &vector(line.heading.tail));
        let start = vector(line.origin);
        let point: Vector = std::array::from_fn(|axis| &start[axis] + &direction[axis] * t);
        let corners = triangle.map(vector);
        let edges = [(0, 1), (1, 2), (2, 0)].map(|(i, j)| difference(&corners[j], &corners[i]));
        let normal = cross(&edges[0], &edges[1]);
        dot(&normal, &difference(&point, &corners[0])).is_zero()
            && edges.iter().zip(&corners).all(|(edge, corner)| {
                let way = difference(&point, corner);
                sign(&dot(&normal, &cross(edge, &way))) != Ordering::Less
            })
    }

    proptest! {
        #![proptest_config(cases(6000))]
        #[test]
        fn contact_is_all_that_lies_on_the_triangle([p, q, a, b, c] in points(),
                                                    flat in any::<bool>()) {
            let flatten = |x: Point| if flat { [x[0], x[1], a[2]] } else { x };
            let (p, q, triangle) = (flatten(p), flatten(q), [a, flatten(b), flatten(c)]);
            let edges = [1, 2].map(|i| difference(&vector(triangle[i]), &vector(a)));
            prop_assume!(p != q && !is_zero(&cross(&edges[0], &edges[1])));
            let line = Line::through(p, q);
            if let Some(contact) = exact_contact(&line, &triangle) {
                let hair = Rational::from(1) / Rational::from(1u64 << 60);
                prop_assert!(is_on(&line, &contact.first, &triangle));
                prop_assert!(is_on(&line, &contact.last, &triangle));
                prop_assert!(!is_on(&line, &(&contact.first - &hair), &triangle));
                prop_assert!(!is_on(&line, &(&contact.last + &hair), &triangle));
            } else {
                for step in -8..17 {
                    let t = Rational::from(step) / Rational::from(8);
                    prop_assert!(!is_on(&line, &t, &triangle));
                }
            }
        }
    }
}
