//! OpenStreetMap PBF made here: each rule of buildings, walls, bridges and streets.

mod osm_writer;
mod solids;

use formats::{Feature, ReadOptions, SceneDescription, read_bytes};
use osm_writer::{OsmFile, Tags};
use solids::{assert_closed, extent, volume};

fn read(file: &OsmFile) -> SceneDescription {
    let scene = read_bytes("city.osm.pbf", &file.raw(), &ReadOptions::default());
    let scene = scene.unwrap_or_else(|error| panic!("{error}"));
    scene.features.iter().for_each(assert_closed);
    scene
}

/// A building of 20 x 10 m with these tags.
fn building(tags: Tags<'_>) -> SceneDescription {
    let mut file = OsmFile::new();
    file.rectangle(1, [0.0, 0.0], [20.0, 10.0], tags);
    read(&file)
}

fn whys(scene: &SceneDescription) -> Vec<(&str, &str)> {
    scene
        .skipped
        .iter()
        .map(|s| (s.name.as_str(), s.why.as_str()))
        .collect()
}

fn hows(scene: &SceneDescription) -> Vec<&str> {
    scene
        .changed
        .iter()
        .map(|changed| changed.how.as_str())
        .collect()
}

/// Whether a feature reaches from one height to another and has about this volume.
fn assert_solid(feature: &Feature, heights: [f64; 2], expected: f64) {
    let found = extent(feature, 2);
    assert!(
        (found[0] - heights[0]).abs() < 1e-9 && (found[1] - heights[1]).abs() < 1e-9,
        "{found:?}"
    );
    let found = volume(feature);
    assert!(
        (found / expected - 1.0).abs() < 0.01,
        "{found} m³, expected {expected}"
    );
}

#[test]
fn a_building_is_extruded_with_all_its_tags() {
    let tags = [
        ("building", "yes"),
        ("height", "12,5 m"),
        ("name", "A"),
        ("building:colour", "#ff0000"),
    ];
    let scene = building(&tags);
    assert_eq!(scene.srid, Some(32635));
    assert!(
        scene
            .attribution
            .as_deref()
            .unwrap()
            .starts_with("OpenStreetMap contributors")
    );
    let [feature] = scene.features.as_slice() else {
        panic!("{} features", scene.features.len());
    };
    assert_eq!(
        (feature.name.as_str(), feature.class.as_str()),
        ("way/1", "Building")
    );
    assert_eq!(feature.attributes["name"], "A");
    assert_eq!(feature.geometries[0].level_of_detail, 1.0);
    assert_solid(feature, [0.0, 12.5], 200.0 * 12.5);
    let shape = &feature.geometries[0].shape;
    let wall = shape
        .surfaces
        .iter()
        .find(|s| shape.semantics[s.semantic.unwrap() as usize].class == "WallSurface")
        .unwrap();
    assert_eq!(
        shape.materials[wall.material.unwrap() as usize].diffuse,
        [1.0, 0.0, 0.0]
    );
    assert_eq!((whys(&scene), hows(&scene)), (vec![], vec![]));
}

