//! [`Tiling`], the features of a scene in several tiles.

use std::convert::Infallible;

use engine::{Box3d, PointQuery, PointSolver, Tile, TileFeature, TileSource};
use fastrand::Rng;

/// Tiles in memory.
#[derive(Debug)]
pub struct Tiling {
    bounds: Vec<Box3d>,
    tiles: Vec<Tile>,
}

impl Tiling {
    /// Features in one tile or several; some may be in two.
    pub fn random(rng: &mut Rng, features: &[TileFeature]) -> Self {
        let parts = parts(rng, features, true);
        Self::of(&parts, if rng.bool() { 0.0 } else { 5.0 })
    }

    /// Features in one tile.
    pub fn single(features: &[TileFeature]) -> Self {
        Self::of(&[features.to_vec()], 0.0)
    }

    /// Parts in a tile each, whose boxes may be wider than they need be.
    fn of(parts: &[Vec<TileFeature>], wider: f64) -> Self {
        let tiles: Vec<Tile> = parts
            .iter()
            .map(|part| Tile::new(part))
            .filter(|tile| !tile.is_empty())
            .collect();
        let bounds = tiles.iter().filter_map(Tile::bounds);
        let bounds = bounds.map(|tight| Box3d::new(tight.min - wider, tight.max + wider));
        Self {
            bounds: bounds.collect(),
            tiles,
        }
    }

    /// The number of the feature at a position of a tile.
    #[cfg(test)]
    pub fn id(&self, tile: usize, feature: usize) -> i64 {
        self.tiles[tile].feature(feature).0
    }

    /// The numbers of the features that may be seen.
    pub fn answer(&mut self, solver: &mut PointSolver, query: &PointQuery) -> Vec<i64> {
        let mut visible = Vec::new();
        let Ok(()) = solver.solve(query, self, &mut visible);
        let mut ids: Vec<i64> = visible
            .iter()
            .map(|seen| self.tiles[seen.tile].feature(seen.feature).0)
            .collect();
        ids.sort_unstable();
        ids.dedup();
        ids
    }
}

/// Features in one part or several; some may be in two.
pub fn parts(rng: &mut Rng, features: &[TileFeature], twice: bool) -> Vec<Vec<TileFeature>> {
    let count = [1, 1, 2, 4, 9][rng.usize(..5)];
    let mut parts = vec![Vec::new(); count];
    for feature in features {
        parts[rng.usize(..count)].push(feature.clone());
        if twice && count > 1 && rng.u8(..8) == 0 {
            parts[rng.usize(..count)].push(feature.clone());
        }
    }
    parts
}

impl TileSource for Tiling {
    type Error = Infallible;

    fn bounds(&self) -> &[Box3d] {
        &self.bounds
    }

    fn tile(&mut self, position: usize) -> Result<&Tile, Infallible> {
        Ok(&self.tiles[position])
    }
}
