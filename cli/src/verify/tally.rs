//! [`Tally`], the views of all observers together.

use super::sight::View;

/// Sums over all observers.
#[derive(Debug, Default)]
pub struct Tally {
    /// How many observers.
    pub observers: usize,
    /// Features in range.
    pub in_range: usize,
    /// Features in answers.
    pub returned: usize,
    /// Features seen.
    pub visible: usize,
    /// Of these, seen by rays alone.
    pub seen_by_ray: usize,
    /// Features not seen.
    pub hidden: usize,
    /// Features that a single convex piece hides.
    pub hidden_by_one: usize,
    /// Of these, left out of answers.
    pub left_out_by_one: usize,
    /// Of those not seen, left out of answers.
    pub left_out: usize,
    /// Features seen and left out.
    pub disputed: usize,
    /// Rays aimed.
    pub rays: usize,
    /// False occlusions.
    pub confirmed: usize,
}

impl Tally {
    /// Adds what one observer saw.
    pub fn add(&mut self, view: &View) {
        self.observers += 1;
        self.in_range += view.in_range;
        self.returned += view.returned;
        self.visible += view.visible;
        self.seen_by_ray += view.seen_by_ray;
        self.hidden += view.hidden;
        self.hidden_by_one += view.hidden_by_one;
        self.left_out_by_one += view.left_out_by_one;
        self.left_out += view.left_out;
        self.disputed += view.disputed;
        self.rays += view.rays;
        self.confirmed += view.faults.len();
    }

    /// The over-estimate, (returned − visible) ÷ visible; `None` where nothing was seen.
    pub fn over_estimate(&self) -> Option<f64> {
        let (returned, visible) = (self.returned as f64, self.visible as f64);
        (self.visible > 0).then(|| (returned - visible) / visible)
    }
}
