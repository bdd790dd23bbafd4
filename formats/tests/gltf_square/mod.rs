//! A document of one square, to be changed by tests.
// Each test binary uses its own part of this module.
#![allow(dead_code)]

use std::io;

use formats::{Format, ReadOptions, SceneDescription, read_bytes};
use serde_json::{Value, json};

/// Positions of a unit square, then indices of its two triangles, as they are in a buffer.
pub fn square_bytes() -> Vec<u8> {
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
pub fn square() -> Value {
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
pub fn square_with(pointer: &str, value: Value) -> Value {
    let mut document = square();
    let (parent, member) = pointer.rsplit_once('/').expect("a pointer");
    match document.pointer_mut(parent).expect("a parent") {
        Value::Object(members) => drop(members.insert(member.to_owned(), value)),
        Value::Array(elements) => elements[member.parse::<usize>().expect("a number")] = value,
        other => panic!("{other} has no members"),
    }
    document
}

pub fn companion(name: &str) -> io::Result<Vec<u8>> {
    if name == "the square.bin" {
        Ok(square_bytes())
    } else {
        Err(io::Error::new(io::ErrorKind::NotFound, "no such file"))
    }
}

pub fn options() -> ReadOptions<'static> {
    ReadOptions {
        companion: &companion,
        ..ReadOptions::default()
    }
}

pub fn scene(document: &Value) -> SceneDescription {
    let text = document.to_string();
    assert_eq!(Format::recognise(text.as_bytes()), Some(Format::Gltf));
    read_bytes("a.gltf", text.as_bytes(), &options()).unwrap_or_else(|error| panic!("{error}"))
}

pub fn refusal(document: &Value) -> String {
    match read_bytes("a.gltf", document.to_string().as_bytes(), &options()) {
        Ok(scene) => format!("{} features", scene.features.len()),
        Err(error) => error.to_string(),
    }
}
