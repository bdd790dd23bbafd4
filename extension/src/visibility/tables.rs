//! [`Tables`], those of a scene, as the catalog has them now.

use crate::scene;
use pgrx::pg_sys::{self, Oid};
use std::ffi::{CStr, CString};

/// Columns of a table, with their types; `None` is `box3d`.
type Columns = &'static [(&'static CStr, Option<Oid>)];

/// Tables and columns that visibility queries read: of those that `scene_columns()` lists, and looked up
/// without a statement, since each query does.
const READ: [(&CStr, Columns); 6] = [
    (
        c"feature",
        &[
            (c"id", Some(pg_sys::INT8OID)),
            (c"class", Some(pg_sys::TEXTOID)),
            (c"envelope", None),
            (c"outline", Some(pg_sys::POLYGONOID)),
        ],
    ),
    (
        c"solid_column",
        &[
            (c"feature", Some(pg_sys::INT8OID)),
            (c"footprint", Some(pg_sys::POLYGONARRAYOID)),
            (c"bottom", Some(pg_sys::FLOAT8OID)),
            (c"top", Some(pg_sys::FLOAT8OID)),
            (c"grounded", Some(pg_sys::BOOLOID)),
            (c"envelope", None),
        ],
    ),
    (
        c"inner_envelope",
        &[
            (c"feature", Some(pg_sys::INT8OID)),
            (c"box", None),
            (c"grounded", Some(pg_sys::BOOLOID)),
        ],
    ),
    (
        c"mesh",
        &[
            (c"feature", Some(pg_sys::INT8OID)),
            (c"vertices", Some(pg_sys::FLOAT8ARRAYOID)),
            (c"triangles", Some(pg_sys::INT4ARRAYOID)),
            (c"defect", Some(pg_sys::TEXTOID)),
        ],
    ),
    (
        c"occlusion_volume",
        &[(c"occludee", Some(pg_sys::INT8OID)), (c"box", None)],
    ),
    (
        c"street",
        &[
            (c"area", Some(pg_sys::POLYGONARRAYOID)),
            (c"envelope", None),
        ],
    ),
];

/// Those of packed tiles and view cells, which a scene made by an older version lacks.
const DERIVED: [(&CStr, Columns); 5] = [
    (
        c"tile",
        &[
            (c"id", Some(pg_sys::INT8OID)),
            (c"bounds", None),
            (c"version", Some(pg_sys::UUIDOID)),
            (c"content", Some(pg_sys::BYTEAOID)),
        ],
    ),
    (
        c"edit",
        &[(c"feature", Some(pg_sys::INT8OID)), (c"place", None)],
    ),
    (
        c"view_cell",
        &[(c"id", Some(pg_sys::INT8OID)), (c"box", None)],
    ),
    (
        c"change",
        &[
            (c"feature", Some(pg_sys::INT8OID)),
            (c"place", None),
            (c"transaction", Some(pg_sys::XID8OID)),
        ],
    ),
    (
        c"view_cell_block",
        &[
            (c"id", Some(pg_sys::INT8OID)),
            (c"range", Some(pg_sys::FLOAT8OID)),
            (c"box", None),
            (c"snapshot", Some(pg_sys::PG_SNAPSHOTOID)),
            (c"cluster", Some(pg_sys::INT8OID)),
        ],
    ),
];

/// What tiles are made of, so that triggers on them write the log of edits.
const SOURCES: [&CStr; 4] = [c"feature", c"solid_column", c"inner_envelope", c"mesh"];

/// The tables of a scene.
#[derive(Clone, Copy, Debug)]
pub struct Tables {
    namespace: Oid,
    tile: Oid,
    edit: Oid,
    view_cell: Oid,
    change: Oid,
    view_cell_block: Oid,
}

impl Tables {
    /// Those of a scene; raises an error unless it is one of real tables, which its user may use.
    pub fn of(name: &str) -> Self {
        match Self::find(name) {
            Some(tables) => tables,
            None => {
                // It knows what is wrong, and says it.
                scene::require(name);
                let tables = Self::find(name);
                tables.unwrap_or_else(|| unreachable!("a scene has the columns of its tables"))
            }
        }
    }

    fn find(name: &str) -> Option<Self> {
        if name.len() >= pg_sys::NAMEDATALEN as usize {
            return None;
        }
        let name = CString::new(name).ok()?;
        // SAFETY: looks the name up in the catalog; an error where the user may not use the schema.
        let namespace = unsafe { pg_sys::LookupExplicitNamespace(name.as_ptr(), true) };
        let box3d = box3d_type()?;
        let table = |name: &CStr| table(namespace, name);
        table(c"scene_info")?;
        for (name, columns) in READ {
            has_columns(table(name)?, columns, box3d).then_some(())?;
        }
        let derived = DERIVED.map(|(name, columns)| match relation(namespace, name) {
            pg_sys::InvalidOid => Some(pg_sys::InvalidOid),
            _ => table(name).filter(|&oid| has_columns(oid, columns, box3d)),
        });
        Some(Self {
            namespace,
            tile: derived[0]?,
            edit: derived[1]?,
            view_cell: derived[2]?,
            change: derived[3]?,
            view_cell_block: derived[4]?,
        })
    }

