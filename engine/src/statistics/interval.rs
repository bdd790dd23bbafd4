//! [`Interval`], where one side of the boxes of a group lies along an axis.

/// From the least to the greatest of some coordinates, metres. They are kept as `f32`; who
/// compares rounds the other side too, so that what touches still touches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    low: f32,
    high: f32,
}

/// A coordinate as the statistics keep it: rounded, and cut to what an `f32` holds.
pub fn rounded(coordinate: f64) -> f32 {
    coordinate.clamp(f32::MIN.into(), f32::MAX.into()) as f32
}

impl Interval {
    /// The interval between two numbers; `None` if they are not in order or not finite.
    pub fn new(low: f32, high: f32) -> Option<Self> {
        (low.is_finite() && high.is_finite() && low <= high).then_some(Self { low, high })
    }

    /// The interval around some coordinates, of which there is at least one.
    pub fn around(coordinates: impl Iterator<Item = f64>) -> Self {
        let empty = Self {
            low: f32::MAX,
            high: f32::MIN,
        };
        coordinates.map(rounded).fold(empty, |so_far, c| Self {
            low: so_far.low.min(c),
            high: so_far.high.max(c),
        })
    }

    /// The least coordinate.
    pub fn low(&self) -> f32 {
        self.low
    }

    /// The greatest coordinate.
    pub fn high(&self) -> f32 {
        self.high
    }

    /// The coordinate at a share of the way, 0 to 1.
    pub fn at(&self, share: f64) -> f64 {
        f64::from(self.low) + (f64::from(self.high) - f64::from(self.low)) * share
    }

    /// The share of the coordinates that are at most `limit`.
    pub fn share_to(&self, limit: f32) -> f64 {
        if limit >= self.high {
            1.0
        } else if limit < self.low {
            0.0
        } else {
            self.way_to(limit)
        }
    }

    /// The share of the coordinates that are less than `limit`.
    pub fn share_before(&self, limit: f32) -> f64 {
        if limit > self.high {
            1.0
        } else if limit <= self.low {
            0.0
        } else {
            self.way_to(limit)
        }
    }

    /// The share of the coordinates that are `place`: all of them or none, as far as is known.
    pub fn share_at(&self, place: f32) -> f64 {
        self.share_to(place) - self.share_before(place)
    }

    /// How far along the interval a coordinate in it lies; only asked where it has a length.
    fn way_to(&self, coordinate: f32) -> f64 {
        let from = |c: f32| f64::from(c) - f64::from(self.low);
        from(coordinate) / from(self.high)
    }
}
