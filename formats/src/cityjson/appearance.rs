//! Materials and textures: not used for visibility, carried along so that sources stay whole.

use serde_json::value::RawValue;

use super::json::{Members, array};
use super::numbering::{Numbering, rewrite_indices};
use super::writer::{ObjectWriter, write_array};
use crate::error::Problem;

/// The member `appearance`.
#[derive(Debug, Default)]
pub(super) struct Appearance<'a> {
    materials: Vec<&'a RawValue>,
    textures: Vec<&'a RawValue>,
    texture_vertices: Vec<&'a RawValue>,
    default_themes: Vec<(&'static str, &'a RawValue)>,
}

impl<'a> Appearance<'a> {
    /// The appearance of a document or of a line of a sequence.
    pub(super) fn of(document: &Members<'a>) -> Result<Self, Problem> {
        let Some(raw) = document.get("appearance") else {
            return Ok(Self::default());
        };
        let members = Members::of("appearance", raw)?;
        let list = |name| {
            members
                .get(name)
                .map_or(Ok(Vec::new()), |raw| array(name, raw))
        };
        let theme = |name| members.get(name).map(|raw| (name, raw));
        let themes = ["default-theme-texture", "default-theme-material"];
        Ok(Self {
            materials: list("materials")?,
            textures: list("textures")?,
            texture_vertices: list("vertices-texture")?,
            default_themes: themes.into_iter().filter_map(theme).collect(),
        })
    }
}

/// Which of the two appearances that a feature can draw on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Origin {
    /// That of its own document or line.
    Own,
    /// That of the header, which templates use.
    Templates,
}

/// The parts of both appearances that one feature uses, numbered anew in one.
#[derive(Debug)]
pub(super) struct UsedAppearance<'a, 'b> {
    own: &'b Appearance<'a>,
    templates: &'b Appearance<'a>,
    materials: Numbering<(Origin, u64)>,
    textures: Numbering<(Origin, u64)>,
    texture_vertices: Numbering<(Origin, u64)>,
}

impl<'a, 'b> UsedAppearance<'a, 'b> {
    /// Nothing used yet.
    pub(super) fn new(own: &'b Appearance<'a>, templates: &'b Appearance<'a>) -> Self {
        Self {
            own,
            templates,
            materials: Numbering::default(),
            textures: Numbering::default(),
            texture_vertices: Numbering::default(),
        }
    }

    fn from(&self, origin: Origin) -> &'b Appearance<'a> {
        match origin {
            Origin::Own => self.own,
            Origin::Templates => self.templates,
        }
    }

    /// A geometry's member `material` with new numbers. In error nothing counts as used.
    pub(super) fn material(&mut self, origin: Origin, raw: &RawValue) -> Result<String, Problem> {
        let count = self.from(origin).materials.len();
        renumber_themes("material", raw, |_, index| {
            in_range("material", index, count)
        })?;
        renumber_themes("material", raw, |_, index| {
            Ok(self.materials.number((origin, index)))
        })
    }

    /// A geometry's member `texture` with new numbers: in each ring the texture comes first, then
    /// its vertices. In error nothing counts as used.
    pub(super) fn texture(&mut self, origin: Origin, raw: &RawValue) -> Result<String, Problem> {
        let from = self.from(origin);
        renumber_themes("texture", raw, |place, index| match place {
            0 => in_range("texture", index, from.textures.len()),
            _ => in_range("texture vertex", index, from.texture_vertices.len()),
        })?;
        renumber_themes("texture", raw, |place, index| match place {
            0 => Ok(self.textures.number((origin, index))),
            _ => Ok(self.texture_vertices.number((origin, index))),
        })
    }

    /// Writes the appearance that the new numbers point into; false if there is nothing in it.
    pub(super) fn write(&self, out: &mut String) -> bool {
        let used = [&self.materials, &self.textures, &self.texture_vertices];
        if used.iter().all(|numbering| numbering.used().is_empty()) {
            return false;
        }
        let mut object = ObjectWriter::start(out);
        for (name, theme) in &self.own.default_themes {
            object.member(name).push_str(theme.get());
        }
        let materials = |origin| &self.from(origin).materials;
        write_used(object.member("materials"), &self.materials, materials);
        let textures = |origin| &self.from(origin).textures;
        write_used(object.member("textures"), &self.textures, textures);
        let vertices = |origin| &self.from(origin).texture_vertices;
        write_used(
            object.member("vertices-texture"),
            &self.texture_vertices,
            vertices,
        );
        object.end();
        true
    }
}

/// Writes the used elements of a list, which may be of either origin.
fn write_used<'b>(
    out: &mut String,
    numbering: &Numbering<(Origin, u64)>,
    list: impl Fn(Origin) -> &'b Vec<&'b RawValue>,
) {
    write_array(out, numbering.used(), |(origin, index), out| {
        out.push_str(list(*origin)[*index as usize].get());
    });
}

/// `{theme: {"value" or "values": indices}}` with every index replaced.
fn renumber_themes(
    what: &str,
    raw: &RawValue,
    mut replace: impl FnMut(usize, u64) -> Result<u64, Problem>,
) -> Result<String, Problem> {
    let mut out = String::new();
    let mut themes = ObjectWriter::start(&mut out);
    for (name, raw) in Members::of(what, raw)?.iter() {
        let mut theme = ObjectWriter::start(themes.member(name));
        for (name, raw) in Members::of(what, raw)?.iter() {
            let out = theme.member(name);
            match name {
                "value" | "values" => rewrite_indices(what, raw.get(), out, &mut replace)?,
                _ => out.push_str(raw.get()),
            }
        }
        theme.end();
    }
    themes.end();
    Ok(out)
}

fn in_range(what: &'static str, index: u64, count: usize) -> Result<u64, Problem> {
    if index >= count as u64 {
        return Err(Problem::IndexOutOfRange { what, index, count });
    }
    Ok(index)
}
