//! [`Table`], the ways beside one another.

use super::contender::Contender;
use super::race::Figures;
use crate::bench::format::Format;

/// A row for each way, ours first. All columns but the first hold numbers.
pub struct Table {
    /// What the columns hold.
    pub heading: Vec<&'static str>,
    /// As many cells each.
    pub rows: Vec<Vec<String>>,
    /// Sentences below it.
    pub remarks: Vec<String>,
}

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

    /// As text.
    pub fn text(&self, format: Format) -> String {
        let right: Vec<bool> = (0..self.heading.len()).map(|column| column > 0).collect();
        let table = format.table(&self.heading, &right, &self.rows);
        format!("{table}\n\n{}\n", self.remarks.join("\n"))
    }
}

/// A number that may not have been measured.
pub fn optional(number: Option<f64>, digits: usize) -> String {
    number.map_or("–".to_owned(), |number| format!("{number:.digits$}"))
}
