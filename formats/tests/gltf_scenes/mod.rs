//! Features for the tests of glTF.
// Each test binary uses its own part of this module.
#![allow(dead_code)]

use std::path::PathBuf;
use std::sync::Arc;

use formats::{
    Feature, Geometry, Material, Model, Part, Placement, ReadOptions, Semantic, Shape, Surface,
    read_bytes,
};
use serde_json::json;

/// A corner of the Netherlands, where f32 alone would be 3 cm off.
pub const FAR: [f64; 3] = [85_000.123, 447_000.457, -1.234];

pub fn surface(ring: &[[f64; 3]]) -> Surface {
    Surface {
        rings: vec![ring.to_vec()],
        ..Surface::default()
    }
}

/// The six sides of a box, oriented outwards; the last is the top.
pub fn box_surfaces([x, y, z]: [f64; 3], [dx, dy, dz]: [f64; 3]) -> Vec<Surface> {
    let corner = |i: usize| {
        let side =
            |bit: usize, low: f64, size: f64| if i >> bit & 1 == 1 { low + size } else { low };
        [side(0, x, dx), side(1, y, dy), side(2, z, dz)]
    };
    let sides = [
        [0, 2, 3, 1],
        [0, 1, 5, 4],
        [1, 3, 7, 5],
        [3, 2, 6, 7],
        [2, 0, 4, 6],
        [4, 5, 7, 6],
    ];
    sides.map(|side| surface(&side.map(corner))).to_vec()
}

pub fn shape(surfaces: Vec<Surface>) -> Shape {
    Shape {
        surfaces,
        ..Shape::default()
    }
}

pub fn geometry(shape: Shape) -> Geometry {
    Geometry {
        level_of_detail: 2.2,
        part: None,
        shape: Arc::new(shape),
        placement: None,
    }
}

pub fn model(id: i64, geometries: Vec<Geometry>) -> Model {
    Model {
        id,
        feature: Feature {
            name: format!("NL.IMBAG.Pand.{id:016}"),
            class: "Building".to_owned(),
            attributes: json!({"height": 9.5, "function": "dwelling \"A\"", "year": 1890}),
            parts: Vec::new(),
            geometries,
        },
    }
}

/// A box at a place.
pub fn building(id: i64, at: [f64; 3]) -> Model {
    model(
        id,
        vec![geometry(shape(box_surfaces(at, [10.25, 8.5, 9.125])))],
    )
}

/// Two materials, two meanings, one of each unused by some surfaces.
pub fn painted(id: i64) -> Model {
    let mut painted = shape(box_surfaces(FAR, [4.0, 5.0, 6.0]));
    painted.materials = vec![
        Material {
            name: Some("brick".to_owned()),
            diffuse: [0.7, 0.25, 0.2],
            specular: [0.1, 0.2, 0.3],
            ..Material::default()
        },
        Material {
            name: Some("glass".to_owned()),
            transparency: 0.75,
            emissive: [0.0, 0.1, 0.0],
            metallic: Some(0.25),
            roughness: Some(0.5),
            ..Material::default()
        },
    ];
    painted.semantics = ["WallSurface", "RoofSurface"]
        .map(|class| Semantic {
            class: class.to_owned(),
            attributes: json!({}),
        })
        .to_vec();
    for (i, surface) in painted.surfaces.iter_mut().enumerate() {
        surface.semantic = Some(u32::from(i == 5));
        surface.material = [None, Some(0), Some(1)][i % 3];
    }
    let mut part = geometry(painted);
    part.part = Some("part 1".to_owned());
    let beside = [FAR[0] + 4.0, FAR[1], FAR[2]];
    let mut model = model(
        id,
        vec![part, geometry(shape(box_surfaces(beside, [3.0; 3])))],
    );
    model.feature.parts = vec![Part {
        name: "part 1".to_owned(),
        class: "BuildingPart".to_owned(),
        attributes: json!({"storeys": 2}),
    }];
    model
}

