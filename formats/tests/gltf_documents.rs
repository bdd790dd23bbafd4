//! Documents of other writers, and ones that are refused.

use std::cell::RefCell;
use std::io;
use std::ops::ControlFlow;
use std::sync::Arc;

use formats::{Feature, Format, ReadOptions, SceneDescription, read, read_bytes};
use serde_json::{Value, json};

/// Positions of a unit square, then indices of its two triangles, as they are in a buffer.
fn square_bytes() -> Vec<u8> {
    let corners = [
        [0.0_f32, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 0.0, -1.0],
        [0.0, 0.0, -1.0],
    ];
    let positions = corners.as_flattened().iter().flat_map(|c| c.to_le_bytes());
    positions.chain([0, 1, 2, 0, 2, 3]).collect()
}

/// A document with one square, its buffer in a file beside it.
fn square() -> Value {
    json!({
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0, 1]}],
        "nodes": [{"name": "a", "mesh": 0}, {"mesh": 0, "translation": [10, 20, 30]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5121, "count": 6, "type": "SCALAR"}],
        "bufferViews": [
            {"buffer": 0, "byteLength": 48},
            {"buffer": 0, "byteOffset": 48, "byteLength": 6}],
        "buffers": [{"uri": "the%20square.bin", "byteLength": 54}],
    })
}

/// The square with one member changed, by its JSON pointer.
fn square_with(pointer: &str, value: Value) -> Value {
    let mut document = square();
    let (parent, member) = pointer.rsplit_once('/').expect("a pointer");
    match document.pointer_mut(parent).expect("a parent") {
        Value::Object(members) => drop(members.insert(member.to_owned(), value)),
        Value::Array(elements) => elements[member.parse::<usize>().expect("a number")] = value,
        other => panic!("{other} has no members"),
    }
    document
}

fn companion(name: &str) -> io::Result<Vec<u8>> {
    if name == "the square.bin" {
        Ok(square_bytes())
    } else {
        Err(io::Error::new(io::ErrorKind::NotFound, "no such file"))
    }
}

fn options() -> ReadOptions<'static> {
    ReadOptions {
        companion: &companion,
        ..ReadOptions::default()
    }
}

fn scene(document: &Value) -> SceneDescription {
    let text = document.to_string();
    assert_eq!(Format::recognise(text.as_bytes()), Some(Format::Gltf));
    read_bytes("a.gltf", text.as_bytes(), &options()).unwrap_or_else(|error| panic!("{error}"))
}

fn refusal(document: &Value) -> String {
    match read_bytes("a.gltf", document.to_string().as_bytes(), &options()) {
        Ok(scene) => format!("{} features", scene.features.len()),
        Err(error) => error.to_string(),
    }
}

fn names(scene: &SceneDescription) -> Vec<&str> {
    scene
        .features
        .iter()
        .map(|feature| feature.name.as_str())
        .collect()
}

fn rings(feature: &Feature) -> Vec<Vec<[f64; 3]>> {
    let geometries = feature.geometries.iter();
    geometries
        .flat_map(|g| g.surfaces().into_owned())
        .flat_map(|s| s.rings)
        .collect()
}

#[test]
fn root_nodes_are_features_in_the_frame_of_the_scene() {
    let scene = scene(&square());
    assert_eq!(names(&scene), ["a", "node-1"]);
    let [a, b] = &scene.features[..] else {
        panic!()
    };
    assert_eq!(
        (a.class.as_str(), a.geometries[0].level_of_detail),
        ("Generic", 2.0)
    );
    assert_eq!(
        rings(a)[0],
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]]
    );
    assert_eq!(
        rings(b)[1],
        [
            [10.0, -30.0, 20.0],
            [11.0, -29.0, 20.0],
            [10.0, -29.0, 20.0]
        ]
    );
    assert!(Arc::ptr_eq(&a.geometries[0].shape, &b.geometries[0].shape));
}

