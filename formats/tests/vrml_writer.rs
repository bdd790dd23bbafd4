//! What is written as VRML97 comes back.

mod common;

use std::collections::HashMap;
use std::sync::Arc;

use common::{real_file, sequence_of_buildings};
use formats::{
    Feature, Geometry, Material, Model, Placement, ReadOptions, SceneDescription, Shape, Surface,
    read_bytes, write_vrml,
};
use proptest::prelude::*;
use serde_json::json;

/// Most that a position may move, in metres.
const ALLOWED: f64 = 1e-4;

const CORNER: [f64; 3] = [85_000.123, 447_000.456, -1.789];

fn surface(rings: &[&[[f64; 3]]], material: Option<u32>) -> Surface {
    Surface {
        rings: rings.iter().map(|ring| ring.to_vec()).collect(),
        material,
        semantic: None,
    }
}

/// A block with a passage from the bottom to the top: two faces with a hole.
fn block_with_passage([x, y, z]: [f64; 3]) -> Vec<Surface> {
    let at = |[i, j, k]: [f64; 3]| [x + i * 7.001, y + j * 5.003, z + k * 3.007];
    let square = |low: f64, high: f64, k: f64| {
        [[low, low], [high, low], [high, high], [low, high]].map(|[i, j]| at([i, j, k]))
    };
    let (outer, inner) = (
        [0.0, 1.0].map(|k| square(0.0, 1.0, k)),
        [0.0, 1.0].map(|k| square(0.3, 0.6, k)),
    );
    let reversed = |mut ring: [[f64; 3]; 4]| {
        ring.reverse();
        ring
    };
    let mut all = vec![
        surface(&[&outer[1], &reversed(inner[1])], Some(1)),
        surface(&[&reversed(outer[0]), &inner[0]], None),
    ];
    for i in 0..4 {
        let j = (i + 1) % 4;
        all.push(surface(
            &[&[outer[0][i], outer[0][j], outer[1][j], outer[1][i]]],
            Some(0),
        ));
        all.push(surface(
            &[&[inner[0][j], inner[0][i], inner[1][i], inner[1][j]]],
            Some(0),
        ));
    }
    all
}

fn materials() -> Vec<Material> {
    let brick = Material {
        name: Some("red brick, 21 cm".to_owned()),
        diffuse: [0.7, 0.25, 0.125],
        shininess: 0.1,
        ..Material::default()
    };
    let glass = Material {
        transparency: 0.6,
        emissive: [0.0, 0.1, 0.2],
        specular: [1.0; 3],
        ambient_intensity: 0.9,
        ..Material::default()
    };
    vec![brick, glass]
}

fn model(id: i64, name: &str, geometries: Vec<Geometry>) -> Model {
    let feature = Feature {
        name: name.to_owned(),
        class: "Building".to_owned(),
        attributes: json!({"use": "a \"shop\" \\ flat", "storeys": 3, "ratio": 0.1}),
        parts: Vec::new(),
        geometries,
    };
    Model { id, feature }
}

fn geometry(shape: &Arc<Shape>, placement: Option<Placement>) -> Geometry {
    Geometry {
        level_of_detail: 2.2,
        part: None,
        shape: shape.clone(),
        placement,
    }
}

fn shape(surfaces: Vec<Surface>) -> Arc<Shape> {
    Arc::new(Shape {
        surfaces,
        materials: materials(),
        semantics: Vec::new(),
    })
}

fn read(text: &str) -> SceneDescription {
    read_bytes("out.wrl", text.as_bytes(), &ReadOptions::default()).expect("our own file")
}

fn surfaces(feature: &Feature) -> Vec<Surface> {
    let geometries = feature.geometries.iter();
    geometries.flat_map(|g| g.surfaces().into_owned()).collect()
}

/// How many edges are passed more often in one direction than in the other.
fn open_edges(surfaces: &[Surface]) -> usize {
    let mut balance: HashMap<[[u64; 3]; 2], i64> = HashMap::new();
    for ring in surfaces.iter().flat_map(|surface| &surface.rings) {
        for (a, b) in ring.iter().zip(ring.iter().cycle().skip(1)) {
            let (a, b) = (a.map(f64::to_bits), b.map(f64::to_bits));
            *balance.entry([a.min(b), a.max(b)]).or_default() += if a < b { 1 } else { -1 };
        }
    }
    balance.values().filter(|balance| **balance != 0).count()
}

