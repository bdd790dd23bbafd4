//! Documents of other writers.

mod gltf_square;

use std::cell::RefCell;
use std::io;
use std::ops::ControlFlow;
use std::sync::Arc;

use formats::{Feature, ReadOptions, SceneDescription, read};
use gltf_square::{options, refusal, scene, square, square_with};
use serde_json::json;

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
