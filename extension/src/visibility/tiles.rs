//! [`Tiles`], where the solver reads the features around an eye.

use super::base;
use super::cache::{self, Key, Version};
use super::live::Seen;
use super::packed_tile::PackedTile;
use super::statements::{Ask, Statements};
use super::tables::Tables as SceneTables;
use crate::error::Refusal;
use crate::settings;
use crate::snapshot_read::{Moment, argument};
use crate::toasted::Toasted;
use crate::types::{Box3d, Point3d};
use engine::{Sighting, Tile, TileSource};
use glam::DVec3;
use pgrx::{Uuid, check_for_interrupts};
use std::collections::{HashMap, HashSet};
use std::rc::Rc;

/// The tiles that meet a box, under the snapshot of the query: packed ones, read when they are needed,
/// and one of the features that were edited since.
pub struct Tiles {
    tables: SceneTables,
    statements: Rc<Statements>,
    bounds: Vec<engine::Box3d>,
    /// As `bounds`, but for what was read from the tables of the scene, which comes last.
    packed: Vec<(Version, Toasted)>,
    tiles: Vec<Option<Rc<PackedTile>>>,
    edited: HashSet<i64>,
    /// Tiles that were found in the cache.
    pub cached: usize,
}

impl Tiles {
    /// Those around an eye. Where tiles may not be relied on, all is read from the tables.
    pub fn around(scene: &str, bounds: &engine::Box3d) -> Self {
        let tables = SceneTables::of(scene);
        Self::meeting(tables, &Statements::of(scene, &tables), bounds)
    }

    /// The same of a scene whose tables are known.
    pub fn meeting(
        tables: SceneTables,
        statements: &Rc<Statements>,
        bounds: &engine::Box3d,
    ) -> Self {
        let mut tiles = Self::none(tables, statements);
        if tables.has_tiles() && tables.are_watched() && tables.may_read_all() {
            tiles.find(bounds);
            if !tiles.packed.is_empty() || tiles.is_packed() {
                if tables.has_edits() {
                    tiles.add_edits(bounds);
                }
                return tiles;
            }
        }
        let features = base::near(statements, Moment::Query, bounds);
        tiles.add(Rc::new(PackedTile::new(features)));
        tiles
    }

    /// One that holds all that counts.
    pub fn only(tables: SceneTables, statements: &Rc<Statements>, tile: Rc<PackedTile>) -> Self {
        let mut tiles = Self::none(tables, statements);
        tiles.add(tile);
        tiles
    }

    fn none(tables: SceneTables, statements: &Rc<Statements>) -> Self {
        Self {
            tables,
            statements: Rc::clone(statements),
            bounds: Vec::new(),
            packed: Vec::new(),
            tiles: Vec::new(),
            edited: HashSet::new(),
            cached: 0,
        }
    }

    /// Whether all features are in tiles or in the log of edits: a transaction that packs a scene packs
    /// all of it, so whoever sees one tile sees all.
    fn is_packed(&self) -> bool {
        let mut is = false;
        let any = self.statements.get(Ask::AnyTile);
        any.read(Moment::Query, &[], |_| is = true);
        is
    }

    fn find(&mut self, bounds: &engine::Box3d) {
        let statements = Rc::clone(&self.statements);
        let tiles = statements.get(Ask::Tiles);
        tiles.read(Moment::Query, &argument(Box3d(*bounds)), |row| {
            let version = row.get::<Uuid>(3).map(|uuid| *uuid.as_bytes());
            let packed = version.zip(Toasted::of(row, 4));
            if let Some((packed, bounds)) = packed.zip(row.get::<Box3d>(2)) {
                self.packed.push(packed);
                self.bounds.push(bounds.0);
            }
        });
        self.tiles = vec![None; self.packed.len()];
    }

