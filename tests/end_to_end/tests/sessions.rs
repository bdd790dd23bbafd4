//! What one session sees of another one's edits: answers from packed tiles and each backend's copies of
//! them, against the tables as the same snapshot has them.

use std::thread;
use std::time::Duration;

use end_to_end::{TestDatabase, TestScene, client};
use postgres::Client;

/// Eyes in and over the middle of the scene.
const EYES: &str =
    "(VALUES (50, 50, 1.7), (83, 17, 1.7), (20, 120, 9), (110, 90, 40)) AS e (x, y, z)";

/// A scene of houses in a square, packed, with a session that has looked at all of it.
struct Stage {
    reader: Client,
    writer: Client,
    // Dropped last: a session that is left in a transaction would keep it from being dropped.
    scene: TestScene,
}

impl Stage {
    fn new(test: &str) -> Self {
        let mut scene = TestScene::new(test);
        // A name that needs no quotes.
        scene.name = scene.name.replace(' ', "_");
        let mut writer = client();
        let name = &scene.name;
        writer
            .batch_execute(&format!(
                "SELECT occlusion.create_scene('{name}');
                 INSERT INTO {name}.feature (id, class, envelope)
                 SELECT 10 * i + j, 'House', occlusion.box3d(occlusion.point3d(13 * i, 13 * j, 0),
                                                             occlusion.point3d(13 * i + 9, 13 * j + 9, 5 + (i + j) % 4))
                 FROM generate_series(0, 9) AS i, generate_series(0, 9) AS j;
                 INSERT INTO {name}.inner_envelope SELECT id, envelope, true FROM {name}.feature;
                 SELECT occlusion.pack_tiles('{name}')"
            ))
            .expect("the scene is made");
        let mut stage = Self {
            reader: client(),
            writer,
            scene,
        };
        assert!(stage.read().len() > 50, "something is seen");
        stage
    }

    fn write(&mut self, statements: &str) {
        let statements = statements.replace("{}", &self.scene.name);
        self.writer.batch_execute(&statements).expect(&statements);
    }

    /// What the reader sees now.
    fn read(&mut self) -> Vec<String> {
        seen(&mut self.reader, &self.scene.name)
    }

    /// What the writer sees now.
    fn write_sees(&mut self) -> Vec<String> {
        seen(&mut self.writer, &self.scene.name)
    }
}

/// What is seen from all eyes, which is what the tables say without tiles.
#[track_caller]
fn seen(client: &mut Client, scene: &str) -> Vec<String> {
    let answer = format!(
        "SELECT (e.x, e.y, e.z, v.feature_id, v.class, v.envelope, v.distance)::text
         FROM {EYES}, occlusion.visible_features('{scene}', occlusion.point3d(e.x, e.y, e.z), 300) AS v
         ORDER BY 1"
    );
    let rows = client.query(&answer, &[]).expect("the scene can be asked");
    rows.iter().map(|row| row.get(0)).collect()
}

/// The same without tiles: undone again.
fn by_tables(client: &mut Client, scene: &str) -> Vec<String> {
    let begin = format!("BEGIN; TRUNCATE {scene}.tile");
    client.batch_execute(&begin).expect("tiles can go");
    let seen = seen(client, scene);
    client.batch_execute("ROLLBACK").expect("tiles come back");
    seen
}

const MOVE: &str = "UPDATE {}.feature SET envelope = occlusion.translate(envelope, 0, 0, 50) WHERE id IN (43, 44, 55)";
const OPEN: &str = "DELETE FROM {}.inner_envelope WHERE feature IN (34, 43, 44, 45, 54)";

#[test]
fn an_edit_is_seen_by_its_own_transaction_at_once_and_by_others_once_committed() {
    let mut stage = Stage::new("sessions_commit");
    let before = stage.read();
    for edit in [MOVE, OPEN, "DELETE FROM {}.feature WHERE id = 33"] {
        let before = stage.read();
        stage.write("BEGIN");
        stage.write(edit);
        assert_ne!(stage.write_sees(), before, "its own: {edit}");
        assert_eq!(stage.read(), before, "not committed: {edit}");
        let own = stage.write_sees();
        stage.write("COMMIT");
        assert_eq!(stage.read(), own, "committed: {edit}");
    }
    let after = stage.read();
    assert_ne!(after, before);
    stage.write("SELECT occlusion.pack_tiles('{}')");
    assert_eq!(stage.read(), after, "packed");
    let name = stage.scene.name.clone();
    assert_eq!(by_tables(&mut stage.writer, &name), after);
}

#[test]
fn what_is_rolled_back_never_was() {
    let mut stage = Stage::new("sessions_rollback");
    let before = stage.read();
    stage.write("BEGIN");
    stage.write(MOVE);
    // Copies of tiles that will never have been.
    stage.write("SELECT occlusion.pack_tiles('{}')");
    let moved = stage.write_sees();
    assert_ne!(moved, before);
    assert_eq!(stage.read(), before);
    stage.write("SAVEPOINT s");
    stage.write(OPEN);
    assert_ne!(stage.write_sees(), moved);
    stage.write("ROLLBACK TO s");
    assert_eq!(stage.write_sees(), moved);
    stage.write(OPEN);
    assert_ne!(
        stage.write_sees(),
        moved,
        "logged again after the savepoint"
    );
    stage.write("ROLLBACK");
    assert_eq!(stage.write_sees(), before);
    assert_eq!(stage.read(), before);
    stage.write(MOVE);
    assert_eq!(stage.read(), moved);
}

