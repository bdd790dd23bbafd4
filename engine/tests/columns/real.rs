//! Real buildings.

use std::path::PathBuf;

use engine::{Closedness, ColumnOptions, TriangleMesh, solid_columns};
use glam::{DMat3, DVec3};

use crate::solids::*;

/// The best level of detail of each feature of a file of the folder of real cities; of houses made
/// here where there is none.
fn real_meshes(name: &str) -> Vec<TriangleMesh> {
    let beside_workspace = || PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../shared/data");
    let folder = std::env::var_os("PG_OCCLUSION_DATA").map_or_else(beside_workspace, PathBuf::from);
    let Ok(bytes) = std::fs::read(folder.join(name)) else {
        let houses =
            (0..60).map(|i| gabled(6.0 + f64::from(i % 7), 8.0, 5.0, 7.0 + f64::from(i % 3)));
        let turned = houses.enumerate().map(|(i, house)| {
            let turn = DMat3::from_rotation_z(i as f64 * 0.1);
            mesh(&moved(house, |p| delivered(turn * p + FAR)))
        });
        return turned.collect();
    };
    let scene = formats::read_bytes(name, &bytes, &formats::ReadOptions::default());
    let features = scene.expect("a city").features;
    let best = |feature: &formats::Feature| {
        let levels = || feature.geometries.iter().map(|g| g.level_of_detail);
        let highest = levels().fold(0.0, f64::max);
        let best = feature
            .geometries
            .iter()
            .filter(|g| g.level_of_detail == highest);
        let surfaces: Vec<_> = best.flat_map(|g| g.surfaces().into_owned()).collect();
        let ring = |ring: &Vec<[f64; 3]>| ring.iter().map(|&p| DVec3::from_array(p)).collect();
        let polygons = surfaces
            .iter()
            .map(|s| s.rings.iter().map(ring).collect::<Vec<Vec<DVec3>>>());
        TriangleMesh::from_polygons(polygons)
    };
    features.iter().map(best).collect()
}

#[test]
fn delft_is_nearly_filled_by_few_columns() {
    let (mut volume, mut covered, mut counts) = (0.0, 0.0, Vec::new());
    // Every twentieth, for the time that debug builds take.
    for mesh in real_meshes("delft.city.jsonl").iter().step_by(20) {
        let Ok(found) = solid_columns(mesh, &ColumnOptions::default()) else {
            assert!(mesh.closedness() != Closedness::Closed);
            continue;
        };
        for column in &found.columns {
            assert_eq!(outside(column, mesh), None, "{column:?}");
        }
        volume += found.volume;
        covered += found.volume * found.share;
        counts.push(found.columns.len());
    }
    counts.sort_unstable();
    assert!(covered > 0.95 * volume, "{covered} of {volume}");
    assert!(counts[counts.len() / 2] <= 8, "{counts:?}");
}
