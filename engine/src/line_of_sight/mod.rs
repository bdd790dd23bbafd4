//! Whether one point can be seen from another, exactly: where a sight line first meets the interior
//! of a solid, or passes through a surface that bounds none.
//!
//! Signs of volumes come from `robust`. Only of the few triangles that a line really meets are the
//! places computed, as rationals, so that no answer depends on a tolerance.

mod contact;
mod exact;
mod neighbourhood;
mod sight_line;
mod solid;
mod surface;
mod winding;

pub use sight_line::{Share, SightLine};
