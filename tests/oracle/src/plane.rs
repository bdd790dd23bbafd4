//! Rings and segments in plan, in either arithmetic.

use std::cmp::Ordering;

use crate::determinant::turn;
use crate::number::{Number, middle, sign_of};

/// A point `[x, y]` in plan, in metres.
pub type PlanPoint = [f64; 2];

/// An edge of a ring, from corner to corner.
pub(crate) type Edge = [PlanPoint; 2];

/// A point in plan, in some arithmetic.
pub(crate) type Spot<N> = [N; 2];

/// Where a point lies against a polygon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Place {
    Inside,
    Boundary,
    Outside,
}

/// The edges of a closed ring.
pub(crate) fn ring_edges(ring: &[PlanPoint]) -> impl Iterator<Item = Edge> {
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).map(|(from, to)| [*from, *to])
}

/// Greater if `a`, `b`, `c` turn anticlockwise. Exact.
pub(crate) fn plan_turn(a: PlanPoint, b: PlanPoint, c: PlanPoint) -> Ordering {
    // Corners against edges that they end are common, and dear in rationals.
    if c == a || c == b {
        return Ordering::Equal;
    }
    let [a, b, c] = [a, b, c].map(|[x, y]| [x, y, 0.0]);
    turn(a, b, c, (0, 1))
}

/// A spot with the coordinates of a point.
pub(crate) fn spot<N: Number>(point: PlanPoint) -> Spot<N> {
    point.map(N::from_f64)
}

/// Twice the area of the triangle `a`, `b`, `c`, positive if it turns anticlockwise.
pub(crate) fn doubled_area<N: Number>(a: &Spot<N>, b: &Spot<N>, c: &Spot<N>) -> N {
    let along = [b[0].minus(&a[0]), b[1].minus(&a[1])];
    let way = [c[0].minus(&a[0]), c[1].minus(&a[1])];
    along[0].times(&way[1]).minus(&along[1].times(&way[0]))
}

/// The point of the line from `a` (at 0) to `b` (at 1).
pub(crate) fn between<N: Number>(a: &Spot<N>, b: &Spot<N>, at: &N) -> Spot<N> {
    std::array::from_fn(|axis| a[axis].plus(&b[axis].minus(&a[axis]).times(at)))
}

/// The edges of a polygon that matter within a rectangle.
pub(crate) struct Outline {
    /// Those that may touch the rectangle.
    pub(crate) near: Vec<Edge>,
    /// Those that rays from it to greater x may meet.
    pub(crate) right: Vec<Edge>,
}

impl Outline {
    /// The edges that matter within the rectangle around some points.
    pub(crate) fn around(points: &[PlanPoint], edges: &[Edge]) -> Self {
        let bound = |axis: usize, pick: fn(f64, f64) -> f64, start: f64| {
            points
                .iter()
                .fold(start, |bound, point| pick(bound, point[axis]))
        };
        let min = [0, 1].map(|axis| bound(axis, f64::min, f64::INFINITY));
        let max = [0, 1].map(|axis| bound(axis, f64::max, f64::NEG_INFINITY));
        let ends_before = |[u, v]: &Edge, axis: usize| u[axis].max(v[axis]) < min[axis];
        let starts_behind = |[u, v]: &Edge, axis: usize| u[axis].min(v[axis]) > max[axis];
        let is_right = |edge: &&Edge| {
            !ends_before(edge, 0) && !ends_before(edge, 1) && !starts_behind(edge, 1)
        };
        let right: Vec<Edge> = edges.iter().filter(is_right).copied().collect();
        let is_near = |edge: &&Edge| !starts_behind(edge, 0);
        Self {
            near: right.iter().filter(is_near).copied().collect(),
            right,
        }
    }
}

/// Where a spot lies against the polygon that `edges` bound, holes included. `None` where the
/// arithmetic cannot tell.
pub(crate) fn place<N: Number>(edges: &[Edge], point: &Spot<N>) -> Option<Place> {
    let mut is_inside = false;
    for &edge in edges {
        match passage(edge, point)? {
            Passage::On => return Some(Place::Boundary),
            Passage::Crosses => is_inside = !is_inside,
            Passage::Misses => {}
        }
    }
    Some(if is_inside {
        Place::Inside
    } else {
        Place::Outside
    })
}

