//! What is seen from points in a cell, all together.

use std::collections::HashSet;
use std::convert::Infallible;

use engine::{Box3d, PointQuery, PointSolver, Tile, TileSource};
use glam::DVec2;

use super::window::Window;

/// Metres between points at the most.
const APART: f64 = 0.5;

/// The outermost points are so far inside the corners, metres: on the grid itself, walls of generated houses
/// would be seen exactly edge on, and hide nothing.
const INSIDE: DVec2 = DVec2::new(1.357e-3, 0.711e-3);

/// Union of the answers from points.
pub struct Points<'a> {
    window: &'a Window,
    bounds: Vec<Box3d>,
    solver: PointSolver,
}

impl<'a> Points<'a> {
    /// For the cells of a window.
    pub fn new(window: &'a Window) -> Self {
        Self {
            window,
            bounds: window.tiles.iter().filter_map(Tile::bounds).collect(),
            solver: PointSolver::default(),
        }
    }

    /// What is seen from somewhere in a dense grid of points: at corners and edges of the cell, too, at its foot and at
    /// its top, wherever an eye may be.
    pub fn union(&mut self, cell: &Box3d) -> HashSet<i64> {
        let steps = (cell.size().x / APART).ceil() as usize;
        let heights = [cell.min.z, cell.max.z];
        let tiles = &self.window.tiles;
        let mut seen = HashSet::new();
        for eye in self.window.eyes_in(cell, steps, INSIDE, &heights) {
            let query = PointQuery {
                eye,
                range: self.window.around.range,
                prisms: true,
                wedge: None,
            };
            let mut sightings = Vec::new();
            let mut source = Tiles(&self.bounds, tiles);
            let Ok(()) = self.solver.solve(&query, &mut source, &mut sightings);
            let features = sightings.iter();
            seen.extend(features.map(|seen| tiles[seen.tile].feature(seen.feature).0));
        }
        seen
    }
}

struct Tiles<'a>(&'a [Box3d], &'a [Tile]);

impl TileSource for Tiles<'_> {
    type Error = Infallible;

    fn bounds(&self) -> &[Box3d] {
        self.0
    }

    fn tile(&mut self, position: usize) -> Result<&Tile, Infallible> {
        Ok(&self.1[position])
    }
}
