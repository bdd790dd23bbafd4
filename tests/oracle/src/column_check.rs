//! The check of a stored solid column.

use thiserror::Error;

use crate::aabb::Point;
use crate::column::Column;
use crate::exact::rational;
use crate::footprint::ShapeFault;
use crate::ground::GROUND_TOLERANCE;
use crate::mesh::{Mesh, Triangle};
use crate::number::middle;
use crate::section::{Heights, triangle_meets_solid};
use crate::test_point::{TestPoint, raised};
use crate::winding::winding_number;

/// Why a column is not inside the solid of a mesh.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum ColumnFault {
    /// The column has no proper shape.
    #[error(transparent)]
    Shape(#[from] ShapeFault),
    /// The mesh does not bound a solid, so it has no inside.
    #[error("the mesh is not closed")]
    OpenMesh,
    /// A triangle of the mesh reaches into the column.
    #[error("triangle {triangle} of the mesh, {corners:?}, reaches into the column")]
    TriangleInside {
        /// The position of the first such triangle.
        triangle: usize,
        /// Its corners.
        corners: Triangle,
    },
    /// A point of the column is not inside the solid.
    #[error("the mesh winds {winding} times around the point {point:?} of the column")]
    PointOutside {
        /// The point, rounded where it lies between `f64` values.
        point: Point,
        /// The winding number of the mesh there.
        winding: i32,
    },
    /// A triangle of the mesh that is not at its foot reaches below a column claimed grounded.
    #[error(
        "triangle {triangle} of the mesh, {corners:?}, is not at its foot and reaches into the \
         ground of the column"
    )]
    NotGrounded {
        /// The position of the first such triangle.
        triangle: usize,
        /// Its corners.
        corners: Triangle,
    },
}

/// Checks that the open column lies wholly inside the solid that `mesh` bounds, and, if it is
/// claimed grounded, that it stands on the foot of the mesh as [`check_grounded`] has it.
///
/// Exact: no triangle meets the open column, so the winding number is the same all over each of its
/// connected pieces, and it is 1 or more at a point of each. Faces may touch the mesh.
///
/// # Errors
/// The first fault found.
pub fn check_column(mesh: &Mesh, column: &Column) -> Result<(), ColumnFault> {
    let triangles = solid_triangles(mesh)?;
    let heights = Heights {
        bottom: column.bottom,
        top: column.top,
    };
    if let Some((triangle, corners)) = first_inside(&triangles, column, heights) {
        return Err(ColumnFault::TriangleInside { triangle, corners });
    }
    check_witnesses(&triangles, column, heights)?;
    if column.grounded {
        check_ground(&triangles, column)
    } else {
        Ok(())
    }
}

/// Checks that the mesh itself shows the ground under a column to be its own foot, claimed or not:
/// no triangle but those within [`GROUND_TOLERANCE`] of the lowest vertex meets the open column
/// made longer without bound at the bottom, and what lies between that height and the top is
/// inside. So each vertical line down from the column leaves the mesh through its foot, and
/// [`solid_ground`](crate::solid_ground) has ground there. Exact.
///
/// # Errors
/// The first fault found.
pub fn check_grounded(mesh: &Mesh, column: &Column) -> Result<(), ColumnFault> {
    check_ground(&solid_triangles(mesh)?, column)
}

fn check_ground(triangles: &[Triangle], column: &Column) -> Result<(), ColumnFault> {
    let level = rational(Mesh::bounds(triangles).min[2]) + rational(GROUND_TOLERANCE);
    let is_foot = |triangle: &Triangle| triangle.iter().all(|corner| rational(corner[2]) <= level);
    let heights = Heights {
        bottom: f64::NEG_INFINITY,
        top: column.top,
    };
    if let Some((triangle, corners)) = triangles.iter().copied().enumerate().find(|(_, corners)| {
        triangle_meets_solid(corners, &column.footprint, heights) && !is_foot(corners)
    }) {
        return Err(ColumnFault::NotGrounded { triangle, corners });
    }
    // The foot itself may reach into a column that starts or ends within the tolerance.
    let above_foot = Heights {
        bottom: column.bottom.max(level.to_f64().value().min(column.top)),
        top: column.top,
    };
    check_witnesses(triangles, column, above_foot)
}

/// The triangles of a mesh that has an inside.
pub(crate) fn solid_triangles(mesh: &Mesh) -> Result<Vec<Triangle>, ColumnFault> {
    mesh.corners()
        .filter(|_| mesh.is_closed())
        .ok_or(ColumnFault::OpenMesh)
}

/// The first triangle that meets the open solid over the footprint.
fn first_inside(
    triangles: &[Triangle],
    column: &Column,
    heights: Heights,
) -> Option<(usize, Triangle)> {
    let inside = |(_, triangle): &(usize, Triangle)| {
        triangle_meets_solid(triangle, &column.footprint, heights)
    };
    triangles.iter().copied().enumerate().find(inside)
}

/// Checks that a point at mid-height of each connected piece of the column is inside.
fn check_witnesses(
    triangles: &[Triangle],
    column: &Column,
    heights: Heights,
) -> Result<(), ColumnFault> {
    let height = middle(&rational(heights.bottom), &rational(heights.top));
    for spot in column.footprint.witnesses() {
        let point = raised(&spot, height.clone());
        // A point on the surface is of a column thinner than the tolerance of the foot.
        let winding = winding_number(triangles, &point).unwrap_or(1);
        if winding < 1 {
            return Err(ColumnFault::PointOutside {
                point: point.nearest(),
                winding,
            });
        }
    }
    Ok(())
}
