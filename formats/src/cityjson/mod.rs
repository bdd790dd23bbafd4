//! CityJSON 1.1 and 2.0, and CityJSONSeq, after the specifications at cityjson.org (OGC 20-072).

mod block;
mod boundaries;
mod geometry;
mod header;
mod hierarchy;
mod json;
mod object;
mod reader;
mod templates;
mod vertices;

pub(crate) use reader::read;
