//! Procedures on scenes: they read tables by SPI, let `engine` compute, and write rows back.

mod auto_refresh;
mod city;
mod fill;
mod ground;
mod job;
mod occlusion_volumes;
pub mod polygon;
mod procedure;
mod repair;
mod snapshot;
mod solids;
mod squares;
mod streets;
mod view_cells;
mod view_region;
mod workers;

pub use auto_refresh::wish as wish_refresh;
pub use ground::settle;
pub use streets::near as near_streets;
pub use workers::Workers;

use crate::error::Refusal;
use pgrx::datum::DatumWithOid;
use pgrx::{FromDatum, IntoDatum, PgSqlErrorCode, Spi};

/// Raises an error unless `scene` is a scene of real tables.
pub fn require(scene: &str) {
    let query = "SELECT true FROM occlusion.require_scene($1)";
    read_one::<bool>(query, &[scene.into()]);
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

/// The one value of a query that only reads: others take a transaction number, which a standby has none of.
pub fn read_one<T: FromDatum + IntoDatum>(query: &str, arguments: &[DatumWithOid]) -> Option<T> {
    let value = Spi::connect(|client| {
        client
            .select(query, None, arguments)?
            .first()
            .get_one::<T>()
    });
    value.unwrap_or_else(|error| failed(&error))
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