#[test]
fn heights_levels_and_roofs_follow_the_rules() {
    let cases: [(Tags<'_>, [f64; 2], f64); 9] = [
        (&[("height", "40'")], [0.0, 12.192], 12.192),
        (&[("building:levels", "4")], [0.0, 12.0], 12.0),
        (&[("height", "10"), ("min_height", "4")], [4.0, 10.0], 6.0),
        (
            &[("building:levels", "4"), ("building:min_level", "1")],
            [3.0, 12.0],
            9.0,
        ),
        (
            &[
                ("height", "10"),
                ("roof:shape", "gabled"),
                ("roof:height", "4"),
            ],
            [0.0, 10.0],
            8.0,
        ),
        (
            &[
                ("building:levels", "2"),
                ("roof:shape", "gabled"),
                ("roof:levels", "1"),
            ],
            [0.0, 9.0],
            7.5,
        ),
        (
            &[
                ("height", "10"),
                ("roof:shape", "skillion"),
                ("roof:angle", "45"),
            ],
            [0.0, 10.0],
            5.0,
        ),
        (
            &[
                ("height", "10"),
                ("roof:shape", "pyramidal"),
                ("roof:height", "6"),
            ],
            [0.0, 10.0],
            6.0,
        ),
        (
            &[
                ("height", "10"),
                ("roof:shape", "flat"),
                ("roof:height", "6"),
            ],
            [0.0, 10.0],
            10.0,
        ),
    ];
    for (tags, [bottom, top], mean) in cases {
        let tags = [&[("building", "yes")], tags].concat();
        let scene = building(&tags);
        let [low, high] = extent(&scene.features[0], 2);
        // Angles give heights by widths, which the test knows to a thousandth.
        assert!(
            (low - bottom).abs() < 1e-9 && (high - top).abs() < 1e-9,
            "{tags:?}: {low} {high}"
        );
        let found = volume(&scene.features[0]) / 200.0;
        assert!(
            (found / mean - 1.0).abs() < 0.01,
            "{tags:?}: {found} m, expected {mean}"
        );
        let has_roof = tags
            .iter()
            .any(|(key, value)| *key == "roof:shape" && *value != "flat");
        let level = if has_roof { 2.0 } else { 1.0 };
        assert_eq!(
            scene.features[0].geometries[0].level_of_detail, level,
            "{tags:?}"
        );
    }
}

#[test]
fn what_cannot_be_built_as_tagged_is_told() {
    let onion = building(&[
        ("building", "church"),
        ("roof:shape", "onion"),
        ("height", "tall"),
    ]);
    let told = [
        "height is no height from 0 to 1000 m, ignored",
        "roof shape \"onion\" built as a dome",
    ];
    assert_eq!(hows(&onion), told);
    let hidden = building(&[("building", "yes"), ("location", "underground")]);
    assert_eq!(whys(&hidden), [("way/1", "under the ground")]);
    let inverted = building(&[("building", "yes"), ("height", "3"), ("min_height", "4")]);
    assert_eq!(
        whys(&inverted),
        [("way/1", "the top is not above the bottom")]
    );
    assert_eq!(building(&[("building", "no")]).features.len(), 0);
}

#[test]
fn parts_replace_the_outline_around_them() {
    let mut file = OsmFile::new();
    file.rectangle(
        1,
        [0.0, 0.0],
        [20.0, 10.0],
        &[("building", "yes"), ("height", "30")],
    );
    file.rectangle(
        2,
        [0.0, 0.0],
        [10.0, 10.0],
        &[("building:part", "yes"), ("height", "5")],
    );
    let gabled = [
        ("building:part", "yes"),
        ("height", "8"),
        ("roof:shape", "gabled"),
        ("roof:height", "2"),
    ];
    file.rectangle(3, [10.0, 0.0], [10.0, 10.0], &gabled);
    file.rectangle(
        4,
        [50.0, 0.0],
        [10.0, 10.0],
        &[("building:part", "yes"), ("height", "7")],
    );
    let scene = read(&file);
    let names: Vec<_> = scene.features.iter().map(|f| f.name.as_str()).collect();
    assert_eq!(names, ["way/4", "way/1"]);
    assert_eq!(
        hows(&scene),
        ["a part without a building around it, made a building"]
    );
    let whole = &scene.features[1];
    assert_solid(whole, [0.0, 8.0], 100.0 * 5.0 + 100.0 * 7.0);
    let parts: Vec<_> = whole
        .parts
        .iter()
        .map(|part| (part.name.as_str(), part.class.as_str()))
        .collect();
    assert_eq!(
        parts,
        [("way/2", "BuildingPart"), ("way/3", "BuildingPart")]
    );
    let of: Vec<_> = whole
        .geometries
        .iter()
        .map(|g| (g.part.as_deref(), g.level_of_detail))
        .collect();
    assert_eq!(of, [(Some("way/2"), 2.0), (Some("way/3"), 2.0)]);
}

#[test]
fn a_relation_of_type_building_gives_parts_to_an_outline_beside_them() {
    let mut file = OsmFile::new();
    file.rectangle(1, [0.0, 0.0], [10.0, 10.0], &[("building", "yes")]);
    file.rectangle(
        2,
        [20.0, 0.0],
        [10.0, 10.0],
        &[("building:part", "yes"), ("height", "5")],
    );
    file.relation(
        3,
        &[(1, 1, "outline"), (1, 2, "part")],
        &[("type", "building")],
    );
    let scene = read(&file);
    assert_eq!(scene.features.len(), 1);
    assert_solid(&scene.features[0], [0.0, 5.0], 500.0);
}

#[test]
fn multipolygons_have_holes_and_several_outer_rings() {
    let mut file = OsmFile::new();
    let corners =
        [[0.0, 0.0], [20.0, 0.0], [20.0, 20.0], [0.0, 20.0]].map(|[x, y]| file.node(x, y));
    let [a, b, c, d] = corners;
    file.way(1, &[a, b, c], &[]);
    file.way(2, &[a, d, c], &[]);
    file.rectangle(3, [5.0, 5.0], [10.0, 10.0], &[]);
    file.rectangle(4, [30.0, 0.0], [10.0, 10.0], &[("building", "yes")]);
    let members = [
        (1, 1, "outer"),
        (1, 2, "outer"),
        (1, 3, "inner"),
        (1, 4, "outer"),
    ];
    file.relation(
        9,
        &members,
        &[
            ("type", "multipolygon"),
            ("building", "yes"),
            ("height", "10"),
        ],
    );
    let broken = [(1, 1, "outer"), (1, 3, "inner")];
    file.relation(
        10,
        &broken,
        &[("type", "multipolygon"), ("building", "yes")],
    );
    let scene = read(&file);
    assert_eq!(scene.features.len(), 1);
    assert_eq!(scene.features[0].name, "relation/9");
    assert_solid(
        &scene.features[0],
        [0.0, 10.0],
        10.0 * (400.0 - 100.0 + 100.0),
    );
    let told = [
        ("relation/10", "the ways of the relation do not form rings"),
        ("way/4", "the outline of a relation of the same kind"),
    ];
    assert_eq!(whys(&scene), told);
}

#[test]
fn touching_buildings_share_the_bits_of_their_corners() {
    let mut file = OsmFile::new();
    let [a, b, c, d] =
        [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]].map(|[x, y]| file.node(x, y));
    let [e, f] = [[20.0, 0.0], [20.0, 10.0]].map(|[x, y]| file.node(x, y));
    file.way(1, &[a, b, c, d, a], &[("building", "yes")]);
    file.way(2, &[b, e, f, c, b], &[("building", "yes")]);
    let scene = read(&file);
    let corners = |feature: &Feature| -> Vec<[u64; 3]> {
        let surfaces = &feature.geometries[0].shape.surfaces;
        surfaces
            .iter()
            .flat_map(|s| &s.rings)
            .flatten()
            .map(|p| p.map(f64::to_bits))
            .collect()
    };
    let (one, other) = (corners(&scene.features[0]), corners(&scene.features[1]));
    let mut shared: Vec<_> = one.iter().filter(|corner| other.contains(corner)).collect();
    shared.sort();
    shared.dedup();
    assert_eq!(shared.len(), 4);
}