fn volume(surfaces: &[Surface]) -> f64 {
    let mut sum = 0.0;
    for ring in surfaces.iter().flat_map(|surface| &surface.rings) {
        for corner in 1..ring.len() - 1 {
            let from_corner =
                |i: usize| -> [f64; 3] { std::array::from_fn(|k| ring[i][k] - CORNER[k]) };
            let [a, b, c] = [0, corner, corner + 1].map(from_corner);
            sum += a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
                + a[2] * (b[0] * c[1] - b[1] * c[0]);
        }
    }
    sum / 6.0
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max)
}

/// The largest distance from a position of the first to the nearest one of the second.
fn largest_distance(from: &[Surface], to: &[Surface]) -> f64 {
    let positions = |surfaces: &[Surface]| -> Vec<[f64; 3]> {
        surfaces
            .iter()
            .flat_map(|s| s.rings.iter().flatten().copied())
            .collect()
    };
    let to = positions(to);
    let nearest = |a: [f64; 3]| {
        to.iter()
            .map(|b| distance(a, *b))
            .fold(f64::INFINITY, f64::min)
    };
    positions(from).into_iter().map(nearest).fold(0.0, f64::max)
}

#[test]
fn features_come_back_with_names_classes_attributes_and_materials() {
    let names = ["NL.IMBAG.Pand.0503100000012869-0", "USE", "a {b} \"c\" \\"];
    let models: Vec<_> = (0..3_u8)
        .map(|i| {
            let corner = [CORNER[0] + 5_000.0 * f64::from(i), CORNER[1], CORNER[2]];
            let shape = shape(block_with_passage(corner));
            model(
                i.into(),
                names[usize::from(i)],
                vec![geometry(&shape, None)],
            )
        })
        .collect();
    let scene = read(&write_vrml(&models, Some(28992)));
    assert_eq!((scene.srid, scene.features.len()), (Some(28992), 3));
    for (read, model) in scene.features.iter().zip(&models) {
        let wrote = &model.feature;
        assert_eq!((&read.name, &read.class), (&wrote.name, &wrote.class));
        assert_eq!(read.attributes, wrote.attributes);
        assert_eq!(read.geometries[0].level_of_detail, 2.2);
        let shape = &read.geometries[0].shape;
        let of_all: Vec<_> = shape
            .surfaces
            .iter()
            .map(|s| s.material.map(|m| &shape.materials[m as usize]))
            .collect();
        assert_eq!(of_all.iter().filter(|m| m.is_none()).count(), 1);
        assert_eq!(
            of_all
                .iter()
                .filter(|m| **m == Some(&materials()[0]))
                .count(),
            8
        );
        assert_eq!(
            of_all
                .iter()
                .filter(|m| **m == Some(&materials()[1]))
                .count(),
            1
        );
        let (before, after) = (surfaces(wrote), surfaces(read));
        assert!(largest_distance(&before, &after) < ALLOWED);
        assert!(largest_distance(&after, &before) < ALLOWED);
        assert_eq!((open_edges(&before), open_edges(&after)), (0, 0));
        assert!((volume(&before) - volume(&after)).abs() < 0.01);
    }
}

#[test]
fn single_precision_is_enough_for_readers() {
    let far = [CORNER[0] + 20_000.0, CORNER[1] - 30_000.0, CORNER[2]];
    let models = [CORNER, far].map(|corner| {
        let shape = shape(block_with_passage(corner));
        model(1, "a", vec![geometry(&shape, None)])
    });
    let text = write_vrml(&models, None);
    let rounded: String = text
        .split_inclusive([' ', '\n'])
        .map(|token| {
            let number = token.trim_end();
            match number.parse::<f32>() {
                Ok(single) if number.contains('.') => format!("{} ", f64::from(single)),
                _ => token.to_owned(),
            }
        })
        .collect();
    assert_ne!(rounded, text);
    for (read, model) in read(&rounded).features.iter().zip(&models) {
        assert!(largest_distance(&surfaces(read), &surfaces(&model.feature)) < ALLOWED);
    }
}

#[test]
fn shared_shapes_are_written_once() {
    let tree = shape(block_with_passage([0.5, 0.25, 0.0]));
    let turn = Placement {
        rows: [
            [0.0, -2.0, 0.0, CORNER[0]],
            [2.0, 0.0, 0.0, CORNER[1]],
            [0.0, 0.0, 3.0, CORNER[2]],
        ],
    };
    let mut sheared = turn;
    sheared.rows[0][0] = 0.5;
    let moved = Placement::moved_by([CORNER[0] + 9.0, CORNER[1], 4.0]);
    let placements = [turn, moved, sheared];
    let own = shape(block_with_passage(CORNER));
    let mut models: Vec<_> = placements
        .iter()
        .map(|placement| model(1, "tree", vec![geometry(&tree, Some(*placement))]))
        .collect();
    models[1].feature.geometries.push(geometry(&own, None));
    let text = write_vrml(&models, None);
    assert_eq!(text.matches("USE shape:1 ").count(), 1);
    let scene = read(&text);
    let names: Vec<_> = scene.features.iter().map(|f| f.name.as_str()).collect();
    assert_eq!(names, ["tree", "tree-2", "tree-3"]);
    for (read, model) in scene.features.iter().zip(&models) {
        let (before, after) = (surfaces(&model.feature), surfaces(read));
        assert!(largest_distance(&after, &before) < ALLOWED);
        assert_eq!(after.len(), before.len());
    }
    let shape_of = |i: usize| scene.features[i].geometries.last().map(|g| &g.shape);
    let (first, second) = (shape_of(0).expect("one"), shape_of(1).expect("one"));
    assert!(Arc::ptr_eq(first, second));
}

