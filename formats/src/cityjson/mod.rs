//! CityJSON 1.1 and 2.0, and CityJSONSeq, after the specifications at cityjson.org (OGC 20-072).

mod appearance;
mod block;
mod boundaries;
mod geometry;
mod header;
mod hierarchy;
mod json;
mod limits;
mod numbering;
mod object;
mod reader;
mod source;
mod templates;
mod vertices;
mod writer;

pub use reader::read_city_json;
