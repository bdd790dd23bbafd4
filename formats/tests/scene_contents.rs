//! What a scene holds of each geometry type, hierarchy, template and appearance.

mod common;

use common::{BOX_SHELL, TRANSFORM, building, document, object, read_all};
use formats::{Part, SceneDescription};

fn read(text: &str) -> SceneDescription {
    read_all("test.city.json", text.as_bytes()).unwrap_or_else(|error| panic!("{error}"))
}

/// Surfaces of the only feature's only geometry, as numbers of vertices of each ring.
fn ring_lengths(text: &str) -> Vec<Vec<usize>> {
    let scene = read(text);
    assert_eq!(
        (scene.features.len(), scene.features[0].geometries.len()),
        (1, 1)
    );
    let surfaces = &scene.features[0].geometries[0].shape.surfaces;
    surfaces
        .iter()
        .map(|surface| surface.rings.iter().map(Vec::len).collect())
        .collect()
}

#[test]
fn every_surface_type_gives_all_its_surfaces() {
    let nested = |open: &str, close: &str| format!("{open}{BOX_SHELL},{BOX_SHELL}{close}");
    let cases = [
        ("MultiSurface", BOX_SHELL.to_owned(), 6),
        ("CompositeSurface", BOX_SHELL.to_owned(), 6),
        ("Solid", nested("[", "]"), 12),
        (
            "MultiSolid",
            format!("[[{BOX_SHELL}],{}]", nested("[", "]")),
            18,
        ),
        (
            "CompositeSolid",
            format!("[[{BOX_SHELL}],[{BOX_SHELL}]]"),
            12,
        ),
    ];
    for (kind, boundaries, surfaces) in cases {
        let text = document(&object("a", "Building", kind, &boundaries));
        assert_eq!(ring_lengths(&text), vec![vec![4]; surfaces], "{kind}");
    }
}

#[test]
fn points_and_lines_alone_are_skipped_and_beside_surfaces_ignored() {
    let points = object("p", "GenericCityObject", "MultiPoint", "[0,1,2]");
    let lines = object("l", "Road", "MultiLineString", "[[0,1,2],[4,5]]");
    let none = r#""n":{"type":"Building"},"e":{"type":"Building","geometry":[]}"#;
    let scene = read(&document(&[points, lines, none.to_owned()].join(",")));
    assert!(scene.features.is_empty() && scene.streets.is_empty());
    let skipped: Vec<_> = scene
        .skipped
        .iter()
        .map(|s| (s.name.as_str(), s.why.as_str()))
        .collect();
    let (lines, nothing) = ("only points or lines", "no geometry");
    assert_eq!(
        skipped,
        [("p", lines), ("l", lines), ("n", nothing), ("e", nothing)]
    );
    let both = format!(
        r#""b":{{"type":"Building","geometry":[
            {{"type":"MultiPoint","lod":"0","boundaries":[0]}},
            {{"type":"MultiSurface","lod":1,"boundaries":{BOX_SHELL}}}]}}"#
    );
    assert_eq!(ring_lengths(&document(&both)).len(), 6);
}

#[test]
fn holes_follow_their_outer_ring_and_closing_vertices_go() {
    let with_hole = "[[[0,1,2,3,0],[4,5,6,4]],[[4,5,6,7],[0,1],[0,1,2]]]";
    let text = document(&object("a", "Bridge", "MultiSurface", with_hole));
    assert_eq!(ring_lengths(&text), [vec![4, 3], vec![4, 3]]);
    assert_eq!(read(&text).degenerate_rings, 1);
}

#[test]
fn positions_are_scaled_and_moved_to_the_same_bits_wherever_used() {
    let scene = read(&document(&building("a")));
    let surfaces = &scene.features[0].geometries[0].shape.surfaces;
    let expected = [
        2000.0 * 0.001 + 85000.0,
        3000.0 * 0.001 + 447000.0,
        4000.0 * 0.001 - 1.5,
    ];
    let corner = expected.map(f64::to_bits);
    let positions = surfaces.iter().flat_map(|surface| &surface.rings).flatten();
    let uses = positions
        .filter(|position| position.map(f64::to_bits) == corner)
        .count();
    assert_eq!(uses, 3);
}

#[test]
fn classes_become_features_streets_and_terrain() {
    let square = "[[[0,1,2,3]]]";
    let classes = [
        "Road",
        "TransportSquare",
        "TINRelief",
        "Railway",
        "+NoiseBarrier",
        "WaterBody",
    ];
    let objects = classes.map(|class| object(class, class, "CompositeSurface", square));
    let scene = read(&document(&objects.join(",")));
    let names = |list: Vec<&String>| list.into_iter().cloned().collect::<Vec<_>>();
    let features = names(scene.features.iter().map(|f| &f.class).collect());
    assert_eq!(features, ["Railway", "+NoiseBarrier", "WaterBody"]);
    assert_eq!(
        names(scene.streets.iter().map(|s| &s.class).collect()),
        classes[..2]
    );
    assert_eq!(
        (
            scene.skipped[0].name.as_str(),
            scene.skipped[0].why.as_str()
        ),
        (classes[2], "terrain")
    );
}

