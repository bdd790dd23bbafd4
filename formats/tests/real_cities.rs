//! Real files with the counts that are known of them; without the files, documents made here that
//! have the same counts.

mod common;

use std::collections::BTreeMap;

use common::{document_of_classes, read_all, real_file, sequence_of_buildings};
use formats::{Feature, SceneDescription};

fn read(name: &str, otherwise: impl FnOnce() -> Vec<u8>) -> SceneDescription {
    let bytes = real_file(name).unwrap_or_else(otherwise);
    let scene = read_all(name, &bytes).unwrap_or_else(|error| panic!("{error}"));
    assert_sound(&scene);
    scene
}

/// What holds of every scene: no empty geometry.
fn assert_sound(scene: &SceneDescription) {
    for feature in &scene.features {
        assert!(!feature.geometries.is_empty(), "{}", feature.name);
        for surface in feature
            .geometries
            .iter()
            .flat_map(|geometry| &geometry.shape.surfaces)
        {
            assert!(
                surface.rings.iter().all(|ring| ring.len() >= 3),
                "{}",
                feature.name
            );
        }
    }
}

fn classes(features: &[Feature]) -> BTreeMap<&str, usize> {
    let mut counts = BTreeMap::new();
    for feature in features {
        *counts.entry(feature.class.as_str()).or_default() += 1;
    }
    counts
}

#[test]
fn delft_has_1115_buildings_in_four_levels_of_detail() {
    let scene = read("delft.city.jsonl", || sequence_of_buildings(1115));
    assert_eq!(
        classes(&scene.features),
        BTreeMap::from([("Building", 1115)])
    );
    assert_eq!((scene.streets.len(), scene.skipped.len()), (0, 0));
    assert_eq!(scene.srid, Some(7415));
    assert_eq!(scene.title.as_deref(), Some("3DBAG"));
    let mut levels: Vec<_> = scene.features[0]
        .geometries
        .iter()
        .map(|g| g.level_of_detail)
        .collect();
    levels.sort_by(f64::total_cmp);
    assert_eq!(levels, [0.0, 1.2, 1.3, 2.2]);
}

#[test]
fn delft_lod1_has_features_of_six_classes_and_143_roads() {
    let features = [
        ("Bridge", 3),
        ("Building", 160),
        ("GenericCityObject", 54),
        ("LandUse", 81),
        ("PlantCover", 126),
        ("WaterBody", 3),
    ];
    let scene = read("delft_lod1_with_roads.json", || {
        document_of_classes(&[&features[..], &[("Road", 143)]].concat())
    });
    assert_eq!(classes(&scene.features), BTreeMap::from(features));
    assert_eq!(scene.streets.len(), 143);
    assert!(
        scene
            .streets
            .iter()
            .all(|road| road.class == "Road" && !road.surfaces.is_empty())
    );
    assert_eq!((scene.skipped.len(), scene.srid), (0, Some(7415)));
}

#[test]
fn rotterdam_has_16_buildings() {
    let scene = read("rotterdam_subset.json", || {
        document_of_classes(&[("Building", 16)])
    });
    assert_eq!(classes(&scene.features), BTreeMap::from([("Building", 16)]));
    assert_eq!((scene.streets.len(), scene.skipped.len()), (0, 0));
}

#[test]
fn single_buildings_and_short_sequences_are_read() {
    let scene = read("delft_1b.json", || document_of_classes(&[("Building", 1)]));
    assert_eq!((scene.features.len(), scene.srid), (1, Some(7415)));
    let scene = read("small.city.jsonl", || sequence_of_buildings(3));
    assert_eq!((scene.features.len(), scene.srid), (3, Some(7415)));
    let scene = read("DH_01_subs.city.json", || {
        document_of_classes(&[("Building", 4)])
    });
    assert_eq!((scene.features.len(), scene.skipped.len()), (4, 0));
}

#[test]
fn trees_from_templates_stand_apart_though_grouped() {
    let templates = include_bytes!("data/trees.city.jsonl");
    let scene = read("geom_temp.city.jsonl", || templates.to_vec());
    let expected = [
        ("Bridge", 1),
        ("GenericCityObject", 1),
        ("SolitaryVegetationObject", 15),
    ];
    assert_eq!(classes(&scene.features), BTreeMap::from(expected));
    let skipped: Vec<_> = scene
        .skipped
        .iter()
        .map(|s| (s.class.as_str(), s.why.as_str()))
        .collect();
    assert_eq!(skipped, [("CityObjectGroup", "a group of other objects")]);
}

#[test]
fn a_scale_of_zero_leaves_nothing_to_see() {
    let flat = include_bytes!("data/zero_scale.city.jsonl");
    let scene = read("noise_extension.city.jsonl", || flat.to_vec());
    assert!(scene.features.is_empty());
    assert_eq!(scene.degenerate_rings, 24);
    let why = "no surface with three distinct vertices";
    assert_eq!(
        scene
            .skipped
            .iter()
            .map(|s| s.why.as_str())
            .collect::<Vec<_>>(),
        [why; 3]
    );
}
