//! What is refused, and in which words.

mod gltf_square;

use gltf_square::{refusal, square, square_with};
use serde_json::{Value, json};

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
