//! The objects of a glTF document that is written, each with the members that are used.

use serde::Serialize;
use serde_json::value::RawValue;

use super::record::FeatureRecord;

/// Name of what writes, in the document.
pub(super) const GENERATOR: &str = "pg_occlusion";

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Document<'a> {
    pub(super) asset: Asset,
    pub(super) scene: u32,
    pub(super) scenes: [Scene; 1],
    pub(super) nodes: Vec<Node<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) meshes: Vec<Mesh<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) materials: Vec<Box<RawValue>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) accessors: Vec<Accessor>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) buffer_views: Vec<BufferView>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) buffers: Vec<Buffer>,
}

#[derive(Serialize)]
pub(super) struct Asset {
    pub(super) version: &'static str,
    pub(super) generator: &'static str,
}

#[derive(Serialize)]
pub(super) struct Scene {
    pub(super) nodes: [u32; 1],
}

#[derive(Default, Serialize)]
pub(super) struct Node<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) name: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) mesh: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) translation: Option<[f64; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) matrix: Option<[f64; 16]>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) children: Vec<usize>,
    #[serde(skip_serializing_if = "NodeExtras::is_empty")]
    pub(super) extras: NodeExtras<'a>,
}

#[derive(Default, Serialize)]
pub(super) struct NodeExtras<'a> {
    #[serde(flatten)]
    pub(super) root: Option<RootRecord>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) feature: Option<FeatureRecord<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) part: Option<&'a str>,
}

impl NodeExtras<'_> {
    fn is_empty(&self) -> bool {
        self.root.is_none() && self.feature.is_none() && self.part.is_none()
    }
}

/// What the root node says about the whole file.
#[derive(Serialize)]
pub(super) struct RootRecord {
    pub(super) generator: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) srid: Option<i32>,
    /// The root's translation in the frame of the scene, z up.
    pub(super) origin: [f64; 3],
}

#[derive(Serialize)]
pub(super) struct Mesh<'a> {
    pub(super) primitives: Vec<Primitive<'a>>,
}

#[derive(Serialize)]
pub(super) struct Primitive<'a> {
    pub(super) attributes: Attributes,
    pub(super) indices: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) material: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) extras: Option<PrimitiveExtras<'a>>,
}

#[derive(Serialize)]
#[serde(rename_all = "UPPERCASE")]
pub(super) struct Attributes {
    pub(super) position: usize,
}

#[derive(Serialize)]
pub(super) struct PrimitiveExtras<'a> {
    pub(super) semantic: &'a str,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Accessor {
    pub(super) buffer_view: usize,
    pub(super) byte_offset: usize,
    pub(super) component_type: u32,
    pub(super) count: usize,
    #[serde(rename = "type")]
    pub(super) kind: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) min: Option<[f64; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) max: Option<[f64; 3]>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct BufferView {
    pub(super) buffer: usize,
    pub(super) byte_offset: usize,
    pub(super) byte_length: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) byte_stride: Option<usize>,
    pub(super) target: u32,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Buffer {
    pub(super) byte_length: usize,
}
