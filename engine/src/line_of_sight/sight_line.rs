//! [`SightLine`], the open segment between an eye and a target.

use std::cmp::Ordering;

use glam::{DVec2, DVec3};

use super::contact::contacts;
use super::exact::{Rational, Vector, difference, dot, rational, rounded, turn_of, vector};
use super::{solid, surface};
use crate::{Box3d, Closedness, TriangleMesh};

/// How much of the way along a sight line, exactly: 0 at the eye, 1 at the target.
#[derive(Clone, Debug)]
pub struct Share(Rational);

impl Share {
    /// The share that a finite number is.
    #[must_use]
    pub fn of(share: f64) -> Self {
        Self(rational(share))
    }
}

impl PartialEq for Share {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Share {}

impl PartialOrd for Share {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Share {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.cmp(&other.0)
    }
}

/// The open segment from an eye to a target, metres.
///
/// A solid hides the target where the segment meets its interior: touching it, grazing it, running
/// along a face or an edge, and passing between solids that touch do not. All of that is decided
/// exactly on the coordinates as they are.
#[derive(Clone, Debug)]
pub struct SightLine {
    pub(super) from: DVec3,
    pub(super) to: DVec3,
    pub(super) origin: Vector,
    pub(super) way: Vector,
}

impl SightLine {
    /// The segment between two points; `None` if they are one, or not finite.
    #[must_use]
    pub fn new(from: DVec3, to: DVec3) -> Option<Self> {
        if !(from.is_finite() && to.is_finite()) || from == to {
            return None;
        }
        let origin = vector(from);
        Some(Self {
            from,
            to,
            way: difference(&vector(to), &origin),
            origin,
        })
    }

    /// Where the line first enters the interior of the solid that a closed mesh bounds: what the
    /// surface winds around once or more, walls within it included. A solid that has the eye in its
    /// interior does not count before the line has been outside of it.
    ///
    /// A mesh that is not closed, whatever it is said to be, is a surface: see
    /// [`passes_through`](Self::passes_through).
    #[must_use]
    pub fn enters(&self, mesh: &TriangleMesh) -> Option<Share> {
        let triangles = usable(mesh)?;
        let contacts = contacts(self, &triangles);
        if contacts.is_empty() {
            // All of the way is inside, or none of it.
            return None;
        }
        // Vertices of equal coordinates need not be shared.
        let welded = TriangleMesh::from_triangles(triangles.iter().copied());
        let share = match welded.closedness() {
            Closedness::Closed => solid::entry(self, &triangles, &contacts),
            Closedness::Open { .. } => surface::crossing(self, &contacts),
        };
        share.map(Share)
    }

    /// Where the line first passes through a surface that bounds no solid, from one side to the
    /// other: through a triangle, or where triangles that share an edge or a corner close around it.
    #[must_use]
    pub fn passes_through(&self, mesh: &TriangleMesh) -> Option<Share> {
        let triangles = usable(mesh)?;
        surface::crossing(self, &contacts(self, &triangles)).map(Share)
    }

    /// How far a share of the way is from the eye, metres.
    #[must_use]
    pub fn distance(&self, share: &Share) -> f64 {
        let length_2 = dot(&self.way, &self.way);
        let square = rounded(&(&share.0 * &share.0 * &length_2));
        if square.is_normal() {
            return square.sqrt();
        }
        // The square of a distance may be out of range where the distance is not.
        let largest = self.way.iter().map(magnitude).max().unwrap_or_default();
        let ratio_2 = rounded(&(length_2 / (&largest * &largest)));
        rounded(&(&share.0 * largest)) * ratio_2.sqrt()
    }

    /// The point at a share of the way, each coordinate rounded once.
    #[must_use]
    pub fn point(&self, share: &Share) -> DVec3 {
        DVec3::from_array(self.exact_point(&share.0).each_ref().map(rounded))
    }

    /// A box that holds what is between two shares of the way.
    #[must_use]
    pub fn piece(&self, first: f64, last: f64) -> Box3d {
        let [from, to] = [first, last].map(|share| self.point(&Share::of(share)));
        // Each coordinate was rounded once, to the nearest.
        Box3d {
            min: from.min(to).map(f64::next_down),
            max: from.max(to).map(f64::next_up),
        }
    }

    /// Whether the closed segment shares a point with a box.
    #[must_use]
    pub fn meets(&self, target: &Box3d) -> bool {
        let around = Box3d::new(self.from, self.to);
        around.overlaps(target)
            && [(0, 1), (1, 2), (2, 0)]
                .into_iter()
                .all(|(i, j)| !self.leaves_aside(target, i, j))
    }

    /// Whether, seen along an axis, all of a box is to one side of the line.
    fn leaves_aside(&self, target: &Box3d, i: usize, j: usize) -> bool {
        let seen = |point: DVec3| DVec2::new(point[i], point[j]);
        let (from, to) = (seen(self.from), seen(self.to));
        let (min, max) = (seen(target.min), seen(target.max));
        let corners = [min, DVec2::new(max.x, min.y), max, DVec2::new(min.x, max.y)];
        let turns = corners.map(|corner| turn_of(from, to, corner));
        turns[0] != Ordering::Equal && turns.iter().all(|turn| *turn == turns[0])
    }

    pub(super) fn exact_point(&self, share: &Rational) -> Vector {
        std::array::from_fn(|axis| &self.origin[axis] + share * &self.way[axis])
    }
}

fn magnitude(value: &Rational) -> Rational {
    if *value < Rational::ZERO {
        -value
    } else {
        value.clone()
    }
}

/// The triangles of a mesh; `None` if one names a vertex that is not there or is not finite: what the
/// mesh bounds is not known then.
fn usable(mesh: &TriangleMesh) -> Option<Vec<[DVec3; 3]>> {
    let triangles: Vec<[DVec3; 3]> = mesh.corners().collect();
    let is_known = triangles.len() == mesh.triangles.len()
        && triangles.as_flattened().iter().all(|v| v.is_finite());
    is_known.then_some(triangles)
}
