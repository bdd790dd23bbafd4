//! The benchmarks, on little data: that everything is measured and that answers agree, not how
//! long it takes.

use end_to_end::{City, Run, TestDatabase, occlusion, occlusion_with_embree};
use tempfile::tempdir;

/// Indexes with the extension that they need, and whether they answer every search.
const INDEXES: [(&str, Option<&str>, &[&str]); 7] = [
    ("box3d GiST", None, &ALL),
    ("box3d GiST, build not sorted", None, &ALL),
    ("box3d SP-GiST", None, &ALL),
    (
        "box3d BRIN",
        None,
        &["box", "sector", "cone", "point in box"],
    ),
    ("PostGIS n-D GiST", Some("postgis"), &OF_RIVALS),
    ("PostGIS 2D GiST + z", Some("postgis"), &OF_RIVALS),
    ("cube GiST", Some("cube"), &OF_RIVALS),
];

const ALL: [&str; 5] = ["box", "sector", "cone", "point in box", "nearest 10"];
const OF_RIVALS: [&str; 4] = ["box", "sector", "point in box", "nearest 10"];

const EXTENSION: &str = "SELECT FROM pg_catalog.pg_extension WHERE extname = $1";
const SCHEMA: &str = "SELECT FROM pg_catalog.pg_namespace WHERE nspname = $1";

/// Rows of all tables in markdown, cell by cell.
fn cells(markdown: &str) -> Vec<Vec<&str>> {
    let rows = markdown.lines().filter_map(|line| line.strip_prefix("| "));
    rows.map(|row| row.trim_end_matches(" |").split(" | ").collect())
        .collect()
}

#[test]
fn every_index_is_measured_on_every_data_set() {
    let mut database = TestDatabase::new("bench_index");
    let run = occlusion(&[
        "bench",
        "index",
        "--rows",
        "2100",
        "--searches",
        "20",
        "--rounds",
        "1",
        "--format",
        "markdown",
        "--database",
        &database.url,
    ])
    .expect(0);
    let text = &run.stdout;
    let rows = cells(text);
    assert_eq!(text.matches("\n### ").count() + 1, 4, "{text}");
    for (index, extension, searches) in INDEXES {
        let data_sets = if index.contains("not sorted") { 1 } else { 3 };
        let count = |row: &dyn Fn(&&Vec<&str>) -> bool| rows.iter().filter(row).count();
        let is_there = extension.is_none_or(|name| database.finds(EXTENSION, name));
        if !is_there {
            let absent = format!("{index} is absent: the server has no extension");
            assert_eq!(text.matches(&absent).count(), data_sets, "{text}");
        }
        let expected = if is_there { data_sets } else { 0 };
        assert_eq!(count(&|row| row[0] == index), expected, "{index}: {text}");
        for search in searches {
            let found = count(&|row| row[0] == *search && row[1] == index);
            assert_eq!(found, expected, "{search}, {index}: {text}");
        }
    }
    let goals = rows
        .iter()
        .filter(|row| row.len() == 4 && ["yes", "no", "not measured"].contains(&row[3]));
    assert_eq!(goals.count(), 7, "{text}");
    let numbers = rows
        .iter()
        .filter(|row| row.len() == 10 && ALL.contains(&row[0]));
    for row in numbers {
        for cell in [2, 3, 4, 8, 9] {
            let number: f64 = row[cell].parse().unwrap_or_else(|_| panic!("{row:?}"));
            assert!(number.is_finite() && number >= 0.0, "{row:?}");
        }
        assert_ne!(row[2], "0", "searches are where there are boxes: {row:?}");
    }
    assert!(!database.finds(SCHEMA, "occlusion_bench_index"));
}

/// The ways of the point benchmark whose answers are complete.
const COMPLETE: [&str; 5] = [
    "visible_features",
    "box3d, in range only",
    "2004: less what volumes hide",
    "PostGIS n-D, in range only",
    "PostGIS 2D and z, in range only",
];

/// A database with a town that has streets and volumes.
fn town(test: &str) -> TestDatabase {
    let mut database = TestDatabase::new(test);
    database
        .client
        .batch_execute("SELECT occlusion.generate_city('a town', 'streets', 150, 1)")
        .unwrap();
    let call = "CALL occlusion.generate_occlusion_volumes('a town', smallest => 4, range => 100)";
    database.client.batch_execute(call).unwrap();
    database
}

fn bench_point(
    program: fn(&[&str]) -> Run,
    database: &TestDatabase,
    scene: &str,
    more: &[&str],
) -> Run {
    let mut arguments = vec!["bench", "point", scene, "--database", &database.url];
    arguments.extend(["--observers", "12", "--rounds", "1", "--format", "markdown"]);
    arguments.extend(more);
    program(&arguments)
}

