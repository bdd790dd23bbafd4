//! What readers read from, and how they hand over what they read.

use std::io::{self, BufRead, Seek};
use std::ops::ControlFlow;

use crate::scene::SceneDescription;

/// Bytes of a file, read from front to back or in any order.
pub trait Input: BufRead + Seek {}

impl<T: BufRead + Seek> Input for T {}

/// Takes a batch of a scene. [`ControlFlow::Break`] ends the reading, without an error.
pub type Sink<'a> = dyn FnMut(SceneDescription) -> ControlFlow<()> + 'a;

/// How to read.
pub struct ReadOptions<'a> {
    /// EPSG code of the projected frame that geographic coordinates are brought into; `None` for
    /// the zone of UTM that they are in. Other formats ignore it.
    pub srid: Option<i32>,
    /// About how many bytes of features a batch holds in memory, where the format allows to read
    /// in batches.
    pub batch_bytes: usize,
    /// Gives the content of a file that lies beside the one that is read and is named in it, such
    /// as a buffer of glTF. The name is as in the file, and hostile.
    pub companion: &'a dyn Fn(&str) -> io::Result<Vec<u8>>,
}

impl Default for ReadOptions<'_> {
    /// Batches of 64 MB and no companions.
    fn default() -> Self {
        Self {
            srid: None,
            batch_bytes: 64 << 20,
            companion: &|_| Err(io::ErrorKind::NotFound.into()),
        }
    }
}
