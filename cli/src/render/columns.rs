//! What a picture of the solid columns shows.

use std::collections::HashSet;

use engine::SolidColumn;
use postgres::Client;
use renderer::{PictureColumn, PictureFeature, PictureScene, Status};

use super::Render;
use super::picture::{area, observer, whereto};
use crate::failure::Failure;
use crate::field_of_view::FieldOfView;
use crate::scene::{Feature, Scene};

impl Render {
    /// The features in the field of view, with their columns.
    pub fn solids(
        &self,
        client: &mut Client,
        scene: &Scene,
        field: &FieldOfView,
    ) -> Result<PictureScene, Failure> {
        let within = field.within(client, &self.scene)?;
        let within: HashSet<i64> = within.iter().map(|feature| feature.id).collect();
        let inside = |feature: &&Feature| within.contains(&feature.id);
        let [x, y, _] = field.observer.0;
        Ok(PictureScene {
            subtitle: format!("what hides at {x:.2}, {y:.2}\n{}", whereto(field)),
            features: scene.features.iter().filter(inside).map(solid).collect(),
            observer: Some(observer(field)),
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

#[cfg(test)]
mod tests {
    use geo::{Coord, Rect, coord};

    use super::*;

    #[test]
    fn columns_keep_their_courtyards() {
        let square = |low: Coord, high: Coord| Rect::new(low, high).to_polygon();
        let court = square(coord! { x: 4.0, y: 4.0 }, coord! { x: 5.0, y: 6.0 });
        let mut footprint = square(coord! { x: 0.0, y: 0.0 }, coord! { x: 9.0, y: 9.0 });
        footprint.interiors_push(court.exterior().clone());
        let drawn = column(&SolidColumn {
            footprint,
            bottom: -1.0,
            top: 7.5,
            grounded: false,
        });
        assert_eq!(
            (drawn.bottom, drawn.top, drawn.grounded),
            (-1.0, 7.5, false)
        );
        assert_eq!(drawn.footprint.exterior.len(), 5);
        assert!(drawn.footprint.holes[0].contains(&[5.0, 6.0]));
    }
}
