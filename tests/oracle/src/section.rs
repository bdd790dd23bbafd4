//! Triangles and polygons against the open solid over a footprint, exactly.

use std::cmp::Ordering;

use crate::exact::Rational;
use crate::footprint::Footprint;
use crate::interval::Interval;
use crate::mesh::Triangle;
use crate::number::{Number, sign_of};
use crate::plane::{
    Edge, Outline, Place, PlanPoint, Spot, any_piece, between, doubled_area, place, plan_turn, spot,
};

/// Heights between which a solid over a footprint lies; the bottom may be minus infinity.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Heights {
    pub(crate) bottom: f64,
    pub(crate) top: f64,
}

/// Whether the closed triangle meets the open solid over `footprint`. Touching its boundary from
/// outside or running within a face does not.
pub(crate) fn triangle_meets_solid(
    triangle: &Triangle,
    footprint: &Footprint,
    heights: Heights,
) -> bool {
    if is_beside(triangle, footprint, heights) {
        return false;
    }
    let outline = Outline::around(&in_plan(triangle), &footprint.edges);
    meets::<Interval>(triangle, &outline, heights)
        .or_else(|| meets::<Rational>(triangle, &outline, heights))
        // Rationals always decide.
        .unwrap_or(true)
}

/// Whether a face of the box around the solid keeps the triangle out.
fn is_beside([a, b, c]: &Triangle, footprint: &Footprint, heights: Heights) -> bool {
    let ([west, south], [east, north]) = (footprint.min, footprint.max);
    let (min, max) = ([west, south, heights.bottom], [east, north, heights.top]);
    (0..3).any(|i| a[i].max(b[i]).max(c[i]) <= min[i] || a[i].min(b[i]).min(c[i]) >= max[i])
}

/// The same for a triangle that reaches between the heights: the part of it there, seen in plan,
/// against the open polygon, of which it need not matter whether that part holds its boundary.
fn meets<N: Number>(triangle: &Triangle, outline: &Outline, heights: Heights) -> Option<bool> {
    let mut shadow = shadow::<N>(triangle, heights);
    let [a, b, c] = in_plan(triangle);
    match plan_turn(a, b, c) {
        Ordering::Equal => sides_meet(&shadow, outline),
        Ordering::Greater => convex_meets(&shadow, outline),
        Ordering::Less => {
            shadow.reverse();
            convex_meets(&shadow, outline)
        }
    }
}

/// The part of the triangle between the heights, in plan.
fn shadow<N: Number>(triangle: &Triangle, heights: Heights) -> Vec<Spot<N>> {
    let whole = triangle.map(|[x, y, z]| (spot([x, y]), z));
    let above = clipped(&whole, heights.bottom, Ordering::Less);
    let section = clipped(&above, heights.top, Ordering::Greater);
    section.into_iter().map(|(spot, _)| spot).collect()
}

/// A convex polygon of spots with their heights, without what lies on the `dropped` side of a
/// height. Heights stay exact: those of new corners are the height itself.
fn clipped<N: Number>(
    polygon: &[(Spot<N>, f64)],
    height: f64,
    dropped: Ordering,
) -> Vec<(Spot<N>, f64)> {
    let is_kept = |z: f64| z.partial_cmp(&height) != Some(dropped);
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for ((p, from), (q, to)) in polygon.iter().zip(polygon.iter().cycle().skip(1)) {
        if is_kept(*from) {
            kept.push((p.clone(), *from));
        }
        let passes = (*from < height && height < *to) || (*to < height && height < *from);
        if passes {
            let [start, end, middle] = [*from, *to, height].map(N::from_f64);
            let at = middle.minus(&start).over(&end.minus(&start));
            kept.push((between(p, q, &at), height));
        }
    }
    kept
}

fn in_plan(triangle: &Triangle) -> [PlanPoint; 3] {
    triangle.map(|[x, y, _]| [x, y])
}

