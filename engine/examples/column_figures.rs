//! Figures of the solid columns of the highest level of detail of a city.
//!
//!     cargo run --release -p engine --example column_figures -- FILE [SHARE [MOST [LEAST_GAIN]]]

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use engine::{ColumnOptions, TriangleMesh, solid_columns};
use formats::{Feature, ReadOptions, read_bytes};
use glam::DVec3;

fn mesh(feature: &Feature) -> TriangleMesh {
    let highest = feature
        .geometries
        .iter()
        .map(|g| g.level_of_detail)
        .fold(0.0, f64::max);
    let best = feature
        .geometries
        .iter()
        .filter(|g| g.level_of_detail == highest);
    let surfaces: Vec<_> = best
        .flat_map(|geometry| geometry.surfaces().into_owned())
        .collect();
    let ring = |ring: &Vec<[f64; 3]>| ring.iter().map(|&p| DVec3::from_array(p)).collect();
    TriangleMesh::from_polygons(
        surfaces
            .iter()
            .map(|s| s.rings.iter().map(ring).collect::<Vec<Vec<DVec3>>>()),
    )
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let file = arguments.get(1).expect("the name of a file");
    let number = |i: usize, otherwise: f64| {
        arguments
            .get(i)
            .map_or(otherwise, |a| a.parse().expect("a number"))
    };
    let default = ColumnOptions::default();
    let options = ColumnOptions {
        share: number(2, default.share),
        most: number(3, default.most as f64) as usize,
        least_gain: number(4, default.least_gain),
    };
    let bytes = std::fs::read(file).expect("a file");
    let scene = read_bytes(file, &bytes, &ReadOptions::default()).expect("a city");
    let meshes: Vec<TriangleMesh> = scene.features.iter().map(mesh).collect();

    let (mut volume, mut covered, mut taken) = (0.0, 0.0, Duration::ZERO);
    let (mut counts, mut grounded, mut corners) = (Vec::new(), 0, 0);
    let mut worst = Vec::new();
    let mut refused: BTreeMap<String, usize> = BTreeMap::new();
    for (mesh, feature) in meshes.iter().zip(&scene.features) {
        let start = Instant::now();
        let found = solid_columns(mesh, &options);
        let time = start.elapsed();
        taken += time;
        match found {
            Ok(found) => {
                volume += found.volume;
                covered += found.volume * found.share;
                counts.push(found.columns.len());
                grounded += found
                    .columns
                    .iter()
                    .filter(|column| column.grounded)
                    .count();
                let rings = |c: &engine::SolidColumn| {
                    let holes: usize = c.footprint.interiors().iter().map(|r| r.0.len() - 1).sum();
                    c.footprint.exterior().0.len() - 1 + holes
                };
                corners += found.columns.iter().map(rings).sum::<usize>();
                let lost = found.volume * (1.0 - found.share);
                worst.push((lost, found.share, found.columns.len(), time, &feature.name));
            }
            Err(defect) => *refused.entry(defect.to_string()).or_default() += 1,
        }
    }
    counts.sort_unstable();
    let total: usize = counts.iter().sum();
    println!("features {}, with columns {}", meshes.len(), counts.len());
    println!(
        "share of volume {:.4}",
        if volume > 0.0 { covered / volume } else { 0.0 }
    );
    let (median, most) = (counts.get(counts.len() / 2), counts.last());
    println!(
        "columns: median {}, most {}",
        median.unwrap_or(&0),
        most.unwrap_or(&0)
    );
    println!("columns in all {total}, grounded {grounded}, corners {corners}");
    println!(
        "ms a feature {:.3}",
        taken.as_secs_f64() * 1e3 / meshes.len() as f64
    );
    println!("refused {refused:#?}");
    worst.sort_by(|a, b| b.0.total_cmp(&a.0));
    for (lost, share, count, time, name) in worst.iter().take(8) {
        println!("{name}: {lost:.0} m3 outside, share {share:.3}, {count} columns, {time:?}");
    }
    worst.sort_by_key(|w| std::cmp::Reverse(w.3));
    for (lost, share, count, time, name) in worst.iter().take(4) {
        println!("{name}: {lost:.0} m3 outside, share {share:.3}, {count} columns, {time:?}");
    }
}
