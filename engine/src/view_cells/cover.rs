//! [`ViewCell`], and how a part of the view region is covered with such.

use std::collections::HashSet;

use super::scene::CellScene;
use super::solver::{CellQuery, CellSighting, CellSolver, around, parts, top};
use crate::point_visibility::Spot;
use crate::{Box3d, ViewRegion};

/// A cell is divided if its set is larger by more than this than what is seen from points in a quarter
/// of it, the largest of the four: that much would be loaded in vain on average.
const GROWTH: f64 = 1.3;

/// So many features more are never worth a division: courtyards see few, and every doorway adds some.
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
    pub fn cover(
        &mut self,
        scene: &CellScene,
        region: &ViewRegion,
        square: &Box3d,
        options: &CoverOptions,
        cancelled: &dyn Fn() -> bool,
    ) -> Option<Vec<ViewCell>> {
        let mut cells = Vec::new();
        let mut open = vec![*square];
        while let Some(square) = open.pop() {
            let Some(bounds) = region.filled(&square) else {
                continue;
            };
            let query = CellQuery {
                bounds,
                range: options.range,
                precision: options.precision,
            };
            let may_divide = square.size().truncate().max_element() > options.smallest;
            let (all, most) = match may_divide {
                true => self.count(scene, region, &query),
                false => (0, usize::MAX),
            };
            let grows = |count: usize| {
                count.saturating_sub(SPARE) > most && count as f64 > GROWTH * most as f64
            };
            // What points show needs no set.
            if grows(all) {
                open.extend(parts(&square));
                continue;
            }
            let is_open = |bounds: &Box3d| region.touches(bounds);
            let visible = self.solve(scene, &query, &is_open, cancelled)?;
            if grows(visible.len()) {
                open.extend(parts(&square));
            } else {
                cells.push(ViewCell { bounds, visible });
            }
        }
        Some(cells)
    }

    /// How many features are seen from five points in each quarter of a cell together, and from those of
    /// the quarter from which most are seen.
    fn count(
        &mut self,
        scene: &CellScene,
        region: &ViewRegion,
        query: &CellQuery,
    ) -> (usize, usize) {
        let is_eye = |&eye: &_| region.touches(&Box3d::new(eye, eye)) && !scene.holds(eye);
        let mut all: HashSet<Spot> = HashSet::new();
        let counts = parts(&query.bounds).map(|part| {
            let eyes = around(&part).into_iter().chain([top(&part)]).filter(is_eye);
            let seen: Vec<Spot> = self.seen_from(scene, eyes, query.range).copied().collect();
            all.extend(&seen);
            seen.len()
        });
        let most = counts.max().unwrap_or(0);
        (all.len(), most)
    }
}
