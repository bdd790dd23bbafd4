//! [`PointJudge`], whether something that an answer left out can be seen from one eye.
//!
//! A witness is a point of the target, in range, such that the open segment from the eye to it meets
//! the interior of no other feature. Aiming is done in `f64`, deciding is exact: a witness stands for
//! an error, whatever the aim was.
//!
//! **What a witness may graze.** Touching and grazing never hide, so a segment that meets no open
//! column is a witness, even if it runs along walls of two features that stand back to back, or
//! through a corner of one and then of another. Two columns of *one* feature are one solid, though: a
//! segment along their common wall is inside it. Where a segment is inside the union of closed columns
//! and in the interior of none, it lies on the surfaces of two of them over the same stretch, since
//! close by the surface of one the inside of the union is another one's. So no segment is a witness
//! that lies on two columns of one feature over stretches of some length. That may give up a witness
//! and never makes one up.

use std::cmp::Ordering;
use std::f64::consts::{PI, TAU};

use fastrand::Rng;

use crate::aabb::{Aabb, Point};
use crate::column::Column;
use crate::exact::rational;
use crate::plane::PlanPoint;
use crate::sight_profile::{Obstacle, SightProfile, chord};
use crate::sight_target::SightTarget;

/// How far from a column an eye is surely within its margin, metres: a millimetre, less what roundings
/// can make of it.
const EYE_MARGIN: f64 = 1e-3 - 1e-9;

/// How far beside a corner to aim, radians: from the roundings of a direction upwards.
const BESIDE: [f64; 6] = [3e-16, 1e-14, 1e-12, 1e-9, 1e-6, 1e-4];

/// Steps of the grid on which a point exactly behind a corner is sought, per metre.
const GRID: f64 = 1024.0;

/// Relative width of squared distances that are compared exactly.
const DISTANCE_SLACK: f64 = 1e-12;

/// A feature as an eye sees it.
#[derive(Clone, Debug, PartialEq)]
pub struct JudgedFeature {
    /// Outer envelope, metres.
    pub bounds: Aabb,
    /// Corners of the convex outer prism, anticlockwise, within the envelope; none where there is no
    /// prism.
    pub outline: Vec<PlanPoint>,
    /// What hides.
    pub columns: Vec<Column>,
}

/// What an answer left out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeftOut {
    /// Position of the feature.
    pub feature: usize,
    /// Whether its prism is meant where it has one, and else its box.
    pub prism: bool,
    /// How far the eye sees, metres; may be infinite.
    pub range: f64,
}

/// What a search for a witness came to.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Search {
    /// A point that can be seen.
    pub witness: Option<Point>,
    /// How many points in plan were aimed at.
    pub aims: usize,
}

/// Judges what answers for one eye left out.
#[derive(Debug)]
pub struct PointJudge<'a> {
    features: &'a [JudgedFeature],
    eye: Point,
    /// Columns that may hide, each with its feature.
    columns: Vec<(usize, &'a Column)>,
    obstacles: Vec<Obstacle>,
    /// Their corners relative to the eye, by azimuth.
    corners: Vec<Corner>,
    profile: SightProfile,
    heights: Vec<f64>,
    /// Which column met the last segment.
    last: usize,
    /// Whether columns that touch are one solid, whatever features they are of.
    joined: bool,
}

#[derive(Clone, Copy, Debug)]
struct Corner {
    feature: usize,
    azimuth: f64,
    place: PlanPoint,
}

/// A search under way.
struct Task<'t> {
    left_out: &'t LeftOut,
    target: &'t SightTarget,
    aims: usize,
}

impl<'a> PointJudge<'a> {
    /// A judge for one eye. Columns that hold the eye, or that it is within a millimetre of, hide
    /// nothing.
    #[must_use]
    pub fn new(features: &'a [JudgedFeature], eye: Point) -> Self {
        let all = features.iter().enumerate();
        let columns: Vec<(usize, &Column)> = all
            .flat_map(|(at, feature)| feature.columns.iter().map(move |column| (at, column)))
            .filter(|(_, column)| !column.is_within(eye, EYE_MARGIN))
            .collect();
        let obstacles: Vec<Obstacle> = columns
            .iter()
            .map(|&(feature, column)| Obstacle::new(feature, column, eye))
            .collect();
        let mut corners: Vec<Corner> = obstacles
            .iter()
            .flat_map(|obstacle| {
                let feature = obstacle.feature;
                obstacle.corners().map(move |place| Corner {
                    feature,
                    azimuth: place[1].atan2(place[0]),
                    place,
                })
            })
            .collect();
        corners.sort_unstable_by(|a, b| a.azimuth.total_cmp(&b.azimuth));
        Self {
            features,
            eye,
            columns,
            obstacles,
            corners,
            profile: SightProfile::default(),
            heights: Vec::new(),
            last: 0,
            joined: false,
        }
    }

