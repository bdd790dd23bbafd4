//! [`Umbra`], what is left of the features in range without those that a single other one hides.

use std::collections::HashSet;

use engine::{Box3d, ConvexPieceOptions, ShadowCaster, convex_pieces};
use glam::DVec2;
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree, RTreeObject, SelectionFunction};

use super::way::Way;
use super::window::Window;

/// Metres around a cell within which an umbra is looked at.
const AROUND: f64 = 1.0;

/// A convex piece of a feature, by its place in the plan.
type Piece = GeomWithData<Rectangle<[f64; 2]>, Caster>;

/// A convex piece with the feature that it is of.
struct Caster {
    feature: i64,
    shadow: ShadowCaster,
}

/// The umbra of one occluder: a feature is hidden from a cell if a convex piece of another one hides it from the
/// whole cell.
pub struct Umbra<'a> {
    window: &'a Window,
    pieces: RTree<Piece>,
}

impl<'a> Umbra<'a> {
    /// Without any pieces, which are made later.
    pub fn new(window: &'a Window) -> Self {
        Self {
            window,
            pieces: RTree::new(),
        }
    }

    /// Whether a single piece of another feature hides a box from all of a cell.
    fn hides(&self, cell: &Box3d, feature: i64, occludee: &Box3d) -> bool {
        let across = Across([cell, occludee].map(|bounds| bounds.center().truncate()));
        let window = [cell.min.truncate() - AROUND, cell.max.truncate() + AROUND];
        let mut between = self.pieces.locate_with_selection_function(across);
        between.any(|piece| {
            let Caster {
                feature: owner,
                shadow,
            } = &piece.data;
            let band = [cell.min.z, cell.max.z];
            let umbra = || shadow.umbra_in_band(occludee, band, window);
            *owner != feature
                && umbra()
                    .and_then(|umbra| umbra.strip(0, cell.min.y, cell.max.y))
                    .is_some_and(|[from, to]| from <= cell.min.x && cell.max.x <= to)
        })
    }
}

impl Way for Umbra<'_> {
    fn name(&self) -> &str {
        "umbra of one occluder"
    }

    fn prepare(&mut self) {
        let features = self.window.around.features.iter();
        let pieces = features.flat_map(|feature| {
            let solids: Vec<_> = feature.solids().collect();
            let pieces = convex_pieces(&solids, &ConvexPieceOptions::default());
            pieces.into_iter().filter_map(|piece| {
                let Box3d { min, max } = piece.envelope();
                let shadow = ShadowCaster::new(&piece)?;
                let plan = Rectangle::from_corners([min.x, min.y], [max.x, max.y]);
                let feature = feature.id;
                Some(GeomWithData::new(plan, Caster { feature, shadow }))
            })
        });
        self.pieces = RTree::bulk_load(pieces.collect());
    }

    fn answer(&mut self, cell: &Box3d) -> HashSet<i64> {
        let features = self.window.around.features.iter();
        features
            .map(|feature| (feature.id, Box3d::from(feature.envelope)))
            .filter(|(_, envelope)| envelope.distance(cell) <= self.window.around.range)
            .filter(|(feature, envelope)| !self.hides(cell, *feature, envelope))
            .map(|(feature, _)| feature)
            .collect()
    }
}

/// Pieces that may meet a line of sight between two points of the plan: one that hides all of a box from all of a
/// cell is met between their middles.
struct Across([DVec2; 2]);

impl SelectionFunction<Piece> for Across {
    fn should_unpack_parent(&self, envelope: &AABB<[f64; 2]>) -> bool {
        let [from, to] = self.0;
        let [low, high] = [envelope.lower(), envelope.upper()].map(DVec2::from);
        let apart = (low - from.max(to)).max(from.min(to) - high);
        let across = (to - from).perp();
        let aside = across.dot(low.midpoint(high) - from).abs();
        apart.max_element() <= 0.0 && aside <= across.abs().dot(0.5 * (high - low))
    }

    fn should_unpack_leaf(&self, leaf: &Piece) -> bool {
        self.should_unpack_parent(&leaf.envelope())
    }
}
