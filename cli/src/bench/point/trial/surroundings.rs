//! [`Surroundings`], all that can be seen from an eye within a range, and all that can hide it.

use std::collections::HashSet;

use postgres::Client;

use super::item_buffer::Sightings;
use crate::database::quoted;
use crate::failure::Failure;
use crate::scene::{self, Feature, Surfaces};
use crate::sql_types::{Box3d, Point3d};

/// What is around an eye. It is as large as the range and the density of the city make it, however
/// large the city is.
pub struct Surroundings {
    eye: [f64; 3],
    range: f64,
    /// Features in range and those that may hide them, by number.
    pub features: Vec<Feature>,
    /// Their surfaces, and the ground under them.
    pub surfaces: Surfaces,
}

impl Surroundings {
    /// Reads them. What hides a feature in range lies in the box around the eye and all of those.
    pub fn load(
        client: &mut Client,
        scene: &str,
        eye: [f64; 3],
        range: f64,
    ) -> Result<Self, Failure> {
        let area = area(client, scene, eye, range)?;
        let features = scene::load_over(client, scene, area)?;
        let surfaces = Surfaces::seen_from(&features, std::iter::once(eye[2]));
        Ok(Self {
            eye,
            range,
            features,
            surfaces,
        })
    }

    /// Whether a feature is in range, as visible_features counts it.
    pub fn is_in_range(&self, feature: &Feature) -> bool {
        feature.envelope.distance(self.eye) <= self.range
    }

    /// The features in range that an item buffer shows.
    pub fn shown(&self, sightings: &Sightings) -> HashSet<i64> {
        let feature = |number: u32| self.features.get((number as usize).checked_sub(1)?);
        sightings
            .numbers()
            .filter_map(feature)
            .filter(|feature| self.is_in_range(feature))
            .map(|feature| feature.id)
            .collect()
    }
}

/// Where all of the features in range lie, and the eye; at all heights, because the ground under a
/// feature hides too.
fn area(client: &mut Client, scene: &str, eye: [f64; 3], range: f64) -> Result<Box3d, Failure> {
    let statement = format!(
        "SELECT occlusion.extent(f.envelope) FROM {}.feature AS f WHERE f.envelope \
         OPERATOR(occlusion.&&) occlusion.expand(occlusion.box3d($1::occlusion.point3d, $1), $2)",
        quoted(scene)
    );
    let extent: Option<Box3d> = client
        .query_one(&statement, &[&Point3d(eye), &range])?
        .get(0);
    let extent = extent.unwrap_or(Box3d { min: eye, max: eye });
    let ([x, y, _], [right, back, _]) = (extent.min, extent.max);
    Ok(Box3d {
        min: [x.min(eye[0]), y.min(eye[1]), f64::MIN],
        max: [right.max(eye[0]), back.max(eye[1]), f64::MAX],
    })
}