    /// The same judge, for whom no segment is a witness that runs in the common wall of two features that
    /// touch: the union of all solids is taken for what hides, and the wall is inside it.
    #[must_use]
    pub fn joined(self) -> Self {
        Self {
            joined: true,
            ..self
        }
    }

    /// Whether the eye is outside of all columns and their margins.
    #[must_use]
    pub fn is_outside(&self) -> bool {
        let all: usize = self
            .features
            .iter()
            .map(|feature| feature.columns.len())
            .sum();
        self.columns.len() == all
    }

    /// Looks for a point that can be seen: corners, edges, faces and random points of the target; in
    /// the vertical planes through all corners of columns, just beside and halfway between them, the
    /// nearest and the farthest part of the target, just above and below what hides. Of these planes
    /// about `planes` are chosen at random.
    pub fn search(&mut self, left_out: &LeftOut, planes: usize, rng: &mut Rng) -> Search {
        let feature = &self.features[left_out.feature];
        let target = if left_out.prism && !feature.outline.is_empty() {
            SightTarget::of_prism(&feature.outline, &feature.bounds)
        } else {
            SightTarget::of_box(&feature.bounds)
        };
        let mut task = Task {
            left_out,
            target: &target,
            aims: 0,
        };
        let witness = self
            .at_places(&mut task, rng)
            .or_else(|| self.in_planes(&mut task, planes, rng));
        Search {
            witness,
            aims: task.aims,
        }
    }

    /// Whether a point is a witness. Exact.
    #[must_use]
    pub fn can_see(&self, left_out: &LeftOut, point: Point) -> bool {
        self.obstruction(left_out.feature, point).is_none()
            && self.is_in_range(left_out.range, point)
            && !self.lies_in_union(left_out.feature, point)
    }

    /// The position of a column whose interior the segment to a point meets.
    fn obstruction(&self, feature: usize, point: Point) -> Option<usize> {
        let order = (self.last..self.columns.len()).chain(0..self.last);
        order.into_iter().find(|&at| {
            let (other, column) = self.columns[at];
            other != feature && column.meets_segment(self.eye, point)
        })
    }

    fn is_in_range(&self, range: f64, point: Point) -> bool {
        let offsets = [0, 1, 2].map(|axis| point[axis] - self.eye[axis]);
        let distance_2: f64 = offsets.iter().map(|offset| offset * offset).sum();
        let range_2 = range * range;
        if (distance_2 - range_2).abs() > DISTANCE_SLACK * range_2 || range_2.is_infinite() {
            return distance_2 < range_2;
        }
        let exact = [0, 1, 2].map(|axis| rational(point[axis]) - rational(self.eye[axis]));
        let [x, y, z] = exact.map(|offset| &offset * &offset);
        (x + y + z).cmp(&(rational(range) * rational(range))) != Ordering::Greater
    }

    /// Whether a segment that meets no open column may still be inside a feature, or inside the union of
    /// all where they are joined.
    fn lies_in_union(&self, feature: usize, point: Point) -> bool {
        let mut touched: Vec<usize> = self
            .columns
            .iter()
            .filter(|(other, _)| self.joined || *other != feature)
            .filter(|(_, column)| column.touches_along(self.eye, point))
            .map(|(other, _)| if self.joined { 0 } else { *other })
            .collect();
        touched.sort_unstable();
        touched.windows(2).any(|pair| pair[0] == pair[1])
    }

    /// Aims at corners, middles of edges and random places of the target.
    fn at_places(&mut self, task: &mut Task, rng: &mut Rng) -> Option<Point> {
        let corners = &task.target.corners;
        let middle = task.target.middle();
        let mut places = corners.clone();
        places.push(middle);
        for (at, from) in corners.iter().enumerate() {
            let to = corners[(at + 1) % corners.len()];
            let share = if rng.bool() { 0.5 } else { rng.f64() };
            let edge = [0, 1].map(|axis| from[axis] + (to[axis] - from[axis]) * share);
            places.push(edge);
            let inward = rng.f64();
            places.push([0, 1].map(|axis| edge[axis] + (middle[axis] - edge[axis]) * inward));
        }
        places
            .into_iter()
            .find_map(|place| self.at_place(task, place))
    }

