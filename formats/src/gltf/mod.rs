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
