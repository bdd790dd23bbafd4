//! What the `extras` of a node say about its feature.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};
use serde_json::Value;
use serde_json::value::RawValue;

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

/// What is read of the extras of a node.
#[derive(Default, Deserialize)]
pub(super) struct NodeRecord<'a> {
    #[serde(borrow)]
    pub(super) feature: Option<ReadRecord<'a>>,
    #[serde(borrow)]
    pub(super) part: Option<Cow<'a, str>>,
    pub(super) srid: Option<i32>,
}

impl<'a> NodeRecord<'a> {
    /// Extras of other writers may hold anything, so what does not fit is not ours and no error.
    pub(super) fn of(extras: Option<&'a RawValue>) -> Self {
        let record = extras.map(|extras| serde_json::from_str(extras.get()));
        record.and_then(Result::ok).unwrap_or_default()
    }
}

/// A [`FeatureRecord`] as it is read; the number is the database's, and a new import gives new ones.
#[derive(Deserialize)]
pub(super) struct ReadRecord<'a> {
    #[serde(borrow)]
    pub(super) name: Cow<'a, str>,
    #[serde(borrow)]
    pub(super) class: Cow<'a, str>,
    pub(super) level_of_detail: f64,
    #[serde(borrow)]
    pub(super) attributes: Option<&'a RawValue>,
    #[serde(borrow)]
    pub(super) parts: Option<&'a RawValue>,
}