    /// The schema's own number.
    pub fn namespace(&self) -> Oid {
        self.namespace
    }

    /// Whether the scene has the tables of tiles and edits at all.
    pub fn can_have_tiles(&self) -> bool {
        self.tile != pg_sys::InvalidOid && self.edit != pg_sys::InvalidOid
    }

    /// Whether the scene has the tables of view cells at all.
    pub fn can_have_cells(&self) -> bool {
        self.cells()
            .into_iter()
            .all(|oid| oid != pg_sys::InvalidOid)
    }

    /// Whether there may be view cells that may be relied on: every change is logged, and no row security
    /// keeps features, cells or changes from the current user.
    pub fn has_cells(&self) -> bool {
        self.can_have_cells()
            && has_pages(self.view_cell)
            && self.are_changes_logged()
            && self.shows_all_of_cells()
    }

    /// Whether no row security keeps view cells, or what they rest on, from the current user.
    pub fn shows_all_of_cells(&self) -> bool {
        self.shows_all_of_sources() && self.cells().into_iter().all(sees_all_rows)
    }

    /// Whether no row security keeps from the current user any of what volumes and cells are computed from.
    fn shows_all_of_sources(&self) -> bool {
        let mut sources = SOURCES.into_iter().chain([c"street"]);
        sources.all(|name| sees_all_rows(relation(self.namespace, name)))
    }

    fn cells(&self) -> [Oid; 3] {
        [self.view_cell, self.view_cell_block, self.change]
    }

    /// Whether all that view cells rest on is written to the log of changes.
    pub fn are_changes_logged(&self) -> bool {
        self.are_watched() && opened(relation(self.namespace, c"street"), is_watched)
    }

    /// Whether every edit is written to the log.
    pub fn are_watched(&self) -> bool {
        SOURCES
            .iter()
            .all(|name| opened(relation(self.namespace, name), is_watched))
    }

    /// Whether the current user may read all rows of tiles, edits and what they are made of.
    pub fn may_read_all(&self) -> bool {
        let sources = SOURCES.map(|name| relation(self.namespace, name));
        let tables = sources.into_iter().chain([self.tile, self.edit]);
        tables
            .into_iter()
            .all(|oid| may(oid, pg_sys::ACL_SELECT) && sees_all_rows(oid))
    }

    /// Whether the current user may read view cells and all that they and tiles rest on.
    pub fn may_read_cells(&self) -> bool {
        let street = relation(self.namespace, c"street");
        let mut tables = self.cells().into_iter().chain([street]);
        self.may_read_all() && tables.all(|oid| may(oid, pg_sys::ACL_SELECT))
    }

    /// Whether the current user may replace tiles.
    pub fn may_pack(&self) -> bool {
        let touched = relation(self.namespace, c"scene_info");
        self.may_read_all()
            && may(touched, pg_sys::ACL_UPDATE)
            && may(self.tile, pg_sys::ACL_INSERT)
            && may(self.tile, pg_sys::ACL_DELETE)
            && may(self.edit, pg_sys::ACL_DELETE)
    }

    /// Whether tiles were ever written, by any transaction: if not, edits need no log.
    pub fn has_tiles(&self) -> bool {
        self.can_have_tiles() && has_pages(self.tile)
    }

    /// Whether there may be edits that the tiles do not hold.
    pub fn has_edits(&self) -> bool {
        has_pages(self.edit)
    }

    /// Whether there may be occlusion volumes that may be relied on: not where row security keeps from the current
    /// user what they were computed from, since that would be told by what it hides.
    pub fn has_volumes(&self) -> bool {
        has_pages(relation(self.namespace, c"occlusion_volume")) && self.shows_all_of_sources()
    }

    /// Keeps others from editing until the end of the transaction; with `wait` false only if nobody is
    /// just doing so. Returns whether it does.
    pub fn lock_sources(&self, wait: bool) -> bool {
        let sources = SOURCES.iter().map(|name| relation(self.namespace, name));
        lock(sources, pg_sys::ShareLock, wait)
    }

    /// Keeps others from truncating the tiles until the end of the transaction, as `lock_sources` does.
    pub fn lock_tiles(&self, wait: bool) -> bool {
        lock([self.tile], pg_sys::RowExclusiveLock, wait)
    }
}

