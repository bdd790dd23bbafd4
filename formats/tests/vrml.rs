//! VRML97: what each node gives, and what is refused.

use std::f64::consts::PI;
use std::sync::Arc;

use formats::{Feature, ReadOptions, SceneDescription, Surface, read_bytes};

fn read(body: &str) -> SceneDescription {
    try_read(body).expect("a file that is right")
}

fn try_read(body: &str) -> Result<SceneDescription, String> {
    let text = format!("#VRML V2.0 utf8\n{body}");
    let options = ReadOptions::default();
    read_bytes("city.wrl", text.as_bytes(), &options).map_err(|error| error.to_string())
}

fn names(scene: &SceneDescription) -> Vec<&str> {
    scene.features.iter().map(|f| f.name.as_str()).collect()
}

fn shape(geometry: &str) -> String {
    format!("Shape {{ geometry {geometry} }}")
}

fn surfaces(feature: &Feature) -> Vec<Surface> {
    let geometries = feature.geometries.iter();
    geometries.flat_map(|g| g.surfaces().into_owned()).collect()
}

/// The surfaces of the only feature.
fn only(body: &str) -> Vec<Surface> {
    let scene = read(body);
    assert_eq!(scene.features.len(), 1, "{scene:?}");
    surfaces(&scene.features[0])
}

/// Six times the volume inside: positive where surfaces are oriented outwards.
fn volume(surfaces: &[Surface]) -> f64 {
    let mut sum = 0.0;
    for ring in surfaces.iter().flat_map(|surface| &surface.rings) {
        for corner in 1..ring.len() - 1 {
            let [a, b, c] = [ring[0], ring[corner], ring[corner + 1]];
            sum += a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
                + a[2] * (b[0] * c[1] - b[1] * c[0]);
        }
    }
    sum / 6.0
}

/// Whether each edge is used once in each direction, bit by bit.
fn is_closed(surfaces: &[Surface]) -> bool {
    let mut edges: Vec<([u64; 3], [u64; 3])> = Vec::new();
    for ring in surfaces.iter().flat_map(|surface| &surface.rings) {
        let next = ring.iter().cycle().skip(1);
        let bits = |position: &[f64; 3]| position.map(f64::to_bits);
        edges.extend(ring.iter().zip(next).map(|(a, b)| (bits(a), bits(b))));
    }
    let mut reversed: Vec<_> = edges.iter().map(|(a, b)| (*b, *a)).collect();
    edges.sort_unstable();
    reversed.sort_unstable();
    edges == reversed
}

fn extent(surfaces: &[Surface]) -> ([f64; 3], [f64; 3]) {
    let positions = surfaces
        .iter()
        .flat_map(|surface| surface.rings.iter().flatten());
    let start = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    positions.fold(start, |(low, high), position| {
        let low = std::array::from_fn(|i| low[i].min(position[i]));
        (low, std::array::from_fn(|i| high[i].max(position[i])))
    })
}

#[test]
fn primitives_are_closed_and_oriented_outwards() {
    let cases = [
        ("Box { size 2 4 6 }", 48.0, 48.0),
        ("Cone { bottomRadius 2 height 3 }", 11.0, 4.0 * PI),
        ("Cylinder { radius 2 height 3 }", 36.0, 12.0 * PI),
        ("Sphere { radius 2 }", 32.0, 33.511),
        ("Extrusion { }", 4.0, 4.0),
        ("Extrusion { spine [0 0 0, 0 0 5] }", 20.0, 20.0),
        (
            "Extrusion { spine [0 0 0, 0 1 0, 0 2 1] scale [1 1, 2 2, 1 3] }",
            8.0,
            30.0,
        ),
    ];
    for (geometry, least, most) in cases {
        let surfaces = only(&shape(geometry));
        let volume = volume(&surfaces);
        assert!(is_closed(&surfaces), "{geometry}");
        assert!(
            volume > least - 1e-9 && volume < most + 1e-9,
            "{geometry}: {volume}"
        );
    }
}