#[test]
fn an_old_snapshot_sees_the_scene_of_its_moment() {
    let mut stage = Stage::new("sessions_snapshot");
    let begin = "BEGIN ISOLATION LEVEL REPEATABLE READ";
    stage.reader.batch_execute(begin).unwrap();
    let before = stage.read();
    stage.write(MOVE);
    assert_eq!(stage.read(), before);
    stage.write("SELECT occlusion.pack_tiles('{}')");
    assert_eq!(stage.read(), before, "the tiles of its moment are read");
    stage.write(OPEN);
    stage.write("DELETE FROM {}.tile; SELECT occlusion.pack_tiles('{}')");
    assert_eq!(stage.read(), before);
    stage.reader.batch_execute("COMMIT").unwrap();
    assert_eq!(stage.read(), stage.write_sees());
    assert_ne!(stage.read(), before);
}

#[test]
fn edits_while_tiles_are_packed_are_in_the_log_or_in_the_tiles() {
    let mut stage = Stage::new("sessions_packing");
    let name = stage.scene.name.clone();
    let mut packer = client();
    // Before it reads, and not committed: it must stay in the log.
    stage.write("BEGIN");
    stage.write(MOVE);
    packer.batch_execute("BEGIN").unwrap();
    let pack = format!("SELECT occlusion.pack_tiles('{name}')");
    packer.batch_execute(&pack).unwrap();
    stage.write("COMMIT");
    // After it read.
    stage.write(OPEN);
    packer.batch_execute("COMMIT").unwrap();
    let now = stage.read();
    assert_eq!(now, by_tables(&mut stage.writer, &name));
    packer.batch_execute(&pack).unwrap();
    assert_eq!(stage.read(), now);
    let left = format!("SELECT count(*) FROM {name}.edit");
    let left: i64 = packer.query_one(&left, &[]).unwrap().get(0);
    assert_eq!(left, 0);
    // An older snapshot than the last packing's cannot pack.
    let begin = format!("BEGIN ISOLATION LEVEL REPEATABLE READ; SELECT FROM {name}.feature");
    packer.batch_execute(&begin).unwrap();
    stage.write(&format!("{}; {pack}", MOVE.replace("50)", "-50)")));
    let refused = packer.batch_execute(&pack).unwrap_err();
    assert_eq!(refused.code().map(|code| code.code()), Some("40001"));
    packer.batch_execute("ROLLBACK").unwrap();
}

#[test]
fn a_first_packing_waits_for_those_who_edit_unlogged() {
    let mut stage = Stage::new("sessions_first");
    let name = stage.scene.name.clone();
    stage.write("TRUNCATE {}.tile");
    stage.write("BEGIN");
    stage.write(MOVE);
    let logged = format!("SELECT count(*) FROM {name}.edit");
    let logged: i64 = stage.writer.query_one(&logged, &[]).unwrap().get(0);
    assert_eq!(logged, 0, "without tiles there is nothing to log");
    // Optional packing lets it be; the other one waits.
    let optional = format!("SELECT occlusion.pack_tiles('{name}', optional => true)");
    let none: i64 = stage.reader.query_one(&optional, &[]).unwrap().get(0);
    assert_eq!(none, 0);
    let packing = {
        let pack = format!("SELECT occlusion.pack_tiles('{name}')");
        thread::spawn(move || client().batch_execute(&pack))
    };
    thread::sleep(Duration::from_millis(300));
    assert!(!packing.is_finished(), "it waits");
    stage.write("COMMIT");
    packing.join().unwrap().unwrap();
    let now = stage.read();
    assert_eq!(now, by_tables(&mut stage.writer, &name));
    stage.write(OPEN);
    assert_ne!(stage.read(), now, "from now on edits are logged");
}

#[test]
fn a_packing_that_waits_while_tiles_are_truncated_is_a_first_one() {
    let mut stage = Stage::new("sessions_truncated");
    let name = stage.scene.name.clone();
    // One packing at a time: this one is in the way of the next.
    let gate = format!("BEGIN; SELECT FROM {name}.scene_info FOR UPDATE");
    stage.reader.batch_execute(&gate).unwrap();
    let packing = {
        let pack = format!("SELECT occlusion.pack_tiles('{name}')");
        thread::spawn(move || client().batch_execute(&pack))
    };
    thread::sleep(Duration::from_millis(300));
    let mut other = client();
    let truncate = format!("SET lock_timeout = '1s'; TRUNCATE {name}.tile");
    // It may be refused, if the packing keeps it out.
    let _ = other.batch_execute(&truncate);
    stage.write("BEGIN");
    stage.write("INSERT INTO {}.feature (id, class, envelope) VALUES (1000, 'Tower', 'BOX3D(60 60 0, 61 61 90)')");
    stage.reader.batch_execute("ROLLBACK").unwrap();
    thread::sleep(Duration::from_millis(300));
    stage.write("COMMIT");
    packing.join().unwrap().unwrap();
    assert_eq!(stage.read(), by_tables(&mut stage.writer, &name));
}