/// Locks tables that were found in the catalog until the transaction ends; with `wait` false only if nobody
/// else stands against it. Returns whether it did.
fn lock(tables: impl IntoIterator<Item = Oid>, mode: u32, wait: bool) -> bool {
    let mode = mode.cast_signed();
    // SAFETY: a lock may be taken on any number of a table.
    tables.into_iter().all(|table| unsafe {
        if wait {
            pg_sys::LockRelationOid(table, mode);
        }
        wait || pg_sys::ConditionalLockRelationOid(table, mode)
    })
}

/// A relation of a schema; [`pg_sys::InvalidOid`] if there is none.
pub fn relation(namespace: Oid, name: &CStr) -> Oid {
    // SAFETY: looks the name up in the catalog.
    unsafe { pg_sys::get_relname_relid(name.as_ptr(), namespace) }
}

/// Whether rows of any transaction are or were in a table. Those that a snapshot sees were written
/// before it was taken, so a table that has no page now has no row for it.
pub fn has_pages(table: Oid) -> bool {
    opened(table, |table| {
        let main = pg_sys::ForkNumber::MAIN_FORKNUM;
        // SAFETY: the table is open; a partitioned one has no file, and its parts may have rows.
        unsafe {
            (*table.rd_rel).relkind as u8 != pg_sys::RELKIND_RELATION
                || pg_sys::RelationGetNumberOfBlocksInFork(table, main) > 0
        }
    })
}

/// Whether every edit of an open table is written to the log: not so of one that has parts or heirs,
/// whose rows come and go without triggers, or that is a part itself.
fn is_watched(table: &mut pg_sys::RelationData) -> bool {
    // SAFETY: the table is open.
    let row = unsafe { &*table.rd_rel };
    row.relkind as u8 == pg_sys::RELKIND_RELATION && !row.relhassubclass && !row.relispartition
}

/// What `look` finds in a table while it is open.
pub fn opened<T>(table: Oid, look: impl FnOnce(&mut pg_sys::RelationData) -> T) -> T {
    let lock = pg_sys::AccessShareLock as pg_sys::LOCKMODE;
    // SAFETY: opens a table that was found in the catalog, or raises an error if it has gone.
    unsafe {
        let open = pg_sys::relation_open(table, lock);
        let found = look(&mut *open);
        pg_sys::relation_close(open, lock);
        found
    }
}

/// A relation of a schema that is a real table.
fn table(namespace: Oid, name: &CStr) -> Option<Oid> {
    let oid = relation(namespace, name);
    if oid == pg_sys::InvalidOid {
        return None;
    }
    // SAFETY: asks the catalog about a relation that was found there.
    let kind = unsafe { pg_sys::get_rel_relkind(oid) } as u8;
    let is_table = kind == pg_sys::RELKIND_RELATION || kind == pg_sys::RELKIND_PARTITIONED_TABLE;
    is_table.then_some(oid)
}

fn has_columns(table: Oid, columns: Columns, box3d: Oid) -> bool {
    columns.iter().all(|&(name, type_oid)| {
        // SAFETY: asks the catalog about a table that was found there; a column that is missing has
        // number 0, which has no type.
        let found = unsafe {
            let number = pg_sys::get_attnum(table, name.as_ptr());
            (number > 0).then(|| pg_sys::get_atttype(table, number))
        };
        found == Some(type_oid.unwrap_or(box3d))
    })
}

/// The type `box3d` of this extension.
fn box3d_type() -> Option<Oid> {
    // SAFETY: looks the names up in the catalog.
    let oid = unsafe {
        let schema = pg_sys::get_namespace_oid(c"occlusion".as_ptr(), true);
        let (key, column) = (c"box3d", pg_sys::Anum_pg_type_oid as pg_sys::AttrNumber);
        pg_sys::GetSysCacheOid(
            pg_sys::SysCacheIdentifier::TYPENAMENSP as i32,
            column,
            pg_sys::Datum::from(key.as_ptr()),
            pg_sys::Datum::from(schema),
            pg_sys::Datum::null(),
            pg_sys::Datum::null(),
        )
    };
    (oid != pg_sys::InvalidOid).then_some(oid)
}

/// Whether the current user has a right on a table.
pub fn may(table: Oid, right: u32) -> bool {
    // SAFETY: asks the catalog about a table that was found there.
    unsafe {
        pg_sys::pg_class_aclcheck(table, pg_sys::GetUserId(), right as pg_sys::AclMode)
            == pg_sys::AclResult::ACLCHECK_OK
    }
}

/// Whether row security hides no row from the current user.
fn sees_all_rows(table: Oid) -> bool {
    // SAFETY: asks the catalog about a table that was found there.
    unsafe {
        pg_sys::check_enable_rls(table, pg_sys::InvalidOid, true)
            != pg_sys::CheckEnableRlsResult::RLS_ENABLED as i32
    }
}
