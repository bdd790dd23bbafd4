//! `occlusion bench index`: the indexes of `box3d` and their rivals on the same boxes.

mod agreement;
mod arena;
mod contender;
mod data_set;
mod outcome;
mod report;
mod search;
mod timing;
mod volumes;

use clap::Args;
use clap::builder::RangedU64ValueParser;
use indicatif::ProgressBar;
use postgres::Client;

use crate::bench::format::Format;
use crate::database::Database;
use crate::failure::{EXIT_STATUS, Failure};
use crate::terminal::{self, BAD};
use arena::Arena;
use contender::{Contender, Kind, SUPERUSER};
use data_set::DataSet;
use outcome::{Entry, Outcome};
use timing::Effort;

const EXAMPLES: &str = "Examples:
  occlusion bench index --rows 100000 --database postgresql://me@localhost/scratch
  occlusion bench index --format markdown";

/// How many boxes overlap a point.
const DEPTHS: [usize; 2] = [200, 2000];

/// Of so many volumes at the most one overlaps a point.
const LEAST_SPREAD: usize = 10;

/// Measures the indexes of box3d against those of PostGIS and cube
///
/// The boxes of a generated city, and boxes like occlusion volumes that overlap each other many
/// times, are put into a table for each index, all with the same other columns in the same order.
/// Each index is built, and asked for what overlaps a box, is in a sector or a cone, holds a point,
/// and is nearest to one: by different searches one at a time, in rounds that take turns, and by
/// one statement for all searches. Answers are compared.
///
/// Run it in a database of its own: it creates the extensions postgis and cube where they are
/// missing, and a schema occlusion_bench_index, which it drops, also when it was there before.
/// An extension that the server lacks is reported as absent. For steady times the server and
/// this program share one core that has nothing else to do; "make bench-index" sees to that.
#[derive(Args, Debug)]
#[command(after_help = format!("{EXAMPLES}\n\n{EXIT_STATUS}"))]
pub struct Index {
    /// Boxes of each data set; without it cities of 100,000 and 1,000,000, and 1,000,000 volumes
    #[arg(long, value_name = "N", value_parser = RangedU64ValueParser::<usize>::new().range(1..=100_000_000))]
    rows: Option<usize>,
    /// Different searches of each kind
    #[arg(long, value_name = "N", default_value_t = 1000,
          value_parser = RangedU64ValueParser::<usize>::new().range(1..=1_000_000))]
    searches: usize,
    /// How often each search is made
    #[arg(long, value_name = "N", default_value_t = 3,
          value_parser = RangedU64ValueParser::<usize>::new().range(1..=1000))]
    rounds: usize,
    /// Seed of boxes and searches
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// How tables are printed
    #[arg(long, value_enum, default_value_t = Format::Plain)]
    format: Format,
    #[command(flatten)]
    database: Database,
}

/// A data set that is to be made.
#[derive(Clone, Copy)]
enum Plan {
    City(usize),
    Volumes(usize, usize),
}

impl Index {
    /// Runs the command; whether all answers agree.
    pub fn run(&self) -> Result<bool, Failure> {
        let mut client = self.database.connect()?;
        let absent = absences(&mut client)?;
        let mut outcomes = Vec::new();
        let mut differences = Vec::new();
        for plan in self.plans() {
            let outcome = self.measure(&mut client, plan, &absent, &mut differences)?;
            println!("{}", self.format.outcome(&outcome));
            outcomes.push(outcome);
        }
        println!("{}", self.format.goals(&outcome::goals(&outcomes)));
        for difference in &differences {
            anstream::eprintln!("{BAD}error:{BAD:#} answers differ: {difference}");
        }
        Ok(differences.is_empty())
    }

    fn plans(&self) -> Vec<Plan> {
        let cities = self
            .rows
            .map_or(vec![100_000, 1_000_000], |rows| vec![rows]);
        let volumes = self.rows.unwrap_or(1_000_000);
        let most = (volumes / LEAST_SPREAD).max(1);
        let depths = DEPTHS.map(|depth| Plan::Volumes(volumes, depth.min(most)));
        cities.into_iter().map(Plan::City).chain(depths).collect()
    }

