//! What a picture of the solid columns shows.

use std::collections::HashSet;

use engine::SolidColumn;
use postgres::Client;
use renderer::{PictureColumn, PictureFeature, PictureScene, Status};

use super::Render;
use super::picture::area;
use crate::failure::Failure;
use crate::scene::{Feature, Scene};

impl Render {
    /// The features in the field of view, with their columns.
    pub fn solids(&self, client: &mut Client, scene: &Scene) -> Result<PictureScene, Failure> {
        let within = self.field_of_view.within(client, &self.scene)?;
        let within: HashSet<i64> = within.iter().map(|feature| feature.id).collect();
        let inside = |feature: &&Feature| within.contains(&feature.id);
        let [x, y, _] = self.field_of_view.observer.0;
        Ok(PictureScene {
            subtitle: format!("what hides at {x:.2}, {y:.2}\n{}", self.whereto()),
            features: scene.features.iter().filter(inside).map(solid).collect(),
            ..self.surroundings(scene)
        })
    }
}

fn solid(feature: &Feature) -> PictureFeature {
    PictureFeature {
        // No answer is asked for; glass has one colour.
        status: Status::Outside,
        triangles: feature.surface().unwrap_or_default(),
        columns: feature.columns.iter().map(column).collect(),
    }
}

fn column(column: &SolidColumn) -> PictureColumn {
    PictureColumn {
        footprint: area(&column.footprint),
        bottom: column.bottom,
        top: column.top,
        grounded: column.grounded,
    }
}
