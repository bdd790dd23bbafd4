//! Occlusion volumes: axis-aligned boxes, along streets, from all of which one occluder hides
//! one occludee.
//!
//! Streets are grouped into [`Block`]s whose ground hardly varies. Within a block, what hides an
//! occludee is a convex plan region for each occluder ([`crate::ShadowCaster`]); lanes of the
//! block, halved adaptively, are filled with the intervals that lie inside those regions.

mod block;
mod coverage;
mod lanes;
mod solver;

pub use block::Block;
pub use solver::{OcclusionVolume, VolumeOptions, VolumeSolver};
