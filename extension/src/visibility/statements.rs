//! [`Statements`], what visibility queries read of one scene, each planned once a backend.

use super::tables::{Tables, may, relation};
use crate::scene::{quoted, read_one};
use crate::snapshot_read::Statement;
use crate::types::Box3d;
use pgrx::IntoDatum;
use pgrx::pg_sys::{self, Oid};
use std::cell::{OnceCell, RefCell};
use std::collections::HashMap;
use std::rc::Rc;

/// Scenes whose statements are kept. Few backends ask more.
const MOST_SCENES: usize = 32;

thread_local! {
    static KEPT: RefCell<HashMap<(String, Oid), Rc<Statements>>> = RefCell::new(HashMap::new());
}

/// Statements on one scene.
pub struct Statements {
    name: String,
    namespace: Oid,
    cells: [OnceCell<Statement>; Ask::COUNT],
}

/// What can be asked.
#[derive(Clone, Copy)]
pub enum Ask {
    /// Id, bounds, version and content of the tiles that meet a box.
    Tiles,
    /// Whether there is any tile.
    AnyTile,
    /// Content of the tile with an id.
    Content,
    /// Features edited since the tiles were packed, in a box or anywhere.
    Edits,
    /// Id, class, envelope and outline of the features that meet a box.
    FeaturesNear,
    /// The same of the features with some ids.
    FeaturesOf,
    /// Feature, footprint, bottom and top of the columns of some features, and whether they are grounded.
    Columns,
    /// Feature and box of the grounded inner envelopes of some features.
    InnerEnvelopes,
    /// Features that occlusion volumes hide from an eye.
    Hidden,
    /// Id and envelope of the features that meet a box, but for those with some ids.
    EnvelopesNear,
    /// Feature, vertices, triangles of some features, and whether these enclose a solid.
    Meshes,
    /// Feature and box of all inner envelopes of some features.
    AllInnerEnvelopes,
    /// Visible set, box, range, id and snapshot of the view cell of an eye, in a cluster.
    ViewCell,
    /// Box, range and visible set of the view cells that meet a box and are right, in a cluster.
    CellsNear,
    /// Feature, footprint, bottom and top of the columns that meet a box, and whether they are grounded.
    ColumnsNear,
    /// Feature and box of the inner envelopes that meet a box.
    InnerEnvelopesNear,
    /// Box and range of the view cell with an id.
    CellQuery,
    /// Ids of the features that are proven to be visible from it.
    Proven,
    /// Envelope and slot of the feature with an id.
    Sought,
    /// Boxes of the right view cells in a cluster from which a slot may be seen, and whether that is proven.
    SeenFrom,
    /// Boxes of the squares within range of a box of which nothing is known, with all heights that eyes there may
    /// have, and of streets that are changed or new: no cell need be there yet. Of all streets where there is no square.
    UnknownFrom,
    /// Id and envelope of the features with some slots.
    Slotted,
    /// Id and slot of some features.
    Slots,
}

impl Ask {
    const COUNT: usize = Self::Slots as usize + 1;

