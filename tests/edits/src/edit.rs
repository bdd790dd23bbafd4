//! Random edits of a scene through SQL.

use std::io::Write;

use fastrand::Rng;
use postgres::{Client, Error};

use crate::thing::Thing;
use crate::truth::{Known, Truth, statement};

/// Features that the town is kept to, roughly.
const FEATURES: std::ops::Range<usize> = 80..120;

/// Where edits are made.
pub struct Editor<'a> {
    pub client: &'a mut Client,
    pub scene: &'a str,
    pub rng: &'a mut Rng,
    /// The number of the next feature that gets one; each session has numbers of its own.
    pub next: &'a mut i64,
}

impl Editor<'_> {
    /// One edit of any kind; what it was.
    pub fn edit(&mut self) -> Result<&'static str, Error> {
        let truth = self.read()?;
        let Some(id) = truth.any(self.rng).map(|known| known.id) else {
            return self.insert();
        };
        match self.rng.u8(..32) {
            0..8 if truth.known.len() < FEATURES.end => self.insert(),
            8..10 if truth.known.len() < FEATURES.end => self.copy(),
            28 if self.rng.u8(..4) == 0 => self.truncate(),
            29 => self.street(&truth),
            kind => self.change(id, kind, truth.known.len()),
        }
    }

    fn read(&mut self) -> Result<Truth, Error> {
        let text: String = self
            .client
            .query_one(&statement(self.scene, &[]), &[])?
            .get(0);
        Ok(Truth::parse(&text))
    }

    /// Edits one feature, of which nobody changes anything meanwhile.
    fn change(&mut self, id: i64, kind: u8, count: usize) -> Result<&'static str, Error> {
        let lock = format!(
            "SELECT FROM {}.feature WHERE id = {id} FOR UPDATE",
            self.scene
        );
        if self.client.query_opt(&lock, &[])?.is_none() {
            return Ok("nothing");
        }
        let truth = self.read()?;
        let Some(known) = truth.known.iter().find(|known| known.id == id) else {
            return Ok("nothing");
        };
        match kind {
            0..10 => self.delete(known),
            10..16 if count > FEATURES.start => self.delete(known),
            10..20 => {
                let by = [0, 1].map(|_| (self.rng.f64() - 0.5) * 12.0);
                self.rewrite(known, &known.thing.moved(by), "move")
            }
            20..23 => {
                let factor = [0.3, 0.8, 1.3][self.rng.usize(..3)];
                self.rewrite(known, &known.thing.resized(factor), "resize")
            }
            23..25 => {
                let thing = Thing::random(self.rng);
                self.rewrite(known, &thing, "replace")
            }
            25..28 => self.hollow(known),
            _ => self.class(known),
        }
    }

    fn run(&mut self, sql: &str) -> Result<(), Error> {
        self.client.batch_execute(sql)
    }

    pub fn insert(&mut self) -> Result<&'static str, Error> {
        let thing = Thing::random(self.rng);
        let (scene, id) = (self.scene, *self.next);
        *self.next += 1;
        let values = thing.feature_values();
        self.run(&format!(
            "INSERT INTO {scene}.feature (id, class, envelope, outline) VALUES ({id}, {values}); {}",
            thing.inserts(scene, id)
        ))?;
        Ok("insert")
    }

    /// Some features at once, whose columns come in the same way.
    fn copy(&mut self) -> Result<&'static str, Error> {
        let (mut features, mut columns) = (String::new(), String::new());
        for _ in 0..3 {
            let thing = Thing::random(self.rng);
            let id = *self.next;
            *self.next += 1;
            let literal = |text: String| text.split('\'').nth(1).unwrap_or_default().to_owned();
            features += &format!("{id}\t{}\n", literal(thing.envelope.sql()));
            if let Some(solid) = &thing.solid {
                let ring = literal(crate::plan::ring_sql(&solid.ring));
                columns += &format!("{id}\t{{\"{ring}\"}}\t0\t{:?}\tt\n", solid.top);
            }
        }
        for (target, rows) in [
            ("feature (id, envelope)", features),
            (
                "solid_column (feature, footprint, bottom, top, grounded)",
                columns,
            ),
        ] {
            let copy = format!("COPY {}.{target} FROM STDIN", self.scene);
            let mut writer = self.client.copy_in(&copy)?;
            writer.write_all(rows.as_bytes()).expect("a connection");
            writer.finish()?;
        }
        Ok("copy")
    }

    fn delete(&mut self, known: &Known) -> Result<&'static str, Error> {
        self.run(&format!(
            "DELETE FROM {}.feature WHERE id = {}",
            self.scene, known.id
        ))?;
        Ok("delete")
    }

    /// Makes something else of a feature: in place, or by rows that go and come.
    fn rewrite(
        &mut self,
        known: &Known,
        thing: &Thing,
        what: &'static str,
    ) -> Result<&'static str, Error> {
        let (scene, id) = (self.scene, known.id);
        self.run(&format!(
            "UPDATE {scene}.feature SET (class, envelope, outline) = ROW({}) WHERE id = {id}",
            thing.feature_values()
        ))?;
        let of = |thing: &Thing| thing.solid.as_ref().map(|s| (s.is_inner, s.has_mesh));
        let in_place = thing
            .updates(scene, id)
            .filter(|_| of(thing) == of(&known.thing));
        match in_place {
            Some(updates) if self.rng.bool() => self.run(&updates)?,
            _ => {
                self.run(&hollow(scene, id))?;
                self.run(&thing.inserts(scene, id))?;
            }
        }
        Ok(what)
    }

    /// What hides in a feature goes; what can be seen of it stays.
    fn hollow(&mut self, known: &Known) -> Result<&'static str, Error> {
        self.run(&hollow(self.scene, known.id))?;
        Ok("hollow")
    }

    /// Empties tables, and fills them again in part.
    fn truncate(&mut self) -> Result<&'static str, Error> {
        let scene = self.scene;
        self.run(&format!(
            "LOCK TABLE {scene}.feature, {scene}.solid_column, {scene}.inner_envelope, {scene}.mesh
             IN ACCESS EXCLUSIVE MODE"
        ))?;
        let truth = self.read()?;
        self.run(&format!(
            "TRUNCATE {scene}.solid_column, {scene}.inner_envelope, {scene}.mesh"
        ))?;
        for known in &truth.known {
            if self.rng.u8(..8) > 0 {
                // An old snapshot shows what somebody has changed since: this fails then.
                let id = known.id;
                self.run(&format!(
                    "SELECT FROM {scene}.feature WHERE id = {id} FOR UPDATE"
                ))?;
                self.run(&known.thing.inserts(scene, id))?;
            }
        }
        Ok("truncate")
    }

    /// A street is closed and opened again, or its eyes change.
    fn street(&mut self, truth: &Truth) -> Result<&'static str, Error> {
        let (scene, Some(street)) = (self.scene, self.rng.choice(&truth.streets)) else {
            return Ok("nothing");
        };
        let [low, high] = street.eyes;
        let id = street.id;
        if self.rng.bool() {
            let high = if high > 2.0 { 2.0 } else { 2.5 };
            self.run(&format!(
                "UPDATE {scene}.street SET eye_high = {high:?} WHERE id = {id}"
            ))?;
        } else {
            let ring = crate::plan::ring_sql(&street.ring);
            self.run(&format!(
                "DELETE FROM {scene}.street WHERE id = {id};
                 INSERT INTO {scene}.street (area, eye_low, eye_high) VALUES (ARRAY[{ring}], {low:?}, {high:?})"
            ))?;
        }
        Ok("street")
    }

    fn class(&mut self, known: &Known) -> Result<&'static str, Error> {
        self.run(&format!(
            "UPDATE {}.feature SET class = class || '' WHERE id = {}",
            self.scene, known.id
        ))?;
        Ok("class")
    }
}

fn hollow(scene: &str, id: i64) -> String {
    let tables = ["solid_column", "inner_envelope", "mesh"];
    let deletes = tables.map(|table| format!("DELETE FROM {scene}.{table} WHERE feature = {id};"));
    deletes.concat()
}
