//! Readers of city models. Each format has a folder of its own, and each gives the same
//! [`SceneDescription`]: features with their surfaces by level of detail, streets, and what was
//! left out and why. Readers take bytes and do no I/O; bad input gives a [`FormatError`] that names
//! the file, the line and the object, and never a panic. So far: CityJSON 1.1, 2.0 and CityJSONSeq.

#![forbid(unsafe_code)]

mod cityjson;
mod error;
mod scene;

pub use cityjson::read_city_json;
pub use error::{FormatError, Problem};
pub use scene::{Feature, Geometry, SceneDescription, Skipped, Street, Surface};
