//! Documents for the tests: real ones where they are at hand, and ones made here.
// Each test binary uses its own part of this module.
#![allow(dead_code)]

use std::fmt::Write;
use std::path::PathBuf;

use formats::{FormatError, ReadOptions, SceneDescription};

/// Reads a file as it comes, in one piece.
pub fn read_all(name: &str, bytes: &[u8]) -> Result<SceneDescription, FormatError> {
    formats::read_bytes(name, bytes, &ReadOptions::default())
}

/// A file of the folder of real cities, if it is there.
pub fn real_file(name: &str) -> Option<Vec<u8>> {
    let beside_workspace = || PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../shared/data");
    let folder = std::env::var_os("PG_OCCLUSION_DATA").map_or_else(beside_workspace, PathBuf::from);
    std::fs::read(folder.join(name)).ok()
}

/// Eight corners of a box of 2 x 3 x 4 stored units.
pub const BOX_VERTICES: &str = "[0,0,0],[2000,0,0],[2000,3000,0],[0,3000,0],[0,0,4000],[2000,0,4000],[2000,3000,4000],[0,3000,4000]";

/// One shell around those corners, oriented outwards.
pub const BOX_SHELL: &str =
    "[[[0,3,2,1]],[[4,5,6,7]],[[0,1,5,4]],[[1,2,6,5]],[[2,3,7,6]],[[3,0,4,7]]]";

/// The transform of the documents made here: millimetres from a corner of the Netherlands.
pub const TRANSFORM: &str = r#"{"scale":[0.001,0.001,0.001],"translate":[85000.0,447000.0,-1.5]}"#;

/// A document with these objects over the corners of the box.
pub fn document(objects: &str) -> String {
    format!(
        r#"{{"type":"CityJSON","version":"2.0","transform":{TRANSFORM},"CityObjects":{{{objects}}},"vertices":[{BOX_VERTICES}]}}"#
    )
}

/// An object of a class with one geometry.
pub fn object(id: &str, class: &str, kind: &str, boundaries: &str) -> String {
    format!(
        r#""{id}":{{"type":"{class}","geometry":[{{"type":"{kind}","lod":"1.2","boundaries":{boundaries}}}]}}"#
    )
}

/// A building in the form of the box.
pub fn building(id: &str) -> String {
    object(id, "Building", "Solid", &format!("[{BOX_SHELL}]"))
}

/// A document with so many boxes of each class, named by class and number.
pub fn document_of_classes(classes: &[(&str, usize)]) -> Vec<u8> {
    let numbers = classes
        .iter()
        .flat_map(|(class, count)| (0..*count).map(move |i| (class, i)));
    let boxes =
        numbers.map(|(class, i)| object(&format!("{class}{i}"), class, "MultiSurface", BOX_SHELL));
    let mut text = document(&boxes.collect::<Vec<_>>().join(",\n"));
    let system =
        r#","metadata":{"referenceSystem":"https://www.opengis.net/def/crs/EPSG/0/7415"}}"#;
    text.pop();
    text.push_str(system);
    text.into_bytes()
}

/// A sequence of buildings, each with a footprint of its own and a part with three solids.
pub fn sequence_of_buildings(count: usize) -> Vec<u8> {
    let mut text = format!(
        r#"{{"type":"CityJSON","version":"2.0","transform":{TRANSFORM},"CityObjects":{{}},"vertices":[],"metadata":{{"referenceSystem":"https://www.opengis.net/def/crs/EPSG/0/7415","title":"3DBAG"}}}}"#
    );
    for i in 0..count {
        let solid = |lod| format!(r#"{{"type":"Solid","lod":"{lod}","boundaries":[{BOX_SHELL}]}}"#);
        let solids = ["1.2", "1.3", "2.2"].map(solid).join(",");
        write!(
            text,
            "\n{}",
            [
                format!(r#"{{"type":"CityJSONFeature","id":"b{i}","CityObjects":{{"#),
                format!(r#""b{i}":{{"type":"Building","attributes":{{"n":{i}}},"children":["b{i}-0"],"#),
                r#""geometry":[{"type":"MultiSurface","lod":"0","boundaries":[[[0,1,2,3]]]}]},"#.into(),
                format!(r#""b{i}-0":{{"type":"BuildingPart","parents":["b{i}"],"geometry":[{solids}]}}}},"#),
                format!(r#""vertices":[{BOX_VERTICES}]}}"#),
            ]
            .concat()
        )
        .expect("a string takes any text");
    }
    text.into_bytes()
}
