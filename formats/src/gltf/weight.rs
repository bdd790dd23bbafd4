//! What a feature takes in memory, so that a small file cannot ask for much of it.

use crate::error::{Problem, quote};
use crate::limits::MAX_NAME_BYTES;

/// Bytes of a triangle in memory: a surface, its list of rings, its ring, and what the allocator
/// adds to two of them.
pub(super) const TRIANGLE_BYTES: usize = 176;

/// Bytes that a byte of JSON takes at most when it is a value in memory.
pub(super) const VALUE_BYTES: usize = 40;

/// Most bytes of one feature, some 1.5 million triangles. Batches are handed over between features.
const MAX_BYTES: usize = 256 << 20;

/// The bytes of one feature.
#[derive(Debug)]
pub(super) struct Weight {
    /// Bytes of the unfinished features around it.
    outer: usize,
    own: usize,
}

impl Weight {
    /// Of a feature inside others of so many bytes.
    pub(super) fn within(outer: usize) -> Self {
        Self { outer, own: 0 }
    }

    /// Adds what is about to be made; refuses what would be too much.
    pub(super) fn add(&mut self, bytes: usize) -> Result<(), Problem> {
        self.own = self.own.saturating_add(bytes);
        if self.total() > MAX_BYTES {
            return Err(Problem::Limit {
                what: "bytes of one feature in memory",
                found: self.total() as u64,
                limit: MAX_BYTES as u64,
            });
        }
        Ok(())
    }

    /// Bytes of the feature itself.
    pub(super) fn own(&self) -> usize {
        self.own
    }

    /// Bytes with those of the features around it.
    pub(super) fn total(&self) -> usize {
        self.outer.saturating_add(self.own)
    }
}

/// Refuses names that are too long to be copied.
pub(super) fn check_name(what: &str, name: &str) -> Result<(), Problem> {
    if name.len() > MAX_NAME_BYTES {
        return Err(Problem::Invalid {
            what: what.to_owned(),
            found: quote(name),
            expected: "at most 1024 bytes",
        });
    }
    Ok(())
}
