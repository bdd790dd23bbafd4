//! Settings, `pg_occlusion.*`.

use pgrx::{GucContext, GucFlags, GucRegistry, GucSetting};

/// Threads that one procedure may use; 0 for one a core.
pub static MAX_THREADS: GucSetting<i32> = GucSetting::<i32>::new(0);

/// Most threads that can be asked for.
const MOST_THREADS: i32 = 1024;

/// Tells PostgreSQL about the settings, when the library is loaded.
pub fn register() {
    GucRegistry::define_int_guc(
        c"pg_occlusion.max_threads",
        c"Threads that one procedure of pg_occlusion may use.",
        c"0 means one thread for each core.",
        &MAX_THREADS,
        0,
        MOST_THREADS,
        GucContext::Userset,
        GucFlags::default(),
    );
}
