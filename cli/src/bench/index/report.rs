//! What the benchmark prints.

use super::contender::Kind;
use super::outcome::{Entry, Goal, Outcome};
use crate::bench::format::Format;

const MEGABYTE: f64 = 1e6;

impl Format {
    /// The tables of one data set.
    pub fn outcome(self, outcome: &Outcome) -> String {
        let absent = outcome
            .absent
            .iter()
            .map(|(name, reason)| format!("{name} is absent: {reason}\n\n"));
        format!(
            "{}{}\n\n{}A round trip that only looks up a search: {:.3} ms.\n\n{}\n",
            self.title(&outcome.name),
            self.built(&outcome.entries),
            absent.collect::<String>(),
            outcome.floor,
            self.searches(outcome)
        )
    }

    /// What was to be reached.
    pub fn goals(self, goals: &[Goal]) -> String {
        let row = |goal: &Goal| {
            let (ratio, place) = goal.worst.clone().unwrap_or((f64::NAN, "–".to_owned()));
            let reached = match goal.reached() {
                Some(true) => "yes",
                Some(false) => "no",
                None => "not measured",
            };
            vec![
                goal.wanted.clone(),
                times(Some(ratio)),
                place,
                reached.to_owned(),
            ]
        };
        let rows: Vec<_> = goals.iter().map(row).collect();
        format!(
            "{}{}\n",
            self.title("Goals"),
            self.table(
                &["goal", "least ratio", "where", "reached"],
                &[false, true, false, false],
                &rows
            )
        )
    }

    fn built(self, entries: &[Entry]) -> String {
        let row = |entry: &Entry| {
            let size = |bytes: i64| format!("{:.1}", bytes as f64 / MEGABYTE);
            vec![
                entry.contender.name.to_owned(),
                format!("{:.2}", entry.built.seconds),
                size(entry.built.index_bytes),
                size(entry.built.table_bytes),
            ]
        };
        let rows: Vec<_> = entries.iter().map(row).collect();
        let heading = ["index", "build s", "index MB", "table MB"];
        self.table(&heading, &[false, true, true, true], &rows)
    }

    fn searches(self, outcome: &Outcome) -> String {
        let rows: Vec<_> = Kind::ALL
            .into_iter()
            .flat_map(|kind| outcome.entries.iter().map(move |entry| (kind, entry)))
            .filter_map(|(kind, entry)| search_row(outcome, kind, entry))
            .collect();
        let heading = [
            "search",
            "index",
            "rows",
            "ms",
            "p95",
            "ratio",
            "ms in batch",
            "ratio",
            "index pages",
            "table pages",
        ];
        let mut right = [true; 10];
        right[..2].fill(false);
        self.table(&heading, &right, &rows)
    }
}

/// Figures of one contender and kind, where there are some.
fn search_row(outcome: &Outcome, kind: Kind, entry: &Entry) -> Option<Vec<String>> {
    let figures = entry.figures[kind as usize]?;
    let ours = outcome.ours().figures[kind as usize]?;
    let batch = figures
        .batch
        .zip(ours.batch)
        .map(|(theirs, ours)| theirs / ours);
    Some(vec![
        kind.name().to_owned(),
        entry.contender.name.to_owned(),
        format!("{:.0}", figures.rows),
        format!("{:.3}", figures.median),
        format!("{:.3}", figures.p95),
        times(Some(figures.median / ours.median)),
        figures
            .batch
            .map_or("–".to_owned(), |ms| format!("{ms:.3}")),
        times(batch),
        format!("{:.1}", figures.index_pages),
        format!("{:.1}", figures.table_pages),
    ])
}

fn times(ratio: Option<f64>) -> String {
    match ratio {
        Some(ratio) if ratio.is_finite() => format!("{ratio:.2}"),
        _ => "–".to_owned(),
    }
}
