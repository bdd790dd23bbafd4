//! What hides a target: few features which, with nothing else, still do.

use std::collections::HashSet;
use std::ops::{ControlFlow, Range};

use glam::{DVec2, DVec3};

use super::EYE_MARGIN;
use super::horizon::Horizon;
use super::occluder::{Measure, Wall};
use super::projection::Span;
use super::solver::{PointQuery, PointSolver, TileSource, Walker, depth, is_shallow, plan_corners};
use super::target::{edge_slopes, outline_slopes};
use super::tile::Tile;
use crate::{Box3d, OuterPrism, Roof};

/// A feature of which one asks what hides it.
#[derive(Clone, Copy, Debug)]
pub struct PointTarget<'a> {
    /// Its number; no feature with it is taken to hide it.
    pub id: i64,
    /// Outer envelope, metres.
    pub envelope: Box3d,
    /// What is to be hidden of it.
    pub shape: TargetShape<'a>,
}

/// What holds all that can be seen of a feature.
#[derive(Clone, Copy, Debug)]
pub enum TargetShape<'a> {
    /// Its outer envelope.
    Envelope,
    /// Its outer prism, by corners of which the convex hull is taken.
    Prism(&'a [DVec2]),
    /// Its mesh, by where it is seen highest.
    Roof(&'a Roof),
}

/// A feature that takes part in hiding a target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hider {
    /// Number of the feature.
    pub id: i64,
    /// Position of its tile.
    pub tile: usize,
    /// Its position in the tile.
    pub feature: usize,
    /// Distance of its outer envelope from the eye, metres.
    pub distance: f64,
}

impl PointSolver {
    /// The features that, with nothing else, hide all of a target from an eye, nearest box in plan
    /// first; `None` where it may be seen, and always where the eye is in the plan of its envelope.
    ///
    /// The set is found hidden by the same horizon as [`Self::solve`] uses, raised anew by the walls of
    /// these features alone. None of them can be left out. Those that hide a wide part of the target by
    /// themselves are preferred, and of equal ones the nearest.
    ///
    /// # Errors
    /// Those of the source.
    pub fn hidden_by<S: TileSource>(
        &mut self,
        eye: DVec3,
        target: &PointTarget<'_>,
        source: &mut S,
    ) -> Result<Option<Vec<Hider>>, S::Error> {
        let limit = depth(eye, &target.envelope);
        let Some(lines) = lines(eye, target).filter(|_| limit > EYE_MARGIN) else {
            return Ok(None);
        };
        self.begin();
        shut(&mut self.horizon, &lines);
        let mut search = Search {
            limit,
            is_shallow: is_shallow(eye, &target.envelope),
            known: HashSet::from([target.id]),
            candidates: Vec::new(),
            walls: Vec::new(),
        };
        let query = PointQuery {
            eye,
            range: f64::INFINITY,
            prisms: false,
            wedge: None,
        };
        self.walk(&query, source, &mut search)?;
        let mut trial = Trial {
            lines: &lines,
            walls: &search.walls,
            horizon: &mut self.horizon,
        };
        Ok(trial.smallest(search.candidates))
    }
}

/// The lines of a target's highest slopes; none where they are not known.
fn lines(eye: DVec3, target: &PointTarget<'_>) -> Option<Vec<Span>> {
    let mut lines = Vec::new();
    let mut add = |line: &Span| {
        lines.push(*line);
        ControlFlow::Continue(())
    };
    let top = target.envelope.max.z - eye.z;
    let flow = match target.shape {
        TargetShape::Envelope => outline_slopes(&plan_corners(eye, &target.envelope), top, add),
        TargetShape::Prism(outline) => {
            let prism = OuterPrism::around(outline.iter().map(|corner| corner.extend(0.0)))?;
            let corners = prism.hull.iter().map(|corner| corner - eye.truncate());
            outline_slopes(&corners.collect::<Vec<_>>(), top, add)
        }
        TargetShape::Roof(roof) => roof.edges.iter().try_for_each(|edge| {
            let [from, to] = edge.map(|end| roof.corners[end as usize] - eye);
            edge_slopes(from, to, &mut add)
        }),
    };
    (flow.is_continue() && !lines.is_empty()).then_some(lines)
}

/// Raises a horizon to the lines of a target, and beside them above all: what is below it cannot take
/// part in hiding the target.
fn shut(horizon: &mut Horizon, lines: &[Span]) {
    horizon.shut_beside(lines);
    for line in lines {
        horizon.raise(line);
    }
}