#[test]
fn a_lonely_root_is_the_frame() {
    let mut document = square();
    document["nodes"] = json!([
        {"children": [1], "translation": [85000.1, 0, -447000.1], "extras": {"srid": 28992}},
        {"children": [2, 3], "scale": [2, 2, 2]},
        {"name": "house", "extras": {"year": 1890}, "children": [4, 5]},
        {"name": "lamp", "extras": "none"},
        {"mesh": 0},
        {"mesh": 0, "translation": [1, 0, 0]}]);
    document["scenes"] = json!([{"nodes": [0]}]);
    let scene = scene(&document);
    assert_eq!((names(&scene), scene.srid), (vec!["house"], Some(28992)));
    assert_eq!(scene.features[0].attributes, json!({"year": 1890}));
    let rings = rings(&scene.features[0]);
    assert_eq!(
        (rings[0][1], rings[3][0]),
        ([85002.1, 447000.1, 0.0], [85002.1, 447000.1, 0.0])
    );
    assert_eq!(
        (
            scene.skipped[0].name.as_str(),
            scene.skipped[0].why.as_str()
        ),
        ("lamp", "no surface")
    );
}

#[test]
fn without_a_scene_all_roots_are_read() {
    let mut document = square();
    document
        .as_object_mut()
        .unwrap()
        .retain(|name, _| name != "scene" && name != "scenes");
    assert_eq!(names(&scene(&document)), ["a", "node-1"]);
    document["nodes"] = json!([{"mesh": 0}, {"children": [0]}, {"mesh": 0}]);
    assert_eq!(names(&scene(&document)), ["node-1", "node-2"]);
}

#[test]
fn a_second_scene_can_be_the_default() {
    let mut document = square_with("/scenes", json!([{"nodes": [0]}, {"nodes": [1]}]));
    assert_eq!(names(&scene(&document)), ["a"]);
    document["scene"] = json!(1);
    assert_eq!(names(&scene(&document)), ["node-1"]);
}

#[test]
fn buffers_come_from_data_uris_and_companions() {
    let data = "data:application/octet-stream;base64,";
    let base64 = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAAAAAAIC/AAAAAAAAAAAAAIC/AAECAAID";
    let embedded = square_with("/buffers/0/uri", json!(format!("{data}{base64}")));
    assert_eq!(scene(&embedded), scene(&square()));
    let missing = square_with("/buffers/0/uri", json!("../other%2F.bin"));
    let expected = "a.gltf: cannot read: buffer 0, \"../other/.bin\": no such file";
    assert_eq!(refusal(&missing), expected);
}

#[test]
fn strips_and_fans_keep_their_turn() {
    let first = |mode: u64, indices: bool| {
        let mut document = square_with("/meshes/0/primitives/0/mode", json!(mode));
        if !indices {
            let primitive = document["meshes"][0]["primitives"][0]
                .as_object_mut()
                .unwrap();
            primitive.remove("indices");
        }
        rings(&scene(&document).features[0])
    };
    let [a, b, c, d] = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
    ];
    assert_eq!(first(4, true), [[a, b, c], [a, c, d]]);
    assert_eq!(first(5, false), [[a, b, c], [b, d, c]]);
    assert_eq!(first(6, false), [[b, c, a], [c, d, a]]);
    assert_eq!(first(4, false), [[a, b, c]]);
}

#[test]
fn sparse_elements_replace_others() {
    let document = square_with(
        "/accessors/0/sparse",
        json!({"count": 2,
            "indices": {"bufferView": 1, "byteOffset": 1, "componentType": 5121},
            "values": {"bufferView": 0, "byteOffset": 24}}),
    );
    let ring = [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let scene = scene(&document);
    assert_eq!(rings(&scene.features[0]), [ring]);
    // The second triangle has lost a corner.
    assert_eq!(scene.degenerate_rings, 1);
}

#[test]
fn quantised_positions_are_read() {
    let mut document = square();
    document["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    document["accessors"][0] = json!(
        {"bufferView": 0, "componentType": 5120, "count": 3, "type": "VEC3", "normalized": true});
    document["bufferViews"][0] = json!({"buffer": 0, "byteLength": 12, "byteStride": 4});
    document["buffers"][0] =
        json!({"uri": "data:,%00%00%00-%7F%00%00-%00%7F%80-", "byteLength": 12});
    let primitive = &mut document["meshes"][0]["primitives"][0];
    primitive.as_object_mut().unwrap().remove("indices");
    let scene = scene(&document);
    let ring = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 1.0]];
    assert_eq!(rings(&scene.features[0]), [ring]);
}

