//! [`Score`], answers held against the truth.

use std::collections::HashSet;

/// Answers of a way against what can be seen, summed over observers.
#[derive(Clone, Copy, Debug, Default)]
pub struct Score {
    /// How many observers.
    pub observers: usize,
    /// Features in answers.
    pub returned: usize,
    visible: usize,
    missed: usize,
}

impl Score {
    /// Adds the answer for an observer.
    pub fn add(&mut self, answer: &HashSet<i64>, visible: &HashSet<i64>) {
        self.observers += 1;
        self.returned += answer.len();
        self.visible += visible.len();
        self.missed += visible.difference(answer).count();
    }

    /// Features that an observer can see, in the mean.
    pub fn visible(&self) -> f64 {
        self.visible as f64 / self.observers as f64
    }

    /// Q, (returned − visible) ÷ visible; `None` where nothing was seen.
    pub fn over_estimate(&self) -> Option<f64> {
        self.share(self.returned as f64 - self.visible as f64)
    }

    /// The share of what can be seen that is missing from the answers; `None` where nothing was seen.
    pub fn missed(&self) -> Option<f64> {
        self.share(self.missed as f64)
    }

    fn share(&self, count: f64) -> Option<f64> {
        (self.visible > 0).then(|| count / self.visible as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_too_much_does_not_make_up_for_what_is_missing() {
        let mut score = Score::default();
        assert_eq!((score.over_estimate(), score.missed()), (None, None));
        score.add(&HashSet::from([1, 2, 3, 4]), &HashSet::from([1, 2]));
        score.add(&HashSet::from([1, 9]), &HashSet::from([1, 2]));
        assert_eq!((score.observers, score.returned), (2, 6));
        assert_eq!((score.visible(), score.over_estimate()), (2.0, Some(0.5)));
        assert_eq!(score.missed(), Some(0.25));
    }
}
