//! The centre of Helsinki, with the counts that are known of it.

use std::collections::BTreeMap;

use formats::{Format, ReadOptions, SceneDescription, Skipped, read_bytes};

fn report(scene: &SceneDescription) {
    let mut why: BTreeMap<(String, String), usize> = BTreeMap::new();
    for Skipped {
        class, why: reason, ..
    } in &scene.skipped
    {
        *why.entry((class.clone(), reason.clone())).or_default() += 1;
    }
    println!("{why:#?}");
    let mut how: BTreeMap<String, usize> = BTreeMap::new();
    for c in &scene.changed {
        *how.entry(c.how.clone()).or_default() += 1;
    }
    println!("{how:#?}");
    let mut classes: BTreeMap<String, usize> = BTreeMap::new();
    for c in &scene.features {
        *classes
            .entry(format!(
                "{} {} {}",
                c.class,
                c.geometries[0].level_of_detail,
                !c.parts.is_empty()
            ))
            .or_default() += 1;
    }
    println!(
        "{classes:#?} streets {} srid {:?}",
        scene.streets.len(),
        scene.srid
    );
}

#[test]
fn helsinki() {
    let bytes = std::fs::read("/work/shared/data/helsinki.osm.pbf").unwrap();
    assert_eq!(Format::recognise(&bytes), Some(Format::OsmPbf));
    let start = std::time::Instant::now();
    let scene = read_bytes("h", &bytes, &ReadOptions::default()).unwrap();
    println!("{:?}", start.elapsed());
    report(&scene);
}

#[test]
fn details() {
    let bytes = std::fs::read("/work/shared/data/helsinki.osm.pbf").unwrap();
    let scene = read_bytes("h", &bytes, &ReadOptions::default()).unwrap();
    for s in &scene.skipped {
        if s.why.starts_with("the top") || s.why.contains("crosses") || s.why.contains("no area") {
            println!("{s:?}");
        }
    }
    for c in &scene.changed {
        println!("{c:?}");
    }
    for f in &scene.features {
        let shapes: Vec<_> = f
            .attributes
            .as_object()
            .unwrap()
            .iter()
            .filter(|(k, _)| {
                k.starts_with("roof") || k.as_str() == "height" || k.contains("levels")
            })
            .collect();
        if f.geometries[0].level_of_detail == 2.0 {
            println!("{} {shapes:?}", f.name);
            for p in &f.parts {
                println!("   {} {}", p.name, p.attributes);
            }
        }
    }
}
