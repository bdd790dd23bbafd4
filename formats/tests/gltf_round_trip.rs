//! What is written as GLB is read back.

mod gltf_scenes;

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use formats::{
    Feature, Geometry, Material, Model, ReadOptions, SceneDescription, Shape, Surface,
    delivered_positions, read_bytes, write_glb,
};
use gltf_scenes::{
    FAR, box_surfaces, building, courtyard, delft, geometry, instances, model, painted, placements,
    shape, surface, thousand,
};
use proptest::prelude::*;
use serde_json::{Value, json};

/// Metres by which a round trip may move a position of a feature that is no wider than 256 m.
const TOLERANCE: f64 = 1e-5;

fn round_trip(models: &[Model], srid: Option<i32>) -> SceneDescription {
    let bytes = write_glb(models, srid).expect("a file");
    read_bytes("a.glb", &bytes, &ReadOptions::default()).unwrap_or_else(|error| panic!("{error}"))
}

/// The JSON of a GLB.
fn document(bytes: &[u8]) -> Value {
    let length = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
    serde_json::from_slice(&bytes[20..20 + length]).expect("json")
}

fn surfaces(feature: &Feature) -> Vec<Surface> {
    let geometries = feature.geometries.iter();
    geometries
        .flat_map(|geometry| geometry.surfaces().into_owned())
        .collect()
}

fn positions(feature: &Feature) -> Vec<[f64; 3]> {
    let surfaces = surfaces(feature).into_iter();
    surfaces
        .flat_map(|surface| surface.rings)
        .flatten()
        .collect()
}

fn bits(positions: impl IntoIterator<Item = [f64; 3]>) -> BTreeSet<[u64; 3]> {
    positions.into_iter().map(|p| p.map(f64::to_bits)).collect()
}

/// How many directed edges have no opposite, by the bits of their ends.
fn unpaired(surfaces: &[Surface]) -> u64 {
    let mut balance = BTreeMap::<_, i64>::new();
    for ring in surfaces.iter().flat_map(|surface| &surface.rings) {
        for (i, from) in ring.iter().enumerate() {
            let to = ring[(i + 1) % ring.len()].map(f64::to_bits);
            let from = from.map(f64::to_bits);
            *balance.entry((from.min(to), from.max(to))).or_default() +=
                if from < to { 1 } else { -1 };
        }
    }
    balance.values().map(|turns| turns.unsigned_abs()).sum()
}

/// Six times the volume inside.
fn volume(surfaces: &[Surface]) -> f64 {
    let origin = surfaces[0].rings[0][0];
    let triangles = surfaces
        .iter()
        .flat_map(|surface| &surface.rings)
        .flat_map(|ring| {
            let ring: Vec<_> = ring
                .iter()
                .map(|p| [0, 1, 2].map(|i| p[i] - origin[i]))
                .collect();
            (1..ring.len() - 1).map(move |i| [ring[0], ring[i], ring[i + 1]])
        });
    triangles
        .map(|[a, b, c]| {
            a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
                + a[2] * (b[0] * c[1] - b[1] * c[0])
        })
        .sum()
}

/// Checks all that a feature keeps but its materials and meanings.
fn check(written: &Feature, read: &Feature) {
    assert_eq!(
        (
            &written.name,
            &written.class,
            &written.attributes,
            &written.parts
        ),
        (&read.name, &read.class, &read.attributes, &read.parts)
    );
    let levels = |feature: &Feature| -> Vec<_> {
        let geometries = feature.geometries.iter();
        geometries
            .map(|g| (g.level_of_detail, g.part.clone()))
            .collect()
    };
    assert_eq!(levels(written), levels(read));
    assert_eq!(
        bits(delivered_positions(&written.geometries)),
        bits(positions(read)),
        "{}",
        written.name
    );
    for (from, to) in positions(written)
        .iter()
        .zip(delivered_positions(&written.geometries))
    {
        assert!(
            from.iter().zip(to).all(|(a, b)| (a - b).abs() < TOLERANCE),
            "{from:?} {to:?}"
        );
    }
    let (before, after) = (surfaces(written), surfaces(read));
    assert_eq!(unpaired(&before), unpaired(&after), "{}", written.name);
    let (before, after) = (volume(&before), volume(&after));
    // A bent polygon has a volume of its own with every triangulation.
    assert!(
        (before - after).abs() <= 0.02 * before.abs().max(1.0),
        "{before} {after}"
    );
}

