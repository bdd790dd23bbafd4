//! The generation of view cells beside others, cancelled, and taken up again; and cells against what is seen.

use std::thread;
use std::time::{Duration, Instant};

use end_to_end::{TestScene, client, database_url, occlusion};
use postgres::error::SqlState;

/// Makes a small town in a scene whose name needs no quotes.
fn town(test: &str, houses: u32) -> TestScene {
    let mut scene = TestScene::new(test);
    scene.name = scene.name.replace(' ', "_");
    let name = scene.name.clone();
    scene.run(&format!(
        "SELECT occlusion.generate_city('{name}', 'streets', {houses}, 5)"
    ));
    scene
}

/// The call, with sets for which little is to be done.
fn call(scene: &str) -> String {
    format!("CALL occlusion.generate_view_cells('{scene}', range => 120, finest => 0.5)")
}

/// All cells, as they would be in any order of work.
const CELLS: &str =
    "SELECT string_agg((box, visible::text)::text, ' ' ORDER BY box::text) FROM {s}.view_cell";

/// Squares that are done.
const DONE: &str = "SELECT count(*) FROM {s}.view_cell_block WHERE done";

const LEFT: &str = "SELECT count(*) FROM {s}.view_cell_block WHERE NOT done";

fn text(scene: &mut TestScene, statement: &str) -> String {
    let statement = statement.replace("{s}", &scene.name);
    scene
        .client
        .query_one(&statement, &[])
        .expect(&statement)
        .get(0)
}

/// The number that a statement returns in which `{n}` stands for the scene's name.
#[track_caller]
fn number(scene: &mut TestScene, statement: &str) -> i64 {
    let statement = statement.replace("{n}", &scene.name);
    scene.number(&statement)
}

#[test]
fn three_sessions_share_the_work_and_make_what_one_makes() {
    let mut scene = town("cells_shared", 300);
    scene.run(&call(&scene.name));
    let alone = text(&mut scene, CELLS);
    assert!(alone.len() > 1000);
    let sessions: Vec<_> = (0..3)
        .map(|_| {
            let call = call(&scene.name);
            thread::spawn(move || client().batch_execute(&call))
        })
        .collect();
    for session in sessions {
        session.join().expect("it ends").expect("it is done");
    }
    assert_eq!(scene.number(LEFT), 0);
    assert_eq!(text(&mut scene, CELLS), alone);
}

#[test]
fn a_square_that_another_session_has_in_hand_is_left_to_it() {
    let mut scene = town("cells_locked", 200);
    scene.run(&call(&scene.name));
    let all = scene.number(DONE);
    // As if a session had been killed before it came to two of the squares.
    scene.run(
        "UPDATE {s}.view_cell_block SET done = false
         WHERE id IN (SELECT id FROM {s}.view_cell_block ORDER BY id LIMIT 2)",
    );
    let mut other = client();
    let lock = format!(
        "BEGIN; SELECT FROM {0}.view_cell_block WHERE id = (SELECT min(id) FROM {0}.view_cell_block) FOR UPDATE",
        scene.name
    );
    other.batch_execute(&lock).expect("it is locked");
    // The other one's lock keeps nobody from beginning.
    scene.run(&call(&scene.name));
    assert_eq!(scene.number(LEFT), 1);
    assert_eq!(scene.number(DONE), all - 1);
    other.batch_execute("ROLLBACK").expect("it is given up");
    scene.run(&call(&scene.name));
    assert_eq!(scene.number(LEFT), 0);
}