#[test]
fn every_way_to_see_is_measured_on_every_scene() {
    let mut database = town("bench_point");
    let ranges = ["--range", "60", "--range", "120"];
    let run = bench_point(occlusion, &database, "a town", &ranges).expect(0);
    assert!(run.stderr.contains("built without Embree"), "{run:?}");
    let text = &run.stdout;
    let rows = cells(text);
    assert_eq!(text.matches("### a town, ").count(), 2, "{text}");
    assert_eq!(text.matches("Connecting and the first call: ").count(), 2);
    assert!(rows.iter().all(|row| row.len() == 8), "{text}");
    let of = |way: &str| -> Vec<f64> {
        let rows = rows.iter().filter(|row| row[0] == way);
        let number = |row: &Vec<&str>| row[2].parse().unwrap_or_else(|_| panic!("{row:?}"));
        rows.map(number).collect()
    };
    let (seen, in_range, old) = (
        of("visible_features"),
        of("box3d, in range only"),
        of("2004: less what volumes hide"),
    );
    assert_eq!((seen.len(), in_range.len(), old.len()), (2, 2, 2), "{text}");
    for at in 0..2 {
        assert!(
            0.0 < seen[at] && seen[at] <= old[at] && old[at] <= in_range[at],
            "{text}"
        );
    }
    if database.finds(EXTENSION, "postgis") {
        assert_eq!(of("PostGIS n-D, in range only"), in_range);
        assert_eq!(of("PostGIS 2D and z, in range only"), in_range);
        assert_eq!(
            of("PostGIS, a sight line to each middle").len(),
            2,
            "{text}"
        );
    }
    assert!(!database.finds(SCHEMA, "occlusion_bench_point"));
    occlusion(&["bench", "point", "atlantis", "--database", &database.url]).expect(3);
}

#[test]
fn item_buffers_are_measured_and_answers_are_judged() {
    let database = town("bench_point_truth");
    let more = ["--range", "100", "--truth", "6"];
    let run = bench_point(occlusion_with_embree, &database, "a town", &more).expect(0);
    let text = &run.stdout;
    let rows = cells(text);
    assert!(rows.iter().all(|row| row.len() == 10), "{text}");
    let row = |way: &str| rows.iter().find(|row| row[0] == way);
    let number = |row: &Vec<&str>, column: usize| -> f64 {
        let cell = row[column].trim_end_matches(" %");
        cell.parse().unwrap_or_else(|_| panic!("{row:?}"))
    };
    for row in COMPLETE.iter().filter_map(|way| row(way)) {
        assert!(row[9] == "0" && number(row, 8) >= 0.0, "{row:?}");
    }
    let over_estimate = |way: &str| number(row(way).unwrap(), 8);
    let (ours, all) = (over_estimate(COMPLETE[0]), over_estimate(COMPLETE[1]));
    assert!(ours < all && all > 0.5, "{text}");
    let cone = row("the same, in a cone of 60 degrees").unwrap();
    assert_eq!(cone[8..], ["–", "–"]);
    if let Some(sight_lines) = row("PostGIS, a sight line to each middle") {
        assert!(number(sight_lines, 9) > 0.0, "{text}");
    }
    let buffers: Vec<&Vec<&str>> = rows
        .iter()
        .filter(|row| row[0].starts_with("Embree item buffer, 6 × "))
        .collect();
    assert_eq!(buffers.len(), 3, "{text}");
    for row in &buffers {
        assert!(row[1] == "6" && number(row, 3) > 0.0, "{row:?}");
        assert!((0.0..50.0).contains(&number(row, 9)), "{row:?}");
    }
    assert!(number(buffers[0], 3) < number(buffers[2], 3), "{text}");
    assert!(number(buffers[0], 9) >= number(buffers[2], 9), "{text}");
    assert!(text.contains("built into a tree of Embree in "), "{text}");
}

#[test]
fn without_truth_no_answer_is_judged() {
    let database = town("bench_point_no_truth");
    let more = ["--range", "60", "--truth", "0"];
    let run = bench_point(occlusion_with_embree, &database, "a town", &more).expect(0);
    assert!(cells(&run.stdout).iter().all(|row| row.len() == 8));
    assert!(!run.stderr.contains("Embree"), "{run:?}");
}

