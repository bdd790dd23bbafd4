//! How long a demolished house stays in the way of view cells, and what queries take meanwhile.

use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Instant;

use indicatif::ProgressBar;
use postgres::Client;

use super::{Edits, SCHEMA};
use crate::bench::observers;
use crate::bench::quantile::quantile;
use crate::bench::table::Table;
use crate::database::{literal, quoted};
use crate::failure::Failure;
use crate::sql_types::Point3d;

/// Features are deleted one after the other; a row each, and what queries took.
pub fn measure(
    edits: &Edits,
    scene: &str,
    client: &mut Client,
    bar: &ProgressBar,
) -> Result<Table, Failure> {
    // So that a repair is of nothing else.
    let refresh = format!("CALL occlusion.refresh({})", literal(scene));
    client.batch_execute(&refresh)?;
    let mut asking = Asking::new(edits, scene)?;
    // Once to warm the caches.
    asking.once()?;
    let mut alone = asking.once()?;
    let mut meanwhile = Vec::new();
    let mut rows = Vec::new();
    for feature in chosen(client, scene, edits)? {
        let squares = delete(client, scene, feature)?;
        let is_repaired = AtomicBool::new(false);
        let (repaired, asked) = thread::scope(|scope| {
            let asked = scope.spawn(|| asking.until(&is_repaired));
            let began = Instant::now();
            let refreshed = client.batch_execute(&refresh);
            let seconds = began.elapsed().as_secs_f64();
            is_repaired.store(true, Ordering::Relaxed);
            let asked = asked.join().expect("asking does not panic");
            (refreshed.map(|()| seconds), asked)
        });
        meanwhile.extend(asked?);
        rows.push(vec![
            feature.to_string(),
            squares.to_string(),
            format!("{:.2}", repaired?),
        ]);
        bar.inc(1);
    }
    let say = |times: &mut [f64]| {
        let [middle, most, worst] = [0.5, 0.95, 1.0].map(|share| quantile(times, share));
        format!(
            "{middle:.2} ms in the median, 95 of 100 no more than {most:.2}, at worst {worst:.2}, of {}",
            times.len()
        )
    };
    let remarks = vec![
        format!(
            "visible_features, {} m, meanwhile: {}.",
            edits.range,
            say(&mut meanwhile)
        ),
        format!("Before, with nothing else going on: {}.", say(&mut alone)),
    ];
    Ok(Table {
        heading: vec!["deleted", "squares that it concerns", "s to repair"],
        rows,
        remarks,
    })
}

/// Features that the seed chooses, of those that hide something.
fn chosen(client: &mut Client, scene: &str, edits: &Edits) -> Result<Vec<i64>, Failure> {
    let statement = format!(
        "SELECT id FROM {0}.feature AS f
         WHERE EXISTS (SELECT FROM {0}.solid_column AS c WHERE c.feature = f.id)
            OR EXISTS (SELECT FROM {0}.inner_envelope AS e WHERE e.feature = f.id)
         ORDER BY hashint8extended(id, $1) LIMIT {1}",
        quoted(scene),
        edits.demolish
    );
    let rows = client.query(&statement, &[&edits.seed])?;
    Ok(rows.iter().map(|row| row.get(0)).collect())
}

/// Deletes a feature; returns how many squares of view cells are out of use then.
fn delete(client: &mut Client, scene: &str, feature: i64) -> Result<i64, Failure> {
    let statement = format!("DELETE FROM {}.feature WHERE id = $1", quoted(scene));
    client.execute(&statement, &[&feature])?;
    let wrong = "SELECT coalesce(squares - right_squares, 0) FROM occlusion.scene_status($1)";
    Ok(client.query_one(wrong, &[&scene])?.get(0))
}

/// A session that asks what can be seen from each observer in turn.
struct Asking {
    client: Client,
    question: postgres::Statement,
    observers: Vec<Point3d>,
    next: usize,
}

impl Asking {
    fn new(edits: &Edits, scene: &str) -> Result<Self, Failure> {
        let mut client = edits.database.connect()?;
        let question = format!(
            "SELECT count(*) FROM occlusion.visible_features({}, $1, {:?})",
            literal(scene),
            edits.range
        );
        let question = client.prepare(&question)?;
        Ok(Self {
            question,
            observers: observers::eyes(&mut client, SCHEMA)?,
            client,
            next: 0,
        })
    }

    /// Asks the next; returns milliseconds.
    fn ask(&mut self) -> Result<f64, Failure> {
        let observer = &self.observers[self.next];
        self.next = (self.next + 1) % self.observers.len();
        let began = Instant::now();
        self.client.query_one(&self.question, &[observer])?;
        Ok(began.elapsed().as_secs_f64() * 1e3)
    }

    fn once(&mut self) -> Result<Vec<f64>, Failure> {
        (0..self.observers.len()).map(|_| self.ask()).collect()
    }

    fn until(&mut self, is_over: &AtomicBool) -> Result<Vec<f64>, Failure> {
        let mut times = Vec::new();
        while !is_over.load(Ordering::Relaxed) {
            times.push(self.ask()?);
        }
        Ok(times)
    }
}
