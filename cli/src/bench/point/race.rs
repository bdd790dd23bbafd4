//! How long ways take to answer.

use std::time::{Duration, Instant};

use indicatif::ProgressBar;
use postgres::{Client, Statement};

use super::contender::Contender;
use crate::bench::quantile::quantile;
use crate::failure::Failure;

/// After so long a round of single questions ends early.
const ROUND: Duration = Duration::from_secs(5);

/// A statement for all observers that would take longer is left out.
const PATIENCE: Duration = Duration::from_secs(20);

/// How often all observers are asked in one statement; the median counts.
const BATCHES: usize = 3;

/// New connections whose first call is measured.
const CONNECTIONS: usize = 20;

/// What a way takes.
#[derive(Clone, Copy, Debug)]
pub struct Figures {
    /// Different observers that were asked in a round.
    pub observers: usize,
    /// Rows of an answer, in the mean.
    pub rows: f64,
    /// Median milliseconds of an answer, at the client.
    pub median: f64,
    /// Milliseconds that 95 of 100 answers do not exceed.
    pub p95: f64,
    /// Milliseconds for each observer where one statement asks for all.
    pub batch: Option<f64>,
}

/// Has the ways answer in turn, a round each, so that what else the machine does hits all of them.
pub fn run(
    client: &mut Client,
    contenders: &[Contender],
    observers: usize,
    rounds: usize,
    bar: &ProgressBar,
) -> Result<Vec<Figures>, Failure> {
    let mut runners = Vec::new();
    for contender in contenders {
        let mut runner = Runner {
            single: client.prepare(&contender.single())?,
            rows: 0,
            asked: 0,
            times: Vec::new(),
        };
        // Warms the caches.
        runner.round(client, observers)?;
        runner.times.clear();
        runners.push(runner);
    }
    for _ in 0..rounds {
        for runner in &mut runners {
            runner.round(client, observers)?;
        }
    }
    let mut figures = Vec::new();
    for (mut runner, contender) in runners.into_iter().zip(contenders) {
        let median = quantile(&mut runner.times, 0.5);
        let whole = Duration::from_secs_f64(median * 1e-3 * observers as f64);
        let batch = if whole < PATIENCE {
            Some(batch(client, contender, observers)?)
        } else {
            None
        };
        figures.push(Figures {
            observers: runner.asked,
            rows: runner.rows as f64 / runner.asked as f64,
            median,
            p95: quantile(&mut runner.times, 0.95),
            batch,
        });
        bar.inc(1);
    }
    Ok(figures)
}

/// A way on its way.
struct Runner {
    single: Statement,
    /// Of the last round: rows, and observers that were asked.
    rows: usize,
    asked: usize,
    times: Vec<f64>,
}

impl Runner {
    fn round(&mut self, client: &mut Client, observers: usize) -> Result<(), Failure> {
        (self.rows, self.asked) = (0, 0);
        let round = Instant::now();
        for id in 0..observers {
            if round.elapsed() > ROUND {
                break;
            }
            let began = Instant::now();
            self.rows += client.query(&self.single, &[&(id as i32)])?.len();
            self.times.push(milliseconds(began));
            self.asked += 1;
        }
        Ok(())
    }
}

fn batch(client: &mut Client, contender: &Contender, observers: usize) -> Result<f64, Failure> {
    let statement = client.prepare(&contender.batch(observers))?;
    let mut times = Vec::new();
    for _ in 0..BATCHES {
        let began = Instant::now();
        client.query_one(&statement, &[])?;
        times.push(milliseconds(began));
    }
    Ok(quantile(&mut times, 0.5) / observers as f64)
}

/// Median milliseconds to connect, and of the first call after that.
pub struct First {
    pub connect: f64,
    pub call: f64,
}

/// Asks a way once in each of some new connections.
pub fn first_calls(
    connect: impl Fn() -> Result<Client, Failure>,
    contender: &Contender,
) -> Result<First, Failure> {
    let (mut connecting, mut calling) = (Vec::new(), Vec::new());
    for id in 0..CONNECTIONS {
        let began = Instant::now();
        let mut client = connect()?;
        connecting.push(milliseconds(began));
        let began = Instant::now();
        client.query(&contender.single(), &[&(id as i32)])?;
        calling.push(milliseconds(began));
    }
    Ok(First {
        connect: quantile(&mut connecting, 0.5),
        call: quantile(&mut calling, 0.5),
    })
}

/// Since then.
pub fn milliseconds(began: Instant) -> f64 {
    began.elapsed().as_secs_f64() * 1e3
}
