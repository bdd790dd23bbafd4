//! VRML97 (ISO/IEC 14772-1), read as a grammar with a table of node types, and written.
//!
//! Files have x east, y up, z south, in metres; scenes get x, -z, y. Each node of the root that
//! has shapes in it is a feature, or each child where a single group holds all of them; its name is
//! that of its `DEF`, or that of the file with a number. All its shapes at one level of detail are
//! one geometry, except those that `USE` puts in several places: these are one shape with a
//! placement each. The levels of an `LOD` node, best first, are levels of detail 2, 1 and 0, and
//! what is outside of it belongs to all of them. `Billboard` does not turn and `Collision` shows
//! its children. Routes, sensors, interpolators, scripts, lights and sounds change no shape and are
//! passed over. `PROTO`, `EXTERNPROTO` and `Inline` are refused, since shapes would be missing.

mod bridge;
mod decomposition;
mod description;
mod extrusion;
mod face_sets;
mod faces;
mod features;
mod field_type;
mod frame;
mod graph;
mod grid;
mod identifier;
mod lexer;
mod material;
mod meshes;
mod node_types;
mod parser;
mod reader;
mod shapes;
mod solids;
mod writer;

pub(crate) use reader::read;
pub use writer::write_vrml;
