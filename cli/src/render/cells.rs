//! Maps of view cells.

use postgres::{Client, Row};
use renderer::{
    Image, PictureCell, PictureFeature, PictureScene, Sight, Status, heat_map, sight_map,
};

use super::Render;
use crate::database::quoted;
use crate::failure::Failure;
use crate::field_of_view::FieldOfView;
use crate::scene::{Feature, Scene, no_view_cells};
use crate::sql_types::Box3d;

impl Render {
    /// How many features may be seen from each view cell, or from which of them one is seen; of the
    /// whole scene, or around an observer.
    pub fn cell_map(
        &self,
        client: &mut Client,
        scene: &Scene,
        around: Option<&FieldOfView>,
    ) -> Result<Image, Failure> {
        client.execute("SELECT occlusion.require_all_cells($1)", &[&self.scene])?;
        let far = self.how_far(client)?;
        let picture = PictureScene {
            features: scene.features.iter().map(grey).collect(),
            ..self.surroundings(scene)
        };
        let sheet = self.sheet(around);
        let Some(wanted) = &self.feature else {
            let cells = self.counted_cells(client)?;
            let subtitle = format!("how many features may be seen from each view cell, {far}");
            let picture = PictureScene {
                subtitle,
                ..picture
            };
            return Ok(heat_map(
                &picture,
                &cells,
                "Features that may be seen",
                &sheet,
            )?);
        };
        let position = find(&self.scene, &scene.features, wanted)?;
        let feature = &scene.features[position];
        let cells = self.seeing_cells(client, feature.id)?;
        let subtitle = format!("view cells from which {feature} may be seen, {far}");
        let picture = PictureScene {
            subtitle,
            ..picture
        };
        Ok(sight_map(&picture, position, &cells, &sheet)?)
    }

    /// The ranges of the view cells in words; fails where there are none.
    fn how_far(&self, client: &mut Client) -> Result<String, Failure> {
        let statement = format!(
            "SELECT min(range), max(range) FROM {}.view_cell_block WHERE box IS NOT NULL",
            quoted(&self.scene)
        );
        let row = client.query_one(&statement, &[])?;
        match (row.get(0), row.get(1)) {
            (Some::<f64>(least), Some::<f64>(most)) if least < most => {
                Ok(format!("{least} to {most} m far"))
            }
            (Some(range), _) => Ok(format!("{range} m far")),
            (None, _) => Err(no_view_cells(&self.scene)),
        }
    }

    /// All cells with how many features may be seen from each.
    fn counted_cells(&self, client: &mut Client) -> Result<Vec<PictureCell<u64>>, Failure> {
        let statement = format!(
            "SELECT box, occlusion.cardinality(visible) FROM {}.view_cell",
            quoted(&self.scene)
        );
        let cell = |row: &Row| seen_from_above(row, row.get::<_, i64>(1).unsigned_abs());
        Ok(client.query(&statement, &[])?.iter().map(cell).collect())
    }

    /// All cells with whether a feature is seen from each.
    fn seeing_cells(
        &self,
        client: &mut Client,
        feature: i64,
    ) -> Result<Vec<PictureCell<Sight>>, Failure> {
        let statement = format!(
            "SELECT c.box, v.proven FROM {}.view_cell AS c \
             LEFT JOIN occlusion.visible_from($1, $2) AS v ON v.box OPERATOR(occlusion.=) c.box",
            quoted(&self.scene)
        );
        let cell = |row: &Row| seen_from_above(row, sight(row.get(1)));
        let rows = client.query(&statement, &[&self.scene, &feature])?;
        Ok(rows.iter().map(cell).collect())
    }
}

/// A cell whose box is the first column.
fn seen_from_above<T>(row: &Row, told: T) -> PictureCell<T> {
    let Box3d { min, max } = row.get(0);
    let corner = |[x, y, _]: [f64; 3]| [x, y];
    PictureCell {
        rectangle: (corner(min), corner(max)),
        told,
    }
}

/// What `visible_from` says of a cell, or that it says nothing.
fn sight(proven: Option<bool>) -> Sight {
    match proven {
        None => Sight::Hidden,
        Some(false) => Sight::Possible,
        Some(true) => Sight::Proven,
    }
}

fn grey(feature: &Feature) -> PictureFeature {
    PictureFeature {
        // No answer is asked for.
        status: Status::Outside,
        triangles: feature.surface().unwrap_or_default(),
        columns: Vec::new(),
    }
}

/// The position of the feature with this number, or else of the only one with this name.
fn find(scene: &str, features: &[Feature], wanted: &str) -> Result<usize, Failure> {
    let number: Option<i64> = wanted.parse().ok();
    let positions = |is_it: &dyn Fn(&Feature) -> bool| -> Vec<usize> {
        (0..features.len())
            .filter(|&at| is_it(&features[at]))
            .collect()
    };
    let numbered = positions(&|feature| Some(feature.id) == number);
    let named = positions(&|feature| feature.name.as_deref() == Some(wanted));
    match (&numbered[..], &named[..]) {
        (&[position, ..], _) | (&[], &[position]) => Ok(position),
        (&[], &[]) => Err(Failure::Input(format!(
            "scene \"{scene}\" has no feature \"{wanted}\"\n  hint: name one by its number or its name, as occlusion query lists them"
        ))),
        (&[], &[first, ..]) => Err(Failure::Input(format!(
            "{} features of scene \"{scene}\" are named \"{wanted}\"\n  hint: name one by its number, such as {}",
            named.len(),
            features[first].id
        ))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn feature(id: i64, name: &str) -> Feature {
        Feature {
            id,
            name: Some(name.to_owned()),
            class: "Building".to_owned(),
            envelope: Box3d {
                min: [0.0; 3],
                max: [1.0; 3],
            },
            mesh: None,
            inner: None,
            columns: Vec::new(),
        }
    }

    #[test]
    fn features_are_found_by_number_before_name() {
        let features = [
            feature(5, "7"),
            feature(7, "church"),
            feature(8, "shed"),
            feature(9, "shed"),
        ];
        let found = |wanted| find("x", &features, wanted).map_err(|failure| failure.to_string());
        assert_eq!(found("7"), Ok(1));
        assert_eq!(found("church"), Ok(1));
        let missing = found("tower").unwrap_err();
        assert!(
            missing.starts_with("scene \"x\" has no feature \"tower\""),
            "{missing}"
        );
        let many = found("shed").unwrap_err();
        assert!(
            many.starts_with("2 features of scene \"x\" are named \"shed\""),
            "{many}"
        );
    }
}
