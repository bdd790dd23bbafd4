//! glTF 2.0 or GLB.

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
