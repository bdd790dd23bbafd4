//! How a trial is told.

use super::score::Score;
use super::trial::Trial;
use crate::bench::table::{Table, optional};
use crate::terminal::grouped;

impl Trial {
    /// A row for each way; `covering` cells of this size cover the window.
    pub fn table(&self, covering: usize) -> Table {
        let ours = self.scores[0].median();
        let row = |score: &Score| {
            vec![
                score.name.clone(),
                format!("{:.2}", score.median()),
                format!("{:.2}", score.p95()),
                format!("{:.3}", score.median() / ours),
                format!("{:.2}", score.prepared),
                format!("{:.2}", score.in_total(covering)),
                format!("{:.1}", score.held()),
                optional(score.ratio(), 3),
                optional(score.worst(), 3),
            ]
        };
        let heading = [
            "way",
            "ms",
            "p95",
            "ratio",
            "s before",
            "ms in total",
            "held",
            "÷ points",
            "at worst",
        ];
        let mut table = Table {
            heading: heading.into(),
            rows: self.scores.iter().map(row).collect(),
            remarks: vec![format!(
                "{} cells, of {} that cover the streets of the window. From points {:.1} features are seen in the \
                 mean; {} of all are not in the set of their cell.",
                self.scores[0].times.len(),
                grouped(covering),
                self.scores[0].by_points(),
                self.by_points_alone,
            )],
        };
        self.add_missed(&mut table);
        table
    }

    /// Adds what is missing from the answers.
    #[cfg(feature = "embree")]
    fn add_missed(&self, table: &mut Table) {
        table.heading.push("missed");
        for (row, score) in table.rows.iter_mut().zip(&self.scores) {
            row.push(crate::bench::table::percent(score.missed()));
        }
        let visible = self.scores[0].visible();
        let remark = format!("Exact rays meet {visible:.1} features of a cell.");
        table.remarks.push(remark);
    }

    #[cfg(not(feature = "embree"))]
    fn add_missed(&self, _: &mut Table) {}
}