#[test]
fn an_old_snapshot_cannot_pack_what_was_edited_unlogged() {
    let mut stage = Stage::new("sessions_unlogged");
    let name = stage.scene.name.clone();
    stage.write("TRUNCATE {}.tile");
    let begin = format!("BEGIN ISOLATION LEVEL REPEATABLE READ; SELECT FROM {name}.feature");
    stage.reader.batch_execute(&begin).unwrap();
    stage.write(OPEN);
    // A first packing that never was leaves pages behind, and no tile.
    stage.write("BEGIN; SELECT occlusion.pack_tiles('{}'); ROLLBACK");
    let pack = format!("SELECT occlusion.pack_tiles('{name}')");
    let refused = stage.reader.batch_execute(&pack).unwrap_err();
    assert_eq!(refused.code().map(|code| code.code()), Some("25000"));
    stage.reader.batch_execute("ROLLBACK").unwrap();
    assert_eq!(stage.read(), by_tables(&mut stage.writer, &name));
}

#[test]
fn a_scene_that_is_dropped_and_made_again_is_another_one() {
    let mut stage = Stage::new("sessions_dropped");
    let name = stage.scene.name.clone();
    let before = stage.read();
    stage.write("BEGIN; SELECT occlusion.drop_scene('{}')");
    stage.write("ROLLBACK");
    assert_eq!(stage.read(), before);
    let other = format!("{name}_other");
    stage.write(&format!(
        "ALTER SCHEMA {{}} RENAME TO {other};
         SELECT occlusion.create_scene('{{}}');
         INSERT INTO {{}}.feature (id, envelope) VALUES (1, 'BOX3D(0 0 0, 1 1 1)');
         SELECT occlusion.pack_tiles('{{}}')"
    ));
    assert_eq!(stage.read().len(), 4, "one feature, seen by four eyes");
    assert_eq!(seen(&mut stage.reader, &other), before);
    stage.write(&format!("UPDATE {other}.feature SET class = 'Other'"));
    assert_eq!(stage.read().len(), 4);
    assert_ne!(seen(&mut stage.reader, &other), before);
    stage.write(&format!("SELECT occlusion.drop_scene('{other}')"));
    stage.write("SELECT occlusion.drop_scene('{}')");
    let asked =
        format!("SELECT occlusion.visible_features('{name}', occlusion.point3d(0, 0, 0), 9)");
    let gone = stage.reader.batch_execute(&asked).unwrap_err();
    assert_eq!(gone.code().map(|code| code.code()), Some("3F000"));
}

#[test]
fn rights_that_are_taken_away_count_at_once() {
    let mut database = TestDatabase::new("sessions_rights");
    let role = format!("e2e_reader_{}", std::process::id());
    database
        .client
        .batch_execute(&format!(
            "SELECT occlusion.generate_city('town', 'streets', 100, 1);
             CREATE ROLE {role};
             GRANT USAGE ON SCHEMA town, occlusion TO {role};
             GRANT SELECT ON ALL TABLES IN SCHEMA town TO {role}"
        ))
        .unwrap();
    let mut reader = Client::connect(&database.url, postgres::NoTls).unwrap();
    reader.batch_execute(&format!("SET ROLE {role}")).unwrap();
    let asked = "SELECT count(*) FROM occlusion.visible_features('town', occlusion.point3d(0, 0, 1.7), 1000)";
    let ask = |reader: &mut Client| match reader.query_one(asked, &[]) {
        Ok(row) => row.get::<_, i64>(0).to_string(),
        Err(error) => error.code().expect("from the server").code().to_owned(),
    };
    let all = ask(&mut reader);
    assert!(all.parse::<i64>().unwrap() > 10);
    for (revoke, grant) in [
        (
            "REVOKE SELECT ON town.feature FROM",
            "GRANT SELECT ON town.feature TO",
        ),
        (
            "REVOKE SELECT ON town.solid_column FROM",
            "GRANT SELECT ON town.solid_column TO",
        ),
        (
            "REVOKE USAGE ON SCHEMA town FROM",
            "GRANT USAGE ON SCHEMA town TO",
        ),
    ] {
        database
            .client
            .batch_execute(&format!("{revoke} {role}"))
            .unwrap();
        assert_eq!(ask(&mut reader), "42501", "{revoke}");
        database
            .client
            .batch_execute(&format!("{grant} {role}"))
            .unwrap();
        assert_eq!(ask(&mut reader), all, "{grant}");
    }
    drop(reader);
    database
        .client
        .batch_execute(&format!("DROP OWNED BY {role}; DROP ROLE {role}"))
        .unwrap();
}
