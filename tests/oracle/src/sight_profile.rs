//! [`SightProfile`], what stands in a vertical plane through the eye, in `f64`: where to aim. Nothing
//! here decides anything.

use crate::column::Column;
use crate::plane::{PlanPoint, ring_edges};

/// A column as it is seen from the eye, relative to it.
#[derive(Clone, Debug)]
pub(crate) struct Obstacle {
    /// Position of its feature.
    pub(crate) feature: usize,
    /// Rings one after the other, as edges.
    edges: Vec<[PlanPoint; 2]>,
    bottom: f64,
    top: f64,
}

impl Obstacle {
    pub(crate) fn new(feature: usize, column: &Column, eye: [f64; 3]) -> Self {
        let relative = |[x, y]: PlanPoint| [x - eye[0], y - eye[1]];
        let edges = column.footprint.edges.iter();
        Self {
            feature,
            edges: edges.map(|edge| edge.map(relative)).collect(),
            bottom: column.solid_bottom() - eye[2],
            top: column.top - eye[2],
        }
    }

    /// Where its edges begin.
    pub(crate) fn corners(&self) -> impl Iterator<Item = PlanPoint> {
        self.edges.iter().map(|edge| edge[0])
    }
}

/// Between which parameters of a ray a column stands, and its heights.
#[derive(Clone, Copy, Debug)]
struct Slab {
    enter: f64,
    leave: f64,
    bottom: f64,
    top: f64,
}

impl Slab {
    /// The slopes to which it hides what is at a parameter, as heights there.
    fn hidden_at(&self, at: f64) -> Option<[f64; 2]> {
        let leave = self.leave.min(at);
        if self.enter >= leave {
            return None;
        }
        let over = |height: f64, by: f64| match by == 0.0 {
            true if height == 0.0 => 0.0,
            true => height * f64::INFINITY,
            false => height / by * at,
        };
        let high = over(self.top, self.enter).max(over(self.top, leave));
        let low = over(self.bottom, self.enter).min(over(self.bottom, leave));
        Some([low, high])
    }
}

/// On which side a corner counts that a ray goes through.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Tie {
    Left,
    Right,
}

/// The columns along one ray in plan.
#[derive(Clone, Debug, Default)]
pub(crate) struct SightProfile {
    slabs: Vec<Slab>,
    crossings: Vec<f64>,
}

impl SightProfile {
    /// Looks along `way` from the eye, past all but one feature. `through` is set where the ray goes
    /// through corners: then only what is met on both sides of it counts.
    pub(crate) fn look(
        &mut self,
        obstacles: &[Obstacle],
        feature: usize,
        way: PlanPoint,
        through: bool,
    ) {
        self.slabs.clear();
        for obstacle in obstacles.iter().filter(|other| other.feature != feature) {
            if through && !self.cross(obstacle, way, Tie::Right) {
                continue;
            }
            if !self.cross(obstacle, way, Tie::Left) {
                continue;
            }
            for pair in self.crossings.chunks_exact(2) {
                if pair[1] > 0.0 {
                    self.slabs.push(Slab {
                        enter: pair[0].max(0.0),
                        leave: pair[1],
                        bottom: obstacle.bottom,
                        top: obstacle.top,
                    });
                }
            }
        }
    }

    /// Finds where a ray meets the outline of an obstacle; returns whether it does.
    fn cross(&mut self, obstacle: &Obstacle, way: PlanPoint, tie: Tie) -> bool {
        self.crossings.clear();
        crossings(&obstacle.edges, way, tie, &mut self.crossings);
        self.crossings.sort_unstable_by(f64::total_cmp);
        !self.crossings.is_empty()
    }

    /// Parameters at which columns begin between two others.
    pub(crate) fn begins(&self, from: f64, to: f64) -> impl Iterator<Item = f64> {
        let enters = self.slabs.iter().map(|slab| slab.enter);
        enters.filter(move |enter| from < *enter && *enter < to)
    }

    /// Adds heights between `low` and `high`, relative to the eye, that may be seen at a parameter:
    /// the ends, and just above and below what hides.
    pub(crate) fn heights(&self, at: f64, low: f64, high: f64, found: &mut Vec<f64>) {
        found.clear();
        let hidden = |height: f64| {
            self.slabs
                .iter()
                .filter_map(|slab| slab.hidden_at(at))
                .any(|[from, to]| {
                    let slack = 1e-13 * height.abs();
                    from + slack < height && height < to - slack
                })
        };
        found.extend([high, low, low + (high - low) / 2.0]);
        let ends = self
            .slabs
            .iter()
            .filter_map(|slab| slab.hidden_at(at))
            .flatten();
        for end in ends.filter(|end| low <= *end && *end <= high) {
            let step = 1e-9 * end.abs().max(1.0);
            found.extend([end, end + step, end - step, end + 1e-5, end - 1e-5]);
            found.extend([end + (high - end) / 2.0, low + (end - low) / 2.0]);
        }
        found.retain(|height| !hidden(*height));
    }
}

/// The parameters at which a line through the eye crosses edges.
fn crossings(edges: &[[PlanPoint; 2]], way: PlanPoint, tie: Tie, found: &mut Vec<f64>) {
    let length_2 = way[0] * way[0] + way[1] * way[1];
    let side = |[x, y]: PlanPoint| way[0] * y - way[1] * x;
    let is_left = |side: f64| side > 0.0 || (side == 0.0 && tie == Tie::Left);
    let along = |[x, y]: PlanPoint| (way[0] * x + way[1] * y) / length_2;
    for &[u, v] in edges {
        let (from, to) = (side(u), side(v));
        if is_left(from) == is_left(to) {
            continue;
        }
        let (begin, end) = (along(u), along(v));
        found.push(begin + (end - begin) * (from / (from - to)));
    }
}

/// Between which parameters a ray is within a convex polygon, relative to the eye.
pub(crate) fn chord(corners: &[PlanPoint], way: PlanPoint) -> Option<[f64; 2]> {
    let edges: Vec<_> = ring_edges(corners).collect();
    let mut found = Vec::new();
    crossings(&edges, way, Tie::Left, &mut found);
    let first = found.iter().copied().fold(f64::INFINITY, f64::min).max(0.0);
    let last = found.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    (first <= last).then_some([first, last])
}
