//! Mutated files: whatever happens to the bytes, the reader gives a scene or an error.
//! `PROPTEST_CASES` scales how many.

mod gltf_scenes;

use formats::{ReadOptions, read_bytes, write_glb};
use gltf_scenes::{FAR, building, courtyard, instances, painted};
use proptest::prelude::*;
use serde_json::{Value, json};

fn seeds() -> Vec<Vec<u8>> {
    let glb = |models: &[_]| write_glb(models, Some(7415)).expect("a file");
    vec![
        glb(&[building(1, FAR)]),
        glb(&[painted(2), courtyard(3)]),
        glb(&instances()),
        glb(&[]),
    ]
}

/// A GLB taken apart, and put together again as it is required.
fn parts(glb: &[u8]) -> (Value, Vec<u8>) {
    let length = u32::from_le_bytes(glb[12..16].try_into().unwrap()) as usize;
    let json = serde_json::from_slice(&glb[20..20 + length]).expect("json");
    let binary = glb.get(28 + length..).unwrap_or_default();
    (json, binary.to_vec())
}

fn whole(json: &str, binary: &[u8]) -> Vec<u8> {
    let word = |count: usize| (count as u32).to_le_bytes();
    let length = 28 + json.len() + binary.len();
    let pieces: [&[u8]; 8] = [
        b"glTF\x02\0\0\0",
        &word(length),
        &word(json.len()),
        b"JSON",
        json.as_bytes(),
        &word(binary.len()),
        b"BIN\0",
        binary,
    ];
    pieces.concat()
}

