//! Readers and writers of city models. Each format has a folder of its own. Every reader gives the
//! same [`SceneDescription`], in batches: features with their surfaces by level of detail, streets,
//! and what was left out and why. Readers do no I/O of their own; bad input gives a [`FormatError`]
//! that names the file and the place in it, and never a panic.

#![forbid(unsafe_code)]

mod batch;
mod cityjson;
mod error;
mod extrusion;
mod format;
mod geojson;
mod gltf;
mod input;
mod limits;
mod obj;
mod osm_pbf;
mod packed;
mod placement;
mod ply;
mod projection;
mod recognition;
mod scene;
mod shape_builder;
mod vrml;
mod wkb;

pub use cityjson::{write_city_json, write_city_json_seq};
pub use error::{FormatError, Problem};
pub use format::{Format, read, read_as, read_bytes};
pub use gltf::{GlbError, delivered_positions, write_glb};
pub use input::{Input, ReadOptions, Sink};
pub use packed::{PackedShape, pack, pack_shape, unpack, unpack_shape};
pub use placement::Placement;
pub use scene::{
    Changed, Feature, Geometry, Material, Model, Part, SceneDescription, Semantic, Shape, Skipped,
    Street, Surface,
};
pub use vrml::write_vrml;
pub use wkb::read_wkb;
