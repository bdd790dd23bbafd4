//! [`BoxSplit`], how an index parts boxes that it will not part anew, and [`BoxCell`], what is then
//! known of a part.

use crate::{Box3d, BoxRange};
use glam::DVec3;

/// Edges on each side of a cut, in what the boxes that were split are spread. Boxes that come later and
/// lie beyond the first edge are so parted by their distance: were there no edges, boxes that come in
/// an order along space would make a tree as deep as a list.
const EDGES: [f64; 4] = [1.0, 4.0, 16.0, 256.0];

/// The part of boxes that are larger than those that were split.
const LARGE: usize = 2 * (EDGES.len() + 1);

/// How much larger than those that were split boxes of the other parts may be. With less, more of
/// those that come later are too large, and most nodes have a part for a few of them, which each
/// search enters.
const SLACK: f64 = 2.0;

/// Boxes of which an index knows where their corners can be, and how large they are at the most.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoxCell {
    /// Where the corners are.
    pub range: BoxRange,
    /// The greatest edge lengths in metres.
    pub largest: DVec3,
}

/// A division of boxes in [`BoxSplit::PARTS`] parts, by one of the six numbers of a box. A box belongs
/// to one part, which depends on nothing but the box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoxSplit {
    cut: Cut,
    /// How far the boxes that were split are spread along it.
    reach: f64,
    /// Larger boxes are a part of their own.
    largest: DVec3,
}

/// A division in two.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Cut {
    number: Number,
    /// The greatest number on the left.
    at: f64,
}

/// Where a box begins or ends along an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Number {
    Least(usize),
    Greatest(usize),
}

impl BoxCell {
    /// All boxes.
    pub const EVERYTHING: Self = {
        let everywhere = Box3d {
            min: DVec3::NEG_INFINITY,
            max: DVec3::INFINITY,
        };
        Self {
            range: BoxRange {
                least: everywhere,
                greatest: everywhere,
            },
            largest: DVec3::INFINITY,
        }
    };

    /// With what follows from the size for either corner from the other; `None` if there are no such
    /// boxes.
    fn tightened(self) -> Option<Self> {
        let BoxRange { least, greatest } = self.range;
        // Sizes were rounded, and so are these sums: one step outwards each.
        let size = self.largest.map(f64::next_up);
        let nearest = (greatest.min - size).map(f64::next_down);
        let farthest = (least.max + size).map(f64::next_up);
        let least = Box3d {
            min: least.min.max(nearest),
            max: least.max.min(greatest.max),
        };
        let greatest = Box3d {
            min: greatest.min.max(least.min),
            max: greatest.max.min(farthest),
        };
        let some = least.min.cmple(least.max).all() && greatest.min.cmple(greatest.max).all();
        some.then_some(Self {
            range: BoxRange { least, greatest },
            ..self
        })
    }
}

impl BoxSplit {
    /// How many parts there are; some may stay empty.
    pub const PARTS: usize = LARGE + 1;

    /// The division of these boxes that leaves the least to search. Unless they are all the same, at
    /// least two parts get some.
    #[must_use]
    pub fn of(boxes: &[Box3d]) -> Self {
        let cut = Cut::best(boxes);
        let values = || boxes.iter().map(|key| cut.number.of(key));
        let spread = values()
            .reduce(f64::max)
            .zip(values().reduce(f64::min))
            .map(|(greatest, least)| greatest - least);
        Self {
            cut,
            reach: spread.unwrap_or_default(),
            largest: largest(boxes) * SLACK,
        }
    }

    /// The part that a box belongs to.
    #[must_use]
    #[inline]
    pub fn part_of(&self, key: &Box3d) -> usize {
        if key.size().cmpgt(self.largest).any() {
            return LARGE;
        }
        let value = self.cut.number.of(key);
        let side = usize::from(self.cut.is_right(key));
        let crossed = (1..=EDGES.len()).take_while(|&edge| match side {
            0 => value <= self.edge(edge, side),
            _ => value > self.edge(edge, side),
        });
        2 * crossed.count() + side
    }

