//! View cells that a worker computes beside edits, in both orders of their commits: whoever asks, under whatever
//! isolation, finds no set that lacks what can be seen.

use std::thread;
use std::time::{Duration, Instant};

use end_to_end::{TestScene, client};
use postgres::Client;

/// Edits by which something is seen that was not: what was hidden, something new, something higher.
const DELETE: &str = "DELETE FROM {s}.feature WHERE id % 3 = 0;";
const INSERT: &str = "INSERT INTO {s}.feature (id, class, envelope)
     SELECT 1000 + id, 'Tower', occlusion.box3d(occlusion.point3d(occlusion.x(at), occlusion.y(at), 40),
                                                occlusion.point3d(occlusion.x(at) + 2, occlusion.y(at) + 2, 45))
     FROM {s}.feature, occlusion.center(envelope) AS c (at) WHERE id % 3 = 0;
     INSERT INTO {s}.mesh (feature, level_of_detail, vertices, triangles)
     SELECT id, 1, ARRAY[occlusion.x(a), occlusion.y(a), 40, occlusion.x(b), occlusion.y(a), 40,
                         occlusion.x(b), occlusion.y(b), 40, occlusion.x(a), occlusion.y(b), 45],
            ARRAY[0, 2, 1, 0, 3, 2, 0, 1, 3, 1, 2, 3]
     FROM {s}.feature, occlusion.lower(envelope) AS l (a), occlusion.upper(envelope) AS u (b) WHERE id > 1000;";
const UPDATE: &str = "UPDATE {s}.feature
     SET envelope = occlusion.merge(envelope, occlusion.translate(envelope, 0, 0, 40)) WHERE id % 3 = 0;
     UPDATE {s}.mesh SET vertices = (SELECT array_agg(CASE WHEN n % 3 = 0 AND v > 1 THEN v + 40 ELSE v END ORDER BY n)
                                     FROM unnest(vertices) WITH ORDINALITY AS u (v, n)) WHERE feature % 3 = 0;";

/// A small town with view cells, and one whose squares are still to be done.
fn town(test: &str) -> TestScene {
    let mut scene = TestScene::new(test);
    scene.name = scene.name.replace(' ', "_");
    let name = scene.name.clone();
    scene.run(&format!(
        "SELECT occlusion.generate_city('{name}', 'streets', 50, 7)"
    ));
    scene.run(&call(&name));
    scene.run("UPDATE {s}.view_cell_block SET done = false");
    scene
}

fn call(scene: &str) -> String {
    format!(
        "CALL occlusion.generate_view_cells('{scene}', range => 150, smallest => 8, finest => 1)"
    )
}

/// A transaction of somebody who reads.
struct Reader {
    client: Client,
    scene: String,
}

impl Reader {
    fn begin(scene: &TestScene, isolation: &str) -> Self {
        let mut client = client();
        let begin = format!(
            "BEGIN ISOLATION LEVEL {isolation}; SELECT count(*) FROM {}.feature",
            scene.name
        );
        client.batch_execute(&begin).expect("a snapshot");
        let scene = scene.name.clone();
        Self { client, scene }
    }

    /// How many eyes have a visible set, and how many features their sets lack that a sight line meets.
    fn look(&mut self) -> [i64; 2] {
        let statement = "WITH eye AS MATERIALIZED (
                 SELECT occlusion.point3d(px, py, s.eye_low) AS eye
                 FROM {s}.street AS s, generate_series(1, 12) AS n,
                      LATERAL (SELECT occlusion.lower(s.envelope) AS a, occlusion.size(s.envelope) AS d) AS e,
                      LATERAL (SELECT occlusion.x(a) + occlusion.x(d) * mod((n + s.id) * 0.754877666, 1.0)::float8 AS px,
                                      occlusion.y(a) + occlusion.y(d) * mod((n + s.id) * 0.569840291, 1.0)::float8 AS py) AS p
                 WHERE s.area[1] @> point(px, py)
             ), seen AS MATERIALIZED (
                 SELECT e.eye, s.visible FROM eye AS e CROSS JOIN LATERAL occlusion.visible_set('{s}', e.eye) AS s
             )
             SELECT (SELECT count(*) FROM seen), (
                 SELECT count(DISTINCT (e.eye::text, f.id)) FROM seen AS e
                 CROSS JOIN LATERAL occlusion.visible_features('{s}', e.eye, 150) AS v
                 JOIN {s}.feature AS f ON f.id = v.feature_id
                 JOIN {s}.mesh AS m ON m.feature = f.id
                 CROSS JOIN LATERAL generate_series(1, cardinality(m.vertices), 3) AS at
                 CROSS JOIN LATERAL occlusion.line_of_sight('{s}', e.eye,
                     occlusion.point3d(m.vertices[at], m.vertices[at + 1], m.vertices[at + 2])) AS l
                 WHERE (f.slot IS NULL OR NOT e.visible OPERATOR(occlusion.@>) f.slot::bigint) AND l.visible)";
        let row = self
            .client
            .query_one(&statement.replace("{s}", &self.scene), &[])
            .expect("an answer");
        [row.get(0), row.get(1)]
    }
}

/// Waits until another session waits for a lock.
fn wait_for_waiting(scene: &mut TestScene, backend: i32) {
    let began = Instant::now();
    let waiting = format!(
        "SELECT count(*) FROM pg_stat_activity WHERE pid = {backend} AND wait_event_type = 'Lock'"
    );
    while scene.number(&waiting) == 0 {
        assert!(began.elapsed() < Duration::from_secs(60), "it never waits");
        thread::sleep(Duration::from_millis(5));
    }
}

