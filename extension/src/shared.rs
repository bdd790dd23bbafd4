//! What all backends of a server share about each scene: how it was asked, and whether a refresh is on its way.
//!
//! The memory comes from what the server has to spare, so nothing needs to be preloaded. It is lost when the server
//! stops. Where there is none, nothing is counted.

use pgrx::pg_sys::{self, Oid};
use pgrx::prelude::PgTryBuilder;
use std::cell::{Cell, OnceCell};
use std::sync::atomic::{AtomicI64, AtomicU64, Ordering};

/// Scenes of a server that have a place.
const PLACES: usize = 128;

/// What the creator writes when the memory is empty.
const READY: u64 = 0x0cc1_0510_0000_0001;

/// What is counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Count {
    /// Answers of `visible_features`, and what rests on it, from tiles and tables.
    Live,
    /// Those from the view cell of the eye.
    ByCell,
    /// Of both, those from which occlusion volumes left something out.
    ByVolumes,
    /// Features that were returned.
    Features,
    /// Visible sets that were returned.
    Sets,
    /// Those that were asked for where no view cell was right.
    SetsMissing,
}

/// How many kinds there are.
pub const COUNTS: usize = Count::SetsMissing as usize + 1;

/// The memory.
#[repr(C)]
struct Shared {
    ready: AtomicU64,
    places: [Place; PLACES],
}

/// What is shared about one scene.
#[repr(C)]
pub struct Place {
    /// Its database and its schema; 0 if it is free.
    key: AtomicU64,
    counts: [AtomicU64; COUNTS],
    /// When a worker was called that has not begun yet, microseconds; 0 if none was.
    called: AtomicI64,
}

thread_local! {
    static SHARED: OnceCell<Option<&'static Shared>> = const { OnceCell::new() };
    /// That of the last scene.
    static LAST: Cell<Option<(Oid, &'static Place)>> = const { Cell::new(None) };
}

impl Place {
    /// That of a scene of this database; `None` where there is no room for it.
    pub fn of(namespace: Oid) -> Option<&'static Self> {
        if let Some((last, place)) = LAST.get()
            && last == namespace
        {
            return Some(place);
        }
        let key = key(namespace);
        let places = &shared()?.places;
        let first = (key % PLACES as u64) as usize;
        let mut found = (0..PLACES).map(|step| &places[(first + step) % PLACES]);
        let place =
            found.find(|place| place.key.load(Ordering::Relaxed) == key || place.take(key))?;
        LAST.set(Some((namespace, place)));
        Some(place)
    }

    /// Takes a place if it is free, or another backend has just taken it for the same scene.
    fn take(&self, key: u64) -> bool {
        let taken = self
            .key
            .compare_exchange(0, key, Ordering::Relaxed, Ordering::Relaxed);
        taken.is_ok() || taken == Err(key)
    }

    /// Adds to a count.
    pub fn add(&self, count: Count, more: usize) {
        self.counts[count as usize].fetch_add(more as u64, Ordering::Relaxed);
    }

    /// Sets the time at which a worker is called. Returns whether that is to be done: not if one was called and has
    /// not begun, unless it must have failed, since that was more than `patience` microseconds ago.
    pub fn call(&self, now: i64, patience: i64) -> bool {
        let before = self.called.load(Ordering::SeqCst);
        let is_due = before == 0 || now - before > patience;
        let exchange = |from| {
            self.called
                .compare_exchange(from, now, Ordering::SeqCst, Ordering::SeqCst)
        };
        is_due && exchange(before).is_ok()
    }

    /// That the worker is still there, and has not begun.
    pub fn is_waiting(&self, now: i64) {
        self.called.store(now, Ordering::SeqCst);
    }

    /// That the worker begins, or there is none: whoever edits from now on calls another one.
    pub fn begins(&self) {
        self.called.store(0, Ordering::SeqCst);
    }

    fn counts(&self) -> [i64; COUNTS] {
        std::array::from_fn(|at| self.counts[at].load(Ordering::Relaxed).cast_signed())
    }
}

/// The scenes of this database that were asked, and what was counted.
pub fn counted() -> Vec<(Oid, [i64; COUNTS])> {
    let places = shared().map_or(&[][..], |shared| &shared.places);
    let counted = places.iter().filter_map(|place| {
        let key = place.key.load(Ordering::Relaxed);
        let namespace = Oid::from(key as u32);
        (key != 0 && key == self::key(namespace)).then(|| (namespace, place.counts()))
    });
    counted.collect()
}

/// Begins to count anew for all scenes of this database.
pub fn reset() {
    let places = shared().map_or(&[][..], |shared| &shared.places);
    for place in places {
        let key = place.key.load(Ordering::Relaxed);
        if key == self::key(Oid::from(key as u32)) {
            for count in &place.counts {
                count.store(0, Ordering::Relaxed);
            }
        }
    }
}

fn key(namespace: Oid) -> u64 {
    // SAFETY: set once, when the backend connects.
    let database = unsafe { pg_sys::MyDatabaseId };
    u64::from(database.to_u32()) << 32 | u64::from(namespace.to_u32())
}

fn shared() -> Option<&'static Shared> {
    let attach = || {
        // An error says that there is no memory left; a query does not fail for that.
        PgTryBuilder::new(attach).catch_others(|_| None).execute()
    };
    SHARED.with(|shared| *shared.get_or_init(attach))
}

/// Finds the memory, or takes it.
fn attach() -> Option<&'static Shared> {
    let mut is_found = false;
    // SAFETY: the memory is as large as was asked for, stays as long as the server, and is aligned for any type.
    // Atomic numbers are valid whatever bytes they have; all are 0 before anybody reads one, since the creator says
    // when it is ready.
    unsafe {
        let memory = pg_sys::ShmemInitStruct(
            c"pg_occlusion scenes".as_ptr(),
            size_of::<Shared>() as _,
            &raw mut is_found,
        )
        .cast::<Shared>();
        if !is_found {
            std::ptr::write_bytes(memory, 0, 1);
            (*memory).ready.store(READY, Ordering::Release);
        }
        let shared = &*memory;
        (shared.ready.load(Ordering::Acquire) == READY).then_some(shared)
    }
}
