//! [`Surroundings`], all that can be seen from a place within a range, and all that can hide it.

use postgres::Client;

use crate::database::quoted;
use crate::failure::Failure;
use crate::scene::{self, Feature};
use crate::sql_types::Box3d;

/// What is around a box in which eyes are. It is as large as the range and the density of the city make
/// it, however large the city is.
pub struct Surroundings {
    /// How far eyes see, metres.
    pub range: f64,
    /// Features in range and those that may hide them, by number.
    pub features: Vec<Feature>,
}

impl Surroundings {
    /// Reads them. What hides a feature in range lies in the box around the place and all of those.
    pub fn load(
        client: &mut Client,
        scene: &str,
        place: &Box3d,
        range: f64,
    ) -> Result<Self, Failure> {
        let area = area(client, scene, place, range)?;
        let features = scene::load_over(client, scene, area)?;
        Ok(Self { range, features })
    }

    /// Whether a feature is in range of an eye, as visible_features counts it.
    #[cfg(feature = "embree")]
    pub fn is_in_range(&self, feature: &Feature, eye: [f64; 3]) -> bool {
        feature.envelope.distance(eye) <= self.range
    }

    /// The features in range that an item buffer shows.
    #[cfg(feature = "embree")]
    pub fn shown(
        &self,
        sightings: &super::item_buffer::Sightings,
        eye: [f64; 3],
    ) -> std::collections::HashSet<i64> {
        let feature = |number: u32| self.features.get((number as usize).checked_sub(1)?);
        sightings
            .numbers()
            .filter_map(feature)
            .filter(|feature| self.is_in_range(feature, eye))
            .map(|feature| feature.id)
            .collect()
    }
}

/// Where all of the features in range lie, and the place; at all heights, because the ground under a
/// feature hides too.
fn area(client: &mut Client, scene: &str, place: &Box3d, range: f64) -> Result<Box3d, Failure> {
    let statement = format!(
        "SELECT occlusion.extent(f.envelope) FROM {}.feature AS f WHERE f.envelope \
         OPERATOR(occlusion.&&) occlusion.expand($1, $2)",
        quoted(scene)
    );
    let extent: Option<Box3d> = client.query_one(&statement, &[place, &range])?.get(0);
    let extent = extent.unwrap_or(*place);
    let ([x, y, _], [right, back, _]) = (extent.min, extent.max);
    Ok(Box3d {
        min: [x.min(place.min[0]), y.min(place.min[1]), f64::MIN],
        max: [right.max(place.max[0]), back.max(place.max[1]), f64::MAX],
    })
}
