//! Witnesses: sight lines that prove that a feature can be seen. Exact, against the real surfaces.

mod aims;
mod surface_tile;
mod surfaces;

pub use surface_tile::{Surface, SurfaceTile};
pub use surfaces::{Sought, Surfaces, Witness};
