//! Files into scenes.

use std::fs;

use end_to_end::{City, TestScene, occlusion};
use tempfile::tempdir;

#[test]
fn a_city_arrives_whole() {
    let folder = tempdir().unwrap();
    let file = City::blocks().write(folder.path());
    let mut scene = TestScene::new("whole");
    let name = scene.name.clone();
    let run = occlusion(&["import", file.to_str().unwrap(), "--scene", &name]).expect(0);
    assert!(
        run.stdout.contains("imported 25 features"),
        "{}",
        run.stdout
    );
    assert!(
        run.stdout.contains("25, 25 of them on solid ground"),
        "{}",
        run.stdout
    );
    for (expected, statement) in [
        (
            25,
            "SELECT count(*) FROM {s}.feature WHERE class = 'Building' AND attributes = '{}'",
        ),
        (
            25,
            "SELECT count(DISTINCT slot) FROM {s}.feature WHERE slot BETWEEN 0 AND 24",
        ),
        (
            25,
            "SELECT count(*) FROM {s}.mesh WHERE defect IS NULL AND level_of_detail = 2",
        ),
        (
            25,
            "SELECT count(*) FROM {s}.model WHERE format = 'packed' AND geometric_error = 0",
        ),
        // A box is one column, and its own outline.
        (
            25,
            "SELECT count(*) FROM {s}.solid_column AS c JOIN {s}.feature AS f ON f.id = c.feature \
             WHERE c.grounded AND c.envelope OPERATOR(occlusion.=) f.envelope \
               AND cardinality(c.footprint) = 1 AND f.outline ~= c.footprint[1]",
        ),
        (7415, "SELECT srid::bigint FROM {s}.scene_info"),
        // Boxes: the three envelopes are one, bit for bit.
        (
            25,
            "SELECT count(*) FROM {s}.feature AS f JOIN {s}.inner_envelope AS i ON i.feature = f.id \
             WHERE f.envelope OPERATOR(occlusion.=) i.box AND i.grounded",
        ),
        (
            1,
            "SELECT count(*) FROM {s}.feature WHERE name = 'block 1 2' AND envelope OPERATOR(occlusion.=) \
             occlusion.box3d(occlusion.point3d(85032, 447064, 0), occlusion.point3d(85052, 447084, 18))",
        ),
        (
            1,
            "SELECT (count(*) > 8)::int::bigint FROM {s}.street WHERE eye_low = 1.5 AND eye_high = 2",
        ),
        // On the crossing, and inside a block.
        (
            1,
            "SELECT count(*) FROM {s}.street WHERE area[1] @> point(85026, 447026)",
        ),
        (
            0,
            "SELECT count(*) FROM {s}.street WHERE area[1] @> point(85042, 447042)",
        ),
    ] {
        assert_eq!(scene.number(statement), expected, "{statement}");
    }
}

#[test]
fn roads_end_where_buildings_stand() {
    let folder = tempdir().unwrap();
    let city = City::default()
        .block("house", [10.0, 0.0, 0.0], [20.0, 10.0, 8.0])
        .road("through", [0.0, 2.0], [40.0, 8.0]);
    let file = city.write(folder.path());
    let mut scene = TestScene::new("roads");
    let name = scene.name.clone();
    occlusion(&["import", file.to_str().unwrap(), "--scene", &name]).expect(0);
    let inside = "SELECT count(*) FROM {s}.street WHERE area[1] @> point(85000 + 15, 447005)";
    let beside = "SELECT count(*) FROM {s}.street WHERE area[1] @> point(85000 + 25, 447005)";
    assert_eq!((scene.number(inside), scene.number(beside)), (0, 1));
}

