//! [`Report`], what a verification says at its end.

use std::fmt::{self, Display, Formatter};

use serde_json::{Value, json};

use super::Verify;
use super::cells::CellTally;
use super::fault::Fault;
use super::tally::Tally;
use crate::terminal::{BAD, FAINT, GOOD, grouped, percent};

/// Most faults that are printed in full.
const PRINTED: usize = 10;

/// What came of a verification.
pub struct Report<'a> {
    /// What was asked for.
    pub verify: &'a Verify,
    /// How many things were checked, with their names.
    pub counts: [(&'static str, usize); 5],
    /// How many observers stood on volumes.
    pub on_volumes: usize,
    /// What the observers saw.
    pub tally: Tally,
    /// What was checked of the view cells, if that was asked.
    pub of_cells: Option<CellTally>,
    /// What is wrong.
    pub faults: &'a [Fault],
    /// What drew.
    pub adapter: String,
    /// Seconds for what is stored.
    pub stored_seconds: f64,
    /// Seconds for all.
    pub seconds: f64,
}

impl Report<'_> {
    fn false_occlusions(&self) -> usize {
        self.faults
            .iter()
            .filter(|fault| fault.is_false_occlusion())
            .count()
    }

    /// For programs.
    pub fn json(&self) -> Value {
        let Self { verify, tally, .. } = self;
        let share = |part: usize, whole: usize| (whole > 0).then(|| part as f64 / whole as f64);
        let fault = |fault: &Fault| {
            json!({
                "fault": fault.to_string(),
                "observer": fault.eye(),
                "picture": verify.picture_of(fault),
            })
        };
        json!({
            "scene": verify.scene,
            "checked": self.counts.iter().map(|(name, count)| (name.replace(' ', "_"), *count))
                .collect::<std::collections::BTreeMap<_, _>>(),
            "observers": tally.observers,
            "on_volumes": self.on_volumes,
            "seed": verify.seed,
            "range": verify.range,
            "resolution": verify.resolution,
            "rays": tally.rays,
            "in_range": tally.in_range,
            "returned": tally.returned,
            "visible": tally.visible,
            "seen_by_ray": tally.seen_by_ray,
            "over_estimate": tally.over_estimate(),
            "truth": "mesh",
            "hidden": tally.hidden,
            "hidden_by_one": tally.hidden_by_one,
            "share_of_hidden_by_one": share(tally.left_out_by_one, tally.hidden_by_one),
            "share_of_hidden": share(tally.left_out, tally.hidden),
            "disputed": tally.disputed,
            "confirmed": tally.confirmed,
            "false_occlusions": self.false_occlusions(),
            "stored_faults": self.faults.len() - self.false_occlusions(),
            "faults": self.faults.iter().map(fault).collect::<Vec<_>>(),
            "view_cells": self.of_cells.as_ref().map(|cells| json!({
                "checked": cells.cells,
                "visible": cells.visible,
                "proven": cells.proven,
                "eyes": cells.eyes,
                "rays": cells.rays,
            })),
            "adapter": self.adapter,
            "stored_seconds": self.stored_seconds,
            "seconds": self.seconds,
        })
    }

    fn rows(&self) -> Vec<(&'static str, String)> {
        let Self { verify, tally, .. } = self;
        let mut rows: Vec<(&str, String)> = self
            .counts
            .iter()
            .map(|&(name, count)| (name, grouped(count)))
            .collect();
        if let Some(cells) = &self.of_cells {
            let proven = percent(cells.proven, cells.visible);
            rows.extend([
                ("view cells", grouped(cells.cells)),
                (
                    "proven",
                    format!(
                        "{} of {}: {proven}",
                        grouped(cells.proven),
                        grouped(cells.visible)
                    ),
                ),
                (
                    "eyes in cells",
                    format!("{}, {} rays", grouped(cells.eyes), grouped(cells.rays)),
                ),
            ]);
        }
        let pairs = |part: usize| format!("{} of {}", grouped(part), grouped(tally.in_range));
        rows.extend([
            (
                "observers",
                format!(
                    "{}, {} of them on volumes, seed {}",
                    grouped(tally.observers),
                    grouped(self.on_volumes),
                    verify.seed
                ),
            ),
            (
                "in range",
                format!("{} within {} m", grouped(tally.in_range), verify.range),
            ),
            ("returned", grouped(tally.returned)),
            (
                "truly visible",
                format!(
                    "{}, {} of them by rays alone",
                    grouped(tally.visible),
                    grouped(tally.seen_by_ray)
                ),
            ),
            ("Q (mesh truth)", self.quality()),
            ("hidden", pairs(tally.hidden)),
            (
                "hidden by one",
                format!("{}: the single-occluder limit", pairs(tally.hidden_by_one)),
            ),
            (
                "left out",
                grouped(tally.in_range.saturating_sub(tally.returned)),
            ),
            (
                "share of the limit",
                percent(tally.left_out_by_one, tally.hidden_by_one),
            ),
            ("share of all hidden", percent(tally.left_out, tally.hidden)),
            ("rays", grouped(tally.rays)),
            ("disputed", grouped(tally.disputed)),
            ("confirmed", grouped(tally.confirmed)),
            ("drawn by", self.adapter.clone()),
            (
                "took",
                format!(
                    "{:.1} s, {:.1} s of it for what is stored",
                    self.seconds, self.stored_seconds
                ),
            ),
        ]);
        rows
    }

    fn quality(&self) -> String {
        let n = self.verify.resolution;
        let q = self.tally.over_estimate();
        q.map_or("–".to_owned(), |q| format!("{q:.3} at 6 x {n}²"))
    }

    fn write_faults(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let stored = self
            .faults
            .iter()
            .filter(|fault| !fault.is_false_occlusion());
        let seen = self
            .faults
            .iter()
            .filter(|fault| fault.is_false_occlusion());
        for fault in stored.take(PRINTED).chain(seen.take(PRINTED)) {
            writeln!(f, "{BAD}fault:{BAD:#} {fault}")?;
            if let Some(picture) = self.verify.picture_of(fault) {
                writeln!(f, "  {FAINT}{picture}{FAINT:#}")?;
            }
        }
        Ok(())
    }
}

impl Display for Report<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        for (label, text) in self.rows() {
            writeln!(f, "  {label:<22} {text}")?;
        }
        self.write_faults(f)?;
        let false_occlusions = self.false_occlusions();
        let stored = self.faults.len() - false_occlusions;
        let style = if self.faults.is_empty() { GOOD } else { BAD };
        writeln!(
            f,
            "{style}{} false occlusions, {} faults in what is stored{style:#}",
            grouped(false_occlusions),
            grouped(stored)
        )
    }
}
