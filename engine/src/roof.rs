//! [`Roof`], the edges over which a mesh is seen highest: the third test for being hidden, and the
//! tightest of what hides.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3};

use crate::predicates::{side, turn};
use crate::{Box3d, Closedness, TriangleMesh};

/// A mesh may end this far within its feature's outer envelope, metres: the envelope holds what the
/// roundings of a GLB make of it, too. Where it ends farther within, the envelope holds more than
/// this mesh, another level of detail or an edit, of which the mesh says nothing.
const FIT: f64 = 0.01;

/// Edges of one roof, at the most. It bounds what a query takes to tell that one feature is hidden;
/// of those with more, the outer prism is all that is known.
const MOST_EDGES: usize = 1024;

/// The edges of a mesh that are seen highest: from any eye outside its envelope in plan, in any
/// direction, some point of them has the greatest slope of all points of the mesh there.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Roof {
    /// Ends of the edges, metres.
    pub corners: Vec<DVec3>,
    /// Two positions in `corners` each, those that reach highest first.
    pub edges: Vec<[u32; 2]>,
    /// Whether what is upright below each edge, down to the foot of the mesh, is the border or the
    /// inside of a solid: what passes there meets the solid.
    pub hides: bool,
}

impl Roof {
    /// The roof of a mesh in an outer envelope; `None` where it could not say more than the prism
    /// does, or the envelope holds more than the mesh.
    ///
    /// A vertical plane through the eye cuts the mesh in line segments. Along each the slope from
    /// the eye grows or falls, so the greatest is found on an edge. It is not found inside an edge
    /// below a wall that stands on it, and it is found elsewhere, too, if it is on an edge at which
    /// a face bends upwards or not at all (`docs/how-it-works.md`, "Roofs").
    #[must_use]
    pub fn of(mesh: &TriangleMesh, envelope: &Box3d) -> Option<Self> {
        if !fits(&mesh.envelope()?, envelope) {
            return None;
        }
        let edges = edges(mesh)?;
        let foot = foot(mesh);
        let mut hides = foot.is_some();
        let mut kept = Vec::new();
        for (ends, apexes) in &edges {
            if !is_below_others(mesh, *ends, apexes) {
                hides &= foot.is_some_and(|foot| has_inside_below(mesh, foot, *ends, apexes));
                kept.push(*ends);
            }
        }
        let top = |edge: &[u32; 2]| {
            let heights = edge.map(|end| mesh.vertices[end as usize].z);
            heights[0].max(heights[1])
        };
        kept.sort_by(|a, b| top(b).total_cmp(&top(a)));
        let is_flat = kept.iter().flatten().all(|&end| {
            let vertex = mesh.vertices[end as usize];
            vertex.z == envelope.max.z && is_corner(vertex.truncate(), envelope)
        });
        (kept.len() <= MOST_EDGES && !is_flat).then(|| Self {
            hides,
            ..Self::gather(mesh, &kept)
        })
    }

    fn gather(mesh: &TriangleMesh, edges: &[[u32; 2]]) -> Self {
        let mut roof = Self::default();
        let mut numbers = BTreeMap::new();
        for edge in edges {
            let edge = edge.map(|end| {
                *numbers.entry(end).or_insert_with(|| {
                    roof.corners.push(mesh.vertices[end as usize]);
                    u32::try_from(roof.corners.len() - 1).expect("a roof has few corners")
                })
            });
            roof.edges.push(edge);
        }
        roof
    }
}

/// Whether a mesh reaches all sides of its feature's envelope, and no farther.
fn fits(mesh: &Box3d, envelope: &Box3d) -> bool {
    envelope.contains(mesh)
        && (mesh.min - envelope.min).max_element() <= FIT
        && (envelope.max - mesh.max).max_element() <= FIT
}

fn is_corner(place: DVec2, envelope: &Box3d) -> bool {
    let (min, max) = (envelope.min.truncate(), envelope.max.truncate());
    (0..2).all(|axis| place[axis] == min[axis] || place[axis] == max[axis])
}

