//! Index support.

mod gist;
mod split;