    fn at_place(&mut self, task: &mut Task, place: PlanPoint) -> Option<Point> {
        let place = task.target.nearest(place)?;
        let way = [place[0] - self.eye[0], place[1] - self.eye[1]];
        if way == [0.0, 0.0] {
            return None;
        }
        self.profile
            .look(&self.obstacles, task.left_out.feature, way, false);
        self.above(task, place, 1.0)
    }

    /// Aims at all promising heights above a place of the target, at a parameter of the profile.
    fn above(&mut self, task: &mut Task, place: PlanPoint, at: f64) -> Option<Point> {
        task.aims += 1;
        let bounds = &task.target.bounds;
        let [low, high] = [bounds.min[2], bounds.max[2]].map(|height| height - self.eye[2]);
        let mut heights = std::mem::take(&mut self.heights);
        self.profile.heights(at, low, high, &mut heights);
        let witness = heights.iter().find_map(|height| {
            let z = (self.eye[2] + height).clamp(bounds.min[2], bounds.max[2]);
            let point = [place[0], place[1], z];
            match self.obstruction(task.left_out.feature, point) {
                Some(column) => {
                    self.last = column;
                    None
                }
                None => (task.target.holds(point) && self.can_see(task.left_out, point))
                    .then_some(point),
            }
        });
        self.heights = heights;
        witness
    }

    /// Aims in vertical planes at, beside and between the corners of columns.
    fn in_planes(&mut self, task: &mut Task, planes: usize, rng: &mut Rng) -> Option<Point> {
        let corners: Vec<PlanPoint> = task
            .target
            .corners
            .iter()
            .map(|corner| [corner[0] - self.eye[0], corner[1] - self.eye[1]])
            .collect();
        let critical = self.critical(task.left_out.feature, &corners);
        // Each has three choices: through, beside, and on to the next.
        let share = planes as f64 / (3 * critical.len()).max(1) as f64;
        for (at, &way) in critical.iter().enumerate() {
            if rng.f64() < share
                && let Some(witness) = self.through(task, &corners, way, rng)
            {
                return Some(witness);
            }
            if rng.f64() < share {
                let [x, y] = way;
                let turn = BESIDE[rng.usize(..BESIDE.len())];
                let turn = if rng.bool() { turn } else { -turn };
                let beside = [x - turn * y, y + turn * x];
                if let Some(witness) = self.along(task, &corners, beside, rng) {
                    return Some(witness);
                }
            }
            if rng.f64() < share
                && let Some(&next) = critical.get(at + 1)
            {
                let unit = |[x, y]: PlanPoint| [x / x.hypot(y), y / x.hypot(y)];
                let (a, b) = (unit(way), unit(next));
                let between = [a[0] + b[0], a[1] + b[1]];
                if let Some(witness) = self.along(task, &corners, between, rng) {
                    return Some(witness);
                }
            }
        }
        None
    }

    /// The ways to corners of other features' columns that lie behind or before a target, by azimuth,
    /// and to the ends of the target itself.
    fn critical(&self, feature: usize, target: &[PlanPoint]) -> Vec<PlanPoint> {
        let azimuth = |[x, y]: PlanPoint| y.atan2(x);
        let first = azimuth(target[0]);
        // Seen from outside, a target takes less than half a turn.
        let offset = |azimuth: f64| (azimuth - first + PI).rem_euclid(TAU) - PI;
        let mut ends: Vec<(f64, PlanPoint)> = target
            .iter()
            .map(|&corner| (offset(azimuth(corner)), corner))
            .collect();
        ends.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        let (low, high) = (ends[0], ends[ends.len() - 1]);
        let mut critical: Vec<(f64, PlanPoint)> = self
            .corners
            .iter()
            .filter(|corner| corner.feature != feature)
            .map(|corner| (offset(corner.azimuth), corner.place))
            .filter(|(offset, _)| low.0 - 1e-12 <= *offset && *offset <= high.0 + 1e-12)
            .collect();
        critical.extend([low, high]);
        critical.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        critical.dedup_by(|a, b| a.1 == b.1);
        critical.into_iter().map(|(_, way)| way).collect()
    }

    /// Aims at the target along a way, near, far and before what stands in it.
    fn along(
        &mut self,
        task: &mut Task,
        target: &[PlanPoint],
        way: PlanPoint,
        rng: &mut Rng,
    ) -> Option<Point> {
        let [first, last] = chord(target, way)?;
        self.profile
            .look(&self.obstacles, task.left_out.feature, way, false);
        let mut places = vec![first, last, first + (last - first) * rng.f64()];
        places.extend(self.profile.begins(first, last).take(4));
        places.into_iter().find_map(|at| {
            let place = [self.eye[0] + way[0] * at, self.eye[1] + way[1] * at];
            let place = task.target.nearest(place)?;
            self.above(task, place, at)
        })
    }

