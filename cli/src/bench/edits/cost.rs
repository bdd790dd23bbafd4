//! What an edit costs with the triggers of a scene, and without.

use std::time::Instant;

use indicatif::ProgressBar;
use postgres::Client;

use crate::bench::quantile::quantile;
use crate::bench::table::Table;
use crate::database::quoted;
use crate::failure::Failure;
use crate::terminal::grouped;

/// Tables with triggers that an edit may fire.
const EDITED: [&str; 4] = ["feature", "solid_column", "inner_envelope", "mesh"];

/// An edit of features that `$1` numbers, in a schema `{0}`.
const KINDS: [(&str, &str); 5] = [
    (
        "attributes of a feature",
        "UPDATE {0}.feature SET attributes = '{}' WHERE id = ANY ($1)",
    ),
    (
        "envelope of a feature",
        "UPDATE {0}.feature SET envelope = occlusion.translate(envelope, 0.5, 0, 0) WHERE id = ANY ($1)",
    ),
    (
        "top of its columns",
        "UPDATE {0}.solid_column SET top = top + 0.5 WHERE feature = ANY ($1)",
    ),
    (
        "new feature",
        "INSERT INTO {0}.feature (class, envelope) SELECT class, envelope FROM {0}.feature WHERE id = ANY ($1)",
    ),
    (
        "deleted feature",
        "DELETE FROM {0}.feature WHERE id = ANY ($1)",
    ),
];

/// An edit of so many features, and milliseconds with the triggers and without.
struct Trial {
    kind: &'static str,
    rows: u64,
    times: [Vec<f64>; 2],
}

/// Runs all edits in rounds.
pub fn measure(
    client: &mut Client,
    scene: &str,
    rows: &[usize],
    rounds: usize,
    bar: &ProgressBar,
) -> Result<Table, Failure> {
    let mut trials = Vec::new();
    let mut remarks = vec![
        "Milliseconds of a statement in the median, before it is committed. A column's row may be one of several of a feature."
            .to_owned(),
    ];
    for &count in rows {
        let ids = features(client, scene, count)?;
        if ids.len() < count {
            remarks.push(format!("There are only {} features.", grouped(ids.len())));
        }
        let first = trials.len();
        trials.extend(KINDS.map(|(kind, _)| Trial {
            kind,
            rows: 0,
            times: Default::default(),
        }));
        for _ in 0..rounds {
            for (trial, (_, edit)) in trials[first..].iter_mut().zip(KINDS) {
                for has_triggers in [true, false] {
                    let (rows, time) = run(client, scene, edit, &ids, has_triggers)?;
                    trial.rows = rows;
                    trial.times[usize::from(!has_triggers)].push(time);
                }
            }
            bar.inc(1);
        }
    }
    Ok(Table {
        heading: vec!["edit", "rows", "ms", "without triggers", "µs a row more"],
        rows: trials.iter_mut().map(Trial::row).collect(),
        remarks,
    })
}

/// Features, as many as wanted if there are, in no order.
fn features(client: &mut Client, scene: &str, count: usize) -> Result<Vec<i64>, Failure> {
    let schema = quoted(scene);
    let statement = format!(
        "SELECT coalesce(array_agg(id), '{{}}') FROM (
             SELECT id FROM {schema}.feature ORDER BY hashint8(id) LIMIT {count}) AS f"
    );
    Ok(client.query_one(&statement, &[])?.get(0))
}

/// Runs an edit and takes it back; returns how many rows, and milliseconds.
fn run(
    client: &mut Client,
    scene: &str,
    edit: &str,
    ids: &[i64],
    has_triggers: bool,
) -> Result<(u64, f64), Failure> {
    let schema = quoted(scene);
    let mut transaction = client.transaction()?;
    if !has_triggers {
        for table in EDITED {
            transaction.batch_execute(&format!(
                "ALTER TABLE {schema}.{table} DISABLE TRIGGER USER"
            ))?;
        }
    }
    let statement = transaction.prepare(&edit.replace("{0}", &schema))?;
    let began = Instant::now();
    let rows = transaction.execute(&statement, &[&ids])?;
    let time = began.elapsed().as_secs_f64() * 1e3;
    transaction.rollback()?;
    Ok((rows, time))
}

impl Trial {
    fn row(&mut self) -> Vec<String> {
        let [with, without] = self.times.each_mut().map(|times| quantile(times, 0.5));
        let more = (with - without) * 1e3 / self.rows as f64;
        vec![
            self.kind.to_owned(),
            grouped(usize::try_from(self.rows).unwrap_or(usize::MAX)),
            format!("{with:.3}"),
            format!("{without:.3}"),
            format!("{more:.1}"),
        ]
    }
}
