//! PLY, as text or binary.
//!
//! The faces of a file are one feature, named like the file, or one for each value of the property
//! `object` or `feature_id` of faces, where there is one: the file's name with the value. The format
//! says nothing of axes: x is taken as east, y as north and z as up, in metres. What else vertices
//! and faces have, and other elements, are passed over.

mod header;
mod reader;
mod values;

pub(crate) use reader::read;
