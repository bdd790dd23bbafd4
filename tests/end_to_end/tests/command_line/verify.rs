//! Honest scenes pass, and every planted fault is found.

use std::path::PathBuf;

use end_to_end::{City, Run, TestScene, occlusion, real_file, shell};
use tempfile::tempdir;

/// A corner moved up, to where an eye looks over everything.
const RAISED: &str = "occlusion.point3d(occlusion.x(p), occlusion.y(p), occlusion.z(p) + 100)";

fn verify(scene: &TestScene, observers: &str) -> Run {
    occlusion(&[
        "verify",
        &scene.name,
        "--observers",
        observers,
        "--resolution",
        "256",
        "--range",
        "500",
        "--json",
    ])
}

/// A scene of 25 blocks with volumes.
fn blocks(test: &str) -> TestScene {
    let folder = tempdir().unwrap();
    imported(test, &City::blocks().write(folder.path()))
}

fn imported(test: &str, file: &std::path::Path) -> TestScene {
    let scene = TestScene::new(test);
    occlusion(&["import", file.to_str().unwrap(), "--scene", &scene.name]).expect(0);
    occlusion(&["generate", &scene.name]).expect(0);
    scene
}

#[test]
fn blocks_pass() {
    let scene = blocks("honest blocks");
    let report = verify(&scene, "10").expect(0).json();
    assert_eq!(report["false_occlusions"], 0, "{report:#}");
    assert_eq!(report["observers"], 10, "{report:#}");
    assert!(
        report["share_of_hidden_by_one"].as_f64().unwrap() > 0.9,
        "{report:#}"
    );
    assert!(
        report["checked"]["occlusion_volumes"].as_u64().unwrap() > 100,
        "{report:#}"
    );
    assert!(
        report["visible"].as_u64() <= report["returned"].as_u64(),
        "{report:#}"
    );
}

#[test]
fn real_cities_pass() {
    let folder = tempdir().unwrap();
    let made = || -> PathBuf { City::blocks().write(folder.path()) };
    for name in ["delft_lod1_with_roads.json", "rotterdam_subset.json"] {
        let file = real_file(name).unwrap_or_else(made);
        let scene = imported(&name[..5], &file);
        let report = verify(&scene, "6").expect(0).json();
        assert_eq!(report["false_occlusions"], 0, "{report:#}");
        assert!(report["visible"].as_u64().unwrap() > 0, "{report:#}");
    }
}

#[test]
fn the_city_of_2004_passes() {
    let mut scene = TestScene::new("scattered");
    let name = scene.name.clone();
    scene.run(&format!(
        "SELECT occlusion.generate_city('{name}', 'scattered', 326, 1)"
    ));
    occlusion(&["generate", &name]).expect(0);
    let report = verify(&scene, "10").expect(0).json();
    assert_eq!(report["false_occlusions"], 0, "{report:#}");
    assert!(
        report["share_of_hidden_by_one"].as_f64().unwrap() > 0.9,
        "{report:#}"
    );
}

#[test]
fn generated_cities_pass() {
    for layout in ["blocks", "streets"] {
        let mut scene = TestScene::new(layout);
        let name = scene.name.clone();
        scene.run(&format!(
            "SELECT occlusion.generate_city('{name}', '{layout}', 150, 7)"
        ));
        occlusion(&["generate", &name, "--smallest", "4"]).expect(0);
        let report = verify(&scene, "20").expect(0).json();
        assert_eq!(report["false_occlusions"], 0, "{layout}: {report:#}");
        let share = report["share_of_hidden_by_one"].as_f64().unwrap();
        assert!(share > 0.5, "{layout}: {report:#}");
    }
}

#[test]
fn a_column_grown_by_a_centimetre_is_found() {
    for change in [
        "top = top + 0.01",
        "bottom = bottom - 0.02",
        "footprint = ARRAY[polygon(path(footprint[1]) + point(0.01, 0))]",
    ] {
        let mut scene = blocks("grown column");
        scene.run(&format!(
            "UPDATE {{s}}.solid_column SET {change} \
             WHERE feature = (SELECT id FROM {{s}}.feature WHERE name = 'block 1 2')"
        ));
        let report = verify(&scene, "0").expect(1).json();
        let fault = report["faults"][0]["fault"].as_str().unwrap();
        assert!(
            fault.contains("\"block 1 2\"") && fault.contains("solid column 1"),
            "{change}: {fault}"
        );
    }
}

#[test]
fn a_moved_volume_is_found() {
    let mut scene = blocks("moved volume");
    scene.run(&format!(
        "UPDATE {{s}}.occlusion_volume SET box = occlusion.box3d(
             (SELECT {RAISED} FROM occlusion.lower(box) AS p),
             (SELECT {RAISED} FROM occlusion.upper(box) AS p))
         WHERE ctid = (SELECT min(ctid) FROM {{s}}.occlusion_volume)"
    ));
    let run = verify(&scene, "0").expect(1);
    let report = run.json();
    assert_eq!(report["stored_faults"], 1, "{report:#}");
    let fault = report["faults"][0]["fault"].as_str().unwrap();
    assert!(
        fault.starts_with("volume of Building ") && fault.contains("misses"),
        "{fault}"
    );
}

