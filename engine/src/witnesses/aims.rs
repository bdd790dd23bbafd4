//! [`Aims`], where to look for a feature.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};

use crate::Box3d;

/// How far from an edge into its triangle one aims, metres: a line through an edge touches, which proves
/// nothing.
const INWARD: f64 = 0.01;

/// The same at most, as a share of the way across the triangle.
const MOST_INWARD: f64 = 0.25;

/// Share of the directions of a surface below which a gap is not looked through.
const NARROW: f64 = 1e-3;

/// The additive recurrence of the plastic number fills a square evenly (Roberts 2018, "The unreasonable
/// effectiveness of quasirandom sequences").
const STEPS: [f64; 2] = [0.754_877_666_246_692_8, 0.569_840_290_998_053_2];

/// Places on a surface that may be seen from an eye.
///
/// What hides stands on the ground, mostly: of all that lies in one direction the top is seen if anything
/// is. So tops are taken, in the middle of the widest gap that what was found in the way leaves.
pub struct Aims<'a> {
    eye: DVec3,
    triangles: &'a [[DVec3; 3]],
    /// Along which directions gain something across; zero where the surface takes half of all directions
    /// or more.
    axis: DVec2,
    /// Directions in which nothing is known to be in the way, by what they gain for each metre along.
    gaps: Vec<[f64; 2]>,
    /// Gaps of this width or less are none.
    narrow: f64,
}

impl<'a> Aims<'a> {
    /// Those at a surface.
    pub fn new(eye: DVec3, triangles: &'a [[DVec3; 3]]) -> Self {
        let (axis, gaps) = match width(eye, triangles) {
            Some((axis, gains)) => (axis, vec![gains]),
            None => (DVec2::ZERO, Vec::new()),
        };
        Self {
            narrow: gaps
                .first()
                .map_or(0.0, |[low, high]| NARROW * (high - low)),
            axis,
            gaps,
            eye,
            triangles,
        }
    }

    /// Just below the highest place in the middle of the widest gap.
    pub fn next_top(&self) -> Option<DVec3> {
        let width = |[low, high]: &[f64; 2]| high - low;
        let gaps = self.gaps.iter().filter(|gap| width(gap) > self.narrow);
        let [low, high] = gaps.max_by(|a, b| width(a).total_cmp(&width(b)))?;
        self.top(low.midpoint(*high))
    }

    /// Takes out the directions in which some triangles, which are in the way of a place, rise as high as
    /// that or higher.
    pub fn close(&mut self, place: DVec3, triangles: &[&[DVec3; 3]]) {
        let way = place - self.eye;
        let along = self.axis.dot(way.truncate());
        let gain = self.axis.perp_dot(way.truncate()) / along;
        for triangle in triangles {
            let high = self.rising(triangle, way.z / along);
            let [low, high] = gains(self.eye, self.axis, high.iter()).unwrap_or([gain, gain]);
            let [low, high] = [low.min(gain - self.narrow), high.max(gain + self.narrow)];
            let left = self.gaps.iter().flat_map(|&[from, to]| {
                [[from, to.min(low)], [from.max(high), to]]
                    .into_iter()
                    .filter(|[from, to]| from < to)
            });
            self.gaps = left.collect();
        }
    }

    /// The corners of that part of a triangle that is seen over a slope or higher.
    fn rising(&self, triangle: &[DVec3; 3], slope: f64) -> Vec<DVec3> {
        let above = triangle.map(|corner| {
            let way = corner - self.eye;
            way.z - slope * self.axis.dot(way.truncate())
        });
        let mut corners = Vec::with_capacity(4);
        for (from, to) in [(0, 1), (1, 2), (2, 0)] {
            if above[from] >= 0.0 {
                corners.push(triangle[from]);
            }
            if (above[from] < 0.0) != (above[to] < 0.0) {
                let share = above[from] / (above[from] - above[to]);
                corners.push(triangle[from].lerp(triangle[to], share));
            }
        }
        corners
    }

    /// Some places, spread evenly over what looks large.
    pub fn anywhere(&self, most: usize) -> impl Iterator<Item = DVec3> {
        let mut sum = 0.0;
        let ends: Vec<f64> = self
            .triangles
            .iter()
            .map(|triangle| {
                sum += size(self.eye, triangle);
                sum
            })
            .collect();
        (1..=most).filter_map(move |number| {
            let [u, v] = STEPS.map(|step| (number as f64 * step).fract());
            let target = u * sum;
            let at = ends.partition_point(|&end| end <= target);
            let begin = if at == 0 { 0.0 } else { ends[at - 1] };
            let triangle = self.triangles.get(at)?;
            Some(place(triangle, (target - begin) / (ends[at] - begin), v))
        })
    }

    /// Just below the highest place in a direction.
    fn top(&self, gain: f64) -> Option<DVec3> {
        let mut highest: Option<(f64, DVec3, DVec3)> = None;
        for triangle in self.triangles {
            let beside = triangle.map(|corner| {
                let way = (corner - self.eye).truncate();
                self.axis.perp_dot(way) - gain * self.axis.dot(way)
            });
            for (from, to) in [(0, 1), (1, 2), (2, 0)] {
                if (beside[from] < 0.0) == (beside[to] < 0.0) {
                    continue;
                }
                let share = beside[from] / (beside[from] - beside[to]);
                let place = triangle[from].lerp(triangle[to], share);
                let way = place - self.eye;
                let slope = way.z / self.axis.dot(way.truncate());
                if highest.is_none_or(|(other, ..)| slope > other) {
                    highest = Some((slope, place, triangle[3 - from - to]));
                }
            }
        }
        let (_, place, across) = highest?;
        let share = INWARD / place.distance(across).max(f64::MIN_POSITIVE);
        Some(place.lerp(across, share.min(MOST_INWARD)))
    }
}

/// The directions of a surface, by an axis and what they gain across; `None` where that is half of all or
/// more.
fn width(eye: DVec3, triangles: &[[DVec3; 3]]) -> Option<(DVec2, [f64; 2])> {
    let corners = || triangles.iter().flatten();
    let bounds = Box3d::around(corners().copied())?;
    let axis = (bounds.center() - eye).truncate().try_normalize()?;
    Some((axis, gains(eye, axis, corners())?))
}

/// The least and the greatest gain of some places; `None` unless all are ahead.
fn gains<'t>(eye: DVec3, axis: DVec2, places: impl Iterator<Item = &'t DVec3>) -> Option<[f64; 2]> {
    let mut range = [f64::INFINITY, f64::NEG_INFINITY];
    for place in places {
        let way = (*place - eye).truncate();
        let along = axis.dot(way);
        if along <= 0.0 {
            return None;
        }
        let gain = axis.perp_dot(way) / along;
        range = [range[0].min(gain), range[1].max(gain)];
    }
    Some(range)
}

/// About how large a triangle looks, front or back.
fn size(eye: DVec3, [a, b, c]: &[DVec3; 3]) -> f64 {
    let way = (*a + *b + *c) / 3.0 - eye;
    let distance = way.length().max(f64::MIN_POSITIVE);
    let area = (*b - *a).cross(*c - *a);
    let size = area.dot(way).abs() / distance.powi(3);
    // The eye may be on the triangle.
    if size.is_finite() {
        size.min(2.0 * PI)
    } else {
        0.0
    }
}

/// A place in a triangle, evenly over it for `u` and `v` in [0, 1).
fn place([a, b, c]: &[DVec3; 3], u: f64, v: f64) -> DVec3 {
    let root = u.sqrt();
    *a * (1.0 - root) + *b * (root * (1.0 - v)) + *c * (root * v)
}
