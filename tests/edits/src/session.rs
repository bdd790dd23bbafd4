//! [`Session`], one connection that edits and asks, as many others do beside it.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::sleep;
use std::time::{Duration, Instant};

use fastrand::Rng;
use postgres::error::SqlState;
use postgres::{Client, Error};

use crate::edit::Editor;
use crate::question::{Counts, Question, RANGE};
use crate::truth::{Truth, statement};

/// How others' locks are waited for: prepared transactions are in no deadlock that the server would find.
const SETTINGS: &str =
    "SET lock_timeout = '2s'; SET deadlock_timeout = '50ms'; SET client_min_messages = warning";

/// What a session did.
#[derive(Debug, Default)]
pub struct Tally {
    pub counts: Counts,
    /// Edits, maintenance and ends of transactions, by name.
    pub done: BTreeMap<&'static str, u64>,
    pub findings: Vec<String>,
}

impl Tally {
    /// Takes up what another session did.
    pub fn add(&mut self, other: Self) {
        self.counts += other.counts;
        for (name, count) in other.done {
            *self.done.entry(name).or_default() += count;
        }
        self.findings.extend(other.findings);
    }
}

/// One connection.
pub struct Session<'a> {
    client: Client,
    scene: &'a str,
    number: u64,
    rng: Rng,
    next: i64,
    prepared: u64,
    /// Where the attack ends before its time, as one session has found something.
    stop: &'a AtomicBool,
    pub tally: Tally,
}

impl<'a> Session<'a> {
    /// A session with a number of its own.
    pub fn new(
        mut client: Client,
        scene: &'a str,
        seed: u64,
        number: u64,
        stop: &'a AtomicBool,
    ) -> Result<Self, Error> {
        client.batch_execute(SETTINGS)?;
        // Every other session answers from view cells.
        let use_cells = if number.is_multiple_of(2) {
            "on"
        } else {
            "off"
        };
        client.batch_execute(&format!("SET pg_occlusion.use_cells = {use_cells}"))?;
        Ok(Self {
            client,
            scene,
            number,
            rng: Rng::with_seed(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ number),
            next: 1_000_000 * (1 + i64::try_from(number).unwrap_or_default()),
            prepared: 0,
            stop,
            tally: Tally::default(),
        })
    }

    /// Edits and asks until a moment.
    pub fn run(&mut self, end: Instant) -> Result<(), Error> {
        while Instant::now() < end && !self.stop.load(Ordering::Relaxed) {
            // Edits now and then, so that what is computed is in use in between.
            let turn = match self.rng.u8(..10) {
                0 => self.edit_in_transaction(),
                _ => self.ask_in_transaction(),
            };
            self.forgive(turn)?;
        }
        Ok(())
    }

    /// Keeps what is computed up to date until a moment.
    pub fn maintain(&mut self, end: Instant) -> Result<(), Error> {
        while Instant::now() < end && !self.stop.load(Ordering::Relaxed) {
            let (name, call) = self.chore();
            let turn = self.client.batch_execute(&call);
            self.count(name);
            self.forgive(turn)?;
            sleep(Duration::from_millis(self.rng.u64(..300)));
        }
        Ok(())
    }

    fn chore(&mut self) -> (&'static str, String) {
        let scene = self.scene;
        match self.rng.u8(..8) {
            0 => ("generate_view_cells", generate_view_cells(scene)),
            1 => (
                "generate_occlusion_volumes",
                format!(
                    "CALL occlusion.generate_occlusion_volumes('{scene}', smallest => 8, range => {RANGE:?})"
                ),
            ),
            2 | 3 => (
                "pack_tiles",
                format!("SELECT occlusion.pack_tiles('{scene}')"),
            ),
            _ => ("refresh", format!("CALL occlusion.refresh('{scene}')")),
        }
    }

    /// Undoes a transaction that others were in the way of.
    fn forgive(&mut self, turn: Result<(), Error>) -> Result<(), Error> {
        let Err(error) = turn else {
            return Ok(());
        };
        let name = match error.code() {
            Some(code) if *code == SqlState::T_R_SERIALIZATION_FAILURE => "serialization failure",
            Some(code) if *code == SqlState::T_R_DEADLOCK_DETECTED => "deadlock",
            Some(code) if *code == SqlState::LOCK_NOT_AVAILABLE => "lock timeout",
            Some(code) if *code == SqlState::FOREIGN_KEY_VIOLATION => "feature gone",
            Some(code) if *code == SqlState::UNIQUE_VIOLATION => "surface there",
            _ => return Err(error),
        };
        self.count(name);
        self.client.batch_execute("ROLLBACK")
    }

