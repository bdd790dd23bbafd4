//! From the bytes of a file to the description of its scene.

use serde_json::value::RawValue;

use super::block::SceneBuilder;
use super::header::Header;
use super::json::{Members, check_nesting, string};
use crate::error::{FormatError, Location, Problem, quote, shorten};
use crate::input::{Input, ReadOptions, Sink};
use crate::limits::{Budget, Limits};
use crate::scene::SceneDescription;

/// Reads a CityJSON document of version 1.1 or 2.0, or a CityJSONSeq: a header on the first line,
/// then a `CityJSONFeature` a line. Which of the two it is shows in the content; `name` is for
/// errors only.
///
/// Each root object becomes one feature with its descendants merged in; the members of a
/// `CityObjectGroup` are features of their own. `Road` and `TransportSquare` become streets,
/// `TINRelief` and what has no surface is skipped. Positions are `vertex * scale + translate`, the
/// same bits wherever a vertex is used; templates are placed.
///
/// # Errors
/// Anything that the format does not allow in what is read, and more than the reader's limits; the
/// error names the file, the line of a sequence, the object and the geometry.
pub(crate) fn read(
    name: &str,
    input: &mut dyn Input,
    _options: &ReadOptions<'_>,
    sink: &mut Sink<'_>,
) -> Result<(), FormatError> {
    let mut bytes = Vec::new();
    input
        .read_to_end(&mut bytes)
        .map_err(|error| Location::file(name).error(error.into()))?;
    let scene = read_within(name, &bytes, &Limits::STANDARD)?;
    let _ = sink(scene);
    Ok(())
}

fn read_within(name: &str, bytes: &[u8], limits: &Limits) -> Result<SceneDescription, FormatError> {
    let file = Location::file(name);
    let at_file = |problem| file.error(problem);
    let mut budget = Budget::new(limits, bytes.len()).map_err(at_file)?;
    let text = text(bytes).map_err(at_file)?;
    let (members, rest) = first_document(text).map_err(at_file)?;
    let blank_lines = newlines(&text[..text.len() - text.trim_start().len()]);
    let first = file.line((!rest.trim().is_empty()).then_some(blank_lines + 1));
    let at_first = |problem| first.error(problem);
    check_type(&members, "CityJSON", "\"CityJSON\"").map_err(at_first)?;
    members.refuse_duplicates().map_err(at_first)?;
    let header = Header::parse(&members, &mut budget).map_err(at_first)?;
    let mut builder = SceneBuilder::new(&header, budget);
    builder.add(&members, &first)?;
    let lines_before = newlines(&text[..text.len() - rest.len()]);
    for (i, line) in rest
        .split('\n')
        .enumerate()
        .filter(|(_, line)| !line.trim().is_empty())
    {
        let place = file.line(Some(lines_before + i + 1));
        let members = feature_line(line).map_err(|problem| place.error(problem))?;
        builder.add(&members, &place)?;
    }
    Ok(builder.finish())
}

fn newlines(text: &str) -> usize {
    text.bytes().filter(|byte| *byte == b'\n').count()
}

/// The bytes as text, without a byte order mark.
fn text(bytes: &[u8]) -> Result<&str, Problem> {
    let text = std::str::from_utf8(bytes).map_err(|error| Problem::NotUtf8 {
        offset: error.valid_up_to(),
    })?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    if text.trim().is_empty() {
        return Err(Problem::Empty);
    }
    Ok(text)
}

/// The first JSON object of a text, and the text after it.
fn first_document(text: &str) -> Result<(Members<'_>, &str), Problem> {
    if !text.trim_start().starts_with('{') {
        return Err(Problem::DocumentType {
            found: format!("no json object but {}", quote(text.trim_start())),
            expected: "\"CityJSON\"",
        });
    }
    let mut documents = serde_json::Deserializer::from_str(text).into_iter::<Members<'_>>();
    match documents.next() {
        Some(Ok(members)) => {
            let (document, rest) = text.split_at(documents.byte_offset());
            check_nesting(document)?;
            Ok((members, rest))
        }
        Some(Err(error)) => Err(Problem::Syntax {
            message: shorten(&error.to_string()),
        }),
        None => Err(Problem::Empty),
    }
}

