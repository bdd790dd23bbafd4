//! [`BoxStatistics`], what a planner keeps of a column of boxes: it estimates which share of them
//! a query meets.

mod group;
mod interval;
mod partition;

use crate::{Box3d, BoxRelation};
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
    pub fn share(&self, relation: BoxRelation, query: &Box3d) -> f64 {
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
    pub fn share_of_pairs(&self, relation: BoxRelation, other: &Self) -> f64 {
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

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;
    use proptest::prelude::*;

    /// A block of 20 × 20 × 20 boxes of size 5, a lattice of 10 m apart.
    fn lattice() -> Vec<Box3d> {
        (0..8_000)
            .map(|i| {
                let at = [i % 20, i / 20 % 20, i / 400].map(|c| 10.0 * f64::from(c));
                let corner = DVec3::from_array(at);
                Box3d::new(corner, corner + 5.0)
            })
            .collect()
    }

    fn boxes() -> impl Strategy<Value = Vec<Box3d>> {
        let scale = prop_oneof![Just(1.0), Just(447_000.0), Just(1e15), Just(1e300)];
        let corner = || prop::array::uniform3(-20i32..20);
        let number = |scale: f64| move |c: [i32; 3]| DVec3::from(c.map(f64::from)) * scale;
        let one = (corner(), corner(), scale)
            .prop_map(move |(a, b, scale)| Box3d::new(number(scale)(a), number(scale)(b)));
        prop::collection::vec(one, 1..60)
    }

    const ALL: [BoxRelation; 3] = [
        BoxRelation::Overlaps,
        BoxRelation::Contains,
        BoxRelation::ContainedBy,
    ];

    #[test]
    fn a_lattice_is_counted() {
        let boxes = lattice();
        let statistics = BoxStatistics::of_sample(&mut boxes.clone(), 400);
        for (low, high) in [(0.0, 100.0), (33.0, 121.0), (-50.0, 62.0), (70.0, 500.0)] {
            let query = Box3d::new(DVec3::splat(low), DVec3::splat(high));
            let share = |holds: &dyn Fn(&Box3d) -> bool| {
                boxes.iter().filter(|b| holds(b)).count() as f64 / boxes.len() as f64
            };
            let overlaps = share(&|b| b.overlaps(&query));
            let inside = share(&|b| query.contains(b));
            for (estimate, truth) in [
                (statistics.share(BoxRelation::Overlaps, &query), overlaps),
                (statistics.share(BoxRelation::ContainedBy, &query), inside),
                (statistics.share_meeting(|b| b.overlaps(&query)), overlaps),
            ] {
                assert!(
                    (0.6..1.6).contains(&(estimate / truth)),
                    "{estimate} {truth}"
                );
            }
        }
    }

    #[test]
    fn what_is_all_at_one_place_is_exact() {
        let house = Box3d::new(
            DVec3::new(85_000.1, 447_000.2, 0.0),
            DVec3::new(85_010.1, 447_007.2, 0.0),
        );
        let statistics = BoxStatistics::of_sample(&mut vec![house; 1_000], 100);
        for relation in ALL {
            assert_eq!(statistics.share(relation, &house), 1.0, "{relation:?}");
        }
        let away = Box3d::new(house.max + 1.0, house.max + 2.0);
        for relation in ALL {
            assert_eq!(statistics.share(relation, &away), 0.0, "{relation:?}");
        }
        assert_eq!(
            statistics.share_of_pairs(BoxRelation::Overlaps, &statistics),
            1.0
        );
    }

    #[test]
    fn pairs_of_a_lattice_are_counted() {
        let boxes = lattice();
        let statistics = BoxStatistics::of_sample(&mut boxes.clone(), 400);
        let wide: Vec<_> = boxes
            .iter()
            .map(|b| Box3d::new(b.min - 10.0, b.max + 10.0))
            .collect();
        let others = BoxStatistics::of_sample(&mut wide.clone(), 400);
        // Every wide box meets 3 × 3 × 3 of the lattice, fewer at its sides.
        let truth = (58.0_f64 / 400.0).powi(3);
        let estimate = statistics.share_of_pairs(BoxRelation::Overlaps, &others);
        assert!(
            (0.5..2.0).contains(&(estimate / truth)),
            "{estimate} {truth}"
        );
    }

    #[test]
    fn numbers_of_no_statistics_are_refused() {
        let good = BoxStatistics::of_sample(&mut lattice(), 4).to_numbers();
        assert!(BoxStatistics::from_numbers(&good).is_some());
        let broken = |at: usize, number: f32| {
            let mut numbers = good.clone();
            numbers[at] = number;
            numbers
        };
        for numbers in [
            vec![],
            vec![1.0],
            good[..good.len() - 1].to_vec(),
            broken(0, 2.0),
            broken(1, -1.0),
            broken(1, 1.5),
            broken(2, f32::NAN),
            broken(3, f32::INFINITY),
            broken(3, -1e9),
            broken(2, 1e9),
        ] {
            assert!(
                BoxStatistics::from_numbers(&numbers).is_none(),
                "{numbers:?}"
            );
        }
    }

    proptest! {
        #[test]
        fn shares_are_shares(mut boxes in boxes(), query in boxes()) {
            let statistics = BoxStatistics::of_sample(&mut boxes, 5);
            let read = BoxStatistics::from_numbers(&statistics.to_numbers());
            prop_assert_eq!(read.as_ref(), Some(&statistics));
            for query in &query {
                for relation in ALL {
                    let share = statistics.share(relation, query);
                    prop_assert!((0.0..=1.0).contains(&share), "{} {:?}", share, relation);
                }
                let meeting = statistics.share_meeting(|b| b.overlaps(query));
                prop_assert!((0.0..=1.0).contains(&meeting));
            }
            let pairs = statistics.share_of_pairs(BoxRelation::Overlaps, &statistics);
            prop_assert!((0.0..=1.0).contains(&pairs));
        }

        #[test]
        fn a_query_around_all_holds_all(mut boxes in boxes()) {
            let around = boxes.iter().copied().reduce(|a, b| a.union(&b)).expect("at least one");
            let statistics = BoxStatistics::of_sample(&mut boxes, 5);
            for relation in [BoxRelation::Overlaps, BoxRelation::ContainedBy] {
                prop_assert!(statistics.share(relation, &around) > 1.0 - 1e-6);
            }
        }
    }
}
