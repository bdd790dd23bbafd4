//! Roofs that are folded along parallel lines, over footprints of any form.

use std::collections::HashMap;
use std::f64::consts::TAU;

use geo::{Contains, Point, Polygon};

use super::extruded::RoofSurfaces;
use super::footprint::{is_inside, line_string, signed_area};
use super::frame::{dot, left, minus};
use super::{Footprint, Plan, Rings};

/// A vertex this close to a fold lies on it, metres: no facet is thinner.
const ON_FOLD: f64 = 1e-5;

/// The cross-section of a roof.
pub(super) struct Profile {
    /// Where distances are measured from.
    pub(super) origin: Plan,
    /// Unit vector across the folds.
    pub(super) down: Plan,
    /// The folds: shares of the width from −1 to 1, ascending, each with its share of the rise.
    pub(super) folds: Vec<[f64; 2]>,
}

/// The roof over a footprint; none where the facets cannot be put together.
pub(super) fn fold(
    footprint: &Footprint,
    profile: &Profile,
    eaves: f64,
    rise: f64,
) -> Option<RoofSurfaces> {
    let mut net = Net::new(footprint, profile, eaves, rise)?;
    let rims: Vec<_> = footprint.rings().iter().map(|ring| net.rim(ring)).collect();
    net.ridges(&footprint.polygon());
    let faces = net.facets()?;
    let place = |rim: &Vec<Vec<usize>>| {
        let above = |edge: &Vec<usize>| edge.iter().map(|i| net.vertices[*i].position).collect();
        rim.iter().map(above).collect()
    };
    Some(RoofSurfaces {
        rims: rims.iter().map(place).collect(),
        faces,
    })
}

/// A vertex of the roof.
struct Vertex {
    position: [f64; 3],
    /// Distance across the folds.
    across: f64,
    /// The fold that it lies on.
    fold: Option<usize>,
}

/// The edges of the facets, each with its facet to the left.
struct Net<'a> {
    profile: &'a Profile,
    /// Distance across and height of each fold.
    folds: Vec<[f64; 2]>,
    vertices: Vec<Vertex>,
    /// Vertices by the bits of their place in plan: rings may touch.
    numbers: HashMap<[u64; 2], usize>,
    /// For each strip between two folds its edges, from vertex to vertices.
    strips: Vec<HashMap<usize, Vec<usize>>>,
}

impl<'a> Net<'a> {
    fn new(footprint: &Footprint, profile: &'a Profile, eaves: f64, rise: f64) -> Option<Self> {
        let across = |p: &Plan| dot(minus(*p, profile.origin), profile.down);
        let outer = footprint.rings().first()?;
        let low = outer.iter().map(across).fold(f64::INFINITY, f64::min);
        let high = outer.iter().map(across).fold(f64::NEG_INFINITY, f64::max);
        let middle = (low + high) / 2.0;
        let half = (high - low) / 2.0;
        let place = |fold: &[f64; 2]| [middle + half * fold[0], eaves + rise * fold[1]];
        let mut folds: Vec<_> = profile.folds.iter().map(place).collect();
        // The outermost folds are where the footprint ends, to the bit.
        folds.first_mut()?[0] = low;
        folds.last_mut()?[0] = high;
        let wide_enough = folds
            .windows(2)
            .all(|pair| pair[1][0] - pair[0][0] > 3.0 * ON_FOLD);
        wide_enough.then(|| Self {
            profile,
            strips: vec![HashMap::new(); folds.len() - 1],
            folds,
            vertices: Vec::new(),
            numbers: HashMap::new(),
        })
    }

