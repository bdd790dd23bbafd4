//! Procedures on scenes: they read tables by SPI, let `engine` compute, and write rows back.

mod city;
mod ground;
mod job;
mod occlusion_volumes;
pub mod polygon;
mod procedure;
mod snapshot;
mod solids;
mod streets;
mod view_cells;
mod view_region;
mod workers;

pub use ground::settle;
pub use workers::Workers;

use crate::error::Refusal;
use pgrx::datum::DatumWithOid;
use pgrx::{PgSqlErrorCode, Spi};

/// Raises an error unless `scene` is a scene of real tables.
pub fn require(scene: &str) {
    run("SELECT occlusion.require_scene($1)", &[scene.into()]);
}

/// An argument that must be given.
pub fn given<T>(argument: Option<T>, name: &str) -> T {
    argument.unwrap_or_else(|| {
        Refusal::new(
            PgSqlErrorCode::ERRCODE_NULL_VALUE_NOT_ALLOWED,
            format!("parameter {name} must not be null"),
        )
        .raise()
    })
}

/// Runs a statement whose result nobody needs.
pub fn run(statement: &str, arguments: &[DatumWithOid]) {
    if let Err(error) = Spi::run_with_args(statement, arguments) {
        failed(&error);
    }
}

/// A number of rows as SQL has it.
pub fn count(number: usize) -> i64 {
    i64::try_from(number).unwrap_or(i64::MAX)
}

/// A name quoted for SQL text.
pub fn quoted(name: &str) -> String {
    pgrx::spi::quote_identifier(name)
}

/// Raises an SPI failure that is not an SQL error of its own (those unwind by themselves).
pub fn failed(error: &pgrx::spi::Error) -> ! {
    Refusal::new(
        PgSqlErrorCode::ERRCODE_INTERNAL_ERROR,
        format!("query failed: {error}"),
    )
    .raise()
}
