//! The PostgreSQL extension `pg_occlusion`: types, their operators and index support, and the
//! procedures on scenes, each a thin layer over the crate `engine`. The SQL that declares it all
//! is written by hand in `sql/`; a function `f` here is the symbol `f_wrapper` there.

mod direct_call;
mod error;
mod field_of_view;
mod import;
mod index;
mod models;
mod planner;
mod scene;
mod settings;
mod shared;
mod snapshot_read;
mod toasted;
mod types;
mod visibility;

pgrx::pg_module_magic!();

/// Runs when a backend loads the library.
#[pgrx::pg_guard]
pub extern "C-unwind" fn _PG_init() {
    settings::register();
}