#[test]
fn y_is_up_and_south_is_z() {
    let (low, high) = extent(&only(
        "Transform { translation 10 20 30 children Shape { geometry Box { size 2 4 6 } } }",
    ));
    assert_eq!((low, high), ([9.0, -33.0, 18.0], [11.0, -27.0, 22.0]));
}

#[test]
fn extrusions_follow_their_spine() {
    let along_x = only(&shape(
        "Extrusion { crossSection [1 0, 0 -2, -1 0, 1 0] spine [0 0 0, 5 0 0] }",
    ));
    assert!(is_closed(&along_x));
    let (low, high) = extent(&along_x);
    assert!(high[0] - low[0] == 5.0 && (volume(&along_x) - 10.0).abs() < 1e-9);
    let ring = "spine [3 0 0, 0 0 3, -3 0 0, 0 0 -3, 3 0 0] beginCap FALSE endCap FALSE";
    let torus = only(&shape(&format!("Extrusion {{ {ring} scale 0.5 0.5 }}")));
    assert!(is_closed(&torus), "{torus:?}");
}

#[test]
fn grids_are_seen_from_above_unless_they_say_otherwise() {
    let grid = "xDimension 3 zDimension 2 xSpacing 2 zSpacing 3 height [0 0 1, 0 0 0]";
    let up = only(&shape(&format!("ElevationGrid {{ {grid} }}")));
    assert_eq!(
        up.len(),
        3,
        "the quadrangle that is not flat is two triangles"
    );
    assert_eq!(up[0].rings[0][0], [0.0, 0.0, 0.0]);
    assert_eq!(up[0].rings[0][1], [0.0, -3.0, 0.0]);
    let down = only(&shape(&format!("ElevationGrid {{ ccw FALSE {grid} }}")));
    assert_eq!(down[0].rings[0][3], [0.0, 0.0, 0.0]);
    let error = try_read(&shape(
        "ElevationGrid { xDimension 3 zDimension 3 height 1 }",
    ));
    let message =
        "city.wrl, line 2: height is 1 numbers, expected xDimension times zDimension numbers";
    assert_eq!(error.unwrap_err(), message);
}

#[test]
fn face_sets_keep_their_polygons() {
    let set = "coord Coordinate { point [0 0 0, 1 0 0, 1 1 0, .5 .2 0, 0 1 0] } convex FALSE";
    let one = only(&shape(&format!(
        "IndexedFaceSet {{ {set} coordIndex [0 1 2 3 4 -1] }}"
    )));
    assert_eq!(one[0].rings[0].len(), 5);
    let error = try_read(&shape(&format!(
        "IndexedFaceSet {{ {set} coordIndex [0 1 5] }}"
    )));
    let message = "city.wrl, line 2: coordIndex 5 is out of range, there are 5";
    assert_eq!(error.unwrap_err(), message);
}

#[test]
fn materials_are_kept_and_textures_counted() {
    let scene = read(
        "DEF a Shape { appearance Appearance {
            material DEF Brick Material { diffuseColor 1 .5 0 transparency 0.25 }
            texture ImageTexture { url \"a.png\" } }
          geometry IndexedFaceSet { color Color { color 1 0 0 } coord Coordinate {
            point [0 0 0, 1 0 0, 0 1 0] } coordIndex [0 1 2] } }",
    );
    let shape = &scene.features[0].geometries[0].shape;
    let material = &shape.materials[0];
    assert_eq!(shape.surfaces[0].material, Some(0));
    assert_eq!(material.name.as_deref(), Some("Brick"));
    assert_eq!(
        (material.diffuse, material.transparency),
        ([1.0, 0.5, 0.0], 0.25)
    );
    let changes: Vec<_> = scene
        .changed
        .iter()
        .map(|changed| changed.how.as_str())
        .collect();
    assert_eq!(
        changes,
        [
            "colours of vertices and faces left out",
            "textures left out"
        ]
    );
}