#[test]
fn skywalks_are_not_grounded() {
    let folder = tempdir().unwrap();
    let city = City::default()
        .block("west", [0.0, 0.0, 0.0], [10.0, 10.0, 20.0])
        .block("walk", [10.0, 2.0, 6.0], [30.0, 8.0, 9.0])
        .block("east", [30.0, 0.0, 0.0], [40.0, 10.0, 20.0]);
    let file = city.write(folder.path());
    let mut scene = TestScene::new("skywalk");
    let name = scene.name.clone();
    occlusion(&["import", file.to_str().unwrap(), "--scene", &name]).expect(0);
    let grounded = "SELECT count(*) FROM {s}.inner_envelope WHERE grounded";
    let hanging = "SELECT count(*) FROM {s}.inner_envelope AS i JOIN {s}.feature AS f ON f.id = i.feature \
                   WHERE NOT i.grounded AND f.name = 'walk'";
    assert_eq!((scene.number(grounded), scene.number(hanging)), (2, 1));
    // There were no roads.
    assert!(scene.number("SELECT count(*) FROM {s}.street WHERE name = 'open space'") > 0);
}

#[test]
fn what_stood_alone_hangs_once_the_ground_is_known() {
    let folder = tempdir().unwrap();
    let write = |name: &str, city: City| {
        let path = folder.path().join(name);
        fs::write(&path, city.text()).unwrap();
        path.to_str().unwrap().to_owned()
    };
    let walk = City::default().block("walk", [10.0, 2.0, 6.0], [30.0, 8.0, 9.0]);
    let houses = City::default()
        .block("west", [0.0, 0.0, 0.0], [10.0, 10.0, 20.0])
        .block("east", [30.0, 0.0, 0.0], [40.0, 10.0, 20.0]);
    let (first, second) = (
        write("walk.city.json", walk),
        write("houses.city.json", houses),
    );
    let grounded = |name: &str| {
        format!(
            "SELECT count(*) FROM {{s}}.feature AS f JOIN {{s}}.inner_envelope AS i ON i.feature = f.id \
             WHERE f.name = '{name}' AND i.grounded AND \
                 (SELECT bool_and(c.grounded) FROM {{s}}.solid_column AS c WHERE c.feature = f.id)"
        )
    };
    for more in [&[][..], &["--update"]] {
        let mut scene = TestScene::new("ground");
        let name = scene.name.clone();
        occlusion(&["import", &first, "--scene", &name]).expect(0);
        assert_eq!(scene.number(&grounded("walk")), 1);
        let run = occlusion(&[&["import", &second, "--scene", &name], more].concat()).expect(0);
        assert!(
            run.stdout.contains("2, 2 of them on solid ground"),
            "{}",
            run.stdout
        );
        for (feature, expected) in [("walk", 0), ("west", 1), ("east", 1)] {
            assert_eq!(scene.number(&grounded(feature)), expected, "{feature}");
        }
    }
}

#[test]
fn a_missing_bottom_is_added_on_the_ground_alone() {
    let folder = tempdir().unwrap();
    let text = City::default()
        .block("west", [0.0, 0.0, 0.0], [10.0, 10.0, 20.0])
        .block("walk", [10.0, 2.0, 6.0], [30.0, 8.0, 9.0])
        .block("east", [30.0, 0.0, 0.0], [40.0, 10.0, 20.0])
        .text();
    // The bottoms of the western house and of the skywalk.
    let open = text
        .replace("[[0,4,5,1]],", "")
        .replace("[[8,12,13,9]],", "");
    assert_eq!(open.len() + 12 + 14, text.len());
    let file = folder.path().join("open.city.json");
    fs::write(&file, open).unwrap();
    let mut scene = TestScene::new("bottoms");
    let name = scene.name.clone();
    let run = occlusion(&["import", file.to_str().unwrap(), "--scene", &name]).expect(0);
    assert!(
        run.stdout
            .contains("2, 2 of them on solid ground, 1 closed"),
        "{}",
        run.stdout
    );
    let mesh = |of: &str, is: &str| {
        format!(
            "SELECT count(*) FROM {{s}}.mesh AS m JOIN {{s}}.feature AS f ON f.id = m.feature \
             LEFT JOIN {{s}}.solid_column AS c ON c.feature = f.id WHERE f.name = '{of}' AND {is}"
        )
    };
    for (of, is) in [
        (
            "west",
            "defect IS NULL AND repair = 'closed at its foot, 0 m' AND repair_triangles = 2 \
                  AND cardinality(triangles) = 36 AND c.grounded",
        ),
        (
            "east",
            "defect IS NULL AND repair IS NULL AND repair_triangles = 0 AND c.grounded",
        ),
        // What was added is gone again.
        (
            "walk",
            "defect LIKE 'open:%' AND repair IS NULL AND repair_triangles = 0 \
                  AND cardinality(triangles) = 30 AND c.feature IS NULL",
        ),
    ] {
        assert_eq!(scene.number(&mesh(of, is)), 1, "{of}");
    }
    occlusion(&["verify", &name, "--observers", "4", "--resolution", "256"]).expect(0);
}

