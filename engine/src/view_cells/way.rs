//! [`Way`], where an observer goes.

use geo::{Coord, CoordsIter, Distance, Euclidean, Intersects, Line, LinesIter, Polygon};
use glam::DVec3;

use crate::point_visibility::EYE_MARGIN;
use crate::{Box3d, SolidColumn, Street};

/// Gaps of this length between what covers a way do not count, metres: they are roundings of where it
/// crosses borders. Cells hold what is seen from eyes that are farther beside their parts than this.
const GAP: f64 = 1e-6;

/// A straight way of an eye.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Way {
    /// Where it begins, metres.
    pub from: DVec3,
    /// Where it ends, metres.
    pub to: DVec3,
}

impl Way {
    /// The same in so many parts of one length.
    pub fn parts(self, count: usize) -> impl Iterator<Item = Self> {
        let place = move |at: usize| match at == count {
            true => self.to,
            false => self.from.lerp(self.to, at as f64 / count as f64),
        };
        (0..count).map(move |at| Self {
            from: place(at),
            to: place(at + 1),
        })
    }

    /// Its length, metres.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.from.distance(self.to)
    }

    /// The box around it.
    #[must_use]
    pub fn bounds(&self) -> Box3d {
        Box3d::new(self.from, self.to)
    }

    /// Whether all of it is in some boxes together, each of which is as low and as high.
    #[must_use]
    pub fn is_in_boxes<'a>(&self, boxes: impl IntoIterator<Item = &'a Box3d>) -> bool {
        let boxes = boxes.into_iter();
        let level = boxes.filter(|bounds| self.is_between(bounds.min.z, bounds.max.z));
        self.is_covered(level.filter_map(|bounds| self.within(bounds)).collect())
    }

    /// Whether all of it is in some streets together, each of which has eyes as low and as high.
    #[must_use]
    pub fn is_in_streets<'a>(&self, streets: impl IntoIterator<Item = &'a Street>) -> bool {
        let streets = streets.into_iter();
        let level = streets.filter(|street| self.is_between(street.eye_low, street.eye_high));
        let shares = level.flat_map(|street| self.within_area(&street.area));
        self.is_covered(shares.collect())
    }

    /// Whether it keeps clear of the plan of a column.
    #[must_use]
    pub fn is_clear_of(&self, column: &SolidColumn) -> bool {
        let line = self.plan();
        let distance = match self.length() > 0.0 {
            true => Euclidean.distance(&line, &column.footprint),
            false => Euclidean.distance(&geo::Point(line.start), &column.footprint),
        };
        distance > EYE_MARGIN
    }

    fn plan(&self) -> Line<f64> {
        let [start, end] = [self.from, self.to].map(coord);
        Line { start, end }
    }

    /// Whether all of it is between two heights. No gap counts there: a micrometre higher one sees over
    /// more.
    fn is_between(&self, low: f64, high: f64) -> bool {
        let (from, to) = (self.from.z, self.to.z);
        low <= from.min(to) && from.max(to) <= high
    }

    /// The shares of the way that are in the plan of a closed box.
    fn within(&self, bounds: &Box3d) -> Option<[f64; 2]> {
        let way = self.to - self.from;
        let mut share = [0.0_f64, 1.0];
        for axis in 0..2 {
            let (from, min, max) = (self.from[axis], bounds.min[axis], bounds.max[axis]);
            if way[axis] == 0.0 {
                if !(min..=max).contains(&from) {
                    return None;
                }
                continue;
            }
            let ends = [(min - from) / way[axis], (max - from) / way[axis]];
            share[0] = share[0].max(ends[0].min(ends[1]));
            share[1] = share[1].min(ends[0].max(ends[1]));
        }
        (share[0] <= share[1]).then_some(share)
    }

    /// The shares of the way that are in an area of the plan.
    fn within_area(&self, area: &Polygon<f64>) -> Vec<[f64; 2]> {
        let mut cuts = self.crossings(area);
        cuts.retain(|share| (0.0..1.0).contains(share));
        cuts.extend([0.0, 1.0]);
        cuts.sort_by(f64::total_cmp);
        let is_inside = |pair: &&[f64]| {
            let middle = self.from.lerp(self.to, pair[0].midpoint(pair[1]));
            area.intersects(&coord(middle))
        };
        let parts = cuts.windows(2).filter(is_inside);
        parts.map(|pair| [pair[0], pair[1]]).collect()
    }

    /// The shares of the way at which it meets the border of an area.
    fn crossings(&self, area: &Polygon<f64>) -> Vec<f64> {
        let way = (self.to - self.from).truncate();
        let mut shares = Vec::with_capacity(area.coords_count());
        for edge in area.lines_iter() {
            let beside = |corner: Coord<f64>| {
                let there = glam::DVec2::new(corner.x, corner.y) - self.from.truncate();
                (way.perp_dot(there), way.dot(there) / way.length_squared())
            };
            let ((left, begin), (right, end)) = (beside(edge.start), beside(edge.end));
            if left == 0.0 && right == 0.0 {
                shares.extend([begin, end]);
            } else if left.signum() != right.signum() || left == 0.0 || right == 0.0 {
                shares.push(begin + (end - begin) * left / (left - right));
            }
        }
        shares
    }

    /// Whether some shares together are all of it.
    fn is_covered(&self, mut shares: Vec<[f64; 2]>) -> bool {
        let gap = GAP / self.length().max(GAP);
        shares.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let mut until = 0.0;
        let mut is_begun = false;
        for [first, last] in shares {
            if first > until + if is_begun { gap } else { 0.0 } {
                return false;
            }
            is_begun = true;
            until = last.max(until);
        }
        is_begun && until >= 1.0
    }
}

