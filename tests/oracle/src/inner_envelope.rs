//! The check of a stored inner envelope.

use thiserror::Error;

use crate::aabb::{Aabb, Point};
use crate::exact::rational;
use crate::ground::GROUND_TOLERANCE;
use crate::mesh::{Mesh, Triangle};
use crate::overlap::triangle_meets_interior;
use crate::winding::winding_number;

/// Why a box is no inner envelope of a mesh.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum InnerFault {
    /// The box is flat, not finite, or so thin that no `f64` lies inside.
    #[error("the inner envelope has no volume: {aabb:?}")]
    NoVolume {
        /// The box as given.
        aabb: Aabb,
    },
    /// The mesh does not bound a solid, so it has no inside.
    #[error("the mesh is not closed")]
    OpenMesh,
    /// A triangle of the mesh reaches into the box.
    #[error("triangle {triangle} of the mesh reaches into the inner envelope")]
    TriangleInside {
        /// The position of the first such triangle.
        triangle: usize,
    },
    /// The centre of the box is not inside the solid.
    #[error("the mesh winds {winding} times around the centre {centre:?} of the inner envelope")]
    CentreOutside {
        /// The centre of the box.
        centre: Point,
        /// The winding number of the mesh there.
        winding: i32,
    },
    /// A box claimed grounded starts above the foot of the mesh.
    #[error("the inner envelope starts at {bottom}, above the foot of the mesh at {foot}")]
    NotGrounded {
        /// The bottom of the box.
        bottom: f64,
        /// The height of the lowest vertex.
        foot: f64,
    },
}

/// Checks that the open box `inner` lies wholly inside the solid that `mesh` bounds, and, if it is
/// claimed `grounded`, that it starts no more than [`GROUND_TOLERANCE`] above the lowest vertex.
///
/// Exact: no triangle meets the open box, so the winding number is the same all over it, and it is
/// 1 or more at the centre. Faces of the box may touch the mesh.
///
/// # Errors
/// The first fault found, in the order of [`InnerFault`].
pub fn check_inner_envelope(mesh: &Mesh, inner: &Aabb, grounded: bool) -> Result<(), InnerFault> {
    let centre: Point = std::array::from_fn(|axis| 0.5 * inner.min[axis] + 0.5 * inner.max[axis]);
    if !inner.is_proper() || !inner.interior_contains(centre) {
        return Err(InnerFault::NoVolume { aabb: *inner });
    }
    let triangles = mesh
        .corners()
        .filter(|_| mesh.is_closed())
        .ok_or(InnerFault::OpenMesh)?;
    check_inside(&triangles, inner, centre)?;
    if grounded {
        check_grounded(&triangles, inner)
    } else {
        Ok(())
    }
}

/// Checks that the surface stays out of the box and winds around it.
fn check_inside(triangles: &[Triangle], inner: &Aabb, centre: Point) -> Result<(), InnerFault> {
    if let Some(triangle) = triangles
        .iter()
        .position(|triangle| triangle_meets_interior(triangle, inner))
    {
        return Err(InnerFault::TriangleInside { triangle });
    }
    // The centre is not on the surface, which stays out of the box.
    let winding = winding_number(triangles, &centre).unwrap_or(0);
    if winding < 1 {
        return Err(InnerFault::CentreOutside { centre, winding });
    }
    Ok(())
}

/// Checks that the box starts at the building's own foot.
fn check_grounded(triangles: &[Triangle], inner: &Aabb) -> Result<(), InnerFault> {
    let (bottom, foot) = (inner.min[2], Mesh::bounds(triangles).min[2]);
    if rational(bottom) - rational(foot) > rational(GROUND_TOLERANCE) {
        return Err(InnerFault::NotGrounded { bottom, foot });
    }
    Ok(())
}