#[test]
fn cancelled_work_keeps_what_it_has_and_goes_on_there() {
    let mut scene = town("cells_cancelled", 600);
    let mut worker = client();
    let backend: i32 = worker
        .query_one("SELECT pg_backend_pid()", &[])
        .expect("it has a number")
        .get(0);
    let call = call(&scene.name);
    let work = thread::spawn({
        let call = call.clone();
        move || worker.batch_execute(&call)
    });
    let began = Instant::now();
    while scene.number(DONE) < 3 {
        assert!(
            began.elapsed() < Duration::from_secs(120),
            "nothing is done"
        );
        thread::sleep(Duration::from_millis(20));
    }
    let asked = Instant::now();
    scene.run(&format!("SELECT pg_cancel_backend({backend})"));
    let error = work.join().expect("it ends").expect_err("it was cancelled");
    println!("cancelled after {:?}", asked.elapsed());
    assert_eq!(error.code(), Some(&SqlState::QUERY_CANCELED));
    let done = scene.number(DONE);
    assert!(done >= 3 && scene.number(LEFT) > 0);
    assert_eq!(
        number(
            &mut scene,
            "SELECT count(*) FROM occlusion.progress('{n}') WHERE state <> 'finished'"
        ),
        1
    );
    scene.run("CREATE TEMP TABLE before AS SELECT id, xmin::text AS made FROM {s}.view_cell");
    scene.run(&call);
    assert_eq!(scene.number(LEFT), 0);
    // Nothing was made again, or lost.
    assert_eq!(
        scene.number(
            "SELECT count(*) FROM before
             WHERE (id, made) NOT IN (SELECT id, xmin::text FROM {s}.view_cell)"
        ),
        0
    );
    let resumed = text(&mut scene, CELLS);
    scene.run(&call);
    assert_eq!(text(&mut scene, CELLS), resumed, "made anew from nothing");
}

#[test]
fn edits_while_cells_are_computed_are_never_overlooked() {
    let mut scene = town("cells_edited", 150);
    let work = thread::spawn({
        let call = call(&scene.name);
        move || client().batch_execute(&call)
    });
    let began = Instant::now();
    while scene.number(DONE) < 2 && began.elapsed() < Duration::from_secs(120) {
        thread::sleep(Duration::from_millis(10));
    }
    for id in [10, 35, 60, 85, 110, 135] {
        scene.run(&format!("DELETE FROM {{s}}.feature WHERE id = {id}"));
        thread::sleep(Duration::from_millis(50));
    }
    work.join().expect("it ends").expect("it is done");
    assert_eq!(unseen(&mut scene), 0);
    // Once more, and all are in use again.
    let call = call(&scene.name);
    scene.run(&call);
    assert_eq!(unseen(&mut scene), 0);
    assert_eq!(scene.number("SELECT count(*) FROM {s}.change"), 0);
    let in_use = "SELECT count(s.box) * 100 / count(*) FROM pg_temp.generate_eyes() AS e (eye)
                  LEFT JOIN LATERAL occlusion.visible_set('{n}', e.eye) AS s ON true";
    assert_eq!(number(&mut scene, in_use), 100);
}

