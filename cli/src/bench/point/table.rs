//! How long the ways take, as a [`Table`].

use super::contender::Contender;
use super::race::Figures;
use crate::bench::table::{Table, optional};

impl Table {
    /// How long the ways take.
    pub fn of(contenders: &[Contender], figures: &[Figures]) -> Self {
        let ours = figures[0];
        let row = |(contender, figures): (&Contender, &Figures)| {
            vec![
                contender.name.to_owned(),
                figures.observers.to_string(),
                format!("{:.1}", figures.rows),
                format!("{:.3}", figures.median),
                format!("{:.3}", figures.p95),
                format!("{:.2}", figures.median / ours.median),
                optional(figures.batch, 3),
                optional(figures.batch.zip(ours.batch).map(|(a, b)| a / b), 2),
            ]
        };
        let heading = [
            "way",
            "observers",
            "rows",
            "ms",
            "p95",
            "ratio",
            "ms in batch",
            "ratio",
        ];
        Self {
            heading: heading.into(),
            rows: contenders.iter().zip(figures).map(row).collect(),
            remarks: Vec::new(),
        }
    }
}
