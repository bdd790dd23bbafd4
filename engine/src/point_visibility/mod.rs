//! What can be seen from one point: an occlusion horizon, walked front to back.
//!
//! The plan around the eye is seen through the four sides of a square. On a side, a point at depth
//! `w` and offset `u` has the place `t = u / w`, and along a straight wall both `1 / w` and the slope
//! to its top are linear in `t`. So the horizon, the highest slope below which all is hidden, is an
//! upper envelope of straight pieces, kept exactly: no raster, and no trigonometry.

mod bytes;
mod extent;
mod hidden_by;
mod horizon;
mod isovist;
mod neighbourhoods;
mod occluder;
mod projection;
mod sift;
mod solver;
mod target;
mod tile;
mod tree;

pub use bytes::MalformedTile;
pub use extent::{AzimuthRange, Extents};
pub use hidden_by::{Hider, PointTarget, TargetShape};
pub use neighbourhoods::neighbourhoods;
pub(crate) use sift::{Known, Sifting, Spot};
pub use solver::{PointQuery, PointSolver, Sighting, TileSource, visible_from_point};
pub use tile::{Tile, TileFeature};
pub(crate) use tree::Tree;

/// How far from a solid an eye counts as within it, metres: that solid hides nothing then, and a
/// wall so near has no usable direction.
pub const EYE_MARGIN: f64 = 1e-3;

/// Relative slack between the slope of an occluder and that of its target: some ten million
/// roundings of an `f64`, because a wall seen at [`EDGE_ON`] multiplies them by a million; on a
/// tower of 100 m it is a micrometre. Each side gives way by as much, towards "visible".
const SLOPE_MARGIN: f64 = 1e-8;

/// Sine of the angle between a wall and the sight line below which it is seen edge on: it hides
/// next to nothing then, and its slope could not be told from the roundings.
const EDGE_ON: f64 = 1e-6;

/// Slack on the line of an edge that is not level, in roundings of the two terms that it is the
/// difference of.
const ROUNDINGS: f64 = 64.0 * f64::EPSILON;

/// Columns that are not grounded hide what is seen over no lower slope than this, where sight lines of
/// this slope and higher ones pass above their bottoms: of an eye 2 m above it a bottom that is
/// nearer than 100 m, and of what stands 2 m lower than the eye what is farther than that.
const SHALLOW: f64 = -0.02;

/// A few roundings of a place: targets are taken to be wider than computed by as much, and what hides
/// to be narrower.
const PLACE_MARGIN: f64 = 4.0 * f64::EPSILON;
