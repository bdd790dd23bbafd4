//! [`BoxStatistics`], what a planner keeps of a column of boxes: it estimates which share of them
//! a query meets.

mod distinct;
mod group;
mod interval;
mod partition;
mod relation;

pub use distinct::distinct_boxes;
pub use relation::Relation;

use crate::Box3d;
use group::{Group, NUMBERS};
use interval::{Interval, rounded};

/// Layout of the stored numbers. Another layout gets another number, so that old statistics are
/// not misread: they are ignored until the next ANALYZE.
const LAYOUT: f32 = 1.0;

/// Examples that are put to a field of view, among the groups that it may meet: the error that is
/// left, a sixteenth, is below that of the sample.
const EXAMPLES: usize = 256;

/// Most examples of one group: it knows no more about its boxes than that.
const MOST_EXAMPLES: usize = 16;

/// Boxes of one side that are put to the other side of a join: a tenth of error, and less than
/// half a millisecond.
const JOIN_EXAMPLES: usize = 100;

/// A sample of boxes, summarised as groups of neighbours of like size.
#[derive(Clone, Debug, PartialEq)]
pub struct BoxStatistics {
    groups: Vec<Group>,
}

impl BoxStatistics {
    /// Summarises a sample, which it reorders, in at most `groups` groups.
    #[must_use]
    pub fn of_sample(boxes: &mut [Box3d], groups: usize) -> Self {
        Self {
            groups: partition::groups(boxes, groups),
        }
    }

    /// Reads stored statistics; `None` if the numbers are none of this layout.
    #[must_use]
    pub fn from_numbers(numbers: &[f32]) -> Option<Self> {
        let (layout, rest) = numbers.split_first()?;
        let (stored, left_over) = rest.as_chunks::<NUMBERS>();
        if *layout != LAYOUT || stored.is_empty() || !left_over.is_empty() {
            return None;
        }
        let groups = stored
            .iter()
            .map(Group::from_numbers)
            .collect::<Option<_>>()?;
        Some(Self { groups })
    }

    /// The numbers to store.
    #[must_use]
    pub fn to_numbers(&self) -> Vec<f32> {
        std::iter::once(LAYOUT)
            .chain(self.groups.iter().flat_map(Group::numbers))
            .collect()
    }

    /// The share of the boxes that stand in `relation` to `query`, 0 to 1.
    #[must_use]
    pub fn share(&self, relation: Relation, query: &Box3d) -> f64 {
        let low = query.min.to_array().map(rounded);
        let high = query.max.to_array().map(rounded);
        self.sum(|group| group.share(relation, low, high))
    }

    /// The share of the boxes that meet a field of view, 0 to 1.
    #[must_use]
    pub fn share_meeting(&self, meets: impl Fn(&Box3d) -> bool) -> f64 {
        let touched: Vec<_> = self.groups.iter().filter(|g| meets(&g.hull())).collect();
        let examples = (EXAMPLES / touched.len().max(1)).clamp(1, MOST_EXAMPLES);
        let met = |at: usize| {
            (at * examples..(at + 1) * examples)
                .filter(|&number| meets(&touched[at].example(number)))
                .count() as f64
                / examples as f64
        };
        (0..touched.len())
            .map(|at| f64::from(touched[at].weight) * met(at))
            .sum::<f64>()
            .clamp(0.0, 1.0)
    }

    /// The share of all pairs of a box of this column and one of another that stand in
    /// `relation`, this one first; 0 to 1.
    #[must_use]
    pub fn share_of_pairs(&self, relation: Relation, other: &Self) -> f64 {
        let step = other.groups.len().div_ceil(JOIN_EXAMPLES).max(1);
        let (weight, met) = other.groups.iter().enumerate().step_by(step).fold(
            (0.0, 0.0),
            |(weight, met), (number, group)| {
                let w = f64::from(group.weight);
                (
                    weight + w,
                    met + w * self.share(relation, &group.example(number)),
                )
            },
        );
        if weight > 0.0 { met / weight } else { 0.0 }
    }

    /// The weighted sum of a share of each group.
    fn sum(&self, share: impl Fn(&Group) -> f64) -> f64 {
        self.groups
            .iter()
            .map(|group| f64::from(group.weight) * share(group))
            .sum::<f64>()
            .clamp(0.0, 1.0)
    }
}
