//! [`Extents`], in which directions features are seen, and which part of their outlines faces the eye
//! there.

use std::collections::BinaryHeap;
use std::f64::consts::TAU;
use std::ops::{ControlFlow, Range};

use glam::DVec2;

use super::occluder::parts;
use super::projection::{Edge, Facing, SIDES, Side, Span};
use super::solver::{
    ByDepth, PointQuery, PointSolver, Sighting, TileSource, Walker, depth, plan_corners,
};
use super::target::outline_slopes;
use super::tile::{Tile, positions};
use super::{EYE_MARGIN, PLACE_MARGIN};

/// How much wider a range is made at each end, radians: thousands of roundings of an azimuth, and a
/// micrometre at a thousand kilometres.
const AZIMUTH_MARGIN: f64 = 1e-12;

/// Places that are no farther apart than this touch: with their margins, ranges would overlap. A
/// place grows by up to twice the angle.
const TOUCH: f64 = 4.0 * AZIMUTH_MARGIN;

/// Points of a façade that are no farther apart are one, metres.
const FACADE_STEP: f64 = 1e-6;

/// A range of directions in plan in which a feature may be seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AzimuthRange<'a> {
    /// Where it begins, radians clockwise from +y (north), from 0 up to a whole turn.
    pub from: f64,
    /// Where it ends, clockwise of `from`: up to a whole turn more, so above a whole turn where the
    /// range passes north.
    pub to: f64,
    /// What faces the eye there of the outline of the prism or box that was tested: points in plan,
    /// metres, clockwise around the eye. All of the outline, closed, where the eye is in it.
    pub facade: &'a [DVec2],
}

/// In which directions features may be seen, as [`PointSolver::visible_extent`] finds it. Its memory
/// is kept from one query to the next.
#[derive(Clone, Debug, Default)]
pub struct Extents {
    extents: Vec<Extent>,
    ranges: Vec<Azimuths>,
    facades: Vec<DVec2>,
    /// Features that the walk has met, and the corners of their outlines relative to the eye.
    met: Vec<Met>,
    corners: Vec<DVec2>,
    /// Lines of their highest slopes, and which are still to be compared with the horizon, nearest
    /// first.
    lines: Vec<Line>,
    open: BinaryHeap<ByDepth<usize>>,
    glimpses: Vec<Glimpse>,
}

#[derive(Clone, Debug)]
struct Extent {
    sighting: Sighting,
    ranges: Range<usize>,
}

#[derive(Clone, Debug)]
struct Azimuths {
    from: f64,
    to: f64,
    facade: Range<usize>,
}

/// A feature that the walk has met.
#[derive(Clone, Debug)]
struct Met {
    sighting: Sighting,
    corners: Range<usize>,
    /// Whether it is all around the eye, or not known to be beside it.
    surrounds: bool,
}

/// A bound of the slopes of a feature from above.
#[derive(Clone, Copy, Debug)]
struct Line {
    met: usize,
    slopes: Span,
    /// What hides it is nearer than this.
    depth: f64,
}

impl Line {
    /// Whether a wall may share a place with it.
    fn meets(&self, wall: &Span) -> bool {
        let line = &self.slopes;
        line.side == wall.side
            && line.from - PLACE_MARGIN <= wall.to
            && wall.from <= line.to + PLACE_MARGIN
    }
}

/// Places on one side in which a feature may be seen.
#[derive(Clone, Copy, Debug)]
struct Glimpse {
    met: usize,
    from: Place,
    to: Place,
}

/// A place on a side.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
struct Place {
    side: usize,
    t: f64,
}

impl Place {
    /// How far it is anticlockwise to another.
    fn until(self, other: Self) -> f64 {
        2.0 * (other.side as f64 - self.side as f64) + (other.t - self.t)
    }

    fn direction(self) -> DVec2 {
        Side(self.side).direction(self.t)
    }

    fn azimuth(self) -> f64 {
        let DVec2 { x, y } = self.direction();
        x.atan2(y)
    }
}

impl PointSolver {
    /// Finds the directions in plan in which features in range may be seen.
    ///
    /// Conservative: a direction in which any point of a feature's outer prism (or box, as the query
    /// says) can be seen is in a range of it. Features are those of [`PointSolver::solve`], in its
    /// order, less those of which a closer look finds that nothing is seen. The range of the query
    /// says which features are looked for; it does not cut them.
    ///
    /// # Errors
    /// Those of the source; what has been found then means nothing.
    pub fn visible_extent<S: TileSource>(
        &mut self,
        query: &PointQuery,
        source: &mut S,
        extents: &mut Extents,
    ) -> Result<(), S::Error> {
        self.begin();
        if let Some(wedge) = &query.wedge {
            self.horizon.shut_between(wedge.left, wedge.right);
        }
        extents.begin();
        self.walk(query, source, extents)?;
        extents.advance(self, f64::INFINITY);
        extents.finish(query.eye.truncate());
        Ok(())
    }
}

