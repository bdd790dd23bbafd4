//! The isovist: what can be seen of the plane at eye level.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};

use super::EYE_MARGIN;
use super::occluder::{Measure, Wall};
use super::projection::{Edge, Span};
use super::solver::{PointQuery, PointSolver, TileSource, Walker, depth, is_below, plan_corners};
use super::tile::Tile;
use crate::Box3d;

/// Chords of the polygon around the circle of the range. Its corners are 0.0075 % of the range
/// outside the circle: 4 cm at 500 m.
const CHORDS: usize = 256;

/// How far corners are moved outwards, and ends of walls to their middles, metres: a thousand
/// roundings of a coordinate of national grids.
const CORNER_MARGIN: f64 = 1e-6;

/// Parts of the outline that are narrower, in places, are a single sight line between two walls: half
/// a micrometre at 500 m.
const NARROW: f64 = 1e-9;

impl PointSolver {
    /// Gives `corners` the isovist: the polygon of all that can be seen in the horizontal plane through
    /// the eye, up to a range, metres.
    ///
    /// Corners are anticlockwise, and the polygon is star-shaped around the eye. It holds every point
    /// in range to which no grounded column with its top above the eye bars the way, but for the rounding
    /// of its coordinates; beyond the walls it reaches a micrometre or a hundred-millionth of their
    /// distance. The circle of the range is replaced by the polygon of 256 chords around it, which
    /// reaches 0.0075 % further. A column that holds the eye, or that is within 1 mm, hides nothing.
    ///
    /// Without corners where the range is not above 0, or not finite.
    ///
    /// # Errors
    /// Those of the source; `corners` then means nothing.
    pub fn isovist<S: TileSource>(
        &mut self,
        eye: DVec3,
        range: f64,
        source: &mut S,
        corners: &mut Vec<DVec2>,
    ) -> Result<(), S::Error> {
        corners.clear();
        if !(range > 0.0 && range.is_finite()) {
            return Ok(());
        }
        self.begin();
        for edge in circle(range) {
            for (inverse_depth, ..) in edge.spans() {
                self.horizon.raise(&inverse_depth);
            }
        }
        let query = PointQuery {
            eye,
            range,
            prisms: false,
            wedge: None,
        };
        self.walk(&query, source, &mut Fronts)?;
        let mut outline = std::mem::take(&mut self.fronts);
        join(self.horizon.pieces(), &mut outline);
        draw(&outline, |corner| corners.push(corner + eye.truncate()));
        self.fronts = outline;
        Ok(())
    }
}

/// The edges of the polygon around a circle, anticlockwise.
fn circle(radius: f64) -> impl Iterator<Item = Edge> {
    let corner = move |at: usize| {
        let azimuth = (at % CHORDS) as f64 / CHORDS as f64 * TAU;
        DVec2::from_angle(azimuth) * (radius / (PI / CHORDS as f64).cos())
    };
    (0..CHORDS).map(move |at| Edge::new(corner(at), corner(at + 1)))
}

/// Raises the inverse depth of all walls that stand up over the eye. The nearest wall at a place has
/// the greatest, in whichever order they come.
struct Fronts;

impl Walker for Fronts {
    fn wants(&self, query: &PointQuery, bounds: &Box3d) -> bool {
        bounds.max.z > query.eye.z && depth(query.eye, bounds) < query.range
    }

    fn advance(&mut self, _: &mut PointSolver, _: f64) {}

    fn skips(&self, solver: &PointSolver, eye: DVec3, bounds: &Box3d) -> bool {
        depth(eye, bounds) > EYE_MARGIN
            && is_below(&solver.horizon, &plan_corners(eye, bounds), 1.0)
    }

    fn meet(
        &mut self,
        solver: &mut PointSolver,
        query: &PointQuery,
        _: usize,
        tile: &Tile,
        position: usize,
    ) {
        let (finder, horizon) = (&mut solver.finder, &mut solver.horizon);
        let feature = &tile.features[position];
        let found = &mut |wall: Wall| horizon.raise(&wall.slopes);
        finder.walls(
            tile,
            feature,
            query.eye,
            Measure::InverseDepth,
            &|_, _| true,
            found,
        );
    }
}

/// Joins pieces of one line that touch.
fn join<'a>(pieces: impl Iterator<Item = &'a Span>, joined: &mut Vec<Span>) {
    joined.clear();
    for piece in pieces {
        match joined.last_mut() {
            Some(last) if last.to == piece.from && piece.part(last.from, last.to) == *last => {
                last.to = piece.to;
            }
            _ => joined.push(*piece),
        }
    }
}

/// Gives `found` the corners of an outline, relative to the eye.
fn draw(outline: &[Span], mut found: impl FnMut(DVec2)) {
    let is_wide = |piece: &Span| piece.to - piece.from > NARROW;
    let Some(first) = outline.iter().position(is_wide) else {
        return;
    };
    let around = || outline[first + 1..].iter().chain(&outline[..=first]);
    let mut last = &outline[first];
    let mut gap_depth = 0.0_f64;
    for piece in around() {
        if is_wide(piece) {
            turn(last, gap_depth, piece, &mut found);
            last = piece;
            gap_depth = 0.0;
        } else {
            gap_depth = gap_depth.max(1.0 / piece.lowest());
        }
    }
}

/// Gives `found` the corners between two walls, anticlockwise, that have a narrow gap of some depth
/// between them, or none.
fn turn(before: &Span, gap_depth: f64, after: &Span, found: &mut impl FnMut(DVec2)) {
    let (depth_before, depth_after) =
        (1.0 / before.value(before.to), 1.0 / after.value(after.from));
    let farthest = depth_before.max(depth_after).max(gap_depth);
    // A wall that ends before something farther ends a little earlier.
    let short = |wall: &Span, depth: f64| {
        if farthest - depth > CORNER_MARGIN {
            (CORNER_MARGIN / depth).min((wall.to - wall.from) / 2.0)
        } else {
            0.0
        }
    };
    let short_before = short(before, depth_before);
    let short_after = short(after, depth_after);
    if short_before == 0.0 && short_after == 0.0 {
        found(corner(before, before.to, farthest));
        return;
    }
    let end = before.to - short_before;
    found(corner(before, end, 1.0 / before.value(end)));
    if short_before > 0.0 && short_after > 0.0 {
        found(corner(before, before.to, gap_depth));
        found(corner(after, after.from, gap_depth));
    }
    let start = after.from + short_after;
    found(corner(after, start, 1.0 / after.value(start)));
}

/// The point at a place and depth, and a little farther.
fn corner(wall: &Span, place: f64, depth: f64) -> DVec2 {
    let point = wall.side.direction(place) * depth;
    point * (1.0 + CORNER_MARGIN / point.length())
}