#[test]
fn the_children_of_the_only_group_are_the_features() {
    let cube = shape("Box { }");
    let scene = read(&format!(
        "Viewpoint {{ }} Group {{ children Transform {{ children [
            DEF A Group {{ children [ {cube} {cube} ] }}
            Transform {{ translation 5 0 0 children {cube} }}
            DEF A {cube} ] }} }}"
    ));
    assert_eq!(names(&scene), ["A", "city-2", "A-2"]);
    let whole = read(&format!("DEF House Group {{ children [ {cube} {cube} ] }}"));
    assert_eq!(names(&whole), ["House"]);
    assert_eq!(whole.features[0].geometries.len(), 1);
    assert_eq!(surfaces(&whole.features[0]).len(), 12);
    assert_eq!(
        names(&read(&format!("{cube} {cube}"))),
        ["city-1", "city-2"]
    );
}

#[test]
fn uses_share_one_shape() {
    let scene = read(
        "DEF Tree Group { children [ Shape { geometry Cone { } } Shape { geometry Sphere { } } ] }
         Transform { translation 1 2 3 children USE Tree }
         DEF Pair Group { children [ USE Tree Transform { scale -1 1 1 children USE Tree } ] }",
    );
    assert_eq!(names(&scene), ["Tree", "city-2", "Pair"]);
    let geometries: Vec<_> = scene.features.iter().flat_map(|f| &f.geometries).collect();
    assert_eq!(geometries.len(), 4);
    assert!(
        geometries
            .iter()
            .all(|g| Arc::ptr_eq(&g.shape, &geometries[0].shape))
    );
    let moved = geometries[1].placement.expect("a placement");
    assert_eq!(moved.apply([0.0; 3]), [1.0, -3.0, 2.0]);
    assert!(
        volume(&geometries[3].surfaces()) > 0.0,
        "mirrored, and still outwards"
    );
}

#[test]
fn instances_are_checked_where_they_stand() {
    let cone = "DEF C Shape { geometry Cone { } }";
    let far = "Transform { translation 0 0 1e9 children USE C }";
    let error = try_read(&format!("{cone}\n{far}")).unwrap_err();
    let message =
        "city.wrl, line 2: coordinate is -1000000001.0, expected a number of metres up to 1e9";
    assert_eq!(error, message);
    let flat = "DEF F Transform { scale 1 0 1 children USE C }";
    let scene = read(&format!("{cone} {flat}"));
    let expected = surfaces(&scene.features[1]).len();
    assert!(expected > 0 && scene.features[1].geometries[0].placement.is_none());
    let point = read(&format!(
        "{cone} DEF L Transform {{ scale 0 0 0 children USE C }}"
    ));
    assert_eq!((point.features.len(), point.skipped.len()), (1, 1));
}

#[test]
fn switches_choose_and_levels_become_levels_of_detail() {
    let [a, b] = ["Box { size 1 1 1 }", "Box { size 2 2 2 }"].map(shape);
    let chosen = only(&format!("Switch {{ whichChoice 1 choice [ {a} {b} ] }}"));
    assert_eq!(volume(&chosen), 8.0);
    assert!(
        read(&format!("Switch {{ choice {a} }}"))
            .features
            .is_empty()
    );
    let scene = read(&format!(
        "DEF H Group {{ children [ {a} LOD {{ level [ {b} {a} Group {{ }} ] range [10, 20] }} ] }}"
    ));
    let levels: Vec<_> = scene.features[0]
        .geometries
        .iter()
        .map(|g| (g.level_of_detail, volume(&g.surfaces())))
        .collect();
    assert_eq!(levels, [(2.0, 9.0), (1.0, 2.0), (0.0, 1.0)]);
}