#[test]
fn a_volume_of_the_whole_street_is_seen_through() {
    let mut scene = blocks("wide volume");
    scene.run(
        "INSERT INTO {s}.occlusion_volume
         SELECT a.id, b.id, occlusion.box3d(occlusion.point3d(84900, 446900, 0), occlusion.point3d(85200, 447200, 3))
           FROM {s}.feature AS a, {s}.feature AS b WHERE a.name = 'block 0 0' AND b.name = 'block 2 2'",
    );
    let report = verify(&scene, "20").expect(1).json();
    assert_eq!(report["stored_faults"], 1, "{report:#}");
    assert!(
        report["false_occlusions"].as_u64().unwrap() > 0,
        "{report:#}"
    );
    assert_eq!(
        report["false_occlusions"], report["confirmed"],
        "{report:#}"
    );
    let seen = report["faults"].as_array().unwrap().last().unwrap();
    assert!(
        seen["fault"]
            .as_str()
            .unwrap()
            .contains("(\"block 2 2\") is visible from"),
        "{seen:#}"
    );
    // What it says to look at can be looked at.
    let folder = tempdir().unwrap();
    let picture = seen["picture"].as_str().unwrap();
    shell(picture, folder.path()).expect(0);
    assert!(
        folder.path().join(format!("{}.png", scene.name)).exists(),
        "{picture}"
    );
}

#[test]
fn without_streets_no_one_can_look() {
    let mut scene = blocks("no streets");
    scene.run("DELETE FROM {s}.street");
    let run = verify(&scene, "1").expect(3);
    assert!(run.stderr.contains("has no streets"), "{}", run.stderr);
    verify(&scene, "0").expect(0);
}

#[test]
fn an_inner_envelope_that_sticks_out_is_found() {
    let mut scene = blocks("inner");
    scene.run(
        "UPDATE {s}.inner_envelope SET box = occlusion.expand(box, 0.001)
         WHERE feature = (SELECT min(id) FROM {s}.feature)",
    );
    let report = verify(&scene, "0").expect(1).json();
    assert_eq!(report["stored_faults"], 1, "{report:#}");
    let fault = report["faults"][0]["fault"].as_str().unwrap();
    assert!(fault.contains("reaches into the inner envelope"), "{fault}");
}

#[test]
fn an_outer_envelope_that_is_too_small_is_found() {
    let mut scene = blocks("outer");
    scene.run(
        "UPDATE {s}.feature SET envelope = occlusion.expand(envelope, -1e-9)
         WHERE id = (SELECT min(id) FROM {s}.feature)",
    );
    let report = verify(&scene, "0").expect(1).json();
    let faults = report["faults"].as_array().unwrap();
    let outside = |fault: &serde_json::Value| {
        fault["fault"]
            .as_str()
            .is_some_and(|text| text.contains("lies outside the outer envelope"))
    };
    assert!(faults.iter().any(outside), "{report:#}");
}

/// A wide building with a passage through it, a kiosk behind, and a road in front.
fn passage() -> City {
    let section = [
        [0.0, 0.0],
        [10.0, 0.0],
        [10.0, 4.0],
        [20.0, 4.0],
        [20.0, 0.0],
        [30.0, 0.0],
        [30.0, 20.0],
        [0.0, 20.0],
    ];
    City::default()
        .prism("gate", &section, [0.0, 10.0])
        .block("kiosk", [13.0, 30.0, 0.0], [17.0, 34.0, 3.0])
        .road("front", [5.0, -30.0], [25.0, -10.0])
}

#[test]
fn solid_ground_under_a_passage_is_found() {
    let folder = tempdir().unwrap();
    let mut scene = imported("passage", &passage().write(folder.path()));
    let name = scene.name.clone();
    verify(&scene, "20").expect(0);
    scene.run(
        "UPDATE {s}.inner_envelope SET grounded = true, box = occlusion.box3d(
             occlusion.point3d(85000, 447000, 4), occlusion.point3d(85030, 447010, 20))
         WHERE feature = (SELECT id FROM {s}.feature WHERE name = 'gate')",
    );
    occlusion(&["generate", &name]).expect(0);
    let report = verify(&scene, "20").expect(1).json();
    assert_eq!(report["stored_faults"], 1, "{report:#}");
    assert!(
        report["false_occlusions"].as_u64().unwrap() > 0,
        "{report:#}"
    );
    let faults = report["faults"].as_array().unwrap();
    assert!(
        faults[0]["fault"]
            .as_str()
            .unwrap()
            .contains("above the foot"),
        "{report:#}"
    );
    assert!(
        faults[1]["fault"]
            .as_str()
            .unwrap()
            .contains("(\"kiosk\") is visible"),
        "{report:#}"
    );
}

#[test]
fn faults_are_told_to_people_too() {
    let mut scene = blocks("told");
    scene.run("UPDATE {s}.inner_envelope SET box = occlusion.expand(box, 0.5)");
    let run = occlusion(&["verify", &scene.name, "--observers", "0"]).expect(1);
    assert_eq!(
        run.stdout.matches("fault: Building").count(),
        10,
        "{}",
        run.stdout
    );
    assert!(
        run.stdout
            .contains("0 false occlusions, 25 faults in what is stored"),
        "{}",
        run.stdout
    );
}
