//! The check of a stored occlusion volume.

use thiserror::Error;

use crate::aabb::{Aabb, Point};
use crate::interval::Interval;
use crate::prism::{Depths, Prism};

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
    /// The occluder has no prism to hide anything with.
    #[error("the occluder is nowhere solid")]
    NoOccluder,
    /// Each prism is missed by a segment between two corners.
    #[error(
        "the segment from {volume_corner:?} to {occludee_corner:?} misses prism {prism} of the \
         occluder, which {met} of the 64 segments meet, more than any other"
    )]
    SegmentMisses {
        /// The position of the prism that most segments meet.
        prism: usize,
        /// How many of the 64 segments meet it.
        met: usize,
        /// The end of the first that does not, at the volume.
        volume_corner: Point,
        /// Its end at the occludee.
        occludee_corner: Point,
    },
}

/// Checks that everything of `occludee` is hidden by one of the prisms `occluder` alone from all
/// points of `volume`.
///
/// The umbra of a prism is convex, so this is so exactly when the 64 open segments between a corner
/// of the volume and a corner of the occludee meet the open prism, which reaches down without bound
/// if it is grounded. The boxes may be flat. Points of the volume within the prism count as hidden:
/// they are outside the view region.
///
/// # Errors
/// The first segment that misses the prism that comes nearest to hiding, a box that is none, or a
/// corner that both have.
pub fn check_volume(volume: &Aabb, occluder: &[Prism], occludee: &Aabb) -> Result<(), VolumeFault> {
    for (role, aabb) in [("occlusion volume", volume), ("occludee", occludee)] {
        if !aabb.is_proper() {
            return Err(VolumeFault::NotABox { role, aabb: *aabb });
        }
    }
    let ends = [volume.corners(), occludee.corners()];
    if let Some(&corner) = ends[0].iter().find(|corner| ends[1].contains(corner)) {
        return Err(VolumeFault::CommonCorner { corner });
    }
    let hides = |prism: &Prism| Segments::new(prism, ends).missing().next().is_none();
    if occluder.iter().any(hides) {
        return Ok(());
    }
    Err(near_miss(occluder, ends).unwrap_or(VolumeFault::NoOccluder))
}

/// The fault of the prism that most segments meet.
fn near_miss(occluder: &[Prism], ends: [[Point; 8]; 2]) -> Option<VolumeFault> {
    let (prism, nearest) = occluder
        .iter()
        .map(|prism| Segments::new(prism, ends))
        .enumerate()
        .min_by_key(|(_, segments)| segments.missing().count())?;
    let [volume_corner, occludee_corner] = nearest.missing().next()?;
    Some(VolumeFault::SegmentMisses {
        prism,
        met: 64 - nearest.missing().count(),
        volume_corner,
        occludee_corner,
    })
}

/// The 64 segments between corners, against one prism.
struct Segments<'a> {
    prism: &'a Prism,
    ends: [[Point; 8]; 2],
    depths: [[Depths<Interval>; 8]; 2],
}

impl<'a> Segments<'a> {
    fn new(prism: &'a Prism, ends: [[Point; 8]; 2]) -> Self {
        let depths = ends.map(|corners| corners.map(|corner| prism.depths(corner)));
        Self {
            prism,
            ends,
            depths,
        }
    }

    /// The segments that miss the prism.
    fn missing(&self) -> impl Iterator<Item = [Point; 2]> {
        let pairs = (0..64).map(|pair| (pair / 8, pair % 8));
        pairs.filter_map(|(i, j)| {
            let ends = [self.ends[0][i], self.ends[1][j]];
            let depths = [&self.depths[0][i], &self.depths[1][j]];
            (!self.prism.meets(ends, depths)).then_some(ends)
        })
    }
}
