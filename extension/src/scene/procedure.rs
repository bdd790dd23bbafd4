//! [`Procedure`], a CALL that commits as it goes.

use crate::error::Refusal;
use pgrx::{PgSqlErrorCode, pg_sys};

/// A running procedure that may commit. Its queries go through [`pgrx::Spi`] as usual.
pub struct Procedure;

impl Procedure {
    /// Begins; raises an error when the call is inside a transaction of the user's.
    pub fn begin(fcinfo: pg_sys::FunctionCallInfo, name: &str) -> Self {
        if is_atomic(fcinfo) {
            Refusal::new(
                PgSqlErrorCode::ERRCODE_INVALID_TRANSACTION_TERMINATION,
                format!("{name} cannot run inside a transaction"),
            )
            .detail("It commits batch by batch.")
            .hint("Call it by itself, outside BEGIN, functions and blocks with exception handlers.")
            .raise();
        }
        // SAFETY: runs on the backend's main thread; the connection is closed in `end`, or by
        // PostgreSQL itself when an error aborts the call.
        unsafe { pg_sys::SPI_connect_ext(pg_sys::SPI_OPT_NONATOMIC.cast_signed()) };
        Self
    }

    /// Makes all that was written so far permanent, and begins the next transaction.
    pub fn commit(&mut self) {
        // SAFETY: the innermost SPI connection is ours and not atomic.
        unsafe { pg_sys::SPI_commit() };
    }

    /// Ends in order. Not a `Drop`: after an error PostgreSQL has cleaned up already.
    pub fn end(self) {
        // SAFETY: closes the connection that `begin` opened.
        unsafe { pg_sys::SPI_finish() };
    }
}

/// Whether the call may not commit.
fn is_atomic(fcinfo: pg_sys::FunctionCallInfo) -> bool {
    // SAFETY: a procedure's call info is valid; its context, if any, is a node that says its kind.
    unsafe {
        let context = (*fcinfo).context;
        context.is_null()
            || (*context).type_ != pg_sys::NodeTag::T_CallContext
            || (*context.cast::<pg_sys::CallContext>()).atomic
    }
}
