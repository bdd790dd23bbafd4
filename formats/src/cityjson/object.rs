//! One city object, taken apart as far as the hierarchy and the geometries need.

use std::borrow::Cow;

use serde_json::value::RawValue;
use serde_json::{Map, Value};

use super::budget::Budget;
use super::json::{Members, array, check_count, parse, string, strings};
use crate::error::Problem;
use crate::limits::{MAX_ATTRIBUTE_BYTES, MAX_NAME_BYTES};

/// A city object; its attributes and geometries are still raw.
#[derive(Debug)]
pub(super) struct CityObject<'a> {
    pub(super) id: Cow<'a, str>,
    pub(super) class: Cow<'a, str>,
    pub(super) parents: Vec<Cow<'a, str>>,
    pub(super) children: Vec<Cow<'a, str>>,
    pub(super) members: Members<'a>,
}

impl<'a> CityObject<'a> {
    /// Reads an object under its identifier.
    pub(super) fn parse(id: Cow<'a, str>, raw: &'a RawValue) -> Result<Self, Problem> {
        check_count(
            "bytes of an identifier",
            id.len() as u64,
            MAX_NAME_BYTES as u64,
        )?;
        let members = Members::of("city object", raw)?;
        let class = string("type", members.require("type", "type")?)?;
        check_count("bytes of a type", class.len() as u64, MAX_NAME_BYTES as u64)?;
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
            members,
        })
    }

    /// The geometries, still raw.
    pub(super) fn geometries(&self) -> Result<Vec<&'a RawValue>, Problem> {
        let raw = self.members.get("geometry");
        raw.map_or(Ok(Vec::new()), |raw| array("geometry", raw))
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
    pub(super) fn attributes(&self, budget: &mut Budget<'_>) -> Result<Value, Problem> {
        let Some(raw) = self.members.get("attributes") else {
            return Ok(Map::new().into());
        };
        let bytes = raw.get().len() as u64;
        check_count("bytes of attributes", bytes, MAX_ATTRIBUTE_BYTES as u64)?;
        budget.feature_attributes(raw.get().len())?;
        parse::<Map<_, _>>("attributes", raw).map(Into::into)
    }
}
