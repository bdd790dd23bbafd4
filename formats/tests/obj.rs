//! Wavefront OBJ: features, faces and materials.

use std::io::{self, Cursor};
use std::ops::ControlFlow;

use formats::{ReadOptions, SceneDescription, read, read_bytes};

const SQUARE: &str =
    "v 85000.001 447000.002 0 1 0 0\nv 85001.5 447000 0\nv 85001 447001 0\nv 85000 447001 -0.0\n";

fn try_read(text: &str) -> Result<SceneDescription, String> {
    let companion = |name: &str| match name {
        "city.mtl" => Ok(
            b"newmtl brick\nKd 0.5 .25 0\nKs 1\nNs 64\nd 0.25\nKe nan 0 0\nPr 0.5\n\
            newmtl pane\nTr 0.5\nmap_Kd a.png\n"
                .to_vec(),
        ),
        "my walls.mtl" => Ok(b"newmtl wall\nKd 0 0 1".to_vec()),
        _ => Err(io::ErrorKind::NotFound.into()),
    };
    let options = ReadOptions {
        companion: &companion,
        ..ReadOptions::default()
    };
    read_bytes("folder/city.obj", text.as_bytes(), &options).map_err(|error| error.to_string())
}

fn features(text: &str) -> Vec<(String, usize)> {
    let scene = try_read(text).expect("a file that is right");
    let features = scene.features.into_iter();
    features
        .map(|f| (f.name, f.geometries[0].shape.surfaces.len()))
        .collect()
}

fn named(expected: &[(&str, usize)]) -> Vec<(String, usize)> {
    expected
        .iter()
        .map(|(name, count)| ((*name).to_owned(), *count))
        .collect()
}

#[test]
fn faces_keep_corners_and_positions() {
    let scene = try_read(&format!(
        "# cube\n\n{SQUARE}vn 0 0 1\nf 1/2/3 2//1 \\\n 3/1 -1\nf -4 -3 -2\nf 1 2 1\n"
    ))
    .expect("a file that is right");
    let shape = &scene.features[0].geometries[0].shape;
    assert_eq!(shape.surfaces[0].rings[0][0], [85000.001, 447000.002, 0.0]);
    assert_eq!(shape.surfaces[0].rings[0][3][2].to_bits(), 0);
    assert_eq!(shape.surfaces[0].rings[0].len(), 4);
    assert_eq!(shape.surfaces[1].rings[0], shape.surfaces[0].rings[0][..3]);
    assert_eq!((shape.surfaces.len(), scene.degenerate_rings), (2, 1));
    assert_eq!(
        (
            scene.features[0].name.as_str(),
            scene.features[0].class.as_str()
        ),
        ("city", "Generic")
    );
}

#[test]
fn objects_are_features_then_groups_then_the_file() {
    let whole = format!("{SQUARE}f 1 2 3\nf 1 2 4\n");
    assert_eq!(features(&whole), named(&[("city", 2)]));
    let groups =
        format!("{SQUARE}f 1 2 3\ng a b\nf 1 2 3\ng\nf 1 2 4\ng c\ng a b\nf 2 3 4\nl 1 2\n");
    assert_eq!(features(&groups), named(&[("city", 2), ("a b", 2)]));
    let objects = format!("{SQUARE}g a\no House 1\nf 1 2 3\ng b\nf 1 2 4\no\nf 1 2 3\n");
    assert_eq!(features(&objects), named(&[("House 1", 2), ("city", 1)]));
}