/// A worker, in a thread of its own.
fn worker(scene: &TestScene) -> (i32, thread::JoinHandle<()>) {
    let mut client = client();
    let row = client.query_one("SELECT pg_backend_pid()", &[]);
    let backend: i32 = row.expect("a backend").get(0);
    let call = call(&scene.name);
    let work = thread::spawn(move || client.batch_execute(&call).expect("it is done"));
    (backend, work)
}

/// What readers find that began before an edit, and after, when both it and a worker are through.
fn check(scene: &mut TestScene, mut before: Vec<Reader>) {
    // Something is known to readers of before, so their sets are looked at, too.
    for reader in &mut before {
        let [_, lacking] = reader.look();
        assert_eq!(lacking, 0);
    }
    let mut after = Reader::begin(scene, "READ COMMITTED");
    assert_eq!(after.look()[1], 0);
    drop(after);
    // The edit is in the log or in the cells; without the log some sets lack something.
    scene.run(&call(&scene.name.clone()));
    let [known, lacking] = Reader::begin(scene, "REPEATABLE READ").look();
    assert!(known > 50, "{known} eyes are known");
    assert_eq!(lacking, 0);
}

fn readers(scene: &TestScene) -> Vec<Reader> {
    ["READ COMMITTED", "REPEATABLE READ"]
        .map(|isolation| Reader::begin(scene, isolation))
        .into()
}

/// The worker reads before the edit, and commits before it.
fn worker_first(test: &str, edit: &str) {
    let mut scene = town(test);
    let before = readers(&scene);
    let mut writer = client();
    let edit = edit.replace("{s}", &scene.name);
    writer
        .batch_execute(&format!("BEGIN; {edit}"))
        .expect("an edit");
    let (_, work) = worker(&scene);
    work.join().expect("it ends");
    // As long as nobody sees the edit, the cells are in use.
    let [known, lacking] = Reader::begin(&scene, "READ COMMITTED").look();
    assert!(known > 50, "{known} eyes are known");
    assert_eq!(lacking, 0);
    writer.batch_execute("COMMIT").expect("a commit");
    // As if it were not logged.
    scene.run("CREATE TEMP TABLE kept AS TABLE {s}.change; DELETE FROM {s}.change");
    let [_, lacking] = Reader::begin(&scene, "READ COMMITTED").look();
    scene.run("INSERT INTO {s}.change TABLE kept; DROP TABLE kept");
    assert!(lacking > 0, "the edit shows nothing");
    check(&mut scene, before);
}

/// The worker reads before the edit, which commits before it does.
fn edit_first(test: &str, edit: &str) {
    let mut scene = town(test);
    let before = readers(&scene);
    let mut gate = client();
    let lock = format!("BEGIN; LOCK TABLE {}.view_cell IN SHARE MODE", scene.name);
    gate.batch_execute(&lock).expect("a lock");
    // It has computed a square, and waits to write it down.
    let (backend, work) = worker(&scene);
    wait_for_waiting(&mut scene, backend);
    scene.run(edit);
    gate.batch_execute("ROLLBACK").expect("it is given up");
    work.join().expect("it ends");
    check(&mut scene, before);
}

#[test]
fn a_worker_commits_before_a_deletion() {
    worker_first("isolation_delete_last", DELETE);
}

#[test]
fn a_worker_commits_before_an_insertion() {
    worker_first("isolation_insert_last", INSERT);
}

#[test]
fn a_worker_commits_before_an_update() {
    worker_first("isolation_update_last", UPDATE);
}

#[test]
fn a_deletion_commits_before_a_worker() {
    edit_first("isolation_delete_first", DELETE);
}

#[test]
fn an_insertion_commits_before_a_worker() {
    edit_first("isolation_insert_first", INSERT);
}

#[test]
fn an_update_commits_before_a_worker() {
    edit_first("isolation_update_first", UPDATE);
}

#[test]
fn what_a_savepoint_takes_back_never_was() {
    let mut scene = town("isolation_savepoint");
    scene.run(&call(&scene.name.clone()));
    let mut writer = Reader::begin(&scene, "REPEATABLE READ");
    let [known, _] = writer.look();
    assert!(known > 50, "{known} eyes are known");
    for edit in [DELETE, INSERT, UPDATE] {
        let edit = edit.replace("{s}", &scene.name);
        let within = format!("SAVEPOINT a; {edit}");
        writer.client.batch_execute(&within).expect("an edit");
        let [fewer, lacking] = writer.look();
        assert!(fewer < known, "{fewer} of {known} eyes");
        assert_eq!(lacking, 0);
        let back = "ROLLBACK TO a; RELEASE a";
        writer.client.batch_execute(back).expect("it is taken back");
        assert_eq!(writer.look(), [known, 0]);
    }
}

#[test]
fn a_prepared_edit_counts_when_it_is_committed() {
    let mut scene = town("isolation_prepared");
    scene.run(&call(&scene.name.clone()));
    let [known, _] = Reader::begin(&scene, "READ COMMITTED").look();
    for (edit, end) in [(UPDATE, "ROLLBACK"), (DELETE, "COMMIT")] {
        let name = format!("isolation {}", std::process::id());
        scene.run(&format!("BEGIN; {edit} PREPARE TRANSACTION '{name}'"));
        assert_eq!(Reader::begin(&scene, "READ COMMITTED").look(), [known, 0]);
        scene.run(&format!("{end} PREPARED '{name}'"));
        let [now, lacking] = Reader::begin(&scene, "READ COMMITTED").look();
        assert_eq!(lacking, 0);
        assert_eq!(now < known, end == "COMMIT", "{now} of {known} eyes");
    }
}
