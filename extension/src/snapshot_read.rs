//! [`Statement`], a query under the snapshot of the statement that calls.
//!
//! pgrx runs queries as read-write once the transaction has an id. Each of them then sees what has
//! been committed, or done by the calling statement itself, since the one before. A function that
//! asks several times needs one view of the tables for all: that of its caller.

use crate::error::Refusal;
use pgrx::datum::DatumWithOid;
use pgrx::{FromDatum, IntoDatum, PgMemoryContexts, PgSqlErrorCode, Spi, pg_sys};
use std::ffi::{CString, c_char};
use std::marker::PhantomData;

/// Queries within one call; what they return is copied out before it ends.
pub struct Reader<'call>(PhantomData<&'call ()>);

/// A query that is planned once for all its runs.
pub struct Statement<'call> {
    plan: pg_sys::SPIPlanPtr,
    reader: PhantomData<&'call ()>,
}

/// A row of a result.
pub struct Row {
    tuple: pg_sys::HeapTuple,
    columns: pg_sys::TupleDesc,
}

/// Lets `work` read the tables as the calling statement sees them.
pub fn read<R>(work: impl for<'call> FnOnce(&Reader<'call>) -> R) -> R {
    Spi::connect(|_| work(&Reader(PhantomData)))
}

impl<'call> Reader<'call> {
    /// A query whose parameters have the types given.
    pub fn statement(&self, query: &str, types: &[pg_sys::Oid]) -> Statement<'call> {
        let mut types = types.to_vec();
        let query = CString::new(query).unwrap_or_else(|_| failed("query holds a zero byte"));
        // SAFETY: inside an SPI connection; text and types are valid and as many as said.
        let plan =
            unsafe { pg_sys::SPI_prepare(query.as_ptr(), count(types.len()), types.as_mut_ptr()) };
        if plan.is_null() {
            failed("query could not be prepared");
        }
        Statement {
            plan,
            reader: PhantomData,
        }
    }
}

impl Statement<'_> {
    /// Runs it, and makes something of each row that needs no memory of PostgreSQL's; at most `limit`
    /// rows, all if that is 0.
    pub fn rows<T>(
        &self,
        arguments: &[DatumWithOid],
        limit: usize,
        make: impl Fn(&Row) -> T,
    ) -> Vec<T> {
        let mut values: Vec<pg_sys::Datum> = Vec::with_capacity(arguments.len());
        let mut nulls: Vec<c_char> = Vec::with_capacity(arguments.len());
        for argument in arguments {
            let datum = argument.datum();
            nulls.push(if datum.is_some() { b' ' } else { b'n' } as c_char);
            values.push(datum.map_or(pg_sys::Datum::null(), |datum| datum.sans_lifetime()));
        }
        // SAFETY: the plan is of the open connection, and there is a value and a flag for each of its
        // parameters, or it raises an error. The table of rows is freed after the last use.
        unsafe {
            if pg_sys::SPI_getargcount(self.plan) != count(arguments.len()) {
                failed("wrong number of arguments");
            }
            let read_only = true;
            let code = pg_sys::SPI_execute_plan(
                self.plan,
                values.as_mut_ptr(),
                nulls.as_ptr(),
                read_only,
                limit.try_into().unwrap_or(0),
            );
            let Some(table) = pg_sys::SPI_tuptable.as_ref() else {
                failed(&format!("query gave no rows: {code}"));
            };
            let number = usize::try_from(pg_sys::SPI_processed).unwrap_or(0);
            let row = |row: usize| Row {
                tuple: *table.vals.add(row),
                columns: table.tupdesc,
            };
            // What rows are unpacked into goes with it.
            let made = PgMemoryContexts::new("rows of pg_occlusion")
                .switch_to(|_| (0..number).map(|number| make(&row(number))).collect());
            pg_sys::SPI_freetuptable(pg_sys::SPI_tuptable);
            made
        }
    }
}

impl Row {
    /// A column, counted from 1; `None` if it is null.
    pub fn get<T: FromDatum + IntoDatum>(&self, column: i32) -> Option<T> {
        let mut is_null = true;
        // SAFETY: row and descriptor are of one table that is still there; the datum is of the type
        // that its descriptor says, against which the wanted one is checked.
        let value = unsafe {
            let found = pg_sys::SPI_gettypeid(self.columns, column);
            let datum = pg_sys::SPI_getbinval(self.tuple, self.columns, column, &raw mut is_null);
            T::try_from_datum(datum, is_null, found)
        };
        value.unwrap_or_else(|error| failed(&format!("column {column}: {error}")))
    }
}

/// A count as SPI has it.
fn count(number: usize) -> i32 {
    i32::try_from(number).unwrap_or(i32::MAX)
}

fn failed(reason: &str) -> ! {
    Refusal::new(PgSqlErrorCode::ERRCODE_INTERNAL_ERROR, reason).raise()
}
