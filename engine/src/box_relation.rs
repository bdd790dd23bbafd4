//! [`BoxRelation`], how one box lies to another, and [`BoxRange`], boxes of which only bounds are
//! known.

use crate::Box3d;

/// How a box lies to another one. All intervals are closed: boxes that touch overlap. Axes are 0, 1
/// and 2.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BoxRelation {
    /// They share a point.
    Overlaps,
    /// They have the same corners.
    Equals,
    /// It holds all of the other one.
    Contains,
    /// It lies wholly in the other one.
    ContainedBy,
    /// It ends before the other one begins.
    Before(usize),
    /// It ends no later than the other one.
    NotAfter(usize),
    /// It begins no earlier than the other one.
    NotBefore(usize),
    /// It begins after the other one ends.
    After(usize),
}

/// All boxes whose corners lie in these bounds: what an index knows of the boxes below a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoxRange {
    /// Where their least corners are. Bounds may be infinite.
    pub least: Box3d,
    /// Where their greatest corners are.
    pub greatest: Box3d,
}

impl BoxRelation {
    /// Whether `a` lies so to `b`.
    #[must_use]
    #[inline]
    pub fn holds(self, a: &Box3d, b: &Box3d) -> bool {
        match self {
            Self::Overlaps => a.overlaps(b),
            Self::Equals => a == b,
            Self::Contains => a.contains(b),
            Self::ContainedBy => b.contains(a),
            Self::Before(axis) => a.max[axis] < b.min[axis],
            Self::NotAfter(axis) => a.max[axis] <= b.max[axis],
            Self::NotBefore(axis) => a.min[axis] >= b.min[axis],
            Self::After(axis) => a.min[axis] > b.max[axis],
        }
    }

    /// How `b` lies to `a` when `a` lies so to `b`, if one of these tells it.
    #[must_use]
    pub fn commuted(self) -> Option<Self> {
        match self {
            Self::Overlaps | Self::Equals => Some(self),
            Self::Contains => Some(Self::ContainedBy),
            Self::ContainedBy => Some(Self::Contains),
            Self::Before(axis) => Some(Self::After(axis)),
            Self::After(axis) => Some(Self::Before(axis)),
            Self::NotAfter(_) | Self::NotBefore(_) => None,
        }
    }

    /// Whether some box in the range lies so to `b`.
    #[must_use]
    #[inline]
    pub fn possible(self, range: &BoxRange, b: &Box3d) -> bool {
        let (least, greatest) = (&range.least, &range.greatest);
        match self {
            Self::Overlaps => least.min.cmple(b.max).all() && greatest.max.cmpge(b.min).all(),
            Self::Equals => least.contains_point(b.min) && greatest.contains_point(b.max),
            Self::Contains => least.min.cmple(b.min).all() && greatest.max.cmpge(b.max).all(),
            // Its least corner is no less than that of `b`, its greatest no greater; and the one
            // is no greater than the other.
            Self::ContainedBy => {
                least.max.cmpge(b.min).all()
                    && greatest.min.cmple(b.max).all()
                    && least.min.cmple(b.max).all()
                    && greatest.max.cmpge(b.min).all()
            }
            Self::Before(axis) => greatest.min[axis] < b.min[axis],
            Self::NotAfter(axis) => greatest.min[axis] <= b.max[axis],
            Self::NotBefore(axis) => least.max[axis] >= b.min[axis],
            Self::After(axis) => least.max[axis] > b.max[axis],
        }
    }
}

impl BoxRange {
    /// All boxes inside `bounds`.
    #[must_use]
    #[inline]
    pub fn inside(bounds: &Box3d) -> Self {
        Self {
            least: *bounds,
            greatest: *bounds,
        }
    }

    /// The smallest box that holds all of them.
    #[must_use]
    #[inline]
    pub fn bounds(&self) -> Box3d {
        Box3d {
            min: self.least.min,
            max: self.greatest.max,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;
    use proptest::prelude::*;

    fn relations() -> Vec<BoxRelation> {
        use BoxRelation::{After, Before, NotAfter, NotBefore};
        let sided =
            (0..3).flat_map(|axis| [Before(axis), NotAfter(axis), NotBefore(axis), After(axis)]);
        [
            BoxRelation::Overlaps,
            BoxRelation::Equals,
            BoxRelation::Contains,
            BoxRelation::ContainedBy,
        ]
        .into_iter()
        .chain(sided)
        .collect()
    }

    /// Boxes on a small lattice: touching, flat, equal and nested ones are common.
    fn lattice_box() -> impl Strategy<Value = Box3d> {
        let corner = || prop::array::uniform3(0..4_i8).prop_map(|c| DVec3::from(c.map(f64::from)));
        (corner(), corner()).prop_map(|(a, b)| Box3d::new(a, b))
    }

    /// All boxes of a lattice whose corners lie in the range.
    fn boxes_in(range: &BoxRange) -> Vec<Box3d> {
        let corners = |bounds: &Box3d| {
            let bounds = *bounds;
            let all = (0..4).flat_map(|x| (0..4).flat_map(move |y| (0..4).map(move |z| [x, y, z])));
            all.map(|c| DVec3::from(c.map(f64::from)))
                .filter(move |&corner| bounds.contains_point(corner))
                .collect::<Vec<_>>()
        };
        let greatest = corners(&range.greatest);
        let pairs = corners(&range.least).into_iter().flat_map(|min| {
            let ordered = greatest.iter().filter(move |max| min.cmple(**max).all());
            ordered.map(move |&max| Box3d { min, max })
        });
        pairs.collect()
    }

    proptest! {
        #[test]
        fn what_some_box_does_is_possible_and_nothing_else(
            least in lattice_box(), greatest in lattice_box(), b in lattice_box(),
        ) {
            let range = BoxRange { least, greatest };
            let boxes = boxes_in(&range);
            for relation in relations() {
                let some = boxes.iter().any(|a| relation.holds(a, &b));
                let possible = relation.possible(&range, &b);
                prop_assert!(possible || !some, "{relation:?} was lost");
                // Where the ranges allow any pair of corners, bounds are exact for boxes inside.
                if least == greatest {
                    prop_assert_eq!(possible, some, "{:?} is loose", relation);
                }
            }
        }
    }
}
