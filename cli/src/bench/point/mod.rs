//! `occlusion bench point`: what can be seen from a point, answered live, and what others answer.

mod contender;
mod race;
mod table;
#[cfg(feature = "embree")]
mod trial;

use clap::Args;
use clap::builder::RangedU64ValueParser;
use postgres::Client;

use crate::bench::format::Format;
use crate::bench::observers;
use crate::bench::table::Table;
use crate::database::Database;
use crate::failure::{EXIT_STATUS, Failure};
use crate::terminal;
#[cfg(feature = "embree")]
use crate::terminal::BAD;
use contender::Contender;

/// Schema of all that the benchmark makes.
const SCHEMA: &str = "occlusion_bench_point";

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
/// Built with the feature "embree", it also looks around with item buffers of Embree, and says of every way
/// what it returns too much (Q) and what it misses, against rays that are cast exactly. An answer of this
/// extension that misses something ends it with status 1.
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
    /// The first so many observers are judged: what is truly visible, and what item buffers show
    #[cfg(feature = "embree")]
    #[arg(long, value_name = "N", default_value_t = 50)]
    truth: usize,
    /// How tables are printed
    #[arg(long, value_enum, default_value_t = Format::Plain)]
    format: Format,
    #[command(flatten)]
    database: Database,
}

impl Point {
    /// Runs the command; whether no answer that claims to be complete lacks something visible.
    pub fn run(&self) -> Result<bool, Failure> {
        let mut client = self.database.connect()?;
        let has_postgis = contender::find_postgis(&mut client)?;
        if !has_postgis {
            anstream::eprintln!("the server has no PostGIS: its ways are left out");
        }
        #[cfg(not(feature = "embree"))]
        anstream::eprintln!(
            "built without Embree: item buffers, Q and what is missed are left out"
        );
        let mut is_sound = true;
        for scene in &self.scenes {
            let spinner = terminal::spinner("making observers and rivals' tables");
            observers::place(&mut client, SCHEMA, scene, self.observers, self.seed)?;
            if has_postgis {
                contender::prepare(&mut client, scene)?;
            }
            let has_volumes = contender::has_volumes(&mut client, scene)?;
            spinner.finish_and_clear();
            for &range in &self.ranges {
                let contenders = Contender::all(scene, range, has_postgis, has_volumes);
                is_sound &= self.measure(&mut client, scene, range, &contenders)?;
            }
        }
        client.batch_execute(contender::CLOSE)?;
        Ok(is_sound)
    }

    fn measure(
        &self,
        client: &mut Client,
        scene: &str,
        range: f64,
        contenders: &[Contender],
    ) -> Result<bool, Failure> {
        let bar = terminal::bar(contenders.len(), "ways");
        let figures = race::run(client, contenders, self.observers, self.rounds, &bar)?;
        bar.finish_and_clear();
        let first = race::first_calls(|| self.database.connect(), &contenders[0])?;
        let mut table = Table::of(contenders, &figures);
        table.remarks.push(format!(
            "Connecting and the first call: {:.2} and {:.2} ms in the median.",
            first.connect, first.call
        ));
        let is_sound = self.judge(
            client,
            scene,
            range,
            contenders,
            &mut table,
            figures[0].median,
        )?;
        println!("{}", self.format.title(&format!("{scene}, {range} m")));
        println!("{}\n", table.text(self.format));
        Ok(is_sound)
    }

    /// Adds what the answers are worth; whether nothing is missing from those that claim to be complete.
    #[cfg(feature = "embree")]
    fn judge(
        &self,
        client: &mut Client,
        scene: &str,
        range: f64,
        contenders: &[Contender],
        table: &mut Table,
        ours: f64,
    ) -> Result<bool, Failure> {
        if self.truth == 0 {
            return Ok(true);
        }
        let bar = terminal::bar(self.truth.min(self.observers), "observers");
        let mut trial = trial::run(client, scene, range, contenders, self.truth, &bar)?;
        bar.finish_and_clear();
        trial.add_to(table, ours);
        for fault in &trial.false_occlusions {
            anstream::eprintln!("{BAD}false occlusion:{BAD:#} {fault}");
        }
        Ok(trial.false_occlusions.is_empty())
    }

    #[cfg(not(feature = "embree"))]
    fn judge(
        &self,
        _: &mut Client,
        _: &str,
        _: f64,
        _: &[Contender],
        _: &mut Table,
        _: f64,
    ) -> Result<bool, Failure> {
        Ok(true)
    }
}