    /// The vertices above each edge of a ring, cut at the folds; their edges go to their strips.
    fn rim(&mut self, ring: &[Plan]) -> Vec<Vec<usize>> {
        let ends = ring.iter().skip(1).chain(ring.first());
        let edges: Vec<_> = ring.iter().zip(ends).collect();
        let rim: Vec<_> = edges.into_iter().map(|(a, b)| self.cut(*a, *b)).collect();
        let all: Vec<usize> = rim.iter().flatten().copied().collect();
        for (from, to) in all.iter().zip(all.iter().skip(1).chain(all.first())) {
            if let Some(strip) = self.strip(*from, *to) {
                self.connect(strip, *from, *to);
            }
        }
        rim
    }

    /// The start of an edge and where it passes folds.
    fn cut(&mut self, a: Plan, b: Plan) -> Vec<usize> {
        let (from, to) = (self.vertex(a), self.vertex(b));
        let (start, end) = (self.vertices[from].across, self.vertices[to].across);
        let passed = |d: f64| (start < d && d < end) || (end < d && d < start);
        let mut passed: Vec<usize> = (0..self.folds.len())
            .filter(|i| passed(self.folds[*i][0]))
            .collect();
        if end < start {
            passed.reverse();
        }
        let mut above = vec![from];
        for fold in passed {
            let [across, z] = self.folds[fold];
            let share = (across - start) / (end - start);
            let position = [
                a[0] + (b[0] - a[0]) * share,
                a[1] + (b[1] - a[1]) * share,
                z,
            ];
            above.push(self.number(Vertex {
                position,
                across,
                fold: Some(fold),
            }));
        }
        above
    }

    /// The vertex above a place of the footprint.
    fn vertex(&mut self, [x, y]: Plan) -> usize {
        let across = dot(minus([x, y], self.profile.origin), self.profile.down);
        let near = |fold: &[f64; 2]| (fold[0] - across).abs() <= ON_FOLD;
        let fold = self.folds.iter().position(near);
        let [across, z] = match fold {
            Some(fold) => self.folds[fold],
            None => [across, self.height(across)],
        };
        self.number(Vertex {
            position: [x, y, z],
            across,
            fold,
        })
    }

    fn number(&mut self, vertex: Vertex) -> usize {
        let [x, y, _] = vertex.position.map(f64::to_bits);
        *self.numbers.entry([x, y]).or_insert_with(|| {
            self.vertices.push(vertex);
            self.vertices.len() - 1
        })
    }

    /// Height of the roof between two folds.
    fn height(&self, across: f64) -> f64 {
        let pairs = self.folds.windows(2).map(|pair| (pair[0], pair[1]));
        let inside = |(_, high): &([f64; 2], [f64; 2])| across <= high[0];
        let last = (
            self.folds[self.folds.len() - 2],
            self.folds[self.folds.len() - 1],
        );
        let (low, high) = pairs.into_iter().find(inside).unwrap_or(last);
        let share = ((across - low[0]) / (high[0] - low[0])).clamp(0.0, 1.0);
        low[1] + (high[1] - low[1]) * share
    }

    /// The strip to the left of an edge; none outside of the outermost folds.
    fn strip(&self, from: usize, to: usize) -> Option<usize> {
        let (a, b) = (&self.vertices[from], &self.vertices[to]);
        if let (Some(fold), true) = (a.fold, a.fold == b.fold) {
            let along = minus(
                [b.position[0], b.position[1]],
                [a.position[0], a.position[1]],
            );
            return match dot(left(along), self.profile.down) > 0.0 {
                true => (fold < self.strips.len()).then_some(fold),
                false => fold.checked_sub(1),
            };
        }
        let middle = (a.across + b.across) / 2.0;
        let strips = self.folds.windows(2);
        let last = self.strips.len() - 1;
        Some(
            strips
                .into_iter()
                .position(|pair| middle < pair[1][0])
                .unwrap_or(last),
        )
    }

    fn connect(&mut self, strip: usize, from: usize, to: usize) {
        self.strips[strip].entry(from).or_default().push(to);
    }

