//! What is written as CityJSON is read back equal but for rounding.

mod common;

use std::sync::Arc;

use common::{document_of_classes, read_all, real_file, sequence_of_buildings};
use formats::{
    Feature, Geometry, Material, Model, Part, Placement, SceneDescription, Semantic, Shape,
    Surface, write_city_json, write_city_json_seq,
};
use proptest::prelude::*;
use serde_json::{Value, json};

/// Most that a coordinate may move, metres.
const ROUNDING: f64 = 0.000_05;

fn models(features: &[Feature]) -> Vec<Model> {
    let numbered = (1..).zip(features);
    numbered
        .map(|(id, feature)| Model {
            id,
            feature: feature.clone(),
        })
        .collect()
}

fn read(text: &str) -> SceneDescription {
    read_all("written", text.as_bytes()).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn assert_equal(again: &[Feature], features: &[Feature]) {
    assert_eq!(again.len(), features.len());
    for (again, feature) in again.iter().zip(features) {
        assert_eq!((&again.name, &again.class), (&feature.name, &feature.class));
        assert_eq!(
            (&again.attributes, &again.parts),
            (&feature.attributes, &feature.parts)
        );
        assert_eq!(again.geometries.len(), feature.geometries.len());
        for (again, geometry) in again.geometries.iter().zip(&feature.geometries) {
            assert_eq!(again.part, geometry.part);
            assert_eq!(again.level_of_detail, geometry.level_of_detail);
            assert_eq!(again.shape.semantics, geometry.shape.semantics);
            assert_surfaces(&again.surfaces(), &geometry.surfaces());
            assert_eq!(materials(&again.shape), materials(&geometry.shape));
        }
    }
}

/// The material of each surface; their order in the list is the file's.
fn materials(shape: &Shape) -> Vec<Option<&Material>> {
    let material = |surface: &Surface| shape.materials.get(surface.material? as usize);
    shape.surfaces.iter().map(material).collect()
}

fn assert_surfaces(again: &[Surface], surfaces: &[Surface]) {
    assert_eq!(again.len(), surfaces.len());
    for (again, surface) in again.iter().zip(surfaces) {
        assert_eq!(again.semantic, surface.semantic);
        let lengths = |s: &Surface| s.rings.iter().map(Vec::len).collect::<Vec<_>>();
        assert_eq!(lengths(again), lengths(surface));
        let positions = |s: &Surface| s.rings.concat();
        for (a, b) in positions(again)
            .iter()
            .flatten()
            .zip(positions(surface).iter().flatten())
        {
            assert!((a - b).abs() < ROUNDING, "{a} for {b}");
        }
    }
}

#[test]
fn real_cities_make_the_round_trip() {
    let names = [
        "delft.city.jsonl",
        "delft_lod1_with_roads.json",
        "rotterdam_subset.json",
        "DH_01_subs.city.json",
        "delft_1b.json",
        "small.city.jsonl",
        "geom_temp.city.jsonl",
        "noise_extension.city.jsonl",
    ];
    for name in names {
        let bytes = real_file(name).unwrap_or_else(|| match name.ends_with("jsonl") {
            true => sequence_of_buildings(30),
            false => document_of_classes(&[("Building", 10), ("PlantCover", 3)]),
        });
        let scene = read_all(name, &bytes).unwrap();
        let models = models(&scene.features);
        for text in [
            write_city_json_seq(&models, scene.srid),
            write_city_json(&models, scene.srid),
        ] {
            let again = read(&text);
            assert_eq!(again.srid, scene.srid, "{name}");
            assert!(
                again.skipped.is_empty() && again.changed.is_empty(),
                "{name}"
            );
            assert_equal(&again.features, &scene.features);
        }
    }
}

/// A tetrahedron with a corner here, outside outwards.
fn tetrahedron([x, y, z]: [f64; 3]) -> Vec<Surface> {
    let corner = |i: usize| match i {
        0 => [x, y, z],
        1 => [x + 3.5, y, z],
        2 => [x, y + 4.25, z],
        _ => [x, y, z + 5.125],
    };
    let faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    let surface = |face: [usize; 3]| Surface {
        rings: vec![face.map(corner).to_vec()],
        ..Surface::default()
    };
    faces.map(surface).to_vec()
}

fn feature(name: &str, geometries: Vec<Geometry>) -> Feature {
    Feature {
        name: name.to_owned(),
        class: "Building".to_owned(),
        attributes: json!({}),
        parts: Vec::new(),
        geometries,
    }
}

fn geometry(surfaces: Vec<Surface>) -> Geometry {
    Geometry {
        level_of_detail: 2.0,
        part: None,
        shape: Arc::new(Shape {
            surfaces,
            ..Shape::default()
        }),
        placement: None,
    }
}

/// Values of the lines that are written.
fn lines(models: &[Model]) -> Vec<Value> {
    let text = write_city_json_seq(models, Some(28992));
    text.lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect()
}

#[test]
fn closed_shapes_are_solids_and_open_ones_are_not() {
    let closed = tetrahedron([85_000.0, 447_000.0, -1.0]);
    let open = closed[1..].to_vec();
    let mut inside_out = closed.clone();
    inside_out[0].rings[0].reverse();
    let geometries = [closed, open, inside_out].map(geometry).to_vec();
    let lines = lines(&models(&[feature("a", geometries)]));
    assert_eq!(lines.len(), 2);
    assert_eq!(
        (&lines[0]["type"], &lines[0]["version"]),
        (&json!("CityJSON"), &json!("2.0"))
    );
    assert_eq!(
        lines[0]["metadata"]["referenceSystem"],
        "https://www.opengis.net/def/crs/EPSG/0/28992"
    );
    assert_eq!(
        lines[0]["transform"]["translate"],
        json!([85_000.0, 447_000.0, -1.0])
    );
    assert_eq!(
        (&lines[1]["type"], &lines[1]["id"]),
        (&json!("CityJSONFeature"), &json!("a"))
    );
    let written = lines[1]["CityObjects"]["a"]["geometry"].as_array().unwrap();
    let kinds: Vec<_> = written.iter().map(|geometry| &geometry["type"]).collect();
    assert_eq!(kinds, ["Solid", "MultiSurface", "MultiSurface"]);
    assert_eq!(written[0]["lod"], "2");
    assert_eq!(lines[1]["vertices"].as_array().unwrap().len(), 4);
}

#[test]
fn shared_shapes_are_templates_and_others_are_expanded() {
    let shape = Arc::new(Shape {
        surfaces: tetrahedron([0.1, 0.0, 0.0]),
        materials: vec![Material::default()],
        semantics: Vec::new(),
    });
    let quarter_turn = [[0.0, -2.0, 0.0, 85_000.000_001], [2.0, 0.0, 0.0, 447_000.5]];
    let placed = |shape: &Arc<Shape>, height: f64| Geometry {
        shape: Arc::clone(shape),
        placement: Some(Placement {
            rows: [quarter_turn[0], quarter_turn[1], [0.0, 0.0, 1.0, height]],
        }),
        ..geometry(Vec::new())
    };
    let alone = Arc::new(Shape::clone(&shape));
    let features = [
        feature("a", vec![placed(&shape, 1.0)]),
        feature("b", vec![placed(&shape, 2.0), placed(&alone, 3.0)]),
    ];
    let models = models(&features);
    let header = &lines(&models)[0];
    let templates = header["geometry-templates"]["templates"]
        .as_array()
        .unwrap();
    assert_eq!(
        (templates.len(), &templates[0]["type"]),
        (1, &json!("Solid"))
    );
    for text in [
        write_city_json_seq(&models, None),
        write_city_json(&models, None),
    ] {
        let scene = read(&text);
        assert_eq!(scene.srid, None);
        let [a, b] = &scene.features[..] else {
            panic!("two features")
        };
        assert!(Arc::ptr_eq(&a.geometries[0].shape, &b.geometries[0].shape));
        assert_eq!(
            a.geometries[0].shape.surfaces, shape.surfaces,
            "in its own frame, exactly"
        );
        assert_eq!(b.geometries[1].placement, None);
        for (again, feature) in scene.features.iter().zip(&features) {
            for (again, geometry) in again.geometries.iter().zip(&feature.geometries) {
                assert_surfaces(&again.surfaces(), &geometry.surfaces());
            }
        }
    }
}

#[test]
fn names_are_told_apart_and_unknown_classes_become_generic() {
    let part = |name: &str, class: &str| Part {
        name: name.to_owned(),
        class: class.to_owned(),
        attributes: json!({"x": 1}),
    };
    let mut first = feature("a", vec![geometry(tetrahedron([0.0; 3]))]);
    first.parts = vec![part("a", "Chimney"), part("b", "+Chimney")];
    let mut second = feature("a", vec![geometry(tetrahedron([0.0; 3]))]);
    second.class = "house".to_owned();
    second.parts = vec![part("p", "wing"), part("p", "BuildingPart")];
    let scene = read(&write_city_json_seq(&models(&[first, second]), None));
    let named = |feature: &Feature| {
        let parts = feature
            .parts
            .iter()
            .map(|part| format!("{} {}", part.class, part.name));
        let root = format!("{} {}", feature.class, feature.name);
        std::iter::once(root).chain(parts).collect::<Vec<_>>()
    };
    let names: Vec<_> = scene.features.iter().map(named).collect();
    assert_eq!(names[0], ["Building a", "BuildingPart a-1", "+Chimney b"]);
    let second = [
        "GenericCityObject a-2",
        "GenericCityObject p",
        "BuildingPart p-2",
    ];
    assert_eq!(names[1], second);
}

#[test]
fn nothing_makes_an_empty_sequence() {
    assert_eq!(
        read(&write_city_json_seq(&[], None)),
        SceneDescription::default()
    );
    assert_eq!(read(&write_city_json(&[], Some(7415))).srid, Some(7415));
}

/// A surface of one to three rings; its positions are steps of 0.1 mm apart or more.
fn surface() -> impl Strategy<Value = Surface> {
    let offset = || (0..30_000_000i32).prop_map(|step| f64::from(step) * 0.000_1);
    let ring = prop::collection::vec((offset(), offset(), offset()), 3..6);
    let rings = prop::collection::vec(ring, 1..3);
    (rings, 0u32..2, prop::option::of(0u32..2)).prop_map(|(rings, material, semantic)| Surface {
        rings: rings
            .into_iter()
            .map(|ring| {
                ring.into_iter()
                    .map(|(x, y, z)| [85_000.3 + x, 447_000.7 + y, z])
                    .collect()
            })
            .collect(),
        material: Some(material),
        semantic,
    })
}

fn any_feature() -> impl Strategy<Value = Feature> {
    let surfaces = prop::collection::vec(surface(), 1..6);
    let geometry = (surfaces, 0u8..40, any::<bool>(), 0.0..1.0).prop_map(
        |(surfaces, level, of_part, share)| {
            let material = |name: &str, transparency| Material {
                name: Some(name.to_owned()),
                diffuse: [share, 0.0, 1.0],
                transparency,
                ..Material::default()
            };
            let semantic = |class: &str| Semantic {
                class: class.to_owned(),
                attributes: json!({"slope": share, "": [null, "é\n"]}),
            };
            Geometry {
                level_of_detail: f64::from(level) / 10.0,
                part: of_part.then(|| "part".to_owned()),
                shape: Arc::new(Shape {
                    surfaces,
                    materials: vec![material("a", 0.0), material("b", share)],
                    semantics: vec![semantic("RoofSurface"), semantic("+é")],
                }),
                placement: None,
            }
        },
    );
    (prop::collection::vec(geometry, 1..4), "[a-z]{1,8} \\PC*").prop_map(
        |(mut geometries, text)| {
            geometries.sort_by_key(|geometry| geometry.part.is_some());
            let part = Part {
                name: "part".to_owned(),
                class: "BuildingPart".to_owned(),
                attributes: json!({"text": text}),
            };
            Feature {
                attributes: json!({ text.clone(): 1e-7 }),
                parts: vec![part],
                ..feature(&text, geometries)
            }
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 100, failure_persistence: None, ..Default::default() })]

    #[test]
    fn any_feature_makes_the_round_trip(feature in any_feature()) {
        let models = models(std::slice::from_ref(&feature));
        assert_equal(&read(&write_city_json_seq(&models, None)).features, std::slice::from_ref(&feature));
        assert_equal(&read(&write_city_json(&models, None)).features, &[feature]);
    }
}