    /// Edited features count as the tables have them, wherever tiles have them.
    fn add_edits(&mut self, bounds: &engine::Box3d) {
        let statements = Rc::clone(&self.statements);
        let edits = statements.get(Ask::Edits);
        edits.read(Moment::Query, &argument(Box3d(*bounds)), |row| {
            self.edited.extend(row.get::<i64>(1));
        });
        if !self.edited.is_empty() {
            let ids: Vec<i64> = self.edited.iter().copied().collect();
            let features = base::of(&statements, Moment::Query, &ids);
            self.add(Rc::new(PackedTile::new(features)));
        }
    }

    /// The features that occlusion volumes hide from an eye, each with one that hides it alone.
    pub fn hidden_by_volumes(&self, eye: DVec3) -> HashMap<i64, i64> {
        let mut hidden = HashMap::new();
        if settings::uses_volumes() && self.tables.has_volumes() {
            let asked = self.statements.get(Ask::Hidden);
            asked.read(Moment::Query, &argument(Point3d(eye)), |row| {
                hidden.extend(row.get::<i64>(1).zip(row.get::<i64>(2)));
            });
        }
        hidden
    }

    /// One tile of features that are given by id, with their outer envelopes; `None` unless all are here.
    pub fn gather(
        &mut self,
        mut features: HashMap<i64, engine::Box3d>,
    ) -> Result<Option<PackedTile>, Refusal> {
        let mut picks = Vec::new();
        for position in 0..self.tiles.len() {
            let bounds = self.bounds[position];
            if !features.values().any(|envelope| bounds.contains(envelope)) {
                continue;
            }
            self.tile(position)?;
            let Some(tile) = self.tiles[position].clone() else {
                continue;
            };
            for at in 0..tile.tile.len() {
                let (id, envelope) = tile.tile.feature(at);
                if features.get(&id) == Some(&envelope) && !self.is_outdated(position, id) {
                    features.remove(&id);
                    picks.push((Rc::clone(&tile), at));
                }
            }
        }
        Ok(features.is_empty().then(|| PackedTile::gathered(&picks)))
    }

    fn add(&mut self, tile: Rc<PackedTile>) {
        if let Some(bounds) = tile.tile.bounds() {
            self.bounds.push(bounds);
            self.tiles.push(Some(tile));
        }
    }

    fn load(&mut self, position: usize) -> Result<Rc<PackedTile>, Refusal> {
        let (version, content) = &self.packed[position];
        let key = Key::Packed(*version);
        if let Some(tile) = cache::find(&key) {
            self.cached += 1;
            return Ok(tile);
        }
        let tile = Rc::new(content.read(PackedTile::from_bytes)?);
        cache::keep(key, &tile);
        Ok(tile)
    }

    /// The features in a tile that was read, with their classes.
    pub fn get(&self, position: usize) -> Option<&PackedTile> {
        self.tiles[position].as_deref()
    }

    /// The feature of a sighting.
    pub fn seen(&self, sighting: &Sighting) -> Option<Seen> {
        let tile = self.get(sighting.tile)?;
        let (id, envelope) = tile.tile.feature(sighting.feature);
        Some(Seen {
            id,
            class: tile.class(sighting.feature).to_owned(),
            envelope,
            distance: sighting.distance,
        })
    }

    /// How many tiles there are, and how many of them were needed.
    pub fn counts(&self) -> (usize, usize) {
        let read = self.tiles.iter().flatten().count();
        (self.tiles.len(), read)
    }

    /// How many features were edited since the tiles were packed.
    pub fn edited(&self) -> usize {
        self.edited.len()
    }
}

impl TileSource for Tiles {
    type Error = Refusal;

    fn bounds(&self) -> &[engine::Box3d] {
        &self.bounds
    }

    fn tile(&mut self, position: usize) -> Result<&Tile, Refusal> {
        // The solver asks for a tile at each step; nothing else in it can be stopped.
        check_for_interrupts!();
        if self.tiles[position].is_none() {
            self.tiles[position] = Some(self.load(position)?);
        }
        match &self.tiles[position] {
            Some(tile) => Ok(&tile.tile),
            None => unreachable!("it was loaded"),
        }
    }

    fn is_outdated(&self, tile: usize, feature: i64) -> bool {
        tile < self.packed.len() && !self.edited.is_empty() && self.edited.contains(&feature)
    }
}