fn coord(place: DVec3) -> Coord<f64> {
    Coord {
        x: place.x,
        y: place.y,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geo::{LineString, polygon};

    fn way(from: [f64; 3], to: [f64; 3]) -> Way {
        Way {
            from: from.into(),
            to: to.into(),
        }
    }

    fn square(x: f64, y: f64, size: f64) -> Box3d {
        Box3d::new(DVec3::new(x, y, 1.5), DVec3::new(x + size, y + size, 2.0))
    }

    #[test]
    fn boxes_that_meet_cover_a_way_and_those_apart_do_not() {
        let across = way([0.5, 0.3, 1.7], [7.9, 3.1, 1.7]);
        assert!(across.is_in_boxes(&[square(0.0, 0.0, 4.0), square(4.0, 0.0, 4.0)]));
        assert!(!across.is_in_boxes(&[square(0.0, 0.0, 4.0), square(4.001, 0.0, 4.0)]));
        assert!(!across.is_in_boxes(&[square(0.0, 0.0, 4.0)]));
        assert!(!across.is_in_boxes(&[]));
        let climbing = way([0.5, 0.5, 1.7], [3.0, 3.0, 2.1]);
        assert!(!climbing.is_in_boxes(&[square(0.0, 0.0, 4.0)]));
        let low = Box3d::new(DVec3::new(0.0, 0.0, 0.0), DVec3::new(4.0, 4.0, 1.9));
        let rising = way([0.5, 0.5, 1.7], [3.0, 3.0, 1.95]);
        assert!(rising.is_in_boxes(&[square(0.0, 0.0, 4.0)]));
        assert!(!rising.is_in_boxes(&[low]), "not a nanometre over the top");
        let standing = way([4.0, 4.0, 2.0], [4.0, 4.0, 2.0]);
        assert!(standing.is_in_boxes(&[square(0.0, 0.0, 4.0)]));
        assert!(!standing.is_in_boxes(&[square(4.5, 0.0, 4.0)]));
    }

    #[test]
    fn streets_count_together_and_their_holes_do_not() {
        let street = |area: Polygon<f64>| Street {
            area,
            eye_low: 1.5,
            eye_high: 2.0,
        };
        let ring = |points: &[[f64; 2]]| {
            LineString::from(points.iter().map(|&[x, y]| (x, y)).collect::<Vec<_>>())
        };
        let hole = ring(&[[4.0, 4.0], [6.0, 4.0], [6.0, 6.0], [4.0, 6.0]]);
        let west = street(Polygon::new(
            ring(&[[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]]),
            vec![hole],
        ));
        let east = street(
            polygon![(x: 10.0, y: 0.0), (x: 20.0, y: 0.0), (x: 20.0, y: 10.0), (x: 10.0, y: 3.0)],
        );
        let both = [west, east];
        assert!(way([1.0, 1.0, 1.7], [19.0, 2.0, 1.7]).is_in_streets(&both));
        assert!(!way([1.0, 1.0, 1.7], [19.0, 2.0, 1.7]).is_in_streets(&both[..1]));
        assert!(!way([1.0, 5.0, 1.7], [9.0, 5.0, 1.7]).is_in_streets(&both));
        assert!(
            way([1.0, 4.0, 1.7], [9.0, 4.0, 1.7]).is_in_streets(&both),
            "along a border"
        );
        assert!(!way([1.0, 1.0, 1.7], [9.0, 1.0, 2.2]).is_in_streets(&both));
        assert!(!way([12.0, 1.0, 1.7], [12.0, 9.0, 1.7]).is_in_streets(&both));
        assert!(way([2.0, 2.0, 1.7], [2.0, 2.0, 1.7]).is_in_streets(&both));
        assert!(!way([5.0, 5.0, 1.7], [5.0, 5.0, 1.7]).is_in_streets(&both));
    }

    #[test]
    fn solids_are_kept_clear_of_by_a_millimetre() {
        let column = SolidColumn {
            footprint: polygon![(x: 0.0, y: 0.0), (x: 4.0, y: 0.0), (x: 0.0, y: 4.0)],
            bottom: 0.0,
            top: 9.0,
            grounded: true,
        };
        assert!(way([3.0, 3.0, 1.7], [9.0, 3.0, 1.7]).is_clear_of(&column));
        assert!(!way([-1.0, 1.0, 1.7], [9.0, 1.0, 1.7]).is_clear_of(&column));
        assert!(!way([4.0005, 0.0, 1.7], [9.0, 0.0, 1.7]).is_clear_of(&column));
        assert!(!way([1.0, 1.0, 1.7], [1.0, 1.0, 1.7]).is_clear_of(&column));
        assert!(way([5.0, 1.0, 1.7], [5.0, 1.0, 1.7]).is_clear_of(&column));
    }

    #[test]
    fn parts_join_at_their_ends() {
        let whole = way([0.1, 0.2, 0.3], [7.7, 8.8, 9.9]);
        let parts: Vec<Way> = whole.parts(7).collect();
        assert_eq!((parts[0].from, parts[6].to), (whole.from, whole.to));
        assert!(parts.windows(2).all(|pair| pair[0].to == pair[1].from));
    }
}
