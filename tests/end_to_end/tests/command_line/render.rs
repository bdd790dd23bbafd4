//! Pictures and tables of an answer.

use end_to_end::{City, TestScene, occlusion};
use tempfile::tempdir;

/// On the crossing between four blocks.
const OBSERVER: &str = "85026,447026,1.75";

#[test]
fn pictures_are_drawn_and_named() {
    let folder = tempdir().unwrap();
    let file = City::blocks().write(folder.path());
    let scene = TestScene::new("pictures");
    occlusion(&["import", file.to_str().unwrap(), "--scene", &scene.name]).expect(0);
    let field = ["--observer", OBSERVER, "--heading", "45", "--angle", "60"];
    for kind in [
        &[][..],
        &["--plan"],
        &["--above"],
        &["--truth"],
        &["--sector"],
        &["--pitch", "20"],
    ] {
        let path = folder.path().join("picture.png");
        let output = ["--size", "400x300", "-o", path.to_str().unwrap()];
        let run =
            occlusion(&[&["render", &scene.name][..], &field, kind, &output].concat()).expect(0);
        assert_eq!(run.stdout.trim(), path.to_str().unwrap());
        let png = std::fs::read(&path).unwrap();
        assert_eq!(&png[..8], b"\x89PNG\r\n\x1a\n");
        assert_eq!(png[16..24], [0, 0, 1, 144, 0, 0, 1, 44], "{kind:?}");
    }
    let nowhere = ["--observer", OBSERVER, "-o", "no/such/folder/x.png"];
    let run = occlusion(&[&["render", &scene.name][..], &nowhere].concat()).expect(4);
    assert!(
        run.stderr.contains("no/such/folder/x.png"),
        "{}",
        run.stderr
    );
}

#[test]
fn maps_of_view_cells_are_drawn() {
    let folder = tempdir().unwrap();
    let file = City::blocks().write(folder.path());
    let scene = TestScene::new("maps of cells");
    occlusion(&["import", file.to_str().unwrap(), "--scene", &scene.name]).expect(0);
    let path = folder.path().join("map.png");
    let draw = |options: &[&str]| {
        let output = ["--size", "400x300", "-o", path.to_str().unwrap()];
        occlusion(&[&["render", &scene.name, "--cells"][..], options, &output].concat())
    };
    let bare = draw(&[]).expect(3).stderr;
    let expected = format!("scene \"{}\" has no view cells", scene.name);
    assert!(
        bare.contains(&expected) && bare.contains("--cells"),
        "{bare}"
    );
    let cells = [
        "generate",
        &scene.name,
        "--cells",
        "--range",
        "60",
        "--finest",
        "1",
    ];
    occlusion(&cells).expect(0);
    let mut pictures = Vec::new();
    for options in [
        &[][..],
        &["--observer", OBSERVER, "--range", "30"],
        &["--feature", "block 1 1"],
        &["--feature", "1"],
    ] {
        let run = draw(options).expect(0);
        assert_eq!(run.stdout.trim(), path.to_str().unwrap());
        let png = std::fs::read(&path).unwrap();
        assert_eq!(png[16..24], [0, 0, 1, 144, 0, 0, 1, 44], "{options:?}");
        assert!(!pictures.contains(&png), "{options:?}");
        pictures.push(png);
    }
    let missing = draw(&["--feature", "block 9"]).expect(2).stderr;
    let expected = format!("scene \"{}\" has no feature \"block 9\"", scene.name);
    assert!(missing.contains(&expected), "{missing}");
}

#[test]
fn answers_are_tables_and_json() {
    let folder = tempdir().unwrap();
    let file = City::blocks().write(folder.path());
    let scene = TestScene::new("answers");
    occlusion(&["import", file.to_str().unwrap(), "--scene", &scene.name]).expect(0);
    let field = [
        "query",
        &scene.name,
        "--observer",
        OBSERVER,
        "--range",
        "10",
    ];
    let table = occlusion(&field).expect(0).stdout;
    assert!(
        table.contains("4 of the 4 features in the field of view"),
        "{table}"
    );
    let lines: Vec<&str> = table.lines().take(2).collect();
    assert!(
        lines[0].ends_with("metres") && lines[1].ends_with("8.5"),
        "{table}"
    );
    let all = occlusion(&[&field[..], &["--json"]].concat())
        .expect(0)
        .json();
    assert_eq!(all.as_array().map(Vec::len), Some(4), "{all:#}");
    let ahead = ["--heading", "45", "--angle", "60", "--json"];
    let ahead = occlusion(&[&field[..], &ahead].concat()).expect(0).json();
    assert_eq!(
        (&ahead[0]["name"], ahead.as_array().map(Vec::len)),
        (&"block 1 1".into(), Some(1))
    );
    // The picture of a camera: as wide as that cone, or looking down past it.
    let seen_at = |pitch: &str| {
        let camera = ["--heading", "45", "--fov", "40", "--pitch", pitch, "--json"];
        occlusion(&[&field[..], &camera].concat()).expect(0).json()
    };
    assert_eq!(seen_at("0")[0]["name"], "block 1 1");
    assert_eq!(seen_at("-80").as_array().map(Vec::len), Some(0));
}