#[test]
fn hostile_files_leave_nothing_behind() {
    let good = City::default().block("house", [0.0; 3], [5.0; 3]).text();
    let cases = [
        ("empty.json", String::new(), "the file is empty"),
        (
            "words.json",
            "no city".to_owned(),
            "the format is not known",
        ),
        (
            "truncated.json",
            good[..good.len() / 2].to_owned(),
            "not valid json",
        ),
        ("old.json", good.replace("\"2.0\"", "\"0.9\""), "version"),
        (
            "index.json",
            good.replace("[[0,4,5,1]]", "[[0,4,99,1]]"),
            "object \"house\", geometry 0: vertex",
        ),
        (
            "nan.json",
            good.replace("[5000,0,0]", "[NaN,0,0]"),
            "not valid json",
        ),
        ("huge.json", good.replace("0.001", "1e308"), "huge.json"),
        ("bytes.json", "\u{0}".to_owned(), "bytes.json"),
    ];
    let folder = tempdir().unwrap();
    let fine = City::default()
        .block("fine", [0.0; 3], [5.0; 3])
        .write(folder.path());
    let mut scene = TestScene::new("hostile");
    let name = scene.name.clone();
    for (file, text, expected) in cases {
        assert_ne!(text, good, "{file} is not hostile");
        let path = folder.path().join(file);
        fs::write(&path, text).unwrap();
        // The good file goes first: it must not stay alone.
        let files = [fine.to_str().unwrap(), path.to_str().unwrap()];
        let run = occlusion(&["import", files[0], files[1], "--scene", &name]).expect(2);
        assert!(
            run.stderr.contains(expected) && run.stderr.contains(file),
            "{}",
            run.stderr
        );
        assert!(!run.stderr.contains("panicked"), "{}", run.stderr);
        assert!(!scene.exists(), "{file}");
    }
}

#[test]
fn features_that_are_there_already_are_refused() {
    let folder = tempdir().unwrap();
    let file = City::blocks().write(folder.path());
    let file = file.to_str().unwrap();
    let mut scene = TestScene::new("twice");
    let name = scene.name.clone();
    let twice = occlusion(&["import", file, file, "--scene", &name]).expect(2);
    assert!(
        twice.stderr.contains("object \"block 0 0\""),
        "{}",
        twice.stderr
    );
    assert!(!scene.exists());
    occlusion(&["import", file, "--scene", &name]).expect(0);
    let again = occlusion(&["import", file, "--scene", &name]).expect(2);
    assert!(
        again.stderr.contains("holds 25 of these features already")
            && again.stderr.contains("--update"),
        "{}",
        again.stderr
    );
    let other = occlusion(&["import", file, "--scene", &name, "--srid", "4978"]).expect(2);
    assert!(
        other.stderr.contains("has SRID 7415, not 4978"),
        "{}",
        other.stderr
    );
    assert_eq!(scene.number("SELECT count(*) FROM {s}.feature"), 25);
    occlusion(&["import", file, "--scene", &name, "--replace"]).expect(0);
    assert_eq!(scene.number("SELECT count(*) FROM {s}.feature"), 25);
}

