//! Attacks a database with sessions that edit a scene and query it, all at once: nothing that an answer leaves out
//! may be seen in the scene of the answer's snapshot.
#![forbid(unsafe_code)]

mod edit;
mod fault;
mod plan;
mod question;
mod session;
mod thing;
mod truth;

use std::process::ExitCode;
use std::sync::atomic::AtomicBool;
use std::thread;
use std::time::{Duration, Instant};

use clap::Parser;
use fastrand::Rng;
use postgres::{Client, Error, NoTls};

use edit::Editor;
use fault::Fault;
use plan::ring_sql;
use session::{Session, Tally, generate_view_cells};
use thing::{BLOCKS, HALF_STREET, PITCH};

/// The scene, and the database that it is in.
const SCENE: &str = "town";
const DATABASE: &str = "occlusion_edits";

/// Features to begin with.
const FEATURES: usize = 100;

/// Findings to print.
const PRINTED: usize = 5;

const EXAMPLES: &str = "Examples:
  edits --database postgresql://postgres@/postgres --seconds 600   ten minutes
  edits --database … --fault trigger                               finds a planted mistake

Exit status: 0 if nothing is wrong, 1 if something that can be seen was left out, 2 if the attack could not be made.";

/// Edits a scene and queries it in many sessions at once, and judges exactly all that the answers left out
///
/// Answers are those of visible_features, visible_set, visible_ahead and visible_from. Each is judged by exact rays in the scene that the same statement
/// returned. It makes a database of its own, occlusion_edits, and drops it.
#[derive(Parser, Debug)]
#[command(name = "edits", after_help = EXAMPLES)]
struct Arguments {
    /// A database on the server to attack, with max_prepared_transactions above the number of sessions
    #[arg(long, value_name = "URL")]
    database: String,
    /// How long to edit and ask
    #[arg(long, value_name = "N", default_value_t = 60)]
    seconds: u64,
    /// How many sessions edit and ask
    #[arg(long, value_name = "N", default_value_t = 8)]
    sessions: u64,
    /// Which edits and questions are made; their order is up to the sessions
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Leave the database as it is when something was left out
    #[arg(long)]
    keep: bool,
    /// Plant a mistake first
    #[arg(long, value_name = "NAME")]
    fault: Option<Fault>,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    match attack(&arguments) {
        Ok(tally) => {
            report(&tally);
            if tally.findings.is_empty() {
                ExitCode::SUCCESS
            } else {
                ExitCode::FAILURE
            }
        }
        Err(error) => {
            eprintln!("edits: {error}");
            if let Some(detail) = error.as_db_error() {
                eprintln!("{detail:?}");
            }
            ExitCode::from(2)
        }
    }
}

/// The whole attack, in a database that is dropped at its end.
fn attack(arguments: &Arguments) -> Result<Tally, Error> {
    let mut server = Client::connect(&arguments.database, NoTls)?;
    let drop = format!("DROP DATABASE IF EXISTS {DATABASE} WITH (FORCE)");
    server.batch_execute(&drop)?;
    server.batch_execute(&format!("CREATE DATABASE {DATABASE}"))?;
    let result = attack_database(arguments);
    let is_kept = |tally: &Tally| arguments.keep && !tally.findings.is_empty();
    if result.as_ref().is_ok_and(is_kept) {
        println!("kept: database {DATABASE}");
        return result;
    }
    for name in prepared(&mut server)? {
        connect(arguments)?.batch_execute(&format!("ROLLBACK PREPARED '{name}'"))?;
    }
    server.batch_execute(&drop)?;
    result
}

