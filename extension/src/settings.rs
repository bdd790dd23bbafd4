//! Settings, `pg_occlusion.*`.

use pgrx::{GucContext, GucFlags, GucRegistry, GucSetting};
use std::time::Duration;

/// Threads that one procedure may use; 0 for one a core.
pub static MAX_THREADS: GucSetting<i32> = GucSetting::<i32>::new(0);

/// Memory for the tiles that a backend keeps, kB.
static CACHE_SIZE: GucSetting<i32> = GucSetting::<i32>::new(64 * 1024);

/// Memory for what generate_view_cells keeps from one square to the next, kB.
static GENERATE_MEMORY: GucSetting<i32> = GucSetting::<i32>::new(256 * 1024);

/// Whether answers leave out what occlusion volumes hide, besides what live ones do.
static USE_VOLUMES: GucSetting<bool> = GucSetting::<bool>::new(true);

/// Whether answers look only at what may be seen from the view cell of the eye.
static USE_CELLS: GucSetting<bool> = GucSetting::<bool>::new(false);

/// Whether a background worker refreshes what edits put out of use.
static AUTO_REFRESH: GucSetting<bool> = GucSetting::<bool>::new(false);

/// How long it waits for more edits, milliseconds.
static REFRESH_DELAY: GucSetting<i32> = GucSetting::<i32>::new(1000);

/// Whether it is counted how each scene is asked.
static TRACK_SCENES: GucSetting<bool> = GucSetting::<bool>::new(true);

/// Longest delay, a day, milliseconds.
const LONGEST_DELAY: i32 = 24 * 60 * 60 * 1000;

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
    GucRegistry::define_int_guc(
        c"pg_occlusion.cache_size",
        c"Memory for the packed tiles that each backend keeps.",
        c"Those that were used last are kept. A query may need more while it runs.",
        &CACHE_SIZE,
        0,
        i32::MAX,
        GucContext::Userset,
        GucFlags::UNIT_KB,
    );
    GucRegistry::define_int_guc(
        c"pg_occlusion.generate_memory",
        c"Memory for what generate_view_cells keeps from one square of a scene to the next.",
        c"What is in range of one square is kept in any case while it is computed.",
        &GENERATE_MEMORY,
        0,
        i32::MAX,
        GucContext::Userset,
        GucFlags::UNIT_KB,
    );
    GucRegistry::define_bool_guc(
        c"pg_occlusion.use_volumes",
        c"Leaves out of answers what occlusion volumes hide, besides what is found live.",
        c"Where many volumes overlap, looking them up can take longer than all the rest.",
        &USE_VOLUMES,
        GucContext::Userset,
        GucFlags::default(),
    );
    GucRegistry::define_bool_guc(
        c"pg_occlusion.use_cells",
        c"Looks only at what may be seen from the view cell of the eye, where there is one.",
        c"It pays where eyes see far and several of them are in one cell.",
        &USE_CELLS,
        GucContext::Userset,
        GucFlags::default(),
    );
    GucRegistry::define_bool_guc(
        c"pg_occlusion.auto_refresh",
        c"Calls a background worker after edits, which does what refresh does.",
        c"It works as the owner of the scene, who must be allowed to log in.",
        &AUTO_REFRESH,
        GucContext::Suset,
        GucFlags::default(),
    );
    GucRegistry::define_int_guc(
        c"pg_occlusion.refresh_delay",
        c"How long that worker waits for more edits.",
        c"Whoever edits in this time calls no other one.",
        &REFRESH_DELAY,
        0,
        LONGEST_DELAY,
        GucContext::Suset,
        GucFlags::UNIT_MS,
    );
    GucRegistry::define_bool_guc(
        c"pg_occlusion.track_scenes",
        c"Counts how each scene is asked and answered.",
        c"What was counted is in the view stat_scenes.",
        &TRACK_SCENES,
        GucContext::Suset,
        GucFlags::default(),
    );
}

/// Whether answers leave out what occlusion volumes hide.
pub fn uses_volumes() -> bool {
    USE_VOLUMES.get()
}

/// Whether answers look only at what may be seen from the view cell of an eye.
pub fn uses_cells() -> bool {
    USE_CELLS.get()
}

/// Whether a background worker refreshes what edits put out of use.
pub fn refreshes_by_itself() -> bool {
    AUTO_REFRESH.get()
}

/// How long it waits for more edits.
pub fn refresh_delay() -> Duration {
    Duration::from_millis(REFRESH_DELAY.get().unsigned_abs().into())
}

/// Whether it is counted how each scene is asked.
pub fn tracks_scenes() -> bool {
    TRACK_SCENES.get()
}

/// Bytes of the tiles that a backend keeps.
pub fn cache_bytes() -> usize {
    usize::try_from(CACHE_SIZE.get()).unwrap_or(0) * 1024
}

/// Bytes of what generate_view_cells keeps from one square to the next.
pub fn generate_bytes() -> usize {
    usize::try_from(GENERATE_MEMORY.get()).unwrap_or(0) * 1024
}