#[test]
fn an_update_touches_what_changed_and_nothing_else() {
    let folder = tempdir().unwrap();
    let file = City::blocks().write(folder.path());
    let file = file.to_str().unwrap();
    let mut scene = TestScene::new("update");
    let name = scene.name.clone();
    let update = ["import", file, "--scene", &name, "--update"];
    // A scene that is not there yet is made.
    let first = occlusion(&update).expect(0);
    assert!(
        first.stdout.contains(": 25 new, 0 changed, 0 as they were"),
        "{}",
        first.stdout
    );
    scene.run(&format!(
        "CALL occlusion.generate_view_cells('{name}', range => 60)"
    ));
    let numbers = "SELECT hashtext(string_agg(id || name || slot, ' ' ORDER BY id))::bigint FROM {s}.feature WHERE name <> 'annex'";
    let before = scene.number(numbers);
    let streets = scene.number("SELECT count(*) FROM {s}.street");
    let wrong = format!("SELECT squares - right_squares FROM occlusion.scene_status('{name}')");

    let again = occlusion(&update).expect(0);
    assert!(
        again.stdout.contains(": 0 new, 0 changed, 25 as they were"),
        "{}",
        again.stdout
    );
    assert!(again.stdout.contains("as they were\n"), "{}", again.stdout);
    assert_eq!(scene.number("SELECT count(*) FROM {s}.change"), 0);

    // One block grows, and another one is new.
    let _ = City::blocks()
        .block("block 2 2", [64.0, 64.0, 0.0], [84.0, 84.0, 40.0])
        .block("annex", [170.0, 0.0, 0.0], [180.0, 10.0, 5.0])
        .write(folder.path());
    let changed = occlusion(&update).expect(0);
    assert!(
        changed
            .stdout
            .contains(": 1 new, 1 changed, 24 as they were"),
        "{}",
        changed.stdout
    );
    assert_eq!(scene.number(numbers), before);
    for (expected, statement) in [
        (26, "SELECT count(*) FROM {s}.feature"),
        (26, "SELECT count(*) FROM {s}.mesh WHERE defect IS NULL"),
        (26, "SELECT count(DISTINCT feature) FROM {s}.solid_column"),
        (26, "SELECT count(*) FROM {s}.model"),
        (
            40,
            "SELECT max(occlusion.z(occlusion.upper(envelope)))::bigint FROM {s}.feature WHERE name = 'block 2 2'",
        ),
        (
            40,
            "SELECT max(c.top)::bigint FROM {s}.solid_column AS c JOIN {s}.feature AS f ON f.id = c.feature WHERE c.grounded",
        ),
        (
            2,
            "SELECT count(*) FROM {s}.mesh WHERE xmin = (SELECT xmin FROM {s}.feature WHERE name = 'annex')",
        ),
        (2, "SELECT count(DISTINCT feature) FROM {s}.change"),
    ] {
        assert_eq!(scene.number(statement), expected, "{statement}");
    }
    assert_eq!(scene.number("SELECT count(*) FROM {s}.street"), streets);
    assert!(scene.number(&wrong) > 0);
    scene.run(&format!("CALL occlusion.refresh('{name}')"));
    assert_eq!(scene.number(&wrong), 0);
    occlusion(&["verify", &name, "--observers", "20", "--cells"]).expect(0);

    let both = [&update[..], &["--replace"]].concat();
    occlusion(&both).expect(2);
}

#[test]
fn a_schema_that_is_no_scene_is_left_alone() {
    let folder = tempdir().unwrap();
    let file = City::blocks().write(folder.path());
    let mut scene = TestScene::new("schema");
    let name = scene.name.clone();
    scene.run("CREATE SCHEMA {s}; CREATE TABLE {s}.precious (x int)");
    for replace in [&[][..], &["--replace"]] {
        let arguments = [
            &["import", file.to_str().unwrap(), "--scene", &name][..],
            replace,
        ]
        .concat();
        let run = occlusion(&arguments).expect(3);
        assert!(run.stderr.contains("is not a scene"), "{}", run.stderr);
    }
    assert_eq!(scene.number("SELECT count(*) FROM {s}.precious"), 0);
    scene.run("DROP SCHEMA {s} CASCADE");
}
