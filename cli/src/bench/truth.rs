//! [`Truth`], what can truly be seen.

use std::collections::HashSet;

use oracle::{RayCaster, Sight, surface_samples};
use rayon::prelude::*;

use super::item_buffer::{ItemBuffer, Sightings};
use crate::failure::Failure;
use crate::scene::{Feature, Surfaces, number};

/// Points on each feature that no pixel shows to aim rays at.
const RAYS: usize = 64;

/// Exact rays among the surfaces of features.
pub struct Truth<'a> {
    features: &'a [Feature],
    caster: RayCaster,
}

impl<'a> Truth<'a> {
    /// That of all features whose surfaces these are.
    pub fn new(features: &'a [Feature], surfaces: &Surfaces) -> Result<Self, Failure> {
        let caster = RayCaster::new(&surfaces.triangles).map_err(Failure::machine)?;
        Ok(Self { features, caster })
    }

    /// The features, of those that are asked for, that an exact ray meets: through the pixel that shows a
    /// feature, or, where none does, to a point of its surface. Embree only chooses the rays, so that its
    /// rounding shows nothing that is hidden.
    pub fn visible(
        &self,
        buffer: &ItemBuffer,
        sightings: &Sightings,
        is_asked: impl Fn(&Feature) -> bool + Sync,
    ) -> HashSet<i64> {
        let is_seen = |(position, feature): &(usize, &Feature)| {
            let number = number(*position);
            let meets = |direction| {
                let hit = self.caster.first_hit(buffer.eye, direction);
                hit.is_some_and(|hit| hit.ids.contains(&number))
            };
            let reaches =
                |target| self.caster.is_clear(buffer.eye, target, Some(number)) == Sight::Clear;
            let targets = || {
                let surface = feature.surface().unwrap_or_default();
                buffer.aim(
                    number,
                    &surface_samples(&surface, RAYS, feature.id.cast_unsigned()),
                )
            };
            sightings.of(number).is_some_and(meets) || targets().into_iter().any(reaches)
        };
        let features = self.features.par_iter().enumerate();
        let asked = features.filter(|(_, feature)| is_asked(feature));
        asked
            .filter(is_seen)
            .map(|(_, feature)| feature.id)
            .collect()
    }
}