#[test]
fn nothing_is_a_file_too() {
    assert_eq!(read(&write_vrml(&[], None)), SceneDescription::default());
    let flat = vec![
        surface(&[&[CORNER, CORNER, CORNER]], None),
        surface(&[], None),
    ];
    let models = [model(1, "", vec![geometry(&shape(flat), None)])];
    assert!(read(&write_vrml(&models, None)).features.is_empty());
}

/// The best level of detail of a feature.
fn best_level(id: usize, mut feature: Feature) -> Model {
    let levels = feature.geometries.iter().map(|g| g.level_of_detail);
    let best = levels.fold(0.0, f64::max);
    feature.geometries.retain(|g| g.level_of_detail == best);
    let id = id.try_into().expect("a small number");
    Model { id, feature }
}

#[test]
fn delft_comes_back() {
    let bytes = real_file("delft.city.jsonl").unwrap_or_else(|| sequence_of_buildings(100));
    let scene = read_bytes("delft", &bytes, &ReadOptions::default()).expect("a real city");
    let features = scene.features.into_iter().enumerate();
    let models: Vec<_> = features
        .map(|(id, feature)| best_level(id, feature))
        .collect();
    let back = read(&write_vrml(&models, scene.srid));
    assert_eq!((back.srid, back.features.len()), (scene.srid, models.len()));
    for (read, model) in back.features.iter().zip(&models) {
        let wrote = &model.feature;
        assert_eq!((&read.name, &read.class), (&wrote.name, &wrote.class));
        assert_eq!(read.attributes, wrote.attributes);
        let (before, after) = (surfaces(wrote), surfaces(read));
        assert!(open_edges(&after) <= open_edges(&before), "{}", read.name);
        assert_eq!(after.len(), before.len());
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn names_and_attributes_come_back_whatever_they_are(name in "\\PC{1,20}", text in any::<String>()) {
        let shape = shape(block_with_passage(CORNER));
        let mut one = model(1, &name, vec![geometry(&shape, None)]);
        one.feature.attributes = json!({ "text": text });
        let scene = read(&write_vrml(&[one.clone()], None));
        prop_assert_eq!(&scene.features[0].name, &name);
        prop_assert_eq!(&scene.features[0].attributes, &one.feature.attributes);
    }

    #[test]
    fn shared_shapes_stand_where_they_stood(
        axis in [-1.0..1.0, -1.0..1.0, 0.1..1.0_f64], angle in -4.0..4.0_f64, scale in [0.1..3.0, 0.1..3.0, 0.1..3.0_f64],
    ) {
        let length = axis.iter().map(|c| c * c).sum::<f64>().sqrt();
        let [x, y, z] = axis.map(|c| c / length);
        let (sin, cos) = f64::sin_cos(angle);
        let rest = 1.0 - cos;
        let rotation = [
            [cos + x * x * rest, x * y * rest - z * sin, x * z * rest + y * sin],
            [x * y * rest + z * sin, cos + y * y * rest, y * z * rest - x * sin],
            [x * z * rest - y * sin, y * z * rest + x * sin, cos + z * z * rest],
        ];
        let rows = [0, 1, 2].map(|i| {
            let [a, b, c] = [0, 1, 2].map(|j| rotation[i][j] * scale[j]);
            [a, b, c, CORNER[i]]
        });
        let shape = shape(block_with_passage([0.0; 3]));
        let geometries = vec![geometry(&shape, Some(Placement { rows })), geometry(&shape, None)];
        let one = model(1, "a", geometries);
        let scene = read(&write_vrml(std::slice::from_ref(&one), None));
        prop_assert_eq!(scene.features[0].geometries.len(), 2);
        let (before, after) = (surfaces(&one.feature), surfaces(&scene.features[0]));
        prop_assert!(largest_distance(&after, &before) < ALLOWED);
    }
}
