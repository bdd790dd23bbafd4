//! Squares of the view region that are covered with cells as a whole.

use super::view_cells::{Asked, Block, Blocks};
use super::{Workers, count, run, streets};
use crate::snapshot_read::Moment;
use crate::types::Box3d;
use crate::visibility::{Around, CELL_BITS, Surroundings};
use engine::{CellQuery, CellSighting, CellSolver, CoverOptions, ViewCell, ViewRegion};
use glam::DVec3;
use rayon::prelude::*;
use std::collections::HashSet;
use std::sync::atomic::{AtomicBool, Ordering};

impl Blocks {
    /// Covers a square with cells; returns how many there are. If features were deleted meanwhile that one of them
    /// sees, these are returned and the square is still to be done: what is behind them is in no set.
    pub fn fill(
        &self,
        block: &Block,
        surroundings: &mut Surroundings,
        workers: &Workers,
        scene: &str,
    ) -> Result<usize, Vec<i64>> {
        // Before anything is read: what is edited from now on is not in the sets, or looks as if it were not.
        let snapshot = Self::snapshot();
        let region = ViewRegion::new(streets::near(scene, Moment::Now, &block.area));
        let eyes = region.filled(&block.area);
        let cells = eyes.map_or(Vec::new(), |eyes| {
            let around = surroundings.around(&eyes, block.asked.range);
            workers.run(|cancelled| cover(&around, &region, block, cancelled))
        });
        let ids: HashSet<i64> = cells
            .iter()
            .flat_map(|cell| &cell.visible)
            .copied()
            .collect();
        let mut slots = surroundings.slots(&ids);
        if slots.len() < ids.len() {
            run("SELECT occlusion.assign_slots($1)", &[scene.into()]);
            slots = surroundings.slots(&ids);
        }
        if slots.len() < ids.len() {
            return Err(ids
                .into_iter()
                .filter(|id| !slots.contains_key(id))
                .collect());
        }
        run(
            &format!(
                "DELETE FROM {0}.view_cell AS c USING {0}.view_cell_block AS b \
                 WHERE b.id OPERATOR(pg_catalog.=) $1 AND {1}",
                self.scene, self.lies_in
            ),
            &[block.id.into()],
        );
        let of = |ids: &[i64]| -> Vec<i64> { ids.iter().map(|id| slots[id]).collect() };
        for (number, cell) in cells.iter().enumerate() {
            run(
                &format!(
                    "INSERT INTO {}.view_cell (id, box, visible, unproven) \
                     VALUES ($1, $2, $3::occlusion.feature_set, $4::occlusion.feature_set)",
                    self.scene
                ),
                &[
                    ((block.id << CELL_BITS) + count(number)).into(),
                    Box3d(cell.bounds).into(),
                    of(&cell.visible).into(),
                    of(&cell.unproven).into(),
                ],
            );
        }
        self.finish_square(block, snapshot);
        Ok(cells.len())
    }
}

/// A cell with the numbers of features.
struct Made {
    bounds: engine::Box3d,
    visible: Vec<i64>,
    /// Those of them that have no witness.
    unproven: Vec<i64>,
}

/// The cells of a square; an incomplete answer only where the work is cancelled.
fn cover(around: &Around, region: &ViewRegion, block: &Block, cancelled: &AtomicBool) -> Vec<Made> {
    let asked = &block.asked;
    let options = CoverOptions {
        range: asked.range,
        smallest: asked.smallest,
        precision: asked.finest,
    };
    let stop = || cancelled.load(Ordering::Relaxed);
    let engine::Box3d { min, max } = block.area;
    let count = ((max.x - min.x) / asked.largest).round() as usize;
    // Neighbours have the same bits where they meet, and the last one ends where the block does.
    let place = |axis: usize, at: usize| match at == count {
        true => max[axis],
        false => min[axis] + at as f64 * asked.largest,
    };
    let corner = |x: usize, y: usize| DVec3::new(place(0, x), place(1, y), 0.0);
    (0..count * count)
        .into_par_iter()
        .map_init(CellSolver::default, |solver, at| {
            let (x, y) = (at % count, at / count);
            let square = engine::Box3d::new(corner(x, y), corner(x + 1, y + 1));
            let cells = solver.cover(&around.scene, region, &square, &options, &stop)?;
            let proven = |cell| prove(solver, around, region, asked, cell, &stop);
            cells.into_iter().map(proven).collect::<Option<Vec<_>>>()
        })
        .flatten_iter()
        .flatten()
        .collect()
}

/// Finds the witnesses of a cell; `None` where the work is cancelled.
fn prove(
    solver: &mut CellSolver,
    around: &Around,
    region: &ViewRegion,
    asked: &Asked,
    cell: ViewCell,
    stop: &dyn Fn() -> bool,
) -> Option<Made> {
    let query = CellQuery {
        bounds: cell.bounds,
        range: asked.range,
        precision: asked.finest,
    };
    let (visible, unproven) = proven(solver, around, &query, &cell.visible, &is_eye(region), stop)?;
    Some(Made {
        bounds: cell.bounds,
        visible,
        unproven,
    })
}

/// Whether an eye may be in a box.
pub fn is_eye(region: &ViewRegion) -> impl Fn(&engine::Box3d) -> bool {
    |bounds| region.touches(bounds)
}

/// The numbers of features that may be seen from a cell, and of those that no witness was found for; `None` where
/// the work is cancelled.
pub fn proven(
    solver: &mut CellSolver,
    around: &Around,
    query: &CellQuery,
    seen: &[CellSighting],
    is_open: &dyn Fn(&engine::Box3d) -> bool,
    stop: &dyn Fn() -> bool,
) -> Option<(Vec<i64>, Vec<i64>)> {
    let witnesses = solver.prove(&around.scene, &around.surfaces, query, seen, is_open, stop)?;
    let id = |seen: &CellSighting| around.scene.feature(seen.feature).0;
    let unproven = seen.iter().zip(&witnesses);
    let unproven = unproven.filter(|(_, witness)| witness.is_none());
    let unproven = unproven.map(|(seen, _)| id(seen)).collect();
    Some((seen.iter().map(id).collect(), unproven))
}
