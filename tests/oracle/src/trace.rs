//! All that a segment does to a mesh, by brute force in rationals.

use std::cmp::Ordering;

use crate::aabb::Point;
use crate::contact::{Contact, Line, Touch, exact_contact};
use crate::exact::{Rational, Vector, is_zero, vector};
use crate::mesh::{Mesh, Triangle};
use crate::number::{cross, difference, middle};
use crate::ray_caster::is_usable;
use crate::test_point::ExactPoint;
use crate::winding::winding_number;

/// A place of a segment at which it begins or ends to touch a triangle with an area, or one of its
/// own ends.
#[derive(Clone, Debug, PartialEq)]
pub struct TraceCut {
    /// How much of the way is behind it, rounded once.
    pub share: f64,
    /// The place itself, each coordinate rounded once.
    pub point: Point,
    /// The triangles that hold it, by their positions in the mesh.
    pub touched: Vec<usize>,
    /// Those that the segment passes through there, inside their borders.
    pub crossed: Vec<usize>,
    /// Those that the segment runs in, before it or after it.
    pub along: Vec<usize>,
}

/// A segment cut at everything that it meets of a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Trace {
    /// In order, the ends of the segment included.
    pub cuts: Vec<TraceCut>,
    /// How often the surface winds around the pieces between, `None` on the surface.
    pub windings: Vec<Option<i32>>,
}

impl Mesh {
    /// Everything that the segment from `p` to `q` meets. `None` if the mesh or the ends are not
    /// usable, or the ends are equal.
    ///
    /// Exact. Triangles without area are passed over. Winding numbers mean something only if the
    /// mesh is closed.
    #[must_use]
    pub fn trace(&self, p: Point, q: Point) -> Option<Trace> {
        let triangles = self.corners()?;
        if !is_usable(p) || !is_usable(q) || p == q {
            return None;
        }
        let line = Line::through(p, q);
        let contacts: Vec<(usize, Contact)> = triangles
            .iter()
            .enumerate()
            .filter(|(_, triangle)| has_area(triangle))
            .filter_map(|(number, triangle)| Some((number, exact_contact(&line, triangle)?)))
            .collect();
        let mut shares: Vec<Rational> = contacts
            .iter()
            .flat_map(|(_, contact)| [contact.first.clone(), contact.last.clone()])
            .filter(|share| *share > Rational::ZERO && *share < Rational::ONE)
            .collect();
        shares.extend([Rational::ZERO, Rational::ONE]);
        shares.sort();
        shares.dedup();
        let (from, way) = (vector(p), difference(&vector(q), &vector(p)));
        let at = |share: &Rational| -> Vector {
            std::array::from_fn(|axis| &from[axis] + share * &way[axis])
        };
        let windings = shares.windows(2).map(|pair| {
            let point = ExactPoint::new(at(&middle(&pair[0], &pair[1])));
            winding_number(triangles.iter().filter(|t| has_area(t)), &point)
        });
        Some(Trace {
            windings: windings.collect(),
            cuts: shares
                .iter()
                .map(|share| cut(share, at(share), &contacts))
                .collect(),
        })
    }
}

fn cut(share: &Rational, point: Vector, contacts: &[(usize, Contact)]) -> TraceCut {
    let here: Vec<&(usize, Contact)> = contacts
        .iter()
        .filter(|(_, contact)| contact.first <= *share && *share <= contact.last)
        .collect();
    let which = |wanted: &dyn Fn(&Contact) -> bool| -> Vec<usize> {
        let chosen = here.iter().filter(|(_, contact)| wanted(contact));
        chosen.map(|(number, _)| *number).collect()
    };
    let is_end = *share == Rational::ZERO || *share == Rational::ONE;
    TraceCut {
        share: share.to_f64().value(),
        point: point.each_ref().map(|x| x.to_f64().value()),
        touched: which(&|_| true),
        crossed: which(&|contact| contact.touch == Touch::Crossing && !is_end),
        along: which(&|contact| contact.first.cmp(&contact.last) == Ordering::Less),
    }
}

fn has_area(triangle: &Triangle) -> bool {
    let [a, b, c] = triangle.map(vector);
    let normal = cross(&difference(&b, &a), &difference(&c, &a));
    !is_zero(&normal)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A tetrahedron with one corner at the origin.
    fn tetrahedron() -> Mesh {
        let [o, x, y, z] = [[0.0; 3], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 4.0]];
        Mesh::from_triangles(&[[o, y, x], [o, x, z], [o, z, y], [x, y, z], [o, x, x]])
    }

    #[test]
    fn a_segment_through_a_tetrahedron() {
        let trace = tetrahedron()
            .trace([1.0, 1.0, -1.0], [1.0, 1.0, 7.0])
            .unwrap();
        assert_eq!(trace.windings, [Some(0), Some(1), Some(0)]);
        let shares: Vec<f64> = trace.cuts.iter().map(|cut| cut.share).collect();
        assert_eq!(shares, [0.0, 0.125, 0.375, 1.0]);
        assert_eq!(trace.cuts[1].crossed, [0]);
        assert_eq!(trace.cuts[2].point, [1.0, 1.0, 2.0]);
        assert!(trace.cuts[0].touched.is_empty() && trace.cuts[1].along.is_empty());
    }

    #[test]
    fn a_segment_in_a_face_of_it() {
        let trace = tetrahedron()
            .trace([-1.0, 1.0, 0.0], [1.0, 1.0, 0.0])
            .unwrap();
        assert_eq!(trace.windings, [Some(0), None]);
        assert_eq!(trace.cuts[1].touched, [0, 2]);
        assert_eq!(trace.cuts[2].along, [0]);
        assert!(trace.cuts.iter().all(|cut| cut.crossed.is_empty()));
        assert_eq!(tetrahedron().trace([1.0; 3], [1.0; 3]), None);
    }
}