fn check_all(models: &[Model]) {
    let scene = round_trip(models, Some(7415));
    assert_eq!(scene.srid, Some(7415));
    assert_eq!((&scene.skipped, &scene.changed), (&Vec::new(), &Vec::new()));
    assert_eq!(scene.features.len(), models.len());
    for (model, read) in models.iter().zip(&scene.features) {
        check(&model.feature, read);
    }
}

#[test]
fn features_come_back() {
    check_all(&[]);
    check_all(&[building(1, FAR)]);
    check_all(&[
        building(1, FAR),
        painted(2),
        courtyard(3),
        building(4, [0.0; 3]),
    ]);
    check_all(&thousand());
}

#[test]
fn a_real_city_comes_back() {
    let models = delft();
    assert!(models.len() >= 1000);
    check_all(&models);
}

#[test]
fn numbers_are_in_the_extras() {
    let models = [building(i64::MAX, FAR), painted(-5)];
    let document = document(&write_glb(&models, Some(28992)).unwrap());
    let root = &document["nodes"][0];
    assert_eq!(root["extras"]["srid"], 28992);
    assert_eq!(root["extras"]["generator"], "pg_occlusion");
    let origin = root["extras"]["origin"].as_array().unwrap();
    assert_eq!(
        root["translation"],
        json!([origin[0], origin[2], -origin[1].as_f64().unwrap()])
    );
    let features: Vec<_> = root["children"]
        .as_array()
        .unwrap()
        .iter()
        .map(|child| &document["nodes"][child.as_u64().unwrap() as usize])
        .map(|node| (node["name"].clone(), node["extras"]["feature"].clone()))
        .collect();
    for ((name, feature), model) in features.iter().zip(&models) {
        assert_eq!(*name, model.feature.name);
        assert_eq!(feature["id"], model.id);
        assert_eq!(feature["attributes"], model.feature.attributes);
    }
    assert_eq!(features[1].1["parts"][0]["class"], "BuildingPart");
}

#[test]
fn equal_models_give_equal_bytes() {
    let models = || [painted(1), courtyard(2), painted(3)];
    assert_eq!(
        write_glb(&models(), None).unwrap(),
        write_glb(&models(), None).unwrap()
    );
}

#[test]
fn materials_and_meanings_come_back() {
    let written = painted(1).feature;
    let scene = round_trip(&[painted(1), painted(2)], None);
    let looks = |feature: &Feature| -> BTreeMap<String, usize> {
        let geometry = &feature.geometries[0];
        let shape = &geometry.shape;
        let mut looks = BTreeMap::new();
        for surface in &shape.surfaces {
            let material = surface.material.map(|i| said(&shape.materials[i as usize]));
            let semantic = surface.semantic.map(|i| &shape.semantics[i as usize]);
            let triangles = surface.rings[0].len() - 2;
            *looks
                .entry(format!("{material:?} {semantic:?}"))
                .or_default() += triangles;
        }
        looks
    };
    assert_eq!(looks(&scene.features[0]), looks(&written));
    let document = document(&write_glb(&[painted(1), painted(2)], None).unwrap());
    assert_eq!(document["materials"].as_array().unwrap().len(), 2);
}

/// A material as a file says it.
fn said(material: &Material) -> Material {
    Material {
        metallic: material.metallic.or(Some(0.0)),
        roughness: material.roughness.or(Some(1.0)),
        ..material.clone()
    }
}

