//! What single occluders hide from a point: the limit that occlusion volumes can reach.

use crate::aabb::{Aabb, Point, is_finite};
use crate::bvh::{Bvh, Probe};
use crate::determinant::subtract;
use crate::prism::Prism;
use crate::ray_caster::{MAX_COORDINATE, is_usable};
use crate::segment::segment_meets_interior;

/// A convex part of the solid of a feature.
#[derive(Clone, Debug, PartialEq)]
pub struct Occluder {
    /// The feature.
    pub id: u32,
    /// What of it hides.
    pub solid: Prism,
}

/// Whether `occluder` alone hides all of `occludee` from `eye`: the open segments from the eye to
/// the eight corners meet the open prism, which reaches down without bound if it is grounded.
/// Exact. An eye inside the occluder is hidden from nothing.
#[must_use]
pub fn single_occluder_hides(eye: Point, occluder: &Prism, occludee: &Aabb) -> bool {
    is_finite(eye)
        && occludee.is_proper()
        && may_hide(eye, &occluder.bounds, occludee)
        && occludee
            .corners()
            .iter()
            .all(|&corner| segment_meets_interior(eye, corner, occluder))
        && !occluder.interior_contains(eye)
}

/// Whether the occluder reaches into the box around the eye and the occludee, as it must.
#[inline]
fn may_hide(eye: Point, solid: &Aabb, occludee: &Aabb) -> bool {
    (0..3).all(|axis| {
        solid.max[axis] > occludee.min[axis].min(eye[axis])
            && solid.min[axis] < occludee.max[axis].max(eye[axis])
    })
}

/// The first of `occluders` that alone hides all of `occludee`, the outer envelope of the feature
/// `occludee_id`, from `eye`. A feature never hides itself.
#[must_use]
pub fn box_hidden_by_any<'a>(
    eye: Point,
    occluders: impl IntoIterator<Item = &'a Occluder>,
    occludee_id: u32,
    occludee: &Aabb,
) -> Option<u32> {
    occluders
        .into_iter()
        .filter(|occluder| occluder.id != occludee_id)
        .find(|occluder| single_occluder_hides(eye, &occluder.solid, occludee))
        .map(|occluder| occluder.id)
}

/// Many occluders, searched along lines of sight.
#[derive(Clone, Debug)]
pub struct OccluderIndex {
    bvh: Bvh,
    /// In the order of the leaves.
    occluders: Vec<Occluder>,
}

impl OccluderIndex {
    /// An index over `occluders`.
    #[must_use]
    pub fn new(occluders: &[Occluder]) -> Self {
        let boxes: Vec<Aabb> = occluders
            .iter()
            .map(|occluder| searched(&occluder.solid.bounds))
            .collect();
        let bvh = Bvh::new(&boxes);
        let occluders = bvh
            .items()
            .iter()
            .map(|&item| occluders[item as usize].clone())
            .collect();
        Self { bvh, occluders }
    }

    /// An occluder that alone hides all of `occludee`, as [`box_hidden_by_any`] finds; where
    /// several do, any of them.
    #[must_use]
    pub fn hiding(&self, eye: Point, occludee_id: u32, occludee: &Aabb) -> Option<u32> {
        if !is_usable(eye) || !is_usable(occludee.min) || !is_usable(occludee.max) {
            return None;
        }
        // Whatever hides the box meets the segment to each of its corners, so one is enough.
        let probe = Probe::new(eye, subtract(occludee.max, eye));
        let mut found = None;
        self.bvh.walk(&probe, 1.0, |places| {
            found = box_hidden_by_any(eye, &self.occluders[places], occludee_id, occludee);
            if found.is_some() { None } else { Some(1.0) }
        });
        found
    }
}

/// The box with a finite bottom, below any eye that is answered.
pub(crate) fn searched(solid: &Aabb) -> Aabb {
    let [x, y, z] = solid.min;
    Aabb {
        min: [x, y, z.max(-MAX_COORDINATE)],
        max: solid.max,
    }
}
