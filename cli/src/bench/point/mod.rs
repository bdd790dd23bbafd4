//! `occlusion bench point`: what can be seen from a point, answered live, and what others answer.

mod contender;
mod observers;
mod race;

use clap::Args;
use clap::builder::RangedU64ValueParser;
use postgres::Client;

use crate::bench::format::Format;
use crate::database::Database;
use crate::failure::{EXIT_STATUS, Failure};
use crate::terminal;
use contender::Contender;
use race::Figures;

const EXAMPLES: &str = "Examples:
  occlusion bench point city --database postgresql://me@localhost/scratch
  occlusion bench point delft city --range 500 --range 2000 --format markdown";

/// Measures what visible_features takes, and its rivals
///
/// Observers stand at different places of the streets of each scene, and none is asked twice in a
/// round. They are asked one at a time, in rounds that take turns, and all in one statement. The
/// rivals: PostGIS with an index in space, and in plan with a filter on heights, which find what is in range and
/// not what is hidden; the way of 2004, which is the same less what occlusion volumes hide, where the scene has some; and
/// a sight line of PostGIS to the middle of each building, which misses what is seen elsewhere.
/// The first call of new connections is measured too.
///
/// It needs scenes with streets, creates the extension postgis where it is missing, and a schema
/// occlusion_bench_point, which it drops, also when it was there before. "make bench-point" makes the scenes.
#[derive(Args, Debug)]
#[command(after_help = format!("{EXAMPLES}\n\n{EXIT_STATUS}"))]
pub struct Point {
    /// Scenes to ask
    #[arg(required = true, value_name = "SCENE")]
    scenes: Vec<String>,
    /// How far observers see, metres; may be given several times
    #[arg(long = "range", value_name = "METRES", default_values_t = [500.0, 2000.0])]
    ranges: Vec<f64>,
    /// Different observers
    #[arg(long, value_name = "N", default_value_t = 500,
          value_parser = RangedU64ValueParser::<usize>::new().range(1..=100_000))]
    observers: usize,
    /// How often each is asked
    #[arg(long, value_name = "N", default_value_t = 3,
          value_parser = RangedU64ValueParser::<usize>::new().range(1..=1000))]
    rounds: usize,
    /// Seed of the observers
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: i64,
    /// How tables are printed
    #[arg(long, value_enum, default_value_t = Format::Plain)]
    format: Format,
    #[command(flatten)]
    database: Database,
}

impl Point {
    /// Runs the command.
    pub fn run(&self) -> Result<(), Failure> {
        let mut client = self.database.connect()?;
        let has_postgis = contender::find_postgis(&mut client)?;
        if !has_postgis {
            anstream::eprintln!("the server has no PostGIS: its ways are left out");
        }
        for scene in &self.scenes {
            let spinner = terminal::spinner("making observers and rivals' tables");
            observers::place(&mut client, scene, self.observers, self.seed)?;
            if has_postgis {
                contender::prepare(&mut client, scene)?;
            }
            let has_volumes = contender::has_volumes(&mut client, scene)?;
            spinner.finish_and_clear();
            for &range in &self.ranges {
                self.measure(&mut client, scene, range, has_postgis, has_volumes)?;
            }
        }
        Ok(client.batch_execute(contender::CLOSE)?)
    }

    fn measure(
        &self,
        client: &mut Client,
        scene: &str,
        range: f64,
        has_postgis: bool,
        has_volumes: bool,
    ) -> Result<(), Failure> {
        let contenders = Contender::all(scene, range, has_postgis, has_volumes);
        let bar = terminal::bar(contenders.len(), "ways");
        let figures = race::run(client, &contenders, self.observers, self.rounds, &bar)?;
        bar.finish_and_clear();
        let first = race::first_calls(|| self.database.connect(), &contenders[0])?;
        println!("{}", self.format.title(&format!("{scene}, {range} m")));
        println!("{}\n", self.table(&contenders, &figures));
        println!(
            "Connecting and the first call: {:.2} and {:.2} ms in the median.\n",
            first.connect, first.call
        );
        Ok(())
    }

    fn table(&self, contenders: &[Contender], figures: &[Figures]) -> String {
        let ours = figures[0];
        let rows: Vec<Vec<String>> = contenders
            .iter()
            .zip(figures)
            .map(|(contender, figures)| {
                vec![
                    contender.name.to_owned(),
                    figures.observers.to_string(),
                    format!("{:.1}", figures.rows),
                    format!("{:.3}", figures.median),
                    format!("{:.3}", figures.p95),
                    format!("{:.2}", figures.median / ours.median),
                    optional(figures.batch, 3),
                    optional(figures.batch.zip(ours.batch).map(|(a, b)| a / b), 2),
                ]
            })
            .collect();
        let heading = [
            "way",
            "observers",
            "rows",
            "ms",
            "p95",
            "ratio",
            "ms in batch",
            "ratio",
        ];
        let mut right = [true; 8];
        right[0] = false;
        self.format.table(&heading, &right, &rows)
    }
}

fn optional(number: Option<f64>, digits: usize) -> String {
    number.map_or("–".to_owned(), |number| format!("{number:.digits$}"))
}
