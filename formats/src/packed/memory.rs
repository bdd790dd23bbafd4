//! How much memory what is unpacked may take.

use std::mem::size_of;

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::container::malformed;
use crate::error::Problem;
use crate::scene::{Geometry, Surface};

/// Most bytes of memory of one model, unpacked.
const MAX_UNPACKED_BYTES: u64 = 256 << 20;

/// Bytes that attributes and names take in memory for each byte of their text, at most.
const BYTES_PER_TEXT_BYTE: u64 = 40;

/// What a model has used so far.
#[derive(Debug, Default)]
pub(super) struct Memory {
    bytes: u64,
}

impl Memory {
    /// Spends what so many surfaces take, without their rings.
    pub(super) fn surfaces(&mut self, count: usize) -> Result<(), Problem> {
        self.spend(count, size_of::<Surface>() as u64)
    }

    /// Spends what so many rings take, without their positions.
    pub(super) fn rings(&mut self, count: usize) -> Result<(), Problem> {
        self.spend(count, size_of::<Vec<[f64; 3]>>() as u64)
    }

    /// Spends what so many positions in rings take.
    pub(super) fn positions(&mut self, count: usize) -> Result<(), Problem> {
        self.spend(count, size_of::<[f64; 3]>() as u64)
    }

    /// Spends what so many geometries take, without their shapes.
    pub(super) fn geometries(&mut self, count: usize) -> Result<(), Problem> {
        self.spend(count, size_of::<Geometry>() as u64)
    }

    /// Values as JSON, none as nothing. Spends what they take once the text is read.
    pub(super) fn encode<T: Serialize>(&mut self, values: &[T]) -> Result<String, Problem> {
        if values.is_empty() {
            return Ok(String::new());
        }
        let text = serde_json::to_string(values).map_err(|error| malformed(&error.to_string()))?;
        self.spend(text.len(), BYTES_PER_TEXT_BYTE)?;
        Ok(text)
    }

    /// Values from JSON.
    pub(super) fn decode<T: DeserializeOwned>(&mut self, text: &str) -> Result<Vec<T>, Problem> {
        if text.is_empty() {
            return Ok(Vec::new());
        }
        self.spend(text.len(), BYTES_PER_TEXT_BYTE)?;
        serde_json::from_str(text).map_err(|error| malformed(&error.to_string()))
    }

    fn spend(&mut self, count: usize, bytes: u64) -> Result<(), Problem> {
        self.bytes = self
            .bytes
            .saturating_add(bytes.saturating_mul(count as u64));
        match self.bytes > MAX_UNPACKED_BYTES {
            true => Err(Problem::Limit {
                what: "bytes of an unpacked model",
                found: self.bytes,
                limit: MAX_UNPACKED_BYTES,
            }),
            false => Ok(()),
        }
    }
}
