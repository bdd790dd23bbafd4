//! Polygons with holes, in plan.

use std::cmp::Ordering;

use thiserror::Error;

use crate::exact::{Rational, rational, sign};
use crate::interval::Interval;
use crate::number::{Number, middle};
use crate::plane::{
    Edge, Outline, Place, PlanPoint, Spot, any_piece, place, plan_turn, ring_edges, spot,
};
use crate::ray_caster::MAX_COORDINATE;

/// Most corners that a footprint may have: edges are checked against each other, so the time grows
/// with the square. Hardly a building comes near.
pub const MAX_CORNERS: usize = 4096;

/// Why rings of corners, or heights, bound no solid.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum ShapeFault {
    /// The top is not above the bottom, or one of them is not usable.
    #[error("the top {top} is not above the bottom {bottom}")]
    NoHeight {
        /// The bottom as given.
        bottom: f64,
        /// The top as given.
        top: f64,
    },
    /// There is no ring, or one with fewer than three corners.
    #[error("ring {ring} of the footprint has {corners} corners")]
    TooFewCorners {
        /// The position of the ring.
        ring: usize,
        /// How many corners it has.
        corners: usize,
    },
    /// The rings together have too many corners.
    #[error("the footprint has {corners} corners, more than {MAX_CORNERS}")]
    TooManyCorners {
        /// How many corners there are.
        corners: usize,
    },
    /// A coordinate is not finite or beyond [`MAX_COORDINATE`].
    #[error("ring {ring} of the footprint has a corner that is not usable: {corner:?}")]
    BadCorner {
        /// The position of the ring.
        ring: usize,
        /// The corner as given.
        corner: PlanPoint,
    },
    /// A ring crosses or touches itself, or repeats a corner.
    #[error("ring {ring} of the footprint meets itself at the edge {edge:?}")]
    NotSimple {
        /// The position of the ring.
        ring: usize,
        /// One of the edges that meet.
        edge: [PlanPoint; 2],
    },
    /// The outer ring turns clockwise, or a hole anticlockwise.
    #[error("ring {ring} of the footprint turns the wrong way")]
    WrongTurn {
        /// The position of the ring.
        ring: usize,
    },
    /// A hole leaves the outer ring or runs along it.
    #[error("ring {ring} of the footprint leaves the outer ring at the edge {edge:?}")]
    HoleOutside {
        /// The position of the ring.
        ring: usize,
        /// An edge that is not all inside.
        edge: [PlanPoint; 2],
    },
    /// A hole reaches into another or runs along it.
    #[error("rings {ring} and {other} of the footprint overlap at the edge {edge:?}")]
    HolesOverlap {
        /// The position of the ring that the edge is of.
        ring: usize,
        /// The position of the other.
        other: usize,
        /// An edge that is not all outside.
        edge: [PlanPoint; 2],
    },
    /// What should be convex and turn anticlockwise does not, or has no area.
    #[error("the footprint is not convex at the edge {edge:?}, turns clockwise or has no area")]
    NotConvex {
        /// An edge with corners on its right, or none on its left.
        edge: [PlanPoint; 2],
    },
}

/// A valid polygon: rings that are simple, the outer one anticlockwise, holes clockwise, inside the
/// outer ring and outside each other. Different rings may touch in points.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Footprint {
    /// One after the other, the outer one first.
    pub(crate) rings: Vec<Vec<Edge>>,
    /// All of them.
    pub(crate) edges: Vec<Edge>,
    pub(crate) min: PlanPoint,
    pub(crate) max: PlanPoint,
}

