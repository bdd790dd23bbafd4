//! `log_edit`, the trigger that writes which features were edited, and where, to the tables `edit` and
//! `change` of their scene. What is in `edit` counts as the tables have it, not as the packed tiles do; near
//! what is in `change`, view cells count that were computed under a snapshot that shows it.
//!
//! A row is logged before it changes, and after if it became different from what was announced: at no
//! moment is there a change that is not in the log. A change of what hides in a feature is logged with
//! no place: the feature may be elsewhere by the time that others see it. Of a feature that is deleted, `change`
//! has the slot, too: what is not seen is not missed, so it concerns nothing but cells that see it.

use super::tables::{has_pages, opened, relation};
use crate::direct_call::direct_function;
use crate::error::Refusal;
use crate::scene::{quoted, wish_refresh};
use crate::snapshot_read::{Moment, Statement};
use crate::types::Box3d;
use pgrx::pg_sys::{self, Datum, Oid};
use pgrx::{FromDatum, IntoDatum, PgSqlErrorCode};
use std::cell::{Cell, RefCell};
use std::collections::HashMap;
use std::ffi::{CStr, c_void};

/// Features that a transaction remembers to have logged. It forgets them all when there are more, and
/// may then log one again.
const MOST_REMEMBERED: usize = 100_000;

/// Places that are remembered of one feature.
const MOST_PLACES: usize = 4;

direct_function! {
    /// The trigger.
    fn log_edit(call: pg_sys::FunctionCallInfo) -> *mut pg_sys::HeapTupleData {
        let event = Event::of(call);
        event.log();
        event.result()
    }
}

/// What the trigger is told.
struct Event {
    data: *mut pg_sys::TriggerData,
    operation: u32,
}

impl Event {
    fn of(call: pg_sys::FunctionCallInfo) -> Self {
        // SAFETY: the context of a call, if any, is a node that says its kind.
        let data = unsafe {
            let context = (*call).context;
            let is_trigger =
                !context.is_null() && (*context).type_ == pg_sys::NodeTag::T_TriggerData;
            is_trigger.then_some(context.cast::<pg_sys::TriggerData>())
        };
        let Some(data) = data else {
            Refusal::new(
                PgSqlErrorCode::ERRCODE_FEATURE_NOT_SUPPORTED,
                "log_edit can only be called as a trigger",
            )
            .raise()
        };
        // SAFETY: a trigger's data is alive while it runs.
        let operation = unsafe { (*data).tg_event } & pg_sys::TRIGGER_EVENT_OPMASK;
        Self { data, operation }
    }

    fn log(&self) {
        for log in Log::of(self.relation(), self.is_of(c"street")) {
            self.write(&log);
        }
    }

    fn write(&self, log: &Log) {
        if self.operation == pg_sys::TRIGGER_EVENT_TRUNCATE {
            log.drop_derived();
            return;
        }
        // SAFETY: a row trigger has the row, and an update the new one.
        let (row, new) = unsafe { ((*self.data).tg_trigtuple, (*self.data).tg_newtuple) };
        let rows = match self.operation {
            pg_sys::TRIGGER_EVENT_UPDATE => [Some(row), Some(new)],
            _ => [Some(row), None],
        };
        let rows = rows.into_iter().flatten();
        if self.is_of(c"street") {
            let places = rows.filter_map(|row| self.value::<Box3d>(row, c"envelope"));
            places.for_each(|place| log.add_street(&place));
        } else if self.is_of(c"feature") {
            if self.operation == pg_sys::TRIGGER_EVENT_UPDATE
                && self.keeps_feature(row, new)
                && (log.kind == Kind::Tiles || self.keeps_slot(row, new))
            {
                return;
            }
            // Before the fact it is not known whether it comes to be.
            let is_all_ours = self.is_after() && self.operation != pg_sys::TRIGGER_EVENT_UPDATE;
            for row in rows {
                let id: Option<i64> = self.value(row, c"id");
                let place = self.value::<Box3d>(row, c"envelope");
                let is_removal =
                    log.kind == Kind::Cells && self.operation == pg_sys::TRIGGER_EVENT_DELETE;
                let slot = is_removal.then(|| self.value(row, c"slot")).flatten();
                if let Some((id, place)) = id.zip(place) {
                    log.add_place(id, &place, slot, is_all_ours);
                }
            }
        } else {
            for row in rows {
                if let Some(id) = self.value(row, c"feature") {
                    log.add_anywhere(id);
                }
            }
        }
    }

