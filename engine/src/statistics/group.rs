//! [`Group`], boxes that lie near each other and are of like size, as the statistics keep them.

use super::Interval;
use crate::{Box3d, BoxRelation};
use glam::DVec3;

/// Numbers that a group is stored as.
pub const NUMBERS: usize = 13;

/// Multiples of these, modulo 1, spread evenly over the unit cube: powers of the root of
/// x⁴ = x + 1 (Roberts 2018, the sequence R3).
const SPREAD: DVec3 = DVec3::new(
    0.819_172_513_396_164_5,
    0.671_043_606_703_789_3,
    0.549_700_477_901_970_3,
);

/// Some boxes of a sample: how many, and between which bounds each of their sides lies. A box is
/// taken to lie anywhere between these bounds with equal chance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Group {
    /// Share of all boxes that this group stands for.
    pub weight: f32,
    /// Where the least coordinates lie, for each axis.
    pub lower: [Interval; 3],
    /// Where the greatest coordinates lie, for each axis.
    pub upper: [Interval; 3],
}

impl Group {
    /// The group of some boxes, of which there is at least one, in a sample of `total`.
    pub fn of(boxes: &[Box3d], total: usize) -> Self {
        let along = |side: fn(&Box3d) -> DVec3| {
            [0, 1, 2].map(|axis| Interval::around(boxes.iter().map(|b| side(b)[axis])))
        };
        Self {
            weight: boxes.len() as f32 / total as f32,
            lower: along(|b| b.min),
            upper: along(|b| b.max),
        }
    }

    /// Reads a stored group; `None` if no group is stored so.
    pub fn from_numbers(numbers: &[f32; NUMBERS]) -> Option<Self> {
        let interval = |at: usize| Interval::new(numbers[at], numbers[at + 1]);
        let group = Self {
            weight: numbers[0],
            lower: [interval(1)?, interval(3)?, interval(5)?],
            upper: [interval(7)?, interval(9)?, interval(11)?],
        };
        let ordered = (0..3).all(|axis| {
            let (lower, upper) = (group.lower[axis], group.upper[axis]);
            lower.low() <= upper.low() && lower.high() <= upper.high()
        });
        (ordered && group.weight > 0.0 && group.weight <= 1.0).then_some(group)
    }

    /// The numbers to store.
    pub fn numbers(&self) -> impl Iterator<Item = f32> {
        std::iter::once(self.weight).chain(
            self.lower
                .into_iter()
                .chain(self.upper)
                .flat_map(|interval| [interval.low(), interval.high()]),
        )
    }

    /// The box around all boxes of the group.
    pub fn hull(&self) -> Box3d {
        Box3d {
            min: DVec3::from_array(self.lower.map(|interval| interval.low().into())),
            max: DVec3::from_array(self.upper.map(|interval| interval.high().into())),
        }
    }

    /// A box such as the group holds; each `number` gives another one.
    pub fn example(&self, number: usize) -> Box3d {
        let at = (SPREAD * (number as f64 + 0.5)).fract().to_array();
        let along = |side: &[Interval; 3]| {
            DVec3::from_array(std::array::from_fn(|axis| side[axis].at(at[axis])))
        };
        Box3d {
            min: along(&self.lower),
            max: along(&self.upper),
        }
    }

    /// The share of the group's boxes that stand in `relation` to the box from `low` to `high`.
    pub fn share(&self, relation: BoxRelation, low: [f32; 3], high: [f32; 3]) -> f64 {
        let (lower, upper) = (&self.lower, &self.upper);
        match relation {
            // Exact for each axis: whoever ends before the query starts before its end.
            BoxRelation::Overlaps => {
                product(|i| lower[i].share_to(high[i]) - upper[i].share_before(low[i]))
            }
            // Exact for boxes of one size.
            BoxRelation::Contains => {
                product(|i| lower[i].share_to(low[i]) - upper[i].share_before(high[i]))
            }
            BoxRelation::ContainedBy => {
                product(|i| upper[i].share_to(high[i]) - lower[i].share_before(low[i]))
            }
            BoxRelation::Equals => {
                product(|i| lower[i].share_at(low[i]) * upper[i].share_at(high[i]))
            }
            BoxRelation::Before(axis) => upper[axis].share_before(low[axis]),
            BoxRelation::NotAfter(axis) => upper[axis].share_to(high[axis]),
            BoxRelation::NotBefore(axis) => 1.0 - lower[axis].share_before(low[axis]),
            BoxRelation::After(axis) => 1.0 - lower[axis].share_to(high[axis]),
        }
    }
}

/// The product of a share along each axis, none of them less than 0. Most groups are far away along
/// one axis already.
fn product(along: impl Fn(usize) -> f64) -> f64 {
    let mut share = 1.0;
    for axis in 0..3 {
        share *= along(axis);
        if share <= 0.0 {
            return 0.0;
        }
    }
    share
}