/// Values that a mutation puts in place of others.
fn values() -> Vec<Value> {
    let huge = "9".repeat(400);
    let deep = (0..120).fold(json!(0), |inner, _| json!([inner]));
    vec![
        json!(0),
        json!(1),
        json!(2),
        json!(-1),
        json!(0.5),
        json!(u64::MAX),
        json!(1e308),
        json!(5121),
        json!(5125),
        json!(5126),
        json!("VEC3"),
        json!("SCALAR"),
        json!(huge),
        json!(null),
        json!([]),
        json!({}),
        json!([0, 0]),
        json!([1e308, 1e308, 1e308]),
        deep,
        json!({"attributes": {"POSITION": 0}, "mode": 5}),
        json!({"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 0, "SCALE": 0}}}),
        json!({"count": 3, "indices": {"bufferView": 1, "componentType": 5123}, "values": {"bufferView": 0}}),
    ]
}

/// Every value below one, by its JSON pointer.
fn pointers(value: &Value, at: &str, found: &mut Vec<String>) {
    let below: Vec<(String, &Value)> = match value {
        Value::Object(members) => members
            .iter()
            .map(|(name, value)| (name.clone(), value))
            .collect(),
        Value::Array(elements) => elements
            .iter()
            .enumerate()
            .map(|(i, value)| (i.to_string(), value))
            .collect(),
        _ => Vec::new(),
    };
    for (name, value) in below {
        let pointer = format!("{at}/{}", name.replace('~', "~0").replace('/', "~1"));
        pointers(value, &pointer, found);
        found.push(pointer);
    }
}

/// One change to a document; choices are taken modulo what there is.
#[derive(Clone, Debug)]
enum Change {
    Value(usize, usize),
    Member(usize, usize),
    Copy(usize, usize),
    Remove(usize),
}

const MEMBERS: [&str; 10] = [
    "mesh",
    "children",
    "matrix",
    "scale",
    "extensions",
    "sparse",
    "byteStride",
    "byteOffset",
    "mode",
    "normalized",
];

fn change() -> impl Strategy<Value = Change> {
    let at = any::<usize>;
    prop_oneof![
        (at(), at()).prop_map(|(i, value)| Change::Value(i, value)),
        (at(), at()).prop_map(|(i, value)| Change::Member(i, value)),
        (at(), at()).prop_map(|(from, to)| Change::Copy(from, to)),
        at().prop_map(Change::Remove),
    ]
}

fn apply(document: &mut Value, change: &Change) {
    let mut places = Vec::new();
    pointers(document, "", &mut places);
    if places.is_empty() {
        return;
    }
    let place = |i: usize| places[i % places.len()].as_str();
    let values = values();
    match *change {
        Change::Value(i, value) => {
            *document.pointer_mut(place(i)).unwrap() = values[value % values.len()].clone()
        }
        Change::Member(i, value) => {
            if let Some(Value::Object(members)) = document.pointer_mut(place(i)) {
                let name = MEMBERS[value % MEMBERS.len()];
                members.insert(name.to_owned(), values[value / 16 % values.len()].clone());
            }
        }
        Change::Copy(from, to) => {
            let copy = document.pointer(place(from)).unwrap().clone();
            *document.pointer_mut(place(to)).unwrap() = copy;
        }
        Change::Remove(i) => {
            let (parent, member) = place(i).rsplit_once('/').unwrap();
            match document.pointer_mut(parent) {
                Some(Value::Object(members)) => drop(members.shift_remove(member)),
                Some(Value::Array(elements)) => {
                    drop(elements.remove(member.parse::<usize>().unwrap()))
                }
                _ => {}
            }
        }
    }
}

/// Reads, and checks what holds of every scene.
fn check(bytes: &[u8]) {
    let scene = match read_bytes("mutated", bytes, &ReadOptions::default()) {
        Ok(scene) => scene,
        Err(error) => return assert!(error.to_string().starts_with("mutated"), "{error}"),
    };
    for feature in &scene.features {
        assert!(feature.attributes.is_object());
        assert!(!feature.geometries.is_empty());
        for geometry in &feature.geometries {
            assert!(!geometry.shape.surfaces.is_empty());
            for surface in geometry.surfaces().iter() {
                assert!(
                    surface
                        .material
                        .is_none_or(|i| (i as usize) < geometry.shape.materials.len())
                );
                assert!(
                    surface
                        .semantic
                        .is_none_or(|i| (i as usize) < geometry.shape.semantics.len())
                );
                let mut coordinates = surface.rings.iter().flatten().flatten();
                assert!(coordinates.all(|coordinate| coordinate.abs() <= 1.01e9));
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4 * ProptestConfig::default().cases, failure_persistence: None, ..Default::default() })]

    #[test]
    fn no_byte_makes_the_reader_panic(
        seed in 0usize..4,
        flips in prop::collection::vec((any::<usize>(), any::<u8>()), 0..6),
        cut in prop::option::of(any::<usize>()),
    ) {
        let mut bytes = seeds().swap_remove(seed);
        for (at, byte) in flips {
            let length = bytes.len();
            bytes[at % length] = byte;
        }
        if let Some(cut) = cut {
            bytes.truncate(cut % bytes.len());
        }
        check(&bytes);
    }

    #[test]
    fn no_change_of_the_document_makes_the_reader_panic(
        seed in 0usize..4,
        changes in prop::collection::vec(change(), 1..5),
    ) {
        let (mut document, binary) = parts(&seeds().swap_remove(seed));
        changes.iter().for_each(|change| apply(&mut document, change));
        check(&whole(&document.to_string(), &binary));
    }

    #[test]
    fn no_byte_of_the_text_makes_the_reader_panic(
        seed in 0usize..4,
        at in any::<usize>(),
        piece in prop::sample::select(vec!["-1", "1e999", "{", "]", ",", "\"", "null", "\u{feff}", "[[[["]),
        cut in 0usize..30,
    ) {
        let (document, binary) = parts(&seeds().swap_remove(seed));
        let mut text = document.to_string();
        let at = (0..=at % text.len()).rev().find(|&i| text.is_char_boundary(i)).unwrap();
        let end = (at + cut).min(text.len());
        let end = (at..=end).rev().find(|&i| text.is_char_boundary(i)).unwrap();
        text.replace_range(at..end, piece);
        check(&whole(&text, &binary));
    }
}
