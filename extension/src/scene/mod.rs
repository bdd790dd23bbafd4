//! Procedures on scenes: they read tables by SPI, let `engine` compute, and write rows back.

mod city;
mod occlusion_volumes;
mod polygon;
mod procedure;
mod streets;
mod view_region;
mod workers;

use crate::error::Refusal;
use pgrx::{PgSqlErrorCode, Spi};

/// Raises an error unless `scene` is a scene of real tables.
fn require(scene: &str) {
    if let Err(error) = Spi::run_with_args("SELECT occlusion.require_scene($1)", &[scene.into()]) {
        failed(&error);
    }
}

/// A name quoted for SQL text.
fn quoted(name: &str) -> String {
    pgrx::spi::quote_identifier(name)
}

/// Raises an SPI failure that is not an SQL error of its own (those unwind by themselves).
fn failed(error: &pgrx::spi::Error) -> ! {
    Refusal::new(PgSqlErrorCode::ERRCODE_INTERNAL_ERROR, format!("query failed: {error}")).raise()
}
