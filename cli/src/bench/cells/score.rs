//! [`Score`], what a way takes and what its answers are worth.

use std::collections::HashSet;

use crate::bench::quantile::quantile;

/// A way, summed over cells.
#[derive(Clone, Debug)]
pub struct Score {
    /// What the way is called.
    pub name: String,
    is_complete: bool,
    /// Seconds to make what all cells share.
    pub prepared: f64,
    /// Milliseconds for each cell.
    pub times: Vec<f64>,
    held: usize,
    by_points: usize,
    worst: f64,
    visible: usize,
    missed: usize,
}

impl Score {
    /// Of no cells yet.
    pub fn new(name: &str, is_complete: bool, prepared: f64) -> Self {
        Self {
            name: name.to_owned(),
            is_complete,
            prepared,
            times: Vec::new(),
            held: 0,
            by_points: 0,
            worst: 0.0,
            visible: 0,
            missed: 0,
        }
    }

    /// Adds the answer for a cell, beside what points see and what is known to be visible.
    pub fn add(
        &mut self,
        held: &HashSet<i64>,
        by_points: &HashSet<i64>,
        visible: Option<&HashSet<i64>>,
    ) {
        self.held += held.len();
        self.by_points += by_points.len();
        self.worst = self.worst.max(held.len() as f64 / by_points.len() as f64);
        if let Some(visible) = visible {
            self.visible += visible.len();
            self.missed += visible.difference(held).count();
        }
    }

    /// Median milliseconds of a cell.
    pub fn median(&self) -> f64 {
        quantile(&mut self.times.clone(), 0.5)
    }

    /// Milliseconds that 95 of 100 cells do not exceed.
    pub fn p95(&self) -> f64 {
        quantile(&mut self.times.clone(), 0.95)
    }

    /// Mean milliseconds of each of so many cells, with its part of what all share.
    pub fn in_total(&self, cells: usize) -> f64 {
        let alone = self.times.iter().sum::<f64>() / self.times.len() as f64;
        alone + 1e3 * self.prepared / cells as f64
    }

    /// Features of an answer, in the mean.
    pub fn held(&self) -> f64 {
        self.held as f64 / self.times.len() as f64
    }

    /// Features that points see, in the mean.
    pub fn by_points(&self) -> f64 {
        self.by_points as f64 / self.times.len() as f64
    }

    /// Features of all answers ÷ those that points see; `None` where they see none.
    pub fn ratio(&self) -> Option<f64> {
        (self.by_points > 0).then(|| self.held as f64 / self.by_points as f64)
    }

    /// The greatest such ratio of a single cell; `None` where answers may lack something.
    pub fn worst(&self) -> Option<f64> {
        (self.is_complete && self.worst.is_finite()).then_some(self.worst)
    }

    /// Features known to be visible, in the mean.
    #[cfg(feature = "embree")]
    pub fn visible(&self) -> f64 {
        self.visible as f64 / self.times.len() as f64
    }

    /// The share of these that is missing from the answers; `None` where none is known.
    #[cfg(feature = "embree")]
    pub fn missed(&self) -> Option<f64> {
        (self.visible > 0).then(|| self.missed as f64 / self.visible as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scores_are_sums_over_cells() {
        let mut score = Score::new("a way", true, 2.0);
        score.add(
            &HashSet::from([1, 2, 3]),
            &HashSet::from([1, 2]),
            Some(&HashSet::from([3, 4])),
        );
        score.add(&HashSet::from([1, 2, 3]), &HashSet::from([1, 2]), None);
        score.times.extend([1.0, 3.0]);
        assert_eq!((score.held(), score.by_points()), (3.0, 2.0));
        assert_eq!((score.ratio(), score.worst()), (Some(1.5), Some(1.5)));
        assert_eq!((score.missed, score.visible), (1, 2));
        // Two seconds, shared by a thousand cells.
        assert_eq!(score.in_total(1000), 4.0);
        assert_eq!(Score::new("another", false, 0.0).worst(), None);
    }
}
