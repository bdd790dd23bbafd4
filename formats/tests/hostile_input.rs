//! Each way in which a file can be wrong, with the message that says so.

mod common;

use common::{BOX_SHELL, TRANSFORM, building, document, object, read_all};
use formats::FormatError;

fn error(bytes: impl AsRef<[u8]>) -> FormatError {
    match read_all("bad.json", bytes.as_ref()) {
        Err(error) => error,
        Ok(scene) => panic!("read {} features", scene.features.len()),
    }
}

fn message(bytes: impl AsRef<[u8]>) -> String {
    error(bytes).to_string()
}

/// A sequence with these lines after its header.
fn sequence(lines: &[&str]) -> String {
    let header = format!(
        r#"{{"type":"CityJSON","version":"2.0","transform":{TRANSFORM},"CityObjects":{{}},"vertices":[]}}"#
    );
    [&[header.as_str()], lines].concat().join("\n")
}

/// A document with one object, given without its braces.
fn with_object(members: &str) -> String {
    document(&format!("\"a\":{{{members}}}"))
}

/// A document with one building, given the members of its one geometry.
fn with_geometry(members: &str) -> String {
    with_object(&format!(r#""type":"Building","geometry":[{{{members}}}]"#))
}

#[test]
fn versions_and_members_of_the_document_are_checked() {
    let good = document(&building("a"));
    let replaced = |from: &str, to: &str| {
        assert!(good.contains(from));
        message(good.replace(from, to))
    };
    assert_eq!(
        replaced("\"2.0\"", "\"1.0\""),
        "bad.json: cityjson version \"1.0\" is not supported, expected \"1.1\" or \"2.0\""
    );
    assert_eq!(
        replaced("\"2.0\"", "2.0"),
        "bad.json: version is 2.0, expected a string"
    );
    assert_eq!(
        replaced("\"version\"", "\"v\""),
        "bad.json: version is missing"
    );
    assert_eq!(
        replaced("\"transform\"", "\"t\""),
        "bad.json: transform is missing"
    );
    let transform = |text| replaced(TRANSFORM, text);
    assert_eq!(
        transform(r#"{"scale":[],"translate":[]}"#),
        "bad.json: transform.scale is [], expected three numbers"
    );
    assert_eq!(
        transform(r#"{"scale":[1,1,1]}"#),
        "bad.json: transform.translate is missing"
    );
    assert_eq!(
        transform(r#"{"scale":[1e300,1,1],"translate":[0,0,0]}"#),
        "bad.json: vertex 1 is [2e303, 0.0, 0.0] in metres, expected coordinates within 1e9 of zero"
    );
    assert_eq!(
        replaced("\"CityObjects\"", "\"c\""),
        "bad.json: CityObjects is missing"
    );
    assert_eq!(
        replaced("\"vertices\"", "\"v\""),
        "bad.json: vertices is missing"
    );
    assert_eq!(
        replaced("[2000,0,0]", "[2000,0]"),
        "bad.json: vertex 1 is [2000,0], expected three numbers"
    );
    assert_eq!(
        replaced("[2000,0,0]", "[1e999,0,0]"),
        "bad.json: vertex 1 is [1e999,0,0], expected three numbers"
    );
    assert_eq!(
        replaced("\"vertices\"", "\"version\":\"2.0\",\"vertices\""),
        "bad.json: \"version\" appears twice"
    );
    assert_eq!(
        replaced("\"version\"", "\"metadata\":[],\"version\""),
        "bad.json: metadata is [], expected an object"
    );
}

#[test]
fn every_truncation_is_an_error_with_its_place() {
    let text = document(&building("a"));
    for end in 0..text.len() {
        let message = message(&text[..end]);
        assert!(end == 0 || message.contains("line 1 column"), "{message}");
    }
    let line = r#"{"type":"CityJSONFeature","id":"a","CityObjects":{"a":{"type":"Buil"#;
    assert_eq!(
        message(sequence(&[line])),
        "bad.json, line 2: not valid json: EOF while parsing a string at column 67"
    );
}

#[test]
fn not_a_number_is_not_json() {
    let text = document(&building("a")).replace("[2000,0,0]", "[NaN,0,0]");
    let message = message(text);
    assert!(message.starts_with("bad.json: not valid json: expected value at line 1 column"));
}

#[test]
fn wrong_boundaries_name_object_and_geometry() {
    let boundaries = |text: &str| {
        message(with_geometry(&format!(
            r#""type":"MultiSurface","lod":"1","boundaries":{text}"#
        )))
    };
    let start = "bad.json, object \"a\", geometry 0: ";
    assert_eq!(
        boundaries("[[[0,1,8]]]"),
        format!("{start}vertex index 8 is out of range, there are 8")
    );
    for (index, found) in [
        ("-1", "invalid value: integer `-1`, expected u64"),
        ("0.5", "invalid type: floating point `0.5`, expected u64"),
        ("1e999", "number out of range"),
        (
            "99999999999999999999",
            "invalid type: floating point `1e+20`, expected u64",
        ),
        ("\"0\"", "invalid type: string \"0\", expected u64"),
        ("null", "invalid type: null, expected u64"),
        ("[[[0]]]", "invalid type: sequence, expected u64"),
    ] {
        assert_eq!(
            boundaries(&format!("[[[0,1,{index}]]]")),
            format!("{start}boundaries is malformed: {found}")
        );
    }
    let long = boundaries(&format!("\"{}\"", "x".repeat(100_000)));
    assert!(long.len() < 200, "{long}");
}

#[test]
fn wrong_geometries_are_refused() {
    let start = "bad.json, object \"a\", geometry 0: ";
    let boundaries = r#""boundaries":[[[0,1,2]]]"#;
    for (members, problem) in [
        (r#""lod":"1""#.to_owned(), "geometry type is missing"),
        (
            r#""type":"MultiSurface","lod":"1""#.to_owned(),
            "boundaries is missing",
        ),
        (
            format!(r#""type":"MultiSurface",{boundaries}"#),
            "lod is missing",
        ),
        (
            format!(r#""type":"Sphere","lod":"1",{boundaries}"#),
            "geometry type is \"Sphere\", expected a geometry type of cityjson",
        ),
        (
            format!(r#""type":"Solid","lod":"1e5",{boundaries}"#),
            "lod is \"1e5\", expected a level of detail from 0 to 10",
        ),
        (
            format!(r#""type":"Solid","lod":"1","lod":"2",{boundaries}"#),
            "\"lod\" appears twice",
        ),
    ] {
        assert_eq!(
            message(with_geometry(&members)),
            format!("{start}{problem}")
        );
    }
}

#[test]
fn wrong_instances_are_refused() {
    let identity = "[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]";
    let instance = |template: &str, boundaries: &str, matrix: &str, templates: &str| {
        let members = format!(
            r#""type":"GeometryInstance","template":{template},"boundaries":{boundaries},"transformationMatrix":{matrix}"#
        );
        let mut text = with_geometry(&members);
        text.pop();
        message(format!(r#"{text},"geometry-templates":{templates}}}"#))
    };
    let templates = r#"{"vertices-templates":[[0,0,0],[1,0,0],[0,1,0]],
        "templates":[{"type":"MultiSurface","lod":"1","boundaries":[[[0,1,2]]]}]}"#;
    let start = "bad.json, object \"a\", geometry 0: ";
    assert_eq!(
        instance("1", "[0]", identity, templates),
        format!("{start}template 1 is out of range, there are 1")
    );
    assert_eq!(
        instance("-1", "[0]", identity, templates),
        format!("{start}template is malformed: invalid value: integer `-1`, expected u64")
    );
    assert_eq!(
        instance("0", "[8]", identity, templates),
        format!("{start}vertex index 8 is out of range, there are 8")
    );
    assert_eq!(
        instance("0", "[0,1]", identity, templates),
        format!("{start}boundaries is [0,1], expected one vertex for the instance")
    );
    assert_eq!(
        instance("0", "[0]", "[1]", templates),
        format!("{start}transformationMatrix is [1], expected 16 numbers")
    );
    let huge = identity.replacen('1', "1e300", 1);
    assert!(instance("0", "[0]", &huge, templates).contains("expected coordinates within 1e9"));
    let wrong_index = templates.replace("[[[0,1,2]]]", "[[[0,1,3]]]");
    assert_eq!(
        instance("0", "[0]", identity, &wrong_index),
        "bad.json: vertex index 3 is out of range, there are 3"
    );
    let nested = r#"{"vertices-templates":[],"templates":[{"type":"GeometryInstance"}]}"#;
    assert_eq!(
        instance("0", "[0]", identity, nested),
        "bad.json: template type is \"GeometryInstance\", expected a geometry that is not an instance"
    );
    assert_eq!(
        instance("0", "[0]", identity, "{}"),
        "bad.json: vertices-templates is missing"
    );
}

#[test]
fn wrong_objects_are_refused() {
    let start = "bad.json, object \"a\": ";
    for (members, problem) in [
        ("", "type is missing"),
        (r#""type":7"#, "type is 7, expected a string"),
        (
            r#""type":"Building","geometry":{}"#,
            "geometry is {}, expected an array",
        ),
        (
            r#""type":"Building","children":"b""#,
            "children is \"b\", expected an array",
        ),
        (
            r#""type":"Building","parents":[7]"#,
            "parents is 7, expected a string",
        ),
        (
            r#""type":"Building","children":["b"]"#,
            "child \"b\" is not in the document",
        ),
        (
            r#""type":"Building","children":["a"]"#,
            "the object is one of its own ancestors",
        ),
    ] {
        assert_eq!(message(with_object(members)), format!("{start}{problem}"));
    }
    assert_eq!(
        message(document("\"a\":[]")),
        format!("{start}city object is [], expected an object")
    );
    let attributes = building("a").replacen('{', r#"{"attributes":[1],"#, 1);
    assert_eq!(
        message(document(&attributes)),
        format!("{start}attributes is malformed: invalid type: sequence, expected a map")
    );
    let twice = document(&[building("a"), building("a")].join(","));
    assert_eq!(message(twice), "bad.json: \"a\" appears twice");
    let name = "n".repeat(1025);
    assert!(
        message(document(&building(&name)))
            .ends_with("1025 bytes of an identifier exceed the limit of 1024")
    );
    let zeros = format!("\"attributes\":{{\"x\":[0{}]}},", ",0".repeat(1 << 19));
    let attributes = building("a").replacen('{', &format!("{{{zeros}"), 1);
    assert_eq!(
        message(document(&attributes)),
        format!("{start}1048585 bytes of attributes exceed the limit of 1048576")
    );
    let not_object = message(with_object(r#""type":"Building","geometry":[7]"#));
    assert_eq!(
        not_object,
        "bad.json, object \"a\", geometry 0: geometry is 7, expected an object"
    );
}

#[test]
fn wrong_lines_of_a_sequence_are_named() {
    let line = |id: &str| {
        let square = object(id, "Building", "MultiSurface", "[[[0,1,2]]]");
        format!(
            r#"{{"type":"CityJSONFeature","id":"{id}","CityObjects":{{{square}}},"vertices":[[0,0,0],[1,0,0],[0,1,0]]}}"#
        )
    };
    let (a, b) = (line("a"), line("b"));
    let second = |text: &str| message(sequence(&[&a, "", text]));
    assert_eq!(
        second(&a),
        "bad.json, line 4, object \"a\": \"a\" appears twice"
    );
    assert_eq!(
        second(&b.replace("[0,1,2]", "[0,1,3]")),
        "bad.json, line 4, object \"b\", geometry 0: vertex index 3 is out of range, there are 3"
    );
    assert_eq!(
        second(&b.replace("CityJSONFeature", "CityJSON")),
        "bad.json, line 4: type is \"CityJSON\", expected \"CityJSONFeature\""
    );
    assert_eq!(
        second("[]"),
        "bad.json, line 4: the line is [], expected an object"
    );
    assert_eq!(
        second("}"),
        "bad.json, line 4: not valid json: expected value at column 1"
    );
    let with_transform = b.replacen('{', r#"{"transform":{},"#, 1);
    assert_eq!(
        second(&with_transform),
        "bad.json, line 4: transform is {}, expected none but that of the first line"
    );
    assert_eq!(
        message(&a),
        "bad.json: type is \"CityJSONFeature\", expected \"CityJSON\""
    );
    let error = error(sequence(&[&a, &a]));
    assert_eq!(
        (error.file(), error.line(), error.object()),
        ("bad.json", Some(3), Some("a"))
    );
}

#[test]
fn deep_nesting_is_refused_and_takes_no_stack() {
    let deep = format!("{}{}", "[".repeat(1_000_000), "]".repeat(1_000_000));
    let text = with_object(&format!(r#""type":"Building","attributes":{{"x":{deep}}}"#));
    assert_eq!(
        message(text),
        "bad.json: 1000004 levels of nesting exceed the limit of 100"
    );
    let open = format!(r#"{{"type":"CityJSON","x":{}"#, "[".repeat(1_000_000));
    assert!(message(open).contains("EOF while parsing"));
}

#[test]
fn instances_cannot_multiply_a_template_without_end() {
    let surfaces = vec!["[[0,1,2]]"; 20_000].join(",");
    let instance = r#"{"type":"GeometryInstance","template":0,"boundaries":[0],"transformationMatrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}"#;
    let instances = vec![instance; 1000].join(",");
    let mut text = with_object(&format!(r#""type":"PlantCover","geometry":[{instances}]"#));
    text.pop();
    text += &format!(
        r#","geometry-templates":{{"vertices-templates":[[0,0,0],[1,0,0],[0,1,0]],"templates":[{{"type":"MultiSurface","lod":"1","boundaries":[{surfaces}]}}]}}}}"#
    );
    assert!(message(text).contains(
        "vertices and rings of template instances in one feature exceed the limit of 10000000"
    ));
}

#[test]
fn shells_of_solids_are_checked_to_the_last() {
    let shell = BOX_SHELL.replace("[[3,0,4,7]]", "[[3,0,4,9]]");
    let text = document(&object(
        "a",
        "Building",
        "Solid",
        &format!("[{BOX_SHELL},{shell}]"),
    ));
    assert_eq!(
        message(text),
        "bad.json, object \"a\", geometry 0: vertex index 9 is out of range, there are 8"
    );
}
