//! Wavefront OBJ with its material libraries.
//!
//! Each `o` is a feature; without any, each `g`; without both the whole file is one, named like the
//! file. A name that comes again continues its feature. The format says nothing of axes: x is taken
//! as east, y as north and z as up, in metres, as surveyors' programs write it. Faces keep all their
//! corners; texture coordinates, normals, vertex colours and smoothing change no shape and are
//! passed over; lines, points and free-form surfaces are left out.

mod features;
mod lines;
mod materials;
mod reader;

pub(crate) use reader::read;
