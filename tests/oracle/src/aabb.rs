/// A point `[x, y, z]` in metres, z up.
pub type Point = [f64; 3];

/// An axis-aligned box from `min` to `max`.
///
/// A box with a NaN, or with `min >= max` on some axis, has an empty interior.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// Lower corner.
    pub min: Point,
    /// Upper corner.
    pub max: Point,
}

impl Aabb {
    /// The box from `min` to `max`, taken as given: corners are not sorted.
    #[must_use]
    pub fn new(min: Point, max: Point) -> Self {
        Self { min, max }
    }

    /// The eight corners; bit `i` of the position chooses `max` on axis `i`.
    #[must_use]
    pub fn corners(&self) -> [Point; 8] {
        std::array::from_fn(|bits| {
            std::array::from_fn(|axis| {
                if bits >> axis & 1 == 1 {
                    self.max[axis]
                } else {
                    self.min[axis]
                }
            })
        })
    }

    /// Whether the interior is not empty.
    #[must_use]
    pub fn has_volume(&self) -> bool {
        (0..3).all(|axis| self.min[axis] < self.max[axis])
    }

    /// Whether `point` lies strictly inside.
    pub(crate) fn interior_contains(&self, point: Point) -> bool {
        (0..3).all(|axis| self.min[axis] < point[axis] && point[axis] < self.max[axis])
    }

    /// Whether all six bounds are finite and in order (flat is fine).
    pub(crate) fn is_proper(&self) -> bool {
        is_finite(self.min)
            && is_finite(self.max)
            && (0..3).all(|axis| self.min[axis] <= self.max[axis])
    }

    /// The smallest box around `points`.
    pub(crate) fn around(points: &[Point]) -> Self {
        let empty = Self {
            min: [f64::INFINITY; 3],
            max: [f64::NEG_INFINITY; 3],
        };
        points.iter().fold(empty, |bounds, &point| {
            bounds.union(&Self::new(point, point))
        })
    }

    /// The smallest box around both.
    pub(crate) fn union(&self, other: &Self) -> Self {
        Self {
            min: std::array::from_fn(|axis| self.min[axis].min(other.min[axis])),
            max: std::array::from_fn(|axis| self.max[axis].max(other.max[axis])),
        }
    }
}

/// Whether all three coordinates are finite.
pub(crate) fn is_finite(point: Point) -> bool {
    point.iter().all(|coordinate| coordinate.is_finite())
}
