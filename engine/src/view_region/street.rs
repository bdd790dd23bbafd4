//! [`Street`], a piece of the view region.

use geo::Polygon;

/// A polygon of ground from which observers look, with their height band.
#[derive(Clone, Debug, PartialEq)]
pub struct Street {
    /// Where observers stand, metres.
    pub area: Polygon<f64>,
    /// Lowest eye, absolute metres.
    pub eye_low: f64,
    /// Highest eye, absolute metres.
    pub eye_high: f64,
}
