//! Roofs that rise from all sides: hipped, pyramidal and domes.

use geo::Centroid;

use super::extruded::RoofSurfaces;
use super::footprint::signed_area;
use super::frame::{dot, length, minus};
use super::{Footprint, Plan};

/// Sine of the turn above which a vertex is a corner, about 15°: mapped sides bend a little.
const CORNER: f64 = 0.25;

/// Shortest ridge, metres: below, the sides meet in a point.
const MIN_RIDGE: f64 = 0.01;

/// Smallest area of a facet in plan, square metres: a thinner one has no direction.
const MIN_FACET: f64 = 1e-6;

/// A roof of four sides over a footprint of four corners, the ridge along the longer sides or
/// across them.
pub(super) fn hipped(
    footprint: &Footprint,
    across: bool,
    eaves: f64,
    rise: f64,
) -> Option<RoofSurfaces> {
    let [ring] = footprint.rings() else {
        return None;
    };
    let corners: Vec<usize> = (0..ring.len()).filter(|i| is_corner(ring, *i)).collect();
    let &[a, b, c, d] = corners.as_slice() else {
        return None;
    };
    let side = |from: usize, to: usize| length(minus(ring[to], ring[from]));
    let mut first_is_end = side(a, b) + side(c, d) < side(b, c) + side(d, a);
    first_is_end ^= across;
    // The ends are the sides from a to b and from c to d.
    let [a, b, c, d] = if first_is_end {
        [a, b, c, d]
    } else {
        [b, c, d, a]
    };
    let middle = |i: usize, j: usize| {
        [
            (ring[i][0] + ring[j][0]) / 2.0,
            (ring[i][1] + ring[j][1]) / 2.0,
        ]
    };
    let (start, end) = (middle(a, b), middle(c, d));
    let axis = minus(end, start);
    let axis_length = length(axis);
    let inset = ((side(a, b) + side(c, d)) / 4.0 / axis_length).min(0.5);
    let at = |share: f64| [start[0] + axis[0] * share, start[1] + axis[1] * share];
    let ridge = match (1.0 - 2.0 * inset) * axis_length < MIN_RIDGE {
        true => [at(0.5); 2],
        false => [at(inset), at(1.0 - inset)],
    };
    let mut fan = Fan::new(ring, eaves, eaves + rise);
    fan.side(a, b, ridge[0])?;
    fan.side(b, c, ridge[0])?;
    fan.ridge(c, ridge)?;
    fan.side(c, d, ridge[1])?;
    fan.side(d, a, ridge[1])?;
    fan.ridge(a, [ridge[1], ridge[0]])?;
    Some(fan.surfaces())
}

/// A roof whose outline shrinks towards the middle as it rises: for each step its share of the
/// outline, the last being none of it, and of the rise. None where a side looks away from the
/// middle.
pub(super) fn dome(
    footprint: &Footprint,
    steps: &[[f64; 2]],
    eaves: f64,
    rise: f64,
) -> Option<RoofSurfaces> {
    let [ring] = footprint.rings() else {
        return None;
    };
    let middle = centroid(ring)?;
    let edges = || (0..ring.len()).map(|i| (i, (i + 1) % ring.len()));
    if edges().any(|(i, j)| signed_area(&[ring[i], ring[j], middle]) < MIN_FACET) {
        return None;
    }
    let (_, steps) = steps.split_last()?;
    let mut rings = vec![at(ring, eaves)];
    for [share, height] in steps {
        let shrunk = ring.iter().map(|p| minus(*p, middle)).map(|[x, y]| {
            [
                middle[0] + x * share,
                middle[1] + y * share,
                eaves + rise * height,
            ]
        });
        rings.push(shrunk.collect());
    }
    let mut faces = Vec::new();
    for pair in rings.windows(2) {
        faces.extend(
            edges().map(|(i, j)| vec![vec![pair[0][i], pair[0][j], pair[1][j], pair[1][i]]]),
        );
    }
    let peak = [middle[0], middle[1], eaves + rise];
    let last = rings.last()?;
    faces.extend(edges().map(|(i, j)| vec![vec![last[i], last[j], peak]]));
    Some(RoofSurfaces {
        rims: vec![rim(ring, eaves)],
        faces,
    })
}

/// Triangles between the eaves and points of a ridge.
struct Fan<'a> {
    ring: &'a [Plan],
    eaves: f64,
    ridge: f64,
    faces: Vec<super::Rings>,
}

impl<'a> Fan<'a> {
    fn new(ring: &'a [Plan], eaves: f64, ridge: f64) -> Self {
        Self {
            ring,
            eaves,
            ridge,
            faces: Vec::new(),
        }
    }

    /// From each edge between two corners to one point; none where one would look down.
    fn side(&mut self, from: usize, to: usize, point: Plan) -> Option<()> {
        let count = self.ring.len();
        let mut i = from;
        while i != to {
            let j = (i + 1) % count;
            let (a, b) = (self.ring[i], self.ring[j]);
            (signed_area(&[a, b, point]) >= MIN_FACET).then_some(())?;
            self.faces.push(vec![vec![
                [a[0], a[1], self.eaves],
                [b[0], b[1], self.eaves],
                [point[0], point[1], self.ridge],
            ]]);
            i = j;
        }
        Some(())
    }

    /// From the ridge to one corner; nothing where the ridge is a point.
    fn ridge(&mut self, corner: usize, [near, far]: [Plan; 2]) -> Option<()> {
        if near == far {
            return Some(());
        }
        let a = self.ring[corner];
        (signed_area(&[a, far, near]) >= MIN_FACET).then_some(())?;
        self.faces.push(vec![vec![
            [a[0], a[1], self.eaves],
            [far[0], far[1], self.ridge],
            [near[0], near[1], self.ridge],
        ]]);
        Some(())
    }

    fn surfaces(self) -> RoofSurfaces {
        RoofSurfaces {
            rims: vec![rim(self.ring, self.eaves)],
            faces: self.faces,
        }
    }
}

/// Whether a ring turns at a vertex.
fn is_corner(ring: &[Plan], i: usize) -> bool {
    let count = ring.len();
    let before = minus(ring[i], ring[(i + count - 1) % count]);
    let after = minus(ring[(i + 1) % count], ring[i]);
    let turn = before[0] * after[1] - before[1] * after[0];
    turn.abs() > CORNER * length(before) * length(after) || dot(before, after) < 0.0
}

/// The middle of the area of a ring; none where it is not a number.
fn centroid(ring: &[Plan]) -> Option<Plan> {
    let origin = *ring.first()?;
    let local: Vec<Plan> = ring.iter().map(|p| minus(*p, origin)).collect();
    let area = geo::Polygon::new(super::footprint::line_string(&local), vec![]);
    let middle = area.centroid()?;
    Some([middle.x() + origin[0], middle.y() + origin[1]])
}

fn at(ring: &[Plan], z: f64) -> Vec<[f64; 3]> {
    ring.iter().map(|[x, y]| [*x, *y, z]).collect()
}

/// Eaves at one height.
fn rim(ring: &[Plan], eaves: f64) -> Vec<Vec<[f64; 3]>> {
    at(ring, eaves)
        .into_iter()
        .map(|position| vec![position])
        .collect()
}
