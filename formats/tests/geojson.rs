//! GeoJSON: footprints, streets, reference systems, and whatever else files hold.

mod solids;

use formats::{FormatError, ReadOptions, SceneDescription, read_bytes};
use proptest::prelude::*;
use solids::{assert_closed, extent, volume};

fn try_read(text: &str) -> Result<SceneDescription, FormatError> {
    read_bytes("city.geojson", text.as_bytes(), &ReadOptions::default())
}

fn read(text: &str) -> SceneDescription {
    let scene = try_read(text).unwrap_or_else(|error| panic!("{error}"));
    scene.features.iter().for_each(assert_closed);
    scene
}

/// A collection in the Dutch grid.
fn dutch(features: &[String]) -> String {
    let crs = r#""crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::28992"}}"#;
    format!(
        r#"{{"type":"FeatureCollection",{crs},"features":[{}]}}"#,
        features.join(",")
    )
}

fn feature(geometry: &str, coordinates: &str, properties: &str) -> String {
    let geometry = format!(r#"{{"type":"{geometry}","coordinates":{coordinates}}}"#);
    format!(r#"{{"type":"Feature","geometry":{geometry},"properties":{properties}}}"#)
}

/// A square of 10 m in the Dutch grid, as an outer ring.
const SQUARE: &str = "[[85000,447000],[85010,447000],[85010,447010],[85000,447010],[85000,447000]]";

fn square(properties: &str) -> String {
    feature("Polygon", &format!("[{SQUARE}]"), properties)
}

fn whys(scene: &SceneDescription) -> Vec<&str> {
    scene
        .skipped
        .iter()
        .map(|skipped| skipped.why.as_str())
        .collect()
}

#[test]
fn footprints_with_heights_are_closed_solids() {
    for (properties, heights, expected) in [
        (r#"{"height":12}"#, [0.0, 12.0], 1200.0),
        (
            r#"{"building_height":"12 m","min_height":2}"#,
            [2.0, 12.0],
            1000.0,
        ),
        (r#"{"hoehe":"12,5","base":null}"#, [0.0, 12.5], 1250.0),
        (r#"{"levels":3}"#, [0.0, 9.0], 900.0),
    ] {
        let scene = read(&dutch(&[square(properties)]));
        assert_eq!(scene.srid, Some(28992));
        let found = &scene.features[0];
        assert_eq!(
            (found.name.as_str(), found.class.as_str()),
            ("feature 0", "Building")
        );
        assert_eq!(extent(found, 2), heights, "{properties}");
        assert!(
            (volume(found) - expected).abs() < 1e-3,
            "{properties}: {}",
            volume(found)
        );
        assert_eq!(
            found.attributes,
            serde_json::from_str::<serde_json::Value>(properties).unwrap()
        );
        assert_eq!(
            [extent(found, 0), extent(found, 1)],
            [[85_000.0, 85_010.0], [447_000.0, 447_010.0]]
        );
    }
}

#[test]
fn holes_parts_and_heights_of_positions_are_kept() {
    let hole = "[[85002,447002],[85004,447002],[85004,447004],[85002,447004],[85002,447002]]";
    let far = SQUARE.replace("447", "448");
    let raised = SQUARE.replace("000]", "000,7.5]").replace("010]", "010,8]");
    let scene = read(&dutch(&[
        feature("Polygon", &format!("[{SQUARE},{hole}]"), r#"{"height":5}"#),
        feature(
            "MultiPolygon",
            &format!("[[{SQUARE}],[{far}]]"),
            r#"{"height":5}"#,
        ),
        feature("Polygon", &format!("[{raised}]"), r#"{"height":5}"#),
    ]));
    let volumes: Vec<_> = scene.features.iter().map(|f| volume(f).round()).collect();
    assert_eq!(volumes, [480.0, 1000.0, 500.0]);
    assert_eq!(extent(&scene.features[2], 2), [7.5, 12.5]);
}

#[test]
fn longitude_and_latitude_go_to_the_zone_around_them() {
    let ring = "[[24.94,60.17],[24.9402,60.17],[24.9402,60.1701],[24.94,60.1701],[24.94,60.17]]";
    let one = feature("Polygon", &format!("[{ring}]"), r#"{"height":10}"#);
    for crs in [
        "",
        r#""crs":null,"#,
        r#""crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:OGC:1.3:CRS84"}},"#,
        r#""crs":{"type":"name","properties":{"name":"EPSG:4326"}},"#,
    ] {
        let text =
            format!(r#"{{"features":[{one}],{crs}"type":"FeatureCollection","name":"centre"}}"#);
        let scene = read(&text);
        assert_eq!(
            (scene.srid, scene.title.as_deref()),
            (Some(32635), Some("centre"))
        );
        let width = extent(&scene.features[0], 0);
        assert!((width[1] - width[0] - 11.5).abs() < 0.3, "{width:?}");
    }
    let alone = read(&one);
    assert_eq!((alone.srid, alone.features.len()), (Some(32635), 1));
    let options = ReadOptions {
        srid: Some(3067),
        ..ReadOptions::default()
    };
    assert_eq!(
        read_bytes("a", one.as_bytes(), &options).unwrap().srid,
        Some(3067)
    );
}

#[test]
fn streets_are_lines_with_a_width_or_areas() {
    let line = "[[85000,447000],[85100,447000]]";
    let scene = read(&dutch(&[
        feature("LineString", line, r#"{"width":8}"#),
        feature(
            "MultiLineString",
            &format!("[{line}]"),
            r#"{"highway":"residential"}"#,
        ),
        square(r#"{"class":"TransportSquare","height":3}"#),
        square(r#"{"type":"street"}"#),
        square(r#"{"highway":"pedestrian"}"#),
        feature("LineString", line, r#"{"class":"Road"}"#),
        feature("LineString", line, r#"{"class":"Wall","width":1}"#),
        feature("LineString", line, "{}"),
        feature("LineString", "[[1,1],[1,1]]", r#"{"width":8}"#),
    ]));
    let classes: Vec<_> = scene
        .streets
        .iter()
        .map(|street| street.class.as_str())
        .collect();
    assert_eq!(classes, ["Road", "Road", "TransportSquare", "Road", "Road"]);
    let areas: Vec<_> = scene
        .streets
        .iter()
        .map(|street| solids::area(&street.surfaces))
        .collect();
    assert!(
        (areas[0] - 847.0).abs() < 5.0 && (areas[2] - 100.0).abs() < 1e-6,
        "{areas:?}"
    );
    let expected = [
        "a line without a width",
        "a line that is no street",
        "a line that is no street",
        "the line has no length",
    ];
    assert_eq!(whys(&scene), expected);
}

#[test]
fn names_come_from_ids_properties_or_numbers_and_are_unique() {
    let with_id = |id: &str| {
        square(r#"{"height":3,"name":"n"}"#).replacen('{', &format!("{{\"id\":{id},"), 1)
    };
    let features = [
        with_id("\"a\""),
        with_id("7"),
        square(r#"{"height":3,"name":"n"}"#),
        square(r#"{"height":3,"id":"a"}"#),
        square(r#"{"height":3}"#),
    ];
    let scene = read(&dutch(&features));
    let names: Vec<_> = scene
        .features
        .iter()
        .map(|feature| feature.name.as_str())
        .collect();
    assert_eq!(names, ["a", "7", "n", "a#3", "feature 4"]);
    assert_eq!(scene.changed.len(), 1);
    assert_eq!(scene.changed[0].name, "a#3");
}

#[test]
fn what_cannot_be_built_is_skipped_with_the_reason() {
    let ring = |coordinates: &str| feature("Polygon", coordinates, r#"{"height":3}"#);
    let scene = read(&dutch(&[
        square("{}"),
        square(r#"{"height":"tall"}"#),
        square(r#"{"height":1e308}"#),
        square(r#"{"height":-3}"#),
        square(r#"{"height":3,"base":3}"#),
        feature("Point", "[85000,447000]", r#"{"height":3}"#),
        r#"{"type":"Feature","geometry":null,"properties":null}"#.to_owned(),
        ring("[[[0,0],[9,9],[9,0],[0,5],[0,0]]]"),
        ring("[[[0,0],[9,0]]]"),
        ring("[]"),
        feature("MultiPolygon", "[]", r#"{"height":3}"#),
        ring("[[[0,0],[9,0],[9,9],[0,0]],[[20,0],[21,0],[21,1],[20,0]]]"),
    ]));
    assert_eq!(
        whys(&scene),
        [
            "no height",
            "the height is no height up to 1000 m",
            "the height is no height up to 1000 m",
            "the top is not above the bottom",
            "the top is not above the bottom",
            "a geometry of type \"Point\"",
            "no geometry",
            "the outline crosses itself",
            "the outline has no area",
            "the outline has no area",
            "no geometry",
            "a hole is not inside of the outline",
        ]
    );
}

#[test]
fn open_and_clockwise_rings_are_put_right() {
    let clockwise = "[[85000,447000],[85000,447010],[85010,447010],[85010,447000]]";
    let scene = read(&dutch(&[feature(
        "Polygon",
        &format!("[{clockwise}]"),
        r#"{"height":3}"#,
    )]));
    assert!((volume(&scene.features[0]) - 300.0).abs() < 1e-3);
    assert_eq!(scene.changed[0].how, "rings closed that were open");
}

#[test]
fn documents_that_are_wrong_are_refused() {
    let one = |feature: &str| format!(r#"{{"type":"FeatureCollection","features":[{feature}]}}"#);
    let crs = |crs: &str| format!(r#"{{"type":"FeatureCollection","crs":{crs},"features":[]}}"#);
    let named = |name: &str| {
        crs(&format!(
            r#"{{"type":"name","properties":{{"name":"{name}"}}}}"#
        ))
    };
    let deep = format!("{}{}", "[".repeat(101), "]".repeat(101));
    let far = feature("Polygon", &format!("[{SQUARE}]"), r#"{"height":3}"#);
    for (text, problem) in [
        (
            r#"{"type":"FeatureCollection"}"#.to_owned(),
            "features is missing",
        ),
        (
            r#"{"type":"Point","coordinates":[0,0]}"#.to_owned(),
            "type is \"Point\", expected \"FeatureCollection\" or \"Feature\"",
        ),
        (
            one("7"),
            "object \"feature 0\": feature is \"7\", expected an object",
        ),
        (
            one(r#"{"geometry":{"type":"Polygon"}}"#),
            "object \"feature 0\": coordinates is missing",
        ),
        (
            one(r#"{"geometry":{"type":"Polygon","coordinates":[[["a",0]]]}}"#),
            "object \"feature 0\": coordinates is malformed: invalid type: string \"a\", expected f64",
        ),
        (
            one(r#"{"geometry":{"type":"Polygon","coordinates":[[[1e999,0]]]}}"#),
            "object \"feature 0\": coordinates is malformed: number out of range",
        ),
        (
            one(r#"{"geometry":{"type":"Polygon","coordinates":[[[0]]]}}"#),
            "object \"feature 0\": coordinates is malformed: invalid length 1, expected a position of two or three numbers",
        ),
        (
            one(r#"{"id":[],"geometry":null}"#),
            "object \"feature 0\": id is \"[]\", expected a string or a number",
        ),
        (
            one(&far),
            "object \"feature 0\": position is \"85000 447000\", expected a longitude and a latitude, or a crs member that names the system",
        ),
        (
            one(&format!(r#"{{"geometry":{deep}}}"#)),
            "101 levels of nesting exceed the limit of 100",
        ),
        (crs("7"), "crs is \"7\", expected an object"),
        (
            named("urn:ogc:def:crs:EPSG::4258"),
            "srid 4258, which is not projected, is not supported",
        ),
        (
            named("urn:ogc:def:crs:EPSG::2263"),
            "srid 2263, which is not in metres, is not supported",
        ),
        (
            named("EPSG:99"),
            "srid 99, which is not known, is not supported",
        ),
        (
            named("local"),
            "crs is \"local\", expected the name of a system of epsg",
        ),
    ] {
        let found = try_read(&text).unwrap_err().to_string();
        assert!(
            found.starts_with("city.geojson") && found.ends_with(problem),
            "{found}, expected {problem}"
        );
    }
    let huge = dutch(&[feature(
        "Polygon",
        "[[[1e308,0],[1,0],[1,1],[1e308,0]]]",
        r#"{"height":3}"#,
    )]);
    let found = try_read(&huge).unwrap_err().to_string();
    assert!(
        found.ends_with("expected coordinates within reach of the projection"),
        "{found}"
    );
}

/// How often a ring runs anticlockwise around a point in plan.
fn winding(ring: &[[f64; 3]], [x, y]: [f64; 2]) -> i32 {
    let edges = ring.iter().zip(ring.iter().cycle().skip(1));
    let passes = edges.map(|(a, b)| {
        let left = (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
        let up = a[1] <= y && b[1] > y && left > 0.0;
        let down = a[1] > y && b[1] <= y && left < 0.0;
        i32::from(up) - i32::from(down)
    });
    passes.sum()
}

fn seeds() -> Vec<String> {
    let hole = "[[85002,447002],[85004,447002],[85004,447004],[85002,447004],[85002,447002]]";
    let degrees = "[[[24.94,60.17],[24.9402,60.17],[24.9402,60.1701],[24.94,60.17]]]";
    vec![
        dutch(&[
            feature(
                "MultiPolygon",
                &format!("[[{SQUARE},{hole}]]"),
                r#"{"height":12,"base":"2 m"}"#,
            ),
            feature(
                "LineString",
                "[[85000,447000],[85100,447000,3]]",
                r#"{"width":8}"#,
            ),
        ]),
        feature(
            "Polygon",
            degrees,
            r#"{"id":"a","levels":2,"class":"Building"}"#,
        ),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 5000, failure_persistence: None, ..Default::default() })]

    #[test]
    fn no_mutation_makes_the_reader_panic(
        seed in 0..2_usize,
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0..5_usize), 1..5),
    ) {
        const PIECES: [&str; 8] = ["-1", "1e999", "1e308", "null", "[]", "{}", "\"\"", "0.1"];
        let mut text = seeds().swap_remove(seed).into_bytes();
        for (at, byte, how) in changes {
            if text.is_empty() {
                break;
            }
            let at = at.index(text.len());
            match how {
                0 => text[at] = byte,
                1 => text.truncate(at),
                2 => drop(text.drain(at..(at + usize::from(byte)).min(text.len()))),
                3 => drop(text.splice(at..at, PIECES[usize::from(byte) % PIECES.len()].bytes())),
                _ => {
                    let end = (at + usize::from(byte)).min(text.len());
                    let copy = text[at..end].to_vec();
                    text.splice(at..at, copy);
                }
            }
        }
        match read_bytes("mutated", &text, &ReadOptions::default()) {
            Err(error) => prop_assert!(error.to_string().starts_with("mutated")),
            Ok(scene) => {
                let shapes = scene.features.iter().flat_map(|f| &f.geometries).map(|g| &g.shape);
                let mut numbers = shapes.flat_map(|s| &s.surfaces).flat_map(|s| &s.rings).flatten().flatten();
                prop_assert!(numbers.all(|number| number.is_finite()));
            }
        }
    }

    #[test]
    fn random_rings_are_closed_solids_or_skipped(
        ring in prop::collection::vec((0..12_i32, 0..12_i32), 0..9),
        hole in prop::collection::vec((0..12_i32, 0..12_i32), 0..5),
    ) {
        let text = |ring: &[(i32, i32)]| format!("{ring:?}").replace('(', "[").replace(')', "]");
        let rings = format!("[{},{}]", text(&ring), text(&hole));
        let scene = read(&dutch(&[feature("Polygon", &rings, r#"{"height":3}"#)]));
        prop_assert_eq!(scene.features.len() + scene.skipped.len(), 1);
        for surface in scene.features.iter().flat_map(|f| &f.geometries[0].shape.surfaces) {
            if surface.semantic == Some(1) {
                // Beside the grid of the vertices, a roof covers each point once or not at all.
                for (x, y) in (0..144).map(|i| (f64::from(i / 12) + 0.51, f64::from(i % 12) + 0.53)) {
                    let windings: i32 = surface.rings.iter().map(|ring| winding(ring, [x, y])).sum();
                    prop_assert!((0..=1).contains(&windings), "{} at {} {}", rings, x, y);
                }
            }
        }
    }
}