/// How the ray from a spot to greater x meets an edge.
enum Passage {
    On,
    Crosses,
    Misses,
}

/// An edge holds its lower end and not its upper one, so that the ray crosses each corner once.
fn passage<N: Number>([u, v]: Edge, point: &Spot<N>) -> Option<Passage> {
    let against = |axis: usize| [u, v].map(|end| N::from_f64(end[axis]).compare(&point[axis]));
    let (left, level) = (against(0), against(1));
    let beside = left == [Some(Ordering::Less); 2]
        || level == [Some(Ordering::Less); 2]
        || level == [Some(Ordering::Greater); 2];
    if beside {
        return Some(Passage::Misses);
    }
    let level = [level[0]?, level[1]?];
    if level == [Ordering::Equal; 2] {
        let right = [left[0]?, left[1]?] == [Ordering::Greater; 2];
        return Some(if right { Passage::Misses } else { Passage::On });
    }
    let side = sign_of(&doubled_area(&spot(u), &spot(v), point))?;
    let is_above = level.map(|order| order == Ordering::Greater);
    Some(match (side, is_above) {
        (Ordering::Equal, _) => Passage::On,
        (Ordering::Greater, [false, true]) | (Ordering::Less, [true, false]) => Passage::Crosses,
        _ => Passage::Misses,
    })
}

/// Whether some piece of the segment from `a` to `b`, between two of the parameters `range` and
/// cut where it meets the outline, lies in a `wanted` place against the polygon within. The ends of
/// pieces do not count. `None` where the arithmetic cannot tell; it needs `a` unlike `b`.
pub(crate) fn any_piece<N: Number>(
    outline: &Outline,
    [a, b]: [&Spot<N>; 2],
    range: [N; 2],
    wanted: impl Fn(Place) -> bool,
) -> Option<bool> {
    let mut cuts = Vec::new();
    for &edge in &outline.near {
        for cut in edge_cuts(edge, a, b)? {
            let orders = [cut.compare(&range[0])?, cut.compare(&range[1])?];
            if orders == [Ordering::Greater, Ordering::Less] {
                cuts.push(cut);
            }
        }
    }
    let [first, last] = range;
    cuts.extend([first, last]);
    let mut certain = true;
    for pair in N::sorted(cuts)?.windows(2) {
        if pair[0].compare(&pair[1]) == Some(Ordering::Equal) {
            continue;
        }
        let point = between(a, b, &middle(&pair[0], &pair[1]));
        match place(&outline.right, &point) {
            Some(place) if wanted(place) => return Some(true),
            Some(_) => {}
            None => certain = false,
        }
    }
    certain.then_some(false)
}

/// The parameters at which the line from `a` to `b` may enter or leave the edge.
fn edge_cuts<N: Number>([u, v]: Edge, a: &Spot<N>, b: &Spot<N>) -> Option<Vec<N>> {
    let (u, v) = (spot(u), spot(v));
    if is_beside(&doubled_area(a, b, &u), &doubled_area(a, b, &v)) {
        return Some(Vec::new());
    }
    let sides = [doubled_area(&u, &v, a), doubled_area(&u, &v, b)];
    if is_beside(&sides[0], &sides[1]) {
        return Some(Vec::new());
    }
    match [sign_of(&sides[0])?, sign_of(&sides[1])?] {
        [Ordering::Equal, Ordering::Equal] => line_cuts(&u, &v, a, b),
        _ => Some(vec![sides[0].over(&sides[0].minus(&sides[1]))]),
    }
}

/// The parameters of the ends of an edge on the line.
fn line_cuts<N: Number>(u: &Spot<N>, v: &Spot<N>, a: &Spot<N>, b: &Spot<N>) -> Option<Vec<N>> {
    let way = [b[0].minus(&a[0]), b[1].minus(&a[1])];
    let axis = usize::from(sign_of(&way[0])? == Ordering::Equal);
    let at = |end: &Spot<N>| end[axis].minus(&a[axis]).over(&way[axis]);
    Some(vec![at(u), at(v)])
}

/// Whether both ends lie surely and strictly on one side.
fn is_beside<N: Number>(a: &N, b: &N) -> bool {
    matches!(
        (sign_of(a), sign_of(b)),
        (Some(Ordering::Less), Some(Ordering::Less))
            | (Some(Ordering::Greater), Some(Ordering::Greater))
    )
}
