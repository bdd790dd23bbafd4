//! The outside of what is packed: a version, then the compressed payload.

use serde::Serialize;
use serde::de::DeserializeOwned;
use zstd::bulk::{Compressor, Decompressor};

use crate::error::Problem;

/// The form that is written; the first byte of everything packed.
const VERSION: u8 = 1;

/// Most bytes of a payload. Its columns take up to 13 bytes of memory for one of these.
const MAX_PAYLOAD_BYTES: usize = 32 << 20;

/// How hard the compressor tries. Level 19 saves one to two percent of a building and takes four to
/// eight times as long.
const COMPRESSION_LEVEL: i32 = 9;

/// What most payloads hold, so that a small one need not spell it out: the meanings of surfaces, in
/// the order in which they usually stand. A change is another version.
const DICTIONARY: &[u8] = br#"
    [{"name":"","class":"BuildingPart","attributes":{}}]
    {"class":"ClosureSurface","attributes":{}},{"class":"WaterSurface","attributes":{}},
    {"class":"TrafficArea","attributes":{}},{"class":"OuterFloorSurface","attributes":{}},
    {"class":"OuterCeilingSurface","attributes":{}},{"class":"Window","attributes":{}},
    {"class":"Door","attributes":{}},[{"class":"WallSurface","attributes":{}},
    [{"class":"RoofSurface","attributes":{}},{"class":"GroundSurface","attributes":{}},{"class":"WallSurface","attributes":{}}]
    [{"class":"GroundSurface","attributes":{}},{"class":"RoofSurface","attributes":{}},{"class":"WallSurface","attributes":{"on_footprint_edge":true}},{"class":"WallSurface","attributes":{"on_footprint_edge":false}}]"#;

/// A value as bytes, always the same for equal ones.
pub(super) fn payload(value: &impl Serialize) -> Result<Vec<u8>, Problem> {
    postcard::to_allocvec(value).map_err(|error| malformed(&error.to_string()))
}

/// What tells payloads apart: the first half of their BLAKE3 hash.
pub(super) fn digest(payload: &[u8]) -> [u8; 16] {
    let hash = blake3::hash(payload);
    let (half, _) = hash.as_bytes().split_at(16);
    std::array::from_fn(|i| half[i])
}

/// Compresses a payload.
pub(super) fn seal(payload: &[u8]) -> Result<Vec<u8>, Problem> {
    check_length(payload.len())?;
    let mut compressor = Compressor::with_dictionary(COMPRESSION_LEVEL, DICTIONARY)?;
    Ok([&[VERSION], compressor.compress(payload)?.as_slice()].concat())
}

/// Decompresses and reads a value.
pub(super) fn open<T: DeserializeOwned>(content: &[u8]) -> Result<T, Problem> {
    let (version, packed) = match content.split_first() {
        None => return Err(malformed("it is empty")),
        Some((version, packed)) => (*version, packed),
    };
    if version != VERSION {
        return Err(Problem::Invalid {
            what: "version of a packed model".to_owned(),
            found: version.to_string(),
            expected: "1",
        });
    }
    let length = match zstd::zstd_safe::get_frame_content_size(packed) {
        Ok(Some(length)) => usize::try_from(length).unwrap_or(usize::MAX),
        _ => return Err(malformed("its length is missing")),
    };
    check_length(length)?;
    let mut decompressor = Decompressor::with_dictionary(DICTIONARY)?;
    let payload = decompressor.decompress(packed, length);
    let payload = payload.map_err(|error| malformed(&error.to_string()))?;
    match postcard::take_from_bytes(&payload) {
        Ok((value, [])) => Ok(value),
        Ok(_) => Err(malformed("bytes are left over")),
        Err(error) => Err(malformed(&error.to_string())),
    }
}

fn check_length(found: usize) -> Result<(), Problem> {
    match found > MAX_PAYLOAD_BYTES {
        true => Err(Problem::Limit {
            what: "bytes of a packed model",
            found: found as u64,
            limit: MAX_PAYLOAD_BYTES as u64,
        }),
        false => Ok(()),
    }
}

/// The problem that content is not as it is written.
pub(super) fn malformed(message: &str) -> Problem {
    Problem::Malformed {
        what: "packed model".to_owned(),
        message: message.to_lowercase(),
    }
}
