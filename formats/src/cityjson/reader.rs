//! From the bytes of a file to batches of its scene.

use serde_json::value::RawValue;

use super::batches::Batches;
use super::block::Reader;
use super::budget::{Budget, Limits};
use super::header::Header;
use super::json::{Members, check_nesting, string};
use super::lines::Lines;
use crate::error::{FormatError, Location, Problem, quote, shorten};
use crate::input::{Input, ReadOptions, Sink};

/// Reads a CityJSON document of version 1.1 or 2.0, or a CityJSONSeq: a header on the first line,
/// then a `CityJSONFeature` a line. Which of the two it is shows in the content; `name` is for
/// errors only. Of a sequence no more than a line and a batch is in memory, a document is read
/// whole.
///
/// Each root object becomes one feature with its descendants merged in; the members of a
/// `CityObjectGroup` are features of their own. `Road` and `TransportSquare` become streets,
/// `TINRelief` and what has no surface is skipped. Positions are `vertex * scale + translate`, the
/// same bits wherever a vertex is used; the instances of a template share its shape.
///
/// # Errors
/// Anything that the format does not allow in what is read, and more than the reader's limits; the
/// error names the file, the line of a sequence, the object and the geometry.
pub(crate) fn read(
    name: &str,
    input: &mut dyn Input,
    options: &ReadOptions<'_>,
    sink: &mut Sink<'_>,
) -> Result<(), FormatError> {
    read_within(name, input, options, sink, &Limits::STANDARD)
}

fn read_within(
    name: &str,
    input: &mut dyn Input,
    options: &ReadOptions<'_>,
    sink: &mut Sink<'_>,
    limits: &Limits,
) -> Result<(), FormatError> {
    let file = Location::file(name);
    let at_file = |problem| file.error(problem);
    let mut lines = Lines::new(input).map_err(at_file)?;
    let first = lines.first(limits.document_bytes).map_err(at_file)?;
    let mut document = first.ok_or_else(|| at_file(Problem::Empty))?;
    if ends_within_document(&document) {
        lines
            .rest(&mut document, limits.document_bytes)
            .map_err(at_file)?;
    }
    let first_line = lines.number();
    let mut line = Vec::new();
    let more = lines.next(&mut line, limits.line_bytes);
    let mut more = more.map_err(|problem| file.line(Some(lines.number())).error(problem))?;

    let place = file.line(more.then_some(first_line));
    let here = |problem| place.error(problem);
    let members = document_members(&document).map_err(here)?;
    let mut budget = Budget::new(limits);
    let header = Header::parse(&members, &mut budget).map_err(here)?;
    let batches = Batches::new(header.description.clone(), options.batch_bytes, sink);
    let mut reader = Reader::new(&header, budget, batches);
    let mut flow = reader.add(&members, &place)?;
    while more && flow.is_continue() {
        let place = file.line(Some(lines.number()));
        let members = feature_members(&line).map_err(|problem| place.error(problem))?;
        flow = reader.add(&members, &place)?;
        let next = lines.next(&mut line, limits.line_bytes);
        more = next.map_err(|problem| file.line(Some(lines.number())).error(problem))?;
    }
    if flow.is_continue() {
        reader.finish();
    }
    Ok(())
}

/// Whether a text is the beginning of a JSON value that goes on after it.
fn ends_within_document(text: &[u8]) -> bool {
    let value = serde_json::from_slice::<serde::de::IgnoredAny>(text);
    value.is_err_and(|error| error.is_eof())
}

/// The members of a whole document or of the first line of a sequence.
fn document_members(bytes: &[u8]) -> Result<Members<'_>, Problem> {
    let text = text(bytes)?;
    if !text.trim_start().starts_with('{') {
        return Err(Problem::DocumentType {
            found: format!("no json object but {}", quote(text.trim_start())),
            expected: "\"CityJSON\"",
        });
    }
    let raw = serde_json::from_str(text).map_err(|error| Problem::Syntax {
        message: shorten(&error.to_string()),
    })?;
    check_nesting(text)?;
    let members = Members::of("the document", raw)?;
    check_type(&members, "CityJSON", "\"CityJSON\"")?;
    Ok(members)
}

/// The members of one line of a sequence.
fn feature_members(bytes: &[u8]) -> Result<Members<'_>, Problem> {
    let text = text(bytes)?;
    let raw: &RawValue = serde_json::from_str(text).map_err(|error| {
        // The parser counts lines within this one, so only its column means something.
        let message = error.to_string();
        let words = message
            .rsplit_once(" at line ")
            .map_or(message.as_str(), |(words, _)| words);
        Problem::Syntax {
            message: format!("{} at column {}", shorten(words), error.column()),
        }
    })?;
    check_nesting(text)?;
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

