//! `occlusion generate`: has the occlusion volumes or the view cells of a scene computed.

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
  occlusion generate delft --smallest 0.5 --range 500
  occlusion generate delft --cells --range 500";

/// How often Ctrl-C is looked for.
const HEED: Duration = Duration::from_millis(50);

/// How often the server is asked how far it is.
const POLL: Duration = Duration::from_millis(500);

/// Computes the occlusion volumes of a scene, or its view cells, on the server
///
/// Replaces what is there. Batches are committed as they are done; Ctrl-C stops the server within a
/// second, and what was committed stays. View cells that were begun in the same way are gone on with, and
/// several of these commands may share the work.
#[derive(Args, Debug)]
#[command(after_help = format!("{EXAMPLES}\n\n{EXIT_STATUS}"))]
pub struct Generate {
    /// Scene
    scene: String,
    /// View cells instead: what can be seen from everywhere in the streets
    #[arg(long)]
    cells: bool,
    /// Least width of a lane of street, metres, 1 without it; of view cells least edge, 4
    #[arg(long, value_name = "METRES")]
    smallest: Option<f64>,
    /// How far observers will look at most, metres; without it any distance, and 500 for view cells
    #[arg(long, value_name = "METRES")]
    range: Option<f64>,
    /// Square metres of street that each volume must add; without it the larger of 4 times the
    /// smallest squared and a 20,000th of the street area
    #[arg(long, value_name = "M2", conflicts_with = "cells")]
    worth: Option<f64>,
    /// Longest edge of a view cell, metres
    #[arg(
        long,
        value_name = "METRES",
        requires = "cells",
        default_value_t = 16.0
    )]
    largest: f64,
    /// Half edge of the smallest parts of a view cell that are told apart, metres
    #[arg(
        long,
        value_name = "METRES",
        requires = "cells",
        default_value_t = 0.25
    )]
    finest: f64,
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
        let bar = terminal::bar(0, self.what());
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

    /// What is made.
    fn what(&self) -> &'static str {
        match self.cells {
            true => "squares of view cells",
            false => "occlusion volumes",
        }
    }

    /// Calls the procedure on a thread of its own.
    fn start(&self, mut worker: Client) -> JoinHandle<Result<(), postgres::Error>> {
        let (scene, range, worth) = (self.scene.clone(), self.range, self.worth);
        let (smallest, largest, finest) = (self.smallest, self.largest, self.finest);
        let cells = self.cells;
        thread::spawn(move || {
            let done = if cells {
                let call = "CALL occlusion.generate_view_cells($1, $2, $3, $4, $5)";
                let range = range.unwrap_or(500.0);
                let smallest = smallest.unwrap_or(4.0);
                worker.execute(call, &[&scene, &range, &smallest, &largest, &finest])
            } else {
                let call = "CALL occlusion.generate_occlusion_volumes($1, $2, $3, $4)";
                let smallest = smallest.unwrap_or(1.0);
                worker.execute(call, &[&scene, &smallest, &range, &worth])
            };
            done.map(|_| ())
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
        let task = match self.cells {
            true => "generate_view_cells",
            false => "generate_occlusion_volumes",
        };
        let statement = "SELECT done, total FROM occlusion.progress($1) \
                         WHERE task = $2 AND state = 'running'";
        if let Some(row) = watcher.query_opt(statement, &[&self.scene, &task])? {
            let [done, total] = [0, 1].map(|column| row.get::<_, i64>(column).unsigned_abs());
            bar.set_length(total);
            bar.set_position(done);
        }
        Ok(())
    }

    fn report(&self, client: &mut Client, took: Duration) -> Result<(), Failure> {
        match self.cells {
            true => self.report_cells(client, took),
            false => self.report_volumes(client, took),
        }
    }

    fn report_cells(&self, client: &mut Client, took: Duration) -> Result<(), Failure> {
        let schema = quoted(&self.scene);
        let statement = format!(
            "SELECT count(*), coalesce(avg(occlusion.cardinality(visible)), 0)::float8, \
                    coalesce(avg(pg_column_size(visible)), 0)::float8 \
             FROM {schema}.view_cell"
        );
        let row = client.query_one(&statement, &[])?;
        let cells = usize::try_from(row.get::<_, i64>(0)).unwrap_or_default();
        let [features, bytes] = [1, 2].map(|column| row.get::<_, f64>(column));
        anstream::println!(
            "{GOOD}generated{GOOD:#} {} view cells of {} in {:.1} s\n  \
             {features:.0} features may be seen from one in the mean, a set takes {bytes:.0} bytes",
            grouped(cells),
            self.scene,
            took.as_secs_f64()
        );
        Ok(())
    }

    fn report_volumes(&self, client: &mut Client, took: Duration) -> Result<(), Failure> {
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
