//! Squares of the view region that deletions alone concern: of their cells those are solved again that saw what is
//! gone, and only for what is behind it (`docs/how-it-works.md`, "When a cell counts").

use super::fill::{is_eye, proven};
use super::streets;
use super::view_cells::{Block, Blocks};
use super::{Workers, failed, run};
use crate::snapshot_read::Moment;
use crate::types::Box3d;
use crate::visibility::{Around, Surroundings};
use engine::{CellQuery, CellSolver, ViewRegion};
use pgrx::Spi;
use rayon::prelude::*;
use std::collections::{HashMap, HashSet};
use std::sync::atomic::{AtomicBool, Ordering};

/// What was deleted and could be seen from a square.
pub struct Removals {
    slots: Vec<i64>,
    places: Vec<engine::Box3d>,
}

/// A cell as it is stored.
struct Stored {
    id: i64,
    bounds: engine::Box3d,
    visible: Vec<i64>,
}

/// What is seen from a cell besides, by the numbers of features.
struct More {
    cell: i64,
    visible: Vec<i64>,
    unproven: Vec<i64>,
}

impl Blocks {
    /// The deletions that concern a square; `None` if there are none, or something else does. What concerns it is
    /// what `occlusion.valid_cells_condition` says.
    pub fn removals(&self, block: &Block) -> Option<Removals> {
        let near = "e.place OPERATOR(occlusion.&&) occlusion.expand(b.area, b.range) \
                    AND NOT pg_catalog.pg_visible_in_snapshot(e.transaction, b.snapshot)";
        let query = format!(
            "SELECT e.slot::pg_catalog.int8, e.place FROM {0}.view_cell_block AS b JOIN {0}.change AS e \
                 ON {near} AND b.visible OPERATOR(occlusion.@>) e.slot::pg_catalog.int8 \
             WHERE b.id OPERATOR(pg_catalog.=) $1 \
               AND b.cluster OPERATOR(pg_catalog.=) occlusion.cluster_identity() \
               AND NOT EXISTS ( \
                   SELECT FROM {0}.change AS e WHERE {near} \
                     AND (e.place OPERATOR(occlusion.&&) b.area OR e.feature IS NOT NULL AND e.slot IS NULL)) \
               AND NOT EXISTS ( \
                   SELECT FROM {0}.change AS e \
                   WHERE e.place IS NULL AND NOT pg_catalog.pg_visible_in_snapshot(e.transaction, b.snapshot) \
                     AND (SELECT f.envelope FROM {0}.feature AS f WHERE f.id OPERATOR(pg_catalog.=) e.feature) \
                         OPERATOR(occlusion.&&) occlusion.expand(b.area, b.range))",
            self.scene
        );
        let rows = Spi::connect_mut(|client| {
            client
                .update(&query, None, &[block.id.into()])?
                .map(|row| Ok((row.get::<i64>(1)?, row.get::<Box3d>(2)?)))
                .collect::<Result<Vec<_>, pgrx::spi::Error>>()
        });
        let rows = rows.unwrap_or_else(|error| failed(&error));
        let (slots, places): (Vec<_>, Vec<_>) = rows
            .into_iter()
            .filter_map(|(slot, place)| Some((slot?, place?.0)))
            .unzip();
        (!slots.is_empty()).then_some(Removals { slots, places })
    }

