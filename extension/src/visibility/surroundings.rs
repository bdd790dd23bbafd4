//! [`Surroundings`], what view cells are computed from.

use super::base;
use super::cache::Version;
use super::live::within_reach;
use super::pack::MOST_FEATURES;
use super::packed_tile::PackedTile;
use super::statements::{Ask, Statements};
use super::surfaces;
use super::tables::Tables;
use crate::error::{Refusal, or_raise};
use crate::snapshot_read::{Moment, argument};
use crate::types::Box3d;
use engine::{CellScene, CellTile, SurfaceTile, Tile, TileFeature, neighbourhoods};
use lru::LruCache;
use pgrx::{PgSqlErrorCode, Uuid};
use std::collections::{HashMap, HashSet};
use std::rc::Rc;
use std::sync::Arc;

/// Bytes that a corner of an eroded tile takes, or a few more.
const CORNER: usize = 32;

/// Bytes that a triangle of a surface takes, with its share of the tree.
const TRIANGLE: usize = 112;

/// What is around some cells.
pub struct Around {
    pub scene: CellScene,
    pub surfaces: engine::Surfaces,
}

/// A neighbourhood, as it hides and as it is seen.
type Kept = (Arc<CellTile>, Arc<SurfaceTile>);

/// The tiles of a scene as they are now, with what is left of them after erosions. They are kept from one
/// part of the scene to the next, those that were used last longest.
pub struct Surroundings {
    scene: String,
    kept: LruCache<Version, Kept>,
    room: usize,
}

impl Surroundings {
    /// None yet, with room for so many bytes between parts.
    pub fn new(scene: &str, room: usize) -> Self {
        Self {
            scene: scene.to_owned(),
            kept: LruCache::unbounded(),
            room,
        }
    }

    /// Raises an error where edits would go unnoticed.
    pub fn require_log(&self) {
        if Tables::of(&self.scene).are_changes_logged() {
            return;
        }
        Refusal::new(
            PgSqlErrorCode::ERRCODE_FEATURE_NOT_SUPPORTED,
            format!(
                "scene \"{}\" has partitioned or inherited tables",
                self.scene
            ),
        )
        .detail("Their parts can be edited unnoticed, so view cells would never be in use.")
        .raise()
    }

    /// All features within range of a box, and those that meet the box around these.
    pub fn around(&mut self, bounds: &engine::Box3d, range: f64) -> Around {
        let bounds = within_reach(bounds, range);
        let (tiles, surfaces) = self.tiles(&bounds).into_iter().unzip();
        Around {
            scene: CellScene::new(tiles),
            surfaces: engine::Surfaces::new(surfaces),
        }
    }

    fn tiles(&mut self, bounds: &engine::Box3d) -> Vec<Kept> {
        self.shrink();
        let tables = Tables::of(&self.scene);
        let statements = Statements::of(&self.scene, &tables);
        if tables.has_tiles() && tables.are_watched() && tables.may_read_all() {
            while let Some(heads) = unedited(&statements, bounds) {
                // A tile that is gone was packed anew in the meantime.
                if let Some(tiles) = heads
                    .into_iter()
                    .map(|head| self.load(&statements, head))
                    .collect()
                {
                    return tiles;
                }
            }
        }
        let features = base::near(&statements, Moment::Now, bounds);
        let features = features.into_iter().map(|base| base.feature).collect();
        tiles(&statements, features)
    }

    /// The slots of features, of those that have one.
    pub fn slots(&self, features: &HashSet<i64>) -> HashMap<i64, i64> {
        let statements = Statements::of(&self.scene, &Tables::of(&self.scene));
        let mut slots = HashMap::new();
        let ids: Vec<i64> = features.iter().copied().collect();
        statements
            .get(Ask::Slots)
            .read(Moment::Now, &argument(ids), |row| {
                let slot = row.get::<i32>(2).map(i64::from);
                slots.extend(row.get::<i64>(1).zip(slot));
            });
        slots
    }

    fn load(&mut self, statements: &Statements, (id, version): (i64, Version)) -> Option<Kept> {
        if let Some(kept) = self.kept.get(&version) {
            return Some(kept.clone());
        }
        let mut read = None;
        let content = statements.get(Ask::Content);
        content.read(Moment::Now, &argument(id), |row| {
            read = row.get::<&[u8]>(1).map(PackedTile::from_bytes);
        });
        let kept = kept(statements, or_raise(read?).tile);
        self.kept.put(version, kept.clone());
        Some(kept)
    }

    fn shrink(&mut self) {
        let size =
            |(tile, surfaces): &Kept| CORNER * tile.corner_count() + TRIANGLE * surfaces.len();
        let mut all: usize = self.kept.iter().map(|(_, kept)| size(kept)).sum();
        while all > self.room
            && let Some((_, kept)) = self.kept.pop_lru()
        {
            all -= size(&kept);
        }
    }
}

/// Ids and versions of the tiles that meet a box; `None` if there are none, or something was edited since
/// they were packed.
///
/// The log is read first: what was edited before is in it, or in the tiles that are found afterwards. The
/// other way round, an edit that is packed in between would be in neither.
fn unedited(statements: &Rc<Statements>, bounds: &engine::Box3d) -> Option<Vec<(i64, Version)>> {
    let bounds = argument(Box3d(*bounds));
    let mut is_edited = false;
    let edits = statements.get(Ask::Edits);
    edits.read(Moment::Now, &bounds, |_| is_edited = true);
    let mut heads = Vec::new();
    let tiles = statements.get(Ask::Tiles);
    tiles.read(Moment::Now, &bounds, |row| {
        let version = row.get::<Uuid>(3).map(|uuid| *uuid.as_bytes());
        heads.extend(row.get::<i64>(1).zip(version));
    });
    (!is_edited && !heads.is_empty()).then_some(heads)
}

/// Tiles of some features.
fn tiles(statements: &Statements, features: Vec<TileFeature>) -> Vec<Kept> {
    let boxes: Vec<engine::Box3d> = features.iter().map(|feature| feature.envelope).collect();
    let tile = |group: Vec<usize>| {
        let members: Vec<TileFeature> = group.iter().map(|&at| features[at].clone()).collect();
        kept(statements, Tile::new(&members))
    };
    let groups = neighbourhoods(&boxes, |_| 1, MOST_FEATURES);
    groups.into_iter().map(tile).collect()
}

/// A tile with the surfaces of its features.
fn kept(statements: &Statements, tile: Tile) -> Kept {
    let features: Vec<i64> = (0..tile.len()).map(|at| tile.feature(at).0).collect();
    let surfaces = surfaces::of(statements, Moment::Now, &features);
    (
        Arc::new(CellTile::new(tile)),
        Arc::new(SurfaceTile::new(surfaces)),
    )
}
