//! Reading a scene.

use std::collections::HashMap;

use engine::SolidColumn;
use oracle::Mesh;
use postgres::{GenericClient, Row};

use super::feature::{Feature, InnerEnvelope};
use super::street::{Street, polygon};
use crate::database::quoted;
use crate::failure::Failure;
use crate::sql_types::{Box3d, Ring};

/// Whether the envelope of a feature meets a box, if there is one.
const IN_AREA: &str =
    "($1::occlusion.box3d IS NULL OR f.envelope OPERATOR(occlusion.&&) $1::occlusion.box3d)";

/// A scene without its volumes.
#[derive(Clone, Debug)]
pub struct Scene {
    /// All features, by number.
    pub features: Vec<Feature>,
    /// The view region.
    pub streets: Vec<Street>,
    /// Whose data it is, as its models say.
    pub attribution: Option<String>,
}

/// Reads features, streets and attribution.
pub fn load(client: &mut impl GenericClient, scene: &str) -> Result<Scene, Failure> {
    client.execute("SELECT occlusion.require_scene($1)", &[&scene])?;
    let schema = quoted(scene);
    Ok(Scene {
        features: features(client, &schema, None)?,
        streets: streets(client, &schema, None)?,
        attribution: attribution(client, &schema)?,
    })
}

/// Reads the features whose envelopes meet a box.
pub fn load_over(
    client: &mut impl GenericClient,
    scene: &str,
    area: Box3d,
) -> Result<Vec<Feature>, Failure> {
    features(client, &quoted(scene), Some(area))
}

/// Reads the streets that meet a box in plan.
pub fn streets_over(
    client: &mut impl GenericClient,
    scene: &str,
    area: Box3d,
) -> Result<Vec<Street>, Failure> {
    streets(client, &quoted(scene), Some(area))
}

impl Scene {
    /// Positions of features by number.
    pub fn positions(&self) -> HashMap<i64, usize> {
        self.features
            .iter()
            .enumerate()
            .map(|(position, feature)| (feature.id, position))
            .collect()
    }
}

/// All features, or those in an area.
fn features(
    client: &mut impl GenericClient,
    schema: &str,
    area: Option<Box3d>,
) -> Result<Vec<Feature>, Failure> {
    let statement = format!(
        "SELECT f.id, f.name, f.class, f.envelope, m.vertices, m.triangles, i.box, i.grounded \
         FROM {schema}.feature AS f \
         LEFT JOIN {schema}.mesh AS m ON m.feature = f.id \
         LEFT JOIN {schema}.inner_envelope AS i ON i.feature = f.id \
         WHERE {IN_AREA} ORDER BY f.id"
    );
    let rows = client.query(&statement, &[&area])?;
    let mut features: Vec<Feature> = rows.iter().map(feature).collect();
    add_columns(client, schema, area, &mut features)?;
    Ok(features)
}

/// Gives each feature its solid columns; a footprint without a ring has no place in the table.
fn add_columns(
    client: &mut impl GenericClient,
    schema: &str,
    area: Option<Box3d>,
    features: &mut [Feature],
) -> Result<(), Failure> {
    let statement = format!(
        "SELECT c.feature, c.footprint, c.bottom, c.top, c.grounded \
         FROM {schema}.solid_column AS c JOIN {schema}.feature AS f ON f.id = c.feature \
         WHERE {IN_AREA} ORDER BY c.feature"
    );
    for row in client.query(&statement, &[&area])? {
        let owner: i64 = row.get(0);
        let position = features.binary_search_by_key(&owner, |feature| feature.id);
        if let (Ok(position), Some(footprint)) = (position, polygon(row.get(1))) {
            features[position].columns.push(SolidColumn {
                footprint,
                bottom: row.get(2),
                top: row.get(3),
                grounded: row.get(4),
            });
        }
    }
    Ok(())
}

fn feature(row: &Row) -> Feature {
    let vertices: Option<Vec<f64>> = row.get(4);
    let triangles: Option<Vec<i32>> = row.get(5);
    Feature {
        id: row.get(0),
        name: row.get(1),
        class: row.get(2),
        envelope: row.get(3),
        mesh: vertices
            .zip(triangles)
            .map(|(vertices, triangles)| mesh(&vertices, &triangles)),
        inner: row.get::<_, Option<_>>(6).map(|bounds| InnerEnvelope {
            bounds,
            grounded: row.get(7),
        }),
        columns: Vec::new(),
    }
}

/// A mesh as the table holds it. What is left over at the end of an array becomes a triangle that
/// names no vertex, so that it is found at fault and not passed over.
fn mesh(vertices: &[f64], triangles: &[i32]) -> Mesh {
    let (points, _) = vertices.as_chunks::<3>();
    let number = |corner: &i32| u32::try_from(*corner).unwrap_or(u32::MAX);
    let corners =
        |triangle: &[i32]| std::array::from_fn(|i| triangle.get(i).map_or(u32::MAX, number));
    Mesh {
        vertices: points.to_vec(),
        triangles: triangles.chunks(3).map(corners).collect(),
    }
}

/// All streets, or those in an area.
fn streets(
    client: &mut impl GenericClient,
    schema: &str,
    area: Option<Box3d>,
) -> Result<Vec<Street>, Failure> {
    let statement = format!(
        "SELECT area, eye_low, eye_high FROM {schema}.street \
         WHERE $1::polygon IS NULL OR area[1] && $1 ORDER BY id"
    );
    let plan = area.map(|Box3d { min, max }| {
        Ring(vec![
            [min[0], min[1]],
            [max[0], min[1]],
            [max[0], max[1]],
            [min[0], max[1]],
        ])
    });
    let rows = client.query(&statement, &[&plan])?;
    Ok(rows
        .iter()
        .filter_map(|row| Street::new(row.get(0), row.get(1), row.get(2)))
        .collect())
}

fn attribution(client: &mut impl GenericClient, schema: &str) -> Result<Option<String>, Failure> {
    let statement = format!("SELECT attribution FROM {schema}.scene_info");
    let row = client.query_opt(&statement, &[])?;
    Ok(row.and_then(|row| row.get(0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn broken_arrays_are_found_at_fault() {
        let square = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
        assert!(mesh(&square, &[0, 1, 2]).corners().is_some());
        for wrong in [&[0, 1][..], &[0, 1, 3], &[0, 1, -1], &[0, 1, 2, 0]] {
            assert_eq!(mesh(&square, wrong).corners(), None, "{wrong:?}");
        }
    }
}