fn attack_database(arguments: &Arguments) -> Result<Tally, Error> {
    make_town(&mut connect(arguments)?, arguments)?;
    let stop = AtomicBool::new(false);
    let session = |number| Session::new(connect(arguments)?, SCENE, arguments.seed, number, &stop);
    let end = Instant::now() + Duration::from_secs(arguments.seconds);
    let mut tally = Tally::default();
    let results: Vec<Result<Tally, Error>> = thread::scope(|scope| {
        let run = |number| {
            let mut session = session(number)?;
            if number == 0 {
                session.maintain(end)?;
            } else {
                session.run(end)?;
            }
            Ok(session.tally)
        };
        let threads: Vec<_> = (0..=arguments.sessions)
            .map(|number| scope.spawn(move || run(number)))
            .collect();
        let joined = threads
            .into_iter()
            .map(|thread| thread.join().expect("a session"));
        joined.collect()
    });
    for result in results {
        tally.add(result?);
    }
    if !tally.findings.is_empty() {
        return Ok(tally);
    }
    // All is brought up to date, and asked once more.
    let mut last = session(arguments.sessions + 1)?;
    connect(arguments)?.batch_execute(&format!("CALL occlusion.refresh('{SCENE}')"))?;
    for _ in 0..20 {
        last.ask()?;
    }
    tally.add(last.tally);
    Ok(tally)
}

fn connect(arguments: &Arguments) -> Result<Client, Error> {
    let mut config: postgres::Config = arguments.database.parse()?;
    config.dbname(DATABASE).application_name("edits");
    config.connect(NoTls)
}

/// Transactions that a session left when it failed.
fn prepared(server: &mut Client) -> Result<Vec<String>, Error> {
    let statement = "SELECT gid FROM pg_catalog.pg_prepared_xacts WHERE database = $1";
    let rows = server.query(statement, &[&DATABASE])?;
    Ok(rows.iter().map(|row| row.get(0)).collect())
}

/// A town on a grid of streets, with all that is computed for it.
fn make_town(client: &mut Client, arguments: &Arguments) -> Result<(), Error> {
    client.batch_execute(&format!(
        "SET client_min_messages = warning; CREATE EXTENSION pg_occlusion; SELECT occlusion.create_scene('{SCENE}')"
    ))?;
    let side = PITCH * f64::from(BLOCKS) + HALF_STREET;
    for at in 0..=BLOCKS {
        let middle = f64::from(at) * PITCH;
        let (near, far) = (middle - HALF_STREET, middle + HALF_STREET);
        for [[west, south], [east, north]] in [
            [[near, -HALF_STREET], [far, side]],
            [[-HALF_STREET, near], [side, far]],
        ] {
            let ring = ring_sql(&[[west, south], [east, south], [east, north], [west, north]]);
            client.batch_execute(&format!(
                "INSERT INTO {SCENE}.street (area, eye_low, eye_high) VALUES (ARRAY[{ring}], 1.5, 2.0)"
            ))?;
        }
    }
    let mut rng = Rng::with_seed(arguments.seed);
    let mut next = 1;
    let mut editor = Editor {
        client,
        scene: SCENE,
        rng: &mut rng,
        next: &mut next,
    };
    for _ in 0..FEATURES {
        editor.insert()?;
    }
    client.batch_execute(&format!("SELECT occlusion.pack_tiles('{SCENE}')"))?;
    client.batch_execute(&generate_view_cells(SCENE))?;
    if let Some(fault) = arguments.fault {
        client.batch_execute(&fault.sql(SCENE))?;
        println!("planted: {fault:?}");
    }
    Ok(())
}

fn report(tally: &Tally) {
    for finding in tally.findings.iter().take(PRINTED) {
        println!("false occlusion: {finding}");
    }
    if tally.findings.len() > PRINTED {
        println!("and {} more", tally.findings.len() - PRINTED);
    }
    let done: Vec<String> = tally
        .done
        .iter()
        .map(|(name, count)| format!("{name} {count}"))
        .collect();
    println!("{}", done.join(", "));
    let counts = tally.counts;
    let [features, sets, ahead, from] = counts.answers;
    println!(
        "{} answers: visible_features {features}, visible_set {sets} ({} without a cell), visible_ahead {ahead}, visible_from {from}",
        counts.answers.iter().sum::<u64>(),
        counts.unused
    );
    println!(
        "{} judgements of what was left out; of {} returned features that were looked at, {} were seen",
        counts.left_out, counts.looked_at, counts.seen
    );
    println!("{} false occlusions", counts.false_occlusions);
}
