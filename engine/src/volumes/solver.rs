//! [`VolumeSolver`], which finds the occlusion volumes of one occludee at a time.

use super::block::Block;
use super::lanes::{Cover, LaneFiller, Shadow};
use crate::{Box3d, Occluder, ShadowCaster, Street};
use geo::Area;
use glam::DVec2;
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

/// Length to width above which a block's lanes run along its length only.
const LONG_BLOCK: f64 = 3.0;

/// Smallest pieces of street that a volume must add, where the user names no worth.
const LEAST_PIECES: f64 = 4.0;

/// Bound on the volumes of one occludee, where the user names no worth; a tenth is usual.
const MOST_VOLUMES: f64 = 20_000.0;

/// How finely to look for volumes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VolumeOptions {
    /// Metres below which no lane is halved.
    pub smallest: f64,
    /// Square metres of street that each volume must add to what is already hidden.
    pub worth: f64,
    /// Metres beyond which nobody looks: eyes farther than this from the occludee are left out.
    pub range: Option<f64>,
}

impl VolumeOptions {
    /// The worth of a volume where none is asked for: enough for four smallest pieces, and in
    /// large scenes enough to keep the volumes of one occludee to some thousands.
    #[must_use]
    pub fn usual_worth(smallest: f64, streets: &[Street]) -> f64 {
        let area: f64 = streets
            .iter()
            .map(|street| street.area.unsigned_area())
            .sum();
        (LEAST_PIECES * smallest * smallest).max(area / MOST_VOLUMES)
    }
}

/// A box from all of which one feature hides another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OcclusionVolume {
    /// The feature that hides.
    pub occluder: i64,
    /// The feature that is hidden.
    pub occludee: i64,
    /// Where, metres.
    pub bounds: Box3d,
}

/// What hides, and in whose name.
#[derive(Debug)]
struct Caster {
    feature: i64,
    shape: ShadowCaster,
}

/// Occluders under a spatial index, and the blocks of street to look from.
#[derive(Debug)]
pub struct VolumeSolver {
    casters: Vec<Caster>,
    index: RTree<GeomWithData<Rectangle<[f64; 3]>, usize>>,
    blocks: Vec<Block>,
    options: VolumeOptions,
}

impl VolumeSolver {
    /// Prepares a scene. A feature may have several occluders.
    #[must_use]
    pub fn new(occluders: Vec<Occluder>, streets: &[Street], options: VolumeOptions) -> Self {
        let mut casters = Vec::with_capacity(occluders.len());
        let mut entries = Vec::with_capacity(occluders.len());
        for Occluder { feature, prism } in occluders {
            let Some(shape) = ShadowCaster::new(&prism) else {
                continue;
            };
            let Box3d { min, max } = prism.envelope();
            let bounds = Rectangle::from_corners(min.to_array(), max.to_array());
            entries.push(GeomWithData::new(bounds, casters.len()));
            casters.push(Caster { feature, shape });
        }
        Self {
            index: RTree::bulk_load(entries),
            blocks: Block::group(streets, options.smallest),
            casters,
            options,
        }
    }

    /// The volumes from which single occluders hide `envelope`, the outer envelope of the
    /// feature `occludee`. `None` as soon as `cancelled` says so.
    pub fn volumes(
        &self,
        occludee: i64,
        envelope: &Box3d,
        cancelled: impl Fn() -> bool,
    ) -> Option<Vec<OcclusionVolume>> {
        let mut found = Vec::new();
        for block in self
            .blocks
            .iter()
            .filter(|block| self.is_near(block, envelope))
        {
            if cancelled() {
                return None;
            }
            let shadows = without_contained(self.shadows(occludee, envelope, block));
            let (axis, cover) = self.best_cover(block, &shadows, &cancelled);
            found.extend(cover.pieces.iter().filter_map(|piece| {
                Some(OcclusionVolume {
                    occluder: self.casters[piece.occluder].feature,
                    occludee,
                    bounds: block.volume(axis, piece.lane, piece.span)?,
                })
            }));
        }
        (!cancelled()).then_some(found)
    }

    /// Whether someone in the block may look at the envelope.
    fn is_near(&self, block: &Block, envelope: &Box3d) -> bool {
        self.options
            .range
            .is_none_or(|range| block.eyes().distance(envelope) <= range)
    }

    /// The shadows over a block: only occluders between it and the occludee can cast one.
    fn shadows(&self, occludee: i64, envelope: &Box3d, block: &Block) -> Vec<Shadow> {
        let mut between = envelope.union(&block.eyes());
        // Grounded occluders hide below their own foot too.
        between.max.z = f64::MAX;
        let between = AABB::from_corners(between.min.to_array(), between.max.to_array());
        self.index
            .locate_in_envelope_intersecting(between)
            .map(|entry| entry.data)
            .filter(|&position| self.casters[position].feature != occludee)
            .filter_map(|position| {
                let caster = &self.casters[position].shape;
                let region = caster.umbra_in_band(envelope, block.band, block.window)?;
                let worth = self.options.worth;
                let [min, max] = region.rectangle();
                let area = || block.coverage.area(0, [min.y, max.y], [min.x, max.x]);
                (region.area() > worth && area() > worth).then_some(Shadow {
                    occluder: position,
                    region,
                })
            })
            .collect()
    }

    /// Fills the block with lanes along the axis that serves best.
    fn best_cover(
        &self,
        block: &Block,
        shadows: &[Shadow],
        cancelled: &dyn Fn() -> bool,
    ) -> (usize, Cover) {
        let shadows: Vec<&Shadow> = shadows.iter().collect();
        let size: DVec2 = block.window[1] - block.window[0];
        let VolumeOptions {
            worth, smallest, ..
        } = self.options;
        let along = |axis: usize| {
            let filler = LaneFiller {
                block,
                axis,
                worth,
                smallest,
                cancelled,
            };
            let across = 1 - axis;
            filler.cover([block.window[0][across], block.window[1][across]], &shadows)
        };
        if size.x > size.y * LONG_BLOCK {
            return (0, along(0));
        }
        if size.y > size.x * LONG_BLOCK {
            return (1, along(1));
        }
        let (x, y) = (along(0), along(1));
        if x.score(worth) >= y.score(worth) {
            (0, x)
        } else {
            (1, y)
        }
    }
}

/// The shadows that lie in no single other one: a narrow piece of a feature often hides no more
/// than a wide one does, and its shadow would be tried in every lane.
fn without_contained(mut shadows: Vec<Shadow>) -> Vec<Shadow> {
    shadows.sort_by(|a, b| b.region.area().total_cmp(&a.region.area()));
    let mut kept: Vec<Shadow> = Vec::with_capacity(shadows.len());
    for shadow in shadows {
        let contains = |other: &Shadow| other.region.contains(&shadow.region);
        if !kept.iter().any(contains) {
            kept.push(shadow);
        }
    }
    kept
}
