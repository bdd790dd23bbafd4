//! CityJSON 1.1 and 2.0, and CityJSONSeq, after the specifications at cityjson.org (OGC 20-072).

mod appearance;
mod batches;
mod block;
mod boundaries;
mod budget;
mod family;
mod geometry;
mod header;
mod hierarchy;
mod json;
mod lines;
mod object;
mod reader;
mod semantics;
mod templates;
mod vertices;
mod writer;

pub(crate) use reader::read;
pub use writer::{write_city_json, write_city_json_seq};
