//! [`Bounds`], the extent of data in degrees.

/// The smallest box around positions.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Bounds(Option<[[f64; 2]; 2]>);

impl Bounds {
    /// Makes it hold a position.
    pub(crate) fn add(&mut self, p: [f64; 2]) {
        let [low, high] = self.0.unwrap_or([p; 2]);
        self.0 = Some([
            [low[0].min(p[0]), low[1].min(p[1])],
            [high[0].max(p[0]), high[1].max(p[1])],
        ]);
    }

    /// Its middle; none where nothing is in it.
    pub(crate) fn centre(&self) -> Option<[f64; 2]> {
        let [low, high] = self.0?;
        Some([(low[0] + high[0]) / 2.0, (low[1] + high[1]) / 2.0])
    }
}
