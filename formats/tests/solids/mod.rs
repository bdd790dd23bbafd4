//! What tests ask of solids.
// Each test binary uses its own part of this module.
#![allow(dead_code)]

use std::collections::HashMap;

use formats::{Feature, Surface};

/// Panics unless each edge of each geometry is met from the other side as often.
pub fn assert_closed(feature: &Feature) {
    assert!(!feature.geometries.is_empty(), "{}", feature.name);
    for geometry in &feature.geometries {
        let mut edges: HashMap<[[u64; 3]; 2], i32> = HashMap::new();
        for ring in geometry
            .shape
            .surfaces
            .iter()
            .flat_map(|surface| &surface.rings)
        {
            assert!(ring.len() >= 3, "{}", feature.name);
            for (a, b) in ring.iter().zip(ring.iter().cycle().skip(1)) {
                assert_ne!(a, b, "{}", feature.name);
                let (a, b) = (a.map(f64::to_bits), b.map(f64::to_bits));
                *edges.entry([a.min(b), a.max(b)]).or_default() += if a < b { 1 } else { -1 };
            }
        }
        assert!(
            edges.values().all(|count| *count == 0),
            "{} is open",
            feature.name
        );
    }
    assert!(volume(feature) > 0.0, "{} is inside out", feature.name);
}

/// Lowest and highest coordinate along an axis.
pub fn extent(feature: &Feature, axis: usize) -> [f64; 2] {
    let surfaces = feature
        .geometries
        .iter()
        .flat_map(|geometry| &geometry.shape.surfaces);
    let positions = surfaces.flat_map(|surface| &surface.rings).flatten();
    positions
        .map(|p| p[axis])
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
            [low.min(value), high.max(value)]
        })
}

/// Volume of all geometries together, m³.
pub fn volume(feature: &Feature) -> f64 {
    let surfaces = || {
        feature
            .geometries
            .iter()
            .flat_map(|geometry| &geometry.shape.surfaces)
    };
    let Some(origin) = surfaces().find_map(|surface| surface.rings.first()?.first()) else {
        return 0.0;
    };
    surfaces()
        .flat_map(|surface| &surface.rings)
        .map(|ring| cone(ring, *origin))
        .sum()
}

/// Area of horizontal surfaces, m².
pub fn area(surfaces: &[Surface]) -> f64 {
    let ring = |ring: &Vec<[f64; 3]>| {
        let [x, y, z] = ring[0];
        3.0 * cone(ring, [x, y, z - 1.0])
    };
    surfaces
        .iter()
        .flat_map(|surface| &surface.rings)
        .map(ring)
        .sum()
}

/// Signed volume between a ring and a point.
fn cone(ring: &[[f64; 3]], origin: [f64; 3]) -> f64 {
    let local = |p: &[f64; 3]| [p[0] - origin[0], p[1] - origin[1], p[2] - origin[2]];
    let triangles = ring
        .windows(2)
        .skip(1)
        .map(|pair| [&ring[0], &pair[0], &pair[1]].map(local));
    let product = |[a, b, c]: [[f64; 3]; 3]| {
        a[0] * (b[1] * c[2] - b[2] * c[1])
            + a[1] * (b[2] * c[0] - b[0] * c[2])
            + a[2] * (b[0] * c[1] - b[1] * c[0])
    };
    triangles.map(product).sum::<f64>() / 6.0
}
