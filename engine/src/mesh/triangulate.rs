//! Polygons in space to triangles over their own vertices.

use glam::{DVec2, DVec3};
use thiserror::Error;

use super::net::Net;

/// A polygon that is nowhere farther than this from a straight line, in metres, is cut into a fan
/// whatever its shape: every fan lies equally close to it. The usual quantum of delivered
/// coordinates is 1 mm, and rounding to it folds faces that are narrower than a few of them.
const THIN: f64 = 0.004;

/// Why a polygon has no triangulation that follows its rings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum PolygonDefect {
    /// A coordinate is NaN, infinite, or too large to compute with.
    #[error("a coordinate is not finite")]
    NotFinite,
    /// Edges cross each other.
    #[error("its edges cross")]
    Crossing,
    /// Rings cover a place twice, or a hole lies outside.
    #[error("its rings overlap")]
    Overlapping,
    /// Two vertices fall together when seen along the polygon's normal.
    #[error("it is folded")]
    Folded,
}

/// Triangles that cover a planar polygon, over the vertices of `rings` numbered ring by ring.
///
/// The first ring is the outer one, the others are holes; a ring may repeat its first vertex at its
/// end. Every vertex is used, also those on a straight edge, and the triangles turn as the outer
/// ring does: each ring edge is the edge of one triangle, in the ring's direction (a hole that
/// turns as the outer ring does is read backwards). Where a vertex touches another edge, triangles
/// without area close the gap between the whole edge and its two parts, so neighbours that share
/// the whole edge still fit.
///
/// The constrained Delaunay triangulation of the polygon seen along the main axis of its normal;
/// a mildly bent polygon follows its vertices.
///
/// # Errors
/// [`PolygonDefect`] when the rings bound no polygon: they cross, overlap, fold, or hold a NaN.
pub fn triangulate(rings: &[Vec<DVec3>]) -> Result<Vec<[usize; 3]>, PolygonDefect> {
    triangulate_strictly(rings).or_else(|defect| {
        if defect != PolygonDefect::NotFinite && is_thin(rings) {
            Ok(fan(rings))
        } else {
            Err(defect)
        }
    })
}

/// As [`triangulate`], but thin polygons get no fan: their rings must bound an area, too.
pub(super) fn triangulate_strictly(rings: &[Vec<DVec3>]) -> Result<Vec<[usize; 3]>, PolygonDefect> {
    if !rings.iter().flatten().all(|p| p.is_finite()) {
        return Err(PolygonDefect::NotFinite);
    }
    let triangles = Polygon::new(rings).triangles()?;
    if triangles.is_empty() {
        return Err(PolygonDefect::Overlapping);
    }
    Ok(triangles)
}

/// Triangles that cover at least the rings' insides, with each ring edge on one triangle: all that
/// can be said of a polygon that [`triangulate`] refuses.
pub(super) fn fan(rings: &[Vec<DVec3>]) -> Vec<[usize; 3]> {
    Polygon::new(rings).fan()
}

/// Rings of vertex numbers, without repetitions in a row.
struct Polygon<'a> {
    vertices: Vec<&'a DVec3>,
    rings: Vec<Vec<usize>>,
}

impl<'a> Polygon<'a> {
    fn new(rings: &'a [Vec<DVec3>]) -> Self {
        let vertices: Vec<_> = rings.iter().flatten().collect();
        let mut start = 0;
        let rings = rings.iter().map(|ring| {
            let mut numbers: Vec<usize> = (start..start + ring.len()).collect();
            start += ring.len();
            numbers.dedup_by(|a, b| vertices[*a] == vertices[*b]);
            while numbers.len() > 1 && vertices[numbers[0]] == vertices[numbers[numbers.len() - 1]]
            {
                numbers.pop();
            }
            numbers
        });
        let rings = rings.collect();
        Self { vertices, rings }
    }

    fn fan(&self) -> Vec<[usize; 3]> {
        let fans = self.rings.iter().filter(|ring| ring.len() > 2);
        fans.flat_map(|ring| ring[1..].windows(2).map(|edge| [ring[0], edge[0], edge[1]]))
            .collect()
    }