/// The members of one line of a sequence.
fn feature_line(line: &str) -> Result<Members<'_>, Problem> {
    let raw: &RawValue = serde_json::from_str(line).map_err(|error| {
        // The parser counts lines within this one, so only its column means something.
        let message = error.to_string();
        let words = message
            .rsplit_once(" at line ")
            .map_or(message.as_str(), |(words, _)| words);
        Problem::Syntax {
            message: format!("{} at column {}", shorten(words), error.column()),
        }
    })?;
    check_nesting(line)?;
    let members = Members::of("the line", raw)?;
    check_type(&members, "CityJSONFeature", "\"CityJSONFeature\"")?;
    if let Some(transform) = members.get("transform") {
        // Two transforms would leave open which one holds, and a wrong one moves buildings.
        return Err(Problem::Invalid {
            what: "transform".to_owned(),
            found: shorten(transform.get()),
            expected: "none but that of the first line",
        });
    }
    Ok(members)
}

fn check_type(members: &Members<'_>, wanted: &str, expected: &'static str) -> Result<(), Problem> {
    let raw = members.require("type", "type")?;
    if string("type", raw)? == wanted {
        return Ok(());
    }
    Err(Problem::DocumentType {
        found: shorten(raw.get()),
        expected,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square as a template with two instances, and one building beside it.
    const DOCUMENT: &str = r#"{"type":"CityJSON","version":"2.0",
        "transform":{"scale":[1,1,1],"translate":[0,0,0]},
        "CityObjects":{
            "a":{"type":"Building","geometry":[
                {"type":"MultiSurface","lod":"1","boundaries":[[[0,1,2]]]}]},
            "t":{"type":"SolitaryVegetationObject","geometry":[
                {"type":"GeometryInstance","template":0,"boundaries":[0],
                    "transformationMatrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]},
                {"type":"GeometryInstance","template":0,"boundaries":[1],
                    "transformationMatrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}]}},
        "vertices":[[0,0,0],[1,0,0],[0,1,0]],
        "geometry-templates":{"vertices-templates":[[0,0,0],[1,0,0],[0,1,0]],
            "templates":[{"type":"MultiSurface","lod":"1","boundaries":[[[0,1,2]]]}]}}"#;

    type Pick = fn(&mut Limits) -> &mut u64;

    fn message(change: impl Fn(&mut Limits)) -> String {
        let mut limits = Limits::STANDARD;
        change(&mut limits);
        match read_within("a.json", DOCUMENT.as_bytes(), &limits) {
            Ok(scene) => format!("{} features", scene.features.len()),
            Err(error) => error.to_string(),
        }
    }

    #[test]
    fn each_limit_is_named_just_when_it_is_exceeded() {
        let length = DOCUMENT.len() as u64;
        let cases: [(Pick, u64, &str, &str); 5] = [
            (|l| &mut l.input_bytes, length, "", "bytes of input"),
            (|l| &mut l.objects, 2, "", "objects"),
            (|l| &mut l.vertices, 6, "", "vertices"),
            (
                |l| &mut l.surfaces,
                3,
                ", object \"t\", geometry 1",
                "surfaces",
            ),
            (
                |l| &mut l.instance_vertices,
                10,
                ", object \"t\", geometry 1",
                "vertices and rings of template instances",
            ),
        ];
        for (limit, enough, place, what) in cases {
            assert_eq!(
                message(|limits| *limit(limits) = enough),
                "2 features",
                "{what}"
            );
            let less = enough - 1;
            let expected = format!("a.json{place}: {enough} {what} exceed the limit of {less}");
            assert_eq!(message(|limits| *limit(limits) = less), expected);
        }
    }
}
