//! What the properties of a feature say.

use serde_json::value::RawValue;
use serde_json::{Map, Value};

use super::document::object;
use crate::error::Problem;
use crate::extrusion::{LEVEL_HEIGHT, MAX_HEIGHT, STREET_WIDTHS, length, street_width};
use crate::limits::{MAX_ATTRIBUTE_BYTES, MAX_NAME_BYTES};

/// Properties that say how high a feature is.
const HEIGHT: [&str; 6] = [
    "height",
    "building_height",
    "measuredHeight",
    "hoehe",
    "hauteur",
    "altura",
];

/// Properties that say how far above the ground it begins.
const BASE: [&str; 3] = ["min_height", "base_height", "base"];

/// Properties that count storeys.
const LEVELS: [&str; 5] = [
    "levels",
    "building:levels",
    "building_levels",
    "floors",
    "storeys",
];

/// Classes of streets and squares, lower case, with the class that they become.
const STREETS: [(&str, &str); 7] = [
    ("road", "Road"),
    ("street", "Road"),
    ("highway", "Road"),
    ("transportsquare", "TransportSquare"),
    ("square", "TransportSquare"),
    ("plaza", "TransportSquare"),
    ("pedestrian", "TransportSquare"),
];

/// The properties of a feature.
pub(super) struct Properties(Map<String, Value>);

impl Properties {
    /// Reads them; none are as good as an empty object.
    pub(super) fn parse(raw: Option<&RawValue>) -> Result<Self, Problem> {
        let Some(raw) = raw else {
            return Ok(Self(Map::new()));
        };
        within("bytes of properties", raw.get().len(), MAX_ATTRIBUTE_BYTES)?;
        object("properties", raw).map(Self)
    }

    /// All of them as attributes.
    pub(super) fn into_attributes(self) -> Value {
        Value::Object(self.0)
    }

    /// The name, if one of them is one.
    pub(super) fn name(&self) -> Result<Option<String>, Problem> {
        let name = ["id", "name"]
            .iter()
            .find_map(|key| self.0.get(*key).and_then(name_of));
        name.map(checked).transpose()
    }

    /// The class, `Building` where none is said.
    pub(super) fn class(&self) -> Result<String, Problem> {
        self.said_class()
            .map_or(Ok("Building".to_owned()), |class| checked(class.to_owned()))
    }

    /// The class of the street that it is; none for what is no street.
    pub(super) fn street(&self) -> Option<&'static str> {
        let class = self.said_class().map(str::to_lowercase);
        let street = class.and_then(|class| STREETS.iter().find(|(name, _)| *name == class));
        let highway = || self.highway().map(|_| "Road");
        street.map(|(_, class)| *class).or_else(highway)
    }

    /// The class of the street that a line is. One with a width and no class is a road.
    pub(super) fn line_street(&self) -> Option<&'static str> {
        let plain = || (self.said_class().is_none() && self.width().is_some()).then_some("Road");
        self.street().or_else(plain)
    }

    /// The width of a street, metres.
    pub(super) fn width(&self) -> Option<f64> {
        let said = self.0.get("width").and_then(metres);
        let by_kind = || self.highway().and_then(street_width);
        said.filter(|width| STREET_WIDTHS.contains(width))
            .or_else(by_kind)
    }

    /// From where to where it reaches above the ground, metres; or why that is not known.
    pub(super) fn heights(&self) -> Result<[f64; 2], &'static str> {
        let believed = -MAX_HEIGHT..=MAX_HEIGHT;
        let first = |keys: &[&str]| keys.iter().find_map(|key| self.value(key));
        let number = |value: &Value| metres(value).filter(|metres| believed.contains(metres));
        let top = match (first(&HEIGHT), first(&LEVELS)) {
            (Some(height), _) => number(height).ok_or("the height is no height up to 1000 m")?,
            (None, Some(levels)) => {
                let height = metres(levels).map(|levels| levels * LEVEL_HEIGHT);
                let height = height.filter(|metres| believed.contains(metres));
                height.ok_or("the levels are no number of storeys")?
            }
            (None, None) => return Err("no height"),
        };
        let base =
            first(&BASE).map(|base| number(base).ok_or("the base is no height up to 1000 m"));
        Ok([base.transpose()?.unwrap_or(0.0), top])
    }

    fn said_class(&self) -> Option<&str> {
        let text = |key| self.value(key).and_then(Value::as_str);
        text("class")
            .or_else(|| text("type"))
            .filter(|class| !class.is_empty())
    }

    fn highway(&self) -> Option<&str> {
        self.value("highway")
            .and_then(Value::as_str)
            .filter(|kind| *kind != "no")
    }

    /// A value that is there.
    fn value(&self, key: &str) -> Option<&Value> {
        self.0.get(key).filter(|value| !value.is_null())
    }
}

/// A name from an identifier, which may be a number.
pub(super) fn name_of(value: &Value) -> Option<String> {
    match value {
        Value::String(text) if !text.is_empty() => Some(text.clone()),
        Value::Number(number) => Some(number.to_string()),
        _ => None,
    }
}

/// A name that is not too long.
pub(super) fn checked(name: String) -> Result<String, Problem> {
    within("bytes of a name or class", name.len(), MAX_NAME_BYTES)?;
    Ok(name)
}

/// Refuses what is too long.
pub(super) fn within(what: &'static str, found: usize, limit: usize) -> Result<(), Problem> {
    let (found, limit) = (found as u64, limit as u64);
    match found > limit {
        true => Err(Problem::Limit { what, found, limit }),
        false => Ok(()),
    }
}

/// A length as a number or as text with a unit.
fn metres(value: &Value) -> Option<f64> {
    match value {
        Value::Number(number) => number.as_f64().filter(|metres| metres.is_finite()),
        Value::String(text) => length(text),
        _ => None,
    }
}