#[test]
fn an_answer_that_misses_something_ends_it_with_an_error() {
    let mut database = TestDatabase::new("bench_point_fault");
    let folder = tempdir().unwrap();
    let city = City::blocks().write(folder.path());
    let city = city.to_str().unwrap();
    occlusion(&[
        "import",
        city,
        "--scene",
        "blocks",
        "--database",
        &database.url,
    ])
    .expect(0);
    let more = ["--range", "300", "--truth", "12"];
    let ask =
        |database: &TestDatabase| bench_point(occlusion_with_embree, database, "blocks", &more);
    ask(&database).expect(0);
    // Every other house is lower than what counts as solid of it.
    let change = "UPDATE blocks.mesh SET vertices = (
            SELECT array_agg(CASE WHEN i % 3 = 0 THEN least(v, 1) ELSE v END ORDER BY i)
            FROM unnest(vertices) WITH ORDINALITY AS u (v, i))
        WHERE feature % 2 = 0";
    database.client.batch_execute(change).unwrap();
    let run = ask(&database).expect(1);
    let fault = "false occlusion: \"visible_features\" leaves out Building ";
    assert!(run.stderr.contains(fault), "{run:?}");
}

/// The ways to find what can be seen from a cell whose sets are complete.
const COMPLETE_SETS: [&str; 3] = ["view cell", "one erosion", "umbra of one occluder"];

fn bench_cells(
    program: fn(&[&str]) -> Run,
    database: &TestDatabase,
    scene: &str,
    more: &[&str],
) -> Run {
    let mut arguments = vec!["bench", "cells", scene, "--database", &database.url];
    arguments.extend(["--cells", "3", "--range", "100", "--format", "markdown"]);
    arguments.extend(more);
    program(&arguments)
}

#[test]
fn view_cells_are_measured_as_computed_and_as_stored() {
    let mut database = town("bench_cells");
    let sizes = ["--edge", "4", "--edge", "8", "--eyes", "9"];
    let run = bench_cells(occlusion, &database, "a town", &sizes).expect(0);
    assert!(run.stderr.contains("built without Embree"), "{run:?}");
    let text = &run.stdout;
    assert_eq!(text.matches("### a town, cells of ").count(), 2, "{text}");
    assert!(!text.contains("view cells, "), "{text}");
    let rows = cells(text);
    let of = |way: &str, column: usize| -> Vec<f64> {
        let rows = rows.iter().filter(|row| row[0] == way);
        let number = |row: &Vec<&str>| row[column].parse().unwrap_or_else(|_| panic!("{row:?}"));
        rows.map(number).collect()
    };
    for way in COMPLETE_SETS {
        assert_eq!(of(way, 1).len(), 2, "{way}: {text}");
        assert!(of(way, 5).iter().all(|&time| time >= 0.0), "{text}");
    }
    let (ours, whole, umbra) = (
        of(COMPLETE_SETS[0], 6),
        of(COMPLETE_SETS[1], 6),
        of(COMPLETE_SETS[2], 6),
    );
    for at in 0..2 {
        assert!(
            0.0 < ours[at] && ours[at] <= whole[at] && ours[at] <= umbra[at],
            "{text}"
        );
    }
    assert!(
        of(COMPLETE_SETS[0], 7).iter().all(|&ratio| ratio >= 0.95),
        "{text}"
    );

    let call = "CALL occlusion.generate_view_cells('a town', range => 60, smallest => 16)";
    database.client.batch_execute(call).unwrap();
    let few = ["--edge", "16", "--eyes", "9"];
    let text = &bench_cells(occlusion, &database, "a town", &few)
        .expect(0)
        .stdout;
    assert!(text.contains(" view cells, 60 m"), "{text}");
    let rows = cells(text);
    let row = |name: &str| rows.iter().find(|row| row[0] == name).expect(name);
    for query in ["visible_set", "visible_from", "visible_features, 60 m"] {
        let row = row(query);
        assert!(row[1] == "9" && row[2] != "0.0", "{row:?}");
    }
    assert!(
        text.contains("| visible_features, 61 m, which no cell answers | 9 |"),
        "{text}"
    );
    let ratio = |name: &str| -> f64 { row(name)[2].parse().unwrap() };
    assert_eq!(ratio("view cells, with indexes"), 1.0);
    assert!(
        ratio("plain table, with indexes") > ratio("visible"),
        "{text}"
    );
    for relation in [
        "view_cell",
        "view_cell_pkey",
        "view_cell_block",
        "view_cell_block_box",
        "view_cell_block_visible",
        "visible_cell",
        "visible_feature",
    ] {
        assert!(ratio(relation) > 0.0, "{text}");
    }
    assert!(!database.finds(SCHEMA, "occlusion_bench_cells"));
    occlusion(&["bench", "cells", "atlantis", "--database", &database.url]).expect(3);
}

