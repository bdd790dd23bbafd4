//! Every format in, and every format out and in again.

use std::env;
use std::path::{Path, PathBuf};

use end_to_end::{City, TestScene, occlusion};
use tempfile::tempdir;

/// The real cities, where they are at hand, or a made one.
fn cities(folder: &Path) -> Vec<PathBuf> {
    let data = env::var("PG_OCCLUSION_DATA");
    let data =
        data.unwrap_or_else(|_| format!("{}/../../../shared/data", env!("CARGO_MANIFEST_DIR")));
    let is_city = |path: &PathBuf| path.extension().is_some_and(|end| end != "md");
    let mut cities: Vec<PathBuf> = std::fs::read_dir(data)
        .map(|entries| {
            entries
                .flatten()
                .map(|entry| entry.path())
                .filter(is_city)
                .collect()
        })
        .unwrap_or_default();
    cities.sort();
    cities.push(City::blocks().write(folder));
    cities
}

/// Imports a file into a scene of its own.
#[track_caller]
fn imported(test: &str, file: &Path) -> TestScene {
    let scene = TestScene::new(test);
    occlusion(&["import", file.to_str().unwrap(), "--scene", &scene.name]).expect(0);
    scene
}

#[test]
fn every_city_arrives_with_nothing_wrong_in_what_is_stored() {
    let folder = tempdir().unwrap();
    for city in cities(folder.path()) {
        let mut scene = imported("city", &city);
        let solid = scene.number("SELECT count(*) FROM {s}.mesh WHERE defect IS NULL");
        let columns = scene.number("SELECT count(DISTINCT feature) FROM {s}.solid_column");
        let told = scene.number(&format!(
            "SELECT coalesce(sum(objects)::bigint, 0) FROM occlusion.import_report('{}') \
             WHERE outcome IN ('solid', 'repaired')",
            scene.name
        ));
        assert!(
            solid == told && columns <= solid,
            "{}: {solid} {columns} {told}",
            city.display()
        );
        let observers = if scene.number("SELECT count(*) FROM {s}.street") > 0 {
            "4"
        } else {
            "0"
        };
        let name = scene.name.clone();
        let run = occlusion(&[
            "verify",
            &name,
            "--observers",
            observers,
            "--range",
            "300",
            "--resolution",
            "256",
            "--rays",
            "4",
        ]);
        let run = run.expect(0);
        assert!(
            run.stdout.contains("0 false occlusions"),
            "{}: {}",
            city.display(),
            run.stdout
        );
    }
}

#[test]
fn what_is_written_comes_back() {
    let folder = tempdir().unwrap();
    for city in cities(folder.path()) {
        let mut scene = imported("out", &city);
        let features = scene.number("SELECT count(*) FROM {s}.feature");
        let solid = scene.number("SELECT count(*) FROM {s}.mesh WHERE defect IS NULL");
        for file in ["town.glb", "town.wrl", "town.city.json", "town.city.jsonl"] {
            let path = folder.path().join(file);
            let path = path.to_str().unwrap();
            let name = scene.name.clone();
            occlusion(&["export", &name, "--all", "-o", path]).expect(0);
            let mut again = imported("back", Path::new(path));
            let place = format!("{} as {file}", city.display());
            assert_eq!(
                again.number("SELECT count(*) FROM {s}.feature"),
                features,
                "{place}"
            );
            assert_eq!(
                again.number("SELECT count(*) FROM {s}.mesh WHERE defect IS NULL"),
                solid,
                "{place}"
            );
            let both = format!(
                "SELECT count(*) FROM {{s}}.feature AS a JOIN \"{name}\".feature AS b USING (name) \
                 WHERE occlusion.expand(b.envelope, 0.001) OPERATOR(occlusion.@>) a.envelope"
            );
            assert_eq!(again.number(&both), features, "{place}");
        }
    }
}

#[test]
fn an_observer_gets_what_can_be_seen() {
    let folder = tempdir().unwrap();
    let mut scene = imported("seen", &City::blocks().write(folder.path()));
    let name = scene.name.clone();
    occlusion(&["generate", &name]).expect(0);
    let path = folder.path().join("visible.glb");
    let path = path.to_str().unwrap();
    let observer = ["--observer", "85026,447026,1.75", "--range", "300"];
    let run = occlusion(&[&["export", &name, "-o", path][..], &observer].concat()).expect(0);
    let seen = scene.number(&format!(
        "SELECT count(*) FROM occlusion.visible_features('{name}', \
         occlusion.point3d(85026, 447026, 1.75), 300)"
    ));
    assert!(
        run.stdout.contains(&format!("wrote {seen} features")),
        "{}",
        run.stdout
    );
    let mut again = imported("seen again", Path::new(path));
    assert_eq!(again.number("SELECT count(*) FROM {s}.feature"), seen);
}

#[test]
fn exports_that_make_no_sense_are_refused() {
    let folder = tempdir().unwrap();
    let scene = imported("no sense", &City::blocks().write(folder.path()));
    let name = scene.name.as_str();
    let run = occlusion(&["export", name, "--all", "-o", "town.dwg"]).expect(2);
    assert!(
        run.stderr.contains("\"town.dwg\" does not tell a format"),
        "{}",
        run.stderr
    );
    occlusion(&["export", name, "-o", "town.glb"]).expect(2);
    let run = occlusion(&["export", name, "--all", "-o", "no/such/folder/town.glb"]).expect(4);
    assert!(run.stderr.contains("cannot write"), "{}", run.stderr);
    let run = occlusion(&["export", "no such scene", "--all", "-o", "town.glb"]).expect(3);
    assert!(run.stderr.contains("does not exist"), "{}", run.stderr);
}
