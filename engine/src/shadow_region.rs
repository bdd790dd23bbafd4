//! [`ShadowRegion`], a convex region of the plan.

use glam::DVec2;

/// Where one side of a region begins, going anticlockwise, and the half-plane
/// `normal · p <= offset` that ends there.
#[derive(Clone, Copy, Debug)]
struct Side {
    corner: DVec2,
    normal: DVec2,
    offset: f64,
}

/// A convex polygon of the plan: an axis-aligned rectangle cut by half-planes.
///
/// Coordinates inside are relative to an origin near the occluder, so that differences keep
/// their digits in frames such as 85,000 / 447,000; the methods take and give absolute metres.
#[derive(Clone, Debug)]
pub struct ShadowRegion {
    origin: DVec2,
    sides: Vec<Side>,
}

impl ShadowRegion {
    /// All of `window`, two absolute corners.
    pub(crate) fn new(origin: DVec2, window: [DVec2; 2]) -> Self {
        let [min, max] = window.map(|corner| corner - origin);
        let side = |x, y, normal, offset| Side {
            corner: DVec2::new(x, y),
            normal,
            offset,
        };
        Self {
            origin,
            sides: vec![
                side(min.x, min.y, DVec2::NEG_Y, -min.y),
                side(max.x, min.y, DVec2::X, max.x),
                side(max.x, max.y, DVec2::Y, max.y),
                side(min.x, max.y, DVec2::NEG_X, -min.x),
            ],
        }
    }

    /// Keeps the half-plane `normal · p <= offset` (relative); `None` when that leaves no area.
    pub(crate) fn bounded(mut self, normal: DVec2, offset: f64) -> Option<Self> {
        let depth = |side: &Side| offset - normal.dot(side.corner);
        if !self.sides.iter().any(|side| depth(side) > 0.0) {
            return None;
        }
        // A line cuts a convex polygon once on the way out and once on the way in.
        let count = self.sides.len();
        let outside = |sides: &[Side], i: usize| depth(&sides[i % count]) < 0.0;
        let leaves = |i: &usize| !outside(&self.sides, *i) && outside(&self.sides, i + 1);
        let Some(leaving) = (0..count).find(leaves) else {
            return Some(self);
        };
        self.sides.rotate_left(leaving);
        let entering = (1..count).find(|i| !outside(&self.sides, i + 1))?;
        let crossing = |from: &Side, to: &Side| {
            let (a, b) = (depth(from), depth(to));
            from.corner + (to.corner - from.corner) * (a / (a - b))
        };
        let (last, after) = (self.sides[entering], self.sides[(entering + 1) % count]);
        let cut = Side {
            corner: crossing(&self.sides[0], &self.sides[1]),
            normal,
            offset,
        };
        let rest = Side {
            corner: crossing(&last, &after),
            ..last
        };
        self.sides.splice(1..=entering, [cut, rest]);
        Some(self)
    }

    /// The enclosing rectangle: the least and the greatest corner, absolute metres.
    #[must_use]
    pub fn rectangle(&self) -> [DVec2; 2] {
        let [x, y] = [0, 1].map(|axis| self.extent(axis));
        [DVec2::new(x[0], y[0]), DVec2::new(x[1], y[1])].map(|corner| corner + self.origin)
    }

    /// Square metres.
    #[must_use]
    pub fn area(&self) -> f64 {
        let corner = |i: usize| self.sides[i % self.sides.len()].corner;
        let doubled: f64 = (0..self.sides.len())
            .map(|i| corner(i).perp_dot(corner(i + 1)))
            .sum();
        doubled / 2.0
    }

    /// Whether `other` lies in this region, up to rounding.
    pub(crate) fn contains(&self, other: &Self) -> bool {
        let shift = other.origin - self.origin;
        other.sides.iter().all(|point| {
            let corner = point.corner + shift;
            let mut sides = self.sides.iter();
            sides.all(|side| side.normal.dot(corner) <= side.offset)
        })
    }

    /// The longest interval along `axis` (0: x, 1: y) such that its rectangle with the lane
    /// `low..high` on the other axis is inside the region; `None` when there is none.
    #[must_use]
    pub fn strip(&self, axis: usize, low: f64, high: f64) -> Option<[f64; 2]> {
        let across = 1 - axis;
        let lane = [low - self.origin[across], high - self.origin[across]];
        self.interval(axis, lane, f64::max)
    }

    /// An interval along `axis` outside of which the lane `low..high` is outside the region.
    #[must_use]
    pub fn reach(&self, axis: usize, low: f64, high: f64) -> Option<[f64; 2]> {
        let across = 1 - axis;
        let [least, most] = self.extent(across);
        let lane = [
            (low - self.origin[across]).max(least),
            (high - self.origin[across]).min(most),
        ];
        if lane[0] > lane[1] {
            return None;
        }
        self.interval(axis, lane, f64::min)
    }

    /// Least and greatest coordinate on an axis (relative).
    fn extent(&self, axis: usize) -> [f64; 2] {
        self.sides
            .iter()
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], side| {
                [low.min(side.corner[axis]), high.max(side.corner[axis])]
            })
    }

    /// Clips the line along `axis` by each side, the lane's ends taken by `worst`: the greater
    /// demand keeps the whole lane inside, the lesser one any point of it.
    fn interval(
        &self,
        axis: usize,
        lane: [f64; 2],
        worst: fn(f64, f64) -> f64,
    ) -> Option<[f64; 2]> {
        let (mut start, mut end) = (f64::NEG_INFINITY, f64::INFINITY);
        for Side { normal, offset, .. } in &self.sides {
            let across = normal[1 - axis];
            let rest = offset - worst(across * lane[0], across * lane[1]);
            let slope = normal[axis];
            if slope > 0.0 {
                end = end.min(rest / slope);
            } else if slope < 0.0 {
                start = start.max(rest / slope);
            } else if rest < 0.0 {
                return None;
            }
        }
        let origin = self.origin[axis];
        (start < end).then_some([start + origin, end + origin])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square() -> ShadowRegion {
        ShadowRegion::new(
            DVec2::splat(100.0),
            [DVec2::splat(100.0), DVec2::splat(104.0)],
        )
    }

    #[test]
    fn half_planes_cut_corners_off() {
        let cut = square().bounded(DVec2::ONE, 6.0).expect("most is left");
        assert_eq!(cut.area(), 14.0);
        assert_eq!(cut.rectangle(), [DVec2::splat(100.0), DVec2::splat(104.0)]);
        assert_eq!(cut.strip(0, 100.0, 103.0), Some([100.0, 103.0]));
        assert_eq!(cut.reach(0, 103.0, 104.0), Some([100.0, 103.0]));
        assert_eq!(cut.strip(1, 103.0, 105.0), None);
        let half = cut.bounded(DVec2::X, 1.0).expect("a quarter is left");
        assert_eq!((half.area(), half.sides.len()), (4.0, 4));
        assert!(square().contains(&half) && !half.contains(&square()));
    }

    #[test]
    fn nothing_is_left_beyond_a_half_plane_that_only_touches() {
        assert!(square().bounded(DVec2::X, 0.0).is_none());
        assert!(square().bounded(DVec2::ONE, 0.0).is_none());
        let whole = square().bounded(DVec2::X, 4.0).expect("all is left");
        assert_eq!(whole.area(), 16.0);
    }
}
