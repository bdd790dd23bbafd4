//! [`inner_envelope`], the largest axis-aligned box inside a mesh.

use glam::DVec3;

use super::certificate::{is_inside, winds_around};
use super::free_grid::FreeGrid;
use super::growth::Growth;
use super::mesh_defect::MeshDefect;
use super::triangle_mesh::TriangleMesh;
use crate::Box3d;

/// A box whose bottom is within this of the mesh's lowest vertex stands on the mesh's own foot,
/// metres. Delivered ground faces are level to a few millimetres.
pub const GROUND_TOLERANCE: f64 = 0.01;

/// Cells a side of the search grids: the second is laid only where the first finds nothing.
const GRIDS: [usize; 2] = [24, FreeGrid::MOST_CELLS];

/// How many free spaces that turn out to be outside or hollow are looked at before the search
/// gives up; only a mesh that is mostly hollows has so many.
const MOST_REJECTED: usize = 64;

/// How often the step halves in which lengths are traded. On 1,115 real buildings more halvings won
/// less than 0.1 % of volume, and a grid of 60 cells 0.5 % for twenty times the time.
const TRADES: usize = 4;

/// The first shrinkage tried on a box that its certificate refuses, metres.
const FIRST_SHRINK: f64 = 1e-6;

/// From this shrinkage on, sides that sit on a vertex's coordinate move too, metres.
const SHRINK_ALL: f64 = 1e-3;

/// A mesh's inner envelope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InnerEnvelope {
    /// The box; its open inside lies within the solid.
    pub bounds: Box3d,
    /// Whether the box stands on the mesh's own foot: its bottom is within [`GROUND_TOLERANCE`] of
    /// the lowest vertex.
    pub grounded: bool,
}

/// The largest axis-aligned box inside a closed mesh, nearly.
///
/// *Always inside*: no triangle meets the open box, and the winding number in it is 1 or more. A
/// face may lie flush on a side, so the inner envelope of a mesh that is an axis-aligned box is
/// that box, bit for bit; slanted faces keep some micrometres away.
///
/// *Nearly the largest*: at least as large as every box of whole cells of a grid of 24 cells a side
/// over the mesh's envelope (less micrometres), and larger in practice, since each side is then
/// moved to its limit and lengths are traded against each other. Inside is where the winding number
/// is 1 or more, so overlapping parts count as solid and hollows do not; the faces within overlaps
/// still bound the box.
///
/// # Errors
/// [`MeshDefect`] when the mesh bounds no solid, or one too thin for a grid of 60 cells a side.
pub fn inner_envelope(mesh: &TriangleMesh) -> Result<InnerEnvelope, MeshDefect> {
    mesh.check_closed()?;
    let triangles: Vec<[DVec3; 3]> = mesh.corners().collect();
    let envelope = mesh.envelope().ok_or(MeshDefect::NoFaces)?;
    if !envelope.size().is_finite() {
        return Err(MeshDefect::NotFinite);
    }
    if envelope.size().min_element() == 0.0 {
        return Err(MeshDefect::ZeroVolume);
    }
    let seed = GRIDS
        .iter()
        .find_map(|&cells| find_seed(mesh, &triangles, &envelope, cells));
    let seed = seed.ok_or_else(|| why_no_seed(mesh, &envelope))?;
    let grown = Growth::new(triangles.into_iter(), envelope).grow(seed, TRADES);
    let certified = shrink_until_inside(grown, mesh).or_else(|| shrink_until_inside(seed, mesh));
    let bounds = certified.ok_or(MeshDefect::TooThin)?;
    let grounded = bounds.min.z - envelope.min.z <= GROUND_TOLERANCE;
    Ok(InnerEnvelope { bounds, grounded })
}

/// The largest box of whole grid cells inside the mesh.
///
/// Free cells that hang together are all inside or all outside, so one winding number decides about
/// a box and, when it is outside, about the whole space around it.
fn find_seed(
    mesh: &TriangleMesh,
    triangles: &[[DVec3; 3]],
    envelope: &Box3d,
    cells: usize,
) -> Option<Box3d> {
    let mut grid = FreeGrid::new(triangles, envelope, cells)?;
    for _ in 0..MOST_REJECTED {
        let largest = grid.largest_box()?;
        let bounds = grid.bounds(&largest);
        if winds_around(mesh, bounds.center()) {
            return Some(bounds);
        }
        grid.reject(&largest);
    }
    None
}

/// Why a closed mesh holds nothing that was looked for.
pub fn why_no_seed(mesh: &TriangleMesh, envelope: &Box3d) -> MeshDefect {
    // Rounding leaves some 1e-16 of the envelope's volume for a mesh that holds nothing.
    let nothing = 1e-12 * envelope.volume();
    match mesh.signed_volume() {
        volume if volume < -nothing => MeshDefect::InsideOut,
        volume if volume <= nothing => MeshDefect::ZeroVolume,
        _ => MeshDefect::TooThin,
    }
}

/// The box itself if it is certified, or else the first certified one among boxes that shrink by
/// doubling steps. Sides on a vertex's coordinate are exact and stay while steps are small.
fn shrink_until_inside(bounds: Box3d, mesh: &TriangleMesh) -> Option<Box3d> {
    let exact_low = on_vertices(bounds.min, mesh);
    let exact_high = on_vertices(bounds.max, mesh);
    let mut shrunk = bounds;
    let mut step = FIRST_SHRINK;
    while shrunk.min.cmplt(shrunk.max).all() {
        if is_inside(&shrunk, mesh) {
            return Some(shrunk);
        }
        let moves = |exact: [bool; 3]| {
            let by = |axis: usize| {
                if exact[axis] && step < SHRINK_ALL {
                    0.0
                } else {
                    step
                }
            };
            DVec3::from_array(std::array::from_fn(by))
        };
        shrunk = Box3d {
            min: bounds.min + moves(exact_low),
            max: bounds.max - moves(exact_high),
        };
        step *= 2.0;
    }
    None
}

/// For each axis, whether some vertex has the corner's coordinate.
fn on_vertices(corner: DVec3, mesh: &TriangleMesh) -> [bool; 3] {
    std::array::from_fn(|axis| {
        mesh.vertices
            .iter()
            .any(|vertex| vertex[axis] == corner[axis])
    })
}
