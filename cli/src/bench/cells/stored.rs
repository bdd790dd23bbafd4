//! [`Stored`], what queries take in a scene that has view cells.

use std::time::Instant;

use fastrand::Rng;
use glam::DVec3;
use postgres::types::ToSql;
use postgres::{Client, Statement};

use super::window::Window;
use crate::bench::quantile::quantile;
use crate::bench::table::Table;
use crate::database::{literal, quoted};
use crate::failure::Failure;
use crate::sql_types::Point3d;

/// How often all is asked, after once to warm the caches.
const ROUNDS: usize = 3;

/// View cells answer no query that sees this much farther than they do, metres.
const FARTHER: f64 = 1.0;

/// The view cells of a scene.
pub struct Stored {
    /// How many.
    pub count: i64,
    /// How far eyes see, metres.
    pub range: f64,
}

impl Stored {
    /// Those of a scene; `None` if it has none.
    pub fn find(client: &mut Client, scene: &str) -> Result<Option<Self>, Failure> {
        let schema = quoted(scene);
        let known = "SELECT to_regclass($1) IS NOT NULL";
        let table = format!("{schema}.view_cell");
        if !client.query_one(known, &[&table])?.get::<_, bool>(0) {
            return Ok(None);
        }
        let statement = format!(
            "SELECT (SELECT count(*) FROM {table}), min(range) FROM {schema}.view_cell_block WHERE box IS NOT NULL"
        );
        let row = client.query_one(&statement, &[])?;
        let range: Option<f64> = row.get(1);
        Ok(range.map(|range| Self {
            count: row.get(0),
            range,
        }))
    }

    /// Asks for eyes in the streets and features around, one statement each, kinds of questions in turn.
    pub fn ask(
        &self,
        client: &mut Client,
        scene: &str,
        window: &Window,
        count: usize,
        rng: &mut Rng,
    ) -> Result<Table, Failure> {
        let eyes: Vec<Point3d> = window.eyes(count, rng).into_iter().map(point).collect();
        let features: Vec<i64> = (0..count)
            .filter_map(|_| rng.choice(&window.around.features))
            .map(|feature| feature.id)
            .collect();
        let mut calls = calls(client, scene, self.range)?;
        for round in 0..=ROUNDS {
            for call in &mut calls {
                match call.of {
                    Of::Eyes => call.round(client, eyes.iter().map(|eye| eye as _))?,
                    Of::Features => call.round(client, features.iter().map(|id| id as _))?,
                }
                if round == 0 {
                    call.times.clear();
                }
            }
        }
        Ok(Table {
            heading: vec!["query", "asked", "rows", "ms", "p95"],
            rows: calls.iter_mut().map(Call::row).collect(),
            remarks: vec!["Rows are those of an answer, in the mean.".to_owned()],
        })
    }
}

fn point(eye: DVec3) -> Point3d {
    Point3d(eye.to_array())
}

/// What a question is about.
enum Of {
    Eyes,
    Features,
}

/// A query, asked one statement at a time.
struct Call {
    name: String,
    of: Of,
    statement: Statement,
    /// Of the last round: questions, and rows of all answers.
    asked: usize,
    rows: usize,
    /// Milliseconds of each.
    times: Vec<f64>,
}

/// Those that are measured.
fn calls(client: &mut Client, scene: &str, range: f64) -> Result<Vec<Call>, Failure> {
    let scene = literal(scene);
    let seen = |range: f64| {
        format!(
            "v.feature_id, v.class FROM occlusion.visible_features({scene}, $1, {range:?}) AS v"
        )
    };
    let farther = range + FARTHER;
    let all = [
        (
            "visible_set".to_owned(),
            Of::Eyes,
            format!("v.visible, v.box, v.range FROM occlusion.visible_set({scene}, $1) AS v"),
        ),
        (
            "visible_from".to_owned(),
            Of::Features,
            format!("v.box FROM occlusion.visible_from({scene}, $1) AS v"),
        ),
        (
            format!("visible_features, {range} m"),
            Of::Eyes,
            seen(range),
        ),
        (
            format!("visible_features, {farther} m, which no cell answers"),
            Of::Eyes,
            seen(farther),
        ),
    ];
    let call = |(name, of, question)| {
        Ok(Call {
            name,
            of,
            statement: client.prepare(&format!("SELECT {question}"))?,
            asked: 0,
            rows: 0,
            times: Vec::new(),
        })
    };
    all.into_iter().map(call).collect()
}

impl Call {
    fn round<'a>(
        &mut self,
        client: &mut Client,
        questions: impl Iterator<Item = &'a (dyn ToSql + Sync)>,
    ) -> Result<(), Failure> {
        (self.asked, self.rows) = (0, 0);
        for question in questions {
            let began = Instant::now();
            self.rows += client.query(&self.statement, &[question])?.len();
            self.times.push(began.elapsed().as_secs_f64() * 1e3);
            self.asked += 1;
        }
        Ok(())
    }

    fn row(&mut self) -> Vec<String> {
        vec![
            self.name.clone(),
            self.asked.to_string(),
            format!("{:.1}", self.rows as f64 / self.asked as f64),
            format!("{:.3}", quantile(&mut self.times, 0.5)),
            format!("{:.3}", quantile(&mut self.times, 0.95)),
        ]
    }
}
