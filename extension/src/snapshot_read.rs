//! [`Statement`], a query that is planned once, and read under the snapshot of the query around it.
//!
//! `pgrx`'s own [`pgrx::Spi`] takes a new snapshot for each statement once a transaction has written
//! anything. What a query pieces together of several statements must be of one moment.

use pgrx::pg_sys::{self, Datum};
use pgrx::{FromDatum, IntoDatum, PgSqlErrorCode};
use std::ffi::CString;

use crate::error::Refusal;

/// Which rows a statement sees.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Moment {
    /// Those that the query around it sees.
    Query,
    /// Those that are committed now, and the transaction's own. Statements that write see these.
    Now,
}

/// A planned statement. It lives until [`Statement::free`]: a backend that ends must not run
/// destructors that call into it.
#[derive(Debug)]
pub struct Statement(pg_sys::SPIPlanPtr);

impl Statement {
    /// Plans a statement with parameters of these types.
    pub fn new(text: &str, types: &[pg_sys::Oid]) -> Self {
        let Ok(text) = CString::new(text) else {
            unreachable!("names in SQL hold no zero byte")
        };
        let count = int(types.len());
        let mut types = types.to_vec();
        connected(|| {
            // SAFETY: inside an SPI connection; the text and the types outlive the call, and the plan
            // is moved out of the connection's memory.
            unsafe {
                let plan = pg_sys::SPI_prepare(text.as_ptr(), count, types.as_mut_ptr());
                if plan.is_null() || pg_sys::SPI_keepplan(plan) != 0 {
                    failed("prepare", pg_sys::SPI_result);
                }
                Self(plan)
            }
        })
    }

    /// Runs it, and gives each row to `row`. The arguments are of the types that it was planned with,
    /// none of them null.
    pub fn read(&self, moment: Moment, arguments: &[Datum], row: impl FnMut(&Row)) {
        self.read_some(moment, arguments, 0, row);
    }

    /// The same, up to so many rows; all if that is 0.
    pub fn read_some(
        &self,
        moment: Moment,
        arguments: &[Datum],
        most: std::ffi::c_long,
        mut row: impl FnMut(&Row),
    ) {
        let mut arguments = arguments.to_vec();
        connected(|| {
            // SAFETY: inside an SPI connection; the plan is alive until `free` takes it. The result's
            // rows are alive until the connection ends.
            unsafe {
                let status = pg_sys::SPI_execute_plan(
                    self.0,
                    arguments.as_mut_ptr(),
                    std::ptr::null(),
                    moment == Moment::Query,
                    most,
                );
                if status < 0 {
                    failed("execute", status);
                }
                let table = pg_sys::SPI_tuptable;
                if table.is_null() {
                    return;
                }
                let count = usize::try_from(pg_sys::SPI_processed).unwrap_or(0);
                let (rows, columns) = ((*table).vals, (*table).tupdesc);
                for at in 0..count {
                    row(&Row {
                        tuple: *rows.add(at),
                        columns,
                    });
                }
            }
        });
    }

    /// Forgets it.
    pub fn free(self) {
        // SAFETY: the plan was kept, and nobody else has it.
        unsafe { pg_sys::SPI_freeplan(self.0) };
    }
}

/// A row of a result.
pub struct Row {
    tuple: pg_sys::HeapTuple,
    columns: pg_sys::TupleDesc,
}

impl Row {
    /// The value in a column, counted from 1; `None` if it is null. What it borrows must not outlive the
    /// row.
    pub fn get<T: FromDatum>(&self, column: i32) -> Option<T> {
        let (datum, is_null) = self.datum(column);
        // SAFETY: the statement casts its columns to the types that are asked for.
        unsafe { T::from_polymorphic_datum(datum, is_null, pg_sys::InvalidOid) }
    }

    /// The datum in a column, counted from 1, and whether it is null.
    pub fn datum(&self, column: i32) -> (Datum, bool) {
        let mut is_null = false;
        // SAFETY: the row is alive, as its connection is.
        let datum =
            unsafe { pg_sys::SPI_getbinval(self.tuple, self.columns, column, &raw mut is_null) };
        (datum, is_null)
    }
}

/// The one argument of a statement.
pub fn argument(value: impl IntoDatum) -> Vec<Datum> {
    value.into_datum().into_iter().collect()
}

/// Whether each statement of the transaction sees what is committed by then.
pub fn sees_the_latest() -> bool {
    // SAFETY: a variable of the backend.
    let level = unsafe { pg_sys::XactIsoLevel };
    level < pg_sys::XACT_REPEATABLE_READ.cast_signed()
}

/// Runs `work` in an SPI connection of its own.
fn connected<T>(work: impl FnOnce() -> T) -> T {
    // SAFETY: runs on the backend's main thread. An error unwinds past `SPI_finish`, and PostgreSQL
    // closes the connection when it ends the transaction.
    unsafe {
        pg_sys::SPI_connect();
        let result = work();
        pg_sys::SPI_finish();
        result
    }
}

fn int(count: usize) -> i32 {
    i32::try_from(count).unwrap_or(i32::MAX)
}

fn failed(what: &str, status: i32) -> ! {
    Refusal::new(
        PgSqlErrorCode::ERRCODE_INTERNAL_ERROR,
        format!("could not {what} a statement of pg_occlusion: {status}"),
    )
    .raise()
}
