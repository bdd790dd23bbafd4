//! What can truly be seen.

use std::collections::HashSet;

use oracle::{RayCaster, Sight, surface_samples};
use rayon::prelude::*;

use super::item_buffer::{ItemBuffer, Sightings};
use super::surroundings::Surroundings;
use crate::failure::Failure;
use crate::scene::{Feature, number};

/// Points on each feature that no pixel shows to aim rays at.
const RAYS: usize = 64;

/// The features in range that an exact ray meets: through the pixel that shows a feature, or, where
/// none does, to a point of its surface. Embree only chooses the rays, so that its rounding shows
/// nothing that is hidden.
pub fn visible(
    around: &Surroundings,
    buffer: &ItemBuffer,
    sightings: &Sightings,
    eye: [f64; 3],
) -> Result<HashSet<i64>, Failure> {
    let caster = RayCaster::new(&around.surfaces.triangles).map_err(Failure::machine)?;
    let is_seen = |(position, feature): &(usize, &Feature)| {
        let number = number(*position);
        let meets = |direction| {
            let hit = caster.first_hit(eye, direction);
            hit.is_some_and(|hit| hit.ids.contains(&number))
        };
        let reaches = |target| caster.is_clear(eye, target, Some(number)) == Sight::Clear;
        let targets = || {
            let surface = feature.surface().unwrap_or_default();
            buffer.aim(
                number,
                &surface_samples(&surface, RAYS, feature.id.cast_unsigned()),
            )
        };
        sightings.of(number).is_some_and(meets) || targets().into_iter().any(reaches)
    };
    let features = around.features.par_iter().enumerate();
    let seen = features.filter(|(_, feature)| around.is_in_range(feature));
    Ok(seen
        .filter(is_seen)
        .map(|(_, feature)| feature.id)
        .collect())
}
