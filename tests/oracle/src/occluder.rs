//! What single occluders hide from a point: the limit that occlusion volumes can reach.

use crate::aabb::{Aabb, Point};
use crate::bvh::{Bvh, Probe};
use crate::determinant::subtract;
use crate::ray_caster::{MAX_COORDINATE, is_usable};
use crate::segment::segment_meets_interior;

/// The inner envelope of a feature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Occluder {
    /// The feature.
    pub id: u32,
    /// Its inner envelope.
    pub inner: Aabb,
    /// Whether the ground under it is solid down to any depth.
    pub grounded: bool,
}

/// Whether `occluder` alone hides all of `occludee` from `eye`: the open segments from the eye to
/// the eight corners meet the open occluder, which reaches down without bound if `grounded`.
/// Exact. An eye inside the occluder is hidden from nothing.
#[must_use]
pub fn single_occluder_hides(eye: Point, occluder: &Aabb, grounded: bool, occludee: &Aabb) -> bool {
    solid_hides(eye, &occluder.with_ground(grounded), occludee)
}

/// The same for an occluder with its ground.
fn solid_hides(eye: Point, solid: &Aabb, occludee: &Aabb) -> bool {
    occludee.is_proper()
        && may_hide(eye, solid, occludee)
        && !solid.interior_contains(eye)
        && occludee
            .corners()
            .iter()
            .all(|&corner| segment_meets_interior(eye, corner, solid))
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
        .find(|occluder| {
            solid_hides(
                eye,
                &occluder.inner.with_ground(occluder.grounded),
                occludee,
            )
        })
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
    /// An index over `occluders`; those that cannot hide (flat, not finite, absurdly far) are left
    /// out.
    #[must_use]
    pub fn new(occluders: &[Occluder]) -> Self {
        let usable: Vec<Occluder> = occluders
            .iter()
            .filter(|occluder| {
                let inner = &occluder.inner;
                is_usable(inner.min) && is_usable(inner.max) && inner.has_volume()
            })
            .copied()
            .collect();
        let boxes: Vec<Aabb> = usable
            .iter()
            .map(|occluder| searched(&occluder.inner.with_ground(occluder.grounded)))
            .collect();
        let bvh = Bvh::new(&boxes);
        let occluders = bvh
            .items()
            .iter()
            .map(|&item| usable[item as usize])
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
fn searched(solid: &Aabb) -> Aabb {
    let [x, y, z] = solid.min;
    Aabb {
        min: [x, y, z.max(-MAX_COORDINATE)],
        max: solid.max,
    }
}
