//! [`Certificate`], the proof that a column is inside a mesh.
//!
//! A column is divided into cells: triangular prisms, cut where level facets cross them. Both a
//! cell and a facet are convex, so the open cell is free of the facet exactly where a plane
//! separates them, and in a prism that plane is level, or stands on an edge of the cell or of the
//! facet in plan, or is the facet's own, or stands on an edge of the cell with the facet cut to the
//! cell's heights on its other side. All but the last are decided by exact predicates, where
//! touching is apart; the last involves computed places and asks for a distance that exceeds their
//! rounding. In a cell free of facets the winding number is the same everywhere, and a vertical
//! ray from one point counts it exactly. Closed cells with winding number 1 or more lie in the
//! closure of the solid, and so does their union, the column. A cell with vertical facets on one
//! line across it is taken as two.

use glam::{DVec2, DVec3};

use super::facets::{Facet, Facets};
use crate::predicates::{side, turn};

/// How far a computed place must be from an edge, as a share of the greatest coordinate: some
/// hundred roundings.
const CLEARANCE: f64 = 1e-14;

/// Most comparisons of a cell with a facet in one mesh: some seconds of work.
const MOST_COMPARISONS: usize = 20_000_000;

/// A wall this close to an edge in plan stands on it, metres.
const ON_WALL: f64 = 1e-6;

/// How a facet lies to the open prism of a cell.
enum Relation {
    Apart,
    /// Level, and across it at this height.
    Level(f64),
    /// Vertical, and across it on this line.
    Wall([DVec2; 2]),
    Meets,
}

/// Proves cells of one mesh.
pub struct Certificate<'a> {
    facets: &'a Facets,
    clearance: f64,
    comparisons: usize,
}

impl<'a> Certificate<'a> {
    pub fn new(facets: &'a Facets) -> Self {
        let corners = facets.list.iter().flat_map(|facet| facet.corners);
        let greatest = corners.fold(0.0, |most: f64, c| most.max(c.abs().max_element()));
        Self {
            facets,
            clearance: CLEARANCE * greatest,
            comparisons: 0,
        }
    }

    /// Whether the cell, a triangle that turns anticlockwise, is solid from `bottom` to `top`.
    /// Never `true` wrongly.
    pub fn proves(&mut self, cell: [DVec2; 3], bottom: f64, top: f64) -> bool {
        let near: Vec<&Facet> = self.facets.near(&cell).collect();
        self.comparisons += near.len();
        if self.comparisons > MOST_COMPARISONS {
            return false;
        }
        let mut cuts = vec![bottom, top];
        let mut wall: Option<[DVec2; 2]> = None;
        for facet in &near {
            match self.relation(facet, cell, bottom, top) {
                Relation::Apart => {}
                Relation::Level(height) => cuts.push(height),
                Relation::Wall(line) => match wall {
                    // One line divides a cell exactly; more would need computed corners.
                    Some([from, to]) if line.iter().any(|&p| turn(from, to, p) != 0.0) => {
                        return false;
                    }
                    _ => wall = Some(line),
                },
                Relation::Meets => return false,
            }
        }
        cuts.sort_unstable_by(f64::total_cmp);
        cuts.dedup();
        let Some(places) = samples(cell, wall) else {
            return false;
        };
        let is_solid = |place: DVec2, low: f64, high: f64| {
            let height = low + (high - low) / 2.0;
            low < height
                && height < high
                && winding(&near, place.extend(height)).is_some_and(|winding| winding >= 1)
        };
        places
            .iter()
            .all(|&place| cuts.windows(2).all(|cut| is_solid(place, cut[0], cut[1])))
    }

    /// Whether a vertical facet stands on an edge of the plan between the heights.
    pub fn has_wall(&self, [from, to]: [DVec2; 2], [bottom, top]: [f64; 2]) -> bool {
        let middle = (from + to) / 2.0;
        let near = self.facets.near(&[middle - ON_WALL, middle + ON_WALL]);
        let mut walls = near.filter(|facet| {
            let [low, high] = facet.heights();
            facet.faces == 0 && low < top && high > bottom
        });
        walls.any(|wall| {
            let line = line(wall);
            let length = line[0].distance(line[1]);
            [from, to]
                .iter()
                .all(|&p| turn(line[0], line[1], p).abs() <= ON_WALL * length)
        })
    }