    /// What the trigger returns: the row that goes on, which after the fact is nobody's business.
    fn result(&self) -> *mut pg_sys::HeapTupleData {
        // SAFETY: as in `log`; a statement trigger has no row.
        unsafe {
            match self.operation {
                pg_sys::TRIGGER_EVENT_TRUNCATE => std::ptr::null_mut(),
                pg_sys::TRIGGER_EVENT_UPDATE => (*self.data).tg_newtuple,
                _ => (*self.data).tg_trigtuple,
            }
        }
    }

    fn is_after(&self) -> bool {
        // SAFETY: a trigger's data is alive while it runs.
        let event = unsafe { (*self.data).tg_event };
        event & pg_sys::TRIGGER_EVENT_TIMINGMASK == pg_sys::TRIGGER_EVENT_AFTER
    }

    fn relation(&self) -> pg_sys::Relation {
        // SAFETY: a trigger's data is alive while it runs.
        unsafe { (*self.data).tg_relation }
    }

    /// Whether the table is the one of this name.
    fn is_of(&self, table: &CStr) -> bool {
        // SAFETY: the relation is open while its trigger runs; its name ends with a zero.
        unsafe {
            let name = &(*(*self.relation()).rd_rel).relname;
            CStr::from_ptr(name.data.as_ptr()) == table
        }
    }

    /// Whether an update leaves all that tiles hold of a feature as it is.
    fn keeps_feature(&self, old: pg_sys::HeapTuple, new: pg_sys::HeapTuple) -> bool {
        let held = |row| {
            (
                self.value::<i64>(row, c"id"),
                self.value::<Box3d>(row, c"envelope").map(bits),
                self.bytes(row, c"class", pg_sys::TEXTOID),
                self.bytes(row, c"outline", pg_sys::POLYGONOID),
            )
        };
        held(old) == held(new)
    }

    /// Whether an update leaves a slot that was given: sets of view cells name features by it.
    fn keeps_slot(&self, old: pg_sys::HeapTuple, new: pg_sys::HeapTuple) -> bool {
        let slot = |row| self.value::<i32>(row, c"slot");
        slot(old).is_none() || slot(old) == slot(new)
    }

    /// The value of a column; `None` if it is null, or there is no such column of that type.
    fn value<T: FromDatum + IntoDatum>(&self, row: pg_sys::HeapTuple, column: &CStr) -> Option<T> {
        let (datum, is_null) = self.datum(row, column, T::type_oid())?;
        // SAFETY: the column is of that type.
        unsafe { T::from_polymorphic_datum(datum, is_null, pg_sys::InvalidOid) }
    }

    /// The bytes of a value of variable length, packed as they are.
    fn bytes(&self, row: pg_sys::HeapTuple, column: &CStr, type_oid: Oid) -> Option<Vec<u8>> {
        let (datum, is_null) = self.datum(row, column, type_oid)?;
        if is_null {
            return None;
        }
        // SAFETY: such a value begins with its length.
        unsafe {
            let value = datum.cast_mut_ptr::<pg_sys::varlena>();
            let length = pgrx::varsize_any(value);
            Some(std::slice::from_raw_parts(value.cast::<u8>(), length).to_vec())
        }
    }

    fn datum(&self, row: pg_sys::HeapTuple, column: &CStr, type_oid: Oid) -> Option<(Datum, bool)> {
        // SAFETY: the row is one of the relation, which is open while its trigger runs.
        unsafe {
            let columns = (*self.relation()).rd_att;
            let number = pg_sys::SPI_fnumber(columns, column.as_ptr());
            if number <= 0 || pg_sys::SPI_gettypeid(columns, number) != type_oid {
                return None;
            }
            let mut is_null = false;
            let datum = pg_sys::SPI_getbinval(row, columns, number, &raw mut is_null);
            Some((datum, is_null))
        }
    }
}

/// A log of a scene.
struct Log {
    scene: String,
    kind: Kind,
    table: Oid,
    namespace: Oid,
}

/// For whom edits are logged.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Kind {
    /// For tiles, in `edit`.
    Tiles,
    /// For view cells, in `change`.
    Cells,
}

impl Kind {
    /// The log.
    fn log(self) -> &'static CStr {
        match self {
            Self::Tiles => c"edit",
            Self::Cells => c"change",
        }
    }

    /// What is derived: as long as none of these tables has had a row, nobody reads the log.
    fn derived(self) -> &'static [&'static CStr] {
        match self {
            Self::Tiles => &[c"tile"],
            Self::Cells => &[c"view_cell_block", c"view_cell"],
        }
    }
}