#[test]
fn instances_share_a_shape_unless_sheared() {
    let models = instances();
    let scene = round_trip(&models, None);
    // The last one is flat: it is written, and not a volume.
    assert_eq!(scene.features.len(), placements().len());
    let shapes: Vec<_> = scene
        .features
        .iter()
        .map(|f| Arc::as_ptr(&f.geometries[0].shape))
        .collect();
    assert!(shapes[..4].iter().all(|shape| *shape == shapes[0]));
    assert!(!shapes[4..].contains(&shapes[0]));
    for (model, read) in models.iter().zip(&scene.features) {
        let (written, read) = (&model.feature, read);
        assert_eq!(
            bits(delivered_positions(&written.geometries)),
            bits(positions(read))
        );
        // A mirrored shape's rings are reversed, so the order is not the same.
        let delivered: Vec<_> = delivered_positions(&written.geometries).collect();
        for from in positions(written) {
            let near = |to: &[f64; 3]| from.iter().zip(to).all(|(a, b)| (a - b).abs() < TOLERANCE);
            assert!(delivered.iter().any(near), "{from:?}");
        }
    }
    let volumes = |features: &[&Feature]| -> Vec<_> {
        features
            .iter()
            .map(|f| (volume(&surfaces(f)) * 1e3).round())
            .collect()
    };
    let written: Vec<_> = models.iter().map(|model| &model.feature).collect();
    let read: Vec<_> = scene.features.iter().collect();
    assert_eq!(volumes(&written), volumes(&read));
}

#[test]
fn a_second_trip_changes_nothing() {
    let once = round_trip(&[painted(1), courtyard(2)], None);
    let numbered = |scene: &SceneDescription| -> Vec<Model> {
        let features = scene.features.iter().cloned();
        features
            .zip(1..)
            .map(|(feature, id)| Model { id, feature })
            .collect()
    };
    let twice = round_trip(&numbered(&once), None);
    for (once, twice) in once.features.iter().zip(&twice.features) {
        assert_eq!(bits(positions(once)), bits(positions(twice)));
    }
}

#[test]
fn positions_do_not_depend_on_what_else_is_written() {
    let alone = round_trip(&[building(1, FAR)], None);
    let far = building(2, [900_000.0, -5_000_000.0, 12.5]);
    let among = round_trip(&[far, building(1, FAR)], None);
    assert_eq!(
        bits(positions(&alone.features[0])),
        bits(positions(&among.features[1]))
    );
}

#[test]
fn neighbours_keep_their_common_wall() {
    let [x, y, z] = FAR;
    let beside = [x + 10.25, y, z];
    let scene = round_trip(&[building(1, FAR), building(2, beside)], None);
    let wall = |feature: &Feature| -> BTreeSet<_> {
        let near = |p: &[f64; 3]| (p[0] - beside[0]).abs() < 1e-3;
        bits(positions(feature).into_iter().filter(near))
    };
    assert_eq!(wall(&scene.features[0]).len(), 4);
    assert_eq!(wall(&scene.features[0]), wall(&scene.features[1]));
}

#[test]
fn wide_features_stay_within_a_tenth_of_a_millimetre() {
    let bridge = model(
        1,
        vec![geometry(shape(box_surfaces(FAR, [4000.0, 3333.3, 20.1])))],
    );
    let delivered = delivered_positions(&bridge.feature.geometries);
    let moved = positions(&bridge.feature).into_iter().zip(delivered);
    for (from, to) in moved {
        assert!(
            from.iter().zip(to).all(|(a, b)| (a - b).abs() < 1e-4),
            "{from:?} {to:?}"
        );
    }
    let scene = round_trip(std::slice::from_ref(&bridge), None);
    assert_eq!(
        bits(positions(&scene.features[0])),
        bits(delivered_positions(&bridge.feature.geometries))
    );
}