impl Footprint {
    /// The polygon that `rings` bound; no ring repeats its first corner as its last.
    pub(crate) fn new(rings: &[Vec<PlanPoint>]) -> Result<Self, ShapeFault> {
        check_corners(rings)?;
        let edges: Vec<Vec<Edge>> = rings
            .iter()
            .map(|ring| ring_edges(ring).collect())
            .collect();
        for (ring, (corners, edges)) in rings.iter().zip(&edges).enumerate() {
            check_simple(ring, edges)?;
            let wanted = if ring == 0 {
                Ordering::Greater
            } else {
                Ordering::Less
            };
            if turn_of_ring(corners) != wanted {
                return Err(ShapeFault::WrongTurn { ring });
            }
        }
        check_holes(&edges)?;
        let corners = rings.concat();
        let bound = |axis: usize, pick: fn(f64, f64) -> f64| {
            corners
                .iter()
                .map(|corner| corner[axis])
                .fold(corners[0][axis], pick)
        };
        Ok(Self {
            edges: edges.concat(),
            rings: edges,
            min: [bound(0, f64::min), bound(1, f64::min)],
            max: [bound(0, f64::max), bound(1, f64::max)],
        })
    }

    /// Where a point lies. Exact.
    pub(crate) fn place(&self, point: PlanPoint) -> Place {
        place::<Interval>(&self.edges, &spot(point))
            .or_else(|| place::<Rational>(&self.edges, &spot(point)))
            // Rationals always decide.
            .unwrap_or(Place::Boundary)
    }

    /// At least one point inside each connected piece of the interior.
    ///
    /// The corners cut the interior into trapezoids between neighbouring ordinates. Both sides of
    /// the lowest trapezoid of a piece have a corner at its lower end, their own or one that
    /// touches: past any other point of an edge the piece would reach further down.
    pub(crate) fn witnesses(&self) -> Vec<Spot<Rational>> {
        let mut levels: Vec<f64> = self.edges.iter().map(|edge| edge[0][1]).collect();
        levels.sort_by(f64::total_cmp);
        levels.dedup();
        let slabs = levels.windows(2);
        slabs
            .flat_map(|slab| self.slab_witnesses(slab[0], slab[1]))
            .collect()
    }

    fn slab_witnesses(&self, low: f64, high: f64) -> Vec<Spot<Rational>> {
        let corners = self.edges.iter().map(|edge| edge[0]);
        let at_low: Vec<PlanPoint> = corners.filter(|corner| corner[1] == low).collect();
        let through = self
            .edges
            .iter()
            .filter(|[u, v]| u[1].min(v[1]) <= low && u[1].max(v[1]) >= high);
        let has_corner = |[u, v]: &Edge| {
            let is_on = |&corner| plan_turn(*u, *v, corner) == Ordering::Equal;
            at_low.iter().any(is_on)
        };
        let sides: Vec<(&Edge, bool)> = through.map(|edge| (edge, has_corner(edge))).collect();
        if sides.iter().filter(|(_, has_corner)| *has_corner).count() < 2 {
            return Vec::new();
        }
        let level = middle(&rational(low), &rational(high));
        let mut crossings: Vec<(Rational, bool)> = sides
            .iter()
            .map(|(edge, has_corner)| (abscissa(edge, &level), *has_corner))
            .collect();
        crossings.sort();
        let trapezoids = crossings.chunks_exact(2);
        trapezoids
            .filter(|sides| sides[0].1 && sides[1].1)
            .map(|sides| [middle(&sides[0].0, &sides[1].0), level.clone()])
            .collect()
    }
}

/// Where the line of an edge that is not level in plan has the ordinate `level`.
fn abscissa([u, v]: &Edge, level: &Rational) -> Rational {
    let [u, v] = [u, v].map(|end| end.map(rational));
    let share = (level - &u[1]) / (&v[1] - &u[1]);
    &u[0] + (&v[0] - &u[0]) * share
}

/// Checks the numbers of corners and each coordinate.
pub(crate) fn check_corners(rings: &[Vec<PlanPoint>]) -> Result<(), ShapeFault> {
    let corners = rings.iter().map(Vec::len).sum();
    if corners > MAX_CORNERS {
        return Err(ShapeFault::TooManyCorners { corners });
    }
    if rings.is_empty() {
        return Err(ShapeFault::TooFewCorners {
            ring: 0,
            corners: 0,
        });
    }
    for (ring, corners) in rings.iter().enumerate() {
        if corners.len() < 3 {
            return Err(ShapeFault::TooFewCorners {
                ring,
                corners: corners.len(),
            });
        }
        let is_bad = |corner: &&PlanPoint| corner.iter().any(|x| !is_usable(*x));
        if let Some(&corner) = corners.iter().find(is_bad) {
            return Err(ShapeFault::BadCorner { ring, corner });
        }
    }
    Ok(())
}