    /// Repairs the cells of a square; returns how many there are of those that were concerned, or what `fill` does.
    pub fn repair(
        &self,
        block: &Block,
        surroundings: &mut Surroundings,
        workers: &Workers,
        scene: &str,
    ) -> Option<Result<usize, Vec<i64>>> {
        // Before anything is read, as in `fill`: later edits are not in it, even if they are in what is read.
        let snapshot = Self::snapshot();
        let removals = self.removals(block)?;
        let region = ViewRegion::new(streets::near(scene, Moment::Now, &block.area));
        let cells = self.concerned_cells(block, &removals);
        let eyes = region.filled(&block.area)?;
        let around = surroundings.around(&eyes, block.asked.range);
        let all = around.scene.features().map(|at| around.scene.feature(at).0);
        let mut slots = surroundings.slots(&all.collect());
        let more = workers.run(|cancelled| {
            let id_of: HashMap<i64, i64> = slots.iter().map(|(id, slot)| (*slot, *id)).collect();
            let known = |cell: &Stored| -> HashSet<i64> {
                let ids = cell.visible.iter().filter_map(|slot| id_of.get(slot));
                ids.copied().collect()
            };
            let solve = |solver: &mut CellSolver, cell: &Stored| {
                let known = known(cell);
                behind(
                    solver, &around, &region, block, cell, &removals, &known, cancelled,
                )
            };
            let cells = cells.par_iter().map_init(CellSolver::default, solve);
            cells.flatten().collect::<Vec<More>>()
        });
        let new: HashSet<i64> = more
            .iter()
            .flat_map(|more| &more.visible)
            .copied()
            .collect();
        if new.iter().any(|id| !slots.contains_key(id)) {
            run("SELECT occlusion.assign_slots($1)", &[scene.into()]);
        }
        slots = surroundings.slots(&new);
        if slots.len() < new.len() {
            return Some(Err(new
                .into_iter()
                .filter(|id| !slots.contains_key(id))
                .collect()));
        }
        for more in &more {
            let of = |ids: &[i64]| -> Vec<i64> { ids.iter().map(|id| slots[id]).collect() };
            run(
                &format!(
                    "UPDATE {}.view_cell SET \
                         visible = visible OPERATOR(occlusion.-) $2::occlusion.feature_set \
                                   OPERATOR(occlusion.|) $3::occlusion.feature_set, \
                         unproven = unproven OPERATOR(occlusion.-) $2::occlusion.feature_set \
                                    OPERATOR(occlusion.|) $4::occlusion.feature_set \
                     WHERE id OPERATOR(pg_catalog.=) $1",
                    self.scene
                ),
                &[
                    more.cell.into(),
                    removals.slots.clone().into(),
                    of(&more.visible).into(),
                    of(&more.unproven).into(),
                ],
            );
        }
        self.finish_square(block, snapshot);
        Some(Ok(more.len()))
    }

    /// The cells of a square that saw something that is gone.
    fn concerned_cells(&self, block: &Block, removals: &Removals) -> Vec<Stored> {
        let query = format!(
            "SELECT c.id, c.box, c.visible::pg_catalog.int8[] \
             FROM {0}.view_cell_block AS b JOIN {0}.view_cell AS c ON {1} \
             WHERE b.id OPERATOR(pg_catalog.=) $1 AND c.visible OPERATOR(occlusion.&&) $2::occlusion.feature_set",
            self.scene, self.lies_in
        );
        let arguments = [block.id.into(), removals.slots.clone().into()];
        let rows = Spi::connect_mut(|client| {
            client
                .update(&query, None, &arguments)?
                .map(|row| {
                    let place = row.get::<i64>(1)?.zip(row.get::<Box3d>(2)?);
                    Ok(place.zip(row.get::<Vec<i64>>(3)?))
                })
                .collect::<Result<Vec<_>, pgrx::spi::Error>>()
        });
        let rows = rows.unwrap_or_else(|error| failed(&error)).into_iter();
        rows.flatten()
            .map(|((id, bounds), visible)| Stored {
                id,
                bounds: bounds.0,
                visible,
            })
            .collect()
    }
}

/// What is seen from a cell besides what is known; `None` where the work is cancelled.
#[expect(clippy::too_many_arguments, reason = "one call, from a closure")]
fn behind(
    solver: &mut CellSolver,
    around: &Around,
    region: &ViewRegion,
    block: &Block,
    cell: &Stored,
    removals: &Removals,
    known: &HashSet<i64>,
    cancelled: &AtomicBool,
) -> Option<More> {
    let query = CellQuery {
        bounds: cell.bounds,
        range: block.asked.range,
        precision: block.asked.finest,
    };
    let is_open = is_eye(region);
    let stop = || cancelled.load(Ordering::Relaxed);
    let is_known = |id: i64| known.contains(&id);
    let seen = solver.solve_behind(
        &around.scene,
        &query,
        &removals.places,
        &is_known,
        &is_open,
        &stop,
    )?;
    let (visible, unproven) = proven(solver, around, &query, &seen, &is_open, &stop)?;
    Some(More {
        cell: cell.id,
        visible,
        unproven,
    })
}