impl Log {
    /// Those of the scene of a table; none where no tiles were ever packed and no cells computed, and in a
    /// schema that is no scene, where a part of a scene's table may be: what is derived is not relied on
    /// then.
    fn of(table: pg_sys::Relation, is_street: bool) -> impl Iterator<Item = Self> {
        // SAFETY: the relation is open while its trigger runs.
        let namespace = unsafe { (*(*table).rd_rel).relnamespace };
        let kinds = [Kind::Tiles, Kind::Cells].into_iter();
        kinds.filter_map(move |kind| {
            let table = relation(namespace, kind.log());
            let has_rows = |name: &&CStr| {
                let derived = relation(namespace, name);
                derived != pg_sys::InvalidOid && has_pages(derived)
            };
            let is_read = table != pg_sys::InvalidOid && kind.derived().iter().any(has_rows);
            if !is_read || (kind == Kind::Tiles && is_street) {
                return None;
            }
            // SAFETY: the schema of an open relation has a name.
            let scene = unsafe { CStr::from_ptr(pg_sys::get_namespace_name(namespace)) };
            Some(Self {
                scene: scene.to_string_lossy().into_owned(),
                kind,
                table,
                namespace,
            })
        })
    }

    /// That a feature was, or is, in a place. `slot`: it is gone, and nothing is concerned but cells that
    /// hold this. `is_all_ours`: it was made or deleted, and what hides in it is no longer, or not yet,
    /// anybody else's.
    fn add_place(&self, feature: i64, place: &Box3d, slot: Option<i32>, is_all_ours: bool) {
        if remember(self.table, feature, Some((bits(*place), slot)), is_all_ours) {
            return;
        }
        let arguments = [feature.into_datum(), place.into_datum(), slot.into_datum()];
        match slot {
            Some(_) => self.write(Write::Removal, &arguments),
            None => self.write(Write::Place, &arguments),
        }
    }

    /// That what hides in a feature was changed, wherever it is.
    fn add_anywhere(&self, feature: i64) {
        if !remember(self.table, feature, None, false) {
            self.write(Write::Anywhere, &[feature.into_datum()]);
        }
    }

    /// That a street was, or is, in a place.
    fn add_street(&self, place: &Box3d) {
        self.write(Write::Street, &[place.into_datum()]);
    }

    /// That all may have gone.
    fn drop_derived(&self) {
        self.write(Write::Truncate, &[]);
        forget();
    }

    /// Writes as the log's owner, so that nobody who may edit can do so without a trace.
    fn write(&self, write: Write, arguments: &[Option<Datum>]) {
        let arguments: Vec<Datum> = arguments.iter().copied().flatten().collect();
        wish_refresh(self.namespace);
        as_owner_of(self.table, || {
            with_statement(self, write, |statement| {
                statement.read(Moment::Now, &arguments, |_| {});
            });
        });
    }
}

#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Write {
    Place,
    Removal,
    Anywhere,
    Street,
    Truncate,
}

impl Write {
    fn statement(self, scene: &str, kind: Kind) -> Statement {
        let scene = quoted(scene);
        let log = match kind {
            Kind::Tiles => format!("{scene}.edit"),
            Kind::Cells => format!("{scene}.change"),
        };
        match self {
            Self::Place => Statement::new(
                &format!("INSERT INTO {log} (feature, place) VALUES ($1, $2)"),
                &[pg_sys::INT8OID, Box3d::type_oid()],
            ),
            Self::Removal => Statement::new(
                &format!("INSERT INTO {log} (feature, place, slot) VALUES ($1, $2, $3)"),
                &[pg_sys::INT8OID, Box3d::type_oid(), pg_sys::INT4OID],
            ),
            Self::Anywhere => Statement::new(
                &format!("INSERT INTO {log} (feature) VALUES ($1)"),
                &[pg_sys::INT8OID],
            ),
            Self::Street => Statement::new(
                &format!("INSERT INTO {log} (place) VALUES ($1)"),
                &[Box3d::type_oid()],
            ),
            Self::Truncate => {
                let derived = match kind {
                    Kind::Tiles => format!("{scene}.tile"),
                    Kind::Cells => format!("{scene}.view_cell, {scene}.view_cell_block"),
                };
                Statement::new(&format!("TRUNCATE {derived}, {log}"), &[])
            }
        }
    }
}

