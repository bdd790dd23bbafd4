//! A feature's source: a document of its own with just the feature's objects, and of the vertices,
//! templates and appearance only what they use. Everything else is copied as raw text, so that
//! semantics, addresses and the members of extensions come along. Written again from itself, a
//! source is the same text.

use serde_json::value::RawValue;

use super::appearance::{Appearance, Origin, UsedAppearance};
use super::boundaries::GeometryType;
use super::geometry::template_index;
use super::header::Header;
use super::hierarchy::Hierarchy;
use super::json::Members;
use super::numbering::{Numbering, rewrite_indices};
use super::object::CityObject;
use super::vertices::Vertices;
use super::writer::{ObjectWriter, write_array, write_string, write_vertex};
use crate::error::Problem;

/// What a source is taken from.
#[derive(Clone, Copy, Debug)]
pub(super) struct Excerpt<'a, 'b> {
    pub(super) header: &'b Header<'a>,
    pub(super) objects: &'b [CityObject<'a>],
    pub(super) hierarchy: &'b Hierarchy,
    pub(super) vertices: &'b Vertices,
    pub(super) appearance: &'b Appearance<'a>,
}

/// Which vertices and templates a source has used so far.
#[derive(Debug)]
struct Used<'a, 'b> {
    vertices: Numbering<u64>,
    templates: Numbering<u64>,
    template_vertices: Numbering<u64>,
    appearance: UsedAppearance<'a, 'b>,
}

impl Excerpt<'_, '_> {
    /// Writes the source of a root and its descendants, whose geometries have been read before.
    pub(super) fn write(&self, family: &[usize]) -> Result<String, Problem> {
        let Self {
            header, vertices, ..
        } = self;
        let mut used = Used {
            vertices: Numbering::default(),
            templates: Numbering::default(),
            template_vertices: Numbering::default(),
            appearance: UsedAppearance::new(self.appearance, &header.appearance),
        };
        let mut out = String::new();
        let mut document = ObjectWriter::start(&mut out);
        document.member("type").push_str("\"CityJSON\"");
        document.member("version").push_str(header.version.get());
        document
            .member("transform")
            .push_str(header.transform_text.get());
        if let Some(extensions) = header.extensions {
            document.member("extensions").push_str(extensions.get());
        }
        if let Some(system) = header.reference_system {
            let mut metadata = ObjectWriter::start(document.member("metadata"));
            metadata.member("referenceSystem").push_str(system.get());
            metadata.end();
        }
        let mut objects = ObjectWriter::start(document.member("CityObjects"));
        for &index in family {
            let id = &self.objects[index].id;
            self.write_object(index, index == family[0], &mut used, objects.member(id))?;
        }
        objects.end();
        write_array(
            document.member("vertices"),
            used.vertices.used(),
            |index, out| {
                write_vertex(out, vertices.stored(*index as usize));
            },
        );
        if !used.templates.used().is_empty() {
            self.write_templates(&mut used, document.member("geometry-templates"))?;
        }
        let mut appearance = String::new();
        if used.appearance.write(&mut appearance) {
            document.member("appearance").push_str(&appearance);
        }
        document.end();
        Ok(out)
    }

    /// Writes one object; its relatives are those of the hierarchy, which may be fewer than it says.
    fn write_object(
        &self,
        index: usize,
        is_root: bool,
        used: &mut Used<'_, '_>,
        out: &mut String,
    ) -> Result<(), Problem> {
        let object = &self.objects[index];
        let mut writer = ObjectWriter::start(out);
        for (name, raw) in object.members.iter() {
            match name {
                "parents" | "children" => {}
                "geometry" => {
                    let out = writer.member(name);
                    write_geometries(&object.geometries, used, out)?;
                }
                _ => writer.member(name).push_str(raw.get()),
            }
        }
        let mut relatives = |name, indices: &[usize]| {
            if !indices.is_empty() {
                write_array(writer.member(name), indices, |relative, out| {
                    write_string(out, &self.objects[*relative].id);
                });
            }
        };
        relatives("children", self.hierarchy.children(index));
        if !is_root {
            relatives("parents", self.hierarchy.parent(index).as_slice());
        }
        writer.end();
        Ok(())
    }

    /// Writes the templates that instances use, with their vertices.
    fn write_templates(&self, used: &mut Used<'_, '_>, out: &mut String) -> Result<(), Problem> {
        let templates = &self.header.templates;
        let mut writer = ObjectWriter::start(out);
        let list = writer.member("templates");
        for (i, index) in used.templates.used().to_vec().into_iter().enumerate() {
            list.push(if i == 0 { '[' } else { ',' });
            write_geometry(
                &templates.get(index)?.members,
                Origin::Templates,
                used,
                list,
            )?;
        }
        list.push(']');
        let out = writer.member("vertices-templates");
        write_array(out, used.template_vertices.used(), |index, out| {
            write_vertex(out, templates.vertices().stored(*index as usize));
        });
        writer.end();
        Ok(())
    }
}

fn write_geometries(
    geometries: &[&RawValue],
    used: &mut Used<'_, '_>,
    out: &mut String,
) -> Result<(), Problem> {
    out.push('[');
    for (i, raw) in geometries.iter().enumerate() {
        if i > 0 {
            out.push(',');
        }
        write_geometry(&Members::of("geometry", raw)?, Origin::Own, used, out)?;
    }
    out.push(']');
    Ok(())
}

/// Writes a geometry, its indices renumbered.
fn write_geometry(
    members: &Members<'_>,
    origin: Origin,
    used: &mut Used<'_, '_>,
    out: &mut String,
) -> Result<(), Problem> {
    let kind = GeometryType::parse(members.require("type", "geometry type")?)?;
    let mut writer = ObjectWriter::start(out);
    for (name, raw) in members.iter().filter(|(_, raw)| raw.get() != "null") {
        match name {
            "boundaries" => {
                let numbering = match origin {
                    Origin::Own => &mut used.vertices,
                    Origin::Templates => &mut used.template_vertices,
                };
                let number = |_, index| Ok(numbering.number(index));
                rewrite_indices("boundaries", raw.get(), writer.member(name), number)?;
            }
            "template" if kind == GeometryType::Instance => {
                let number = used.templates.number(template_index(members)?);
                writer.member(name).push_str(&number.to_string());
            }
            // Real files have materials that are not in their list. How a surface looks changes
            // nothing about what it hides, so the member goes and the feature stays.
            "material" => {
                if let Ok(material) = used.appearance.material(origin, raw) {
                    writer.member(name).push_str(&material);
                }
            }
            "texture" => {
                if let Ok(texture) = used.appearance.texture(origin, raw) {
                    writer.member(name).push_str(&texture);
                }
            }
            _ => writer.member(name).push_str(raw.get()),
        }
    }
    writer.end();
    Ok(())
}
