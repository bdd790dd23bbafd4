//! Sifting: which of many features are not hidden by what stands somewhere else.

use std::ops::{ControlFlow, Range};

use glam::DVec3;

use super::horizon::{COUNT, Horizon, slices};
use super::projection::Span;
use super::solver::{PointQuery, PointSolver, TileSource, Walker, What, depth, plan_corners};
use super::target::outline_slopes;
use super::tile::Tile;
use crate::Box3d;

/// Slack on the range, metres: for the roundings of a distance, and for who takes an eye to be in the box
/// that is a little beside it, as PostgreSQL's polygons do by a micrometre.
const RANGE_MARGIN: f64 = 1e-3;

/// A feature, by the position of its tile and its own in there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Spot {
    pub tile: usize,
    pub feature: usize,
}

/// What is to be sifted, and with what. The first tiles of the source hold the features, the others what
/// hides.
#[derive(Clone, Copy, Debug)]
pub struct Sifting<'a> {
    /// From where, metres.
    pub eye: DVec3,
    /// Of features farther from this box than the range nothing is asked.
    pub near: Box3d,
    /// Metres.
    pub range: f64,
    /// The first tile that hides.
    pub first_hiding: usize,
    /// The features, and the tiles among which what hides them is sought; `None`: all within range that
    /// are not skipped, and all.
    pub known: Option<Known<'a>>,
    /// Only what is seen over one of these boxes, or under it, is asked for; `None`: all is.
    pub through: Option<&'a [Box3d]>,
}

/// What is left of a sifting before.
#[derive(Clone, Copy, Debug)]
pub struct Known<'a> {
    /// Features with their outer envelopes.
    pub features: &'a [(Spot, Box3d)],
    /// Tiles that hide.
    pub tiles: &'a [usize],
}

impl PointSolver {
    /// Gives `found` those features that are not hidden from the eye, but for those to be skipped. Returns
    /// the tiles that hide and are in sight between the eye and the features, or would be from somewhere in
    /// the box.
    ///
    /// # Errors
    /// Those of the source.
    pub(crate) fn sift<S: TileSource>(
        &mut self,
        sifting: &Sifting<'_>,
        source: &mut S,
        skip: impl Fn(Spot) -> bool,
        found: impl FnMut(Spot, Box3d),
    ) -> Result<Vec<usize>, S::Error> {
        self.begin();
        if let Some(lines) = sifting
            .through
            .and_then(|places| lines(sifting.eye, places))
        {
            self.horizon.shut_beside(&lines);
        }
        let query = PointQuery {
            eye: sifting.eye,
            range: f64::INFINITY,
            prisms: true,
            wedge: None,
        };
        let mut sifter = Sifter {
            sifting,
            limit: f64::INFINITY,
            search: None,
            skip,
            found,
        };
        let Some(Known { features, tiles }) = sifting.known else {
            self.walk(&query, source, &mut sifter)?;
            return Ok((sifting.first_hiding..source.bounds().len()).collect());
        };
        let depths = features
            .iter()
            .map(|(_, envelope)| depth(sifting.eye, envelope));
        sifter.limit = depths.fold(0.0, f64::max);
        sifter.search = Search::of(sifting.eye, features);
        if let Some(search) = &sifter.search {
            self.horizon.shut_beside(&search.lines);
        }
        // A tile that is on a line from an eye of the box to a feature is no farther from the line to the same point from
        // here, which passes the same places: in no direction that is shut.
        let reach = 0.5 * sifting.near.size().truncate().max_element();
        let mut in_sight = Vec::new();
        for &tile in tiles {
            let bounds = &source.bounds()[tile];
            let is_in_sight = sifter.wants(&query, bounds)
                && bounds
                    .expanded(reach)
                    .is_some_and(|bounds| !self.hides_box(sifting.eye, &bounds));
            if is_in_sight {
                in_sight.push(tile);
                self.open(sifting.eye, tile, What::Tile, bounds);
            }
        }
        for (spot, envelope) in features {
            if sifter.is_in_range(envelope) {
                self.open(
                    sifting.eye,
                    spot.tile,
                    What::Feature(spot.feature),
                    envelope,
                );
            }
        }
        self.visit(&query, source, &mut sifter)?;
        Ok(in_sight)
    }
}

