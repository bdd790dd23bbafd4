//! What the columns of a feature, or its roof, add to the horizon.

use glam::{DVec2, DVec3};

use super::projection::{Edge, Facing, Span};
use super::tile::{Column, Feature, Tile, positions};
use super::{EYE_MARGIN, PLACE_MARGIN, ROUNDINGS, SHALLOW, SLOPE_MARGIN};

/// Walls that lead away from the eye are cut where their depth has grown by this factor: each part
/// hides only what is beyond all of it.
const DEPTH_STEP: f64 = 1.25;

/// Slack on the depth of a part, for the roundings of its ends.
const DEPTH_MARGIN: f64 = 1e-8;

/// A part of a wall, which hides what is farther than `depth`.
#[derive(Clone, Copy, Debug)]
pub struct Wall {
    pub depth: f64,
    /// Whether it hides what is seen over no lower slope than [`SHALLOW`] alone: it has air below it.
    pub is_raised: bool,
    /// Slopes to its top, or inverse depths.
    pub slopes: Span,
}

/// What is known of a wall at each place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Measure {
    /// The slope to its top.
    Slope,
    /// Its inverse depth, where it stands up over the eye.
    InverseDepth,
}

/// Reads columns; its memory is kept from one to the next.
#[derive(Clone, Debug, Default)]
pub struct WallFinder {
    edges: Vec<(Edge, Facing)>,
    /// Ends of the edges of a roof: positions of their corners, clockwise one first, and their heights.
    ends: Vec<[(u16, f64); 2]>,
    /// Corners of a roof from which an edge goes on clockwise, and anticlockwise.
    sides: [Vec<u16>; 2],
}

impl WallFinder {
    /// Gives `found` the walls of a feature that can hide something from the eye. Edges that `adds`, given
    /// how high above the eye they are at the most, says of that they add nothing are passed over.
    pub fn walls(
        &mut self,
        tile: &Tile,
        feature: &Feature,
        eye: DVec3,
        measure: Measure,
        adds: &impl Fn(&Edge, f64) -> bool,
        found: &mut impl FnMut(Wall),
    ) {
        let nearest = eye.clamp(feature.envelope.min, feature.envelope.max);
        let is_near = (nearest - eye).truncate().abs().max_element() <= EYE_MARGIN;
        if !is_near && measure == Measure::Slope {
            self.crests(tile, feature, eye, adds, found);
            if feature.hides_by_roof() {
                return;
            }
        }
        for column in &tile.columns[positions(&feature.columns)] {
            if is_near && holds(tile, column, eye) {
                continue;
            }
            let height = match measure {
                Measure::Slope => column.top - eye.z,
                Measure::InverseDepth if column.top > eye.z && is_grounded(column) => 1.0,
                Measure::InverseDepth => continue,
            };
            let reach = reach(column.bottom - eye.z);
            let found = &mut |wall: Wall| {
                if wall.depth < reach {
                    found(Wall {
                        is_raised: !is_grounded(column),
                        ..wall
                    });
                }
            };
            for ring in &tile.rings[positions(&column.rings)] {
                let corners = positions(ring);
                let buried = &tile.buried[corners.clone()];
                self.ring(&tile.corners[corners], buried, height, eye, adds, found);
            }
        }
    }