#[test]
fn a_street_has_the_surfaces_of_its_highest_level_of_detail() {
    let road = r#""r":{"type":"Road","geometry":[
        {"type":"MultiSurface","lod":"1","boundaries":[[[0,1,2,3]]]},
        {"type":"MultiSurface","lod":"2","boundaries":[[[0,1,2]],[[0,2,3]]]},
        {"type":"MultiSurface","lod":"0","boundaries":[[[4,5,6,7]]]}]}"#;
    let surfaces = &read(&document(road)).streets[0].surfaces;
    assert_eq!(
        surfaces
            .iter()
            .map(|s| s.rings[0].len())
            .collect::<Vec<_>>(),
        [3, 3]
    );
}

#[test]
fn descendants_are_merged_into_their_root_with_the_part_named() {
    let part = |id: &str, parent: &str, more: &str, surface: &str| {
        format!(
            r#""{id}":{{"type":"BuildingPart","parents":["{parent}"],{more}"attributes":{{"x":1}},
            "geometry":[{{"type":"MultiSurface","lod":"2.2","boundaries":[{surface}]}}]}}"#
        )
    };
    let objects = [
        r#""root":{"type":"Building","attributes":{"z":2,"a":[1e3,null]},"children":["one"]}"#
            .into(),
        part("two", "one", "", "[[4,5,6,7]]"),
        part("one", "root", r#""children":["two"],"#, "[[0,1,2,3]]"),
        building("other"),
    ];
    let scene = read(&document(&objects.join(",")));
    assert_eq!(scene.features.len(), 2);
    let feature = &scene.features[0];
    assert_eq!(
        (feature.name.as_str(), feature.class.as_str()),
        ("root", "Building")
    );
    assert_eq!(
        feature.attributes.to_string(),
        r#"{"z":2,"a":[1000.0,null]}"#
    );
    let parts: Vec<_> = feature
        .geometries
        .iter()
        .map(|g| (g.part.as_deref(), g.level_of_detail))
        .collect();
    assert_eq!(parts, [(Some("one"), 2.2), (Some("two"), 2.2)]);
    let part = |name: &str| Part {
        name: name.to_owned(),
        class: "BuildingPart".to_owned(),
        attributes: serde_json::json!({"x": 1}),
    };
    assert_eq!(feature.parts, [part("one"), part("two")]);
}

#[test]
fn parts_have_geometry_or_attributes() {
    let part = |id: &str, members: &str| {
        format!(r#""{id}":{{"type":"BuildingInstallation","parents":["b"]{members}}}"#)
    };
    let square = r#","geometry":[{"type":"MultiSurface","lod":"2","boundaries":[[[0,1,2,3]]]}]"#;
    let points = r#","geometry":[{"type":"MultiPoint","lod":"2","boundaries":[0]}]"#;
    let objects = [
        building("b"),
        part("bare", ""),
        part("points", points),
        part("named", r#","attributes":{"name":"chimney"}"#),
        part("square", square),
    ];
    let scene = read(&document(&objects.join(",")));
    let parts: Vec<_> = scene.features[0].parts.iter().collect();
    let names: Vec<_> = parts.iter().map(|part| part.name.as_str()).collect();
    assert_eq!(names, ["named", "square"]);
    assert_eq!(parts[1].attributes, serde_json::json!({}));
    assert_eq!(scene.features[0].geometries[0].part, None);
}

#[test]
fn sequences_take_byte_order_marks_blank_lines_and_carriage_returns() {
    let header = format!(
        r#"{{"type":"CityJSON","version":"1.1","transform":{TRANSFORM},"CityObjects":{{}},"vertices":[]}}"#
    );
    let line = |id: &str| {
        let square = object(id, "Building", "MultiSurface", "[[[0,1,2]]]");
        let vertices = "[[0,0,0],[1000,0,0],[0,1000,0]]";
        format!(
            r#"{{"type":"CityJSONFeature","id":"{id}","CityObjects":{{{square}}},"vertices":{vertices}}}"#
        )
    };
    let text = format!(
        "\u{feff}{header}\r\n\r\n{}\r\n  \r\n{}",
        line("a"),
        line("b")
    );
    let scene = read(&text);
    assert_eq!(
        scene
            .features
            .iter()
            .map(|f| f.name.as_str())
            .collect::<Vec<_>>(),
        ["a", "b"]
    );
    let header_only = read(&header);
    assert_eq!(header_only, SceneDescription::default());
}
