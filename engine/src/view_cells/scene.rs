//! [`CellScene`], what surrounds view cells, and [`CellTile`], what is left of a part of it after erosion.

use std::collections::HashMap;
use std::convert::Infallible;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use glam::DVec3;

use super::erosion::eroded;
use crate::{Box3d, SolidColumn, Tile, TileSource};

/// A neighbourhood of features, with what is left of it after erosions. It may be shared by threads.
#[derive(Debug)]
pub struct CellTile {
    tile: Tile,
    /// By the bits of the size.
    eroded: Mutex<HashMap<u64, Arc<OnceLock<Tile>>>>,
    corners: AtomicUsize,
}

impl CellTile {
    /// That of a tile.
    #[must_use]
    pub fn new(tile: Tile) -> Self {
        Self {
            corners: AtomicUsize::new(tile.corner_count()),
            tile,
            eroded: Mutex::default(),
        }
    }

    /// The tile as it was given.
    #[must_use]
    pub fn tile(&self) -> &Tile {
        &self.tile
    }

    /// Corners of all that it holds, erosions included: some 24 bytes each.
    #[must_use]
    pub fn corner_count(&self) -> usize {
        self.corners.load(Ordering::Relaxed)
    }

    /// The tile as it is left after erosion by a square of this half edge, metres.
    fn eroded(&self, half: f64) -> Arc<OnceLock<Tile>> {
        let mut eroded = self.eroded.lock().unwrap_or_else(PoisonError::into_inner);
        let place = Arc::clone(eroded.entry(half.to_bits()).or_default());
        drop(eroded);
        // Another thread that needs the same one waits for it; the lock is free meanwhile.
        place.get_or_init(|| {
            let made = eroded_tile(&self.tile, half);
            self.corners
                .fetch_add(made.corner_count(), Ordering::Relaxed);
            made
        });
        place
    }
}

/// What surrounds view cells.
#[derive(Debug)]
pub struct CellScene {
    tiles: Vec<Arc<CellTile>>,
    /// Of the tiles, and once more of what is left of them, which lies in them.
    bounds: Vec<Box3d>,
}

impl CellScene {
    /// A scene of some tiles; no feature is in two of them.
    #[must_use]
    pub fn new(tiles: Vec<Arc<CellTile>>) -> Self {
        let mut tiles = tiles;
        tiles.retain(|tile| !tile.tile.is_empty());
        let bounds: Vec<Box3d> = tiles.iter().filter_map(|tile| tile.tile.bounds()).collect();
        Self {
            bounds: bounds.repeat(2),
            tiles,
        }
    }

    /// Positions of all features, as [`CellSighting`](crate::CellSighting) has them.
    pub fn features(&self) -> impl Iterator<Item = (usize, usize)> {
        let tiles = self.tiles.iter().enumerate();
        tiles.flat_map(|(at, tile)| (0..tile.tile.len()).map(move |feature| (at, feature)))
    }

    /// Number and outer envelope of a feature, by the position of its tile and its own.
    #[must_use]
    pub fn feature(&self, (tile, feature): (usize, usize)) -> (i64, Box3d) {
        self.tiles[tile].tile.feature(feature)
    }

    /// Erodes all tiles by a square of this half edge, metres, ahead of the queries that need it
    /// ([`crate::CellQuery::erosions`]). Without, they are eroded one by one when a query meets them.
    pub fn erode(&self, half: f64) {
        for tile in &self.tiles {
            tile.eroded(half);
        }
    }

    /// How many tiles there are.
    pub(super) fn len(&self) -> usize {
        self.tiles.len()
    }

    /// Whether an eye is within a solid or its margin, so that no cell speaks of it.
    #[must_use]
    pub fn holds(&self, eye: DVec3) -> bool {
        self.tiles.iter().any(|tile| tile.tile.holds(eye))
    }
}

/// What is left of a tile. Features that touch are eroded as one.
fn eroded_tile(tile: &Tile, half: f64) -> Tile {
    let (boxes, columns): (Vec<Box3d>, Vec<Vec<SolidColumn>>) = tile.solids().unzip();
    let groups = touching(&boxes);
    let left = groups.iter().flat_map(|group| {
        let members = group.iter().flat_map(|&at| &columns[at]);
        eroded(members, half)
    });
    Tile::of_columns(left.collect())
}

/// Groups of boxes that hang together in plan.
fn touching(boxes: &[Box3d]) -> Vec<Vec<usize>> {
    let mut left: Vec<usize> = (0..boxes.len()).collect();
    let mut groups = Vec::new();
    while let Some(first) = left.pop() {
        let mut group = vec![first];
        let mut done = 0;
        while done < group.len() {
            let here = boxes[group[done]];
            let (near, far) = left.into_iter().partition(|&at| touch(&here, &boxes[at]));
            left = far;
            group.extend::<Vec<usize>>(near);
            done += 1;
        }
        groups.push(group);
    }
    groups
}

fn touch(a: &Box3d, b: &Box3d) -> bool {
    let apart = a.min.max(b.min) - a.max.min(b.max);
    apart.truncate().max_element() <= 0.0
}

/// The tiles of a scene.
#[derive(Debug)]
pub struct Plain<'a>(pub &'a CellScene);

impl TileSource for Plain<'_> {
    type Error = Infallible;

    fn bounds(&self) -> &[Box3d] {
        &self.0.bounds[..self.0.tiles.len()]
    }

    fn tile(&mut self, position: usize) -> Result<&Tile, Infallible> {
        Ok(&self.0.tiles[position].tile)
    }
}

/// The tiles of a scene, and behind them as many that hide: eroded ones, or the same.
#[derive(Debug)]
pub struct Stage<'a> {
    scene: &'a CellScene,
    /// Half edge of the squares of erosion, metres; `None`: nothing is eroded.
    half: Option<f64>,
    eroded: Vec<Option<Arc<OnceLock<Tile>>>>,
}

impl<'a> Stage<'a> {
    pub fn new(scene: &'a CellScene, half: Option<f64>) -> Self {
        Self {
            scene,
            half,
            eroded: vec![None; scene.tiles.len()],
        }
    }
}

impl TileSource for Stage<'_> {
    type Error = Infallible;

    fn bounds(&self) -> &[Box3d] {
        &self.scene.bounds
    }

    fn tile(&mut self, position: usize) -> Result<&Tile, Infallible> {
        let count = self.scene.tiles.len();
        let Some(half) = self.half.filter(|_| position >= count) else {
            return Ok(&self.scene.tiles[position % count].tile);
        };
        let (scene, at) = (self.scene, position - count);
        let place = self.eroded[at].get_or_insert_with(|| scene.tiles[at].eroded(half));
        Ok(place.get().expect("made before it was handed out"))
    }
}
