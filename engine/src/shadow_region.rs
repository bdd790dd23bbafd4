//! [`ShadowRegion`], a convex region of the plan kept as half-planes.

use glam::DVec2;

/// Two tangents from each of the four plan corners of an occludee.
const MOST_SIDES: usize = 8;

/// A convex plan region: the intersection of an axis-aligned rectangle and some half-planes.
///
/// Coordinates inside are relative to an origin near the occluder, so that differences keep
/// their digits in frames such as 85,000 / 447,000; the methods take and give absolute metres.
#[derive(Clone, Debug)]
pub struct ShadowRegion {
    origin: DVec2,
    min: DVec2,
    max: DVec2,
    /// `normal · p <= offset`.
    sides: [(DVec2, f64); MOST_SIDES],
    count: usize,
}

impl ShadowRegion {
    /// All of `window`, two absolute corners.
    pub(crate) fn new(origin: DVec2, window: [DVec2; 2]) -> Self {
        let [min, max] = window.map(|corner| corner - origin);
        Self {
            origin,
            min,
            max,
            sides: [(DVec2::ZERO, 0.0); MOST_SIDES],
            count: 0,
        }
    }

    /// Keeps what is at most `limit` (relative) on `axis`.
    pub(crate) fn bound_above(&mut self, axis: usize, limit: f64) {
        self.max[axis] = self.max[axis].min(limit);
    }

    /// Keeps what is at least `limit` (relative) on `axis`.
    pub(crate) fn bound_below(&mut self, axis: usize, limit: f64) {
        self.min[axis] = self.min[axis].max(limit);
    }

    /// Keeps the half-plane `normal · p <= offset` (relative).
    ///
    /// # Panics
    /// When called more than eight times.
    pub(crate) fn bound(&mut self, normal: DVec2, offset: f64) {
        self.sides[self.count] = (normal, offset);
        self.count += 1;
    }

    /// Whether the enclosing rectangle has area; the region itself may still be empty.
    pub(crate) fn is_possible(&self) -> bool {
        self.min.cmplt(self.max).all()
    }

    /// The enclosing rectangle: the least and the greatest corner, absolute metres.
    #[must_use]
    pub fn rectangle(&self) -> [DVec2; 2] {
        [self.min + self.origin, self.max + self.origin]
    }

    /// The longest interval along `axis` (0: x, 1: y) such that its rectangle with the lane
    /// `low..high` on the other axis is inside the region; `None` when there is none.
    #[must_use]
    pub fn strip(&self, axis: usize, low: f64, high: f64) -> Option<[f64; 2]> {
        let across = 1 - axis;
        let lane = [low - self.origin[across], high - self.origin[across]];
        if lane[0] < self.min[across] || lane[1] > self.max[across] {
            return None;
        }
        self.interval(axis, lane, f64::max)
    }

    /// The interval along `axis` outside of which the lane `low..high` is outside the region.
    #[must_use]
    pub fn reach(&self, axis: usize, low: f64, high: f64) -> Option<[f64; 2]> {
        let across = 1 - axis;
        let lane = [
            (low - self.origin[across]).max(self.min[across]),
            (high - self.origin[across]).min(self.max[across]),
        ];
        if lane[0] > lane[1] {
            return None;
        }
        self.interval(axis, lane, f64::min)
    }

    /// Clips the line along `axis` by each side, the lane's ends taken by `worst`: the greater
    /// demand keeps the whole lane inside, the lesser one any point of it.
    fn interval(
        &self,
        axis: usize,
        lane: [f64; 2],
        worst: fn(f64, f64) -> f64,
    ) -> Option<[f64; 2]> {
        let (mut start, mut end) = (self.min[axis], self.max[axis]);
        for (normal, offset) in &self.sides[..self.count] {
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
