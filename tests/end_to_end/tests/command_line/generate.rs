//! Ctrl-C and what comes after it, and edits beside the work.

use std::process::Command;
use std::thread;
use std::time::{Duration, Instant};

use end_to_end::{TestScene, client, occlusion, start};
use postgres::NoTls;
use postgres::error::SqlState;

/// How fast a cancelled procedure must end.
const AT_ONCE: Duration = Duration::from_secs(1);

/// How long tests wait for something to begin.
const PATIENCE: Duration = Duration::from_secs(30);

/// A scene that keeps the procedure busy for long.
fn busy(test: &str) -> TestScene {
    let mut scene = TestScene::new(test);
    let name = scene.name.clone();
    scene.run(&format!(
        "SELECT occlusion.generate_city('{name}', 'scattered', 4000, 1)"
    ));
    scene
}

/// Waits until the work on the scene has written something.
fn wait_for_first_batch(scene: &mut TestScene) {
    let began = Instant::now();
    while scene.number("SELECT coalesce(sum(done), 0)::bigint FROM {s}.job") == 0 {
        assert!(
            began.elapsed() < PATIENCE,
            "the procedure did not get going"
        );
        thread::sleep(Duration::from_millis(20));
    }
}

fn backends_at_work(scene: &mut TestScene) -> i64 {
    scene.number(
        "SELECT count(*) FROM pg_catalog.pg_stat_activity AS a JOIN {s}.job AS j ON a.pid = j.backend \
         WHERE a.state = 'active'",
    )
}

/// Volumes of coarse lanes, quickly made: how many there are.
fn rerun(scene: &mut TestScene) -> i64 {
    occlusion(&["generate", &scene.name, "--smallest", "25", "--range", "60"]).expect(0);
    scene.number("SELECT count(*) FROM {s}.occlusion_volume")
}

#[test]
fn view_cells_are_made_and_told_of() {
    let mut scene = TestScene::new("generate cells");
    let name = scene.name.clone();
    scene.run(&format!(
        "SELECT occlusion.generate_city('{name}', 'streets', 60, 1)"
    ));
    let run = occlusion(&[
        "generate", &name, "--cells", "--range", "60", "--finest", "1",
    ])
    .expect(0);
    let cells = scene.number("SELECT count(*) FROM {s}.view_cell");
    assert!(cells > 10);
    assert!(
        run.stdout
            .contains(&format!("generated {cells} view cells of {name} in ")),
        "{}",
        run.stdout
    );
    let refused = occlusion(&["generate", &name, "--cells", "--smallest", "20"]).expect(3);
    assert!(
        refused
            .stderr
            .contains("smallest 20 is larger than largest 16"),
        "{}",
        refused.stderr
    );
    occlusion(&["generate", &name, "--finest", "1"]).expect(2);
    occlusion(&["generate", &name, "--cells", "--worth", "1"]).expect(2);
}

#[test]
fn a_cancelled_call_ends_at_once_and_can_be_repeated() {
    let mut scene = busy("cancelled");
    let name = scene.name.clone();
    let mut worker = client();
    let token = worker.cancel_token();
    let call = thread::spawn(move || {
        let call = "CALL occlusion.generate_occlusion_volumes($1, 0.5)";
        let error = worker
            .execute(call, &[&name])
            .expect_err("the call was cancelled");
        (error.code().cloned(), Instant::now(), worker)
    });
    wait_for_first_batch(&mut scene);
    let cancelled = Instant::now();
    token.cancel_query(NoTls).unwrap();
    let (code, ended, mut worker) = call.join().unwrap();
    assert_eq!(code, Some(SqlState::QUERY_CANCELED));
    assert!(
        ended - cancelled < AT_ONCE,
        "it took {:?}",
        ended - cancelled
    );
    // The same backend goes on, and what was committed stays.
    assert_eq!(
        worker.query_one("SELECT 1", &[]).unwrap().get::<_, i32>(0),
        1
    );
    assert!(scene.number("SELECT count(*) FROM {s}.occlusion_volume") > 0);
    let first = rerun(&mut scene);
    assert!(first > 0);
    assert_eq!(rerun(&mut scene), first);
}

#[test]
fn ctrl_c_stops_the_server_too() {
    let mut scene = busy("ctrl-c");
    let mut program = start(&["generate", &scene.name, "--smallest", "0.5"]);
    wait_for_first_batch(&mut scene);
    let interrupted = Instant::now();
    let sent = Command::new("kill")
        .args(["-INT", &program.id().to_string()])
        .status()
        .unwrap();
    assert!(sent.success());
    let status = program.wait().unwrap();
    let took = interrupted.elapsed();
    assert_eq!(status.code(), Some(130));
    assert!(
        took < AT_ONCE + Duration::from_millis(500),
        "it took {took:?}"
    );
    assert_eq!(backends_at_work(&mut scene), 0);
}

#[test]
fn what_is_taken_down_during_the_work_hides_nothing_after_it() {
    let mut scene = busy("taken down");
    let name = scene.name.clone();
    let call = thread::spawn(move || {
        occlusion(&["generate", &name, "--smallest", "10", "--range", "200"]).expect(0)
    });
    wait_for_first_batch(&mut scene);
    // Of every other feature the box goes, and the column is cut down to a kerb.
    scene.run(
        "DELETE FROM {s}.inner_envelope WHERE feature % 2 = 0; \
         UPDATE {s}.solid_column SET top = bottom + 0.1 WHERE feature % 2 = 0",
    );
    let began_again = scene.number("SELECT (total - done)::bigint FROM {s}.job");
    assert!(began_again > 0, "the work was over before the edit");
    call.join().unwrap();
    let count = |scene: &mut TestScene, rest: i32| {
        scene.number(&format!(
            "SELECT count(*) FROM {{s}}.occlusion_volume WHERE occluder % 2 = {rest}"
        ))
    };
    assert_eq!(count(&mut scene, 0), 0);
    assert!(count(&mut scene, 1) > 0);
}

#[test]
fn an_edit_on_a_snapshot_older_than_the_volumes_is_refused() {
    let mut scene = TestScene::new("old snapshot");
    let name = scene.name.clone();
    scene.run(&format!(
        "SELECT occlusion.generate_city('{name}', 'scattered', 100, 1)"
    ));
    let grow = format!(
        "UPDATE \"{name}\".feature SET envelope = occlusion.expand(envelope, 1) \
         WHERE id = (SELECT occludee FROM \"{name}\".occlusion_volume \
                     UNION ALL SELECT 1 LIMIT 1)"
    );
    let begin =
        format!("BEGIN ISOLATION LEVEL REPEATABLE READ; SELECT count(*) FROM \"{name}\".feature");
    let mut editor = client();
    editor.batch_execute(&begin).expect("a snapshot is taken");
    scene.run(&format!(
        "CALL occlusion.generate_occlusion_volumes('{name}')"
    ));
    let error = editor.batch_execute(&grow).expect_err("too old");
    assert_eq!(error.code(), Some(&SqlState::T_R_SERIALIZATION_FAILURE));
    editor
        .batch_execute("ROLLBACK")
        .expect("it can be repeated");
    editor.batch_execute(&begin).expect("a snapshot is taken");
    editor.batch_execute(&grow).expect("new enough");
    editor.batch_execute("COMMIT").expect("committed");
}
