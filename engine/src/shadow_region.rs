//! [`ShadowRegion`], a convex region of the plan.

use glam::DVec2;

use crate::convex_polygon::{area, clipped};

/// A half-plane is of no use to a region that stays this far inside it, metres: more than the
/// corners of a region are off, even where lines cross at an angle of a billionth.
const IDLE: f64 = 1e-3;

/// Where `normal · p <= offset`.
#[derive(Clone, Copy, Debug)]
struct HalfPlane {
    normal: DVec2,
    offset: f64,
}

/// A convex polygon of the plan: an axis-aligned rectangle cut by half-planes.
///
/// The half-planes are what counts. The corners are rounded, so they only tell how large the region
/// is, and which half-planes are clear of it.
///
/// Coordinates inside are relative to an origin near the occluder, so that differences keep
/// their digits in frames such as 85,000 / 447,000; the methods take and give absolute metres.
#[derive(Clone, Debug)]
pub struct ShadowRegion {
    origin: DVec2,
    half_planes: Vec<HalfPlane>,
    corners: Vec<DVec2>,
}

impl ShadowRegion {
    /// All of `window`, two absolute corners.
    pub(crate) fn new(origin: DVec2, window: [DVec2; 2]) -> Self {
        let [min, max] = window.map(|corner| corner - origin);
        let half_plane = |normal, offset| HalfPlane { normal, offset };
        Self {
            origin,
            half_planes: vec![
                half_plane(DVec2::NEG_Y, -min.y),
                half_plane(DVec2::X, max.x),
                half_plane(DVec2::Y, max.y),
                half_plane(DVec2::NEG_X, -min.x),
            ],
            corners: vec![min, DVec2::new(max.x, min.y), max, DVec2::new(min.x, max.y)],
        }
    }

    /// Keeps the half-plane `normal · p <= offset` (relative); `None` when that leaves no area.
    pub(crate) fn bounded(mut self, normal: DVec2, offset: f64) -> Option<Self> {
        self.corners = clipped(&self.corners, normal, offset);
        self.half_planes.push(HalfPlane { normal, offset });
        (self.area() > 0.0).then_some(self)
    }

    /// The same region without the half-planes that are clear of it.
    pub(crate) fn without_idle(mut self) -> Self {
        let corners = &self.corners;
        self.half_planes.retain(|half_plane| {
            let clearance = IDLE * half_plane.normal.length();
            let depth = |corner: &DVec2| half_plane.offset - half_plane.normal.dot(*corner);
            corners.iter().any(|corner| depth(corner) <= clearance)
        });
        self
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
        area(&self.corners)
    }

    /// Whether `other` lies in this region, up to rounding.
    pub(crate) fn contains(&self, other: &Self) -> bool {
        let shift = other.origin - self.origin;
        other.corners.iter().all(|&corner| {
            let holds = |h: &HalfPlane| h.normal.dot(corner + shift) <= h.offset;
            self.half_planes.iter().all(holds)
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
        self.corners
            .iter()
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], corner| {
                [low.min(corner[axis]), high.max(corner[axis])]
            })
    }

    /// Clips the line along `axis` by each half-plane, the lane's ends taken by `worst`: the greater
    /// demand keeps the whole lane inside, the lesser one any point of it.
    fn interval(
        &self,
        axis: usize,
        lane: [f64; 2],
        worst: fn(f64, f64) -> f64,
    ) -> Option<[f64; 2]> {
        let (mut start, mut end) = (f64::NEG_INFINITY, f64::INFINITY);
        for HalfPlane { normal, offset } in &self.half_planes {
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
    use proptest::prelude::*;

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
        assert_eq!(
            (half.area(), half.clone().without_idle().half_planes.len()),
            (4.0, 4)
        );
        assert!(square().contains(&half) && !half.contains(&square()));
    }

    #[test]
    fn nothing_is_left_beyond_a_half_plane_that_only_touches() {
        assert!(square().bounded(DVec2::X, 0.0).is_none());
        assert!(square().bounded(DVec2::ONE, 0.0).is_none());
        let whole = square().bounded(DVec2::X, 4.0).expect("all is left");
        assert_eq!(whole.area(), 16.0);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]
        #[test]
        fn strips_keep_to_every_half_plane(
            touch in prop::array::uniform2(-1e2..1e2f64),
            turns in prop::collection::vec((-3.2..3.2f64, 1e-3..2e2f64), 1..12),
            windows in prop::array::uniform4(1.0..3e2f64),
            lanes in prop::collection::vec((-2e2..2e2f64, 0.5..20.0f64), 8),
        ) {
            // Lines through one point, some nearly the same: rounding puts it on either side.
            let touch = DVec2::from(touch);
            let half_planes: Vec<HalfPlane> = turns.iter().map(|&(turn, length)| {
                let normal = DVec2::from_angle(turn) * length;
                HalfPlane { normal, offset: normal.dot(touch) }
            }).collect();
            let [left, below, right, above] = windows;
            let window = [-DVec2::new(left, below), DVec2::new(right, above)];
            let region = half_planes.iter().try_fold(
                ShadowRegion::new(DVec2::ZERO, window),
                |region, h| region.bounded(h.normal, h.offset),
            );
            let Some(region) = region.map(ShadowRegion::without_idle) else { return Ok(()) };
            for (axis, (low, width)) in [0, 1].into_iter().flat_map(|a| lanes.iter().map(move |l| (a, *l))) {
                let Some(span) = region.strip(axis, low, low + width) else { continue };
                for (along, across) in [0, 1, 2, 3].map(|i| (span[i & 1], low + width * (i >> 1) as f64)) {
                    let corner = if axis == 0 { DVec2::new(along, across) } else { DVec2::new(across, along) };
                    for h in &half_planes {
                        let beyond = (h.normal.dot(corner) - h.offset) / h.normal.length();
                        prop_assert!(beyond <= 1e-9, "{beyond} beyond {h:?} at {corner}");
                    }
                }
            }
        }
    }
}
