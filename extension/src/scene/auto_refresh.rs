//! Refreshes that come by themselves: whoever commits edits calls a background worker, which waits a little for
//! more of them, and then does what `refresh` does.
//!
//! Nothing needs to be preloaded: the workers are dynamic ones, a scene has one at work and at most one that waits.
//! Whether one waits is shared by all backends ([`Place::call`]). It is said that it does before it is started, and
//! that it does not before it takes its first snapshot, so that an edit that it does not see calls another one.

use super::procedure::Procedure;
use super::{read_one, view_cells};
use crate::settings;
use crate::shared::Place;
use pgrx::bgworkers::{BackgroundWorker, BackgroundWorkerBuilder, BgWorkerStartTime};
use pgrx::pg_sys::{self, Oid};
use pgrx::{Spi, check_for_interrupts, pg_guard, warning};
use std::cell::{Cell, OnceCell, RefCell};
use std::collections::HashMap;
use std::ffi::{CStr, c_int, c_void};
use std::time::Duration;

/// How long a worker that was called may give no sign before another one is called.
const PATIENCE: Duration = Duration::from_secs(30);

/// How often a waiting worker gives a sign.
const SIGN: Duration = Duration::from_secs(1);

/// The first number of the advisory locks of workers at work; the second is that of the scene's schema.
const LOCKS: i32 = 0x0cc1_0510;

unsafe extern "C" {
    /// The server's handler of SIGTERM, as it is: what pgrx wraps around it is not for signals.
    fn die(signal: c_int);
}

thread_local! {
    /// Scenes that the transaction edited, with their owners.
    static WISHES: RefCell<HashMap<Oid, Oid>> = RefCell::new(HashMap::new());
    static IS_TOLD: Cell<bool> = const { Cell::new(false) };
    /// Where the server finds this library.
    static LIBRARY: OnceCell<String> = const { OnceCell::new() };
}

/// Takes down that a scene was edited, for the end of the transaction.
pub fn wish(namespace: Oid) {
    if !settings::refreshes_by_itself() {
        return;
    }
    if !IS_TOLD.replace(true) {
        // SAFETY: the function stays where it is, as the library does.
        unsafe { pg_sys::RegisterXactCallback(Some(transaction_ends), std::ptr::null_mut()) };
    }
    LIBRARY.with(|library| {
        library.get_or_init(library_name);
    });
    WISHES.with_borrow_mut(|wishes| {
        wishes.entry(namespace).or_insert_with(|| owner(namespace));
    });
}

/// As the functions name it that are in it.
fn library_name() -> String {
    let query = "SELECT p.probin FROM pg_catalog.pg_proc AS p \
                 WHERE p.oid OPERATOR(pg_catalog.=) 'occlusion.log_edit()'::pg_catalog.regprocedure";
    read_one::<String>(query, &[]).unwrap_or_else(|| "$libdir/pg_occlusion".to_owned())
}

/// The owner of a schema that is there.
fn owner(namespace: Oid) -> Oid {
    // SAFETY: looks the number up in the catalog.
    unsafe {
        pg_sys::GetSysCacheOid(
            pg_sys::SysCacheIdentifier::NAMESPACEOID as i32,
            pg_sys::Anum_pg_namespace_nspowner as pg_sys::AttrNumber,
            pg_sys::Datum::from(namespace),
            pg_sys::Datum::null(),
            pg_sys::Datum::null(),
            pg_sys::Datum::null(),
        )
    }
}

/// Of a prepared transaction the wishes wait for the next commit of the session, which is as a rule that of it.
unsafe extern "C-unwind" fn transaction_ends(event: pg_sys::XactEvent::Type, _: *mut c_void) {
    match event {
        pg_sys::XactEvent::XACT_EVENT_COMMIT => {
            for (namespace, owner) in WISHES.take() {
                call(namespace, owner);
            }
        }
        pg_sys::XactEvent::XACT_EVENT_ABORT => drop(WISHES.take()),
        _ => {}
    }
}

/// Calls a worker, unless one waits.
fn call(namespace: Oid, owner: Oid) {
    let Some(place) = Place::of(namespace) else {
        return;
    };
    let patience = settings::refresh_delay() + PATIENCE;
    if !place.call(now(), microseconds(patience)) {
        return;
    }
    let library = LIBRARY.with(|library| library.get().cloned().unwrap_or_default());
    // SAFETY: set once, when the backend connects.
    let database = unsafe { pg_sys::MyDatabaseId };
    let worker = BackgroundWorkerBuilder::new("pg_occlusion refresh")
        .set_type("pg_occlusion refresh")
        .set_library(&library)
        .set_function("pg_occlusion_refresh_main")
        .set_extra(&format!(
            "{} {} {}",
            database.to_u32(),
            owner.to_u32(),
            namespace.to_u32()
        ))
        .enable_spi_access()
        .set_start_time(BgWorkerStartTime::RecoveryFinished);
    if worker.load_dynamic().is_err() {
        place.begins();
        warning!(
            "no background worker is free to refresh a scene: max_worker_processes is too small"
        );
    }
}