    fn measure(
        &self,
        client: &mut Client,
        plan: Plan,
        absent: &[(&str, String)],
        differences: &mut Vec<String>,
    ) -> Result<Outcome, Failure> {
        let making = terminal::spinner("making boxes");
        let data = match plan {
            Plan::City(rows) => DataSet::city(rows, self.seed),
            Plan::Volumes(rows, depth) => DataSet::volumes(rows, depth, self.seed),
        };
        let searches = search::searches(&data, self.searches, self.seed);
        let mut arena = Arena::new(client, &data, &searches)?;
        making.finish_and_clear();
        let unsorted = matches!(plan, Plan::Volumes(_, depth) if depth > DEPTHS[0]);
        let reason = |contender: &Contender| {
            contender.needs().find_map(|need| {
                let (_, reason) = absent.iter().find(|(name, _)| *name == need)?;
                Some(reason.clone())
            })
        };
        let (out, contenders): (Vec<Contender>, Vec<Contender>) = Contender::all(unsorted)
            .into_iter()
            .partition(|c| reason(c).is_some());
        let bar = terminal::bar(contenders.len() * (1 + Kind::ALL.len()), "indexes");
        let entries = self.compete(&mut arena, &contenders, &bar, differences)?;
        let floor = timing::floor(arena.client(), &contenders[0], self.effort())?;
        bar.finish_and_clear();
        arena.close()?;
        Ok(Outcome {
            name: data.name,
            depth: data.depth,
            entries,
            absent: out
                .iter()
                .filter_map(|c| Some((c.name, reason(c)?)))
                .collect(),
            floor,
        })
    }

    /// Builds all indexes, then makes the searches.
    fn compete(
        &self,
        arena: &mut Arena<'_>,
        contenders: &[Contender],
        bar: &ProgressBar,
        differences: &mut Vec<String>,
    ) -> Result<Vec<Entry>, Failure> {
        let mut entries = Vec::new();
        for &contender in contenders {
            let built = arena.enter(&contender)?;
            entries.push(Entry {
                contender,
                built,
                figures: Default::default(),
            });
            bar.inc(1);
        }
        for kind in Kind::ALL {
            bar.set_message(kind.name());
            for contender in &contenders[1..] {
                let difference =
                    agreement::difference(arena.client(), &contenders[0], contender, kind)?;
                differences.extend(difference);
            }
            let figures = timing::race(arena.client(), contenders, kind, self.effort())?;
            for (entry, figures) in entries.iter_mut().zip(figures) {
                entry.figures[kind as usize] = figures;
            }
            bar.inc(contenders.len() as u64);
        }
        Ok(entries)
    }

    fn effort(&self) -> Effort {
        Effort {
            searches: self.searches,
            rounds: self.rounds,
        }
    }
}

/// What contenders need and cannot have, and why. Creates the extensions of rivals.
fn absences(client: &mut Client) -> Result<Vec<(&'static str, String)>, Failure> {
    let mut absent = Vec::new();
    for name in ["postgis", "cube"] {
        if let Some(reason) = absence(client, name)? {
            absent.push((name, reason));
        }
    }
    let statement = "SELECT rolsuper FROM pg_catalog.pg_roles WHERE rolname = current_user";
    if !client.query_one(statement, &[])?.get::<_, bool>(0) {
        let reason = "only a superuser makes operator classes";
        absent.push((SUPERUSER, reason.to_owned()));
    }
    Ok(absent)
}

/// Creates an extension where it is missing; why that cannot be.
fn absence(client: &mut Client, extension: &str) -> Result<Option<String>, Failure> {
    let available = "SELECT FROM pg_catalog.pg_available_extensions WHERE name = $1";
    if client.query_opt(available, &[&extension])?.is_none() {
        return Ok(Some(format!("the server has no extension {extension}")));
    }
    let create = format!("CREATE EXTENSION IF NOT EXISTS {extension}");
    let refused = client.batch_execute(&create).err();
    Ok(refused.map(|error| {
        let refusal = Failure::from(error);
        format!("extension {extension} cannot be created: {refusal}")
    }))
}