    fn relation(&self, facet: &Facet, cell: [DVec2; 3], bottom: f64, top: f64) -> Relation {
        let [low, high] = facet.heights();
        let plan = facet.corners.map(DVec3::truncate);
        let is_apart = high <= bottom
            || low >= top
            || edges(cell).any(|[from, to]| plan.iter().all(|&p| turn(from, to, p) <= 0.0))
            || is_beside(cell, facet);
        if is_apart {
            return Relation::Apart;
        }
        if low == high {
            return Relation::Level(low);
        }
        let ends = cell.map(|p| [p.extend(bottom), p.extend(top)]);
        let sides = ends.as_flattened().iter().map(|&p| side(&facet.corners, p));
        if is_on_one_side(sides) || self.is_cut_off(facet, cell, bottom, top) {
            return Relation::Apart;
        }
        match facet.faces {
            0 => Relation::Wall(line(facet)),
            _ => Relation::Meets,
        }
    }

    /// Whether the facet between the heights is beyond an edge of the cell.
    fn is_cut_off(&self, facet: &Facet, cell: [DVec2; 3], bottom: f64, top: f64) -> bool {
        let within = facet.corners.iter().filter(|c| bottom <= c.z && c.z <= top);
        let within: Vec<DVec2> = within.map(|corner| corner.truncate()).collect();
        let mut computed = Vec::new();
        for (i, from) in facet.corners.iter().enumerate() {
            let to = facet.corners[(i + 1) % 3];
            for height in [bottom, top] {
                if from.z.min(to.z) < height && height < from.z.max(to.z) {
                    let along = (height - from.z) / (to.z - from.z);
                    computed.push(from.truncate().lerp(to.truncate(), along));
                }
            }
        }
        edges(cell).any(|[from, to]| {
            let beyond = self.clearance * from.distance(to);
            within.iter().all(|&p| turn(from, to, p) <= 0.0)
                && computed.iter().all(|&p| turn(from, to, p) < -beyond)
        })
    }
}

/// Points in the cell, or in both its parts where a line divides it; `None` where rounding leaves
/// no room for them.
fn samples(cell: [DVec2; 3], line: Option<[DVec2; 2]>) -> Option<Vec<DVec2>> {
    let Some([from, to]) = line else {
        let middle = (cell[0] + cell[1] + cell[2]) / 3.0;
        return is_inside(cell, middle).then(|| vec![middle]);
    };
    [1.0, -1.0]
        .into_iter()
        .map(|sign| {
            let side = |p: DVec2| sign * turn(from, to, p);
            let mut part = Vec::new();
            for [a, b] in edges(cell) {
                if side(a) >= 0.0 {
                    part.push(a);
                }
                if side(a) * side(b) < 0.0 {
                    part.push(a.lerp(b, side(a) / (side(a) - side(b))));
                }
            }
            let middle = part.iter().sum::<DVec2>() / part.len() as f64;
            (is_inside(cell, middle) && side(middle) > 0.0).then_some(middle)
        })
        .collect()
}

fn is_inside(cell: [DVec2; 3], place: DVec2) -> bool {
    edges(cell).all(|[from, to]| turn(from, to, place) > 0.0)
}

/// The line on which a vertical facet stands: through its two corners that are furthest apart.
fn line(wall: &Facet) -> [DVec2; 2] {
    edges(wall.corners.map(DVec3::truncate))
        .max_by(|a, b| a[0].distance(a[1]).total_cmp(&b[0].distance(b[1])))
        .unwrap_or_default()
}

/// How often the facets wind around a point that is on none of them; `None` when it is on one. A
/// vertical ray up from the point passes out of the solid through facets that face up.
fn winding(near: &[&Facet], point: DVec3) -> Option<i32> {
    let mut winding = 0;
    for facet in near.iter().filter(|facet| facet.covers(point.truncate())) {
        let side = side(&facet.corners, point) * f64::from(facet.faces);
        if side == 0.0 {
            return None;
        }
        if side < 0.0 {
            winding += facet.faces;
        }
    }
    Some(winding)
}

/// Whether an edge of the facet has the facet on one side and the cell on the other, in plan.
fn is_beside(cell: [DVec2; 3], facet: &Facet) -> bool {
    edges(facet.corners.map(DVec3::truncate)).any(|[from, to]| {
        let sides = cell.map(|p| turn(from, to, p));
        match facet.faces {
            // All of a vertical facet is on the line.
            0 => from != to && is_on_one_side(sides),
            faces => sides.iter().all(|side| side * f64::from(faces) <= 0.0),
        }
    })
}

fn edges([a, b, c]: [DVec2; 3]) -> impl Iterator<Item = [DVec2; 2]> {
    [[a, b], [b, c], [c, a]].into_iter()
}

fn is_on_one_side(sides: impl IntoIterator<Item = f64>) -> bool {
    let (mut left, mut right) = (false, false);
    for side in sides {
        left |= side > 0.0;
        right |= side < 0.0;
    }
    left != right
}
