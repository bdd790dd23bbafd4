//! What triangles look like from a point on them: arcs of directions.

use std::cmp::Ordering;

use super::contact::Contact;
use super::exact::{Vector, cross, determinant_sign, difference, dot, is_zero, sign, vector};

/// The directions between two, less than half a turn apart, in which a triangle is seen.
pub struct Arc {
    from: Vector,
    to: Vector,
    /// The side of its plane from which it turns anticlockwise.
    pub normal: Vector,
}

impl Arc {
    fn new(from: &Vector, to: &Vector) -> Self {
        Self {
            normal: cross(from, to),
            from: from.clone(),
            to: to.clone(),
        }
    }

    /// Whether a direction is on it, its ends included.
    fn holds(&self, direction: &Vector) -> bool {
        dot(&self.normal, direction).is_zero()
            && self.order(&self.from, direction) != Ordering::Greater
            && self.order(direction, &self.to) != Ordering::Greater
    }

    /// The order of two directions on it.
    fn order(&self, first: &Vector, second: &Vector) -> Ordering {
        determinant_sign(&self.normal, first, second).reverse()
    }

    /// The positions, in order, of those of some directions that are on it.
    pub fn on(&self, directions: &[Vector]) -> Vec<usize> {
        let mut on: Vec<usize> = (0..directions.len())
            .filter(|&number| self.holds(&directions[number]))
            .collect();
        on.sort_by(|&a, &b| self.order(&directions[a], &directions[b]));
        on
    }
}

/// The arcs of the triangles of contacts around a point that is on all of them.
pub fn arcs<'a>(contacts: impl IntoIterator<Item = &'a Contact<'a>>, point: &Vector) -> Vec<Arc> {
    contacts
        .into_iter()
        .flat_map(|contact| {
            let corners = contact
                .triangle
                .map(|corner| difference(&vector(corner), point));
            arcs_of(&corners)
        })
        .collect()
}

/// The arcs of a triangle around the zero point: one from a corner, two from within an edge, three
/// from within the triangle.
fn arcs_of(corners: &[Vector; 3]) -> Vec<Arc> {
    let edges = [(0, 1), (1, 2), (2, 0)].map(|(i, j)| (&corners[i], &corners[j]));
    edges
        .into_iter()
        .filter(|(from, to)| !is_zero(&cross(from, to)))
        .map(|(from, to)| Arc::new(from, to))
        .collect()
}

/// The directions, each once, in which arcs end or cross: between neighbours of them, arcs are apart
/// or the same.
pub fn places(arcs: &[Arc]) -> Vec<Vector> {
    let ends = arcs
        .iter()
        .flat_map(|arc| [arc.from.clone(), arc.to.clone()]);
    let crossings = arcs.iter().enumerate().flat_map(|(number, one)| {
        arcs[..number].iter().flat_map(move |other| {
            let along = cross(&one.normal, &other.normal);
            let against = along.each_ref().map(|component| -component);
            [along, against].into_iter().filter(move |direction| {
                !is_zero(direction) && one.holds(direction) && other.holds(direction)
            })
        })
    });
    let mut places: Vec<Vector> = Vec::new();
    for direction in ends.chain(crossings) {
        let is_same = |place: &Vector| {
            is_zero(&cross(place, &direction)) && sign(&dot(place, &direction)) == Ordering::Greater
        };
        if !places.iter().any(is_same) {
            places.push(direction);
        }
    }
    places
}
