//! How long searches take, and how many pages they read.

use std::time::{Duration, Instant};

use postgres::{Client, Statement, Transaction};

use super::contender::{Contender, Kind};
use crate::bench::quantile::quantile;
use crate::failure::Failure;

/// After so long a round of single searches ends early.
const ROUND: Duration = Duration::from_secs(5);

/// Milliseconds for all batches of a contender; those that would take longer are left out.
const PATIENCE: f64 = 20e3;

/// How often all searches are made in one statement; the median counts.
const BATCHES: usize = 5;

/// What searches of one kind cost with one index.
#[derive(Clone, Copy, Debug)]
pub struct Figures {
    /// Rows that a search finds, in the mean.
    pub rows: f64,
    /// Median milliseconds of a search, at the client.
    pub median: f64,
    /// Milliseconds that 95 of 100 searches do not exceed.
    pub p95: f64,
    /// Milliseconds for each search where one statement makes all.
    pub batch: Option<f64>,
    /// Pages of the index that a search reads, in the mean.
    pub index_pages: f64,
    /// Pages of the table.
    pub table_pages: f64,
}

/// How often searches are made.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// How many different ones there are.
    pub searches: usize,
    /// How often each is made.
    pub rounds: usize,
}

/// A contender on its way.
struct Runner {
    single: Statement,
    batch: Statement,
    figures: Figures,
    times: Vec<f64>,
    batches: Vec<f64>,
}

/// Has contenders search in turn, a round each, so that what else the machine does hits all of
/// them; `None` for who cannot answer.
pub fn race(
    client: &mut Client,
    contenders: &[Contender],
    kind: Kind,
    effort: Effort,
) -> Result<Vec<Option<Figures>>, Failure> {
    let mut runners = Vec::new();
    for contender in contenders {
        runners.push(Runner::warm(client, contender, kind, effort)?);
    }
    for _ in 0..effort.rounds {
        for runner in runners.iter_mut().flatten() {
            runner.search(client, effort)?;
        }
    }
    for _ in 0..BATCHES {
        for runner in runners.iter_mut().flatten() {
            runner.search_all(client, effort)?;
        }
    }
    let done = runners
        .into_iter()
        .map(|runner| Some(runner?.figures(effort)));
    Ok(done.collect())
}

/// Median milliseconds of a round trip that only looks up a search.
pub fn floor(client: &mut Client, contender: &Contender, effort: Effort) -> Result<f64, Failure> {
    let look_up = format!(
        "SELECT q.id FROM {}_search AS q WHERE q.id = $1",
        contender.table
    );
    let look_up = client.prepare(&look_up)?;
    let mut times = Vec::new();
    for round in 0..=effort.rounds {
        let took = timed_round(client, &look_up, effort)?;
        // The first round warms up.
        times.extend(took.into_iter().filter(|_| round > 0));
    }
    Ok(quantile(&mut times, 0.5))
}

impl Runner {
    /// Prepares statements and makes every search once, which counts rows and pages.
    fn warm(
        client: &mut Client,
        contender: &Contender,
        kind: Kind,
        effort: Effort,
    ) -> Result<Option<Self>, Failure> {
        let (Some(single), Some(batch)) = (contender.single(kind), contender.batch(kind)) else {
            return Ok(None);
        };
        let (single, batch) = (client.prepare(&single)?, client.prepare(&batch)?);
        let mut transaction = client.transaction()?;
        let before = pages(&mut transaction, contender)?;
        let (mut searches, mut rows) = (0, 0);
        let began = Instant::now();
        for id in 0..effort.searches {
            if began.elapsed() > ROUND {
                break;
            }
            rows += transaction.query(&single, &[&(id as i32)])?.len();
            searches += 1;
        }
        let after = pages(&mut transaction, contender)?;
        transaction.commit()?;
        let mean = |count: f64| count / f64::from(searches);
        let figures = Figures {
            rows: mean(rows as f64),
            median: f64::NAN,
            p95: f64::NAN,
            batch: None,
            index_pages: mean(after[0] - before[0]),
            table_pages: mean(after[1] - before[1]),
        };
        Ok(Some(Self {
            single,
            batch,
            figures,
            times: Vec::new(),
            batches: Vec::new(),
        }))
    }

    fn search(&mut self, client: &mut Client, effort: Effort) -> Result<(), Failure> {
        self.times
            .extend(timed_round(client, &self.single, effort)?);
        Ok(())
    }

    fn search_all(&mut self, client: &mut Client, effort: Effort) -> Result<(), Failure> {
        let mean = self.times.iter().sum::<f64>() / self.times.len() as f64;
        let spent: f64 = self.batches.iter().sum();
        if spent + mean * effort.searches as f64 > PATIENCE {
            return Ok(());
        }
        let began = Instant::now();
        client.query_one(&self.batch, &[])?;
        self.batches.push(milliseconds(began));
        Ok(())
    }

    fn figures(mut self, effort: Effort) -> Figures {
        let batch = |batches: &mut Vec<f64>| quantile(batches, 0.5) / effort.searches as f64;
        Figures {
            median: quantile(&mut self.times, 0.5),
            p95: quantile(&mut self.times, 0.95),
            batch: (!self.batches.is_empty()).then(|| batch(&mut self.batches)),
            ..self.figures
        }
    }
}

/// Milliseconds of each search.
fn timed_round(
    client: &mut Client,
    single: &Statement,
    effort: Effort,
) -> Result<Vec<f64>, Failure> {
    let mut times = Vec::with_capacity(effort.searches);
    let round = Instant::now();
    for id in 0..effort.searches {
        if round.elapsed() > ROUND {
            break;
        }
        let began = Instant::now();
        client.query(single, &[&(id as i32)])?;
        times.push(milliseconds(began));
    }
    Ok(times)
}

/// Pages of index and table that this transaction has read so far, cached or not.
fn pages(transaction: &mut Transaction<'_>, contender: &Contender) -> Result<[f64; 2], Failure> {
    let table = contender.table;
    let statement = format!(
        "SELECT pg_stat_get_xact_blocks_fetched('{table}_key'::regclass)::float8,
                pg_stat_get_xact_blocks_fetched('{table}'::regclass)::float8"
    );
    let row = transaction.query_one(&statement, &[])?;
    Ok([row.get(0), row.get(1)])
}

fn milliseconds(began: Instant) -> f64 {
    began.elapsed().as_secs_f64() * 1e3
}
