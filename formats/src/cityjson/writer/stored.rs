//! What is written, member by member.

use serde::{Serialize, Serializer};
use serde_json::{Map, Value};

use super::block::Block;
use crate::scene::Material;

/// A document, or the first line of a sequence.
#[derive(Serialize)]
pub(super) struct Document<'a> {
    #[serde(rename = "type")]
    pub(super) kind: &'static str,
    pub(super) version: &'static str,
    pub(super) transform: Transform,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) metadata: Option<Metadata>,
    #[serde(rename = "CityObjects", serialize_with = "as_map")]
    pub(super) city_objects: Vec<(String, CityObject<'a>)>,
    pub(super) vertices: Vec<[i64; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) appearance: Option<Appearance<'a>>,
    #[serde(rename = "geometry-templates", skip_serializing_if = "Option::is_none")]
    pub(super) geometry_templates: Option<GeometryTemplates<'a>>,
}

/// A further line of a sequence.
#[derive(Serialize)]
pub(super) struct FeatureLine<'a> {
    #[serde(rename = "type")]
    kind: &'static str,
    id: String,
    #[serde(rename = "CityObjects", serialize_with = "as_map")]
    city_objects: Vec<(String, CityObject<'a>)>,
    vertices: Vec<[i64; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    appearance: Option<Appearance<'a>>,
}

impl<'a> FeatureLine<'a> {
    /// The line of a block with one feature.
    pub(super) fn of(id: String, block: Block<'a>) -> Self {
        Self {
            kind: "CityJSONFeature",
            id,
            city_objects: block.objects,
            vertices: block.vertices.into_list(),
            appearance: block.materials.into_appearance(),
        }
    }
}

#[derive(Serialize)]
pub(super) struct Transform {
    pub(super) scale: [f64; 3],
    pub(super) translate: [f64; 3],
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Metadata {
    reference_system: String,
}

impl Metadata {
    /// Names the reference system.
    pub(super) fn of(srid: i32) -> Self {
        Self {
            reference_system: format!("https://www.opengis.net/def/crs/EPSG/0/{srid}"),
        }
    }
}

#[derive(Serialize)]
pub(super) struct CityObject<'a> {
    #[serde(rename = "type")]
    pub(super) class: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) attributes: Option<&'a Value>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) children: Vec<String>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) parents: Vec<String>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) geometry: Vec<StoredGeometry>,
}

#[derive(Clone, Serialize)]
#[serde(untagged)]
pub(super) enum StoredGeometry {
    Surfaces(Surfaces),
    Instance(Instance),
}

#[derive(Clone, Serialize)]
pub(super) struct Surfaces {
    #[serde(rename = "type")]
    pub(super) kind: &'static str,
    pub(super) lod: String,
    pub(super) boundaries: Shell<IndexSurface>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) semantics: Option<Semantics>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) material: Option<Themes>,
}

/// A surface as rings of vertex indices.
pub(super) type IndexSurface = Vec<Vec<usize>>;

/// Something for each surface: a plain list, or within the one shell of a solid.
#[derive(Clone, Serialize)]
#[serde(untagged)]
pub(super) enum Shell<T> {
    Open(Vec<T>),
    Solid([Vec<T>; 1]),
}

#[derive(Clone, Serialize)]
pub(super) struct Semantics {
    pub(super) surfaces: Vec<Map<String, Value>>,
    pub(super) values: Shell<Option<u32>>,
}

/// Materials of surfaces by theme, of which there is one.
#[derive(Clone, Serialize)]
pub(super) struct Themes {
    pub(super) default: Theme,
}

#[derive(Clone, Serialize)]
pub(super) struct Theme {
    pub(super) values: Shell<Option<usize>>,
}

#[derive(Clone, Serialize)]
pub(super) struct Instance {
    #[serde(rename = "type")]
    pub(super) kind: &'static str,
    pub(super) template: usize,
    pub(super) boundaries: [usize; 1],
    #[serde(rename = "transformationMatrix")]
    pub(super) transformation_matrix: [f64; 16],
}

#[derive(Serialize)]
pub(super) struct GeometryTemplates<'a> {
    pub(super) templates: &'a [StoredGeometry],
    #[serde(rename = "vertices-templates")]
    pub(super) vertices: &'a [[f64; 3]],
}

#[derive(Serialize)]
pub(super) struct Appearance<'a> {
    pub(super) materials: Vec<StoredMaterial<'a>>,
    #[serde(rename = "default-theme-material")]
    pub(super) default_theme: &'static str,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct StoredMaterial<'a> {
    /// Required; empty where the material has none.
    name: &'a str,
    ambient_intensity: f64,
    diffuse_color: [f64; 3],
    emissive_color: [f64; 3],
    specular_color: [f64; 3],
    shininess: f64,
    transparency: f64,
}

impl<'a> From<&'a Material> for StoredMaterial<'a> {
    fn from(material: &'a Material) -> Self {
        Self {
            name: material.name.as_deref().unwrap_or_default(),
            ambient_intensity: material.ambient_intensity,
            diffuse_color: material.diffuse,
            emissive_color: material.emissive,
            specular_color: material.specular,
            shininess: material.shininess,
            transparency: material.transparency,
        }
    }
}

fn as_map<S: Serializer>(
    objects: &[(String, CityObject<'_>)],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    serializer.collect_map(objects.iter().map(|(name, object)| (name, object)))
}
