//! Semantics and materials of surfaces, and what is said where they are lost.

mod common;

use common::{BOX_SHELL, document, read_all};
use formats::{Material, SceneDescription, Semantic, Shape};
use serde_json::json;

fn read(text: &str) -> SceneDescription {
    read_all("test.city.json", text.as_bytes()).unwrap_or_else(|error| panic!("{error}"))
}

const MATERIALS: &str = r#""appearance":{"materials":[{"name":"brick","diffuseColor":[0.5,0.25,0]},
    {"name":"","transparency":0.5},{"name":"tile","shininess":2,"ambientIntensity":0.75}]}"#;

/// A document with one building, its one geometry with these members, and materials.
fn with(kind: &str, boundaries: &str, members: &str, appearance: &str) -> SceneDescription {
    let mut text = document(&format!(
        r#""a":{{"type":"Building","geometry":[{{"type":"{kind}","lod":"2","boundaries":{boundaries},{members}}}]}}"#
    ));
    text.pop();
    read(&format!("{text},{appearance}}}"))
}

fn shape(scene: &SceneDescription) -> &Shape {
    &scene.features[0].geometries[0].shape
}

fn semantics_of(shape: &Shape) -> Vec<Option<u32>> {
    shape
        .surfaces
        .iter()
        .map(|surface| surface.semantic)
        .collect()
}

fn materials_of(shape: &Shape) -> Vec<Option<u32>> {
    shape
        .surfaces
        .iter()
        .map(|surface| surface.material)
        .collect()
}

#[test]
fn semantics_follow_the_nesting_of_each_type() {
    let surfaces = r#""surfaces":[{"type":"RoofSurface"},{"type":"+Dormer"}]"#;
    let six = [Some(1), None, Some(0), Some(0), Some(0), Some(0)];
    let list = "[1,null,0,0,0,0]";
    let cases = [
        (
            "MultiSurface",
            BOX_SHELL.to_owned(),
            list.to_owned(),
            six.to_vec(),
        ),
        (
            "CompositeSurface",
            BOX_SHELL.to_owned(),
            "null".to_owned(),
            vec![None; 6],
        ),
        (
            "Solid",
            format!("[{BOX_SHELL},{BOX_SHELL}]"),
            format!("[null,{list}]"),
            [vec![None; 6], six.to_vec()].concat(),
        ),
        (
            "MultiSolid",
            format!("[[{BOX_SHELL}],[{BOX_SHELL},{BOX_SHELL}],[{BOX_SHELL}]]"),
            format!("[[{list}],[{list},null],null]"),
            [six.to_vec(), six.to_vec(), vec![None; 12]].concat(),
        ),
    ];
    for (kind, boundaries, values, expected) in cases {
        let members = format!(r#""semantics":{{{surfaces},"values":{values}}}"#);
        let scene = with(kind, &boundaries, &members, MATERIALS);
        assert_eq!(semantics_of(shape(&scene)), expected, "{kind}");
        assert_eq!(shape(&scene).semantics[1].class, "+Dormer");
        assert!(scene.changed.is_empty());
    }
}

#[test]
fn semantics_keep_their_attributes_in_order() {
    let semantics = r#""semantics":{"values":[0],"surfaces":[
        {"slope":33.5,"type":"RoofSurface","children":[1],"a":{"b":null}},
        {"type":"Window","parent":0}]}"#;
    let scene = with("MultiSurface", "[[[0,1,2]]]", semantics, MATERIALS);
    let roof = &shape(&scene).semantics[0];
    assert_eq!(
        roof.attributes.to_string(),
        r#"{"slope":33.5,"children":[1],"a":{"b":null}}"#
    );
    let window = Semantic {
        class: "Window".to_owned(),
        attributes: json!({"parent": 0}),
    };
    assert_eq!(
        shape(&scene).semantics[1],
        window,
        "kept for its parent's sake"
    );
}

#[test]
fn values_stay_with_their_surfaces_when_others_are_dropped() {
    let members = r#""semantics":{"surfaces":[{"type":"A"},{"type":"B"}],"values":[0,1]},
        "material":{"m":{"values":[0,2]}}"#;
    let scene = with("MultiSurface", "[[[0,0,1]],[[0,1,2]]]", members, MATERIALS);
    assert_eq!(semantics_of(shape(&scene)), [Some(1)]);
    let material = materials_of(shape(&scene))[0].unwrap() as usize;
    assert_eq!(
        shape(&scene).materials[material].name.as_deref(),
        Some("tile")
    );
}