    /// What is known of the boxes of a part, if there can be any in a cell.
    #[must_use]
    #[inline]
    pub fn part(&self, cell: &BoxCell, part: usize) -> Option<BoxCell> {
        if part >= LARGE {
            return cell.largest.cmpgt(self.largest).any().then_some(*cell);
        }
        let (crossed, side) = (part / 2, part % 2);
        let ends = [crossed, crossed + 1].map(|edge| self.edge(edge, side));
        let (from, to) = (ends[1 - side], ends[side]);
        let mut part = *cell;
        let (bounds, axis) = match self.cut.number {
            Number::Least(axis) => (&mut part.range.least, axis),
            Number::Greatest(axis) => (&mut part.range.greatest, axis),
        };
        bounds.min[axis] = bounds.min[axis].max(from);
        bounds.max[axis] = bounds.max[axis].min(to);
        part.largest = part.largest.min(self.largest);
        part.tightened()
    }

    /// Where an edge is on a side; the cut itself is the first, and behind the last one is no other.
    #[inline]
    fn edge(&self, edge: usize, side: usize) -> f64 {
        let distance = match edge {
            0 => 0.0,
            _ => EDGES
                .get(edge - 1)
                .map_or(f64::INFINITY, |e| e * self.reach),
        };
        self.cut.at + if side == 0 { -distance } else { distance }
    }

    /// As six numbers, as an index stores it.
    #[must_use]
    pub fn to_numbers(&self) -> [f64; 6] {
        let Self { cut, reach, .. } = *self;
        let [x, y, z] = self.largest.to_array();
        [cut.number.position() as f64, cut.at, reach, x, y, z]
    }

    /// From what [`Self::to_numbers`] gave.
    #[must_use]
    #[inline]
    pub fn from_numbers([position, at, reach, x, y, z]: [f64; 6]) -> Self {
        let number = Number::ALL[(position as usize).min(Number::ALL.len() - 1)];
        Self {
            cut: Cut { number, at },
            reach,
            largest: DVec3::new(x, y, z),
        }
    }
}

impl Cut {
    /// Leaves all on the left.
    const NONE: Self = Self {
        number: Number::Least(0),
        at: f64::MAX,
    };

    /// The cut that leaves the least to search, if there is one.
    fn best(boxes: &[Box3d]) -> Self {
        let cuts = Number::ALL
            .into_iter()
            .filter_map(|number| Self::by(number, boxes));
        let costed = cuts.map(|cut| (cut.cost(boxes), cut));
        let best = costed.min_by(|a, b| a.0.total_cmp(&b.0));
        best.map_or(Self::NONE, |(_, cut)| cut)
    }

    /// The cut by one number, as near to the median as equal ones allow.
    fn by(number: Number, boxes: &[Box3d]) -> Option<Self> {
        let mut values: Vec<f64> = boxes.iter().map(|key| number.of(key)).collect();
        values.sort_unstable_by(f64::total_cmp);
        let half = values.len() / 2;
        let rises = (1..values.len()).filter(|&at| values[at - 1] < values[at]);
        let rise = rises.min_by_key(|at| at.abs_diff(half))?;
        Some(Self {
            number,
            at: values[rise - 1],
        })
    }

    /// How much there is to search on both sides: boxes times the volume in which a search about as
    /// large as they are meets the box around them. So flat boxes have one too, and metres count alike
    /// on all axes.
    fn cost(self, boxes: &[Box3d]) -> f64 {
        let longest = boxes.iter().map(|key| key.size().max_element());
        let search = longest.sum::<f64>() / boxes.len() as f64;
        let side = |right: bool| {
            let keys = || boxes.iter().filter(move |key| self.is_right(key) == right);
            let around = keys().copied().reduce(|a, b| a.union(&b));
            let room = around.map(|around| (around.size() + search).element_product());
            keys().count() as f64 * room.unwrap_or_default()
        };
        side(false) + side(true)
    }

    #[inline]
    fn is_right(self, key: &Box3d) -> bool {
        self.number.of(key) > self.at
    }
}