#[test]
fn straight_vertices_keep_a_surface_closed() {
    // The front has a vertex on its upper edge, where two roofs meet.
    let [x, y, z] = FAR;
    let p = |dx: f64, dy: f64, dz: f64| [x + dx, y + dy, z + dz];
    let surfaces = vec![
        surface(&[
            p(0., 0., 0.),
            p(4., 0., 0.),
            p(4., 0., 3.),
            p(1.7, 0., 3.),
            p(0., 0., 3.),
        ]),
        surface(&[
            p(4., 5., 0.),
            p(0., 5., 0.),
            p(0., 5., 3.),
            p(1.7, 5., 3.),
            p(4., 5., 3.),
        ]),
        surface(&[p(0., 0., 3.), p(1.7, 0., 3.), p(1.7, 5., 3.), p(0., 5., 3.)]),
        surface(&[p(1.7, 0., 3.), p(4., 0., 3.), p(4., 5., 3.), p(1.7, 5., 3.)]),
        surface(&[p(0., 0., 0.), p(0., 0., 3.), p(0., 5., 3.), p(0., 5., 0.)]),
        surface(&[p(4., 0., 0.), p(4., 5., 0.), p(4., 5., 3.), p(4., 0., 3.)]),
        surface(&[p(0., 0., 0.), p(0., 5., 0.), p(4., 5., 0.), p(4., 0., 0.)]),
    ];
    assert_eq!(unpaired(&surfaces), 0);
    check_all(&[model(1, vec![geometry(shape(surfaces))])]);
}

#[test]
fn what_cannot_be_written_is_refused() {
    for bad in [f64::NAN, f64::INFINITY, 1e300] {
        let surfaces = vec![surface(&[[0.0; 3], [1.0, 0.0, 0.0], [bad, 1.0, 0.0]])];
        let error = write_glb(&[model(3, vec![geometry(shape(surfaces))])], None).unwrap_err();
        assert_eq!(
            error.to_string(),
            "feature 3 has a position that is not finite or too far from the others"
        );
    }
}

/// A prism over a star, far away, closed.
fn prism(radii: &[f64], height: f64) -> Shape {
    let at = |i: usize, z: f64| {
        let angle = i as f64 * std::f64::consts::TAU / radii.len() as f64;
        let (sin, cos) = angle.sin_cos();
        [FAR[0] + radii[i] * cos, FAR[1] + radii[i] * sin, FAR[2] + z]
    };
    let count = radii.len();
    let ring = |z: f64| (0..count).map(|i| at(i, z)).collect::<Vec<_>>();
    let mut floor = ring(0.0);
    floor.reverse();
    let mut surfaces = vec![surface(&floor), surface(&ring(height))];
    for i in 0..count {
        let j = (i + 1) % count;
        surfaces.push(surface(&[
            at(i, 0.0),
            at(j, 0.0),
            at(j, height),
            at(i, height),
        ]));
    }
    shape(surfaces)
}

fn attributes() -> impl Strategy<Value = Value> {
    let value = prop_oneof![
        Just(Value::Null),
        any::<bool>().prop_map(Value::from),
        any::<f64>().prop_map(Value::from),
        ".*".prop_map(Value::from),
    ];
    prop::collection::btree_map(".*", value, 0..4).prop_map(|map| map.into_iter().collect())
}

fn any_feature() -> impl Strategy<Value = Feature> {
    let prisms = prop::collection::vec(
        (prop::collection::vec(1.0..90.0f64, 3..12), 0.01..200.0f64),
        1..3,
    );
    (".{1,9}", ".{1,9}", attributes(), prisms, 0.0..10.0f64).prop_map(
        |(name, class, attributes, prisms, level_of_detail)| Feature {
            name,
            class,
            attributes,
            parts: Vec::new(),
            geometries: prisms
                .iter()
                .map(|(radii, height)| Geometry {
                    level_of_detail,
                    ..geometry(prism(radii, *height))
                })
                .collect(),
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..Default::default() })]

    #[test]
    fn made_features_come_back(features in prop::collection::vec(any_feature(), 0..4)) {
        let models: Vec<_> = features.into_iter().zip(0..).map(|(feature, id)| Model { id, feature }).collect();
        check_all(&models);
    }
}