#[test]
fn materials_are_those_used_numbered_anew() {
    let members = r#""material":{"first":{"values":[[2,null,0,2,2,2]]},"other":{"value":1}}"#;
    let boundaries = format!("[{BOX_SHELL}]");
    let scene = with("Solid", &boundaries, members, MATERIALS);
    let expected = [Some(1), None, Some(0), Some(1), Some(1), Some(1)];
    assert_eq!(materials_of(shape(&scene)), expected);
    let brick = Material {
        name: Some("brick".to_owned()),
        diffuse: [0.5, 0.25, 0.0],
        ..Material::default()
    };
    let tile = Material {
        name: Some("tile".to_owned()),
        shininess: 1.0,
        ambient_intensity: 0.75,
        ..Material::default()
    };
    assert_eq!(shape(&scene).materials, [brick, tile]);
    let default_theme = MATERIALS.replacen('{', r#"{"default-theme-material":"other","#, 1);
    let scene = with("Solid", &boundaries, members, &default_theme);
    assert_eq!(materials_of(shape(&scene)), [Some(0); 6]);
    let glass = Material {
        transparency: 0.5,
        ..Material::default()
    };
    assert_eq!(shape(&scene).materials, [glass]);
}

#[test]
fn losses_are_told_once_a_feature() {
    let told = |members: &str, appearance: &str| {
        let scene = with("MultiSurface", "[[[0,1,2]],[[4,5,6]]]", members, appearance);
        let bare = shape(&scene);
        assert!(bare.materials.is_empty() && bare.semantics.is_empty());
        assert_eq!(semantics_of(bare), [None; 2]);
        assert_eq!(materials_of(bare), [None; 2]);
        let changes = scene.changed.iter();
        let changes = changes.map(|c| format!("{} {}: {}", c.class, c.name, c.how));
        changes.collect::<Vec<_>>().join("; ")
    };
    let texture = r#""texture":{"rgb":{"values":[[[0,0,1,2]],[[null]]]}}"#;
    assert_eq!(told(texture, MATERIALS), "Building a: textures left out");
    assert_eq!(told(r#""texture":{}"#, MATERIALS), "");
    assert_eq!(told(r#""material":{}"#, MATERIALS), "");
    let semantics = "Building a: malformed semantics left out";
    for wrong in [
        r#"{"values":[0,0]}"#,
        r#"{"surfaces":[{"type":"A"}],"values":[0]}"#,
        r#"{"surfaces":[{"type":"A"}],"values":[0,1]}"#,
        r#"{"surfaces":[{"type":"A"}],"values":[0,-1]}"#,
        r#"{"surfaces":[{"type":"A"}],"values":[[0,0]]}"#,
        r#"{"surfaces":[{"slope":1}],"values":[0,0]}"#,
        r#"{"surfaces":["A"],"values":[0,0]}"#,
        "[]",
    ] {
        assert_eq!(
            told(&format!(r#""semantics":{wrong}"#), MATERIALS),
            semantics,
            "{wrong}"
        );
    }
    let materials = "Building a: malformed materials left out";
    for wrong in [
        r#"{"m":{"value":3}}"#,
        r#"{"m":{"values":[0]}}"#,
        r#"{"m":0}"#,
        "7",
    ] {
        assert_eq!(
            told(&format!(r#""material":{wrong}"#), MATERIALS),
            materials,
            "{wrong}"
        );
    }
    let red = r#""appearance":{"materials":[{"name":"a","diffuseColor":"red"}]}"#;
    assert_eq!(told(r#""material":{"m":{"value":0}}"#, red), materials);
}

#[test]
fn a_line_of_a_sequence_has_its_own_materials_or_those_of_the_header() {
    let header = format!(
        r#"{{"type":"CityJSON","version":"2.0","transform":{{"scale":[1,1,1],"translate":[0,0,0]}},"CityObjects":{{}},"vertices":[],{}}}"#,
        MATERIALS.replace('\n', "")
    );
    let line = |id: &str, appearance: &str| {
        format!(
            r#"{{"type":"CityJSONFeature","id":"{id}",{appearance}"CityObjects":{{"{id}":{{"type":"Building","geometry":[{{"type":"MultiSurface","lod":"1","boundaries":[[[0,1,2]]],"material":{{"m":{{"value":0}}}}}}]}}}},"vertices":[[0,0,0],[1,0,0],[0,1,0]]}}"#
        )
    };
    let own = line("a", r#""appearance":{"materials":[{"name":"own"}]},"#);
    let scene = read(&[header, own, line("b", "")].join("\n"));
    let names = scene
        .features
        .iter()
        .map(|f| f.geometries[0].shape.materials[0].name.clone());
    let names: Vec<_> = names.flatten().collect();
    assert_eq!(names, ["own", "brick"]);
}
