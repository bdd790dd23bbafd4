//! How a trial is told.

use super::{Buffer, Trial};
use crate::bench::quantile::quantile;
use crate::bench::table::{Table, optional, percent};
use crate::terminal;

impl Trial {
    /// Adds what the answers are worth to a table of the ways, and the item buffers, beside our median time.
    pub fn add_to(&mut self, table: &mut Table, ours: f64) {
        table.heading.extend(["Q", "missed"]);
        for (row, score) in table.rows.iter_mut().zip(&self.ways) {
            row.push(optional(score.and_then(|score| score.over_estimate()), 3));
            row.push(percent(score.and_then(|score| score.missed())));
        }
        for buffer in &mut self.buffers {
            table.rows.push(row(buffer, ours));
        }
        table.remarks.push(self.remark());
    }

    /// What is there to be seen, and what item buffers take before they can look.
    fn remark(&mut self) -> String {
        format!(
            "Truly visible are {:.1} features in the mean. Around an observer are {} triangles, read in {:.0} ms \
             and built into a tree of Embree in {:.0} ms, in the median.",
            self.buffers[0].score.visible(),
            terminal::grouped(quantile(&mut self.triangles, 0.5) as usize),
            quantile(&mut self.reading, 0.5),
            quantile(&mut self.building, 0.5),
        )
    }
}

fn row(buffer: &mut Buffer, ours: f64) -> Vec<String> {
    let (score, median) = (buffer.score, quantile(&mut buffer.times, 0.5));
    vec![
        buffer.name.clone(),
        score.observers.to_string(),
        format!("{:.1}", score.returned as f64 / score.observers as f64),
        format!("{median:.3}"),
        format!("{:.3}", quantile(&mut buffer.times, 0.95)),
        format!("{:.2}", median / ours),
        optional(None, 3),
        optional(None, 2),
        optional(score.over_estimate(), 3),
        percent(score.missed()),
    ]
}
