//! One geometry of a city object: its type, its level of detail, and its shape.

use std::sync::Arc;

use super::appearance::Appearance;
use super::boundaries::{Boundaries, GeometryType};
use super::budget::Budget;
use super::json::{Members, invalid, string};
use super::semantics::{Values, parse_semantics};
use super::vertices::Vertices;
use crate::error::Problem;
use crate::limits::MAX_LEVEL_OF_DETAIL;
use crate::scene::{Changed, Shape};

/// What geometries refer to, a whole document's or one line's.
pub(super) struct Lists<'b> {
    pub(super) vertices: &'b Vertices,
    pub(super) appearance: &'b Appearance,
}

/// A shape that is no instance.
#[derive(Clone, Debug)]
pub(super) struct ReadShape {
    pub(super) level_of_detail: f64,
    /// False for points and lines, which never have surfaces.
    pub(super) is_surface: bool,
    /// Without surfaces where there are none that are not degenerate.
    pub(super) shape: Arc<Shape>,
    /// Vertices and rings: what placing it once costs.
    pub(super) size: usize,
    pub(super) losses: Losses,
}

/// What of a geometry, or of all of an object's, could not be kept.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Losses {
    textures: bool,
    semantics: bool,
    materials: bool,
    pub(super) flat_instances: bool,
    pub(super) degenerate_rings: usize,
}

impl Losses {
    /// Adds those of another geometry.
    pub(super) fn add(&mut self, other: Self) {
        self.textures |= other.textures;
        self.semantics |= other.semantics;
        self.materials |= other.materials;
        self.flat_instances |= other.flat_instances;
        self.degenerate_rings += other.degenerate_rings;
    }

    /// How an object differs from its source.
    pub(super) fn changes(&self, name: &str, class: &str) -> impl Iterator<Item = Changed> {
        let all = [
            (self.textures, "textures left out"),
            (self.semantics, "malformed semantics left out"),
            (self.materials, "malformed materials left out"),
            (self.flat_instances, "instances made flat left out"),
        ];
        let lost = all.into_iter().filter(|(lost, _)| *lost);
        lost.map(|(_, how)| Changed {
            name: name.to_owned(),
            class: class.to_owned(),
            how: how.to_owned(),
        })
    }
}

/// Reads the surfaces of a geometry that is no instance, with what they mean and look like.
pub(super) fn read_shape(
    members: &Members<'_>,
    kind: GeometryType,
    lists: &Lists<'_>,
    budget: &mut Budget<'_>,
) -> Result<ReadShape, Problem> {
    let level_of_detail = level_of_detail(members)?;
    let raw = members.require("boundaries", "boundaries")?;
    let boundaries = Boundaries::parse(kind, raw, lists.vertices.len())?;
    let mut read = ReadShape {
        level_of_detail,
        is_surface: kind.has_surfaces(),
        shape: Arc::default(),
        size: 0,
        losses: Losses::default(),
    };
    if !read.is_surface {
        return Ok(read);
    }
    read.size = boundaries.size();
    budget.feature_vertices(read.size)?;
    budget.feature_geometry()?;
    let losses = &mut read.losses;
    losses.textures = members
        .get("texture")
        .is_some_and(|texture| texture.get() != "{}");
    let (semantics, semantic_of) = match members.get("semantics") {
        Some(raw) => kept(
            parse_semantics(raw, kind, &boundaries, budget),
            &mut losses.semantics,
        )?,
        None => Default::default(),
    };
    let (materials, material_of) = match members.get("material") {
        Some(raw) => kept(
            lists.appearance.choose(raw, kind, &boundaries),
            &mut losses.materials,
        )?,
        None => Default::default(),
    };
    let surfaces = boundaries.surfaces(lists.vertices, &mut losses.degenerate_rings);
    let value = |values: &Values, surface: usize| values.get(surface).copied().flatten();
    let with_values = surfaces.into_iter().enumerate().filter_map(|(i, surface)| {
        let mut surface = surface?;
        surface.material = value(&material_of, i);
        surface.semantic = value(&semantic_of, i);
        Some(surface)
    });
    read.shape = Arc::new(Shape {
        surfaces: with_values.collect(),
        materials,
        semantics,
    });
    Ok(read)
}

/// What was read, or nothing and the loss noted: what a surface means and looks like is not worth
/// an import. A limit stays an error.
fn kept<T: Default>(read: Result<T, Problem>, lost: &mut bool) -> Result<T, Problem> {
    match read {
        Err(limit @ Problem::Limit { .. }) => Err(limit),
        Err(_) => {
            *lost = true;
            Ok(T::default())
        }
        read => read,
    }
}

/// Reads the member `lod`: a string in the standard, a number in older files.
fn level_of_detail(members: &Members<'_>) -> Result<f64, Problem> {
    let raw = members.require("lod", "lod")?;
    let text = match raw.get().starts_with('"') {
        true => string("lod", raw)?,
        false => raw.get().into(),
    };
    let level = text
        .parse()
        .ok()
        .filter(|level| (0.0..=MAX_LEVEL_OF_DETAIL).contains(level));
    // A negative zero is in the range, and is no level of its own.
    let level = level.map(|level| level + 0.0);
    level.ok_or_else(|| invalid("lod", raw, "a level of detail from 0 to 10"))
}

#[cfg(test)]
mod tests {
    use serde_json::value::RawValue;

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
