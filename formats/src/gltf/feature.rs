//! A feature that is put together from the nodes of a subtree.

use serde_json::value::RawValue;
use serde_json::{Map, Value};

use super::document::parse;
use super::node::Node;
use super::record::{NodeRecord, ReadRecord};
use super::shapes::Losses;
use super::weight::{VALUE_BYTES, Weight, check_name};
use crate::error::{Problem, shorten};
use crate::limits::{MAX_ATTRIBUTE_BYTES, MAX_LEVEL_OF_DETAIL};
use crate::scene::{Changed, Feature, Geometry, Part, SceneDescription, Skipped};

/// Class of a feature whose file names none.
const CLASS: &str = "Generic";

/// Level of detail of a feature whose file names none.
const LEVEL_OF_DETAIL: f64 = 2.0;

/// A feature, and what was lost on the way.
pub(super) struct FeatureBuilder {
    pub(super) feature: Feature,
    pub(super) level_of_detail: f64,
    pub(super) weight: Weight,
    pub(super) losses: Losses,
    pub(super) skinned: bool,
    pub(super) flattened: bool,
    /// Whether the node had a record, so that nodes below name parts.
    pub(super) recorded: bool,
}

impl FeatureBuilder {
    /// The feature that a node begins, without its geometry: as its record says, or named as the
    /// node is, with the node's extras for attributes.
    pub(super) fn new(
        number: u64,
        node: &Node<'_>,
        record: &NodeRecord<'_>,
        outer_bytes: usize,
    ) -> Result<Self, Problem> {
        let mut builder = Self {
            feature: Feature {
                name: name(number, node, record),
                class: CLASS.to_owned(),
                attributes: Value::Object(Map::new()),
                parts: Vec::new(),
                geometries: Vec::new(),
            },
            level_of_detail: LEVEL_OF_DETAIL,
            weight: Weight::within(outer_bytes),
            losses: Losses::default(),
            skinned: false,
            flattened: false,
            recorded: record.feature.is_some(),
        };
        check_name("the name of a feature", &builder.feature.name)?;
        match &record.feature {
            Some(record) => builder.take(record)?,
            None => builder.take_extras(node.extras)?,
        }
        Ok(builder)
    }

    fn take(&mut self, record: &ReadRecord<'_>) -> Result<(), Problem> {
        check_name("the class of a feature", &record.class)?;
        if !(0.0..=MAX_LEVEL_OF_DETAIL).contains(&record.level_of_detail) {
            return Err(Problem::Invalid {
                what: "level_of_detail".to_owned(),
                found: record.level_of_detail.to_string(),
                expected: "0 to 10",
            });
        }
        self.feature.class = record.class.clone().into_owned();
        self.level_of_detail = record.level_of_detail;
        if let Some(attributes) = record.attributes {
            self.feature.attributes = self.value("attributes", attributes)?;
            check_object("attributes", &self.feature.attributes)?;
        }
        if let Some(parts) = record.parts {
            self.weight
                .add(parts.get().len().saturating_mul(VALUE_BYTES))?;
            self.feature.parts = parse("parts", parts)?;
        }
        for Part {
            name,
            class,
            attributes,
        } in &self.feature.parts
        {
            check_name("the name of a part", name)?;
            check_name("the class of a part", class)?;
            check_object("the attributes of a part", attributes)?;
        }
        Ok(())
    }

    fn take_extras(&mut self, extras: Option<&RawValue>) -> Result<(), Problem> {
        if let Some(extras) = extras.filter(|extras| extras.get().starts_with('{')) {
            self.feature.attributes = self.value("extras", extras)?;
        }
        Ok(())
    }

    fn value(&mut self, what: &str, raw: &RawValue) -> Result<Value, Problem> {
        if raw.get().len() > MAX_ATTRIBUTE_BYTES {
            return Err(Problem::Limit {
                what: "bytes of attributes of one object",
                found: raw.get().len() as u64,
                limit: MAX_ATTRIBUTE_BYTES as u64,
            });
        }
        self.weight
            .add(raw.get().len().saturating_mul(VALUE_BYTES))?;
        parse(what, raw)
    }

    pub(super) fn add(&mut self, geometry: Geometry) -> Result<(), Problem> {
        self.weight
            .add(geometry.part.as_ref().map_or(0, String::len))?;
        self.feature.geometries.push(geometry);
        Ok(())
    }

    /// Moves the feature into a scene, with what is to be said of it; its bytes.
    pub(super) fn finish(self, scene: &mut SceneDescription) -> usize {
        let Feature { name, class, .. } = &self.feature;
        let losses = [
            (self.losses.textures, "textures left out"),
            (self.losses.targets, "morph targets left out"),
            (self.skinned, "skin left out"),
            (self.losses.lines, "points and lines left out"),
            (self.flattened, "instances without thickness left out"),
        ];
        if self.feature.geometries.is_empty() {
            let why = if self.losses.lines {
                "only points and lines"
            } else {
                "no surface"
            };
            scene.skipped.push(Skipped {
                name: name.clone(),
                class: class.clone(),
                why: why.to_owned(),
            });
        } else {
            let changed = losses
                .iter()
                .filter(|(lost, _)| *lost)
                .map(|(_, how)| Changed {
                    name: name.clone(),
                    class: class.clone(),
                    how: (*how).to_owned(),
                });
            scene.changed.extend(changed);
            scene.features.push(self.feature);
        }
        self.weight.own() + size_of::<Feature>()
    }
}

fn name(number: u64, node: &Node<'_>, record: &NodeRecord<'_>) -> String {
    let recorded = record.feature.as_ref().map(|record| &record.name);
    let name = recorded
        .or(node.name.as_ref())
        .filter(|name| !name.is_empty());
    name.map_or_else(
        || format!("node-{number}"),
        |name| name.clone().into_owned(),
    )
}

fn check_object(what: &str, value: &Value) -> Result<(), Problem> {
    if value.is_object() {
        return Ok(());
    }
    Err(Problem::Invalid {
        what: what.to_owned(),
        found: shorten(&value.to_string()),
        expected: "an object",
    })
}
