//! Packed models: exact to the last bit, small, and safe to read whatever they hold.

mod common;

use std::sync::Arc;

use common::{read_all, real_file, sequence_of_buildings};
use formats::{
    Geometry, Material, Part, Placement, Semantic, Shape, Surface, pack, pack_shape, unpack,
    unpack_shape,
};
use proptest::prelude::*;
use serde_json::json;

/// Any bits at all, and coordinates as they are in the Netherlands.
fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        any::<u64>().prop_map(f64::from_bits),
        (-200_000i32..200_000).prop_map(|step| f64::from(step) * 0.001 + 447_000.25),
        Just(-0.0),
    ]
}

fn surface() -> impl Strategy<Value = Surface> {
    let ring = prop::collection::vec([coordinate(), coordinate(), coordinate()], 0..6);
    let rings = prop::collection::vec(ring, 0..3);
    let value = || prop::option::of(0u32..2);
    (rings, value(), value()).prop_map(|(rings, material, semantic)| Surface {
        rings,
        material,
        semantic,
    })
}

fn shape() -> impl Strategy<Value = Shape> {
    let semantic = |(class, slope): (String, f64)| Semantic {
        class,
        attributes: json!({ "slope": slope, "é": [null, 1e300, u64::MAX] }),
    };
    let surfaces = prop::collection::vec(surface(), 0..8);
    let semantics = prop::collection::vec((".*", -90.0..90.0).prop_map(semantic), 2..4);
    (surfaces, semantics, any::<u64>()).prop_map(|(surfaces, semantics, bits)| {
        let odd = Material {
            name: Some("odd".to_owned()),
            metallic: Some(f64::from_bits(bits)),
            ..Material::default()
        };
        Shape {
            surfaces,
            materials: vec![Material::default(), odd],
            semantics,
        }
    })
}

/// Every bit of a shape, not-a-numbers included.
fn bits(shape: &Shape) -> String {
    let rings = |surface: &Surface| {
        let bits = |ring: &Vec<[f64; 3]>| ring.iter().map(|p| p.map(f64::to_bits)).collect();
        let rings: Vec<Vec<[u64; 3]>> = surface.rings.iter().map(bits).collect();
        (rings, surface.material, surface.semantic)
    };
    let surfaces: Vec<_> = shape.surfaces.iter().map(rings).collect();
    let materials: Vec<_> = shape
        .materials
        .iter()
        .map(|m| (&m.name, m.metallic.map(f64::to_bits)))
        .collect();
    format!("{surfaces:?} {materials:?} {:?}", shape.semantics)
}

fn model(shape: Shape) -> (Vec<Geometry>, Vec<Part>) {
    let shape = Arc::new(shape);
    let geometry = |part: Option<&str>, placement| Geometry {
        level_of_detail: 2.2,
        part: part.map(str::to_owned),
        shape: Arc::clone(&shape),
        placement,
    };
    let moved = Placement::moved_by([85_000.125, -0.0, 1e-300]);
    let part = Part {
        name: "part \"é\"".to_owned(),
        class: "BuildingPart".to_owned(),
        attributes: json!({"z": 1, "a": {"b": -0.0}}),
    };
    let geometries = vec![
        geometry(None, None),
        geometry(Some("part \"é\""), Some(moved)),
    ];
    (geometries, vec![part])
}