    /// The statement for a scene. Columns are cast to the types that they are read as.
    fn text(self, name: &str) -> String {
        let scene = quoted(name);
        let features = format!(
            "SELECT id::pg_catalog.int8, class::pg_catalog.text, envelope::occlusion.box3d, \
                    outline::pg_catalog.polygon FROM {scene}.feature"
        );
        let columns = format!(
            "SELECT feature::pg_catalog.int8, footprint::pg_catalog.polygon[], \
                    bottom::pg_catalog.float8, top::pg_catalog.float8, grounded::pg_catalog.bool \
             FROM {scene}.solid_column"
        );
        match self {
            Self::Tiles => format!(
                "SELECT id::pg_catalog.int8, bounds::occlusion.box3d, version::pg_catalog.uuid, \
                        content::pg_catalog.bytea FROM {scene}.tile WHERE bounds OPERATOR(occlusion.&&) $1"
            ),
            Self::AnyTile => format!("SELECT 1 FROM {scene}.tile LIMIT 1"),
            Self::Content => format!(
                "SELECT content::pg_catalog.bytea FROM {scene}.tile \
                 WHERE id OPERATOR(pg_catalog.=) $1"
            ),
            Self::Edits => format!(
                "SELECT feature::pg_catalog.int8 FROM {scene}.edit \
                 WHERE place OPERATOR(occlusion.&&) $1 \
                 UNION ALL \
                 SELECT feature::pg_catalog.int8 FROM {scene}.edit WHERE place IS NULL"
            ),
            Self::FeaturesNear => format!("{features} WHERE envelope OPERATOR(occlusion.&&) $1"),
            Self::FeaturesOf => format!("{features} WHERE id OPERATOR(pg_catalog.=) ANY ($1)"),
            Self::InnerEnvelopes => format!("{} AND grounded", Self::AllInnerEnvelopes.text(name)),
            Self::Columns => format!("{columns} WHERE feature OPERATOR(pg_catalog.=) ANY ($1)"),
            Self::AllInnerEnvelopes => format!(
                "SELECT feature::pg_catalog.int8, box::occlusion.box3d FROM {scene}.inner_envelope \
                 WHERE feature OPERATOR(pg_catalog.=) ANY ($1)"
            ),
            Self::EnvelopesNear => format!(
                "SELECT id::pg_catalog.int8, envelope::occlusion.box3d FROM {scene}.feature \
                 WHERE envelope OPERATOR(occlusion.&&) $1 \
                   AND id OPERATOR(pg_catalog.<>) ALL ($2)"
            ),
            Self::Meshes => format!(
                "SELECT near.feature, m.vertices::pg_catalog.float8[], \
                        m.triangles::pg_catalog.int4[], m.defect IS NULL \
                 FROM pg_catalog.unnest($1) AS near (feature) LEFT JOIN {scene}.mesh AS m \
                   ON m.feature OPERATOR(pg_catalog.=) near.feature"
            ),
            Self::Slots => format!(
                "SELECT id::pg_catalog.int8, slot::pg_catalog.int4 FROM {scene}.feature \
                 WHERE id OPERATOR(pg_catalog.=) ANY ($1)"
            ),
            Self::CellsNear => format!(
                "SELECT c.box::occlusion.box3d, b.range::pg_catalog.float8, c.visible::occlusion.feature_set \
                 FROM {} WHERE b.box OPERATOR(occlusion.&&) $1 AND c.box OPERATOR(occlusion.&&) $1 \
                   AND {OF_CLUSTER} AND {}",
                cells(name),
                valid_cells(name)
            ),
            Self::SeenFrom => format!(
                "SELECT c.box::occlusion.box3d, NOT c.unproven OPERATOR(occlusion.@>) $1 FROM {} \
                 WHERE b.visible OPERATOR(occlusion.@>) $1 AND c.visible OPERATOR(occlusion.@>) $1 \
                   AND {OF_CLUSTER} AND {}",
                cells(name),
                valid_cells(name)
            ),
            Self::UnknownFrom => format!(
                "SELECT occlusion.box3d( \
                     occlusion.point3d(occlusion.x(occlusion.lower(b.area)), \
                                       occlusion.y(occlusion.lower(b.area)), s.low), \
                     occlusion.point3d(occlusion.x(occlusion.upper(b.area)), \
                                       occlusion.y(occlusion.upper(b.area)), s.high)) \
                 FROM {scene}.view_cell_block AS b CROSS JOIN LATERAL ( \
                     SELECT pg_catalog.min(t.eye_low), pg_catalog.max(t.eye_high) FROM {scene}.street AS t \
                     WHERE t.envelope OPERATOR(occlusion.&&) b.area) AS s (low, high) \
                 WHERE ((SELECT EXISTS (SELECT FROM {scene}.change)) \
                        OR (SELECT EXISTS (SELECT FROM {scene}.view_cell_block AS o WHERE NOT o.done)) \
                        OR (SELECT EXISTS ( \
                           SELECT FROM {scene}.view_cell_block AS o WHERE o.cluster OPERATOR(pg_catalog.<) $2 \
                               OR o.cluster OPERATOR(pg_catalog.>) $2))) \
                   AND b.area OPERATOR(occlusion.&&) occlusion.expand($1, b.range) AND s.low IS NOT NULL \
                   AND (NOT b.done OR b.cluster OPERATOR(pg_catalog.<>) $2 OR NOT ({})) \
                 UNION ALL \
                 SELECT e.place FROM {scene}.change AS e WHERE e.feature IS NULL AND e.place OPERATOR(occlusion.&&) \
                     occlusion.expand($1, (SELECT pg_catalog.max(b.range) FROM {scene}.view_cell_block AS b)) \
                 UNION ALL \
                 SELECT t.envelope FROM {scene}.street AS t \
                 WHERE NOT EXISTS (SELECT FROM {scene}.view_cell_block)",
                valid_cells(name)
            ),
            Self::Sought => format!(
                "SELECT envelope::occlusion.box3d, slot::pg_catalog.int8 FROM {scene}.feature \
                 WHERE id OPERATOR(pg_catalog.=) $1"
            ),
            Self::ColumnsNear => format!("{columns} WHERE envelope OPERATOR(occlusion.&&) $1"),
            Self::InnerEnvelopesNear => format!(
                "SELECT feature::pg_catalog.int8, box::occlusion.box3d FROM {scene}.inner_envelope \
                 WHERE box OPERATOR(occlusion.&&) $1"
            ),
            Self::CellQuery => format!(
                "SELECT c.box::occlusion.box3d, b.range::pg_catalog.float8 FROM {scene}.view_cell AS c \
                 JOIN {scene}.view_cell_block AS b \
                   ON b.id OPERATOR(pg_catalog.=) (c.id OPERATOR(pg_catalog.>>) {CELL_BITS}) \
                 WHERE c.id OPERATOR(pg_catalog.=) $1"
            ),
            Self::Proven => format!(
                "SELECT f.id::pg_catalog.int8 FROM {scene}.view_cell AS c \
                 CROSS JOIN LATERAL occlusion.unnest(c.visible OPERATOR(occlusion.-) c.unproven) AS s (slot) \
                 JOIN {scene}.feature AS f ON f.slot OPERATOR(pg_catalog.=) s.slot \
                 WHERE c.id OPERATOR(pg_catalog.=) $1"
            ),
            Self::Slotted => format!(
                "SELECT id::pg_catalog.int8, envelope::occlusion.box3d FROM {scene}.feature \
                 WHERE slot OPERATOR(pg_catalog.=) ANY ($1)"
            ),
            Self::Hidden => written("hidden_features_statement", name),
            Self::ViewCell => written("view_cell_statement", name),
        }
    }

