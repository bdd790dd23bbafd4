//! The tiles that a backend keeps.

use super::packed_tile::PackedTile;
use crate::settings;
use lru::LruCache;
use pgrx::pg_sys::Oid;
use std::cell::RefCell;
use std::rc::Rc;

/// What a tile is known by: it is given when a tile is written, and never again, so that a tile in
/// memory is right in every transaction whose snapshot shows its version.
pub type Version = [u8; 16];

/// What a tile in memory is known by.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Key {
    /// One that the table `tile` holds.
    Packed(Version),
    /// One gathered for view cells; `ViewCell::tile` says why it is known by this.
    Gathered {
        /// The schema of the scene.
        namespace: Oid,
        /// What the cells were computed under.
        snapshot: Vec<u8>,
        /// The slots of its features.
        visible: Vec<u8>,
    },
}

thread_local! {
    static CACHE: RefCell<TileCache> = RefCell::new(TileCache {
        tiles: LruCache::unbounded(),
        size: 0,
    });
}

/// Tiles, those that were used last kept longest.
struct TileCache {
    tiles: LruCache<Key, Rc<PackedTile>>,
    /// Bytes of all of them.
    size: usize,
}

/// The tile of a key, if it is kept.
pub fn find(key: &Key) -> Option<Rc<PackedTile>> {
    CACHE.with_borrow_mut(|cache| cache.tiles.get(key).map(Rc::clone))
}

/// Keeps a tile, and drops others until all together take no more than `pg_occlusion.cache_size`.
pub fn keep(key: Key, tile: &Rc<PackedTile>) {
    CACHE.with_borrow_mut(|cache| {
        cache.size += tile.size() + key.size();
        if let Some((key, old)) = cache.tiles.push(key, Rc::clone(tile)) {
            cache.size -= old.size() + key.size();
        }
        cache.shrink(settings::cache_bytes());
    });
}

impl Key {
    /// Bytes that it takes besides what every key does.
    fn size(&self) -> usize {
        match self {
            Self::Packed(_) => 0,
            Self::Gathered {
                snapshot, visible, ..
            } => snapshot.len() + visible.len(),
        }
    }
}

impl TileCache {
    fn shrink(&mut self, most: usize) {
        while self.size > most
            && let Some((key, tile)) = self.tiles.pop_lru()
        {
            self.size -= tile.size() + key.size();
        }
    }
}
