//! From features to the text of a file.

use std::collections::HashMap;
use std::fmt::{Display, Write};
use std::sync::Arc;

use super::decomposition::{Decomposition, decompose};
use super::description::{ATTRIBUTES, CLASS, ID, LEVEL_OF_DETAIL, NAME, ORIGIN, SRID};
use super::face_sets::write_shapes;
use super::frame::placement_to_file;
use super::grid::{on_grid, origin, write_point};
use super::identifier::encode;
use crate::placement::Placement;
use crate::scene::{Geometry, Model, Shape, Surface};

/// Writes features as VRML97, x east, y up, z south: a group each, named by `DEF`, with a
/// `WorldInfo` that gives name, number, class, level of detail and attributes. Positions are from
/// an origin of each feature, on a grid of a hundredth of a millimetre, so that 32-bit readers keep
/// them to a tenth of a millimetre. A shape that several geometries share is written once, unless
/// its placement shears or mirrors. Semantics, parts and the factors of glTF have no place in it.
pub fn write_vrml(models: &[Model], srid: Option<i32>) -> String {
    let geometries = || models.iter().flat_map(|model| &model.feature.geometries);
    let mut writer = Writer {
        text: "#VRML V2.0 utf8\n".to_owned(),
        uses: HashMap::new(),
        written: HashMap::new(),
    };
    for geometry in geometries() {
        *writer.uses.entry(Arc::as_ptr(&geometry.shape)).or_default() += 1;
    }
    let scene_origin = origin(geometries().flat_map(positions));
    let [x, y, z] = scene_origin;
    let srid = srid.map(|srid| (SRID, srid.to_string()));
    let origin = (ORIGIN, format!("{x} {y} {z}"));
    writer.info(&srid.into_iter().chain([origin]).collect::<Vec<_>>());
    writer.open_transform(scene_origin, [0.0; 3], None);
    for model in models {
        writer.model(model, scene_origin);
    }
    writer.text.push_str("] }\n");
    writer.text
}

struct Writer {
    text: String,
    /// How many geometries have each shape.
    uses: HashMap<*const Shape, usize>,
    /// Shapes that a `USE` can name, by number, and the origin of their positions.
    written: HashMap<*const Shape, (usize, [f64; 3])>,
}

impl Writer {
    fn model(&mut self, model: &Model, scene_origin: [f64; 3]) {
        let feature = &model.feature;
        let feature_origin = origin(feature.geometries.iter().flat_map(positions));
        let name = encode(&feature.name);
        if !name.is_empty() {
            self.push(format_args!("DEF {name} "));
        }
        self.open_transform(feature_origin, scene_origin, None);
        let mut said = vec![
            (NAME, feature.name.clone()),
            (ID, model.id.to_string()),
            (CLASS, feature.class.clone()),
            (ATTRIBUTES, feature.attributes.to_string()),
        ];
        let level = feature.geometries.first().map(|g| g.level_of_detail);
        said.extend(level.map(|level| (LEVEL_OF_DETAIL, level.to_string())));
        self.info(&said);
        for geometry in &feature.geometries {
            self.geometry(geometry, feature_origin);
        }
        self.text.push_str("] }\n");
    }

    fn geometry(&mut self, geometry: &Geometry, feature_origin: [f64; 3]) {
        let shape = &geometry.shape;
        let placement = geometry.placement.unwrap_or(Placement::IDENTITY);
        let is_shared = self
            .uses
            .get(&Arc::as_ptr(shape))
            .is_some_and(|uses| *uses > 1);
        let decomposition = decompose(&placement_to_file(&placement)).filter(|_| is_shared);
        match decomposition {
            Some(decomposition) => self.instance(shape, &placement, &decomposition, feature_origin),
            None => {
                let surfaces = geometry.surfaces();
                write_shapes(&mut self.text, &surfaces, &shape.materials, feature_origin);
            }
        }
    }

    fn instance(
        &mut self,
        shape: &Arc<Shape>,
        placement: &Placement,
        decomposition: &Decomposition,
        feature_origin: [f64; 3],
    ) {
        let key = Arc::as_ptr(shape);
        let known = self.written.get(&key).copied();
        let new = || {
            (
                self.written.len() + 1,
                origin(surface_positions(&shape.surfaces)),
            )
        };
        let (number, shape_origin) = known.unwrap_or_else(new);
        self.open_transform(
            placement.apply(shape_origin),
            feature_origin,
            Some(decomposition),
        );
        // Names of features and materials have no colon.
        if known.is_some() {
            self.push(format_args!("USE shape:{number} "));
        } else {
            self.push(format_args!("DEF shape:{number} Group {{ children [\n"));
            write_shapes(
                &mut self.text,
                &shape.surfaces,
                &shape.materials,
                shape_origin,
            );
            self.text.push_str("] } ");
            self.written.insert(key, (number, shape_origin));
        }
        self.text.push_str("] }\n");
    }

    /// Opens a group at a position of the scene, within one whose origin is given.
    fn open_transform(
        &mut self,
        position: [f64; 3],
        around: [f64; 3],
        decomposition: Option<&Decomposition>,
    ) {
        self.text.push_str("Transform { translation ");
        write_point(&mut self.text, on_grid(position, around));
        if let Some(Decomposition { rotation, scale }) = decomposition {
            let [x, y, z, angle] = rotation;
            self.push(format_args!(" rotation {x} {y} {z} {angle}"));
            let [x, y, z] = scale;
            self.push(format_args!(" scale {x} {y} {z}"));
        }
        self.text.push_str(" children [\n");
    }

    /// Writes a `WorldInfo` of words and what they say.
    fn info(&mut self, said: &[(&str, String)]) {
        self.text.push_str("WorldInfo { info [ ");
        for (word, what) in said {
            let what = what.replace('\\', "\\\\").replace('"', "\\\"");
            self.push(format_args!("\"{word} {what}\" "));
        }
        self.text.push_str("] }\n");
    }

    fn push(&mut self, what: impl Display) {
        // Writing to a string cannot fail.
        let _ = write!(self.text, "{what}");
    }
}

/// The positions of a geometry in the scene.
fn positions(geometry: &Geometry) -> impl Iterator<Item = [f64; 3]> {
    let placement = geometry.placement;
    surface_positions(&geometry.shape.surfaces)
        .map(move |position| placement.map_or(position, |placement| placement.apply(position)))
}

fn surface_positions(surfaces: &[Surface]) -> impl Iterator<Item = [f64; 3]> {
    surfaces
        .iter()
        .flat_map(|surface| surface.rings.iter().flatten().copied())
}