    fn triangles(&self) -> Result<Vec<[usize; 3]>, PolygonDefect> {
        let Some(outer) = self.rings.first().filter(|ring| ring.len() > 2) else {
            return Ok(Vec::new());
        };
        let plane = Plane::of(outer.iter().map(|&i| *self.vertices[i]));
        let mut rings = self.rings.clone();
        for hole in &mut rings[1..] {
            // A hole delivered with the outer ring's turn would count as a second covering.
            if plane.signed_area(hole.iter().map(|&i| *self.vertices[i])) > 0.0 {
                hole.reverse();
            }
        }
        Net::new(&rings, &self.vertices, |p| plane.flatten(p))?.triangles()
    }
}

/// Whether all vertices lie within [`THIN`] of one line.
fn is_thin(rings: &[Vec<DVec3>]) -> bool {
    let far_from = |origin: DVec3| {
        let points = rings.iter().flatten().copied();
        points.max_by(|a, b| a.distance(origin).total_cmp(&b.distance(origin)))
    };
    let Some(start) = rings
        .iter()
        .flatten()
        .next()
        .and_then(|&first| far_from(first))
    else {
        return true;
    };
    let along = far_from(start)
        .map(|end| (end - start).normalize_or_zero())
        .unwrap_or_default();
    rings
        .iter()
        .flatten()
        .all(|&p| (p - start).reject_from_normalized(along).length() <= THIN)
}

/// The coordinate plane that a polygon is flattened onto, by leaving out an axis: coordinates stay
/// as delivered, so vertices on a straight edge stay on it.
#[derive(Clone, Copy)]
struct Plane {
    origin: DVec3,
    axes: [usize; 2],
}

impl Plane {
    /// Faces the ring's normal, so that the flattened ring turns anticlockwise.
    fn of(ring: impl Iterator<Item = DVec3> + Clone) -> Self {
        let origin = ring.clone().next().unwrap_or_default();
        let normal = vector_area(ring, origin);
        let main = normal.abs().max_position();
        let (u, v) = ((main + 1) % 3, (main + 2) % 3);
        Self {
            origin,
            axes: if normal[main] < 0.0 { [v, u] } else { [u, v] },
        }
    }

    fn flatten(&self, point: DVec3) -> DVec2 {
        let local = point - self.origin;
        DVec2::new(local[self.axes[0]], local[self.axes[1]])
    }

    fn signed_area(&self, ring: impl Iterator<Item = DVec3>) -> f64 {
        edges(&ring.map(|p| self.flatten(p)).collect::<Vec<_>>())
            .map(|(from, to)| from.perp_dot(to) * 0.5)
            .sum()
    }
}

/// Twice the area times the unit normal (Newell's method), about a nearby origin.
fn vector_area(ring: impl Iterator<Item = DVec3>, origin: DVec3) -> DVec3 {
    let local: Vec<DVec3> = ring.map(|p| p - origin).collect();
    edges(&local).map(|(from, to)| from.cross(to)).sum()
}