/// Each edge with the third corners of the triangles at it. `None` where a triangle names a corner
/// that is not there.
fn edges(mesh: &TriangleMesh) -> Option<BTreeMap<[u32; 2], Vec<u32>>> {
    let mut edges: BTreeMap<[u32; 2], Vec<u32>> = BTreeMap::new();
    for &triangle in &mesh.triangles {
        let has = |&number: &u32| (number as usize) < mesh.vertices.len();
        triangle.iter().all(has).then_some(())?;
        for turned in 0..3 {
            let [a, b, apex] = [0, 1, 2].map(|at| triangle[(at + turned) % 3]);
            edges.entry([a.min(b), a.max(b)]).or_default().push(apex);
        }
    }
    Some(edges)
}

/// Whether what is seen of the mesh over an edge is seen as high or higher over others.
fn is_below_others(mesh: &TriangleMesh, ends: [u32; 2], apexes: &[u32]) -> bool {
    let at = |number: u32| mesh.vertices[number as usize];
    let [a, b] = ends.map(at);
    if a.truncate() == b.truncate() {
        // Its upper end is one of another edge, unless all of the triangle is upright above one place.
        return apexes
            .iter()
            .any(|&apex| at(apex).truncate() != a.truncate());
    }
    if apexes.iter().any(|&apex| stands_on(at(apex), a, b)) {
        return true;
    }
    match apexes {
        &[c, d] => bends_upwards(a, b, at(c), at(d)),
        _ => false,
    }
}

/// The foot of a mesh that is the border of all that is between its foot and itself: it is closed, and
/// no face but those at its foot looks down. `None` for others.
///
/// A vertical line from above enters such a solid at a face that looks up, and its winding number does
/// not fall again before the foot.
fn foot(mesh: &TriangleMesh) -> Option<f64> {
    let heights = mesh.vertices.iter().map(|vertex| vertex.z);
    let foot = heights.fold(f64::INFINITY, f64::min);
    let is_border = mesh.untriangulable_faces == 0
        && mesh.closedness() == Closedness::Closed
        && mesh.corners().all(|corners| {
            let [a, b, c] = corners.map(DVec3::truncate);
            turn(a, b, c) >= 0.0 || corners.iter().all(|corner| corner.z == foot)
        });
    is_border.then_some(foot)
}

/// Whether a mesh that rises from its foot has inside below all of an edge: a face at it looks up.
fn has_inside_below(mesh: &TriangleMesh, foot: f64, ends: [u32; 2], apexes: &[u32]) -> bool {
    let at = |number: u32| mesh.vertices[number as usize];
    let [a, b] = ends.map(at);
    apexes.iter().map(|&apex| at(apex)).any(|apex| {
        let is_upright = turn(a.truncate(), b.truncate(), apex.truncate()) == 0.0;
        !is_upright && [a, b, apex].iter().any(|corner| corner.z > foot)
    })
}

/// Whether a corner is above the line through two others, exactly, in a triangle that is upright.
fn stands_on(apex: DVec3, a: DVec3, b: DVec3) -> bool {
    if turn(a.truncate(), b.truncate(), apex.truncate()) != 0.0 {
        return false;
    }
    let along = (b - a).truncate().abs();
    let axis = usize::from(along.y > along.x);
    let upright = |corner: DVec3| DVec2::new(corner[axis], corner.z);
    let (first, last) = if a[axis] < b[axis] { (a, b) } else { (b, a) };
    turn(upright(first), upright(last), upright(apex)) > 0.0
}

/// Whether two triangles on both sides of an edge in plan meet in it at a valley, or are level.
fn bends_upwards(a: DVec3, b: DVec3, c: DVec3, d: DVec3) -> bool {
    let [of_c, of_d] = [c, d].map(|apex| turn(a.truncate(), b.truncate(), apex.truncate()));
    if of_c > 0.0 && of_d < 0.0 {
        side(&[a, b, c], d) >= 0.0
    } else if of_c < 0.0 && of_d > 0.0 {
        side(&[b, a, c], d) >= 0.0
    } else {
        false
    }
}
