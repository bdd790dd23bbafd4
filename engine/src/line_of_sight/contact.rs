//! [`Contact`], where a sight line meets a triangle.

use std::cmp::Ordering;

use glam::DVec3;

use super::exact::{Rational, Vector, cross, difference, dot, is_zero, side_of, sign, vector};
use super::sight_line::SightLine;

/// The part of a sight line's whole line that lies in a closed triangle.
pub struct Contact<'a> {
    /// The corners of the triangle, which has an area.
    pub triangle: &'a [DVec3; 3],
    /// The share of the way at which it begins.
    pub first: Rational,
    /// The share at which it ends: the same, unless the line runs in the triangle.
    pub last: Rational,
    /// How the line passes from side to side through the triangle's relative interior, if it does.
    pub passage: Option<Passage>,
}

/// Through which side a line comes into a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Passage {
    /// From the side on which it turns anticlockwise: into the solid.
    Inward,
    /// Out of the solid.
    Outward,
}

impl Contact<'_> {
    /// Whether the line runs in the triangle.
    pub fn is_run(&self) -> bool {
        self.first < self.last
    }

    /// Whether the closed contact holds a share.
    pub fn holds(&self, share: &Rational) -> bool {
        self.first <= *share && *share <= self.last
    }
}

/// The contacts of a sight line, its ends included, with triangles. Those without an area are passed
/// over: nothing is inside them, and the edges that they close lie on others.
pub fn contacts<'a>(line: &SightLine, triangles: &'a [[DVec3; 3]]) -> Vec<Contact<'a>> {
    triangles
        .iter()
        .filter_map(|triangle| contact(line, triangle))
        .collect()
}

fn contact<'a>(line: &SightLine, triangle: &'a [DVec3; 3]) -> Option<Contact<'a>> {
    if is_beside(line, triangle) {
        return None;
    }
    let near = side_of(triangle, line.from);
    let far = side_of(triangle, line.to);
    if near == far {
        // On one side, or both in the plane.
        return (near == Ordering::Equal)
            .then(|| run(line, triangle))
            .flatten();
    }
    let [a, b, c] = *triangle;
    let turns = [(a, b), (b, c), (c, a)].map(|(u, v)| side_of(&[line.from, line.to, u], v));
    if turns.contains(&Ordering::Less) && turns.contains(&Ordering::Greater) {
        return None;
    }
    let share = share_at_plane(line, triangle);
    let ends_apart = near != Ordering::Equal && far != Ordering::Equal;
    let passes = ends_apart && !turns.contains(&Ordering::Equal);
    Some(Contact {
        triangle,
        first: share.clone(),
        last: share,
        passage: passes.then_some(if near == Ordering::Greater {
            Passage::Inward
        } else {
            Passage::Outward
        }),
    })
}

/// Whether all of the triangle is beyond one side of the box around the line.
fn is_beside(line: &SightLine, [a, b, c]: &[DVec3; 3]) -> bool {
    let (min, max) = (a.min(*b).min(*c), a.max(*b).max(*c));
    min.cmpgt(line.from.max(line.to)).any() || max.cmplt(line.from.min(line.to)).any()
}

/// The share at which the line, which is not parallel to it, meets the plane of a triangle.
fn share_at_plane(line: &SightLine, triangle: &[DVec3; 3]) -> Rational {
    let [a, b, c] = corners(line, triangle);
    let normal = cross(&difference(&b, &a), &difference(&c, &a));
    dot(&normal, &a) / dot(&normal, &line.way)
}

/// The contact with a triangle in whose plane the line runs: what is left of it on the inner sides of
/// the three edges.
fn run<'a>(line: &SightLine, triangle: &'a [DVec3; 3]) -> Option<Contact<'a>> {
    let corners = corners(line, triangle);
    let edges: [Vector; 3] =
        std::array::from_fn(|i| difference(&corners[(i + 1) % 3], &corners[i]));
    let normal = cross(&edges[0], &edges[1]);
    if is_zero(&normal) {
        return None;
    }
    let (mut first, mut last): (Option<Rational>, Option<Rational>) = (None, None);
    for (edge, corner) in edges.iter().zip(&corners) {
        let inward = cross(&normal, edge);
        // How far inside the line begins, and how that grows along it.
        let (start, gain) = (-dot(&inward, corner), dot(&inward, &line.way));
        match sign(&gain) {
            Ordering::Equal if sign(&start) == Ordering::Less => return None,
            Ordering::Equal => {}
            Ordering::Greater => {
                let bound = -start / gain;
                first = Some(first.map_or(bound.clone(), |first| first.max(bound)));
            }
            Ordering::Less => {
                let bound = -start / gain;
                last = Some(last.map_or(bound.clone(), |last| last.min(bound)));
            }
        }
    }
    let (first, last) = (first?, last?);
    let meets = first <= last && last >= Rational::ZERO && first <= Rational::ONE;
    meets.then_some(Contact {
        triangle,
        first,
        last,
        passage: None,
    })
}

/// The corners as seen from where the line begins.
fn corners(line: &SightLine, triangle: &[DVec3; 3]) -> [Vector; 3] {
    triangle.map(|corner| difference(&vector(corner), &line.origin))
}
