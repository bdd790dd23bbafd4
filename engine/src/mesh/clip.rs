//! Cuts triangles by axis-aligned slabs.

use glam::DVec3;

/// A convex piece of a triangle, cut down slab by slab; its memory is reused.
///
/// Sutherland and Hodgman, "Reentrant polygon clipping", Communications of the ACM 17(1), 1974. A
/// cut point gets the plane's coordinate bit for bit, so that "flush with a plane" is decided by
/// exact comparison.
#[derive(Default)]
pub struct Clip {
    points: Vec<DVec3>,
    previous: Vec<DVec3>,
}

impl Clip {
    /// Starts again from a whole triangle.
    pub fn reset(&mut self, triangle: &[DVec3; 3]) {
        self.points.clear();
        self.points.extend_from_slice(triangle);
    }

    /// Starts again from the piece that another clip holds.
    pub fn reset_to(&mut self, other: &Self) {
        self.points.clear();
        self.points.extend_from_slice(&other.points);
    }

    /// Keeps what lies in the closed slab `low <= coordinate <= high`.
    pub fn cut(&mut self, axis: usize, low: f64, high: f64) {
        self.cut_at(axis, low, |x| x >= low);
        self.cut_at(axis, high, |x| x <= high);
    }

    fn cut_at(&mut self, axis: usize, plane: f64, keeps: impl Fn(f64) -> bool) {
        if self.points.iter().all(|p| keeps(p[axis])) {
            return;
        }
        std::mem::swap(&mut self.points, &mut self.previous);
        self.points.clear();
        let Some(&last) = self.previous.last() else {
            return;
        };
        let mut from = last;
        for &to in &self.previous {
            if keeps(from[axis]) != keeps(to[axis]) {
                self.points.push(crossing(from, to, axis, plane));
            }
            if keeps(to[axis]) {
                self.points.push(to);
            }
            from = to;
        }
    }

    /// Least and greatest coordinate of the piece; `None` when nothing is left.
    #[must_use]
    pub fn extent(&self, axis: usize) -> Option<(f64, f64)> {
        let coordinates = self.points.iter().map(|p| p[axis]);
        coordinates
            .map(|x| (x, x))
            .reduce(|(low, high), (x, _)| (low.min(x), high.max(x)))
    }

    /// Whether the piece, which lies in the closed slab, meets the open one.
    ///
    /// A convex set in a closed box misses the open box only by lying in one of its faces, so this
    /// test on each axis decides whether a clipped triangle meets an open box.
    #[must_use]
    pub fn meets_open_slab(&self, axis: usize, low: f64, high: f64) -> bool {
        self.extent(axis)
            .is_some_and(|(least, greatest)| greatest > low && least < high)
    }
}

fn crossing(from: DVec3, to: DVec3, axis: usize, plane: f64) -> DVec3 {
    let share = (plane - from[axis]) / (to[axis] - from[axis]);
    // Clamped, since rounding must not carry the point past the edge's own ends.
    let mut point = (from + share * (to - from)).clamp(from.min(to), from.max(to));
    point[axis] = plane;
    point
}

#[cfg(test)]
mod tests {
    use super::*;

    fn clip_of(triangle: [DVec3; 3]) -> Clip {
        let mut clip = Clip::default();
        clip.reset(&triangle);
        clip
    }

    #[test]
    fn cut_keeps_the_slab() {
        let mut clip = clip_of([
            DVec3::ZERO,
            DVec3::new(4.0, 0.0, 0.0),
            DVec3::new(0.0, 4.0, 2.0),
        ]);
        clip.cut(0, 1.0, 2.0);
        assert_eq!(clip.extent(0), Some((1.0, 2.0)));
        assert_eq!(clip.extent(1), Some((0.0, 3.0)));
        assert_eq!(clip.extent(2), Some((0.0, 1.5)));
    }

    #[test]
    fn flush_piece_misses_the_open_slab() {
        let wall = [DVec3::X, DVec3::X + DVec3::Y, DVec3::X + DVec3::Z];
        let mut clip = clip_of(wall);
        clip.cut(0, 0.0, 1.0);
        assert!(!clip.meets_open_slab(0, 0.0, 1.0));
        assert!(clip.meets_open_slab(0, 0.0, 2.0));
    }

    #[test]
    fn nothing_left_outside() {
        let mut clip = clip_of([DVec3::ZERO, DVec3::X, DVec3::Y]);
        clip.cut(2, 1.0, 2.0);
        assert_eq!(clip.extent(0), None);
        clip.cut(0, 0.0, 1.0);
        assert!(!clip.meets_open_slab(0, 0.0, 1.0));
    }
}
