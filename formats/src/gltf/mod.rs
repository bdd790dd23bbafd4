//! glTF 2.0 and GLB: a reader for both and a writer of merged GLB.
//!
//! The reading is typed here and not by the crate `gltf`: that keeps transformations in single
//! precision, which at 447,000 m is 3 cm, and holds all of a document in memory many times its
//! size.

mod accessor;
mod appearance;
mod buffers;
mod color;
mod container;
mod delivery;
mod document;
mod feature;
mod frame;
mod materials;
mod meshes;
mod node;
mod reader;
mod record;
mod shapes;
mod structure;
mod weight;
mod writer;

pub use delivery::delivered_positions;
pub(crate) use reader::read;
pub use writer::{GlbError, write_glb};

/// Bytes in which a document names one of the members that only glTF has.
const BEGINNING: usize = 4096;

/// Whether JSON that begins with these bytes is a glTF document.
pub(crate) fn is_document(start: &[u8]) -> bool {
    let start = String::from_utf8_lossy(&start[..start.len().min(BEGINNING)]);
    let names = |member: &str| start.contains(&format!("\"{member}\""));
    !names("CityJSON")
        && ["asset", "accessors", "bufferViews", "meshes"]
            .into_iter()
            .any(names)
}
