//! [`Workers`], threads that compute while the backend's main thread stays answerable.

use crate::error::Refusal;
use crate::settings;
use pgrx::{PgSqlErrorCode, check_for_interrupts, pg_sys};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

/// How long the main thread sleeps between looks for an interrupt.
const POLL: Duration = Duration::from_millis(20);

/// A pool of threads that never call PostgreSQL. It is gone when this is dropped.
pub struct Workers(rayon::ThreadPool);

impl Workers {
    /// Starts the threads that `pg_occlusion.max_threads` allows, one for each core when it is 0,
    /// with all signals blocked: they belong to the main thread.
    pub fn start() -> Self {
        let threads = usize::try_from(settings::MAX_THREADS.get()).unwrap_or(0);
        let builder = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let pool = with_signals_blocked(|| builder.build());
        match pool {
            Ok(pool) => Self(pool),
            Err(error) => Refusal::new(
                PgSqlErrorCode::ERRCODE_INSUFFICIENT_RESOURCES,
                format!("could not start worker threads: {error}"),
            )
            .raise(),
        }
    }

    /// Runs `work` in the pool and returns its result. A cancel or a shutdown of the backend
    /// sets the flag that `work` is given, waits for it to return, and is then obeyed.
    pub fn run<T: Send>(&self, work: impl FnOnce(&AtomicBool) -> T + Send) -> T {
        let cancelled = AtomicBool::new(false);
        let result = self.0.in_place_scope(|scope| {
            let (send, receive) = channel();
            let flag = &cancelled;
            scope.spawn(move |_| {
                // The receiver waits for this one message.
                let _ = send.send(work(flag));
            });
            loop {
                match receive.recv_timeout(POLL) {
                    Ok(result) => break Some(result),
                    Err(RecvTimeoutError::Disconnected) => break None,
                    Err(RecvTimeoutError::Timeout) if interrupted() => {
                        cancelled.store(true, Ordering::Relaxed);
                    }
                    Err(RecvTimeoutError::Timeout) => {}
                }
            }
        });
        check_for_interrupts!();
        if cancelled.load(Ordering::Relaxed) {
            // What is incomplete goes nowhere, even if the cancel was taken back.
            Refusal::new(PgSqlErrorCode::ERRCODE_QUERY_CANCELED, "canceled").raise();
        }
        result.unwrap_or_else(|| unreachable!("the pool re-raises a panic of its work"))
    }
}

/// Whether a cancel or a shutdown is waiting to be obeyed.
fn interrupted() -> bool {
    // SAFETY: flags of the backend that its signal handlers set; read as volatile.
    unsafe {
        (&raw const pg_sys::QueryCancelPending).read_volatile() != 0
            || (&raw const pg_sys::ProcDiePending).read_volatile() != 0
    }
}

/// Runs `start` with all signals blocked, which the threads that it starts inherit.
fn with_signals_blocked<T>(start: impl FnOnce() -> T) -> T {
    // SAFETY: sets are initialised by sigfillset and pthread_sigmask before they are read, and
    // the old mask is put back.
    unsafe {
        let mut all = std::mem::zeroed::<libc::sigset_t>();
        let mut before = std::mem::zeroed::<libc::sigset_t>();
        libc::sigfillset(&raw mut all);
        libc::pthread_sigmask(libc::SIG_SETMASK, &raw const all, &raw mut before);
        let result = start();
        libc::pthread_sigmask(libc::SIG_SETMASK, &raw const before, std::ptr::null_mut());
        result
    }
}
