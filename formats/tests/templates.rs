//! Geometry templates: one shape, shared by all its instances.

mod common;

use std::sync::Arc;

use common::{building, document, read_all};
use formats::SceneDescription;

const IDENTITY: &str = "[1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]";

fn read(text: &str) -> SceneDescription {
    read_all("test.city.json", text.as_bytes()).unwrap_or_else(|error| panic!("{error}"))
}

fn instance(matrix: &str, anchor: usize) -> String {
    format!(
        r#"{{"type":"GeometryInstance","template":1,"boundaries":[{anchor}],"transformationMatrix":{matrix}}}"#
    )
}

/// A building, and an object of this class with instances of a triangle; the vertices of the
/// document are the corners of the box.
fn tree_document(class: &str, instances: &[String]) -> String {
    let tree = format!(
        r#""t":{{"type":"{class}","geometry":[{}]}}"#,
        instances.join(",")
    );
    let mut text = document(&[building("b"), tree].join(","));
    text.pop();
    text + r#","geometry-templates":{"vertices-templates":[[9.5,0,0],[1.5,0,0],[0,2.5,0],[0,0,3.5]],
        "templates":[{"type":"MultiPoint","lod":"0","boundaries":[0]},
        {"type":"MultiSurface","lod":"3","boundaries":[[[1,2,3]]],
        "semantics":{"surfaces":[{"type":"RoofSurface"}],"values":[0]},
        "material":{"m":{"value":2}}}]},
        "appearance":{"materials":[{"name":"a"},{"name":"b"},{"name":"c"}]}}"#
}

fn trees(instances: &[String]) -> SceneDescription {
    read(&tree_document("SolitaryVegetationObject", instances))
}

#[test]
fn templates_are_placed_by_matrix_and_anchor_in_metres() {
    let scene = trees(&[instance("[2,0,0,10, 0,1,0,0, 0,0,1,0, 0,0,0,1]", 6)]);
    let geometry = &scene.features[1].geometries[0];
    assert_eq!(
        (geometry.part.as_deref(), geometry.level_of_detail),
        (None, 3.0)
    );
    let [x, y, z] = [85002.0, 447003.0, 2.5];
    let expected = [
        [x + 13.0, y, z],
        [x + 10.0, y + 2.5, z],
        [x + 10.0, y, z + 3.5],
    ];
    assert_eq!(geometry.surfaces()[0].rings, [expected.to_vec()]);
}

#[test]
fn instances_share_one_shape_in_its_own_frame() {
    let scene = trees(&[0, 1, 2].map(|anchor| instance(IDENTITY, anchor)));
    let geometries = &scene.features[1].geometries;
    assert_eq!(geometries.len(), 3);
    let shape = &geometries[0].shape;
    assert!(
        geometries
            .iter()
            .all(|geometry| Arc::ptr_eq(&geometry.shape, shape))
    );
    let own_frame = [[1.5, 0.0, 0.0], [0.0, 2.5, 0.0], [0.0, 0.0, 3.5]];
    assert_eq!(shape.surfaces[0].rings, [own_frame.to_vec()]);
    assert_eq!(shape.materials[0].name.as_deref(), Some("c"));
    assert_eq!(shape.semantics[0].class, "RoofSurface");
    let x = |i: usize| geometries[i].surfaces()[0].rings[0][1][0];
    assert_eq!([x(0), x(1), x(2)], [85000.0, 85002.0, 85002.0]);
}

#[test]
fn mirrored_templates_keep_their_outside_outside() {
    let scene = trees(&[instance("[1,0,0,0, 0,1,0,0, 0,0,-1,0, 0,0,0,1]", 6)]);
    let ring = scene.features[1].geometries[0].surfaces()[0].rings[0].clone();
    let last_comes_first = [85002.0, 447003.0, 2.5 - 3.5];
    assert_eq!(ring[0], last_comes_first);
}

#[test]
fn instances_without_volume_are_left_out() {
    let flat = instance("[1,0,0,0, 0,1,0,0, 0,0,0,0, 0,0,0,1]", 0);
    let scene = trees(&[flat.clone(), instance(IDENTITY, 0)]);
    assert_eq!(scene.features[1].geometries.len(), 1);
    assert_eq!(scene.changed[0].how, "instances made flat left out");
    assert_eq!(trees(&[flat]).skipped[0].name, "t");
}

#[test]
fn streets_have_their_instances_placed_and_bare() {
    let scene = read(&tree_document("Road", &[instance(IDENTITY, 6)]));
    let surface = &scene.streets[0].surfaces[0];
    assert_eq!(surface.rings[0][0], [85003.5, 447003.0, 2.5]);
    assert_eq!((surface.material, surface.semantic), (None, None));
}