#[test]
fn cells_are_sampled_and_what_is_missed_is_told() {
    let database = town("bench_cells_truth");
    let run = bench_cells(occlusion_with_embree, &database, "a town", &["--edge", "8"]).expect(0);
    let text = &run.stdout;
    let rows = cells(text);
    let row = |way: &str| rows.iter().find(|row| row[0] == way).expect(way);
    for way in COMPLETE_SETS {
        assert_eq!(row(way)[9], "0", "{text}");
    }
    let missed = |way: &str| -> f64 {
        let cell = row(way)[9].trim_end_matches(" %");
        cell.parse().unwrap_or_else(|_| panic!("{text}"))
    };
    let sampled = ["9 eyes, 6 × 128²", "25 eyes, 6 × 128²", "25 eyes, 6 × 512²"]
        .map(|eyes| missed(&format!("Embree, {eyes}")));
    assert!(
        sampled[0] >= sampled[1] && sampled[1] >= sampled[2],
        "{text}"
    );
    assert!(text.contains("Exact rays meet "), "{text}");
}

#[test]
fn a_cell_that_misses_something_ends_it_with_an_error() {
    let mut database = TestDatabase::new("bench_cells_fault");
    let folder = tempdir().unwrap();
    let city = City::blocks().write(folder.path());
    let city = city.to_str().unwrap();
    let import = [
        "import",
        city,
        "--scene",
        "blocks",
        "--database",
        &database.url,
    ];
    occlusion(&import).expect(0);
    let more = ["--range", "300", "--edge", "4", "--cells", "8"];
    let arguments = |url| [&["bench", "cells", "blocks", "--database", url], &more[..]].concat();
    occlusion_with_embree(&arguments(&database.url)).expect(0);
    // Every other house is lower than what counts as solid of it.
    let change = "UPDATE blocks.mesh SET vertices = (
            SELECT array_agg(CASE WHEN i % 3 = 0 THEN least(v, 1) ELSE v END ORDER BY i)
            FROM unnest(vertices) WITH ORDINALITY AS u (v, i))
        WHERE feature % 2 = 0";
    database.client.batch_execute(change).unwrap();
    let run = occlusion_with_embree(&arguments(&database.url)).expect(1);
    let fault = "false occlusion: \"view cell\" leaves out Building ";
    assert!(run.stderr.contains(fault), "{run:?}");
}

fn number(database: &mut TestDatabase, statement: &str) -> i64 {
    let row = database.client.query_one(statement, &[]);
    row.unwrap().get(0)
}

#[test]
fn edits_and_repairs_are_measured() {
    let mut database = town("bench_edits");
    let call = "CALL occlusion.generate_view_cells('a town', range => 60, smallest => 16)";
    database.client.batch_execute(call).unwrap();
    let before = number(&mut database, "SELECT count(*) FROM \"a town\".feature");
    let arguments = ["--rows", "1", "--rows", "20", "--rounds", "2", "--demolish"];
    let more = ["2", "--observers", "5", "--range", "60", "--format"];
    let to = ["bench", "edits", "a town", "--database", &database.url];
    let run = occlusion(&[&to[..], &arguments, &more, &["markdown"]].concat()).expect(0);
    let text = &run.stdout;
    let rows = cells(text);
    for (edit, more) in [
        ("attributes of a feature", 1),
        ("envelope of a feature", 1),
        ("new feature", 1),
        ("deleted feature", 1),
        // Of some features there are several.
        ("top of its columns", 3),
    ] {
        let counts: Vec<usize> = rows
            .iter()
            .filter(|row| row[0] == edit)
            .map(|row| row[1].parse().unwrap())
            .collect();
        assert_eq!(counts.len(), 2, "{text}");
        assert!((1..=more).contains(&counts[0]), "{text}");
        assert!((20..=20 * more).contains(&counts[1]), "{text}");
    }
    for query in ["visible_features", "visible_set"] {
        let row = rows.iter().find(|row| row[0] == query).expect(query);
        let ratio: f64 = row[3].parse().unwrap();
        assert!(ratio > 0.0, "{text}");
    }
    let (_, repairs) = text.split_once("### a town, repairs").expect(text);
    assert_eq!(cells(repairs).len(), 4, "{text}");
    assert!(
        text.contains("visible_features, 60 m, meanwhile: "),
        "{text}"
    );

    assert_eq!(
        number(&mut database, "SELECT count(*) FROM \"a town\".feature"),
        before - 2
    );
    let wrong = "SELECT squares - right_squares + edits FROM occlusion.scene_status('a town')";
    assert_eq!(number(&mut database, wrong), 0);
    assert!(!database.finds(SCHEMA, "occlusion_bench_edits"));
    occlusion(&["bench", "edits", "atlantis", "--database", &database.url]).expect(3);
}
