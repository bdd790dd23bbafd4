//! What an observer looks at: [`ViewCone`], [`ViewSector`], the [`Frustum`] of a [`Camera`], and the
//! ball all round ([`in_range`]).
//! Each asks one question of a box: do they share a point? The answers are exact up to the
//! tolerances named here, and err to "yes".

mod camera;
mod frustum;
mod plan_wedge;
mod view_cone;
mod view_projection;
mod view_sector;

pub use camera::Camera;
pub use frustum::Frustum;
pub use plan_wedge::PlanWedge;
pub use view_cone::ViewCone;
pub use view_projection::{DepthRange, MatrixDefect};
pub use view_sector::ViewSector;

use crate::Box3d;
use glam::DVec3;

/// Relative slack on squared distances and on cosines: some thousand roundings of an `f64`,
/// far below a millimetre at any range in a city.
const RELATIVE_TOLERANCE: f64 = 1e-12;

/// Whether a box has a point within `range` metres (Euclidean) of the eye.
#[must_use]
pub fn in_range(eye: DVec3, range: f64, target: &Box3d) -> bool {
    within(target.distance_to_point(eye).powi(2), range)
}

/// The part of a box that may be within range of the eye, relative to the eye; `None` when no
/// point is. Boxes far larger than the range are cut to twice the range, a cut that no point in
/// range can notice: rounding over their full extent would lose what is near.
fn near_part(eye: DVec3, range: f64, target: &Box3d) -> Option<Box3d> {
    let reach = DVec3::splat(2.0 * range);
    let local = Box3d {
        min: target.min - eye,
        max: target.max - eye,
    };
    let nearest = DVec3::ZERO.clamp(local.min, local.max);
    within(nearest.length_squared(), range).then(|| Box3d {
        min: local.min.max(-reach),
        max: local.max.min(reach),
    })
}

/// Whether a squared distance is within `range`.
fn within(distance_2: f64, range: f64) -> bool {
    distance_2 <= range * range * (1.0 + RELATIVE_TOLERANCE)
}