/// Whether a side of a polygon without area meets the open polygon within the outline.
fn sides_meet<N: Number>(polygon: &[Spot<N>], outline: &Outline) -> Option<bool> {
    let mut certain = true;
    for (a, b) in polygon.iter().zip(polygon.iter().cycle().skip(1)) {
        match side_meets(a, b, outline) {
            Some(true) => return Some(true),
            Some(false) => {}
            None => certain = false,
        }
    }
    certain.then_some(false)
}

fn side_meets<N: Number>(a: &Spot<N>, b: &Spot<N>, outline: &Outline) -> Option<bool> {
    let is_inside = |place| place == Place::Inside;
    if a[0].compare(&b[0])? == Ordering::Equal && a[1].compare(&b[1])? == Ordering::Equal {
        return place(&outline.right, a).map(is_inside);
    }
    any_piece(outline, [a, b], [0.0, 1.0].map(N::from_f64), is_inside)
}

/// Whether a convex polygon with an area, anticlockwise, meets the open polygon within the
/// outline: some edge passes through its interior, or it lies all inside.
fn convex_meets<N: Number>(polygon: &[Spot<N>], outline: &Outline) -> Option<bool> {
    if any_edge_enters(polygon, &outline.near)? {
        return Some(true);
    }
    place(&outline.right, &centre(polygon)).map(|place| place == Place::Inside)
}

/// Whether a convex polygon with an area, anticlockwise, lies in the closed polygon within the
/// outline.
pub(crate) fn lies_within<N: Number>(polygon: &[Spot<N>], outline: &Outline) -> Option<bool> {
    if any_edge_enters(polygon, &outline.near)? {
        return Some(false);
    }
    place(&outline.right, &centre(polygon)).map(|place| place == Place::Inside)
}

/// Whether any of the edges meets the open convex polygon.
fn any_edge_enters<N: Number>(polygon: &[Spot<N>], edges: &[Edge]) -> Option<bool> {
    let mut certain = true;
    for edge in edges {
        match edge_enters(polygon, edge) {
            Some(true) => return Some(true),
            Some(false) => {}
            None => certain = false,
        }
    }
    certain.then_some(false)
}

/// Whether the closed edge meets the open convex polygon: no side of the polygon and not the edge
/// itself separates them (the sides of their Minkowski difference are parallel to these).
fn edge_enters<N: Number>(polygon: &[Spot<N>], edge: &Edge) -> Option<bool> {
    let [u, v] = edge.map(spot);
    let mut certain = true;
    for (p, q) in polygon.iter().zip(polygon.iter().cycle().skip(1)) {
        match keeps_right(p, q, [&u, &v]) {
            Some(true) => return Some(false),
            Some(false) => {}
            None => certain = false,
        }
    }
    for [from, to] in [[&u, &v], [&v, &u]] {
        match keeps_right(from, to, polygon) {
            Some(true) => return Some(false),
            Some(false) => {}
            None => certain = false,
        }
    }
    certain.then_some(true)
}

/// Whether all spots lie on or to the right of the line from `p` to `q`.
fn keeps_right<'a, N: Number + 'a>(
    p: &Spot<N>,
    q: &Spot<N>,
    spots: impl IntoIterator<Item = &'a Spot<N>>,
) -> Option<bool> {
    let mut certain = true;
    for spot in spots {
        match sign_of(&doubled_area(p, q, spot)) {
            Some(Ordering::Greater) => return Some(false),
            Some(_) => {}
            None => certain = false,
        }
    }
    certain.then_some(true)
}