#[test]
fn materials_come_from_their_libraries() {
    let text = format!(
        "mtllib city.mtl none.mtl\nmtllib my walls.mtl\n{SQUARE}\
         usemtl brick\nf 1 2 3\nusemtl pane\nf 1 2 4\nusemtl brick\nf 1 3 4\nusemtl\nf 2 3 4\n\
         usemtl lost\nf 2 3 4\nusemtl wall\nf 1 2 3 4\np 1\nsurf 1\n"
    );
    let scene = try_read(&text).expect("a file that is right");
    let shape = &scene.features[0].geometries[0].shape;
    let numbers: Vec<_> = shape
        .surfaces
        .iter()
        .map(|surface| surface.material)
        .collect();
    assert_eq!(numbers, [Some(0), Some(1), Some(0), None, Some(2), Some(3)]);
    let brick = &shape.materials[0];
    assert_eq!(
        (brick.name.as_deref(), brick.diffuse),
        (Some("brick"), [0.5, 0.25, 0.0])
    );
    assert_eq!((brick.specular, brick.shininess), ([1.0; 3], 0.5));
    assert_eq!((brick.transparency, brick.emissive), (0.75, [0.0; 3]));
    assert_eq!(
        (brick.roughness, shape.materials[1].transparency),
        (Some(0.5), 0.5)
    );
    assert_eq!(shape.materials[2].name.as_deref(), Some("lost"));
    assert_eq!(shape.materials[3].diffuse, [0.0, 0.0, 1.0]);
    let changes: Vec<_> = scene
        .changed
        .iter()
        .map(|changed| changed.how.as_str())
        .collect();
    let expected = [
        "a material library is missing",
        "free-form surfaces left out",
        "lines and points left out",
        "textures left out",
    ];
    assert_eq!(changes, expected);
}

#[test]
fn what_has_no_face_is_skipped_with_the_reason() {
    let scene = try_read(&format!("{SQUARE}o a\nl 1 2\no b\nf 1 1 2\no c\n")).expect("right");
    let why: Vec<_> = scene
        .skipped
        .iter()
        .map(|s| (s.name.as_str(), s.why.as_str()))
        .collect();
    let lines = ("a", "only lines, points or free-form surfaces");
    assert_eq!(
        why,
        [lines, ("b", "no surface with three distinct vertices")]
    );
}

#[test]
fn batches_hold_complete_features() {
    let text = format!("{SQUARE}o a\nf 1 2 3\no b\nf 1 2 3\no a\nf 1 2 4\no c\nf 1 2 3\n");
    let options = ReadOptions {
        batch_bytes: 1,
        ..ReadOptions::default()
    };
    let mut batches: Vec<Vec<String>> = Vec::new();
    let mut take = |end_after: usize| {
        batches.clear();
        let sink = &mut |batch: SceneDescription| {
            batches.push(
                batch
                    .features
                    .into_iter()
                    .map(|feature| feature.name)
                    .collect(),
            );
            match batches.len() < end_after {
                true => ControlFlow::Continue(()),
                false => ControlFlow::Break(()),
            }
        };
        read("a.obj", &mut Cursor::new(text.as_bytes()), &options, sink).expect("right");
        batches.concat().join(" ")
    };
    assert_eq!(take(9), "b a c");
    assert_eq!(take(2), "b a");
}

#[test]
fn what_is_refused_says_so_with_the_line() {
    let long = format!("o {}", "a".repeat(1025));
    let cases = [
        ("v 1 2", "1: a coordinate is \"\", expected a number"),
        ("v 1 2 x", "1: a coordinate is \"x\", expected a number"),
        ("v 1 2 inf", "1: a coordinate is \"inf\", expected a number"),
        (
            "\nv 1 2 3\nf 1 2 3",
            "3: a corner of a face is \"2\", expected the number of a vertex before it",
        ),
        (
            "f -1 1 1",
            "1: a corner of a face is \"-1\", expected the number of a vertex before it",
        ),
        (
            "f 0 1 1",
            "1: a corner of a face is \"0\", expected the number of a vertex, from 1 on or negative",
        ),
        (
            "f a",
            "1: a corner of a face is \"a\", expected the number of a vertex, from 1 on or negative",
        ),
        (
            "v 0 0 0\nv 1 0 0\nv 0 1e10 0\nf 1 2 3",
            "4: coordinate is 10000000000.0, expected a number of metres up to 1e9",
        ),
        (&long, "1: 1025 bytes of a name exceed the limit of 1024"),
    ];
    for (text, message) in cases {
        assert_eq!(
            try_read(text).unwrap_err(),
            format!("folder/city.obj, line {message}")
        );
    }
}