#[test]
fn instances_are_listed_by_the_extension() {
    let mut document = square();
    document["extensionsRequired"] = json!(["EXT_mesh_gpu_instancing"]);
    document["nodes"][1]["extensions"] =
        json!({"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 0}}});
    let scene = scene(&document);
    assert_eq!(scene.features[1].geometries.len(), 4);
    assert_eq!(rings(&scene.features[1])[2][0], [11.0, -30.0, 20.0]);
}

#[test]
fn what_has_no_surface_is_named() {
    let lines = scene(&square_with("/meshes/0/primitives/0/mode", json!(1)));
    assert_eq!(
        (lines.features.len(), lines.skipped[1].why.as_str()),
        (0, "only points and lines")
    );
    let mut document = square_with(
        "/materials",
        json!([
        {"name": "wall", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]),
    );
    document["meshes"][0]["primitives"][0]["material"] = json!(0);
    document["nodes"][1]["scale"] = json!([1, 0, 1]);
    let scene = scene(&document);
    assert_eq!(
        (names(&scene), scene.changed[0].how.as_str()),
        (vec!["a"], "textures left out")
    );
    assert_eq!(
        scene.features[0].geometries[0].shape.materials[0]
            .name
            .as_deref(),
        Some("wall")
    );
    assert_eq!(scene.skipped[0].name, "node-1");
}

#[test]
fn batches_are_handed_over_until_the_sink_has_enough() {
    let text = square().to_string();
    let options = ReadOptions {
        batch_bytes: 1,
        ..options()
    };
    let batches = RefCell::new(Vec::new());
    let read_until = |enough: usize| {
        batches.borrow_mut().clear();
        let sink = &mut |batch: SceneDescription| {
            batches.borrow_mut().push(batch.features.len());
            if batches.borrow().len() < enough {
                ControlFlow::Continue(())
            } else {
                ControlFlow::Break(())
            }
        };
        read("a.gltf", &mut io::Cursor::new(&text), &options, sink).expect("a scene");
        batches.borrow().clone()
    };
    assert_eq!(read_until(9), [1, 1, 0]);
    assert_eq!(read_until(1), [1]);
}

#[test]
fn refusals_say_what_and_where() {
    let cases = [
        ("/asset", Value::Null, "asset is missing"),
        (
            "/asset/version",
            json!("1.0"),
            "asset version is \"1.0\", at least \"2.0\", expected \"2.0\"",
        ),
        (
            "/extensionsRequired",
            json!(["KHR_draco_mesh_compression"]),
            "the required extension \"KHR_draco_mesh_compression\" is not supported",
        ),
        (
            "/extensionsRequired",
            json!(["KHR_materials_unlit", "EXT_meshopt_compression"]),
            "the required extension \"EXT_meshopt_compression\" is not supported",
        ),
        ("/scene", json!(3), "scene 3 is out of range, there are 1"),
        (
            "/nodes",
            json!(7),
            "nodes is malformed: invalid type: integer `7`, expected an array",
        ),
        (
            "/buffers/0/byteLength",
            json!(55),
            "the byteLength of buffer 0 is 55, expected no more than there are",
        ),
        (
            "/buffers/0/uri",
            json!("data:nothing"),
            "the data uri of buffer 0 is \"nothing\", expected a comma before the content",
        ),
        (
            "/buffers/0/uri",
            json!("data:;base64,??"),
            "the base64 of buffer 0 is malformed: invalid symbol 63, offset 0.",
        ),
        (
            "/buffers/0/uri",
            json!("https://example.org/a.bin"),
            "buffer 0 at \"https://example.org/a.bin\" is not supported",
        ),
        (
            "/buffers/0",
            json!({"byteLength": 54}),
            "the uri of buffer 0 is missing",
        ),
    ];
    for (pointer, value, message) in cases {
        assert_eq!(
            refusal(&square_with(pointer, value)),
            format!("a.gltf: {message}")
        );
    }
}

#[test]
fn refusals_name_the_feature() {
    let outside = "expected inside the view, and that inside its buffer";
    let cases = [
        (
            "/nodes/0/mesh",
            json!(1),
            "mesh 1 is out of range, there are 1".to_owned(),
        ),
        (
            "/accessors/0/type",
            json!("VEC4"),
            "the type of accessor 0 is \"VEC4\", expected \"VEC3\"".to_owned(),
        ),
        (
            "/accessors/0/componentType",
            json!(5124),
            "componentType is 5124, expected 5120 to 5123, 5125 or 5126".to_owned(),
        ),
        (
            "/accessors/0/count",
            json!(5),
            format!("the end of 5 elements in buffer view 0 is outside, {outside}"),
        ),
        (
            "/accessors/0/byteOffset",
            json!(u64::MAX),
            format!("the end of 4 elements in buffer view 0 is outside, {outside}"),
        ),
        (
            "/accessors/0/count",
            json!(4_000_001),
            "4000001 elements of one accessor exceed the limit of 4000000".to_owned(),
        ),
        (
            "/accessors/0/bufferView",
            json!(9),
            "buffer view 9 is out of range, there are 2".to_owned(),
        ),
        (
            "/bufferViews/0/byteLength",
            json!(u64::MAX),
            format!("the end of 4 elements in buffer view 0 is outside, {outside}"),
        ),
        (
            "/bufferViews/0/buffer",
            json!(1),
            "buffer 1 is out of range, there are 1".to_owned(),
        ),
        (
            "/bufferViews/0/byteStride",
            json!(11),
            "the byteStride of buffer view 0 is 11, expected at least the size of an element"
                .to_owned(),
        ),
        (
            "/bufferViews/0/byteStride",
            json!(u64::MAX),
            format!("the end of 4 elements in buffer view 0 is outside, {outside}"),
        ),
        (
            "/bufferViews/1/byteOffset",
            json!(14),
            "vertex 128 is out of range, there are 4".to_owned(),
        ),
        (
            "/meshes/0/primitives/0/mode",
            json!(7),
            "the mode of a primitive is 7, expected 0 to 6".to_owned(),
        ),
        (
            "/meshes/0/primitives/0/material",
            json!(0),
            "material 0 is out of range, there are 0".to_owned(),
        ),
        (
            "/nodes/0/children",
            json!([2]),
            "node 2 is out of range, there are 2".to_owned(),
        ),
        (
            "/nodes/0/children",
            json!([0]),
            "node 0 appears twice".to_owned(),
        ),
        (
            "/nodes/0/children",
            json!([1, 1]),
            "node 1 appears twice".to_owned(),
        ),
        (
            "/nodes/0/children",
            json!([1, 1, 1]),
            "3 children of nodes exceed the limit of 2".to_owned(),
        ),
        (
            "/nodes/0/translation",
            json!([0, 0, 2e9]),
            "a position is [0.0, -2000000000.0, 0.0], expected coordinates of at most 1e9"
                .to_owned(),
        ),
        (
            "/nodes/0/scale",
            json!([1e308, 1e308, 1e308]),
            "a position is [1e308, 0.0, 0.0], expected coordinates of at most 1e9".to_owned(),
        ),
        ("/nodes/0/matrix", json!([1, 2]), String::new()),
    ];
    for (pointer, value, message) in cases {
        let found = refusal(&square_with(pointer, value));
        if message.is_empty() {
            let expected =
                "a.gltf: node 0 is malformed: invalid length 2, expected an array of length 16";
            assert_eq!(found, expected);
        } else {
            assert_eq!(
                found,
                format!("a.gltf, object \"a\": {message}"),
                "{pointer}"
            );
        }
    }
}

#[test]
fn nesting_and_repetition_are_limited() {
    let chain = |count: usize| {
        let mut nodes: Vec<_> = (1..count).map(|i| json!({"children": [i]})).collect();
        nodes.push(json!({"mesh": 0}));
        let mut document = square_with("/nodes", json!(nodes));
        document["scenes"][0]["nodes"] = json!([0]);
        refusal(&document)
    };
    assert_eq!(chain(100), "1 features");
    assert!(
        chain(102).ends_with(": 101 levels of nodes exceed the limit of 100"),
        "{}",
        chain(102)
    );
    // Elements without bytes, and a mesh that repeats them.
    let mut document = square_with(
        "/accessors/0",
        json!(
        {"componentType": 5126, "count": 3_999_999, "type": "VEC3"}),
    );
    let primitive = json!({"attributes": {"POSITION": 0}});
    document["meshes"][0]["primitives"] = json!(vec![primitive; 100]);
    let message = refusal(&document);
    assert!(
        message.ends_with("bytes of one feature in memory exceed the limit of 268435456"),
        "{message}"
    );
    let mut document = square();
    document["accessors"][0]["count"] = json!(4);
    document["accessors"].as_array_mut().unwrap().push(json!(
        {"componentType": 5126, "count": 3_999_999, "type": "VEC3"}));
    document["nodes"][1]["extensions"] =
        json!({"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 2}}});
    let message = refusal(&document);
    assert!(
        message.ends_with("bytes of one feature in memory exceed the limit of 268435456"),
        "{message}"
    );
}