/// The lines in plan of some boxes; `None` if the eye is above or below one.
fn lines(eye: DVec3, boxes: &[Box3d]) -> Option<Vec<Span>> {
    let mut lines = Vec::new();
    for bounds in boxes {
        add_lines(eye, bounds, &mut lines)?;
    }
    Some(lines)
}

/// Adds those of one box.
fn add_lines(eye: DVec3, bounds: &Box3d, lines: &mut Vec<Span>) -> Option<()> {
    let before = lines.len();
    let flow = outline_slopes(&plan_corners(eye, bounds), 1.0, |line| {
        lines.push(*line);
        ControlFlow::Continue(())
    });
    (flow.is_continue() && lines.len() > before).then_some(())
}

/// In which directions features are looked for.
struct Search {
    /// The lines of their boxes.
    lines: Vec<Span>,
    /// The features, and which of the lines are theirs.
    features: Vec<(Spot, Range<usize>)>,
    /// Of each slice of the horizon, how many of the lines pass it whose features are still to be met.
    left: Vec<u32>,
}

impl Search {
    /// The search for some features; `None` if the eye is above or below one.
    fn of(eye: DVec3, features: &[(Spot, Box3d)]) -> Option<Self> {
        let mut search = Self {
            lines: Vec::new(),
            features: Vec::with_capacity(features.len()),
            left: vec![0; COUNT],
        };
        for (spot, envelope) in features {
            let first = search.lines.len();
            add_lines(eye, envelope, &mut search.lines)?;
            search.features.push((*spot, first..search.lines.len()));
        }
        for at in search.lines.iter().flat_map(slices) {
            search.left[at] += 1;
        }
        Some(search)
    }

    /// Shuts the directions in which nothing more is looked for after a feature was met.
    fn leave(&mut self, spot: Spot, horizon: &mut Horizon) {
        let Some((_, lines)) = self.features.iter().find(|(other, _)| *other == spot) else {
            return;
        };
        for at in self.lines[lines.clone()].iter().flat_map(slices) {
            self.left[at] -= 1;
            if self.left[at] == 0 {
                horizon.shut_slice(at);
            }
        }
    }
}

struct Sifter<'a, K, F> {
    sifting: &'a Sifting<'a>,
    /// Nothing that is farther in plan matters.
    limit: f64,
    /// `None` where all around is looked at.
    search: Option<Search>,
    skip: K,
    found: F,
}

impl<K, F> Sifter<'_, K, F> {
    fn is_in_range(&self, bounds: &Box3d) -> bool {
        bounds.distance(&self.sifting.near) <= self.sifting.range + RANGE_MARGIN
    }
}

impl<K: Fn(Spot) -> bool, F: FnMut(Spot, Box3d)> Walker for Sifter<'_, K, F> {
    fn wants(&self, query: &PointQuery, bounds: &Box3d) -> bool {
        self.is_in_range(bounds) && depth(query.eye, bounds) < self.limit
    }

    fn leave(&mut self, solver: &mut PointSolver, tile: usize, position: usize) {
        if tile < self.sifting.first_hiding
            && let Some(search) = &mut self.search
        {
            let spot = Spot {
                tile,
                feature: position,
            };
            search.leave(spot, &mut solver.horizon);
        }
    }

    fn meet(
        &mut self,
        solver: &mut PointSolver,
        query: &PointQuery,
        tile_position: usize,
        tile: &Tile,
        position: usize,
    ) {
        if tile_position >= self.sifting.first_hiding {
            solver.take_walls(query.eye, tile, position, |_| 0.0);
            return;
        }
        let spot = Spot {
            tile: tile_position,
            feature: position,
        };
        if !(self.skip)(spot) && solver.meet(query, tile_position, tile, position).is_some() {
            (self.found)(spot, tile.features[position].envelope);
        }
    }
}
