//! [`ViewCell`], and how a part of the view region is covered with such.

use std::collections::BTreeMap;

use super::scene::CellScene;
use super::solver::{CellQuery, CellSighting, CellSolver, parts};
use crate::{Box3d, ViewRegion};

/// Cells are not joined if the set of all is larger by more than this than the largest of theirs: that much
/// would be loaded in vain.
const GROWTH: f64 = 1.3;

/// So many features more never matter: courtyards see few, and every doorway adds some.
const SPARE: usize = 12;

/// A box of the view region with what can be seen from anywhere in it.
#[derive(Clone, Debug, PartialEq)]
pub struct ViewCell {
    /// Where eyes may be, metres.
    pub bounds: Box3d,
    /// The features that may be seen, in the order of their positions.
    pub visible: Vec<CellSighting>,
}

/// How a view region is covered with cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoverOptions {
    /// How far eyes see, metres.
    pub range: f64,
    /// Edge below which no cell is divided, metres.
    pub smallest: f64,
    /// Half edge of the smallest parts of a cell that are told apart, metres.
    pub precision: f64,
}

impl CellSolver {
    /// Cells that cover all of the view region that lies in a square of the plan, whose heights do not
    /// matter: the square, or parts of it where what is seen changes fast. `None` as soon as `cancelled`
    /// says so.
    ///
    /// The smallest parts are solved, and joined where that adds little: what is seen from a part of a cell
    /// is seen from the cell, and the other way round.
    pub fn cover(
        &mut self,
        scene: &CellScene,
        region: &ViewRegion,
        square: &Box3d,
        options: &CoverOptions,
        cancelled: &dyn Fn() -> bool,
    ) -> Option<Vec<ViewCell>> {
        let Some(bounds) = region.filled(square) else {
            return Some(Vec::new());
        };
        if square.size().truncate().max_element() <= options.smallest {
            let query = CellQuery {
                bounds,
                range: options.range,
                precision: options.precision,
            };
            let is_open = |bounds: &Box3d| region.touches(bounds);
            let visible = self.solve(scene, &query, &is_open, cancelled)?;
            return Some(vec![ViewCell { bounds, visible }]);
        }
        let mut cells = Vec::new();
        let mut are_whole = true;
        for part in parts(square) {
            let of_part = self.cover(scene, region, &part, options, cancelled)?;
            are_whole &= of_part.len() <= 1;
            cells.extend(of_part);
        }
        let joined = are_whole.then(|| joined(&cells)).flatten();
        Some(match joined {
            Some(visible) => vec![ViewCell { bounds, visible }],
            None => cells,
        })
    }
}

/// What is seen from some cells together; `None` if that is much more than from each.
fn joined(cells: &[ViewCell]) -> Option<Vec<CellSighting>> {
    let mut all = BTreeMap::new();
    for sighting in cells.iter().flat_map(|cell| &cell.visible) {
        all.entry(sighting.feature).or_insert(*sighting);
    }
    let most = cells.iter().map(|cell| cell.visible.len()).max()?;
    let is_little = all.len() <= most + SPARE || all.len() as f64 <= GROWTH * most as f64;
    is_little.then(|| all.into_values().collect())
}
