//! [`Job`], how far long work on a scene is, for others to see.

use super::{count, failed, quoted, run};
use pgrx::Spi;

/// One row of the table `job`.
pub struct Job {
    scene: String,
    task: &'static str,
}

impl Job {
    /// The row of one kind of work on a scene.
    pub fn new(scene: &str, task: &'static str) -> Self {
        Self {
            scene: quoted(scene),
            task,
        }
    }

    /// Tells that it begins, with so many features to do.
    pub fn start(&self, total: usize) {
        run(
            &format!(
                "INSERT INTO {}.job AS j \
                     (task, backend, started, updated, done, total, made, finished) \
                 VALUES ($1, pg_catalog.pg_backend_pid(), pg_catalog.clock_timestamp(), \
                         pg_catalog.clock_timestamp(), 0, $2, 0, false) \
                 ON CONFLICT (task) DO UPDATE SET backend = EXCLUDED.backend, \
                     started = EXCLUDED.started, updated = EXCLUDED.updated, done = 0, \
                     total = EXCLUDED.total, made = 0, finished = false",
                self.scene
            ),
            &[self.task.into(), count(total).into()],
        );
    }

    /// Tells how many features are done, and how many rows made.
    pub fn advance(&self, done: usize, made: i64) {
        run(
            &format!(
                "UPDATE {}.job SET done = $2, made = $3, updated = pg_catalog.clock_timestamp() \
                 WHERE task OPERATOR(pg_catalog.=) $1",
                self.scene
            ),
            &[self.task.into(), count(done).into(), made.into()],
        );
    }

    /// Tells that one more of what several sessions share is done, and how many rows it made; returns how
    /// many are done, and how many there are in all.
    pub fn add(&self, made: usize) -> (i64, i64) {
        let statement = format!(
            "UPDATE {}.job SET done = done OPERATOR(pg_catalog.+) 1, \
                    made = made OPERATOR(pg_catalog.+) $2, \
                    backend = pg_catalog.pg_backend_pid(), updated = pg_catalog.clock_timestamp() \
             WHERE task OPERATOR(pg_catalog.=) $1 RETURNING done, total",
            self.scene
        );
        let counts = Spi::connect_mut(|client| {
            let row = client
                .update(&statement, None, &[self.task.into(), count(made).into()])?
                .first();
            match row.is_empty() {
                true => Ok((None, None)),
                false => Ok::<_, pgrx::spi::Error>((row.get::<i64>(1)?, row.get::<i64>(2)?)),
            }
        });
        let (done, total) = counts.unwrap_or_else(|error| failed(&error));
        (done.unwrap_or(0), total.unwrap_or(0))
    }

    /// Tells that it came to its end.
    pub fn finish(&self) {
        run(
            &format!(
                "UPDATE {}.job SET finished = true, updated = pg_catalog.clock_timestamp() \
                 WHERE task OPERATOR(pg_catalog.=) $1",
                self.scene
            ),
            &[self.task.into()],
        );
    }
}
