//! `pack_tiles`: the features of a scene as tiles, from which queries are answered without reading its
//! tables.
//!
//! It forgets the log of edits first and reads the tables afterwards: what is edited in between is in
//! the tiles and in the log, which is right, and never in neither.

use super::base::{self, BaseFeature};
use super::edit_log;
use super::packed_tile::PackedTile;
use super::statements::{Ask, Statements};
use super::tables::Tables;
use crate::error::{Refusal, or_raise};
use crate::scene::{count, failed, quoted, run};
use crate::snapshot_read::{Moment, sees_the_latest};
use crate::types::Box3d;
use engine::neighbourhoods;
use pgrx::datum::DatumWithOid;
use pgrx::{IntoDatum, PgSqlErrorCode, Spi, check_for_interrupts, notice, pg_extern};
use std::collections::HashSet;
use std::rc::Rc;

/// Features of one tile, at the most. A tile is read whole, and each tile in range has a box to be tested.
pub const MOST_FEATURES: usize = 64;

/// Corners of the columns of one tile, at the most; a single feature may have more. It bounds what a
/// query reads to look at one feature.
const MOST_CORNERS: usize = 4096;

/// One edited feature for so many in all, and packing all anew is no more work.
const FEW: usize = 8;

/// Packs a scene; returns how many tiles were written.
#[pg_extern(volatile, strict)]
fn pack_tiles(scene: &str, optional: bool) -> i64 {
    if optional {
        return pack_if_possible(scene);
    }
    let packing = Packing::of(scene);
    match packing.prepare(true) {
        Ok(()) => packing.run(),
        Err(refusal) => refusal.raise(),
    }
}

/// Packs a scene where nothing stands against it; otherwise tells, and leaves it at that: queries are
/// right without tiles, and slower.
pub fn pack_if_possible(scene: &str) -> i64 {
    let packing = Packing::of(scene);
    match packing.prepare(false) {
        Ok(()) => packing.run(),
        Err(refusal) => {
            notice!("no tiles were packed: {refusal}");
            0
        }
    }
}

/// A scene that is to be packed.
struct Packing {
    /// Quoted.
    scene: String,
    name: String,
    tables: Tables,
    statements: Rc<Statements>,
}

impl Packing {
    fn of(scene: &str) -> Self {
        let tables = Tables::of(scene);
        Self {
            scene: quoted(scene),
            name: scene.to_owned(),
            statements: Statements::of(scene, &tables),
            tables,
        }
    }

    /// Makes sure that nothing is overlooked: that rows are not hidden, and edits not unlogged. With
    /// `wait` false, does not wait for those who are editing.
    fn prepare(&self, wait: bool) -> Result<(), Refusal> {
        let name = &self.name;
        if !self.tables.can_have_tiles() {
            return Err(Refusal::new(
                PgSqlErrorCode::ERRCODE_OBJECT_NOT_IN_PREREQUISITE_STATE,
                format!("scene \"{name}\" has no tables of tiles"),
            )
            .hint(format!(
                "An older version made it: SELECT occlusion.upgrade_scene('{name}') adds them."
            )));
        }
        if !self.tables.are_watched() {
            return Err(Refusal::new(
                PgSqlErrorCode::ERRCODE_FEATURE_NOT_SUPPORTED,
                format!("scene \"{name}\" has partitioned or inherited tables"),
            )
            .detail(
                "Their parts can be edited unnoticed, so queries read the tables themselves.",
            ));
        }
        if !self.tables.may_pack() {
            return Err(Refusal::new(
                PgSqlErrorCode::ERRCODE_INSUFFICIENT_PRIVILEGE,
                format!("permission denied to pack tiles of scene \"{name}\""),
            )
            .detail(
                "It takes SELECT on all rows of feature, solid_column, inner_envelope, mesh, tile and \
                 edit, INSERT and DELETE on tile, DELETE on edit, and UPDATE on scene_info.",
            ));
        }
        // Where there never were tiles, or all were truncated, edits are not logged; nobody truncates from now on.
        let is_locked = self.tables.lock_tiles(wait)
            && (self.tables.has_tiles() || self.tables.lock_sources(wait));
        if !is_locked {
            return Err(Refusal::new(
                PgSqlErrorCode::ERRCODE_LOCK_NOT_AVAILABLE,
                format!("others are editing scene \"{name}\""),
            ));
        }
        // Without a tile in sight, the last edits may be from before there was a log: a packing that was
        // rolled back leaves pages, and no tile.
        if !sees_the_latest() && self.count("tile") == 0 {
            return Err(Refusal::new(
                PgSqlErrorCode::ERRCODE_INVALID_TRANSACTION_STATE,
                format!("scene \"{name}\" cannot be packed for the first time in this transaction"),
            )
            .detail("Its snapshot may be older than edits that nothing was to log.")
            .hint("Pack it in a transaction that is READ COMMITTED."));
        }
        // One at a time; and an older snapshot than the last one's fails here.
        run(
            &format!(
                "UPDATE {}.scene_info SET format_version = format_version",
                self.scene
            ),
            &[],
        );
        Ok(())
    }

    fn run(&self) -> i64 {
        edit_log::forget();
        let features = self.count("feature");
        if self.count("tile") == 0 || self.count("edit") > features / FEW {
            self.pack_all()
        } else {
            self.pack_edited()
        }
    }

    fn pack_all(&self) -> i64 {
        for table in ["edit", "tile"] {
            run(&format!("DELETE FROM {}.{table}", self.scene), &[]);
        }
        self.write(&self.envelopes(
            &format!("SELECT id, envelope FROM {}.feature", self.scene),
            &[],
        ))
    }

