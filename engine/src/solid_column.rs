//! [`SolidColumn`], what hides in its full form.

use geo::Polygon;

/// A vertical prism, all of it inside the solid of a feature.
#[derive(Clone, Debug, PartialEq)]
pub struct SolidColumn {
    /// Outer ring anticlockwise, then holes clockwise; metres.
    pub footprint: Polygon<f64>,
    /// Lowest height, metres.
    pub bottom: f64,
    /// Greatest height, metres.
    pub top: f64,
    /// Whether the column stands on the foot of its own mesh, so that the ground under it may be
    /// solid down to any depth.
    pub grounded: bool,
}
