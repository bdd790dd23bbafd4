//! Materials to those of glTF, each once a file.

use std::collections::HashMap;

use serde_json::value::{RawValue, to_raw_value};
use serde_json::{Value, json};

use super::color::linear;
use crate::scene::Material;

/// The materials of a file that is written.
#[derive(Default)]
pub(super) struct Materials {
    texts: Vec<Box<RawValue>>,
    numbers: HashMap<String, usize>,
}

impl Materials {
    /// Number of a material, which is added if no equal one is there.
    pub(super) fn number(&mut self, material: &Material) -> serde_json::Result<usize> {
        let text = to_raw_value(&written(material))?;
        if let Some(&number) = self.numbers.get(text.get()) {
            return Ok(number);
        }
        let number = self.texts.len();
        self.numbers.insert(text.get().to_owned(), number);
        self.texts.push(text);
        Ok(number)
    }

    pub(super) fn into_vec(self) -> Vec<Box<RawValue>> {
        self.texts
    }
}

/// A material that says nothing of metal is none, and one that says nothing of roughness is rough:
/// what glTF itself takes for granted is metal. Both sides are drawn, since a surface of a city
/// model need not be closed, nor turned the right way. Highlights and ambient light are what glTF
/// lacks; they go into the extras.
fn written(material: &Material) -> Value {
    let alpha = 1.0 - share(material.transparency);
    let [red, green, blue] = material.diffuse.map(|c| linear(share(c)));
    let mut written = json!({
        "pbrMetallicRoughness": {
            "baseColorFactor": [red, green, blue, alpha],
            "metallicFactor": share(material.metallic.unwrap_or(0.0)),
            "roughnessFactor": share(material.roughness.unwrap_or(1.0)),
        },
        "doubleSided": true,
        "extras": {
            "specular": material.specular.map(share),
            "shininess": share(material.shininess),
            "ambient_intensity": share(material.ambient_intensity),
        },
    });
    if let Some(name) = &material.name {
        written["name"] = json!(name);
    }
    if alpha < 1.0 {
        written["alphaMode"] = json!("BLEND");
    }
    if material.emissive != [0.0; 3] {
        written["emissiveFactor"] = json!(material.emissive.map(|c| linear(share(c))));
    }
    written
}

/// Within 0 to 1; NaN becomes 0.
fn share(value: f64) -> f64 {
    if value.is_nan() {
        0.0
    } else {
        value.clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_materials_are_written_once() {
        let mut materials = Materials::default();
        let red = Material {
            diffuse: [1.0, 0.0, 0.0],
            ..Material::default()
        };
        let numbers = [&Material::default(), &red, &red, &Material::default()]
            .map(|material| materials.number(material).unwrap());
        assert_eq!(numbers, [0, 1, 1, 0]);
        assert_eq!(materials.into_vec().len(), 2);
    }

    #[test]
    fn values_out_of_range_are_brought_into_it() {
        let material = Material {
            diffuse: [f64::NAN, 2.0, -1.0],
            transparency: 0.25,
            ..Material::default()
        };
        let written = written(&material);
        let color = &written["pbrMetallicRoughness"]["baseColorFactor"];
        assert_eq!(*color, json!([0.0, 1.0, 0.0, 0.75]));
        assert_eq!(written["alphaMode"], "BLEND");
    }
}