/// A feature that may take part.
#[derive(Clone, Debug)]
struct Candidate {
    hider: Hider,
    walls: Range<usize>,
}

/// Gathers what may take part: what rises above the lines of the target, nearer than all of it.
struct Search {
    limit: f64,
    /// Whether walls with air below them hide the target.
    is_shallow: bool,
    /// A feature may be met once for each tile that it stands in.
    known: HashSet<i64>,
    candidates: Vec<Candidate>,
    walls: Vec<Wall>,
}

impl Walker for Search {
    fn wants(&self, query: &PointQuery, bounds: &Box3d) -> bool {
        depth(query.eye, bounds) < self.limit
    }

    fn advance(&mut self, _: &mut PointSolver, _: f64) {}

    fn meet(
        &mut self,
        solver: &mut PointSolver,
        query: &PointQuery,
        tile_position: usize,
        tile: &Tile,
        position: usize,
    ) {
        let feature = &tile.features[position];
        if !self.known.insert(feature.id) {
            return;
        }
        let first = self.walls.len();
        let (finder, horizon) = (&mut solver.finder, &solver.horizon);
        finder.walls(
            tile,
            feature,
            query.eye,
            Measure::Slope,
            &|_, _| true,
            &mut |wall| {
                let may_hide = self.is_shallow || !wall.is_raised;
                if may_hide && wall.depth < self.limit && !horizon.covers(&wall.slopes) {
                    self.walls.push(wall);
                }
            },
        );
        if first < self.walls.len() {
            self.candidates.push(Candidate {
                hider: Hider {
                    id: feature.id,
                    tile: tile_position,
                    feature: position,
                    distance: feature.envelope.distance_to_point(query.eye),
                },
                walls: first..self.walls.len(),
            });
        }
    }
}

/// Tries whether some candidates hide the target.
struct Trial<'a> {
    lines: &'a [Span],
    walls: &'a [Wall],
    horizon: &'a mut Horizon,
}

impl Trial<'_> {
    /// A set of candidates, given nearest first, that hides the target, and of which none can be left
    /// out.
    fn smallest(&mut self, candidates: Vec<Candidate>) -> Option<Vec<Hider>> {
        let mut open: Vec<(f64, usize)> = (0..candidates.len())
            .map(|at| (self.seen_past(&candidates[at]), at))
            .collect();
        open.sort_by(|a, b| a.0.total_cmp(&b.0));
        let open: Vec<usize> = open.into_iter().map(|(_, at)| at).collect();
        let mut open = &open[..];
        // As many of the first as are needed beside the members: the last of them is a member too.
        let mut members: Vec<usize> = Vec::new();
        let mut hide = |members: &[usize], more: &[usize]| {
            self.raise(members.iter().chain(more).map(|&at| &candidates[at]));
            self.is_hidden()
        };
        while !hide(&members, &[]) {
            if !hide(&members, open) {
                return None;
            }
            let (mut too_few, mut enough) = (0, open.len());
            while enough - too_few > 1 {
                let middle = usize::midpoint(too_few, enough);
                if hide(&members, &open[..middle]) {
                    enough = middle;
                } else {
                    too_few = middle;
                }
            }
            members.push(open[enough - 1]);
            open = &open[..enough - 1];
        }
        // A member that roundings have let in can be left out still.
        let mut at = 0;
        while at < members.len() {
            let mut fewer = members.clone();
            fewer.remove(at);
            if hide(&fewer, &[]) {
                members = fewer;
                at = 0;
            } else {
                at += 1;
            }
        }
        members.sort_unstable();
        let is_hidden = hide(&members, &[]);
        is_hidden.then(|| members.iter().map(|&at| candidates[at].hider).collect())
    }

    /// How much of the target, in places, is seen past one candidate.
    fn seen_past(&mut self, candidate: &Candidate) -> f64 {
        self.raise([candidate].into_iter());
        let mut width = 0.0;
        for line in self.lines {
            self.horizon.gaps(line, &mut |from, to| width += to - from);
        }
        width
    }

    /// The horizon of some candidates and nothing else.
    fn raise<'c>(&mut self, candidates: impl Iterator<Item = &'c Candidate>) {
        self.horizon.clear();
        for candidate in candidates {
            for wall in &self.walls[candidate.walls.clone()] {
                self.horizon.raise(&wall.slopes);
            }
        }
    }

    fn is_hidden(&self) -> bool {
        self.lines.iter().all(|line| self.horizon.hides(line))
    }
}
