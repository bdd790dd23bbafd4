//! What the `extras` of a node say about its feature.

use serde::Serialize;
use serde_json::Value;

use crate::scene::{Model, Part};

/// Written as the member `feature` of the extras of a feature's node.
#[derive(Serialize)]
pub(super) struct FeatureRecord<'a> {
    id: i64,
    name: &'a str,
    class: &'a str,
    level_of_detail: f64,
    attributes: &'a Value,
    #[serde(skip_serializing_if = "<[Part]>::is_empty")]
    parts: &'a [Part],
}

impl<'a> FeatureRecord<'a> {
    pub(super) fn of(model: &'a Model) -> Self {
        let Model { id, feature } = model;
        let geometry = feature.geometries.first();
        Self {
            id: *id,
            name: &feature.name,
            class: &feature.class,
            level_of_detail: geometry.map_or(0.0, |geometry| geometry.level_of_detail),
            attributes: &feature.attributes,
            parts: &feature.parts,
        }
    }
}