/// The mean of the corners, inside a convex polygon with an area.
fn centre<N: Number>(polygon: &[Spot<N>]) -> Spot<N> {
    let zero = [0.0; 2].map(N::from_f64);
    let sum = polygon.iter().fold(zero, |sum: Spot<N>, corner| {
        std::array::from_fn(|axis| sum[axis].plus(&corner[axis]))
    });
    let count = N::from_f64(polygon.len() as f64);
    sum.map(|x| x.over(&count))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::aabb::Point;
    use crate::exact::{Vector, sign, vector};
    use crate::number::{cross, difference, dot};
    use crate::overlap::triangle_meets_interior;
    use crate::scenes::{cases, points, ring};

    /// Another method: clip the triangle by the half-spaces of a convex prism, each given by three
    /// points that turn anticlockwise seen from inside. What is left of it is convex, so it meets the
    /// open prism exactly when its centroid is strictly inside.
    fn clipped_meets(triangle: &Triangle, faces: &[[Point; 3]]) -> bool {
        let depth = |[a, b, c]: &[Point; 3], p: &Vector| {
            let [u, v] = [b, c].map(|end| difference(&vector(*end), &vector(*a)));
            dot(&cross(&u, &v), &difference(p, &vector(*a)))
        };
        let mut polygon: Vec<Vector> = triangle.iter().map(|&corner| vector(corner)).collect();
        for face in faces {
            let mut kept = Vec::new();
            for (p, q) in polygon.iter().zip(polygon.iter().cycle().skip(1)) {
                let (from, to) = (depth(face, p), depth(face, q));
                if sign(&from) != Ordering::Less {
                    kept.push(p.clone());
                }
                if sign(&from) == sign(&to).reverse() && sign(&from) != Ordering::Equal {
                    let t = &from / (&from - &to);
                    kept.push(std::array::from_fn(|k| &p[k] + (&q[k] - &p[k]) * &t));
                }
            }
            polygon = kept;
        }
        let Ok(count) = u32::try_from(polygon.len()) else {
            return false;
        };
        let sum = |axis: usize| polygon.iter().fold(Rational::ZERO, |sum, p| sum + &p[axis]);
        count > 0 && {
            let centre = [0, 1, 2].map(|axis| sum(axis) / Rational::from(count));
            faces
                .iter()
                .all(|face| sign(&depth(face, &centre)) == Ordering::Greater)
        }
    }

    proptest! {
        #![proptest_config(cases(2000))]
        #[test]
        fn agrees_with_clipping([a, b, c, d, e, f] in points()) {
            let corners = [d, e, f].map(|[x, y, _]| [x, y]).to_vec();
            let (bottom, top) = (d[2].min(e[2]), d[2].max(e[2]));
            let Ok(footprint) = Footprint::new(&[corners]) else {
                return Ok(());
            };
            prop_assume!(bottom < top);
            let wall = |[ux, uy, _]: Point, [vx, vy, _]: Point| {
                [[vx, vy, 0.0], [ux, uy, 0.0], [vx, vy, 1.0]]
            };
            let faces = [
                wall(d, e),
                wall(e, f),
                wall(f, d),
                [[0.0, 0.0, bottom], [1.0, 0.0, bottom], [0.0, 1.0, bottom]],
                [[0.0, 0.0, top], [0.0, 1.0, top], [1.0, 0.0, top]],
            ];
            prop_assert_eq!(
                triangle_meets_solid(&[a, b, c], &footprint, Heights { bottom, top }),
                clipped_meets(&[a, b, c], &faces)
            );
        }

        #[test]
        fn a_ring_is_its_bars([a, b, c, d, e, f, g] in points()) {
            let Some((column, bars)) = ring([d, e, f, g]) else {
                return Ok(());
            };
            let heights = Heights { bottom: column.bottom, top: column.top };
            let footprint = column.footprint;
            prop_assert_eq!(
                triangle_meets_solid(&[a, b, c], &footprint, heights),
                bars.iter().any(|bar| triangle_meets_interior(&[a, b, c], bar))
            );
        }

        #[test]
        fn filter_never_disagrees([a, b, c, d, e, f, g] in points()) {
            let Some((column, _)) = ring([d, e, f, g]) else {
                return Ok(());
            };
            let heights = Heights { bottom: column.bottom, top: column.top };
            let footprint = column.footprint;
            let triangle = [a, b, c];
            prop_assume!(!is_beside(&triangle, &footprint, heights));
            let outline = Outline::around(&in_plan(&triangle), &footprint.edges);
            if let Some(answer) = meets::<Interval>(&triangle, &outline, heights) {
                prop_assert_eq!(Some(answer), meets::<Rational>(&triangle, &outline, heights));
            }
        }
    }
}