    /// What is upright below the crests of a roof. The eye is beside it.
    fn crests(
        &mut self,
        tile: &Tile,
        feature: &Feature,
        eye: DVec3,
        adds: &impl Fn(&Edge, f64) -> bool,
        found: &mut impl FnMut(Wall),
    ) {
        self.edges.clear();
        self.ends.clear();
        self.sides.iter_mut().for_each(Vec::clear);
        for &ridge in tile.crests(feature) {
            let [from, to] = tile.ends(feature, ridge).map(|end| end - eye);
            let edge = Edge::new(from.truncate(), to.truncate());
            let lowered = |z: f64| z - z.abs() * SLOPE_MARGIN;
            let ends = [(ridge[0], lowered(from.z)), (ridge[1], lowered(to.z))];
            let ends = match edge.facing() {
                Facing::Left => ends,
                Facing::Right => [ends[1], ends[0]],
                Facing::EdgeOn => continue,
            };
            self.edges.push((edge, edge.facing()));
            self.ends.push(ends);
            self.sides[1].push(ends[0].0);
            self.sides[0].push(ends[1].0);
        }
        self.sides.iter_mut().for_each(|side| side.sort_unstable());
        for ((edge, facing), &[first, last]) in self.edges.iter().zip(&self.ends) {
            if !adds(edge, first.1.max(last.1)) {
                continue;
            }
            let corner = |side: &Vec<u16>, end: u16| match side.binary_search(&end) {
                Ok(_) => Corner::Drawn,
                Err(_) => Corner::End,
            };
            let corners = [
                corner(&self.sides[0], first.0),
                corner(&self.sides[1], last.0),
            ];
            let [from, to] = match facing {
                Facing::Left => [first.1, last.1],
                _ => [last.1, first.1],
            };
            let [heights, slack] = edge.heights(from, to);
            let slack = ROUNDINGS * slack.max_element();
            walls(edge, corners, found, |part| {
                let (at_zero, rise) = part.side.frame(heights);
                Span {
                    at_zero: at_zero - slack,
                    rise,
                    ..*part
                }
            });
        }
    }

    /// The walls over one ring. Under the eye's height the far edges decide: what passes them has
    /// gone over the top or met it. Above it the near ones do.
    fn ring(
        &mut self,
        corners: &[DVec2],
        buried: &[bool],
        height: f64,
        eye: DVec3,
        adds: &impl Fn(&Edge, f64) -> bool,
        found: &mut impl FnMut(Wall),
    ) {
        let (wanted, height) = if height >= 0.0 {
            (Facing::Right, height * (1.0 - SLOPE_MARGIN))
        } else {
            (Facing::Left, height * (1.0 + SLOPE_MARGIN))
        };
        let count = corners.len();
        let from_eye = |at: usize| corners[at % count] - eye.truncate();
        self.edges.clear();
        self.edges.extend((0..count).map(|at| {
            let edge = Edge::new(from_eye(at), from_eye(at + 1));
            (edge, edge.facing())
        }));
        for (at, (edge, facing)) in self.edges.iter().enumerate() {
            if *facing != wanted || buried[at] || !adds(edge, height) {
                continue;
            }
            let corner = |other: usize| {
                let (edge, facing) = &self.edges[other % count];
                match (*facing == wanted, buried[other % count]) {
                    (true, false) => Corner::Drawn,
                    (true, true) if edge.width() > 2.0 * PLACE_MARGIN => Corner::Buried,
                    _ => Corner::End,
                }
            };
            let (before, after) = (corner(at + count - 1), corner(at + 1));
            let (first, last) = match wanted {
                Facing::Left => (before, after),
                _ => (after, before),
            };
            walls(edge, [first, last], found, |part| part.scaled(height));
        }
    }
}

/// The walls over one edge, between two corners anticlockwise; `slopes` makes those of a part out of its
/// inverse depths.
fn walls(
    edge: &Edge,
    [first, last]: [Corner; 2],
    found: &mut impl FnMut(Wall),
    slopes: impl Fn(&Span) -> Span,
) {
    let mut spans = edge.spans().peekable();
    let mut begins_late = false;
    while let Some((span, starts, stops)) = spans.next() {
        // An end within the margin of a corner of the square is one beyond it too.
        let starts = starts || begins_late;
        begins_late = starts && 1.0 - span.from < PLACE_MARGIN;
        let stops = stops
            || spans
                .peek()
                .is_some_and(|(next, _, stops)| *stops && next.to + 1.0 < PLACE_MARGIN);
        parts(&span, |part, depth, is_first, is_last| {
            let begin = if is_first && starts {
                first
            } else {
                Corner::Drawn
            };
            let end = if is_last && stops {
                last
            } else {
                Corner::Drawn
            };
            let slopes = Span {
                from: (part.from - begin.reach()).max(-1.0),
                to: (part.to + end.reach()).min(1.0),
                ..slopes(part)
            };
            found(Wall {
                depth,
                is_raised: false,
                slopes,
            });
        });
    }
}