fn small_shape() -> Shape {
    let triangle = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.5]];
    Shape {
        surfaces: vec![Surface {
            rings: vec![triangle],
            material: Some(0),
            semantic: Some(0),
        }],
        materials: vec![Material::default()],
        semantics: vec![Semantic {
            class: "RoofSurface".to_owned(),
            attributes: json!({}),
        }],
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..Default::default() })]

    #[test]
    fn shapes_come_back_bit_for_bit(shape in shape()) {
        let packed = pack_shape(&shape).unwrap();
        let again = unpack_shape(&packed.content).unwrap();
        prop_assert_eq!(bits(&again), bits(&shape));
        prop_assert_eq!(&pack_shape(&again).unwrap(), &packed);
        let (geometries, parts) = model(shape);
        let (same_parts, same) = unpack(&pack(&geometries, &parts).unwrap()).unwrap();
        prop_assert_eq!(same_parts, parts);
        prop_assert!(Arc::ptr_eq(&same[0].shape, &same[1].shape), "the shape is still shared");
        prop_assert_eq!(bits(&same[0].shape), bits(&geometries[0].shape));
        for (same, geometry) in same.iter().zip(&geometries) {
            prop_assert_eq!(&same.part, &geometry.part);
            prop_assert_eq!(same.placement, geometry.placement);
            prop_assert_eq!(same.level_of_detail, geometry.level_of_detail);
        }
    }

    #[test]
    fn hostile_content_is_refused_or_read(
        at in any::<prop::sample::Index>(),
        bits in 1u8..,
        noise in prop::collection::vec(any::<u8>(), 0..40),
    ) {
        let (geometries, parts) = model(small_shape());
        let mut content = pack(&geometries, &parts).unwrap();
        let at = at.index(content.len());
        content[at] ^= bits;
        let _ = unpack(&content);
        let _ = unpack_shape(&content);
        content.truncate(at.max(1));
        content[0] = 1;
        content.extend(noise);
        let _ = unpack(&content);
    }
}

#[test]
fn truncated_content_is_malformed() {
    let (geometries, parts) = model(small_shape());
    let content = pack(&geometries, &parts).unwrap();
    for end in 0..content.len() {
        let message = unpack(&content[..end]).unwrap_err().to_string();
        assert!(
            message.starts_with("packed model is malformed: "),
            "{message}"
        );
    }
    let longer = [content.as_slice(), b"x"].concat();
    assert!(unpack(&longer).is_err());
    let other_version = [&[2], &content[1..]].concat();
    assert_eq!(
        unpack(&other_version).unwrap_err().to_string(),
        "version of a packed model is 2, expected 1"
    );
    let declared_huge = [1, 0x28, 0xb5, 0x2f, 0xfd, 0xe0, 0, 0, 0, 0, 0, 1, 0, 0];
    let message = unpack(&declared_huge).unwrap_err().to_string();
    let expected = "1099511627776 bytes of a packed model exceed the limit of 33554432";
    assert_eq!(message, expected);
}

#[test]
fn digests_tell_shapes_apart() {
    let shape = small_shape();
    let digest = |shape: &Shape| pack_shape(shape).unwrap().digest;
    assert_eq!(digest(&shape), digest(&shape.clone()));
    let mut changed = vec![shape.clone(); 4];
    changed[0].surfaces[0].rings[0][2][2] = 0.5f64.next_up();
    changed[1].materials[0].transparency = 0.25;
    changed[2].semantics[0].attributes = json!({"slope": 30});
    changed[3].surfaces[0].semantic = None;
    for other in &changed {
        assert_ne!(digest(other), digest(&shape));
    }
    let stored = [
        157, 208, 137, 167, 245, 139, 27, 252, 162, 48, 252, 180, 177, 33, 21, 249,
    ];
    assert_eq!(
        digest(&shape),
        stored,
        "rows that are stored already must be found"
    );
}

#[test]
fn real_buildings_come_back_and_are_small() {
    let bytes = real_file("delft.city.jsonl").unwrap_or_else(|| sequence_of_buildings(100));
    let scene = read_all("delft", &bytes).unwrap();
    let mut packed_bytes = 0;
    for feature in &scene.features {
        let content = pack(&feature.geometries, &feature.parts).unwrap();
        packed_bytes += content.len();
        let (parts, geometries) = unpack(&content).unwrap();
        assert_eq!((&parts, &geometries), (&feature.parts, &feature.geometries));
    }
    assert!(
        packed_bytes * 5 < bytes.len(),
        "{packed_bytes} of {}",
        bytes.len()
    );
}