    fn parameters(self) -> Vec<Oid> {
        match self {
            Self::AnyTile => Vec::new(),
            Self::Content | Self::CellQuery | Self::Proven | Self::Sought => vec![pg_sys::INT8OID],
            Self::FeaturesOf
            | Self::Columns
            | Self::InnerEnvelopes
            | Self::Meshes
            | Self::Slots
            | Self::AllInnerEnvelopes => vec![pg_sys::INT8ARRAYOID],
            Self::Slotted => vec![pg_sys::INT4ARRAYOID],
            Self::SeenFrom => vec![pg_sys::INT8OID, pg_sys::INT8OID],
            Self::UnknownFrom => vec![Box3d::type_oid(), pg_sys::INT8OID],
            Self::EnvelopesNear => vec![Box3d::type_oid(), pg_sys::INT8ARRAYOID],
            Self::Tiles
            | Self::Edits
            | Self::FeaturesNear
            | Self::ColumnsNear
            | Self::InnerEnvelopesNear => vec![Box3d::type_oid()],
            Self::CellsNear => vec![Box3d::type_oid(), pg_sys::INT8OID],
            Self::Hidden => vec![crate::types::Point3d::type_oid()],
            Self::ViewCell => vec![crate::types::Point3d::type_oid(), pg_sys::INT8OID],
        }
    }
}

impl Statements {
    /// Those of a scene. Planned anew when another schema has taken its name.
    pub fn of(scene: &str, tables: &Tables) -> Rc<Self> {
        KEPT.with_borrow_mut(|kept| {
            let key = (scene.to_owned(), tables.namespace());
            if kept.len() >= MOST_SCENES && !kept.contains_key(&key) {
                kept.drain().for_each(|(_, statements)| statements.free());
            }
            let new = || {
                Rc::new(Self {
                    name: scene.to_owned(),
                    namespace: tables.namespace(),
                    cells: [const { OnceCell::new() }; Ask::COUNT],
                })
            };
            Rc::clone(kept.entry(key).or_insert_with(new))
        })
    }

    /// One of them.
    pub fn get(&self, ask: Ask) -> &Statement {
        self.cells[ask as usize]
            .get_or_init(|| Statement::new(&ask.text(&self.name), &ask.parameters()))
    }

    /// Whether the current user may read meshes. Those who may not are answered by what else is known.
    pub fn may_read_meshes(&self) -> bool {
        may(relation(self.namespace, c"mesh"), pg_sys::ACL_SELECT)
    }

    /// Forgets them, unless a query that is under way has them in hand.
    fn free(self: Rc<Self>) {
        if let Ok(statements) = Rc::try_unwrap(self) {
            let kept = statements
                .cells
                .into_iter()
                .filter_map(OnceCell::into_inner);
            kept.for_each(Statement::free);
        }
    }
}

/// Bits of the number that a view cell has in its square; the others are the square's, as
/// `occlusion.cell_in_block_condition` has it.
pub const CELL_BITS: u32 = 22;

/// That a square b is of a cluster, the second argument. It is a question that no index answers: nearly all
/// squares are, and without statistics the planner takes them for few.
const OF_CLUSTER: &str = "(b.cluster OPERATOR(pg_catalog.=) $2) IS TRUE";

/// View cells c with their squares b.
fn cells(scene: &str) -> String {
    let lies_in = read_one::<String>("SELECT occlusion.cell_in_block_condition()", &[]);
    let lies_in = lies_in.unwrap_or_else(|| unreachable!("a condition is text"));
    let scene = quoted(scene);
    format!("{scene}.view_cell_block AS b JOIN {scene}.view_cell AS c ON {lies_in}")
}

/// That the cells of a square b are right.
fn valid_cells(scene: &str) -> String {
    written("valid_cells_condition", scene)
}

/// What a function of `sql/` has for a scene.
fn written(function: &str, scene: &str) -> String {
    let query = format!("SELECT occlusion.{function}($1)");
    let text = read_one::<String>(&query, &[scene.into()]);
    text.unwrap_or_else(|| unreachable!("the statement of a scene is text"))
}