#[test]
fn walls_and_bridges_are_solids() {
    let mut file = OsmFile::new();
    let wall = [("barrier", "wall"), ("height", "3"), ("width", "0.5")];
    file.line(1, &[[0.0, 0.0], [30.0, 0.0], [30.0, 20.0]], &wall);
    file.rectangle(2, [100.0, 0.0], [50.0, 50.0], &[("barrier", "city_wall")]);
    file.rectangle(
        3,
        [200.0, 0.0],
        [5.0, 5.0],
        &[("barrier", "wall"), ("area", "yes")],
    );
    file.rectangle(
        4,
        [300.0, 0.0],
        [50.0, 10.0],
        &[("man_made", "bridge"), ("layer", "2")],
    );
    file.rectangle(5, [400.0, 0.0], [9.0, 9.0], &[("barrier", "fence")]);
    let scene = read(&file);
    let classes: Vec<_> = scene.features.iter().map(|f| f.class.as_str()).collect();
    assert_eq!(classes, ["Wall", "Wall", "Wall", "Bridge"]);
    assert_solid(&scene.features[0], [0.0, 3.0], 50.0 * 0.5 * 3.0);
    assert_solid(&scene.features[1], [0.0, 6.0], 200.0 * 2.0 * 6.0);
    assert_solid(&scene.features[2], [0.0, 2.0], 25.0 * 2.0);
    assert_solid(&scene.features[3], [10.0, 11.0], 500.0);
}

