//! [`Failure`], why a command ended early.

use std::error::Error;
use std::fmt::Display;
use std::path::Path;

/// Why a command ended early, worded for the user; each kind has an exit status of its own.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// What was asked for makes no sense, or a file that was given cannot be used.
    #[error("{0}")]
    Input(String),
    /// The database cannot be reached, or it refused.
    #[error("{}", database_message(.0))]
    Database(#[from] postgres::Error),
    /// The database lacks something.
    #[error("{0}")]
    Unready(String),
    /// This machine cannot do it: no graphics adapter, no room for a picture.
    #[error("{0}")]
    Machine(String),
    /// The user pressed Ctrl-C.
    #[error("cancelled")]
    Cancelled,
}

/// Exit status of a `verify` or `bench` that found a fault. Success is 0, wrong usage 2.
pub const FOUND_FAULTS: u8 = 1;

/// What `--help` says about the exit status.
pub const EXIT_STATUS: &str = "Exit status:
  0  done
  1  verify found a false occlusion or another fault, or bench answers that differ or miss something
  2  wrong usage, or a file or value that cannot be used
  3  the database cannot be reached, or it refused
  4  this machine cannot do it: no graphics adapter, a file cannot be written
  130  cancelled by Ctrl-C";

impl Failure {
    /// The exit status that tells it to a script.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Input(_) => 2,
            Self::Database(_) | Self::Unready(_) => 3,
            Self::Machine(_) => 4,
            Self::Cancelled => 130,
        }
    }

    /// A file that cannot be read.
    pub fn unreadable(path: &Path, error: &std::io::Error) -> Self {
        Self::Input(format!("cannot read \"{}\": {error}", path.display()))
    }

    /// Something that this machine could not do.
    pub fn machine(error: impl Display) -> Self {
        Self::Machine(error.to_string())
    }
}

impl From<renderer::Error> for Failure {
    fn from(error: renderer::Error) -> Self {
        Self::machine(error)
    }
}

/// The server's message with detail and hint, or the client's with its cause.
fn database_message(error: &postgres::Error) -> String {
    let Some(refusal) = error.as_db_error() else {
        return with_causes(error);
    };
    let mut message = refusal.message().to_owned();
    for (label, text) in [("detail", refusal.detail()), ("hint", refusal.hint())] {
        if let Some(text) = text {
            message += &format!("\n  {label}: {text}");
        }
    }
    message
}

/// An error and what caused it, each said once.
fn with_causes(error: &dyn Error) -> String {
    let mut message = error.to_string();
    let mut cause = error.source();
    while let Some(deeper) = cause {
        let text = deeper.to_string();
        if !message.contains(&text) {
            message += &format!(": {text}");
        }
        cause = deeper.source();
    }
    message
}
