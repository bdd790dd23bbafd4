//! [`Footprint`], an area that can be extruded.

use geo::coordinate_position::{CoordPos, CoordinatePosition};
use geo::{Coord, LineString, Polygon, Validation};

use super::{Plan, crossing};

/// Most vertices of one footprint, holes included.
const MAX_VERTICES: usize = 20_000;

/// Most holes of one footprint: each is compared with each.
const MAX_HOLES: usize = 1000;

/// Most vertices of a footprint whose rings touch: its edges are compared each with each.
const MAX_TOUCHING_VERTICES: usize = 500;

/// Most vertices of a ring that may touch another before it counts as outside.
const MAX_TOUCHES: usize = 16;

/// Smallest area, square metres: below, rounding decides what is inside.
const MIN_AREA: f64 = 1e-4;

/// Why rings without an area are no footprint.
pub(super) const NO_AREA: &str = "the outline has no area";

/// An area in plan: rings that do not cross, holes inside the outer one.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Footprint {
    /// The outer ring anticlockwise, then the holes clockwise; no first vertex repeated at the end.
    rings: Vec<Vec<Plan>>,
}

impl Footprint {
    /// Rings in any direction, closed or not, as a footprint; or why they are none.
    pub(crate) fn new(outer: Vec<Plan>, holes: Vec<Vec<Plan>>) -> Result<Self, &'static str> {
        let footprint = Self::unchecked(outer, holes)?;
        footprint.check()?;
        Ok(footprint)
    }

    /// The same for rings that come from a library which keeps them apart.
    pub(super) fn unchecked(outer: Vec<Plan>, holes: Vec<Vec<Plan>>) -> Result<Self, &'static str> {
        let vertices: usize = holes.iter().map(Vec::len).sum::<usize>() + outer.len();
        if vertices > MAX_VERTICES {
            return Err("the outline has more than 20000 vertices");
        }
        if holes.len() > MAX_HOLES {
            return Err("the outline has more than 1000 holes");
        }
        let outer = turned(cleaned(outer), 1.0).ok_or(NO_AREA)?;
        let holes = holes.into_iter().map(cleaned);
        let holes = holes.filter_map(|hole| turned(hole, -1.0));
        Ok(Self {
            rings: std::iter::once(outer).chain(holes).collect(),
        })
    }

    /// Finds a fault that would make a solid over this area no solid.
    pub(crate) fn check(&self) -> Result<(), &'static str> {
        let touch = crossing::do_touch(&self.rings)?;
        if touch && self.vertices() > MAX_TOUCHING_VERTICES {
            return Err("rings of the outline touch");
        }
        // Where rings touch, one may pass from inside to outside through a vertex.
        match self.holes_are_inside() && (!touch || self.polygon().is_valid()) {
            true => Ok(()),
            false => Err("a hole is not inside of the outline"),
        }
    }

    /// The outer ring, then the holes.
    pub(crate) fn rings(&self) -> &[Vec<Plan>] {
        &self.rings
    }

    /// How many vertices the rings have.
    pub(crate) fn vertices(&self) -> usize {
        self.rings.iter().map(Vec::len).sum()
    }

    /// The area with its holes taken out, square metres.
    pub(crate) fn area(&self) -> f64 {
        self.rings.iter().map(|ring| signed_area(ring)).sum()
    }

    /// The same area for a library.
    pub(crate) fn polygon(&self) -> Polygon {
        let mut rings = self.rings.iter().map(|ring| line_string(ring));
        let outer = rings.next().unwrap_or_else(|| LineString::new(Vec::new()));
        Polygon::new(outer, rings.collect())
    }

    /// The area at a height, as the rings of a surface that looks up.
    pub(crate) fn at(&self, z: f64) -> Vec<Vec<[f64; 3]>> {
        let ring = |ring: &Vec<Plan>| ring.iter().map(|[x, y]| [*x, *y, z]).collect();
        self.rings.iter().map(ring).collect()
    }

    /// Whether every hole is inside of the outer ring and of no other hole.
    fn holes_are_inside(&self) -> bool {
        let Some((outer, holes)) = self.rings.split_first() else {
            return false;
        };
        let area = |ring: &Vec<Plan>| Polygon::new(line_string(ring), vec![]);
        let outer = area(outer);
        let areas: Vec<_> = holes.iter().map(area).collect();
        holes.iter().enumerate().all(|(i, hole)| {
            let in_other = |(j, other)| i != j && is_inside(hole, other);
            is_inside(hole, &outer) && !areas.iter().enumerate().any(in_other)
        })
    }
}