    /// Packs what was edited anew, with all that is in tiles near it.
    fn pack_edited(&self) -> i64 {
        let edits = format!("DELETE FROM {}.edit RETURNING feature, place", self.scene);
        let edits = self.pairs::<Box3d>(&edits, &[]);
        let mut features: HashSet<i64> = edits.iter().map(|(feature, _)| *feature).collect();
        let anywhere: Vec<i64> = edits
            .iter()
            .filter_map(|(feature, place)| place.is_none().then_some(*feature))
            .collect();
        let now = self.envelopes_of(anywhere);
        let places = edits.into_iter().filter_map(|(_, place)| place);
        let mut tiles = HashSet::new();
        for place in places.chain(now.into_iter().map(|(_, envelope)| Box3d(envelope))) {
            let argument: Vec<_> = place.into_datum().into_iter().collect();
            self.statements
                .get(Ask::Tiles)
                .read(Moment::Now, &argument, |row| {
                    tiles.extend(row.get::<i64>(1));
                });
        }
        for &tile in &tiles {
            features.extend(self.features_in(tile));
        }
        let tiles: Vec<i64> = tiles.into_iter().collect();
        run(
            &format!(
                "DELETE FROM {}.tile WHERE id OPERATOR(pg_catalog.=) ANY ($1)",
                self.scene
            ),
            &[tiles.into()],
        );
        self.write(&self.envelopes_of(features.into_iter().collect()))
    }

    /// Writes tiles of some features; returns how many.
    fn write(&self, features: &[(i64, engine::Box3d)]) -> i64 {
        let boxes: Vec<engine::Box3d> = features.iter().map(|(_, envelope)| *envelope).collect();
        let mut written = 0;
        for group in neighbourhoods(&boxes, |_| 1, MOST_FEATURES) {
            check_for_interrupts!();
            let ids: Vec<i64> = group.iter().map(|&at| features[at].0).collect();
            let read = base::of(&self.statements, Moment::Now, &ids);
            for part in parts(read) {
                self.insert(&PackedTile::new(part));
                written += 1;
            }
        }
        count(written)
    }

    fn insert(&self, tile: &PackedTile) {
        let Some(bounds) = tile.tile.bounds() else {
            return;
        };
        run(
            &format!(
                "INSERT INTO {}.tile (bounds, features, content) VALUES ($1, $2, $3)",
                self.scene
            ),
            &[
                Box3d(bounds).into(),
                i32::try_from(tile.tile.len()).unwrap_or(i32::MAX).into(),
                tile.to_bytes().into(),
            ],
        );
    }

    fn features_in(&self, tile: i64) -> Vec<i64> {
        let argument: Vec<_> = tile.into_datum().into_iter().collect();
        let mut ids = Vec::new();
        self.statements
            .get(Ask::Content)
            .read(Moment::Now, &argument, |row| {
                let tile = row.get::<&[u8]>(1).map(PackedTile::from_bytes);
                if let Some(tile) = tile.map(or_raise) {
                    ids.extend((0..tile.tile.len()).map(|position| tile.tile.feature(position).0));
                }
            });
        ids
    }

    fn envelopes_of(&self, features: Vec<i64>) -> Vec<(i64, engine::Box3d)> {
        let query = format!(
            "SELECT id, envelope FROM {}.feature WHERE id OPERATOR(pg_catalog.=) ANY ($1)",
            self.scene
        );
        self.envelopes(&query, &[features.into()])
    }

    fn envelopes(&self, query: &str, arguments: &[DatumWithOid]) -> Vec<(i64, engine::Box3d)> {
        let rows = self.pairs::<Box3d>(query, arguments).into_iter();
        rows.filter_map(|(id, envelope)| Some((id, envelope?.0)))
            .collect()
    }

    /// The rows of a statement that returns a feature and something of it.
    fn pairs<T>(&self, query: &str, arguments: &[DatumWithOid]) -> Vec<(i64, Option<T>)>
    where
        T: pgrx::FromDatum + IntoDatum,
    {
        let rows = Spi::connect_mut(|client| {
            client
                .update(query, None, arguments)?
                .map(|row| Ok((row.get::<i64>(1)?, row.get::<T>(2)?)))
                .collect::<Result<Vec<_>, pgrx::spi::Error>>()
        });
        let rows = rows.unwrap_or_else(|error| failed(&error)).into_iter();
        rows.filter_map(|(id, value)| Some((id?, value))).collect()
    }

    fn count(&self, table: &str) -> usize {
        let query = format!("SELECT pg_catalog.count(*) FROM {}.{table}", self.scene);
        let rows =
            Spi::connect_mut(|client| client.update(&query, None, &[])?.first().get::<i64>(1));
        let rows = rows.unwrap_or_else(|error| failed(&error));
        usize::try_from(rows.unwrap_or(0)).unwrap_or(0)
    }
}

/// Features in groups that are no larger than a tile may be.
fn parts(features: Vec<BaseFeature>) -> Vec<Vec<BaseFeature>> {
    let boxes: Vec<engine::Box3d> = features.iter().map(|base| base.feature.envelope).collect();
    let corners: Vec<usize> = features.iter().map(BaseFeature::corners).collect();
    let groups = neighbourhoods(&boxes, |at| corners[at], MOST_CORNERS);
    let mut features: Vec<Option<BaseFeature>> = features.into_iter().map(Some).collect();
    let mut taken = |group: Vec<usize>| {
        group
            .into_iter()
            .filter_map(|at| features[at].take())
            .collect()
    };
    groups.into_iter().map(&mut taken).collect()
}