impl Walker for Extents {
    fn advance(&mut self, solver: &mut PointSolver, depth: f64) {
        while let Some(nearest) = self.open.peek()
            && nearest.depth <= depth
        {
            solver.pass(nearest.depth);
            let Line { met, slopes, .. } = self.lines[nearest.item];
            self.open.pop();
            let side = slopes.side.0;
            solver.horizon.gaps(&slopes, &mut |from, to| {
                self.glimpses.push(Glimpse {
                    met,
                    from: Place { side, t: from },
                    to: Place { side, t: to },
                });
            });
        }
        solver.pass(depth);
    }

    fn meet(
        &mut self,
        solver: &mut PointSolver,
        query: &PointQuery,
        tile_position: usize,
        tile: &Tile,
        position: usize,
    ) {
        let Some(sighting) = solver.meet(query, tile_position, tile, position) else {
            return;
        };
        let feature = &tile.features[position];
        let outline = &tile.corners[positions(&feature.outline)];
        let first = self.corners.len();
        if query.prisms && !outline.is_empty() {
            let eye = query.eye.truncate();
            self.corners
                .extend(outline.iter().map(|&corner| corner - eye));
        } else {
            self.corners
                .extend(plan_corners(query.eye, &feature.envelope));
        }
        let corners = first..self.corners.len();
        let is_beside = depth(query.eye, &feature.envelope) > EYE_MARGIN
            || is_beside(&self.corners[corners.clone()]);
        let height = feature.envelope.max.z - query.eye.z;
        let first = self.lines.len();
        let is_known = is_beside && self.follow(corners.clone(), height);
        // No feature hides itself, though its columns may stick out of its outline by roundings.
        let own = &self.lines[first..];
        solver.take_walls(query.eye, tile, position, |wall| {
            let met = own.iter().filter(|line| line.meets(wall));
            met.map(|line| line.depth).fold(0.0, f64::max)
        });
        self.met.push(Met {
            sighting,
            corners,
            surrounds: !is_known,
        });
    }
}

impl Extents {
    /// The features in the order in which the solver met them, each with its ranges in no order. A
    /// feature that stands in several tiles comes once for each.
    pub fn iter(&self) -> impl Iterator<Item = (Sighting, impl Iterator<Item = AzimuthRange<'_>>)> {
        self.extents.iter().map(|extent| {
            let ranges = self.ranges[extent.ranges.clone()].iter();
            let ranges = ranges.map(|range| AzimuthRange {
                from: range.from,
                to: range.to,
                facade: &self.facades[range.facade.clone()],
            });
            (extent.sighting, ranges)
        })
    }

    /// How many features there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.extents.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.extents.is_empty()
    }

    fn begin(&mut self) {
        self.extents.clear();
        self.ranges.clear();
        self.facades.clear();
        self.met.clear();
        self.corners.clear();
        self.lines.clear();
        self.open.clear();
        self.glimpses.clear();
    }

    /// Takes the lines of the next feature, each to be compared with the walls that are nearer than
    /// all that is seen at its places. Returns whether they bound it.
    fn follow(&mut self, corners: Range<usize>, height: f64) -> bool {
        let corners = &self.corners[corners];
        let (met, lines, open) = (self.met.len(), &mut self.lines, &mut self.open);
        let mut add = |slopes: Span, depth: f64| {
            open.push(ByDepth {
                depth,
                item: lines.len(),
            });
            lines.push(Line { met, slopes, depth });
        };
        let mut nearest = 0.0_f64;
        let is_bounded = outline_slopes(corners, 1.0, |inverse_depth| {
            nearest = nearest.max(inverse_depth.highest());
            if height >= 0.0 {
                // The near edges have the highest slopes, and all else is behind them.
                cut(inverse_depth, |part| {
                    add(part.scaled(height), least_depth(part.highest()));
                });
            }
            ControlFlow::Continue(())
        })
        .is_continue();
        // The far ones have; what they are compared with must be before all of the feature.
        is_bounded
            && (height >= 0.0
                || outline_slopes(corners, height, |slopes| {
                    add(*slopes, least_depth(nearest));
                    ControlFlow::Continue(())
                })
                .is_continue())
    }

    /// Makes ranges of azimuths of what was seen.
    fn finish(&mut self, eye: DVec2) {
        self.glimpses.sort_unstable_by(|a, b| {
            let order = a.met.cmp(&b.met).then(a.from.side.cmp(&b.from.side));
            order.then(a.from.t.total_cmp(&b.from.t))
        });
        let (met, glimpses) = (
            std::mem::take(&mut self.met),
            std::mem::take(&mut self.glimpses),
        );
        let mut rest = &glimpses[..];
        for (at, met) in met.iter().enumerate() {
            let count = rest.iter().take_while(|glimpse| glimpse.met == at).count();
            let (of_this, others) = rest.split_at(count);
            rest = others;
            let first = self.ranges.len();
            if met.surrounds {
                self.add_whole(met, eye);
            } else {
                joined(of_this, |from, to| self.add(met, from, to, eye));
            }
            if first < self.ranges.len() {
                self.extents.push(Extent {
                    sighting: met.sighting,
                    ranges: first..self.ranges.len(),
                });
            }
        }
        (self.met, self.glimpses) = (met, glimpses);
    }

    fn add_whole(&mut self, met: &Met, eye: DVec2) {
        let first = self.facades.len();
        let corners = &self.corners[met.corners.clone()];
        self.facades
            .extend(corners.iter().rev().map(|corner| corner + eye));
        self.facades
            .extend(corners.last().map(|corner| corner + eye));
        self.ranges.push(Azimuths {
            from: 0.0,
            to: TAU,
            facade: first..self.facades.len(),
        });
    }

    /// Adds the range between two places, anticlockwise.
    fn add(&mut self, met: &Met, from: Place, to: Place, eye: DVec2) {
        let first = self.facades.len();
        let corners = &self.corners[met.corners.clone()];
        facade(corners, to.direction(), from.direction(), |point| {
            self.facades.push(point + eye);
        });
        let begin = turned(to.azimuth() - AZIMUTH_MARGIN);
        let end = turned(from.azimuth() + AZIMUTH_MARGIN);
        self.ranges.push(Azimuths {
            from: begin,
            to: if end < begin { end + TAU } else { end },
            facade: first..self.facades.len(),
        });
    }
}

