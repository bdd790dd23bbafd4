//! Features written as CityJSON 2.0: as a sequence, a feature a line, or as one document.

mod block;
mod classes;
mod frame;
mod geometry;
mod materials;
mod stored;
mod templates;

use serde::Serialize;

use crate::scene::Model;
use block::{Block, Names};
use frame::Frame;
use materials::Materials;
use stored::{Document, FeatureLine, Metadata};
use templates::Templates;

/// Writes models as CityJSONSeq. Positions are rounded to a hundredth of a millimetre; placed
/// shapes that several geometries share become templates. A class that CityJSON does not have
/// becomes `GenericCityObject`; what it has no place for, the metalness and roughness of materials,
/// is left out. Of models with the same name, all but the first have their number appended.
pub fn write_city_json_seq(models: &[Model], srid: Option<i32>) -> String {
    let frame = Frame::around(models);
    let templates = Templates::of(models);
    let mut text = line(&header(
        &frame,
        &templates,
        Block::new(&frame, templates.materials()),
        srid,
    ));
    let mut names = Names::default();
    for model in models {
        let mut block = Block::new(&frame, Materials::default());
        let id = block.add(model, &templates, &mut names);
        text.push_str(&line(&FeatureLine::of(id, block)));
    }
    text
}

/// Writes models as one CityJSON document, otherwise as [`write_city_json_seq`].
pub fn write_city_json(models: &[Model], srid: Option<i32>) -> String {
    let frame = Frame::around(models);
    let templates = Templates::of(models);
    let mut block = Block::new(&frame, templates.materials());
    let mut names = Names::default();
    for model in models {
        block.add(model, &templates, &mut names);
    }
    line(&header(&frame, &templates, block, srid))
}

fn header<'a>(
    frame: &Frame,
    templates: &'a Templates<'_>,
    block: Block<'a>,
    srid: Option<i32>,
) -> Document<'a> {
    Document {
        kind: "CityJSON",
        version: "2.0",
        transform: frame.transform(),
        metadata: srid.map(Metadata::of),
        city_objects: block.objects,
        vertices: block.vertices.into_list(),
        appearance: block.materials.into_appearance(),
        geometry_templates: templates.stored(),
    }
}

fn line(value: &impl Serialize) -> String {
    let mut line = serde_json::to_string(value).expect("keys are strings and nothing fails");
    line.push('\n');
    line
}