#[test]
fn lines_points_and_text_are_skipped_with_the_reason() {
    let scene = read(
        "DEF L Shape { geometry IndexedLineSet { coord Coordinate { point 0 0 0 } coordIndex 0 } }
         DEF P Shape { geometry PointSet { } } DEF T Shape { geometry Text { string \"a\" } }
         DEF N Shape { geometry IndexedFaceSet { } }
         DEF H Group { children [ Shape { geometry Box { } } Shape { geometry PointSet { } } ] }",
    );
    let why: Vec<_> = scene
        .skipped
        .iter()
        .map(|s| (s.name.as_str(), s.why.as_str()))
        .collect();
    let none = "no surface with three distinct vertices";
    let lines = "only lines or points";
    assert_eq!(
        why,
        [("L", lines), ("P", lines), ("T", "only text"), ("N", none)]
    );
    assert_eq!(scene.changed[0].how, "lines and points left out");
}

#[test]
fn what_moves_and_shines_is_passed_over() {
    let scene = read(
        "DEF T TimeSensor { cycleInterval 4 loop TRUE }
         DEF I PositionInterpolator { key [0, 1] keyValue [0 0 0, 1 1 1] }
         DEF S Script { url \"javascript: x\" eventIn SFBool on field MFNode held [ Group { } ]
            field SFVec3f at 1 2 3 eventOut SFTime off directOutput TRUE }
         PixelTexture { image 1 2 3 0xFF0000 0xFF } Background { skyColor [0 0 1] }
         DEF B Transform { children Shape { geometry Box { } } ROUTE T.a TO I.b }
         ROUTE T.fraction_changed TO I.set_fraction ROUTE I.value_changed TO B.set_translation",
    );
    assert_eq!(names(&scene), ["B"]);
}

#[test]
fn what_is_refused_says_so_with_the_line() {
    let deep = format!("{}{}", "Group { children ".repeat(101), "}".repeat(101));
    let cases = [
        ("\nPROTO A [ ] { }", "3: PROTO is not supported"),
        ("EXTERNPROTO A [ ] \"a\"", "2: EXTERNPROTO is not supported"),
        (
            "Group {\nchildren Inline { url \"a\" } }",
            "3: Inline is not supported",
        ),
        (
            "\r\n\rTeapot { }",
            "4: node type \"Teapot\" is not supported",
        ),
        (
            "Box { sise 1 }",
            "2: a field of Box is \"sise\", expected one that vrml97 gives it",
        ),
        ("Box { size 1 1 1 size 1 1 1 }", "2: \"size\" appears twice"),
        ("Box { size 1 1 }", "2: size is \"}\", expected a number"),
        (
            "Box { size 1 1 1e999 }",
            "2: size is \"1e999\", expected a number",
        ),
        ("Box size", "2: Box is \"size\", expected \"{\" after it"),
        (
            "Box {",
            "2: a field of Box is the end of the file, expected a name",
        ),
        (
            "Cone { side 1 }",
            "2: side is \"1\", expected TRUE or FALSE",
        ),
        (
            "Switch { whichChoice 1.5 }",
            "2: whichChoice is \"1.5\", expected a whole number of 32 bits",
        ),
        (
            "WorldInfo { title 5 }",
            "2: title is \"5\", expected a string",
        ),
        (
            "ROUTE a.b c.d",
            "2: a route is \"c\", expected the form: node.event TO node.event",
        ),
        (
            "DEF A Group { children USE A }",
            "2: the name after USE is \"A\", expected one that a DEF before it gives to a complete node",
        ),
        (
            "Shape { geometry Group { } }",
            "2: the geometry of a Shape is Group, expected a geometry node",
        ),
        (
            "Script { field SFFoo a 1 }",
            "2: a type of field is \"SFFoo\", expected one of vrml97",
        ),
        (
            deep.as_str(),
            "2: 101 levels of nested nodes exceed the limit of 100",
        ),
        (
            "Transform { translation 2e9 0 0 children Shape { geometry Box { } } }",
            "2: coordinate is 1999999999.0, expected a number of metres up to 1e9",
        ),
    ];
    for (body, message) in cases {
        assert_eq!(
            try_read(body).unwrap_err(),
            format!("city.wrl, line {message}")
        );
    }
    let version = read_bytes("a.wrl", b"#VRML V1.0 ascii\n", &ReadOptions::default());
    assert_eq!(
        version.unwrap_err().to_string(),
        "a.wrl: vrml 1.0 (convert it to vrml97) is not supported"
    );
}

#[test]
fn few_bytes_do_not_make_much_memory() {
    let mut doubled = "DEF A0 Shape { geometry Sphere { } }\n".to_owned();
    for i in 1..60 {
        let before = i - 1;
        doubled += &format!("DEF A{i} Group {{ children [ USE A{before} USE A{before} ] }}\n");
    }
    let error = try_read(&doubled).unwrap_err();
    assert!(error.contains("exceed the limit of 3000000"), "{error}");
}
