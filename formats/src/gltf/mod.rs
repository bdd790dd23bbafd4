//! glTF 2.0 or GLB.

mod color;
mod container;
mod delivery;
mod frame;
mod materials;
mod meshes;
mod record;
mod structure;
mod writer;

pub use delivery::delivered_positions;
pub use writer::{GlbError, write_glb};

use crate::error::{FormatError, Location, Problem};
use crate::input::{Input, ReadOptions, Sink};

/// Reads a file.
pub(crate) fn read(
    name: &str,
    _input: &mut dyn Input,
    _options: &ReadOptions<'_>,
    _sink: &mut Sink<'_>,
) -> Result<(), FormatError> {
    Err(Location::file(name).error(Problem::UnknownFormat))
}
