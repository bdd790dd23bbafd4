//! [`ColumnOptions`], what columns are to reach.

/// Trade-off between the volume inside the columns and their number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ColumnOptions {
    /// Share of the solid volume that is enough, 0 to 1. Of the sets of columns that reach it, one
    /// with the fewest is taken. More lets more be hidden, and costs columns: a gabled roof takes
    /// three for three quarters of its volume, and seven for seven eighths.
    pub share: f64,
    /// Most columns of a mesh.
    pub most: usize,
    /// Least share of the solid volume that a column adds: details below it stay outside, which
    /// keeps the columns of large buildings few.
    pub least_gain: f64,
}

impl Default for ColumnOptions {
    fn default() -> Self {
        Self {
            share: 0.98,
            most: 24,
            least_gain: 0.003,
        }
    }
}
