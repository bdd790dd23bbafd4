//! [`Way`], a way to find what can be seen from a view cell.

use std::collections::HashSet;
use std::sync::Arc;

use engine::{Box3d, CellQuery, CellScene, CellSolver, CellTile};
use glam::DVec3;

use super::window::Window;

/// A way to find what can be seen from a view cell.
pub trait Way {
    /// What it is called.
    fn name(&self) -> &str;

    /// Whether everything that can be seen is in its answers.
    fn is_complete(&self) -> bool {
        true
    }

    /// Makes what all cells of a size share.
    fn prepare(&mut self) {}

    /// The features that it finds.
    fn answer(&mut self, cell: &Box3d) -> HashSet<i64>;
}

/// View cells as the database computes them, or some other precision.
pub struct Eroding<'a> {
    name: &'static str,
    window: &'a Window,
    tiles: Vec<Arc<CellTile>>,
    /// Of the cells, metres.
    edge: f64,
    precision: f64,
    solver: CellSolver,
}

impl<'a> Eroding<'a> {
    /// For cells with edges of so many metres.
    pub fn new(name: &'static str, window: &'a Window, edge: f64, precision: f64) -> Self {
        let tiles = window.tiles.iter().cloned().map(CellTile::new);
        Self {
            name,
            window,
            tiles: tiles.map(Arc::new).collect(),
            edge,
            precision,
            solver: CellSolver::default(),
        }
    }

    fn query(&self, bounds: Box3d) -> CellQuery {
        CellQuery {
            bounds,
            range: self.window.around.range,
            precision: self.precision,
        }
    }
}

impl Way for Eroding<'_> {
    fn name(&self) -> &str {
        self.name
    }

    fn prepare(&mut self) {
        let scene = CellScene::new(self.tiles.clone());
        let any = Box3d::new(DVec3::ZERO, DVec3::splat(self.edge));
        self.query(any)
            .erosions()
            .for_each(|half| scene.erode(half));
    }

    fn answer(&mut self, cell: &Box3d) -> HashSet<i64> {
        let query = self.query(*cell);
        let is_near = |tile: &&Arc<CellTile>| {
            let around = tile.tile().bounds();
            around.is_some_and(|around| around.distance(cell) <= query.range)
        };
        let scene = CellScene::new(self.tiles.iter().filter(is_near).cloned().collect());
        let is_open = |bounds: &Box3d| self.window.region.touches(bounds);
        let set = self.solver.solve(&scene, &query, &is_open, &|| false);
        let sightings = set.unwrap_or_default().into_iter();
        sightings
            .map(|seen| scene.feature(seen.feature).0)
            .collect()
    }
}
