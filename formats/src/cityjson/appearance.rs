//! The member `appearance`: materials, and which theme of them counts.

use serde::Deserialize;
use serde_json::value::RawValue;

use super::boundaries::{Boundaries, GeometryType};
use super::json::{Members, list, string};
use super::semantics::{Values, check_values, surface_values};
use crate::error::Problem;
use crate::scene::Material;

/// Most materials of a document or line.
const MAX_MATERIALS: u64 = 65_536;

/// Materials to choose from.
#[derive(Debug, Default)]
pub(super) struct Appearance {
    materials: Vec<Material>,
    default_theme: Option<String>,
}

/// A material as the file has it.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct StoredMaterial {
    name: Option<String>,
    ambient_intensity: Option<f64>,
    diffuse_color: Option<[f64; 3]>,
    emissive_color: Option<[f64; 3]>,
    specular_color: Option<[f64; 3]>,
    shininess: Option<f64>,
    transparency: Option<f64>,
}

impl Appearance {
    /// Reads what a document or line has. What is not as the format has it costs the materials, not
    /// the import: the geometries that refer to them are told to have lost them.
    pub(super) fn parse(raw: &RawValue) -> Self {
        Self::try_parse(raw).unwrap_or_default()
    }

    fn try_parse(raw: &RawValue) -> Result<Self, Problem> {
        let members = Members::of("appearance", raw)?;
        let stored: Vec<StoredMaterial> = match members.get("materials") {
            Some(raw) => list("materials", raw, "materials", MAX_MATERIALS)?,
            None => Vec::new(),
        };
        let theme = members.get("default-theme-material");
        let theme = theme.map(|raw| string("default-theme-material", raw));
        Ok(Self {
            materials: stored.into_iter().map(Material::from).collect(),
            default_theme: theme.transpose()?.map(|theme| theme.into_owned()),
        })
    }

    /// The materials that a geometry uses in the default theme, or else its first, and the one of
    /// each surface among them. `raw` is the geometry's member `material`.
    pub(super) fn choose(
        &self,
        raw: &RawValue,
        kind: GeometryType,
        boundaries: &Boundaries,
    ) -> Result<(Vec<Material>, Values), Problem> {
        let themes = Members::of("material", raw)?;
        let theme = self
            .default_theme
            .as_deref()
            .and_then(|theme| themes.get(theme));
        let Some(theme) = theme.or_else(|| themes.first()) else {
            return Ok(Default::default());
        };
        let theme = Members::of("theme", theme)?;
        let mut values = surface_values(theme.get("values"), kind, boundaries)?;
        if let Some(raw) = theme.get("value") {
            let value: u32 = super::json::parse("value", raw)?;
            values.fill(Some(value));
        }
        check_values(&values, self.materials.len())?;
        let mut used: Vec<u32> = values.iter().flatten().copied().collect();
        used.sort_unstable();
        used.dedup();
        for value in values.iter_mut().flatten() {
            *value = used.partition_point(|earlier| earlier < value) as u32;
        }
        let material = |i: &u32| self.materials[*i as usize].clone();
        Ok((used.iter().map(material).collect(), values))
    }
}

impl From<StoredMaterial> for Material {
    /// What the file does not say is as in VRML97, where the model comes from.
    fn from(stored: StoredMaterial) -> Self {
        let default = Self::default();
        let share = |share: Option<f64>, or: f64| share.unwrap_or(or).clamp(0.0, 1.0);
        let colour = |colour: Option<[f64; 3]>, or: [f64; 3]| {
            colour.unwrap_or(or).map(|share| share.clamp(0.0, 1.0))
        };
        Self {
            name: stored.name.filter(|name| !name.is_empty()),
            diffuse: colour(stored.diffuse_color, default.diffuse),
            emissive: colour(stored.emissive_color, default.emissive),
            specular: colour(stored.specular_color, default.specular),
            shininess: share(stored.shininess, default.shininess),
            ambient_intensity: share(stored.ambient_intensity, default.ambient_intensity),
            transparency: share(stored.transparency, default.transparency),
            ..default
        }
    }
}
