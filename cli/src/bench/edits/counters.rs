//! What it costs to count queries.

use std::time::Instant;

use indicatif::ProgressBar;
use postgres::Client;

use super::SCHEMA;
use crate::bench::observers;
use crate::bench::quantile::quantile;
use crate::bench::table::Table;
use crate::database::literal;
use crate::failure::Failure;

/// How many questions there are.
pub const QUESTIONS: usize = 2;

/// Milliseconds of a question, counted and not.
struct Trial {
    name: &'static str,
    question: String,
    times: [Vec<f64>; 2],
}

/// Asks all observers in rounds, each counted and not, one right after the other.
pub fn measure(
    client: &mut Client,
    scene: &str,
    range: f64,
    rounds: usize,
    bar: &ProgressBar,
) -> Result<Table, Failure> {
    let observers = observers::eyes(client, SCHEMA)?;
    let scene = literal(scene);
    let mut trials: [Trial; QUESTIONS] = [
        (
            "visible_features",
            format!("SELECT count(*) FROM occlusion.visible_features({scene}, $1, {range:?})"),
        ),
        (
            "visible_set",
            format!("SELECT count(*) FROM occlusion.visible_set({scene}, $1)"),
        ),
    ]
    .map(|(name, question)| Trial {
        name,
        question,
        times: Default::default(),
    });
    for trial in &mut trials {
        let statement = client.prepare(&trial.question)?;
        // Warms the caches.
        for observer in &observers {
            client.query_one(&statement, &[observer])?;
        }
        for round in 0..rounds {
            for (number, observer) in observers.iter().enumerate() {
                for turn in 0..2 {
                    let is_counted = (round + number + turn) % 2 == 0;
                    client
                        .batch_execute(&format!("SET pg_occlusion.track_scenes = {is_counted}"))?;
                    let began = Instant::now();
                    client.query_one(&statement, &[observer])?;
                    let time = began.elapsed().as_secs_f64() * 1e3;
                    trial.times[usize::from(!is_counted)].push(time);
                }
            }
            bar.inc(1);
        }
    }
    client.batch_execute("RESET pg_occlusion.track_scenes")?;
    Ok(Table {
        heading: vec!["query", "counted, ms", "not counted", "ratio"],
        rows: trials.iter_mut().map(Trial::row).collect(),
        remarks: vec![format!(
            "Median of {} questions each, as the client sees them; each is asked counted and not, in either order.",
            rounds * observers.len()
        )],
    })
}

impl Trial {
    fn row(&mut self) -> Vec<String> {
        let [counted, not] = self.times.each_mut().map(|times| quantile(times, 0.5));
        vec![
            self.name.to_owned(),
            format!("{counted:.4}"),
            format!("{not:.4}"),
            format!("{:.3}", counted / not),
        ]
    }
}
