//! `occlusion bench edits`: what it costs that answers are right at every moment.

mod cost;
mod counters;
mod repair;

use clap::Args;
use clap::builder::RangedU64ValueParser;

use crate::bench::format::Format;
use crate::bench::observers;
use crate::bench::table::Table;
use crate::database::Database;
use crate::failure::{EXIT_STATUS, Failure};
use crate::terminal;

/// Schema of all that the benchmark makes.
const SCHEMA: &str = "occlusion_bench_edits";

const EXAMPLES: &str = "Examples:
  occlusion bench edits town --database postgresql://me@localhost/scratch
  occlusion bench edits delft --demolish 10 --format markdown";

/// Measures edits, repairs, and the counting of queries
///
/// Edits of so many rows run with and without the triggers of the scene, in turn, and are rolled back; the
/// difference is what each row costs. Queries run with and without being counted, in turn. Then features are
/// deleted, one after the other, FOR GOOD, each followed by a refresh, while another session asks what can be seen; it
/// asks as often before, when nothing else goes on.
///
/// It needs a superuser, and scenes with streets, of which those without view cells (occlusion generate --cells) are only packed again.
/// It makes a schema occlusion_bench_edits, which it drops, also when it was there before. "make bench-edits" makes the
/// scenes.
#[derive(Args, Debug)]
#[command(after_help = format!("{EXAMPLES}\n\n{EXIT_STATUS}"))]
pub struct Edits {
    /// Scenes to edit, of a scratch database
    #[arg(required = true, value_name = "SCENE")]
    scenes: Vec<String>,
    /// Rows of an edit; may be given several times
    #[arg(long = "rows", value_name = "N", default_values_t = [1, 10_000],
          value_parser = RangedU64ValueParser::<usize>::new().range(1..=1_000_000))]
    rows: Vec<usize>,
    /// How often each edit runs, and each observer is asked
    #[arg(long, value_name = "N", default_value_t = 15,
          value_parser = RangedU64ValueParser::<usize>::new().range(1..=10_000))]
    rounds: usize,
    /// How many features are deleted for good
    #[arg(long, value_name = "N", default_value_t = 5,
          value_parser = RangedU64ValueParser::<usize>::new().range(0..=10_000))]
    demolish: usize,
    /// Different observers
    #[arg(long, value_name = "N", default_value_t = 500,
          value_parser = RangedU64ValueParser::<usize>::new().range(1..=100_000))]
    observers: usize,
    /// How far they see, metres
    #[arg(long, value_name = "METRES", default_value_t = 500.0)]
    range: f64,
    /// Seed of the observers, and of what is deleted
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: i64,
    /// How tables are printed
    #[arg(long, value_enum, default_value_t = Format::Plain)]
    format: Format,
    #[command(flatten)]
    database: Database,
}

impl Edits {
    /// Runs the command.
    pub fn run(&self) -> Result<bool, Failure> {
        let mut client = self.database.connect()?;
        for scene in &self.scenes {
            let spinner = terminal::spinner("placing observers");
            observers::place(&mut client, SCHEMA, scene, self.observers, self.seed)?;
            spinner.finish_and_clear();
            let bar = terminal::bar(self.rounds * self.rows.len(), "edits");
            let costs = cost::measure(&mut client, scene, &self.rows, self.rounds, &bar)?;
            bar.finish_and_clear();
            self.print(&format!("{scene}, edits"), &costs);
            // Of what was rolled back the logs are full: nobody else cleans them up in time.
            client.batch_execute("VACUUM ANALYZE")?;
            let bar = terminal::bar(counters::QUESTIONS * self.rounds, "queries");
            let counted = counters::measure(&mut client, scene, self.range, self.rounds, &bar)?;
            bar.finish_and_clear();
            self.print(&format!("{scene}, queries"), &counted);
            if self.demolish > 0 {
                let bar = terminal::bar(self.demolish, "repairs");
                let repairs = repair::measure(self, scene, &mut client, &bar)?;
                bar.finish_and_clear();
                self.print(&format!("{scene}, repairs"), &repairs);
            }
        }
        client.batch_execute(&format!("DROP SCHEMA {SCHEMA} CASCADE"))?;
        Ok(true)
    }

    fn print(&self, title: &str, table: &Table) {
        println!("{}", self.format.title(title));
        println!("{}\n", table.text(self.format));
    }
}