/// Whether a ring that does not cross an area's edge is inside of it: the first vertex that does
/// not touch the edge tells.
pub(crate) fn is_inside(ring: &[Plan], area: &Polygon) -> bool {
    let position = |[x, y]: &Plan| area.coordinate_position(&Coord { x: *x, y: *y });
    let mut positions = ring.iter().take(MAX_TOUCHES).map(position);
    positions.find(|position| *position != CoordPos::OnBoundary) == Some(CoordPos::Inside)
}

/// The ring as a library has it.
pub(crate) fn line_string(ring: &[Plan]) -> LineString {
    ring.iter().map(|[x, y]| Coord { x: *x, y: *y }).collect()
}

/// Twice the same place and back is no edge: repeated vertices and spikes go.
fn cleaned(ring: Vec<Plan>) -> Vec<Plan> {
    let mut kept: Vec<Plan> = Vec::with_capacity(ring.len());
    for position in ring {
        if kept.last() == Some(&position) {
            continue;
        }
        if kept.len() >= 2 && kept[kept.len() - 2] == position {
            kept.pop();
            continue;
        }
        kept.push(position);
    }
    while kept.len() > 1 && kept.first() == kept.last() {
        kept.pop();
        // A spike over the seam.
        if kept.len() > 2 && kept.get(1) == kept.last() {
            kept.remove(0);
        }
    }
    kept
}

/// The ring in the direction of a sign, anticlockwise for a positive one; none without an area.
fn turned(mut ring: Vec<Plan>, sign: f64) -> Option<Vec<Plan>> {
    let area = signed_area(&ring);
    if ring.len() < 3 || area.abs() < MIN_AREA {
        return None;
    }
    if area * sign < 0.0 {
        ring.reverse();
    }
    Some(ring)
}

/// Area of a ring, positive where it runs anticlockwise; by offsets from its first vertex, since
/// coordinates of millions of metres would drown it.
pub(super) fn signed_area(ring: &[Plan]) -> f64 {
    let Some([x, y]) = ring.first() else {
        return 0.0;
    };
    let local = |p: &Plan| [p[0] - x, p[1] - y];
    let edges = ring.iter().zip(ring.iter().skip(1).chain(ring.first()));
    let twice: f64 = edges
        .map(|(a, b)| (local(a), local(b)))
        .map(|(a, b)| a[0] * b[1] - b[0] * a[1])
        .sum();
    twice / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: f64, side: f64) -> Vec<Plan> {
        vec![[x, x], [x + side, x], [x + side, x + side], [x, x + side]]
    }

    #[test]
    fn rings_are_turned_and_cleaned() {
        let mut clockwise = square(0.0, 4.0);
        clockwise.reverse();
        clockwise.push(clockwise[0]);
        clockwise.insert(1, clockwise[0]);
        clockwise.splice(3..3, [[9.0, 9.0], clockwise[2]]);
        let footprint = Footprint::new(clockwise, vec![square(1.0, 1.0)]).unwrap();
        assert_eq!(footprint.area(), 15.0);
        assert!(signed_area(&footprint.rings()[0]) > 0.0);
        assert!(signed_area(&footprint.rings()[1]) < 0.0);
        assert_eq!(footprint.rings()[0].len(), 4);
    }

    #[test]
    fn what_is_no_area_is_refused() {
        let refused = |outer, holes| Footprint::new(outer, holes).unwrap_err();
        assert_eq!(refused(vec![], vec![]), "the outline has no area");
        assert_eq!(
            refused(vec![[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]], vec![]),
            "the outline has no area"
        );
        let outside = "a hole is not inside of the outline";
        assert_eq!(refused(square(0.0, 4.0), vec![square(5.0, 1.0)]), outside);
        let nested = vec![square(0.5, 3.0), square(1.0, 1.0)];
        assert_eq!(refused(square(0.0, 4.0), nested), outside);
    }

    #[test]
    fn a_hole_may_touch_the_outline_in_a_corner() {
        let hole = vec![[0.0, 0.0], [2.0, 1.0], [1.0, 2.0]];
        assert!(Footprint::new(square(0.0, 4.0), vec![hole]).is_ok());
    }
}
