//! `occlusion generate`: has the occlusion volumes of a scene computed.

use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use clap::Args;
use indicatif::ProgressBar;
use postgres::error::SqlState;
use postgres::{CancelToken, Client, NoTls};

use crate::database::{Database, quoted};
use crate::failure::{EXIT_STATUS, Failure};
use crate::terminal::{self, GOOD, grouped};

const EXAMPLES: &str = "Examples:
  occlusion generate delft
  occlusion generate delft --smallest 0.5 --range 500";

/// How often Ctrl-C is looked for.
const HEED: Duration = Duration::from_millis(50);

/// How often the server is asked how far it is.
const POLL: Duration = Duration::from_millis(500);

/// Computes the occlusion volumes of a scene, on the server
///
/// Replaces what is there. Batches are committed as they are done; Ctrl-C stops the server within a
/// second, and what was committed stays.
#[derive(Args, Debug)]
#[command(after_help = format!("{EXAMPLES}\n\n{EXIT_STATUS}"))]
pub struct Generate {
    /// Scene
    scene: String,
    /// Least width of a lane of street, metres
    #[arg(long, value_name = "METRES", default_value_t = 1.0)]
    smallest: f64,
    /// How far observers will look at most, metres; without it any distance
    #[arg(long, value_name = "METRES")]
    range: Option<f64>,
    /// Square metres of street that each volume must add; without it the larger of 4 times the
    /// smallest squared and a 20,000th of the street area
    #[arg(long, value_name = "M2")]
    worth: Option<f64>,
    #[command(flatten)]
    database: Database,
}

impl Generate {
    /// Runs the command.
    pub fn run(&self) -> Result<(), Failure> {
        let began = Instant::now();
        let interrupts = count_interrupts()?;
        let mut watcher = self.database.connect()?;
        watcher.execute("SELECT occlusion.require_scene($1)", &[&self.scene])?;
        let bar = terminal::bar(0, "occlusion volumes");
        let noticed = bar.clone();
        let worker = self.database.connect_heeding(move |notice| {
            if noticed.is_hidden() {
                eprintln!("{notice}");
            }
        })?;
        let token = worker.cancel_token();
        let call = self.start(worker);
        self.watch(&call, &mut watcher, &bar, &interrupts, &token)?;
        bar.finish_and_clear();
        let done = call
            .join()
            .map_err(|_| Failure::machine("the connection's thread died"))?;
        done.map_err(|error| match error.code() {
            Some(&SqlState::QUERY_CANCELED) if interrupts.load(Ordering::Relaxed) > 0 => {
                Failure::Cancelled
            }
            _ => error.into(),
        })?;
        self.report(&mut watcher, began.elapsed())
    }

    /// Calls the procedure on a thread of its own.
    fn start(&self, mut worker: Client) -> JoinHandle<Result<(), postgres::Error>> {
        let (scene, smallest, range, worth) =
            (self.scene.clone(), self.smallest, self.range, self.worth);
        thread::spawn(move || {
            let call = "CALL occlusion.generate_occlusion_volumes($1, $2, $3, $4)";
            worker
                .execute(call, &[&scene, &smallest, &range, &worth])
                .map(|_| ())
        })
    }

    /// Shows progress until the call ends, and passes Ctrl-C on to the server.
    fn watch(
        &self,
        call: &JoinHandle<Result<(), postgres::Error>>,
        watcher: &mut Client,
        bar: &ProgressBar,
        interrupts: &AtomicU32,
        token: &CancelToken,
    ) -> Result<(), Failure> {
        let mut asked = Instant::now();
        let mut passed_on = false;
        while !call.is_finished() {
            thread::sleep(HEED);
            if interrupts.load(Ordering::Relaxed) > 0 && !passed_on {
                passed_on = true;
                token.cancel_query(NoTls)?;
            }
            if asked.elapsed() >= POLL {
                asked = Instant::now();
                self.show(watcher, bar)?;
            }
        }
        Ok(())
    }

    fn show(&self, watcher: &mut Client, bar: &ProgressBar) -> Result<(), Failure> {
        let statement = "SELECT done, total FROM occlusion.progress($1) \
                         WHERE task = 'generate_occlusion_volumes' AND state = 'running'";
        if let Some(row) = watcher.query_opt(statement, &[&self.scene])? {
            let [done, total] = [0, 1].map(|column| row.get::<_, i64>(column).unsigned_abs());
            bar.set_length(total);
            bar.set_position(done);
        }
        Ok(())
    }

    fn report(&self, client: &mut Client, took: Duration) -> Result<(), Failure> {
        let schema = quoted(&self.scene);
        let statement = format!(
            "SELECT count(*), count(DISTINCT occluder), count(DISTINCT occludee), \
                    (SELECT count(*) FROM {schema}.feature) \
             FROM {schema}.occlusion_volume"
        );
        let row = client.query_one(&statement, &[])?;
        let [volumes, occluders, hidden, features] = [0, 1, 2, 3].map(|column| {
            let count: i64 = row.get(column);
            grouped(usize::try_from(count).unwrap_or_default())
        });
        anstream::println!(
            "{GOOD}generated{GOOD:#} {volumes} occlusion volumes of {} in {:.1} s\n  \
             {hidden} of {features} features are hidden somewhere, {occluders} hide others",
            self.scene,
            took.as_secs_f64()
        );
        Ok(())
    }
}

/// Counts each Ctrl-C from now on; the second one ends the program at once.
fn count_interrupts() -> Result<Arc<AtomicU32>, Failure> {
    let count = Arc::new(AtomicU32::new(0));
    let counted = Arc::clone(&count);
    let handler = move || {
        if counted.fetch_add(1, Ordering::Relaxed) > 0 {
            std::process::exit(Failure::Cancelled.exit_code().into());
        }
    };
    ctrlc::set_handler(handler).map_err(Failure::machine)?;
    Ok(count)
}