/// An angle from 0 up to a whole turn.
fn turned(angle: f64) -> f64 {
    let angle = angle.rem_euclid(TAU);
    if angle < TAU { angle } else { 0.0 }
}

/// Whether some edge of an outline, anticlockwise and relative to the eye, has the eye plainly on its
/// outer side.
fn is_beside(corners: &[DVec2]) -> bool {
    let mut from = corners[corners.len() - 1];
    corners.iter().any(|&to| {
        let along = to - from;
        let distance = -from.perp_dot(along) / along.length();
        let edge = Edge::new(from, to);
        from = to;
        edge.facing() == Facing::Right && distance > EYE_MARGIN
    })
}

/// The depth of the greatest inverse depth of a line, or 0 if that is not known.
fn least_depth(greatest: f64) -> f64 {
    if greatest > 0.0 { 1.0 / greatest } else { 0.0 }
}

/// Cuts the inverse depth of an edge into parts of about one depth.
fn cut(inverse_depth: &Span, mut found: impl FnMut(&Span)) {
    if inverse_depth.lowest() > 0.0 && inverse_depth.highest().is_finite() {
        parts(inverse_depth, |part, _, _, _| found(part));
    } else {
        found(inverse_depth);
    }
}

/// Joins places that touch, given in order; gives each range anticlockwise.
fn joined(glimpses: &[Glimpse], mut found: impl FnMut(Place, Place)) {
    let touches = |to: Place, from: Place| to.until(from) <= TOUCH;
    let (mut first, mut last) = (None, None);
    for &Glimpse { from, to, .. } in glimpses {
        match &mut last {
            Some((_, end)) if touches(*end, from) => {
                if to > *end {
                    *end = to;
                }
            }
            _ => {
                let done = last.replace((from, to));
                if first.is_none() {
                    first = done;
                } else if let Some((from, to)) = done {
                    found(from, to);
                }
            }
        }
    }
    let around = |place: Place| Place {
        side: place.side + SIDES,
        ..place
    };
    match (first, last) {
        // The last goes on in the first: sides meet there too.
        (Some((from, to)), Some((last_from, last_to))) if touches(last_to, around(from)) => {
            found(last_from, to);
        }
        (first, last) => {
            for (from, to) in first.into_iter().chain(last) {
                found(from, to);
            }
        }
    }
}

/// The near edges of an outline from one direction clockwise to another; corners are anticlockwise
/// and relative to the eye, which is beside it.
fn facade(corners: &[DVec2], from: DVec2, to: DVec2, mut found: impl FnMut(DVec2)) {
    let count = corners.len();
    let is_near = |at: usize| corners[at % count].perp_dot(corners[(at + 1) % count]) < 0.0;
    let Some(first) = (0..count).find(|&at| is_near(at) && !is_near(at + count - 1)) else {
        // Seen edge on: its nearest corner.
        let nearest = corners
            .iter()
            .copied()
            .min_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
        nearest.into_iter().for_each(found);
        return;
    };
    let mut last = None;
    let mut add = |point: DVec2| {
        if last.is_none_or(|last: DVec2| (point - last).length() > FACADE_STEP) {
            last = Some(point);
            found(point);
        }
    };
    let (mut has_begun, mut end) = (false, corners[first]);
    for at in (first..first + count).take_while(|&at| is_near(at)) {
        let (a, b) = (corners[at % count], corners[(at + 1) % count]);
        end = b;
        if from.perp_dot(b) > 0.0 {
            continue;
        }
        if !has_begun {
            has_begun = true;
            add(crossing(a, b, from));
        }
        if to.perp_dot(b) <= 0.0 {
            end = crossing(a, b, to);
            break;
        }
        add(b);
    }
    add(end);
}

/// Where an edge crosses a direction, or the end that is nearer to it.
fn crossing(a: DVec2, b: DVec2, direction: DVec2) -> DVec2 {
    let (before, after) = (direction.perp_dot(a), direction.perp_dot(b));
    let share = before / (before - after);
    if share.is_nan() {
        a
    } else {
        a + (b - a) * share.clamp(0.0, 1.0)
    }
}