/// Checks that there is a height between `bottom` and `top`.
pub(crate) fn check_heights(bottom: f64, top: f64) -> Result<(), ShapeFault> {
    if is_usable(bottom) && is_usable(top) && bottom < top {
        Ok(())
    } else {
        Err(ShapeFault::NoHeight { bottom, top })
    }
}

fn is_usable(coordinate: f64) -> bool {
    coordinate.abs() <= MAX_COORDINATE
}

/// Checks every edge of a ring against all that follow.
fn check_simple(ring: usize, edges: &[Edge]) -> Result<(), ShapeFault> {
    let last = edges.len() - 1;
    for (i, edge) in edges.iter().enumerate() {
        let meets_later = edges.iter().enumerate().skip(i + 1).any(|(j, other)| {
            if j == i + 1 {
                folds(edge, other)
            } else if i == 0 && j == last {
                folds(other, edge)
            } else {
                meet(edge, other)
            }
        });
        if edge[0] == edge[1] || meets_later {
            return Err(ShapeFault::NotSimple { ring, edge: *edge });
        }
    }
    Ok(())
}

/// Whether an edge runs back along the one before it.
fn folds([a, b]: &Edge, [_, c]: &Edge) -> bool {
    let goes_back = |axis: usize| {
        (a[axis] < b[axis] && c[axis] < b[axis]) || (a[axis] > b[axis] && c[axis] > b[axis])
    };
    plan_turn(*a, *b, *c) == Ordering::Equal && (goes_back(0) || goes_back(1))
}

/// Whether two closed segments have a point in common.
fn meet(&[a, b]: &Edge, &[c, d]: &Edge) -> bool {
    let apart = (0..2).any(|i| a[i].max(b[i]) < c[i].min(d[i]) || c[i].max(d[i]) < a[i].min(b[i]));
    let beside = |[u, v]: Edge, [p, q]: Edge| {
        let side = plan_turn(u, v, p);
        side != Ordering::Equal && plan_turn(u, v, q) == side
    };
    // Segments on one line that are not apart on either axis do meet.
    !apart && !beside([a, b], [c, d]) && !beside([c, d], [a, b])
}

/// Greater if a simple ring turns anticlockwise.
fn turn_of_ring(corners: &[PlanPoint]) -> Ordering {
    let area = ring_edges(corners).fold(Rational::ZERO, |sum, [u, v]| {
        sum + rational(u[0]) * rational(v[1]) - rational(u[1]) * rational(v[0])
    });
    sign(&area)
}

/// Checks that holes lie inside the outer ring and outside each other.
fn check_holes(rings: &[Vec<Edge>]) -> Result<(), ShapeFault> {
    for (ring, edges) in rings.iter().enumerate().skip(1) {
        for (other, fence) in rings.iter().enumerate().filter(|(other, _)| *other != ring) {
            let wanted = if other == 0 {
                Place::Inside
            } else {
                Place::Outside
            };
            let Some(&edge) = edges.iter().find(|edge| !keeps_to(edge, fence, wanted)) else {
                continue;
            };
            return Err(if other == 0 {
                ShapeFault::HoleOutside { ring, edge }
            } else {
                ShapeFault::HolesOverlap { ring, other, edge }
            });
        }
    }
    Ok(())
}

/// Whether an edge, but for points where it touches, lies in one place against a ring.
fn keeps_to(&[u, v]: &Edge, fence: &[Edge], wanted: Place) -> bool {
    let strays = |place| place != wanted;
    let outline = Outline::around(&[u, v], fence);
    let filtered = any_piece::<Interval>(
        &outline,
        [&spot(u), &spot(v)],
        [0.0, 1.0].map(Interval::from_f64),
        strays,
    );
    let exact = || {
        let range = [Rational::ZERO, Rational::ONE];
        any_piece::<Rational>(&outline, [&spot(u), &spot(v)], range, strays)
    };
    // Rationals always decide.
    !filtered.or_else(exact).unwrap_or(true)
}
