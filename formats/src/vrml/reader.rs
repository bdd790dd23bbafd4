//! From the bytes of a file to its scene.

use std::io::Read;
use std::path::Path;

use super::features::hand_over;
use super::lexer::Fault;
use super::parser::parse;
use super::shapes::MAX_SHARED_VERTICES;
use crate::error::{FormatError, Location, Problem, quote};
use crate::input::{Input, ReadOptions, Sink};
use crate::limits::{Budget, Limits};

/// What a file of version 2.0 begins with.
const HEADER: &str = "#VRML V2.0 utf8";

/// Most that is read: numbers take four times as much memory as the shortest text for them, nodes
/// fifteen times, and the whole file is held until its last feature.
const LIMITS: Limits = Limits {
    input_bytes: 96 << 20,
    objects: 4_000_000,
    instance_vertices: MAX_SHARED_VERTICES as u64,
    ..Limits::STANDARD
};

/// Reads a file.
///
/// # Errors
/// What the grammar does not allow, nodes that are not in the standard, and more than the reader's
/// limits; the error names the line.
pub(crate) fn read(
    name: &str,
    input: &mut dyn Input,
    options: &ReadOptions<'_>,
    sink: &mut Sink<'_>,
) -> Result<(), FormatError> {
    let file = Location::file(name);
    let bytes = bytes(input).map_err(|problem| file.error(problem))?;
    let budget = Budget::new(&LIMITS, bytes.len()).map_err(|problem| file.error(problem))?;
    let text = text(&bytes).map_err(|problem| file.error(problem))?;
    let stem = Path::new(name).file_stem().unwrap_or_default();
    let stem = stem.to_string_lossy();
    scene(text, budget, &stem, options, sink).map_err(|fault| {
        let line = line_of(text, fault.offset);
        file.line(Some(line)).error(fault.problem)
    })
}

fn scene(
    text: &str,
    mut budget: Budget,
    stem: &str,
    options: &ReadOptions<'_>,
    sink: &mut Sink<'_>,
) -> Result<(), Fault> {
    let graph = parse(text, &mut budget)?;
    hand_over(&graph, budget, stem, options.batch_bytes, sink)
}

/// The bytes of the input, one more than the limit at most.
fn bytes(input: &mut dyn Input) -> Result<Vec<u8>, Problem> {
    let mut bytes = Vec::new();
    input.take(LIMITS.input_bytes + 1).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// The bytes as text that begins with the header.
fn text(bytes: &[u8]) -> Result<&str, Problem> {
    let text = std::str::from_utf8(bytes).map_err(|error| Problem::NotUtf8 {
        offset: error.valid_up_to(),
    })?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    match text.starts_with(HEADER) {
        true => Ok(text),
        false => Err(Problem::DocumentType {
            found: quote(text.lines().next().unwrap_or_default()),
            expected: "\"#VRML V2.0 utf8\"",
        }),
    }
}

/// The line, counted from 1, of a byte.
fn line_of(text: &str, offset: usize) -> usize {
    let before = text.as_bytes().get(..offset).unwrap_or_default();
    let ends = before.iter().enumerate().filter(|(i, byte)| match byte {
        b'\n' => true,
        b'\r' => before.get(i + 1) != Some(&b'\n'),
        _ => false,
    });
    1 + ends.count()
}
