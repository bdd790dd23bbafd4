//! Materials of glTF to those of a scene.

use std::borrow::Cow;

use serde::Deserialize;
use serde_json::value::RawValue;

use super::color::{encoded, settled};
use super::weight::check_name;
use crate::error::Problem;
use crate::scene::Material;

/// A material as it is read.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct ReadMaterial<'a> {
    #[serde(borrow)]
    name: Option<Cow<'a, str>>,
    #[serde(borrow)]
    pbr_metallic_roughness: MetallicRoughness<'a>,
    emissive_factor: [f64; 3],
    #[serde(borrow)]
    emissive_texture: Option<&'a RawValue>,
    #[serde(borrow)]
    normal_texture: Option<&'a RawValue>,
    #[serde(borrow)]
    occlusion_texture: Option<&'a RawValue>,
    alpha_mode: Cow<'a, str>,
    #[serde(borrow)]
    extras: Option<&'a RawValue>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", default)]
struct MetallicRoughness<'a> {
    base_color_factor: [f64; 4],
    metallic_factor: f64,
    roughness_factor: f64,
    #[serde(borrow)]
    base_color_texture: Option<&'a RawValue>,
    #[serde(borrow)]
    metallic_roughness_texture: Option<&'a RawValue>,
}

impl Default for ReadMaterial<'_> {
    fn default() -> Self {
        Self {
            name: None,
            pbr_metallic_roughness: MetallicRoughness::default(),
            emissive_factor: [0.0; 3],
            emissive_texture: None,
            normal_texture: None,
            occlusion_texture: None,
            alpha_mode: Cow::Borrowed("OPAQUE"),
            extras: None,
        }
    }
}

impl Default for MetallicRoughness<'_> {
    /// The defaults of glTF 2.0, 5.22.
    fn default() -> Self {
        Self {
            base_color_factor: [1.0; 4],
            metallic_factor: 1.0,
            roughness_factor: 1.0,
            base_color_texture: None,
            metallic_roughness_texture: None,
        }
    }
}

/// What glTF lacks, as our writer puts it into the extras.
#[derive(Deserialize)]
struct Highlights {
    specular: [f64; 3],
    shininess: f64,
    ambient_intensity: f64,
}

impl ReadMaterial<'_> {
    pub(super) fn has_textures(&self) -> bool {
        let surface = &self.pbr_metallic_roughness;
        let textures = [
            self.emissive_texture,
            self.normal_texture,
            self.occlusion_texture,
            surface.base_color_texture,
            surface.metallic_roughness_texture,
        ];
        textures.iter().any(Option::is_some)
    }

    /// The material of a scene. Numbers out of range are brought into it.
    pub(super) fn material(&self) -> Result<Material, Problem> {
        check_name(
            "the name of a material",
            self.name.as_deref().unwrap_or_default(),
        )?;
        let color = |c: f64| encoded(c.clamp(0.0, 1.0));
        let surface = &self.pbr_metallic_roughness;
        let [red, green, blue, alpha] = surface.base_color_factor;
        let transparency = if self.alpha_mode == "BLEND" {
            settled(1.0 - alpha.clamp(0.0, 1.0))
        } else {
            0.0
        };
        let mut material = Material {
            name: self.name.as_deref().map(str::to_owned),
            diffuse: [red, green, blue].map(color),
            emissive: self.emissive_factor.map(color),
            transparency,
            metallic: Some(surface.metallic_factor.clamp(0.0, 1.0)),
            roughness: Some(surface.roughness_factor.clamp(0.0, 1.0)),
            ..Material::default()
        };
        let highlights = self.extras.map(|extras| serde_json::from_str(extras.get()));
        if let Some(Ok(Highlights {
            specular,
            shininess,
            ambient_intensity,
        })) = highlights
        {
            material.specular = specular.map(|c| c.clamp(0.0, 1.0));
            material.shininess = shininess.clamp(0.0, 1.0);
            material.ambient_intensity = ambient_intensity.clamp(0.0, 1.0);
        }
        Ok(material)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn material(json: &str) -> Material {
        serde_json::from_str::<ReadMaterial<'_>>(json)
            .unwrap()
            .material()
            .unwrap()
    }

    #[test]
    fn factors_become_srgb_and_transparency() {
        let read = material(
            r#"{"name":"glass","alphaMode":"BLEND","emissiveFactor":[0,0,1],
                "pbrMetallicRoughness":{"baseColorFactor":[0.2140411,1,9,0.25],"roughnessFactor":0}}"#,
        );
        assert!((read.diffuse[0] - 0.5).abs() < 1e-6);
        assert_eq!(read.diffuse[1..], [1.0, 1.0]);
        assert_eq!(read.emissive, [0.0, 0.0, 1.0]);
        assert_eq!(
            (read.transparency, read.name.as_deref()),
            (0.75, Some("glass"))
        );
        assert_eq!((read.metallic, read.roughness), (Some(1.0), Some(0.0)));
    }

    #[test]
    fn alpha_counts_only_where_it_blends() {
        let json = r#"{"pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.25]}}"#;
        assert_eq!(material(json).transparency, 0.0);
    }
}
