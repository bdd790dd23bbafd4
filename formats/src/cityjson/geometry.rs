//! One geometry of a city object: its type, its level of detail, and its surfaces.

use serde_json::value::RawValue;

use super::boundaries::{GeometryType, index_surfaces, surfaces_at};
use super::header::Header;
use super::json::{Members, invalid, parse, string};
use super::templates::Placement;
use super::vertices::Vertices;
use crate::error::Problem;
use crate::limits::{Budget, MAX_LEVEL_OF_DETAIL};
use crate::scene::Surface;

/// A geometry with its surfaces, which may be none.
#[derive(Debug)]
pub(super) struct ReadGeometry {
    pub(super) level_of_detail: f64,
    /// False for points and lines, which never have surfaces.
    pub(super) is_surface: bool,
    pub(super) surfaces: Vec<Surface>,
}

/// Reads one geometry, its instance placed.
pub(super) fn read_geometry(
    members: &Members<'_>,
    header: &Header,
    vertices: &Vertices,
    budget: &mut Budget,
    degenerate_rings: &mut usize,
) -> Result<ReadGeometry, Problem> {
    let kind = GeometryType::parse(members.require("type", "geometry type")?)?;
    let boundaries = members.require("boundaries", "boundaries")?;
    if kind == GeometryType::Instance {
        let index = template_index(members)?;
        let anchor = vertices.position(anchor_index(boundaries, vertices.len())?);
        let matrix = members.require("transformationMatrix", "transformationMatrix")?;
        let placement = Placement::parse(matrix, anchor)?;
        let surfaces = header
            .templates
            .place(index, &placement, budget, degenerate_rings)?;
        let level_of_detail = header.templates.get(index)?.level_of_detail;
        return Ok(ReadGeometry {
            level_of_detail,
            is_surface: true,
            surfaces,
        });
    }
    let level_of_detail = level_of_detail(members)?;
    let index_surfaces = index_surfaces(kind, boundaries, vertices.len())?;
    budget.surfaces(index_surfaces.len())?;
    let surfaces = surfaces_at(&index_surfaces, vertices, degenerate_rings);
    let is_surface = !matches!(
        kind,
        GeometryType::MultiPoint | GeometryType::MultiLineString
    );
    Ok(ReadGeometry {
        level_of_detail,
        is_surface,
        surfaces,
    })
}

/// Reads the member `template` of an instance.
pub(super) fn template_index(members: &Members<'_>) -> Result<u64, Problem> {
    parse("template", members.require("template", "template")?)
}

/// Reads the boundaries of an instance: one vertex.
fn anchor_index(raw: &RawValue, vertex_count: usize) -> Result<usize, Problem> {
    index_surfaces(GeometryType::Instance, raw, vertex_count)?;
    match parse::<Vec<usize>>("boundaries", raw)?[..] {
        [index] => Ok(index),
        _ => Err(invalid("boundaries", raw, "one vertex for the instance")),
    }
}

/// Reads the member `lod`: a string in the standard, a number in older files.
pub(super) fn level_of_detail(members: &Members<'_>) -> Result<f64, Problem> {
    let raw = members.require("lod", "lod")?;
    let text = match raw.get().starts_with('"') {
        true => string("lod", raw)?,
        false => raw.get().into(),
    };
    let level = text
        .parse()
        .ok()
        .filter(|level| (0.0..=MAX_LEVEL_OF_DETAIL).contains(level));
    level.ok_or_else(|| invalid("lod", raw, "a level of detail from 0 to 10"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_of_detail_are_numbers_from_0_to_10() {
        let read = |lod: &str| {
            let text = format!("{{\"lod\":{lod}}}");
            let raw: &RawValue = serde_json::from_str(&text).unwrap();
            level_of_detail(&Members::of("geometry", raw).unwrap()).map_err(|p| p.to_string())
        };
        assert_eq!(read("\"2.2\""), Ok(2.2));
        assert_eq!(read("1"), Ok(1.0));
        for wrong in ["\"NaN\"", "\"inf\"", "-1", "11", "\"two\"", "[]", "true"] {
            let message = format!("lod is {wrong}, expected a level of detail from 0 to 10");
            assert_eq!(read(wrong), Err(message));
        }
        assert_eq!(read("null"), Err("lod is missing".to_owned()));
    }
}