#[test]
fn streets_have_their_width_and_squares_their_area() {
    let mut file = OsmFile::new();
    let line = [[0.0, 0.0], [100.0, 0.0]];
    file.line(1, &line, &[("highway", "residential"), ("width", "7")]);
    file.rectangle(
        2,
        [0.0, 0.0],
        [20.0, 30.0],
        &[("highway", "pedestrian"), ("area", "yes")],
    );
    file.rectangle(3, [0.0, 0.0], [20.0, 30.0], &[("place", "square")]);
    file.line(4, &line, &[("highway", "primary"), ("bridge", "yes")]);
    file.line(5, &line, &[("highway", "footway"), ("tunnel", "yes")]);
    file.line(6, &line, &[("highway", "proposed")]);
    file.rectangle(7, [0.0, 0.0], [20.0, 30.0], &[("leisure", "park")]);
    let scene = read(&file);
    let found: Vec<_> = scene
        .streets
        .iter()
        .map(|s| (s.name.as_str(), s.class.as_str()))
        .collect();
    assert_eq!(
        found,
        [
            ("way/1", "Road"),
            ("way/2", "TransportSquare"),
            ("way/3", "TransportSquare")
        ]
    );
    let area = |street: usize| solids::area(&scene.streets[street].surfaces);
    // A strip with two half discs, drawn with few corners.
    assert!(
        (area(0) - (700.0 + 3.5 * 3.5 * 3.0)).abs() < 10.0,
        "{}",
        area(0)
    );
    assert!((area(1) - 600.0).abs() < 6.0, "{}", area(1));
    let told = [
        ("way/4", "on a bridge"),
        ("way/5", "in a tunnel or a passage"),
        ("way/6", "a highway of a kind that is no street"),
    ];
    assert_eq!(whys(&scene), told);
}

#[test]
fn an_extract_may_miss_nodes() {
    let mut file = OsmFile::new();
    let [a, b, c] = [[0.0, 0.0], [10.0, 0.0], [20.0, 0.0]].map(|[x, y]| file.node(x, y));
    file.way(1, &[a, b, c, 99, a], &[("building", "yes")]);
    file.way(2, &[a, b, 99, 98, b, c], &[("highway", "footway")]);
    file.way(3, &[a, 99], &[("highway", "footway")]);
    let scene = read(&file);
    assert_eq!(
        whys(&scene),
        [
            ("way/1", "a node is missing"),
            ("way/3", "a node is missing")
        ]
    );
    assert_eq!(scene.streets[0].name, "way/2");
}

#[test]
fn any_projected_frame_can_be_asked_for() {
    let mut file = OsmFile::new();
    file.rectangle(1, [0.0, 0.0], [20.0, 10.0], &[("building", "yes")]);
    let read = |srid| {
        let options = ReadOptions {
            srid: Some(srid),
            ..ReadOptions::default()
        };
        read_bytes("city.osm.pbf", &file.zlib(), &options)
    };
    assert_eq!(read(3067).unwrap().srid, Some(3067));
    let error = read(4326).unwrap_err().to_string();
    assert_eq!(
        error,
        "city.osm.pbf: srid 4326, which is not projected, is not supported"
    );
}

#[test]
fn batches_are_as_small_as_asked_for_and_can_be_stopped() {
    let mut file = OsmFile::new();
    for i in 0..20 {
        file.rectangle(
            i,
            [30.0 * i as f64, 0.0],
            [20.0, 10.0],
            &[("building", "yes")],
        );
    }
    let options = ReadOptions {
        batch_bytes: 1,
        ..ReadOptions::default()
    };
    let read = |most: usize| {
        let mut batches = Vec::new();
        let mut input = std::io::Cursor::new(file.zlib());
        formats::read("city.osm.pbf", &mut input, &options, &mut |batch| {
            batches.push(batch);
            if batches.len() < most {
                std::ops::ControlFlow::Continue(())
            } else {
                std::ops::ControlFlow::Break(())
            }
        })
        .unwrap();
        batches
    };
    let all = read(usize::MAX);
    assert_eq!(
        all.iter().map(|batch| batch.features.len()).sum::<usize>(),
        20
    );
    assert!(
        all.iter()
            .all(|batch| batch.features.len() <= 1 && batch.srid == Some(32635))
    );
    assert_eq!(read(3).len(), 3);
}