fn is_grounded(column: &Column) -> bool {
    column.bottom == f64::NEG_INFINITY
}

/// How near a wall must be so that what is seen over [`SHALLOW`] slopes passes above its bottom, at some
/// height above the eye.
fn reach(bottom: f64) -> f64 {
    bottom / SHALLOW * (1.0 - SLOPE_MARGIN)
}

/// What is on the other side of a corner where a wall begins or ends.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Corner {
    /// Nothing that faces as the wall does: what hides ends there.
    End,
    /// A wall that takes over at the very same place.
    Drawn,
    /// A wall that would, but is left out as it lies in another column.
    Buried,
}

impl Corner {
    /// How much a wall is made longer there: shorter by what roundings may have added to it, and
    /// longer only where something is left out that is known to hide, so that no crack opens.
    fn reach(self) -> f64 {
        match self {
            Self::End => -PLACE_MARGIN,
            Self::Drawn => 0.0,
            Self::Buried => PLACE_MARGIN,
        }
    }
}

/// Cuts the inverse depth of a wall into parts of about one depth; gives each with its greatest
/// depth, and whether it is the first and the last.
pub fn parts(span: &Span, mut found: impl FnMut(&Span, f64, bool, bool)) {
    let ends = [span.value(span.from), span.value(span.to)];
    let (nearest, farthest) = (1.0 / ends[0].max(ends[1]), 1.0 / ends[0].min(ends[1]));
    if !(nearest > 0.0 && farthest.is_finite()) {
        return;
    }
    let recedes = ends[1] < ends[0];
    let mut depth = nearest;
    let mut done = if recedes { span.from } else { span.to };
    let end = if recedes { span.to } else { span.from };
    let mut is_start = true;
    loop {
        depth *= DEPTH_STEP;
        let is_end = depth >= farthest;
        let place = if is_end {
            depth = farthest;
            end
        } else {
            ((1.0 / depth - span.at_zero) / span.rise).clamp(span.from, span.to)
        };
        let part = Span {
            from: done.min(place),
            to: done.max(place),
            ..*span
        };
        let (first, last) = if recedes {
            (is_start, is_end)
        } else {
            (is_end, is_start)
        };
        found(&part, depth * (1.0 + DEPTH_MARGIN), first, last);
        if is_end {
            return;
        }
        done = place;
        is_start = false;
    }
}

/// Whether a column or its margin holds the eye.
pub fn holds(tile: &Tile, column: &Column, eye: DVec3) -> bool {
    if eye.z > column.top + EYE_MARGIN {
        return false;
    }
    let eye = eye.truncate();
    let mut crossings = 0;
    for ring in &tile.rings[positions(&column.rings)] {
        let corners = &tile.corners[positions(ring)];
        for (at, &from) in corners.iter().enumerate() {
            let to = corners[(at + 1) % corners.len()];
            if distance(from - eye, to - eye) <= EYE_MARGIN {
                return true;
            }
            // Farther from the edge than its roundings, so the sign is right.
            let is_left = (from - eye).perp_dot(to - from) > 0.0;
            let crosses = (from.y > eye.y) != (to.y > eye.y);
            crossings += usize::from(crosses && is_left == (to.y > from.y));
        }
    }
    crossings % 2 == 1
}

/// Distance from the origin to a straight edge.
fn distance(from: DVec2, to: DVec2) -> f64 {
    let along = to - from;
    let length_2 = along.length_squared();
    let share = if length_2 > 0.0 {
        (-from.dot(along) / length_2).clamp(0.0, 1.0)
    } else {
        0.0
    };
    (from + along * share).length()
}
