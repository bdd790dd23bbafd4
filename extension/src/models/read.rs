//! Reading the models of features.

use super::content::Content;
use crate::error::or_raise;
use crate::scene::{failed, quoted, read_one};
use formats::{Feature, Model};
use pgrx::Spi;
use pgrx::spi::SpiHeapTupleData;

/// Which models are wanted.
pub struct Choice {
    features: Vec<i64>,
    level_of_detail: f64,
    most_error: Vec<Option<f64>>,
}

impl Choice {
    /// The models of features, those that are null left out: the best level of detail not above the
    /// one given, or the coarsest whose geometric error is within that of the same place.
    pub fn new(
        features: Option<Vec<Option<i64>>>,
        level_of_detail: Option<f64>,
        most_error: Option<Vec<Option<f64>>>,
    ) -> Self {
        let features = features.unwrap_or_default();
        let mut most_error = most_error.unwrap_or_default();
        most_error.resize(features.len(), None);
        let wanted = features.into_iter().zip(most_error);
        let (features, most_error) = wanted
            .filter_map(|(feature, error)| Some((feature?, error)))
            .unzip();
        Self {
            features,
            level_of_detail: level_of_detail.unwrap_or(f64::INFINITY),
            most_error,
        }
    }
}

/// A feature that was asked for.
pub struct Row {
    /// Its number.
    pub feature: i64,
    /// The level of detail that was chosen.
    pub level_of_detail: Option<f64>,
    /// The feature at that level; `None` where there is neither model nor mesh.
    pub model: Option<Model>,
}

/// The models of the features that are in the scene, in the order asked for.
pub fn models(scene: &str, choice: &Choice) -> Vec<Row> {
    let arguments = [
        choice.features.clone().into(),
        choice.most_error.clone().into(),
        choice.level_of_detail.into(),
    ];
    let rows = Spi::connect(|client| {
        client
            .select(&statement(scene), None, &arguments)?
            .map(|row| row_of(&row))
            .collect::<Result<Vec<_>, pgrx::spi::Error>>()
    });
    rows.unwrap_or_else(|error| failed(&error))
}

/// EPSG code of a scene, if it is known.
pub fn srid(scene: &str) -> Option<i32> {
    let query = format!("SELECT srid FROM {}.scene_info", quoted(scene));
    let srid = read_one::<i32>(&query, &[]);
    srid.filter(|&srid| srid != 0)
}

/// Of each feature the wanted model, or its mesh. Levels above the wanted one come last, the lowest
/// of them first, so that there is always one.
fn statement(scene: &str) -> String {
    let scene = quoted(scene);
    format!(
        "SELECT f.id, f.name, f.class, f.attributes::pg_catalog.text, \
                m.level_of_detail, m.format, coalesce(m.content, s.content), m.placement, \
                g.level_of_detail, g.vertices, g.triangles \
         FROM ROWS FROM (pg_catalog.unnest($1), pg_catalog.unnest($2)) \
                  WITH ORDINALITY AS w (id, most_error, place) \
         JOIN {scene}.feature AS f ON f.id OPERATOR(pg_catalog.=) w.id \
         LEFT JOIN LATERAL ( \
             SELECT m.* FROM {scene}.model AS m \
             WHERE m.feature OPERATOR(pg_catalog.=) f.id \
             ORDER BY m.level_of_detail OPERATOR(pg_catalog.>) $3, \
                      CASE WHEN m.level_of_detail OPERATOR(pg_catalog.>) $3 \
                                OR m.geometric_error OPERATOR(pg_catalog.<=) w.most_error \
                           THEN m.level_of_detail END NULLS LAST, \
                      m.level_of_detail DESC, \
                      m.format OPERATOR(pg_catalog.<>) 'packed', m.format \
             LIMIT 1) AS m ON true \
         LEFT JOIN {scene}.shape AS s ON s.digest OPERATOR(pg_catalog.=) m.shape \
         LEFT JOIN {scene}.mesh AS g ON g.feature OPERATOR(pg_catalog.=) f.id AND m.feature IS NULL \
         ORDER BY w.place"
    )
}

fn row_of(row: &SpiHeapTupleData) -> Result<Row, pgrx::spi::Error> {
    let id: i64 = row.get(1)?.unwrap_or_default();
    let attributes: Option<String> = row.get(4)?;
    let mut feature = Feature {
        name: row.get(2)?.unwrap_or_else(|| id.to_string()),
        class: row.get(3)?.unwrap_or_default(),
        attributes: attributes
            .and_then(|text| serde_json::from_str(&text).ok())
            .unwrap_or_else(|| serde_json::Value::Object(serde_json::Map::new())),
        parts: Vec::new(),
        geometries: Vec::new(),
    };
    let format: Option<&str> = row.get(6)?;
    let bytes: Option<&[u8]> = row.get(7)?;
    let placement: Option<Vec<f64>> = row.get(8)?;
    let mesh = row.get::<Vec<f64>>(10)?.zip(row.get::<Vec<i32>>(11)?);
    let mut level_of_detail = row.get::<f64>(5)?;
    let content = match (format, bytes, placement, mesh) {
        (Some("packed"), Some(bytes), Some(placement), _) => Content::Instance(bytes, placement),
        (Some("packed"), Some(bytes), None, _) => Content::Packed(bytes),
        (Some(_), Some(bytes), _, _) => Content::File(bytes),
        (_, _, _, Some((vertices, triangles))) => {
            level_of_detail = row.get(9)?;
            Content::Mesh(vertices, triangles)
        }
        _ => {
            return Ok(Row {
                feature: id,
                level_of_detail: None,
                model: None,
            });
        }
    };
    or_raise(content.fill(&mut feature, level_of_detail.unwrap_or_default()));
    Ok(Row {
        feature: id,
        level_of_detail,
        model: Some(Model { id, feature }),
    })
}
