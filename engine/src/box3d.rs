//! [`Box3d`], the axis-aligned box.

use glam::DVec3;

/// An axis-aligned box in metres: the closed set of points between two corners.
///
/// Holds `min <= max` on every axis; a box may be flat, or a single point.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Box3d {
    /// The corner with the least coordinates.
    pub min: DVec3,
    /// The corner with the greatest coordinates.
    pub max: DVec3,
}

impl Box3d {
    /// The box spanned by two opposite corners, given in any order.
    #[must_use]
    pub fn new(corner: DVec3, opposite: DVec3) -> Self {
        Self {
            min: corner.min(opposite),
            max: corner.max(opposite),
        }
    }

    /// The smallest box that holds all `points`; `None` when there are none.
    #[must_use]
    pub fn around(points: impl IntoIterator<Item = DVec3>) -> Option<Self> {
        points
            .into_iter()
            .map(|p| Self { min: p, max: p })
            .reduce(|a, b| a.union(&b))
    }

    /// The smallest box that holds both.
    #[must_use]
    pub fn union(&self, other: &Self) -> Self {
        Self {
            min: self.min.min(other.min),
            max: self.max.max(other.max),
        }
    }

    /// Edge lengths in metres.
    #[must_use]
    pub fn size(&self) -> DVec3 {
        self.max - self.min
    }

    /// The middle of the box.
    #[must_use]
    pub fn center(&self) -> DVec3 {
        self.min + self.size() * 0.5
    }

    /// Volume in cubic metres; 0 for a flat box.
    #[must_use]
    pub fn volume(&self) -> f64 {
        self.size().element_product()
    }

    /// Sum of the three edge lengths in metres, which ranks flat boxes too.
    #[must_use]
    pub fn margin(&self) -> f64 {
        self.size().element_sum()
    }

    /// The eight corners; bit 0, 1, 2 of the position choose max on x, y, z.
    #[must_use]
    pub fn corners(&self) -> [DVec3; 8] {
        std::array::from_fn(|i| {
            let pick = |axis: usize| {
                if i >> axis & 1 == 1 {
                    self.max[axis]
                } else {
                    self.min[axis]
                }
            };
            DVec3::new(pick(0), pick(1), pick(2))
        })
    }

    /// Whether the closed boxes share a point.
    #[must_use]
    #[inline]
    pub fn overlaps(&self, other: &Self) -> bool {
        self.min.cmple(other.max).all() && other.min.cmple(self.max).all()
    }

    /// Whether `other` lies in the closed box.
    #[must_use]
    #[inline]
    pub fn contains(&self, other: &Self) -> bool {
        self.min.cmple(other.min).all() && other.max.cmple(self.max).all()
    }

    /// Whether `point` lies in the closed box.
    #[must_use]
    #[inline]
    pub fn contains_point(&self, point: DVec3) -> bool {
        self.min.cmple(point).all() && point.cmple(self.max).all()
    }

    /// The box moved outward by `margin` metres on every side; a negative margin shrinks it.
    /// `None` when nothing would be left.
    #[must_use]
    pub fn expanded(&self, margin: f64) -> Option<Self> {
        let grown = Self {
            min: self.min - margin,
            max: self.max + margin,
        };
        grown.min.cmple(grown.max).all().then_some(grown)
    }

    /// The box that both share; `None` when they are apart. It may be flat.
    #[must_use]
    pub fn intersection(&self, other: &Self) -> Option<Self> {
        let shared = Self {
            min: self.min.max(other.min),
            max: self.max.min(other.max),
        };
        shared.min.cmple(shared.max).all().then_some(shared)
    }

    /// Area of the six faces in square metres; a flat box has two.
    #[must_use]
    pub fn surface_area(&self) -> f64 {
        let size = self.size();
        2.0 * (size.x * size.y + size.y * size.z + size.z * size.x)
    }

    /// Euclidean distance in metres from `point` to the closed box; 0 inside.
    #[must_use]
    #[inline]
    pub fn distance_to_point(&self, point: DVec3) -> f64 {
        length(point.clamp(self.min, self.max) - point)
    }

    /// Euclidean distance in metres between the closed boxes; 0 when they share a point.
    #[must_use]
    #[inline]
    pub fn distance(&self, other: &Self) -> f64 {
        let gap = (self.min - other.max).max(other.min - self.max);
        length(gap.max(DVec3::ZERO))
    }

    /// The greatest Euclidean distance in metres between a point of one box and one of the other.
    #[must_use]
    pub fn max_distance(&self, other: &Self) -> f64 {
        length((self.max - other.min).max(other.max - self.min))
    }
}

/// The length of a vector; that of one whose square is out of an f64's bounds, too.
#[inline]
pub(crate) fn length(vector: DVec3) -> f64 {
    let squared = vector.length_squared();
    if squared.is_normal() && squared.is_finite() {
        return squared.sqrt();
    }
    let scale = vector.abs().max_element();
    if scale == 0.0 || scale.is_infinite() {
        return scale;
    }
    (vector / scale).length() * scale
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_near_the_bounds_of_numbers_are_kept() {
        for scale in [1e-310, 1e-200, 1e-150, 1.0, 1e153, 1e200, 1e307] {
            let got = length(DVec3::new(3.0, -4.0, 12.0) * scale) / scale;
            assert!((got - 13.0).abs() < 1e-9, "{got} at {scale:e}");
        }
        assert_eq!(length(DVec3::ZERO), 0.0);
    }

    #[test]
    fn what_is_shared_is_in_both() {
        let a = Box3d::new(DVec3::ZERO, DVec3::new(2.0, 3.0, 4.0));
        let b = Box3d::new(DVec3::new(2.0, 1.0, 1.0), DVec3::new(5.0, 2.0, 9.0));
        let shared = Box3d::new(DVec3::new(2.0, 1.0, 1.0), DVec3::new(2.0, 2.0, 4.0));
        assert_eq!(a.intersection(&b), Some(shared));
        let apart = Box3d::new(DVec3::splat(9.0), DVec3::splat(9.5));
        assert_eq!(a.intersection(&apart), None);
        assert_eq!(a.surface_area(), 52.0);
        assert_eq!(shared.surface_area(), 6.0);
        assert_eq!(a.max_distance(&b), DVec3::new(5.0, 2.0, 9.0).length());
    }
}
