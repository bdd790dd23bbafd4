//! The check of a stored occlusion volume.

use thiserror::Error;

use crate::aabb::{Aabb, Point};
use crate::segment::segment_meets_interior;

/// Why an occlusion volume is not inside the umbra.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum VolumeFault {
    /// A box with an infinite or missing bound, or with its corners out of order.
    #[error("the {role} is not a box: {aabb:?}")]
    NotABox {
        /// Which of the boxes: "occlusion volume" or "occludee".
        role: &'static str,
        /// The box as given.
        aabb: Aabb,
    },
    /// A corner of the volume is a corner of the occludee, so nothing lies between them.
    #[error("corner {corner:?} of the volume is a corner of the occludee")]
    CommonCorner {
        /// The common corner.
        corner: Point,
    },
    /// A segment between two corners misses the interior of the occluder.
    #[error("the segment from {volume_corner:?} to {occludee_corner:?} misses the occluder")]
    SegmentMisses {
        /// The end at the volume.
        volume_corner: Point,
        /// The end at the occludee.
        occludee_corner: Point,
    },
}

/// Checks that everything of `occludee` is hidden by `occluder` alone from all points of `volume`.
///
/// The umbra is convex, so this is so exactly when the 64 open segments between a corner of the
/// volume and a corner of the occludee meet the open occluder, which reaches down without bound
/// if it is grounded. The boxes may be flat. Points of the volume within the occluder count as
/// hidden: they are outside the view region.
///
/// # Errors
/// The first pair of corners between which nothing hides, or a box that is none.
pub fn check_volume(
    volume: &Aabb,
    occluder: &Aabb,
    grounded: bool,
    occludee: &Aabb,
) -> Result<(), VolumeFault> {
    for (role, aabb) in [("occlusion volume", volume), ("occludee", occludee)] {
        if !aabb.is_proper() {
            return Err(VolumeFault::NotABox { role, aabb: *aabb });
        }
    }
    let solid = occluder.with_ground(grounded);
    let occludee_corners = occludee.corners();
    for volume_corner in volume.corners() {
        for occludee_corner in occludee_corners {
            check_pair(volume_corner, occludee_corner, &solid)?;
        }
    }
    Ok(())
}

/// Checks one of the 64 segments.
fn check_pair(
    volume_corner: Point,
    occludee_corner: Point,
    solid: &Aabb,
) -> Result<(), VolumeFault> {
    if volume_corner == occludee_corner {
        return Err(VolumeFault::CommonCorner {
            corner: volume_corner,
        });
    }
    if !segment_meets_interior(volume_corner, occludee_corner, solid) {
        return Err(VolumeFault::SegmentMisses {
            volume_corner,
            occludee_corner,
        });
    }
    Ok(())
}