    /// Edges along the folds, wherever these are inside of the area.
    fn ridges(&mut self, area: &Polygon) {
        let ridge = left(self.profile.down);
        for fold in 1..self.folds.len() - 1 {
            let on_fold = |i: &usize| self.vertices[*i].fold == Some(fold);
            let mut row: Vec<usize> = (0..self.vertices.len()).filter(on_fold).collect();
            let along = |i: usize| {
                let [x, y, _] = self.vertices[i].position;
                dot(minus([x, y], self.profile.origin), ridge)
            };
            row.sort_by(|a, b| along(*a).total_cmp(&along(*b)));
            for pair in row.windows(2) {
                let (a, b) = (pair[0], pair[1]);
                let is_rim = |from: usize, to: usize| {
                    let strips = [fold - 1, fold];
                    strips
                        .iter()
                        .any(|s| self.strips[*s].get(&from).is_some_and(|t| t.contains(&to)))
                };
                if is_rim(a, b) || is_rim(b, a) {
                    continue;
                }
                let (p, q) = (self.vertices[a].position, self.vertices[b].position);
                let middle = Point::new((p[0] + q[0]) / 2.0, (p[1] + q[1]) / 2.0);
                if area.contains(&middle) {
                    // To the left of the ridge's direction is the lower strip.
                    self.connect(fold - 1, a, b);
                    self.connect(fold, b, a);
                }
            }
        }
    }

    /// The facets of all strips.
    fn facets(&self) -> Option<Vec<Rings>> {
        let mut facets = Vec::new();
        for strip in &self.strips {
            let mut rings = self.rings(strip.clone())?;
            let plan = |ring: &[usize]| -> Vec<Plan> {
                ring.iter()
                    .map(|i| self.vertices[*i].position)
                    .map(|[x, y, _]| [x, y])
                    .collect()
            };
            let (outer, holes): (Vec<_>, Vec<_>) = rings
                .drain(..)
                .partition(|ring| signed_area(&plan(ring)) > 0.0);
            let areas: Vec<_> = outer
                .iter()
                .map(|ring| Polygon::new(line_string(&plan(ring)), vec![]))
                .collect();
            let first = facets.len();
            facets.extend(outer.iter().map(|ring| vec![self.place(ring)]));
            for hole in holes {
                let hole_plan = plan(&hole);
                let around = areas.iter().position(|area| is_inside(&hole_plan, area))?;
                facets[first + around].push(self.place(&hole));
            }
        }
        Some(facets)
    }

    fn place(&self, ring: &[usize]) -> Vec<[f64; 3]> {
        ring.iter().map(|i| self.vertices[*i].position).collect()
    }

    /// The rings that edges form, each turning left as sharply as it can, so that none touches
    /// itself more than it must.
    fn rings(&self, mut edges: HashMap<usize, Vec<usize>>) -> Option<Vec<Vec<usize>>> {
        let mut starts: Vec<usize> = edges.keys().copied().collect();
        starts.sort_unstable();
        let mut rings = Vec::new();
        for start in starts {
            while let Some(first) = edges.get_mut(&start).and_then(Vec::pop) {
                let mut ring = vec![start];
                let (mut from, mut at) = (start, first);
                while at != start {
                    ring.push(at);
                    let next = self.take_leftmost(edges.get_mut(&at)?, from, at)?;
                    (from, at) = (at, next);
                }
                if ring.len() < 3 {
                    return None;
                }
                rings.push(ring);
            }
        }
        Some(rings)
    }

    fn take_leftmost(&self, choices: &mut Vec<usize>, from: usize, at: usize) -> Option<usize> {
        let angle = |to: usize| {
            let (p, q) = (self.vertices[at].position, self.vertices[to].position);
            (q[1] - p[1]).atan2(q[0] - p[0])
        };
        let turn = |to: usize| (angle(to) - angle(from)).rem_euclid(TAU);
        let best =
            (0..choices.len()).max_by(|i, j| turn(choices[*i]).total_cmp(&turn(choices[*j])))?;
        Some(choices.swap_remove(best))
    }
}