    /// Aims at points of the target behind a corner: exactly where all are on a grid or on a line
    /// along an axis, and elsewhere but for roundings.
    fn through(
        &mut self,
        task: &mut Task,
        target: &[PlanPoint],
        way: PlanPoint,
        rng: &mut Rng,
    ) -> Option<Point> {
        let step = step(way);
        let unit = step.unwrap_or(way);
        let [mut first, mut last] = chord(target, unit)?;
        if step.is_some() && !unit.contains(&0.0) {
            (first, last) = (first.ceil(), last.floor());
        }
        if first > last {
            return None;
        }
        self.profile
            .look(&self.obstacles, task.left_out.feature, unit, true);
        let share = rng.f64();
        let mut random = first + (last - first) * share;
        if step.is_some() {
            random = random.floor();
        }
        let bounds = task.target.bounds;
        [first, last, random].into_iter().find_map(|at| {
            let place = [0, 1].map(|axis| {
                let value = self.eye[axis] + unit[axis] * at;
                value.clamp(bounds.min[axis], bounds.max[axis])
            });
            self.above(task, place, at)
        })
    }
}

/// The shortest step on the grid that leads on along a way, where the way is one of the grid.
fn step(way: PlanPoint) -> Option<PlanPoint> {
    if let Some(axis) = (0..2).find(|&axis| way[axis] == 0.0) {
        let mut step = [0.0; 2];
        step[1 - axis] = way[1 - axis].signum() / GRID;
        return (way[1 - axis] != 0.0).then_some(step);
    }
    let counts = way.map(|offset| offset * GRID);
    if counts
        .iter()
        .any(|count| count.fract() != 0.0 || count.abs() > 1e12)
    {
        return None;
    }
    let common = common_factor(counts[0].abs(), counts[1].abs());
    Some(counts.map(|count| count / common / GRID))
}