impl Number {
    const ALL: [Self; 6] = [
        Self::Least(0),
        Self::Least(1),
        Self::Least(2),
        Self::Greatest(0),
        Self::Greatest(1),
        Self::Greatest(2),
    ];

    #[inline]
    fn of(self, key: &Box3d) -> f64 {
        match self {
            Self::Least(axis) => key.min[axis],
            Self::Greatest(axis) => key.max[axis],
        }
    }

    /// Its position among all.
    fn position(self) -> usize {
        match self {
            Self::Least(axis) => axis,
            Self::Greatest(axis) => axis + 3,
        }
    }
}

/// The greatest edge lengths.
fn largest(boxes: &[Box3d]) -> DVec3 {
    let sizes = boxes.iter().map(Box3d::size);
    sizes.reduce(DVec3::max).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::BoxRelation;
    use proptest::prelude::*;

    /// Boxes of a leaf before it is split.
    const LEAF: usize = 16;

    /// What an index makes of splits, in memory.
    enum Tree {
        Leaf(Vec<Box3d>),
        Node(BoxSplit, Vec<Tree>),
    }

    impl Tree {
        fn of(boxes: &[Box3d]) -> Self {
            let mut tree = Self::Leaf(Vec::new());
            boxes.iter().for_each(|&key| tree.insert(key));
            tree
        }

        fn insert(&mut self, key: Box3d) {
            match self {
                Self::Node(split, parts) => parts[split.part_of(&key)].insert(key),
                Self::Leaf(boxes) => {
                    boxes.push(key);
                    if boxes.len() > LEAF && boxes.iter().any(|other| *other != boxes[0]) {
                        let boxes = std::mem::take(boxes);
                        *self = Self::split(&boxes);
                    }
                }
            }
        }

        fn split(boxes: &[Box3d]) -> Self {
            let split = BoxSplit::of(boxes);
            let stored = BoxSplit::from_numbers(split.to_numbers());
            assert_eq!(stored, split);
            let mut parts = vec![Vec::new(); BoxSplit::PARTS];
            for key in boxes {
                parts[split.part_of(key)].push(*key);
            }
            let filled = parts.iter().filter(|part| !part.is_empty()).count();
            assert!(filled > 1, "nothing was divided");
            Self::Node(split, parts.into_iter().map(Self::Leaf).collect())
        }

        fn depth(&self) -> usize {
            match self {
                Self::Leaf(_) => 0,
                Self::Node(_, parts) => 1 + parts.iter().map(Self::depth).max().unwrap_or(0),
            }
        }

        /// Calls back for each leaf that is not empty with what is known of it, or `None` where there
        /// can be no boxes.
        fn leaves(
            &self,
            cell: Option<&BoxCell>,
            visit: &mut impl FnMut(Option<&BoxCell>, &[Box3d]),
        ) {
            match self {
                Self::Leaf(boxes) if boxes.is_empty() => {}
                Self::Leaf(boxes) => visit(cell, boxes),
                Self::Node(split, parts) => {
                    for (part, tree) in parts.iter().enumerate() {
                        let cell = cell.and_then(|cell| split.part(cell, part));
                        tree.leaves(cell.as_ref(), visit);
                    }
                }
            }
        }

        /// Leaves in which there may be something that overlaps a box, and all leaves.
        fn overlapping(&self, wanted: &Box3d) -> (usize, usize) {
            let mut count = (0, 0);
            self.leaves(Some(&BoxCell::EVERYTHING), &mut |cell, _| {
                let range = &cell.expect("there are boxes").range;
                let possible = BoxRelation::Overlaps.possible(range, wanted);
                count.0 += usize::from(possible);
                count.1 += 1;
            });
            count
        }
    }

    fn holds(cell: &BoxCell, key: &Box3d) -> bool {
        cell.range.least.contains_point(key.min)
            && cell.range.greatest.contains_point(key.max)
            && key.size().cmple(cell.largest).all()
    }

    /// Small lattices, where boxes touch, are flat and are equal, and numbers that are rounded or
    /// as large as they can be.
    fn number() -> impl Strategy<Value = f64> {
        prop_oneof![
            6 => (0..4_i8).prop_map(f64::from),
            3 => (0..40_i8).prop_map(|n| 447_000.1 + f64::from(n) * 0.1),
            1 => Just(f64::MAX),
            1 => Just(f64::MIN),
            1 => Just(-0.0),
        ]
    }

    fn boxes() -> impl Strategy<Value = Vec<Box3d>> {
        let corner = || prop::array::uniform3(number()).prop_map(DVec3::from);
        prop::collection::vec(
            (corner(), corner()).prop_map(|(a, b)| Box3d::new(a, b)),
            1..200,
        )
    }

    /// Houses on level ground, in rows.
    fn city(side: usize) -> Vec<Box3d> {
        let house = |at: usize| {
            let (x, y) = ((at % side) as f64 * 15.0, (at / side) as f64 * 15.0);
            let size = DVec3::new(
                8.0 + (at % 5) as f64,
                12.0 - (at % 3) as f64,
                6.0 + (at % 7) as f64,
            );
            Box3d::new(DVec3::new(x, y, 0.0), DVec3::new(x, y, 0.0) + size)
        };
        (0..side * side).map(house).collect()
    }

    proptest! {
        #[test]
        fn what_is_known_of_a_part_holds_for_all_its_boxes(boxes in boxes()) {
            let mut count = 0;
            Tree::of(&boxes).leaves(Some(&BoxCell::EVERYTHING), &mut |cell, found| {
                let cell = cell.expect("a part with boxes was left out");
                assert!(found.iter().all(|key| holds(cell, key)), "{cell:?} of {found:?}");
                count += found.len();
            });
            prop_assert_eq!(count, boxes.len());
        }
    }

    proptest! {
        #[test]
        fn one_corner_and_the_size_tell_where_the_other_is(boxes in boxes()) {
            for key in &boxes {
                let everywhere = BoxCell::EVERYTHING.range.least;
                let [least, greatest] = [key.min, key.max].map(|p| Box3d { min: p, max: p });
                for (least, greatest) in [(least, everywhere), (everywhere, greatest)] {
                    let range = BoxRange { least, greatest };
                    let cell = BoxCell { range, largest: key.size() }.tightened().unwrap();
                    prop_assert!(holds(&cell, key), "{cell:?} of {key:?}");
                    // And not much more room than there must be, where that can be told.
                    let room = cell.range.bounds().size() - key.size();
                    let rounded = key.corners()[7].abs().max_element().max(1.0) * 1e-12;
                    prop_assert!(room.max_element() < rounded || key.min.min_element() < -1e9 || rounded > 1.0);
                }
            }
        }
    }

    #[test]
    fn boxes_that_are_all_the_same_are_one_part() {
        let key = city(2)[3];
        let split = BoxSplit::of(&[key; 5]);
        assert_eq!(split.to_numbers()[2], 0.0);
        let part = split.part(&BoxCell::EVERYTHING, split.part_of(&key));
        assert!(holds(&part.unwrap(), &key));
    }

    #[test]
    fn level_ground_does_not_keep_a_search_from_being_narrow() {
        let boxes = city(100);
        let tree = Tree::of(&boxes);
        let most = boxes.iter().map(|key| {
            let point = key.center();
            let (possible, all) = tree.overlapping(&Box3d::new(point, point));
            assert!(all >= boxes.len() / LEAF);
            possible
        });
        let most = most.max().unwrap();
        assert!(most <= 8, "{most} leaves for a point");
    }

    #[test]
    fn an_order_along_space_does_not_make_a_deep_tree() {
        let line: Vec<Box3d> = (0..100_000)
            .map(|at| {
                Box3d::new(
                    DVec3::splat(f64::from(at)),
                    DVec3::splat(f64::from(at) + 2.0),
                )
            })
            .collect();
        // As a list it would be thousands deep, and 13 if all were known before.
        assert!(Tree::of(&line).depth() < 80);
    }
}
