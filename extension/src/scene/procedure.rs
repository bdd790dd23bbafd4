//! [`Procedure`], work that commits as it goes.

use crate::error::Refusal;
use pgrx::{PgSqlErrorCode, pg_sys};

/// Work that may commit. Its queries go through [`pgrx::Spi`] as usual.
pub enum Procedure {
    /// A CALL.
    Call,
    /// A background worker.
    Worker,
}

impl Procedure {
    /// Begins a CALL; raises an error when it is inside a transaction of the user's.
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
        Self::Call
    }

    /// Begins the first transaction of a background worker, or the next one.
    pub fn of_worker() -> Self {
        begin_transaction();
        Self::Worker
    }

    /// Makes all that was written so far permanent, and begins the next transaction.
    pub fn commit(&mut self) {
        match self {
            // SAFETY: the innermost SPI connection is ours and not atomic.
            Self::Call => unsafe { pg_sys::SPI_commit() },
            Self::Worker => {
                end_transaction();
                begin_transaction();
            }
        }
    }

    /// Ends in order. Not a `Drop`: after an error PostgreSQL has cleaned up already.
    pub fn end(self) {
        match self {
            // SAFETY: closes the connection that `begin` opened.
            Self::Call => unsafe {
                pg_sys::SPI_finish();
            },
            Self::Worker => end_transaction(),
        }
    }
}

fn begin_transaction() {
    // SAFETY: a background worker is in no transaction.
    unsafe {
        pg_sys::SetCurrentStatementStartTimestamp();
        pg_sys::StartTransactionCommand();
        pg_sys::PushActiveSnapshot(pg_sys::GetTransactionSnapshot());
    }
}

fn end_transaction() {
    // SAFETY: ends what `begin_transaction` began.
    unsafe {
        pg_sys::PopActiveSnapshot();
        pg_sys::CommitTransactionCommand();
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