/// The greatest common divisor of two whole numbers.
fn common_factor(a: f64, b: f64) -> f64 {
    if b == 0.0 { a } else { common_factor(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rectangle(west: f64, south: f64, east: f64, north: f64) -> Vec<PlanPoint> {
        vec![[west, south], [east, south], [east, north], [west, north]]
    }

    /// A feature of boxes `[west, south, east, north]` with a top, all grounded.
    fn houses(boxes: &[[f64; 4]], top: f64) -> JudgedFeature {
        let columns = boxes.iter().map(|&[west, south, east, north]| {
            Column::new(&[rectangle(west, south, east, north)], 0.0, top, true).unwrap()
        });
        let ends = boxes
            .iter()
            .flat_map(|&[west, south, east, north]| [[west, south, 0.0], [east, north, top]]);
        JudgedFeature {
            bounds: Aabb::around(&ends.collect::<Vec<_>>()),
            outline: Vec::new(),
            columns: columns.collect(),
        }
    }

    fn thing(min: Point, max: Point) -> JudgedFeature {
        JudgedFeature {
            bounds: Aabb::new(min, max),
            outline: Vec::new(),
            columns: Vec::new(),
        }
    }

    /// What can be seen of the first feature.
    fn witness(features: &[JudgedFeature], eye: Point, range: f64, prism: bool) -> Option<Point> {
        let left_out = LeftOut {
            feature: 0,
            prism,
            range,
        };
        let mut judge = PointJudge::new(features, eye);
        let search = judge.search(&left_out, usize::MAX, &mut Rng::with_seed(1));
        assert!(search.aims > 0);
        if let Some(point) = search.witness {
            assert!(judge.can_see(&left_out, point));
        }
        search.witness
    }

    fn is_seen(features: &[JudgedFeature], eye: Point) -> bool {
        witness(features, eye, f64::INFINITY, false).is_some()
    }

    const EYE: Point = [0.0, 0.0, 1.0];

    #[test]
    fn what_is_behind_a_house_is_not_seen_and_what_stands_out_is() {
        let house = houses(&[[5.0, -4.0, 9.0, 4.0]], 4.0);
        let behind = |top: f64| thing([12.0, -2.0, 0.0], [14.0, 2.0, top]);
        assert!(!is_seen(&[behind(3.0), house.clone()], EYE));
        assert!(is_seen(&[behind(9.5), house.clone()], EYE));
        assert!(is_seen(
            &[thing([12.0, -2.0, 0.0], [14.0, 30.0, 1.0]), house],
            EYE
        ));
    }

    #[test]
    fn flush_is_seen() {
        let house = houses(&[[5.0, -4.0, 9.0, 4.0]], 4.0);
        assert!(is_seen(
            &[thing([5.0, -1.0, 1.0], [5.0, 1.0, 2.0]), house.clone()],
            EYE
        ));
        assert!(!is_seen(
            &[thing([9.0, -1.0, 1.0], [9.0, 1.0, 2.0]), house],
            EYE
        ));
    }

    #[test]
    fn a_feature_never_hides_itself() {
        let house = houses(&[[5.0, -4.0, 6.0, 4.0], [8.0, -1.0, 9.0, 1.0]], 4.0);
        assert!(is_seen(&[house], EYE));
    }

    #[test]
    fn between_two_features_back_to_back_one_looks_through_and_within_one_not() {
        let sign = thing([9.0, -2.0, 0.0], [9.0, 2.0, 1.0]);
        let (left, right) = ([5.0, 0.0, 8.0, 9.0], [5.0, -9.0, 8.0, 0.0]);
        let two = [sign.clone(), houses(&[left], 4.0), houses(&[right], 4.0)];
        assert_eq!(
            witness(&two, EYE, f64::INFINITY, false).map(|[_, y, _]| y),
            Some(0.0)
        );
        assert!(!is_seen(&[sign, houses(&[left, right], 4.0)], EYE));
    }

    #[test]
    fn past_corners_on_one_line_one_sees_along_it() {
        let sign = thing([20.0, 10.0, 0.0], [20.0, 30.0, 1.0]);
        let (near, far) = ([3.0, 4.0, 5.0, 90.0], [8.0, -90.0, 9.0, 8.0]);
        let target = |gap: f64| {
            let far = [far[0], far[1], far[2], far[3] - gap];
            [
                sign.clone(),
                houses(&[[near[0], near[1], 4.0, 90.0]], 9.0),
                houses(&[far], 9.0),
            ]
        };
        // The near house ends at (4, 4) for the eye, the far one at (8, 8).
        assert_eq!(
            witness(&target(0.0), EYE, f64::INFINITY, false).map(|[x, y, _]| [x, y]),
            Some([20.0, 20.0])
        );
        assert!(!is_seen(&target(-1e-9), EYE));
        assert!(is_seen(&target(1e-9), EYE));
    }

    #[test]
    fn a_house_within_a_millimetre_of_the_eye_hides_nothing() {
        let behind = thing([12.0, -2.0, 0.0], [14.0, 2.0, 3.0]);
        let house = |west: f64| houses(&[[west, -4.0, 9.0, 4.0]], 4.0);
        assert!(is_seen(&[behind.clone(), house(-1.0)], EYE));
        assert!(is_seen(&[behind.clone(), house(0.0)], EYE));
        assert!(is_seen(&[behind.clone(), house(0.0009)], EYE));
        assert!(!is_seen(&[behind, house(0.0011)], EYE));
    }

    #[test]
    fn one_sees_under_a_bridge_and_not_under_a_house() {
        let behind = thing([12.0, -2.0, 0.0], [14.0, 2.0, 3.0]);
        let deck = |grounded: bool| {
            let rings = [rectangle(5.0, -90.0, 9.0, 90.0)];
            let column = Column::new(&rings, 2.0, 90.0, grounded).unwrap();
            JudgedFeature {
                bounds: Aabb::new([5.0, -90.0, 2.0], [9.0, 90.0, 90.0]),
                outline: Vec::new(),
                columns: vec![column],
            }
        };
        assert!(is_seen(&[behind.clone(), deck(false)], EYE));
        assert!(!is_seen(&[behind, deck(true)], EYE));
    }

    #[test]
    fn range_is_a_distance_and_closed() {
        let point = thing([3.0, 4.0, 13.0], [3.0, 4.0, 13.0]);
        let seen = |range: f64| witness(std::slice::from_ref(&point), EYE, range, false).is_some();
        assert!(seen(13.0));
        assert!(!seen(13.0_f64.next_down()));
    }

    #[test]
    fn of_a_prism_only_the_prism_counts() {
        let mut feature = thing([12.0, -4.0, 0.0], [16.0, 4.0, 3.0]);
        feature.outline = vec![
            [12.0, 0.0],
            [14.0, -1.0],
            [16.0, 0.0],
            [14.0, 4.0],
            [13.0, 1.0],
        ];
        feature.outline.pop();
        let features = [feature, houses(&[[5.0, -1.0, 9.0, 3.0]], 9.0)];
        let seen = |prism: bool| witness(&features, EYE, f64::INFINITY, prism).is_some();
        assert!(seen(false));
        assert!(!seen(true));
    }
}