type Statements = HashMap<(String, Oid, Write), Statement>;

thread_local! {
    /// Planned once a backend; by the log's own number, since another scene may take its name.
    static STATEMENTS: RefCell<Statements> = RefCell::new(HashMap::new());
    static LOGGED: RefCell<HashMap<(Oid, i64), Logged>> = RefCell::new(HashMap::new());
    static IS_TOLD: Cell<bool> = const { Cell::new(false) };
}

fn with_statement(log: &Log, write: Write, run: impl FnOnce(&Statement)) {
    let key = (log.scene.clone(), log.table, write);
    // Taken out while it runs: a trigger on the log may edit, too.
    let kept = STATEMENTS.with_borrow_mut(|statements| statements.remove(&key));
    let statement = kept.unwrap_or_else(|| write.statement(&log.scene, log.kind));
    run(&statement);
    let old = STATEMENTS.with_borrow_mut(|statements| statements.insert(key, statement));
    old.into_iter().for_each(Statement::free);
}

/// Runs `work` with the rights of a table's owner, row security aside, as core does for foreign keys.
fn as_owner_of(table: Oid, work: impl FnOnce()) {
    let (mut user, mut context) = (pg_sys::InvalidOid, 0);
    let rights = pg_sys::SECURITY_LOCAL_USERID_CHANGE | pg_sys::SECURITY_NOFORCE_RLS;
    // SAFETY: an error on the way ends the transaction, which puts the user back itself.
    unsafe {
        pg_sys::GetUserIdAndSecContext(&raw mut user, &raw mut context);
        pg_sys::SetUserIdAndSecContext(owner(table), context | rights.cast_signed());
        work();
        pg_sys::SetUserIdAndSecContext(user, context);
    }
}

fn owner(table: Oid) -> Oid {
    // SAFETY: the table is open.
    opened(table, |table| unsafe { (*table.rd_rel).relowner })
}

fn bits(place: Box3d) -> [u64; 6] {
    let [a, b] = [place.0.min, place.0.max].map(|corner| corner.to_array().map(f64::to_bits));
    [a[0], a[1], a[2], b[0], b[1], b[2]]
}

/// A place, and the slot of the cells that are concerned if these are not all.
type Place = ([u64; 6], Option<i32>);

/// What this transaction has logged of a feature.
#[derive(Default)]
struct Logged {
    places: Vec<Place>,
    anywhere: bool,
    is_all_ours: bool,
}

/// Remembers an entry of the log, `place` if it has one; returns whether one that says as much is there.
fn remember(edit: Oid, feature: i64, place: Option<Place>, is_all_ours: bool) -> bool {
    forget_in_time();
    LOGGED.with_borrow_mut(|all| {
        if all.len() >= MOST_REMEMBERED {
            all.clear();
        }
        let logged = all.entry((edit, feature)).or_default();
        logged.is_all_ours |= is_all_ours;
        match place {
            None if logged.is_all_ours => true,
            None => std::mem::replace(&mut logged.anywhere, true),
            Some(place @ (bounds, _))
                if logged.places.contains(&place) || logged.places.contains(&(bounds, None)) =>
            {
                true
            }
            Some(place) => {
                if logged.places.len() < MOST_PLACES {
                    logged.places.push(place);
                }
                false
            }
        }
    })
}

/// Forgets what was logged: it is gone from the log, or may be.
pub fn forget() {
    LOGGED.with_borrow_mut(HashMap::clear);
}

/// Sees to it that the end of a transaction, and of a part of one that failed, makes it forget.
fn forget_in_time() {
    if IS_TOLD.replace(true) {
        return;
    }
    // SAFETY: both functions stay where they are, as the library does.
    unsafe {
        pg_sys::RegisterXactCallback(Some(transaction_ends), std::ptr::null_mut());
        pg_sys::RegisterSubXactCallback(Some(subtransaction_ends), std::ptr::null_mut());
    }
}

unsafe extern "C-unwind" fn transaction_ends(_: pg_sys::XactEvent::Type, _: *mut c_void) {
    forget();
}

unsafe extern "C-unwind" fn subtransaction_ends(
    event: pg_sys::SubXactEvent::Type,
    _: pg_sys::SubTransactionId,
    _: pg_sys::SubTransactionId,
    _: *mut c_void,
) {
    if event == pg_sys::SubXactEvent::SUBXACT_EVENT_ABORT_SUB {
        forget();
    }
}
