//! PLY: encodings, features and refusals.

use formats::{ReadOptions, SceneDescription, read_bytes};

const HEADER: &str = "element vertex 4\nproperty double x\nproperty double y\nproperty float z\n\
    property uchar red\nelement edge 1\nproperty int a\nelement face 2\n\
    property list uchar int vertex_indices\nproperty short object\nend_header\n";

const POSITIONS: [[f64; 3]; 4] = [
    [85000.001, 447000.002, -0.0],
    [85001.5, 447000.0, 0.25],
    [85001.0, 447001.0, 0.5],
    [85000.0, 447001.0, 1.0],
];

const FACES: [(&[u8], i16); 2] = [(&[0, 1, 2, 3], 7), (&[2, 1, 0], -1)];

fn try_read(bytes: &[u8]) -> Result<SceneDescription, String> {
    read_bytes("folder/mesh.ply", bytes, &ReadOptions::default()).map_err(|e| e.to_string())
}

/// A file with the numbers above, each as `encode` has it: its bytes with the lowest first, and
/// its text.
fn file(format: &str, encode: impl Fn(&[u8], String) -> Vec<u8>) -> Vec<u8> {
    let mut bytes =
        format!("ply\r\nformat {format} 1.0\ncomment made by hand\n{HEADER}").into_bytes();
    for [x, y, z] in POSITIONS {
        bytes.extend(encode(&x.to_le_bytes(), x.to_string()));
        bytes.extend(encode(&y.to_le_bytes(), y.to_string()));
        bytes.extend(encode(&(z as f32).to_le_bytes(), z.to_string()));
        bytes.extend(encode(&[255], "255".to_owned()));
    }
    bytes.extend(encode(&5_i32.to_le_bytes(), "5".to_owned()));
    for (corners, object) in FACES {
        bytes.extend(encode(&[corners.len() as u8], corners.len().to_string()));
        for corner in corners {
            bytes.extend(encode(
                &i32::from(*corner).to_le_bytes(),
                corner.to_string(),
            ));
        }
        bytes.extend(encode(&object.to_le_bytes(), object.to_string()));
    }
    bytes
}

#[test]
fn every_encoding_gives_the_same() {
    let ascii = file("ascii", |_, text| format!("{text}\n").into_bytes());
    let little = file("binary_little_endian", |bytes, _| bytes.to_vec());
    let big = file("binary_big_endian", |bytes, _| {
        bytes.iter().rev().copied().collect()
    });
    let scene = try_read(&ascii).expect("a file that is right");
    let names: Vec<_> = scene.features.iter().map(|f| f.name.as_str()).collect();
    assert_eq!(names, ["mesh--1", "mesh-7"]);
    let ring = &scene.features[1].geometries[0].shape.surfaces[0].rings[0];
    assert_eq!(ring[..], POSITIONS);
    assert_eq!(ring[0][2].to_bits(), 0);
    assert_eq!(scene.changed.len(), 2);
    assert_eq!(try_read(&little).as_ref(), Ok(&scene));
    assert_eq!(try_read(&big).as_ref(), Ok(&scene));
}

fn ascii(header: &str, body: &str) -> String {
    format!("ply\nformat ascii 1.0\n{header}end_header\n{body}")
}

const XYZ: &str = "property float x\nproperty float y\nproperty float z\n";

#[test]
fn without_numbers_the_file_is_the_feature() {
    let faces = "element face 2\nproperty list uchar uint vertex_index\n";
    let header = format!("element vertex 3\n{XYZ}{faces}");
    let scene =
        try_read(ascii(&header, "0 0 0 1 0 0 0 1 0 3 0 1 2 2 0 1").as_bytes()).expect("right");
    assert_eq!(
        (scene.features[0].name.as_str(), scene.degenerate_rings),
        ("mesh", 1)
    );
    let points = ascii(&format!("element vertex 1\n{XYZ}"), "0 0 0");
    assert_eq!(
        try_read(points.as_bytes()).expect("right").skipped[0].why,
        "only points"
    );
    assert_eq!(
        try_read(ascii("", "").as_bytes()),
        Ok(SceneDescription::default())
    );
    let endless = ascii("element nothing 18446744073709551615\n", "");
    assert_eq!(
        try_read(endless.as_bytes()),
        Ok(SceneDescription::default())
    );
}

#[test]
fn what_is_refused_says_where() {
    let vertex = format!("element vertex 1\n{XYZ}");
    let list = "property list uchar int vertex_indices\n";
    let face = format!("{vertex}element face 1\n{list}");
    let many = format!("element vertex 16000001\n{XYZ}");
    let cases = [
        (
            "ply\nelement".to_owned(),
            ", line 2: the header is malformed: it does not end",
        ),
        (
            "ply\nend_header\n".to_owned(),
            ", line 2: format is missing",
        ),
        (
            "ply\nformat utf 1.0\n".to_owned(),
            ", line 2: format is \"utf\", expected ascii or a binary one",
        ),
        (
            "ply\nformat ascii 2.0\n".to_owned(),
            ", line 2: a line of the header is \"format ascii 2.0\", expected one of the format's",
        ),
        (
            "ply\nproperty int a\n".to_owned(),
            ", line 2: a property is \"a\", expected an element before it",
        ),
        (
            "ply\nelement a -1\n".to_owned(),
            ", line 2: a number of elements is \"-1\", expected a count",
        ),
        (
            "ply\nelement a 1\nproperty long a\n".to_owned(),
            ", line 3: a type of property is \"long\", expected one of the format's",
        ),
        (
            "ply\nelement a 1\nproperty list float int a\n".to_owned(),
            ", line 3: the type of a length is \"float\", expected a whole number",
        ),
        (
            format!("ply\n{}", "comment\n".repeat(10_000)),
            ", line 10000: 10001 lines of the header exceed the limit of 10000",
        ),
        (
            format!("ply\ncomment {}", "a".repeat(5000)),
            ", line 2: 4097 bytes of a line of the header exceed the limit of 4096",
        ),
        (
            ascii("element vertex 1\nproperty int x\n", ""),
            ": property y of vertex is missing",
        ),
        (
            ascii("element face 1\nproperty int x\n", ""),
            ": property vertex_indices of face is missing",
        ),
        (
            ascii("element tristrips 1\n", ""),
            ": element \"tristrips\" is not supported",
        ),
        (
            ascii(&vertex, "1 2"),
            ", object \"vertex 0\": the file is malformed: it ends before its last element",
        ),
        (
            ascii(&vertex, "1 2 a"),
            ", object \"vertex 0\": a value is \"a\", expected a number",
        ),
        (
            ascii(&face, "0 0 0 3 0 0 1"),
            ", object \"face 0\": a corner of a face is 1, expected the number of a vertex before it, from 0 on",
        ),
        (
            ascii(&face, "0 0 0 -3"),
            ", object \"face 0\": the length of \"vertex_indices\" is -3, expected a count of up to ten million",
        ),
        (
            ascii(&format!("{face}property float object\n"), "0 0 0 1 0 0.5"),
            ", object \"face 0\": the feature of a face is 0.5, expected a whole number",
        ),
        (
            ascii(&many, ""),
            ": 16000001 vertices exceed the limit of 16000000",
        ),
    ];
    for (text, message) in cases {
        let error = try_read(text.as_bytes()).unwrap_err();
        assert_eq!(error, format!("folder/mesh.ply{message}"));
    }
}
