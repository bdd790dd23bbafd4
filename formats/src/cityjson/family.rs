//! A root object with its descendants, merged into what a feature needs.

use serde_json::value::RawValue;
use serde_json::{Map, Value};

use super::boundaries::GeometryType;
use super::budget::Budget;
use super::geometry::{Lists, Losses, read_shape};
use super::json::Members;
use super::object::CityObject;
use super::templates::Templates;
use crate::error::{FormatError, Location, Problem};
use crate::scene::{Geometry, Part};

/// What a root and its descendants have.
#[derive(Debug)]
pub(super) struct Family {
    /// The root's.
    pub(super) attributes: Value,
    /// The descendants that have geometry or attributes.
    pub(super) parts: Vec<Part>,
    /// None of them is empty.
    pub(super) geometries: Vec<Geometry>,
    /// Why there is no geometry, where there is none.
    pub(super) why_none: &'static str,
    pub(super) losses: Losses,
}

/// Reads a family, its root first.
pub(super) fn read_family(
    objects: &[&CityObject<'_>],
    templates: &Templates,
    lists: &Lists<'_>,
    budget: &mut Budget<'_>,
    place: &Location,
) -> Result<Family, FormatError> {
    let mut family = Family {
        attributes: Map::new().into(),
        parts: Vec::new(),
        geometries: Vec::new(),
        why_none: "no geometry",
        losses: Losses::default(),
    };
    for (number, object) in objects.iter().enumerate() {
        let at = |problem| place.object(&object.id).error(problem);
        let attributes = object.attributes(budget).map_err(at)?;
        let part = (number > 0).then_some(object.id.as_ref());
        let before = family.geometries.len();
        for (number, raw) in object.geometries().map_err(at)?.into_iter().enumerate() {
            let read = family.read_geometry(raw, part, templates, lists, budget);
            read.map_err(|problem| place.object(&object.id).geometry(number).error(problem))?;
        }
        let is_bare = attributes.as_object().is_none_or(Map::is_empty);
        match part {
            None => family.attributes = attributes,
            Some(name) if !is_bare || family.geometries.len() > before => {
                family.parts.push(Part {
                    name: name.to_owned(),
                    class: object.class.to_string(),
                    attributes,
                });
            }
            Some(_) => {}
        }
    }
    Ok(family)
}

impl Family {
    /// Reads one geometry of the root or of a part.
    fn read_geometry(
        &mut self,
        raw: &RawValue,
        part: Option<&str>,
        templates: &Templates,
        lists: &Lists<'_>,
        budget: &mut Budget<'_>,
    ) -> Result<(), Problem> {
        let members = Members::of("geometry", raw)?;
        let kind = GeometryType::parse(members.require("type", "geometry type")?)?;
        let (read, placement) = match kind {
            GeometryType::Instance => {
                let (template, placement) = templates.place(&members, lists.vertices, budget)?;
                (template, Some(placement))
            }
            _ => (read_shape(&members, kind, lists, budget)?, None),
        };
        self.losses.add(read.losses);
        if read.is_surface {
            self.why_none = "no surface with three distinct vertices";
        } else if self.why_none == "no geometry" {
            self.why_none = "only points or lines";
        }
        if !read.shape.surfaces.is_empty() {
            self.geometries.push(Geometry {
                level_of_detail: read.level_of_detail,
                part: part.map(str::to_owned),
                shape: read.shape,
                placement,
            });
        }
        Ok(())
    }
}
