//! GeoJSON: footprints with a height, and streets as areas or as lines with a width.

mod document;
mod feature;
mod geometry;
mod properties;
mod reference;

use std::collections::HashSet;
use std::io::Read as _;
use std::ops::ControlFlow;

use document::Document;
use feature::{FeatureReader, Read};
use reference::Reference;

use crate::batch::Batch;
use crate::error::{FormatError, Location, Problem, quote};
use crate::input::{Input, ReadOptions, Sink};
use crate::limits::Limits;
use crate::scene::{Changed, SceneDescription};

/// Most bytes of a file: it is read into memory whole.
const MAX_INPUT_BYTES: u64 = 512 << 20;

/// Reads a file.
pub(crate) fn read(
    name: &str,
    input: &mut dyn Input,
    options: &ReadOptions<'_>,
    sink: &mut Sink<'_>,
) -> Result<(), FormatError> {
    let place = Location::file(name);
    let bytes = bytes(input).map_err(|problem| place.error(problem))?;
    let document = Document::parse(&bytes, &Limits::STANDARD);
    let document = document.map_err(|problem| place.error(problem))?;
    let reference = Reference::of(&document, options).map_err(|error| error.at(&place))?;
    let scene = SceneDescription {
        srid: reference.srid(),
        title: document.name.clone(),
        ..SceneDescription::default()
    };
    let mut batch = Batch::new(scene, options, sink);
    let mut names = Names::default();
    let reader = FeatureReader::new(&reference);
    for (number, raw) in document.features.iter().enumerate() {
        let read = reader.read(raw, number).map_err(|error| error.at(&place))?;
        if give(read, &mut names, &mut batch).is_break() {
            return Ok(());
        }
    }
    // The end of the reading asked for by the sink is no error.
    let _ = batch.finish();
    Ok(())
}

/// All of a file.
fn bytes(input: &mut dyn Input) -> Result<Vec<u8>, Problem> {
    let mut bytes = Vec::new();
    input.take(MAX_INPUT_BYTES + 1).read_to_end(&mut bytes)?;
    let found = bytes.len() as u64;
    match found > MAX_INPUT_BYTES {
        true => Err(Problem::Limit {
            what: "bytes of input",
            found,
            limit: MAX_INPUT_BYTES,
        }),
        false => Ok(bytes),
    }
}

fn give(read: Read, names: &mut Names, batch: &mut Batch<'_, '_>) -> ControlFlow<()> {
    let (name, class) = match &read {
        Read::Feature(feature, _) => (&feature.name, &feature.class),
        Read::Street(street) => (&street.name, &street.class),
        Read::Skipped(skipped) => return batch.skipped(skipped.clone()),
    };
    let (name, class) = (name.clone(), class.clone());
    let unique = names.unique(&name);
    let changed = |how: &str| Changed {
        name: unique.clone(),
        class: class.clone(),
        how: how.to_owned(),
    };
    if unique != name {
        batch.changed(changed("a number added to a name that another object has"))?;
    }
    match read {
        Read::Feature(mut feature, note) => {
            if let Some(how) = note {
                batch.changed(changed(how))?;
            }
            feature.name = unique;
            batch.feature(feature)
        }
        Read::Street(mut street) => {
            street.name = unique;
            batch.street(street)
        }
        Read::Skipped(_) => ControlFlow::Continue(()),
    }
}

/// The names that are taken.
#[derive(Default)]
struct Names(HashSet<String>);

impl Names {
    /// The name, or the name with the first number that makes it new.
    fn unique(&mut self, name: &str) -> String {
        if self.0.insert(name.to_owned()) {
            return name.to_owned();
        }
        let numbered = (self.0.len()..).map(|number| format!("{name}#{number}"));
        let unique = numbered
            .into_iter()
            .find(|name| !self.0.contains(name))
            .unwrap_or_default();
        self.0.insert(unique.clone());
        unique
    }
}

/// A problem and the feature that has it.
struct FeatureError {
    feature: Option<String>,
    problem: Problem,
}

impl FeatureError {
    fn at(self, place: &Location) -> FormatError {
        match &self.feature {
            Some(feature) => place.object(feature).error(self.problem),
            None => place.error(self.problem),
        }
    }
}

/// What a feature is called in errors: its number, counted from 0.
fn numbered(number: usize) -> String {
    format!("feature {number}")
}

/// The problem that a value is not what it has to be.
fn invalid(what: &str, found: &str, expected: &'static str) -> Problem {
    Problem::Invalid {
        what: what.to_owned(),
        found: quote(found),
        expected,
    }
}
