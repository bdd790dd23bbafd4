//! One city object, taken apart as far as the hierarchy and the geometries need.

use std::borrow::Cow;

use serde_json::value::RawValue;

use super::json::{Members, array, parse, string, strings};
use crate::error::Problem;
use crate::limits::{MAX_ATTRIBUTE_BYTES, MAX_NAME_BYTES};

/// A city object; its attributes and geometries are still raw.
#[derive(Debug)]
pub(super) struct CityObject<'a> {
    pub(super) id: Cow<'a, str>,
    pub(super) class: Cow<'a, str>,
    pub(super) parents: Vec<Cow<'a, str>>,
    pub(super) children: Vec<Cow<'a, str>>,
    pub(super) geometries: Vec<&'a RawValue>,
    pub(super) members: Members<'a>,
}

impl<'a> CityObject<'a> {
    /// Reads an object under its identifier.
    pub(super) fn parse(id: Cow<'a, str>, raw: &'a RawValue) -> Result<Self, Problem> {
        check_length("bytes of an identifier", &id, MAX_NAME_BYTES)?;
        let members = Members::of("city object", raw)?;
        let class = string("type", members.require("type", "type")?)?;
        check_length("bytes of a type", &class, MAX_NAME_BYTES)?;
        let list = |name| {
            members
                .get(name)
                .map_or(Ok(Vec::new()), |raw| strings(name, raw))
        };
        Ok(Self {
            id,
            class,
            parents: list("parents")?,
            children: list("children")?,
            geometries: members
                .get("geometry")
                .map_or(Ok(Vec::new()), |raw| array("geometry", raw))?,
            members,
        })
    }

    /// Whether it only names other objects that stay objects of their own.
    pub(super) fn is_group(&self) -> bool {
        self.class == "CityObjectGroup"
    }

    /// Whether observers walk or drive on it.
    pub(super) fn is_street(&self) -> bool {
        matches!(self.class.as_ref(), "Road" | "TransportSquare")
    }

    /// Whether it is the ground, which is no feature.
    pub(super) fn is_terrain(&self) -> bool {
        self.class == "TINRelief"
    }

    /// The attributes, an empty object where there are none.
    pub(super) fn attributes(&self) -> Result<serde_json::Value, Problem> {
        let Some(raw) = self.members.get("attributes") else {
            return Ok(serde_json::Value::Object(serde_json::Map::new()));
        };
        check_length("bytes of attributes", raw.get(), MAX_ATTRIBUTE_BYTES)?;
        parse::<serde_json::Map<_, _>>("attributes", raw).map(Into::into)
    }
}

fn check_length(what: &'static str, text: &str, limit: usize) -> Result<(), Problem> {
    let (found, limit) = (text.len() as u64, limit as u64);
    match found > limit {
        true => Err(Problem::Limit { what, found, limit }),
        false => Ok(()),
    }
}