/// A worker: refreshes one scene, once.
#[pg_guard]
#[unsafe(no_mangle)]
pub extern "C-unwind" fn pg_occlusion_refresh_main(_argument: pg_sys::Datum) {
    // SAFETY: the handler is the one that backends have; threads of its own do not run yet.
    unsafe {
        libc::signal(libc::SIGTERM, die as *const () as libc::sighandler_t);
        pg_sys::BackgroundWorkerUnblockSignals();
    }
    let mut numbers = BackgroundWorker::get_extra()
        .split(' ')
        .filter_map(|word| word.parse::<u32>().ok())
        .map(Oid::from);
    let (database, owner, namespace) = (numbers.next(), numbers.next(), numbers.next());
    BackgroundWorker::connect_worker_to_spi_by_oid(database, owner);
    if let Some(namespace) = namespace
        && let Some(place) = Place::of(namespace)
    {
        wait_for_others(namespace, place);
        show("waiting for more edits");
        rest(settings::refresh_delay(), place);
        place.begins();
        refresh(namespace);
    }
}

fn refresh(namespace: Oid) {
    let mut procedure = Procedure::of_worker();
    // The scene may have been dropped.
    if let Some(scene) = name(namespace) {
        show(&format!("refresh of scene \"{scene}\""));
        view_cells::bring_up_to_date(&scene, &mut procedure);
    }
    procedure.end();
}

fn name(namespace: Oid) -> Option<String> {
    // SAFETY: looks the number up in the catalog; a name ends with a zero.
    unsafe {
        let name = pg_sys::get_namespace_name(namespace);
        (!name.is_null()).then(|| CStr::from_ptr(name).to_string_lossy().into_owned())
    }
}

/// Says in `pg_stat_activity` what is done.
fn show(activity: &str) {
    if let Ok(text) = std::ffi::CString::new(activity) {
        // SAFETY: copies the text.
        unsafe {
            pg_sys::pgstat_report_activity(pg_sys::BackendState::STATE_RUNNING, text.as_ptr())
        };
    }
}

/// Waits until no other worker is at work on the scene. The lock goes with the process.
fn wait_for_others(namespace: Oid, place: &Place) {
    let locked = || {
        let procedure = Procedure::of_worker();
        let lock = "SELECT pg_catalog.pg_try_advisory_lock($1, $2)";
        let number = namespace.to_u32().cast_signed();
        let is_locked =
            Spi::get_one_with_args::<bool>(lock, &[LOCKS.into(), number.into()]) == Ok(Some(true));
        procedure.end();
        is_locked
    };
    show("waiting for another refresh");
    while !locked() {
        rest(SIGN, place);
    }
}

/// Sleeps, gives a sign now and then, and obeys a shutdown.
fn rest(time: Duration, place: &Place) {
    let end = now() + microseconds(time);
    loop {
        place.is_waiting(now());
        let left = end - now();
        if left <= 0 {
            return;
        }
        let nap = Duration::from_micros(left.unsigned_abs()).min(SIGN);
        let flags = pg_sys::WL_LATCH_SET | pg_sys::WL_TIMEOUT | pg_sys::WL_POSTMASTER_DEATH;
        // SAFETY: the latch is the process's own.
        let events = unsafe {
            let milliseconds = nap.as_millis().max(1) as std::ffi::c_long;
            let woken = pg_sys::WaitLatch(
                pg_sys::MyLatch,
                flags.cast_signed(),
                milliseconds,
                pg_sys::PG_WAIT_EXTENSION,
            );
            pg_sys::ResetLatch(pg_sys::MyLatch);
            woken.cast_unsigned()
        };
        check_for_interrupts!();
        if events & pg_sys::WL_POSTMASTER_DEATH != 0 {
            // SAFETY: ends the process in order.
            unsafe { pg_sys::proc_exit(1) };
        }
    }
}

fn now() -> i64 {
    // SAFETY: reads the clock.
    unsafe { pg_sys::GetCurrentTimestamp() }
}

fn microseconds(time: Duration) -> i64 {
    i64::try_from(time.as_micros()).unwrap_or(i64::MAX)
}
