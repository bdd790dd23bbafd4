//! How many features of a scene a field of view returns, from what ANALYZE found.

use super::column::{analyzed, fixed_part};
use super::query::{Query, type_name};
use super::support::Arguments;
use engine::BoxRelation;
use pgrx::{FromDatum, pg_sys};
use std::ffi::{CStr, CString};

/// Features seen all round for each e-fold of those in range: the nearest hide the others, so that their
/// number grows as the logarithm of what is there (docs/benchmarks.md, "From a point").
const SEEN_BY_FOLD: f64 = 25.0;

/// Rows of `visible_features(scene, field of view, …)` or `(scene, observer, range, …)`. Looks at
/// the catalogs only, takes no locks, and raises no error: a scene that is none fails when the
/// query runs.
pub fn visible_rows(arguments: &Arguments) -> Option<f64> {
    let scene = arguments.get(0)?;
    // SAFETY: the first parameter is of type text.
    let scene = unsafe { String::from_datum(scene.constvalue, false)? };
    let query = field_of_view(arguments)?;
    let tables = Tables::of(&scene)?;
    let feature = tables.find(c"feature")?;
    let in_view = feature.rows * feature.share(c"envelope", &query)?;
    let around = match query {
        Query::InView(_, eye, range) => {
            feature.rows * feature.share(c"envelope", &Query::InRange(eye, range))?
        }
        _ => in_view,
    };
    Some(in_view * seen_share(around))
}

/// The share of the features in range that is seen all round, among houses.
fn seen_share(around: f64) -> f64 {
    (SEEN_BY_FOLD * around.ln_1p() / around.max(1.0)).min(1.0)
}

/// What the observer looks at.
fn field_of_view(arguments: &Arguments) -> Option<Query> {
    let view = arguments.get(1)?;
    match Query::of(view)? {
        Query::Bounds(bounds) if type_name(view.consttype) == "occlusion.point3d" => {
            // SAFETY: after an observer comes the range, of type float8.
            let range = unsafe { f64::from_datum(arguments.get(2)?.constvalue, false)? };
            Some(Query::InRange(bounds.min, range))
        }
        Query::Bounds(_) => None,
        view => Some(view),
    }
}

/// The tables of a schema.
struct Tables(pg_sys::Oid);

impl Tables {
    /// Those of a schema that the current user may use.
    fn of(schema: &str) -> Option<Self> {
        if schema.len() >= pg_sys::NAMEDATALEN as usize {
            return None;
        }
        let schema = CString::new(schema).ok()?;
        // SAFETY: looks the name up in the catalog.
        let schema = unsafe { pg_sys::get_namespace_oid(schema.as_ptr(), true) };
        (schema != pg_sys::InvalidOid && may_use(schema)).then_some(Self(schema))
    }

    /// The real table of a name, if it has been analysed.
    fn find(&self, name: &CStr) -> Option<Table> {
        // SAFETY: looks the table up in the catalog, whose row is released after its last use.
        unsafe {
            let oid = pg_sys::get_relname_relid(name.as_ptr(), self.0);
            let tuple = pg_sys::SearchSysCache1(
                pg_sys::SysCacheIdentifier::RELOID as i32,
                pg_sys::Datum::from(oid),
            );
            if tuple.is_null() {
                return None;
            }
            let row = &*fixed_part::<pg_sys::FormData_pg_class>(tuple);
            let (kind, rows) = (row.relkind as u8, f64::from(row.reltuples));
            pg_sys::ReleaseSysCache(tuple);
            let is_table =
                kind == pg_sys::RELKIND_RELATION || kind == pg_sys::RELKIND_PARTITIONED_TABLE;
            (is_table && rows >= 0.0).then_some(Table {
                oid,
                rows,
                partitioned: kind == pg_sys::RELKIND_PARTITIONED_TABLE,
            })
        }
    }
}

/// A table, with the number of rows that ANALYZE found.
struct Table {
    oid: pg_sys::Oid,
    rows: f64,
    partitioned: bool,
}

impl Table {
    /// The share of rows whose box meets the query; `None` if the user may not read all of them.
    fn share(&self, column: &CStr, query: &Query) -> Option<f64> {
        // SAFETY: looks the statistics up in the catalog; the row is released after its last use.
        unsafe {
            let number = pg_sys::get_attnum(self.oid, column.as_ptr());
            let is_box = type_name(pg_sys::get_atttype(self.oid, number)) == "occlusion.box3d";
            if !is_box || !self.may_read(number) {
                return None;
            }
            let tuple = pg_sys::SearchSysCache3(
                pg_sys::SysCacheIdentifier::STATRELATTINH as i32,
                pg_sys::Datum::from(self.oid),
                pg_sys::Datum::from(number),
                pg_sys::Datum::from(self.partitioned),
            );
            if tuple.is_null() {
                return None;
            }
            let analyzed = analyzed(tuple);
            pg_sys::ReleaseSysCache(tuple);
            let analyzed = analyzed?;
            Some(query.share(&analyzed.boxes, BoxRelation::Overlaps) * analyzed.present)
        }
    }

    /// Whether the current user may read a column of all rows.
    fn may_read(&self, column: pg_sys::AttrNumber) -> bool {
        // SAFETY: asks the catalog about the table, which was found there.
        unsafe {
            let user = pg_sys::GetUserId();
            let right = pg_sys::ACL_SELECT as pg_sys::AclMode;
            let granted = pg_sys::pg_class_aclcheck(self.oid, user, right)
                == pg_sys::AclResult::ACLCHECK_OK
                || pg_sys::pg_attribute_aclcheck(self.oid, column, user, right)
                    == pg_sys::AclResult::ACLCHECK_OK;
            let all_rows = pg_sys::check_enable_rls(self.oid, pg_sys::InvalidOid, true)
                != pg_sys::CheckEnableRlsResult::RLS_ENABLED as i32;
            granted && all_rows
        }
    }
}

/// Whether the current user may use a schema.
fn may_use(schema: pg_sys::Oid) -> bool {
    // SAFETY: asks the catalog about a schema that was found there.
    unsafe {
        let (user, right) = (pg_sys::GetUserId(), pg_sys::ACL_USAGE as pg_sys::AclMode);
        #[cfg(any(feature = "pg14", feature = "pg15"))]
        let answer = pg_sys::pg_namespace_aclcheck(schema, user, right);
        #[cfg(not(any(feature = "pg14", feature = "pg15")))]
        let answer = pg_sys::object_aclcheck(pg_sys::NamespaceRelationId, schema, user, right);
        answer == pg_sys::AclResult::ACLCHECK_OK
    }
}