fn text(bytes: &[u8]) -> Result<&str, Problem> {
    let not_utf8 = |error: std::str::Utf8Error| Problem::NotUtf8 {
        offset: error.valid_up_to(),
    };
    std::str::from_utf8(bytes).map_err(not_utf8)
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
    use std::io::Cursor;
    use std::ops::ControlFlow;

    use super::*;
    use crate::scene::SceneDescription;

    /// A triangle as a template with two instances, and one building beside it.
    const DOCUMENT: &str = r#"{"type":"CityJSON","version":"2.0",
        "transform":{"scale":[1,1,1],"translate":[0,0,0]},
        "CityObjects":{
            "a":{"type":"Building","attributes":{"x":1},"geometry":[
                {"type":"MultiSurface","lod":"1","boundaries":[[[0,1,2]],[[0,2,1]]]}]},
            "t":{"type":"SolitaryVegetationObject","geometry":[
                {"type":"GeometryInstance","template":0,"boundaries":[0],
                    "transformationMatrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]},
                {"type":"GeometryInstance","template":0,"boundaries":[1],
                    "transformationMatrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}]}},
        "vertices":[[0,0,0],[1,0,0],[0,1,0]],
        "geometry-templates":{"vertices-templates":[[0,0,0],[1,0,0],[0,1,0]],
            "templates":[{"type":"MultiSurface","lod":"1","boundaries":[[[0,1,2]]]}]}}"#;

    fn read_text(text: &[u8], limits: &Limits) -> Result<SceneDescription, String> {
        let mut scene = SceneDescription::default();
        let sink: &mut Sink<'_> = &mut |batch| {
            scene.add(batch);
            ControlFlow::Continue(())
        };
        let options = ReadOptions::default();
        let read = read_within("a.json", &mut Cursor::new(text), &options, sink, limits);
        read.map(|()| scene).map_err(|error| error.to_string())
    }

    #[test]
    fn each_limit_is_named_just_when_it_is_exceeded() {
        type Pick = fn(&mut Limits) -> &mut u64;
        let (a, t) = (", object \"a\"", ", object \"t\", geometry 1");
        let a_geometry = format!("{a}, geometry 0");
        let cases: [(Pick, u64, &str, &str); 8] = [
            (
                |l| &mut l.document_bytes,
                DOCUMENT.len() as u64,
                "",
                "bytes of a document",
            ),
            (|l| &mut l.objects, 2, "", "objects"),
            (|l| &mut l.vertices, 3, "", "vertices"),
            (
                |l| &mut l.feature_vertices,
                10,
                &a_geometry,
                "vertices and rings of one feature",
            ),
            (
                |l| &mut l.feature_geometries,
                2,
                t,
                "geometries of one feature",
            ),
            (
                |l| &mut l.feature_attribute_bytes,
                7,
                a,
                "bytes of attributes of one feature",
            ),
            (
                |l| &mut l.feature_instance_vertices,
                10,
                t,
                "vertices and rings of template instances in one feature",
            ),
            (
                |l| &mut l.instance_vertices,
                10,
                t,
                "vertices and rings of template instances",
            ),
        ];
        for (limit, enough, place, what) in cases {
            let read_up_to = |most| {
                let mut limits = Limits::STANDARD;
                *limit(&mut limits) = most;
                read_text(DOCUMENT.as_bytes(), &limits).map(|scene| scene.features.len())
            };
            assert_eq!(read_up_to(enough), Ok(2), "{what}");
            let less = enough - 1;
            let expected = format!("a.json{place}: {enough} {what} exceed the limit of {less}");
            assert_eq!(read_up_to(less), Err(expected));
        }
    }

    #[test]
    fn long_lines_are_refused_before_they_are_held() {
        let text = format!("{}\n\n{{{}", DOCUMENT.replace('\n', ""), " ".repeat(1000));
        let limits = Limits {
            line_bytes: 100,
            ..Limits::STANDARD
        };
        let message = read_text(text.as_bytes(), &limits).unwrap_err();
        assert_eq!(
            message,
            "a.json, line 3: 101 bytes of a line exceed the limit of 100"
        );
    }

    #[test]
    fn what_is_no_city_json_is_refused() {
        let cases: [(&[u8], &str); 9] = [
            (b"", ": the file is empty"),
            (b"\xef\xbb\xbf \r\n\n", ": the file is empty"),
            (
                b"{\"type\":\"\xff\"}",
                ": the text is not utf-8 from byte 9 on",
            ),
            (b"\xff\xfe{\0", ": the text is not utf-8 from byte 0 on"),
            (
                b"v 0 0 0\nf 1 1 1",
                ", line 1: type is no json object but \"v 0 0 0\\n\", expected \"CityJSON\"",
            ),
            (
                b"[1]",
                ": type is no json object but \"[1]\", expected \"CityJSON\"",
            ),
            (b"{}", ": type is missing"),
            (b"{\"type\":7}", ": type is 7, expected a string"),
            (
                b"{\"type\":\"FeatureCollection\"}",
                ": type is \"FeatureCollection\", expected \"CityJSON\"",
            ),
        ];
        for (bytes, problem) in cases {
            let read = read_text(bytes, &Limits::STANDARD);
            assert_eq!(read, Err(format!("a.json{problem}")));
        }
    }
}