    fn count(&mut self, name: &'static str) {
        *self.tally.done.entry(name).or_default() += 1;
    }

    fn begin(&mut self) -> Result<(), Error> {
        let isolation = [
            "READ COMMITTED",
            "READ COMMITTED",
            "REPEATABLE READ",
            "SERIALIZABLE",
        ][self.rng.usize(..4)];
        self.client
            .batch_execute(&format!("BEGIN ISOLATION LEVEL {isolation}"))
    }

    /// Asks now and a little later, while others edit.
    fn ask_in_transaction(&mut self) -> Result<(), Error> {
        self.begin()?;
        for _ in 0..self.rng.usize(1..=3) {
            self.ask()?;
            sleep(Duration::from_millis(self.rng.u64(..40)));
        }
        self.client.batch_execute("COMMIT")
    }

    /// Edits, asking in between, and commits, or not.
    fn edit_in_transaction(&mut self) -> Result<(), Error> {
        self.begin()?;
        for _ in 0..self.rng.usize(1..=3) {
            let is_nested = self.rng.u8(..3) == 0;
            if is_nested {
                self.client.batch_execute("SAVEPOINT a")?;
            }
            self.edit()?;
            if self.rng.bool() {
                self.ask()?;
            }
            if is_nested {
                let (name, end) = if self.rng.bool() {
                    ("savepoint rolled back", "ROLLBACK TO a")
                } else {
                    ("savepoint released", "RELEASE a")
                };
                self.client.batch_execute(end)?;
                self.count(name);
                if self.rng.bool() {
                    self.ask()?;
                }
            }
        }
        match self.rng.u8(..8) {
            0 | 1 => {
                self.count("rollback");
                self.client.batch_execute("ROLLBACK")
            }
            2 => self.prepare(),
            _ => {
                self.count("commit");
                self.client.batch_execute("COMMIT")
            }
        }
    }

    fn edit(&mut self) -> Result<(), Error> {
        let mut editor = Editor {
            client: &mut self.client,
            scene: self.scene,
            rng: &mut self.rng,
            next: &mut self.next,
        };
        let name = editor.edit()?;
        self.count(name);
        Ok(())
    }

    /// Hands the transaction to the server, lets others ask, and ends it.
    fn prepare(&mut self) -> Result<(), Error> {
        self.prepared += 1;
        let name = format!("'edits {} {}'", self.number, self.prepared);
        self.client
            .batch_execute(&format!("PREPARE TRANSACTION {name}"))?;
        let asked = self.ask();
        sleep(Duration::from_millis(self.rng.u64(..60)));
        let (done, end) = if self.rng.bool() {
            ("prepared and committed", "COMMIT")
        } else {
            ("prepared and rolled back", "ROLLBACK")
        };
        self.count(done);
        // Whatever came of the question, its locks are given up.
        self.client.batch_execute("ROLLBACK")?;
        self.client
            .batch_execute(&format!("{end} PREPARED {name}"))?;
        asked
    }

    /// Asks several observers' questions in one statement, and judges the answers by the scene that it shows.
    pub fn ask(&mut self) -> Result<(), Error> {
        let text: String = self
            .client
            .query_one(&statement(self.scene, &[]), &[])?
            .get(0);
        let before = Truth::parse(&text);
        let questions: Vec<Question> = (0..2)
            .map(|_| Question::random(&mut self.rng, &before))
            .collect();
        let expressions: Vec<Vec<String>> = questions
            .iter()
            .map(|q| q.expressions(self.scene))
            .collect();
        let text: String = self
            .client
            .query_one(&statement(self.scene, &expressions.concat()), &[])?
            .get(0);
        let truth = Truth::parse(&text);
        let mut answers = truth.answers.as_slice();
        for (question, expressions) in questions.iter().zip(&expressions) {
            let (its, others) = answers.split_at(expressions.len());
            answers = others;
            let found = question.judge(&truth, its, &mut self.rng, &mut self.tally.counts);
            if !found.is_empty() {
                self.stop.store(true, Ordering::Relaxed);
            }
            self.tally.findings.extend(found);
        }
        Ok(())
    }
}

/// The call that computes view cells, with sets for which little is to be done.
pub fn generate_view_cells(scene: &str) -> String {
    format!(
        "CALL occlusion.generate_view_cells('{scene}', range => {RANGE:?}, smallest => 8, finest => 2)"
    )
}