#[test]
fn deleted_houses_concern_the_cells_that_see_them_until_these_are_refreshed() {
    let mut scene = town("cells_deleted", 150);
    scene.run(&call(&scene.name));
    let in_use = "SELECT count(s.box) * 100 / count(*) FROM pg_temp.generate_eyes() AS e (eye)
                  LEFT JOIN LATERAL occlusion.visible_set('{n}', e.eye) AS s ON true";
    let mut before = 100;
    for id in [20, 110] {
        scene.run(&format!("DELETE FROM {{s}}.feature WHERE id = {id}"));
        assert_eq!(unseen(&mut scene), 0);
        let now = number(&mut scene, in_use);
        assert!(
            0 < now && now < before,
            "{now} % of the eyes after {before} %"
        );
        before = now;
    }
    let report = check_cells(&scene).expect(0).json();
    assert_eq!(report["false_occlusions"], 0, "{report:#}");
    // As if nothing had been logged.
    scene.run("CREATE TABLE {s}.kept AS TABLE {s}.change; DELETE FROM {s}.change");
    assert_eq!(number(&mut scene, in_use), 100);
    assert!(unseen(&mut scene) > 0);
    scene.run("INSERT INTO {s}.change TABLE {s}.kept; DROP TABLE {s}.kept");
    assert_eq!(number(&mut scene, in_use), before);

    let squares = scene.number(DONE);
    let computed = "SELECT count(*) FROM {s}.view_cell_block AS b
                    WHERE EXISTS (SELECT FROM {s}.view_cell AS c WHERE c.id >> 22 = b.id AND c.xmin::text::bigint > ";
    let last = scene.number("SELECT max(xmin::text::bigint) FROM {s}.view_cell");
    let refresh = format!("CALL occlusion.refresh('{}')", scene.name);
    let sessions: Vec<_> = (0..2)
        .map(|_| {
            let refresh = refresh.clone();
            thread::spawn(move || client().batch_execute(&refresh))
        })
        .collect();
    for session in sessions {
        session.join().expect("it ends").expect("it is done");
    }
    let anew = scene.number(&format!("{computed}{last})"));
    assert!(0 < anew && anew < squares, "{anew} of {squares} squares");
    assert_eq!(number(&mut scene, in_use), 100);
    assert_eq!(unseen(&mut scene), 0);
    assert_eq!(scene.number("SELECT count(*) FROM {s}.change"), 0);
    assert_eq!(scene.number("SELECT count(*) FROM {s}.edit"), 0);
    let report = check_cells(&scene).expect(0).json();
    assert_eq!(report["stored_faults"], 0, "{report:#}");
}

/// Workers that refresh the scene, or wait.
const WORKERS: &str = "SELECT count(*) FROM pg_stat_activity
    WHERE backend_type = 'pg_occlusion refresh' AND datname = current_database()";

#[test]
fn a_worker_refreshes_what_was_edited_by_itself() {
    let mut scene = town("cells_by_themselves", 120);
    scene.run(&call(&scene.name));
    scene.run("SET pg_occlusion.auto_refresh = on; SET pg_occlusion.refresh_delay = '1s'");
    let pending = |scene: &mut TestScene| {
        number(
            scene,
            "SELECT squares - right_squares + changes + edits FROM occlusion.scene_status('{n}')",
        )
    };
    // What is rolled back calls nobody.
    scene.run("BEGIN; DELETE FROM {s}.feature WHERE id = 30; ROLLBACK");
    thread::sleep(Duration::from_millis(300));
    assert_eq!(scene.number(WORKERS), 0);
    for id in [20, 60, 100] {
        scene.run(&format!("DELETE FROM {{s}}.feature WHERE id = {id}"));
    }
    assert!(pending(&mut scene) > 0);
    let began = Instant::now();
    while pending(&mut scene) > 0 {
        let workers = scene.number(WORKERS);
        assert!(workers <= 1, "{workers} workers for edits of one second");
        assert!(began.elapsed() < Duration::from_secs(60), "it never comes");
        thread::sleep(Duration::from_millis(50));
    }
    assert_eq!(unseen(&mut scene), 0);
    // Others who edit need not know of it, and may not call workers as they like.
    scene.run("DROP ROLE IF EXISTS e2e_nobody; CREATE ROLE e2e_nobody; SET ROLE e2e_nobody");
    let refused = scene
        .client
        .batch_execute("SET pg_occlusion.auto_refresh = on");
    let code = refused.expect_err("it is refused").code().cloned();
    assert_eq!(code, Some(SqlState::INSUFFICIENT_PRIVILEGE));
    scene.run("RESET ROLE; DROP ROLE e2e_nobody");
    // A scene that is dropped before its worker begins.
    scene.run("DELETE FROM {s}.feature WHERE id = 40");
    let name = scene.name.clone();
    scene.run(&format!("SELECT occlusion.drop_scene('{name}')"));
    let began = Instant::now();
    while scene.number(WORKERS) > 0 {
        assert!(began.elapsed() < Duration::from_secs(60), "it never ends");
        thread::sleep(Duration::from_millis(50));
    }
}

#[test]
fn an_edit_that_is_packed_while_a_square_is_begun_is_not_overlooked() {
    let mut scene = town("cells_packed", 400);
    let work = thread::spawn({
        let call = call(&scene.name);
        move || client().batch_execute(&call)
    });
    let began = Instant::now();
    // Half of the squares, so that all tiles are known to the session.
    while scene.number(DONE) <= scene.number(LEFT) && began.elapsed() < Duration::from_secs(120) {
        thread::sleep(Duration::from_millis(5));
    }
    // All are still there, and more of them are seen.
    scene.run(
        "DELETE FROM {s}.solid_column WHERE feature % 3 = 0;
         DELETE FROM {s}.inner_envelope WHERE feature % 3 = 0",
    );
    // The next square waits for the log, and whatever was read of it before is out of date then.
    let name = scene.name.clone();
    scene.run(&format!(
        "BEGIN; LOCK TABLE {{s}}.edit IN ACCESS EXCLUSIVE MODE; SELECT pg_sleep(1);
         SELECT occlusion.pack_tiles('{name}'); COMMIT"
    ));
    work.join().expect("it ends").expect("it is done");
    // What is in use is what comes out when all is computed from the tables as they are now.
    scene.run(&format!(
        "DO $$ BEGIN
             EXECUTE 'CREATE TEMP TABLE in_use AS SELECT c.box, c.visible
                      FROM {{s}}.view_cell_block AS b JOIN {{s}}.view_cell AS c ON '
                 || occlusion.cell_in_block_condition() || ' WHERE ' || occlusion.valid_cells_condition('{name}');
         END $$"
    ));
    let in_use = scene.number("SELECT count(*) FROM in_use");
    assert!(in_use > 100, "{in_use} cells are in use");
    scene.run(&call(&name));
    let same = "SELECT count(*) FROM in_use AS u JOIN {s}.view_cell AS c
                ON c.box::text = u.box::text AND c.visible::text = u.visible::text";
    assert_eq!(scene.number(same), in_use);
}

#[test]
fn every_eye_of_the_streets_is_in_a_cell_and_sees_nothing_that_its_set_lacks() {
    let mut scene = town("cells_cover", 400);
    scene.run(&call(&scene.name));
    assert_eq!(unseen(&mut scene), 0);
    let eyes = scene.number("SELECT count(*) FROM pg_temp.generate_eyes()");
    assert!(eyes > 300, "{eyes} eyes");
    let covered = "SELECT count(*) FROM pg_temp.generate_eyes() AS e (eye)
                   CROSS JOIN LATERAL occlusion.visible_set('{n}', e.eye) AS s
                   WHERE s.box OPERATOR(occlusion.@>) e.eye";
    assert_eq!(number(&mut scene, covered), eyes);
}

#[test]
fn answers_through_cells_hold_all_that_is_seen() {
    let mut scene = town("cells_answers", 300);
    scene.run(&call(&scene.name));
    let url = format!(
        "{}&options=-c%20pg_occlusion.use_cells%3Don",
        database_url()
    );
    let verified = occlusion(&[
        "verify",
        &scene.name,
        "--observers",
        "25",
        "--resolution",
        "256",
        "--range",
        "120",
        "--json",
        "--database",
        &url,
    ]);
    let report = verified.expect(0).json();
    assert_eq!(report["false_occlusions"], 0, "{report:#}");
    assert!(report["visible"].as_u64().unwrap() > 100, "{report:#}");
    // The same from many eyes: live answers have nothing that those through cells lack and a sight line
    // meets.
    scene.run(EYES);
    scene.run("SET pg_occlusion.use_cells = on");
    let through = "SELECT count(*) FROM pg_temp.generate_eyes() AS e (eye)
                   CROSS JOIN LATERAL occlusion.explain_sight('{n}', e.eye, 120) AS line
                   WHERE line ~ 'View Cell: \\d'";
    let eyes = scene.number("SELECT count(*) FROM pg_temp.generate_eyes()");
    assert_eq!(number(&mut scene, through), eyes);
    let through =
        "CREATE TEMP TABLE through AS SELECT e.eye, v.* FROM pg_temp.generate_eyes() AS e (eye)
                   CROSS JOIN LATERAL occlusion.visible_features('{n}', e.eye, 120) AS v";
    let through = through.replace("{n}", &scene.name);
    scene.run(&through);
    scene.run("SET pg_occlusion.use_cells = off");
    scene.run(&through.replace("TABLE through", "TABLE live"));
    let rows = scene.number("SELECT count(*) FROM live");
    assert!(rows > 10_000, "{rows} rows");
    let lost = "WITH lost AS (TABLE live EXCEPT TABLE through)
         SELECT count(DISTINCT (l.eye::text, l.feature_id)) FROM lost AS l
         JOIN {s}.mesh AS m ON m.feature = l.feature_id
         CROSS JOIN LATERAL generate_series(1, cardinality(m.vertices), 3) AS at
         CROSS JOIN LATERAL occlusion.line_of_sight('{n}', l.eye,
             occlusion.point3d(m.vertices[at], m.vertices[at + 1], m.vertices[at + 2])) AS sight
         WHERE sight.visible";
    assert_eq!(number(&mut scene, lost), 0);
    let more = scene.number("SELECT count(*) FROM (TABLE through EXCEPT TABLE live) AS more");
    assert!(more * 1000 < rows, "{more} rows more than live");
}

/// A function that makes eyes.
const EYES: &str = "CREATE OR REPLACE FUNCTION pg_temp.generate_eyes() RETURNS SETOF occlusion.point3d LANGUAGE sql STABLE AS $$
             SELECT occlusion.point3d(px, py, s.eye_low + (s.eye_high - s.eye_low) * (n % 3) / 2)
             FROM {s}.street AS s, generate_series(1, 60) AS n,
                  LATERAL (SELECT occlusion.lower(s.envelope) AS a, occlusion.size(s.envelope) AS d) AS e,
                  LATERAL (SELECT occlusion.x(a) + occlusion.x(d) * mod((n + s.id) * 0.754877666, 1.0)::float8 AS px,
                                  occlusion.y(a) + occlusion.y(d) * mod((n + s.id) * 0.569840291, 1.0)::float8 AS py) AS p
             WHERE s.area[1] @> point(px, py)
             ORDER BY s.id, n LIMIT 600
         $$;
         SET search_path = public";

/// Makes eyes, and counts features that a sight line from one meets, within range, and that its set lacks: a
/// live answer may hold too much, so what only it has is looked at along sight lines to its surface.
fn unseen(scene: &mut TestScene) -> i64 {
    scene.run(EYES);
    number(
        scene,
        "SELECT count(*) FROM pg_temp.generate_eyes() AS e (eye)
         CROSS JOIN LATERAL occlusion.visible_set('{n}', e.eye) AS s
         CROSS JOIN LATERAL occlusion.visible_features('{n}', e.eye, 120) AS v
         JOIN {s}.feature AS f ON f.id = v.feature_id
         CROSS JOIN LATERAL (SELECT vertices FROM {s}.mesh AS m WHERE m.feature = f.id) AS m
         CROSS JOIN LATERAL generate_series(1, cardinality(m.vertices), 3) AS at
         CROSS JOIN LATERAL occlusion.line_of_sight('{n}', e.eye,
             occlusion.point3d(m.vertices[at], m.vertices[at + 1], m.vertices[at + 2])) AS l
         WHERE NOT s.visible OPERATOR(occlusion.@>) f.slot::bigint AND l.visible",
    )
}

/// What `verify --cells` says of a scene.
fn check_cells(scene: &TestScene) -> end_to_end::Run {
    let name = scene.name.as_str();
    occlusion(&["verify", name, "--cells", "--observers", "0", "--json"])
}

#[test]
fn stored_cells_are_checked_and_planted_faults_are_found() {
    let mut scene = town("cells_checked", 200);
    scene.run(&call(&scene.name));
    let report = check_cells(&scene).expect(0).json();
    let cells = &report["view_cells"];
    let count = number(&mut scene, "SELECT count(*) FROM {n}.view_cell");
    assert_eq!(cells["checked"], count, "{report:#}");
    assert!(cells["rays"].as_u64().unwrap() > 100_000, "{report:#}");
    let share: f64 = scene
        .client
        .query_one("SELECT occlusion.proven_share($1)", &[&scene.name])
        .unwrap()
        .get(0);
    let proven = cells["proven"].as_f64().unwrap() / cells["visible"].as_f64().unwrap();
    assert!(
        share > 0.7 && (share - proven).abs() < 1e-9,
        "{share} {proven}"
    );

    // A proof that is made up.
    let name = scene.name.clone();
    scene.run(&format!("UPDATE {name}.view_cell SET unproven = '{{}}'"));
    let report = check_cells(&scene).expect(1).json();
    assert!(report["stored_faults"].as_i64().unwrap() > 0, "{report:#}");
    assert_eq!(report["false_occlusions"], 0, "{report:#}");

    // An erosion that is a tenth short: what was found for a box is said of one that is larger by a ninth.
    scene.run(&format!(
        "UPDATE {name}.view_cell AS c SET unproven = c.visible, box = occlusion.box3d(
             occlusion.point3d(occlusion.x(low) - occlusion.x(size) / 18, occlusion.y(low) - occlusion.y(size) / 18,
                               occlusion.z(low)),
             occlusion.point3d(occlusion.x(high) + occlusion.x(size) / 18, occlusion.y(high) + occlusion.y(size) / 18,
                               occlusion.z(high)))
         FROM (SELECT id, occlusion.lower(box), occlusion.upper(box), occlusion.size(box) FROM {name}.view_cell)
              AS old (id, low, high, size)
         WHERE old.id = c.id"
    ));
    let report = check_cells(&scene).expect(1).json();
    assert!(
        report["false_occlusions"].as_i64().unwrap() > 0,
        "{report:#}"
    );
    assert_eq!(report["stored_faults"], 0, "{report:#}");
}
