//! Sifting: which of many features are not hidden by what stands somewhere else.

use std::ops::ControlFlow;

use glam::DVec3;

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
        let query = PointQuery {
            eye: sifting.eye,
            range: f64::INFINITY,
            prisms: true,
            wedge: None,
        };
        let mut sifter = Sifter {
            sifting,
            limit: f64::INFINITY,
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
        if let Some(lines) = outlines(sifting.eye, features) {
            self.horizon.shut_beside(&lines);
        }
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

/// The lines of some boxes; `None` if the eye is above or below one.
fn outlines(eye: DVec3, features: &[(Spot, Box3d)]) -> Option<Vec<Span>> {
    let mut lines = Vec::new();
    let flow = features.iter().try_for_each(|(_, envelope)| {
        let corners = plan_corners(eye, envelope);
        let before = lines.len();
        outline_slopes(&corners, 1.0, |line| {
            lines.push(*line);
            ControlFlow::Continue(())
        })?;
        match lines.len() > before {
            true => ControlFlow::Continue(()),
            false => ControlFlow::Break(()),
        }
    });
    flow.is_continue().then_some(lines)
}

struct Sifter<'a, K, F> {
    sifting: &'a Sifting<'a>,
    /// Nothing that is farther in plan matters.
    limit: f64,
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
