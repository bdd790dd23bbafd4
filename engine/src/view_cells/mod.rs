//! What can be seen from anywhere in a view cell.
//!
//! What the union of all that hides, eroded by the box that an eye may move in, hides from the middle of
//! the cell is hidden from all of it: one problem of a point ([`crate::PointSolver`]) for each cell. Where
//! that leaves something open, the cell is divided.

mod area;
mod behind;
mod cover;
mod crack;
mod erosion;
mod proof;
mod scene;
mod simpler;
mod solver;
mod way;

pub use area::plan_of_boxes;
pub use cover::{CoverOptions, ViewCell};
pub use proof::witness;
pub use scene::{CellScene, CellTile};
pub use solver::{CellQuery, CellSighting, CellSolver};
pub use way::Way;
