//! [`Truth`], a scene as one snapshot shows it, with what was asked in the same statement.

use std::collections::HashMap;

use fastrand::Rng;
use oracle::{Aabb, Column, JudgedFeature};
use serde::Deserialize;

use crate::plan::{Bounds, Place, ring};
use crate::thing::{Solid, Thing};

/// What the statement returns.
#[derive(Deserialize)]
struct Rows {
    features: Vec<(i64, Option<i64>, String, Option<String>)>,
    columns: Vec<(i64, String, f64)>,
    inner: Vec<(i64, String)>,
    meshes: Vec<(i64, Vec<f64>)>,
    streets: Vec<(i64, String, f64, f64)>,
    answers: Vec<serde_json::Value>,
}

/// A place where observers can be.
pub struct Street {
    pub id: i64,
    pub ring: Vec<Place>,
    pub eyes: [f64; 2],
}

/// A feature as its rows make it.
pub struct Known {
    pub id: i64,
    pub slot: Option<i64>,
    pub thing: Thing,
}

/// A scene of one moment.
pub struct Truth {
    pub known: Vec<Known>,
    /// The same, for the judge.
    pub judged: Vec<JudgedFeature>,
    pub streets: Vec<Street>,
    /// What the expressions came to that were asked.
    pub answers: Vec<serde_json::Value>,
}

/// One statement, and so one snapshot whatever the isolation: all of a scene, and expressions of JSON.
pub fn statement(scene: &str, expressions: &[String]) -> String {
    let rows = |columns: &str, table: &str| {
        format!(
            "(SELECT coalesce(json_agg(json_build_array({columns}) ORDER BY ctid), '[]') FROM {scene}.{table})"
        )
    };
    format!(
        "SELECT json_build_object('features', {}, 'columns', {}, 'inner', {}, 'meshes', {}, 'streets', {},
                'answers', json_build_array({}))::text",
        rows("id, slot, envelope::text, outline::text", "feature"),
        rows("feature, footprint[1]::text, top", "solid_column"),
        rows("feature, box::text", "inner_envelope"),
        rows("feature, vertices", "mesh"),
        rows("id, area[1]::text, eye_low, eye_high", "street"),
        expressions.join(", ")
    )
}

impl Truth {
    /// Of what the statement returned.
    pub fn parse(text: &str) -> Self {
        let rows: Rows = serde_json::from_str(text).expect("a scene");
        let columns: HashMap<i64, (String, f64)> = rows
            .columns
            .into_iter()
            .map(|(feature, ring, top)| (feature, (ring, top)))
            .collect();
        let inner: HashMap<i64, String> = rows.inner.into_iter().collect();
        let meshes: HashMap<i64, Vec<f64>> = rows.meshes.into_iter().collect();
        let (mut known, mut judged) = (Vec::new(), Vec::new());
        for (id, slot, envelope, outline) in rows.features {
            let envelope = Bounds::parse(&envelope);
            let mesh = meshes.get(&id).map(|vertices| prism(vertices));
            let claimed = match (columns.get(&id), inner.get(&id)) {
                (Some((corners, top)), _) => Some((ring(corners), *top, false)),
                (None, Some(bounds)) => {
                    let Bounds { min, max } = Bounds::parse(bounds);
                    let corners = vec![
                        [min[0], min[1]],
                        [max[0], min[1]],
                        [max[0], max[1]],
                        [min[0], max[1]],
                    ];
                    Some((corners, max[2], true))
                }
                // A closed surface alone may hide, too.
                (None, None) => mesh.clone().map(|(corners, top)| (corners, top, false)),
            };
            // What there is to see: the surface, or else all that may be in the outline and the envelope.
            let (outline, bounds) = match &mesh {
                Some((corners, _)) => (corners.clone(), envelope),
                None => (
                    outline.map(|text| ring(&text)).unwrap_or_default(),
                    envelope,
                ),
            };
            let solid = claimed.as_ref().map(|(corners, top, _)| {
                Column::new(std::slice::from_ref(corners), 0.0, *top, true)
                    .expect("a proper column")
            });
            judged.push(JudgedFeature {
                bounds: Aabb::new(bounds.min, bounds.max),
                outline,
                columns: solid.into_iter().collect(),
            });
            let solid = claimed.map(|(ring, top, is_inner)| Solid {
                ring,
                top,
                has_mesh: mesh.is_some(),
                is_inner,
            });
            known.push(Known {
                id,
                slot,
                thing: Thing { envelope, solid },
            });
        }
        let streets = rows
            .streets
            .into_iter()
            .map(|(id, area, low, high)| Street {
                id,
                ring: ring(&area),
                eyes: [low, high],
            });
        Self {
            known,
            judged,
            streets: streets.collect(),
            answers: rows.answers,
        }
    }

    /// Whether an observer can be there, for all that streets say.
    pub fn is_in_streets(&self, [x, y, z]: [f64; 3]) -> bool {
        let holds = |street: &Street| {
            let bound = |of: fn(f64, f64) -> f64, axis: usize| {
                let values = street.ring.iter().map(|place| place[axis]);
                values.reduce(of).expect("a ring has corners")
            };
            // All streets here are rectangles.
            (bound(f64::min, 0)..=bound(f64::max, 0)).contains(&x)
                && (bound(f64::min, 1)..=bound(f64::max, 1)).contains(&y)
                && (street.eyes[0]..=street.eyes[1]).contains(&z)
        };
        self.streets.iter().any(holds)
    }

    /// A feature by chance.
    pub fn any(&self, rng: &mut Rng) -> Option<&Known> {
        rng.choice(&self.known)
    }
}

/// The ring and the height of a mesh that is a prism on the ground.
fn prism(vertices: &[f64]) -> (Vec<Place>, f64) {
    let (foot, top) = vertices.split_at(vertices.len() / 2);
    let corners = foot.chunks(3).map(|corner| [corner[0], corner[1]]);
    (corners.collect(), top[2])
}
