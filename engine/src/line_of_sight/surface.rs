//! Where a sight line passes through a surface that bounds no solid.

use std::cmp::Ordering;

use super::contact::Contact;
use super::exact::{Rational, Vector, determinant_sign};
use super::neighbourhood::{Arc, arcs, places};
use super::sight_line::SightLine;

/// The share of the way at which the line, its ends left out, first passes from one side of the
/// surface to the other: through the relative interior of a triangle, or where triangles that meet at
/// an edge or a corner close around it. Running in a triangle or along an edge does not count.
pub fn crossing(line: &SightLine, contacts: &[Contact]) -> Option<Rational> {
    let mut shares: Vec<&Rational> = contacts
        .iter()
        .map(|contact| &contact.first)
        .filter(|share| **share > Rational::ZERO && **share < Rational::ONE)
        .collect();
    shares.sort_unstable();
    shares.dedup();
    let first = shares
        .into_iter()
        .find(|share| passes(line, contacts, share));
    first.cloned()
}

/// Whether the line passes through the surface at a share of the way.
fn passes(line: &SightLine, contacts: &[Contact], share: &Rational) -> bool {
    let here = || contacts.iter().filter(|contact| contact.holds(share));
    if here().any(|contact| contact.passage.is_some()) {
        return true;
    }
    if here().any(Contact::is_run) {
        return false;
    }
    parts(&arcs(here(), &line.exact_point(share)), &line.way)
}

/// Whether arcs around a point part the way on from the way back, none of which is on an arc.
///
/// They do exactly when a closed chain of arcs goes around the way an odd number of times: when it
/// crosses a half plane that begins at the way so often. That is found as an odd cycle is, by giving
/// each place a side that its neighbours confirm.
fn parts(arcs: &[Arc], way: &Vector) -> bool {
    let places = places(arcs);
    let mut sides = Sides::new(places.len());
    for arc in arcs {
        for pair in arc.on(&places).windows(2) {
            let crosses = crosses_half_plane(&places[pair[0]], &places[pair[1]], way);
            if !sides.join(pair[0], pair[1], crosses) {
                return true;
            }
        }
    }
    false
}

/// Whether the arc between two directions crosses the half plane from the way through an axis. What
/// is in the plane counts as to its left.
fn crosses_half_plane(a: &Vector, b: &Vector, way: &Vector) -> bool {
    // An axis that the way is not parallel to.
    let axis = usize::from(!way[0].is_zero());
    let through: Vector = std::array::from_fn(|i| {
        if i == axis {
            Rational::ONE
        } else {
            Rational::ZERO
        }
    });
    let is_left = |v: &Vector| determinant_sign(way, &through, v) != Ordering::Less;
    let (left, right) = match (is_left(a), is_left(b)) {
        (true, false) => (a, b),
        (false, true) => (b, a),
        _ => return false,
    };
    determinant_sign(way, right, left) == Ordering::Greater
}

/// Places joined to groups, each on one of two sides of its group's first.
struct Sides {
    parent: Vec<usize>,
    /// Whether a place is on the other side than its parent.
    is_other: Vec<bool>,
}

impl Sides {
    fn new(count: usize) -> Self {
        Self {
            parent: (0..count).collect(),
            is_other: vec![false; count],
        }
    }

    /// The first of a place's group, and whether the place is on the other side.
    fn find(&self, mut place: usize) -> (usize, bool) {
        let mut is_other = false;
        while self.parent[place] != place {
            is_other ^= self.is_other[place];
            place = self.parent[place];
        }
        (place, is_other)
    }

    /// Joins two places, on different sides if so said; `false` if they are known to be otherwise.
    fn join(&mut self, a: usize, b: usize, differ: bool) -> bool {
        let ((first, a_other), (second, b_other)) = (self.find(a), self.find(b));
        if first == second {
            return (a_other ^ b_other) == differ;
        }
        self.parent[second] = first;
        self.is_other[second] = a_other ^ b_other ^ differ;
        true
    }
}
