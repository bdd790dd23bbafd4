//! The centre of Helsinki, with the counts that are known of it; without the file, a city made here
//! that has the same counts.

mod common;
mod osm_writer;
mod solids;

use std::collections::BTreeMap;

use formats::{Format, ReadOptions, read_bytes};
use osm_writer::OsmFile;

const BUILDINGS: i64 = 450;
const BUILDINGS_WITH_PARTS: i64 = 54;
const WALLS: i64 = 108;
const STREETS: i64 = 2158;

/// Rows of buildings, walls and footways.
fn city() -> Vec<u8> {
    let mut file = OsmFile::new();
    let place = |i: i64, row: f64| [(i % 50) as f64 * 20.0, (row + (i / 50) as f64) * 20.0];
    for i in 0..BUILDINGS {
        file.rectangle(i, place(i, 0.0), [20.0, 10.0], &[("building", "yes")]);
        if i < BUILDINGS_WITH_PARTS {
            let part = [
                ("building:part", "yes"),
                ("roof:shape", "gabled"),
                ("building:levels", "2"),
            ];
            file.rectangle(10_000 + i, place(i, 0.0), [10.0, 10.0], &part);
        }
    }
    for i in 0..WALLS {
        file.rectangle(
            20_000 + i,
            place(i, 10.0),
            [9.0, 9.0],
            &[("barrier", "wall")],
        );
    }
    for i in 0..STREETS {
        let [x, y] = place(i, 20.0);
        file.line(
            30_000 + i,
            &[[x, y], [x + 20.0, y]],
            &[("highway", "footway")],
        );
    }
    file.rectangle(
        50_000,
        place(0, 80.0),
        [30.0, 9.0],
        &[("man_made", "bridge")],
    );
    file.zlib()
}

#[test]
fn helsinki_is_closed_solids_on_the_ground_and_streets() {
    let bytes = common::real_file("helsinki.osm.pbf").unwrap_or_else(city);
    assert_eq!(Format::recognise(&bytes), Some(Format::OsmPbf));
    let scene = read_bytes("helsinki.osm.pbf", &bytes, &ReadOptions::default());
    let scene = scene.unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(scene.srid, Some(32635));
    let mut classes: BTreeMap<&str, i64> = BTreeMap::new();
    for feature in &scene.features {
        *classes.entry(feature.class.as_str()).or_default() += 1;
        solids::assert_closed(feature);
        let [low, high] = solids::extent(feature, 2);
        assert!(low >= 0.0 && high < 100.0, "{}: {low} {high}", feature.name);
    }
    let expected = [("Bridge", 1), ("Building", BUILDINGS), ("Wall", WALLS)];
    assert_eq!(classes, BTreeMap::from(expected));
    let with_parts = scene
        .features
        .iter()
        .filter(|feature| !feature.parts.is_empty())
        .count();
    assert_eq!(with_parts as i64, BUILDINGS_WITH_PARTS);
    assert_eq!(scene.streets.len() as i64, STREETS);
    for street in &scene.streets {
        assert!(solids::area(&street.surfaces) > 0.0, "{}", street.name);
    }
    let with_roofs = scene
        .features
        .iter()
        .filter(|f| f.geometries[0].level_of_detail == 2.0);
    assert!(with_roofs.count() >= 13);
}