/// A frame: a square with a square hole, both ways round, and walls around both.
pub fn courtyard(id: i64) -> Model {
    let ring = |low: f64, high: f64, z: f64| {
        [
            [low, low, z],
            [high, low, z],
            [high, high, z],
            [low, high, z],
        ]
        .map(|[x, y, z]| [x + FAR[0], y + FAR[1], z + FAR[2]])
        .to_vec()
    };
    let reversed = |mut ring: Vec<[f64; 3]>| {
        ring.reverse();
        ring
    };
    let frame = |rings| Surface {
        rings,
        ..Surface::default()
    };
    let mut surfaces = vec![
        frame(vec![
            ring(0.0, 30.0, 12.0),
            reversed(ring(10.0, 20.0, 12.0)),
        ]),
        frame(vec![reversed(ring(0.0, 30.0, 0.0)), ring(10.0, 20.0, 0.0)]),
    ];
    for i in 0..4 {
        let j = (i + 1) % 4;
        let wall =
            |low: &[[f64; 3]], high: &[[f64; 3]]| surface(&[low[i], low[j], high[j], high[i]]);
        surfaces.push(wall(&ring(0.0, 30.0, 0.0), &ring(0.0, 30.0, 12.0)));
        let (mut low, mut high) = (ring(10.0, 20.0, 0.0), ring(10.0, 20.0, 12.0));
        std::mem::swap(&mut low, &mut high);
        surfaces.push(wall(&low, &high));
    }
    model(id, vec![geometry(shape(surfaces))])
}

/// A turn about the upright axis by a quarter and a bit, a scale, a mirror or a shear, and a move.
pub fn placements() -> Vec<Placement> {
    let rows = |[a, b]: [f64; 2], [c, d]: [f64; 2], height: f64, x: f64| Placement {
        rows: [
            [a, b, 0.0, FAR[0] + x],
            [c, d, 0.0, FAR[1]],
            [0.0, 0.0, height, FAR[2]],
        ],
    };
    vec![
        rows([1.0, 0.0], [0.0, 1.0], 1.0, 0.0),
        rows([0.6, -0.8], [0.8, 0.6], 1.0, 20.0),
        rows([-1.2, -1.6], [1.6, -1.2], 3.0, 40.0),
        rows([-1.0, 0.0], [0.0, 1.0], 1.0, 60.0),
        rows([1.0, 0.5], [0.0, 1.0], 1.0, 80.0),
        rows([1.0, 0.0], [0.0, 1.0], 0.0, 100.0),
    ]
}

/// Features that share one shape, one for each of [`placements`].
pub fn instances() -> Vec<Model> {
    let tree = Arc::new(shape(box_surfaces([-0.5, -0.5, 0.0], [1.0, 1.0, 5.123])));
    let instance = |(i, placement)| {
        let geometry = Geometry {
            level_of_detail: 3.0,
            part: None,
            shape: Arc::clone(&tree),
            placement: Some(placement),
        };
        let mut model = model(i as i64 + 100, vec![geometry]);
        model.feature.class = "SolitaryVegetationObject".to_owned();
        model
    };
    placements().into_iter().enumerate().map(instance).collect()
}

/// A thousand buildings over two kilometres.
pub fn thousand() -> Vec<Model> {
    let place = |i: i64| {
        [
            FAR[0] + (i % 40) as f64 * 50.1,
            FAR[1] + (i / 40) as f64 * 77.7,
            FAR[2],
        ]
    };
    (0..1000).map(|i| building(i, place(i))).collect()
}

/// The buildings of Delft at their highest level of detail, if the file is there; else a thousand
/// boxes.
pub fn delft() -> Vec<Model> {
    let beside_workspace = || PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../shared/data");
    let folder = std::env::var_os("PG_OCCLUSION_DATA").map_or_else(beside_workspace, PathBuf::from);
    let Ok(bytes) = std::fs::read(folder.join("delft.city.jsonl")) else {
        return thousand();
    };
    let scene = read_bytes("delft.city.jsonl", &bytes, &ReadOptions::default()).expect("a city");
    let best = |mut feature: Feature| {
        let levels = feature.geometries.iter().map(|g| g.level_of_detail);
        let best = levels.fold(0.0, f64::max);
        feature.geometries.retain(|g| g.level_of_detail == best);
        feature
    };
    let features = scene.features.into_iter().map(best).zip(1..);
    features
        .map(|(feature, id)| Model { id, feature })
        .collect()
}
