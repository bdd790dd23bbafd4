//! The tiles that a backend keeps.

use super::packed_tile::PackedTile;
use crate::settings;
use lru::LruCache;
use std::cell::RefCell;
use std::rc::Rc;

/// What a tile is known by: it is given when a tile is written, and never again, so that a tile in
/// memory is right in every transaction whose snapshot shows its version.
pub type Version = [u8; 16];

thread_local! {
    static CACHE: RefCell<TileCache> = RefCell::new(TileCache {
        tiles: LruCache::unbounded(),
        size: 0,
    });
}

/// Tiles, those that were used last kept longest.
struct TileCache {
    tiles: LruCache<Version, Rc<PackedTile>>,
    /// Bytes of all of them.
    size: usize,
}

/// The tile of a version, if it is kept.
pub fn find(version: &Version) -> Option<Rc<PackedTile>> {
    CACHE.with_borrow_mut(|cache| cache.tiles.get(version).map(Rc::clone))
}

/// Keeps a tile, and drops others until all together take no more than `pg_occlusion.cache_size`.
pub fn keep(version: Version, tile: &Rc<PackedTile>) {
    CACHE.with_borrow_mut(|cache| {
        cache.size += tile.size();
        if let Some((_, old)) = cache.tiles.push(version, Rc::clone(tile)) {
            cache.size -= old.size();
        }
        cache.shrink(settings::cache_bytes());
    });
}

impl TileCache {
    fn shrink(&mut self, most: usize) {
        while self.size > most
            && let Some((_, tile)) = self.tiles.pop_lru()
        {
            self.size -= tile.size();
        }
    }
}