/// The edges of a ring that closes itself.
pub(super) fn edges<T: Copy>(ring: &[T]) -> impl Iterator<Item = (T, T)> {
    ring.iter()
        .copied()
        .zip(ring.iter().copied().cycle().skip(1))
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use proptest::prelude::*;

    use super::*;

    fn ring(points: &[[f64; 2]], place: impl Fn(DVec3) -> DVec3) -> Vec<DVec3> {
        points
            .iter()
            .map(|&[x, y]| place(DVec3::new(x, y, 0.0)))
            .collect()
    }

    fn flat(points: &[[f64; 2]]) -> Vec<DVec3> {
        ring(points, |p| p)
    }

    /// Directed edges between positions, each less its opposites, zeros left out.
    fn boundary<'a>(rings: impl IntoIterator<Item = Vec<&'a DVec3>>) -> BTreeMap<String, i32> {
        let mut balance = BTreeMap::new();
        for ring in rings {
            for (from, to) in edges(&ring) {
                *balance.entry(format!("{from} {to}")).or_default() += 1;
                *balance.entry(format!("{to} {from}")).or_default() -= 1;
            }
        }
        balance.retain(|_, turns| *turns != 0);
        balance
    }

    /// Checks that the triangles have the rings for boundary, and returns their area as a vector.
    fn checked_area(rings: &[Vec<DVec3>], triangles: &[[usize; 3]]) -> DVec3 {
        let vertices: Vec<&DVec3> = rings.iter().flatten().collect();
        let given = boundary(rings.iter().map(|ring| ring.iter().collect()));
        let made = boundary(triangles.iter().map(|t| t.map(|i| vertices[i]).to_vec()));
        assert_eq!(given, made);
        let area =
            |t: &[usize; 3]| vector_area(t.iter().map(|&i| *vertices[i]), *vertices[0]) / 2.0;
        let areas: Vec<DVec3> = triangles.iter().map(area).collect();
        let sum: DVec3 = areas.iter().sum();
        // None is turned over: sizes add up as vectors do.
        let sizes: f64 = areas.iter().map(|a| a.length()).sum();
        assert!(
            (sizes - sum.length()).abs() <= 1e-9 * sizes.max(1.0),
            "{sizes} {sum}"
        );
        sum
    }

    fn area_of(rings: &[Vec<DVec3>]) -> DVec3 {
        checked_area(rings, &triangulate(rings).expect("a polygon"))
    }

    const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]];
    const HOLE: [[f64; 2]; 4] = [[2.0, 2.0], [2.0, 4.0], [4.0, 4.0], [4.0, 2.0]];

    #[test]
    fn square_with_hole_in_any_plane() {
        let places: [fn(DVec3) -> DVec3; 4] = [
            |p| p,
            |p| DVec3::new(p.y, p.x, 3.0),
            |p| DVec3::new(85_000.0, 447_000.0 + p.x, p.y),
            |p| DVec3::new(85_000.0 + p.x, 447_000.0 + p.y, p.x + p.y),
        ];
        for place in places {
            let area = area_of(&[ring(&SQUARE, place), ring(&HOLE, place)]);
            let normal = vector_area(ring(&SQUARE, place).into_iter(), place(DVec3::ZERO)) / 2.0;
            assert!(area.distance(normal * 0.96) < 1e-6, "{area} {normal}");
        }
    }

    #[test]
    fn hole_that_turns_the_wrong_way_is_a_hole() {
        let mut hole = flat(&HOLE);
        hole.reverse();
        let triangles = triangulate(&[flat(&SQUARE), hole]).expect("a polygon");
        assert_eq!(
            checked_area(&[flat(&SQUARE), flat(&HOLE)], &renumbered(&triangles)).z,
            96.0
        );
    }

    /// Vertex numbers after the second ring, of four, is turned round.
    fn renumbered(triangles: &[[usize; 3]]) -> Vec<[usize; 3]> {
        triangles
            .iter()
            .map(|t| t.map(|i| if i < 4 { i } else { 11 - i }))
            .collect()
    }

    #[test]
    fn every_vertex_is_used() {
        let straight = flat(&[
            [0.0, 0.0],
            [1.0, 0.0],
            [2.0, 0.0],
            [2.0, 2.0],
            [1.0, 2.0],
            [0.0, 2.0],
        ]);
        assert_eq!(area_of(&[straight]).z, 4.0);
        // Closed by repetition, and with a vertex given twice.
        let repeated = flat(&[[0.0, 0.0], [2.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 0.0]]);
        assert_eq!(area_of(&[repeated]).z, 2.0);
    }

    #[test]
    fn touching_rings_keep_whole_edges() {
        // A hole whose corner is on the outer edge, a ring that touches its own edge, and a spike.
        let corner = flat(&[[5.0, 0.0], [4.0, 3.0], [6.0, 3.0]]);
        assert_eq!(area_of(&[flat(&SQUARE), corner]).z, 97.0);
        let pinched = flat(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, 0.0], [0.0, 4.0]]);
        assert_eq!(area_of(&[pinched]).z, 8.0);
        let spike = flat(&[
            [0.0, 0.0],
            [2.0, 0.0],
            [2.0, 2.0],
            [3.0, 3.0],
            [2.0, 2.0],
            [0.0, 2.0],
        ]);
        assert_eq!(area_of(&[spike]).z, 4.0);
    }

    #[test]
    fn polygons_without_area_become_triangles_without_area() {
        let line = [flat(&[[0.0, 0.0], [1.0, 0.0], [3.0, 0.0], [2.0, 0.0]])];
        assert_eq!(area_of(&line), DVec3::ZERO);
        assert_eq!(triangulate(&line).map(|t| t.len()), Ok(2));
        // Narrow enough to be folded by rounding to millimetres.
        let folded = [flat(&[
            [0.0, 0.0],
            [5.0, 0.001],
            [9.0, 0.0],
            [4.0, 0.002],
            [5.0, 0.0],
        ])];
        let triangles = triangulate(&folded).expect("thin");
        assert_eq!(triangles.len(), 3);
        assert_eq!(triangulate(&[]), Ok(Vec::new()));
        assert_eq!(triangulate(&[flat(&[[1.0, 1.0]])]), Ok(Vec::new()));
    }

    #[test]
    fn nonsense_is_refused() {
        let bow_tie =
            |y: f64| triangulate(&[flat(&[[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, y]])]);
        assert_eq!(bow_tie(3.0), Err(PolygonDefect::Crossing));
        // Its two halves cancel, so it has no normal to look along.
        assert!(bow_tie(2.0).is_err());
        let far_hole = flat(&HOLE).iter().map(|&p| p + 20.0 * DVec3::X).collect();
        assert_eq!(
            triangulate(&[flat(&SQUARE), far_hole]),
            Err(PolygonDefect::Overlapping)
        );
        let twice = [SQUARE, SQUARE].concat();
        assert_eq!(
            triangulate(&[flat(&twice)]),
            Err(PolygonDefect::Overlapping)
        );
        let mut folded = flat(&SQUARE);
        folded.push(DVec3::new(0.0, 0.0, 1.0));
        assert_eq!(triangulate(&[folded]), Err(PolygonDefect::Folded));
        let nan = flat(&[[0.0, 0.0], [f64::NAN, 0.0], [1.0, 1.0]]);
        assert_eq!(triangulate(&[nan]), Err(PolygonDefect::NotFinite));
    }

    proptest! {
        #[test]
        fn stars_keep_area_and_edges(
            radii in prop::collection::vec(1.0..20.0f64, 3..30),
            hole in prop::collection::vec(0.1..0.8f64, 3..8),
            tilt in -2.0..2.0f64,
            far in any::<bool>(),
        ) {
            let origin = if far { DVec3::new(85_000.0, 447_000.0, 3.0) } else { DVec3::ZERO };
            let star = |radii: &[f64], turn: f64| -> Vec<DVec3> {
                let step = turn * std::f64::consts::TAU / radii.len() as f64;
                let place = |(i, &r): (usize, &f64)| {
                    let (sin, cos) = (i as f64 * step).sin_cos();
                    origin + DVec3::new(r * cos, r * sin, tilt * r * cos)
                };
                radii.iter().enumerate().map(place).collect()
            };
            // Three spokes leave edges that pass 0.5 from the centre; the hole is within that.
            let hole: Vec<f64> = hole.iter().map(|r| r * 0.3).collect();
            let rings = [star(&radii, 1.0), star(&hole, -1.0)];
            let inside = radii.len() > 4;
            let rings = if inside { &rings[..] } else { &rings[..1] };
            let expected: DVec3 = rings
                .iter()
                .map(|ring| vector_area(ring.iter().copied(), origin) / 2.0)
                .sum();
            let area = area_of(rings);
            prop_assert!(area.distance(expected) < 1e-6 * expected.length(), "{area} {expected}");
        }

        #[test]
        fn scribbles_never_panic_and_fans_keep_edges(
            rings in prop::collection::vec(
                prop::collection::vec(prop::array::uniform3(-3..3i8), 0..12), 0..4),
        ) {
            let rings: Vec<Vec<DVec3>> = rings
                .into_iter()
                .map(|r| r.into_iter().map(|p| DVec3::from_array(p.map(f64::from))).collect())
                .collect();
            let vertices: Vec<&DVec3> = rings.iter().flatten().collect();
            let given = boundary(rings.iter().map(|ring| ring.iter().collect()));
            let triangles = triangulate(&rings);
            let fans = fan(&rings);
            let made = boundary(fans.iter().map(|t| t.map(|i| vertices[i]).to_vec()));
            prop_assert_eq!(&given, &made);
            if let (Ok(triangles), 1) = (triangles, rings.len()) {
                let made = boundary(triangles.iter().map(|t| t.map(|i| vertices[i]).to_vec()));
                prop_assert_eq!(&given, &made);
            }
        }
    }
}
