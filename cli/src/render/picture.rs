//! What a picture shows.

use std::collections::HashSet;

use geo::Polygon;
use postgres::Client;
use renderer::{Area, Observer, PictureFeature, PictureScene, PlanView, Renderer, Status};

use super::Render;
use super::size::Size;
use crate::failure::Failure;
use crate::field_of_view::{FieldOfView, Returned};
use crate::scene::{Scene, Surfaces, number};

/// Pixels along a side of each face of the item buffer that tells what is truly visible.
const TRUTH: u32 = 2048;

/// A scene wider than so many ranges is not shown whole on a map.
const WIDE: f64 = 4.0;

impl Render {
    /// The scene in the colours of the answer.
    pub fn picture(
        &self,
        client: &mut Client,
        scene: &Scene,
        field: &FieldOfView,
        renderer: &Renderer,
    ) -> Result<PictureScene, Failure> {
        let ids = |features: Vec<Returned>| features.iter().map(|feature| feature.id).collect();
        let within: HashSet<i64> = ids(field.within(client, &self.scene)?);
        let returned: HashSet<i64> = ids(field.visible(client, &self.scene)?);
        let mesh = Surfaces::of(scene).mesh();
        let seen = renderer.cube_map(&mesh, field.observer.0, TRUTH)?.seen();
        let is_seen = |position: usize| seen.contains_key(&number(position));
        let status = |position: usize, id: i64| match self.truth {
            true => true_status(within.contains(&id), is_seen(position)),
            false => status(
                within.contains(&id),
                returned.contains(&id),
                is_seen(position),
            ),
        };
        let features = scene
            .features
            .iter()
            .enumerate()
            .map(|(position, feature)| PictureFeature {
                status: status(position, feature.id),
                triangles: feature.surface().unwrap_or_default(),
                columns: Vec::new(),
            });
        Ok(PictureScene {
            subtitle: self.question(field),
            features: features.collect(),
            observer: Some(observer(field)),
            ..self.surroundings(scene)
        })
    }

    /// The picture without features, and without who looks at them.
    pub fn surroundings(&self, scene: &Scene) -> PictureScene {
        let streets = scene.streets.iter().map(|street| area(&street.area));
        PictureScene {
            title: self.caption.clone().unwrap_or_else(|| self.scene.clone()),
            attribution: scene.attribution.clone().unwrap_or_default(),
            streets: streets.collect(),
            ..Default::default()
        }
    }

    /// What was asked, in words.
    fn question(&self, field: &FieldOfView) -> String {
        let [x, y, z] = field.observer.0;
        let coloured = if self.truth {
            "\ncoloured by what is truly visible"
        } else {
            ""
        };
        format!("from {x:.2}, {y:.2}, {z:.2}\n{}{coloured}", whereto(field))
    }

    /// The whole scene, or what is in range where the scene is much wider.
    pub fn plan_view(&self, picture: &PictureScene, field: &FieldOfView) -> PlanView {
        let ([x, y, _], range) = (field.observer.0, field.range);
        let corners = picture
            .features
            .iter()
            .flat_map(|f| f.triangles.iter().flatten());
        let farthest = corners.fold(0.0, |far: f64, corner| {
            far.max((corner[0] - x).abs()).max((corner[1] - y).abs())
        });
        self.sheet((farthest > WIDE * range).then_some(field))
    }

    /// The whole scene, or what is in range.
    pub fn sheet(&self, field: Option<&FieldOfView>) -> PlanView {
        let Size { width, height } = self.size;
        let window = field.map(|field| {
            let ([x, y, _], reach) = (field.observer.0, 1.1 * field.range);
            ([x - reach, y - reach], [x + reach, y + reach])
        });
        PlanView {
            width,
            height,
            window,
        }
    }
}

/// Who looks, and whereto.
pub fn observer(field: &FieldOfView) -> Observer {
    let (heading, angle) = field.direction().unwrap_or((0.0, 360.0));
    Observer {
        eye: field.observer.0,
        heading,
        angle,
        range: field.range,
    }
}

/// The field of view but for the eye, in words.
pub fn whereto(field: &FieldOfView) -> String {
    let range = field.range;
    match field.direction() {
        None => format!("all round, {range} m far"),
        Some((heading, angle)) => {
            let wide = (100.0 * angle).round() / 100.0;
            format!("heading {heading}°, {wide}° wide, {range} m far")
        }
    }
}

/// The colour of a feature.
fn status(within: bool, returned: bool, seen: bool) -> Status {
    match (returned, seen, within) {
        (true, true, _) => Status::Visible,
        (true, false, _) => Status::OverEstimated,
        (false, _, true) => Status::Hidden,
        (false, _, false) => Status::Outside,
    }
}

/// The colour of a feature by the truth alone.
fn true_status(within: bool, seen: bool) -> Status {
    match (within, seen) {
        (true, true) => Status::Visible,
        (true, false) => Status::Hidden,
        (false, _) => Status::Outside,
    }
}

/// A polygon for the renderer.
pub fn area(polygon: &Polygon<f64>) -> Area {
    let ring = |line: &geo::LineString<f64>| line.coords().map(|c| [c.x, c.y]).collect();
    Area {
        exterior: ring(polygon.exterior()),
        holes: polygon.interiors().iter().map(ring).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_follow_the_answer() {
        assert_eq!(status(true, true, true), Status::Visible);
        assert_eq!(status(true, true, false), Status::OverEstimated);
        // Seen and left out: the red that must not be.
        assert_eq!(status(true, false, true), Status::Hidden);
        assert_eq!(status(false, false, true), Status::Outside);
        assert_eq!(true_status(true, false), Status::Hidden);
    }
}
