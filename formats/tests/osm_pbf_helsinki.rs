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
