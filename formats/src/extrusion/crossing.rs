//! Whether the edges of a footprint keep apart.

use geo::algorithm::kernels::{Kernel, Orientation};
use geo::{Coord, GeoNum};

use super::Plan;

/// Most pairs of edges that are compared: what a footprint of 2,000 vertices needs at worst, and
/// one of 100,000 in practice. Beyond, a hostile outline would take minutes.
const MAX_PAIRS: usize = 2_000_000;

/// Why the edges of rings do not bound an area; none where they meet at most in points.
pub(super) fn fault(rings: &[Vec<Plan>]) -> Option<&'static str> {
    let mut edges: Vec<Edge> = rings.iter().flat_map(|ring| edges(ring)).collect();
    edges.sort_by(|a, b| a.low[0].total_cmp(&b.low[0]));
    let mut pairs = 0;
    for (i, edge) in edges.iter().enumerate() {
        for other in edges[i + 1..]
            .iter()
            .take_while(|other| other.low[0] <= edge.high[0])
        {
            pairs += 1;
            if pairs > MAX_PAIRS {
                return Some("the outline is too intricate");
            }
            if edge.may_touch(other) && edge.crosses(other) {
                return Some("the outline crosses itself");
            }
        }
    }
    None
}

/// The edges of a ring whose last vertex leads back to the first.
fn edges(ring: &[Plan]) -> impl Iterator<Item = Edge> + '_ {
    let ends = ring.iter().skip(1).chain(ring.first());
    ring.iter().zip(ends).map(|(a, b)| Edge {
        ends: [*a, *b],
        low: [a[0].min(b[0]), a[1].min(b[1])],
        high: [a[0].max(b[0]), a[1].max(b[1])],
    })
}

/// An edge with its box.
struct Edge {
    ends: [Plan; 2],
    low: Plan,
    high: Plan,
}

impl Edge {
    /// Whether the heights of the boxes meet; their widths do already.
    fn may_touch(&self, other: &Self) -> bool {
        self.low[1] <= other.high[1] && other.low[1] <= self.high[1]
    }

    /// Whether two edges have more in common than a point where one of them ends.
    fn crosses(&self, other: &Self) -> bool {
        let sides = |line: &Self, of: &Self| of.ends.map(|end| side(line.ends, end));
        let (a, b) = (sides(self, other), sides(other, self));
        if a == [Orientation::Collinear; 2] {
            return self.overlaps(other);
        }
        let apart = |sides: [Orientation; 2]| {
            sides[0] != sides[1] && !sides.contains(&Orientation::Collinear)
        };
        apart(a) && apart(b)
    }

    /// Whether two edges on one line share a piece of it.
    fn overlaps(&self, other: &Self) -> bool {
        let axis = usize::from(self.high[0] - self.low[0] < self.high[1] - self.low[1]);
        self.low[axis] < other.high[axis] && other.low[axis] < self.high[axis]
    }
}

/// The side of a line that a point is on, exactly.
fn side([a, b]: [Plan; 2], p: Plan) -> Orientation {
    let coord = |[x, y]: Plan| Coord { x, y };
    <f64 as GeoNum>::Ker::orient2d(coord(a), coord(b), coord(p))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edges_may_touch_and_not_cross() {
        let square = vec![[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
        let bow = vec![[0.0, 0.0], [4.0, 4.0], [4.0, 0.0], [0.0, 4.0]];
        let touching = vec![[0.0, 0.0], [2.0, 3.0], [3.0, 2.0]];
        let flush = vec![[1.0, 0.0], [3.0, 0.0], [2.0, 2.0]];
        assert_eq!(fault(&[square.clone()]), None);
        assert_eq!(fault(&[bow]), Some("the outline crosses itself"));
        assert_eq!(fault(&[square.clone(), touching]), None);
        assert_eq!(fault(&[square, flush]), Some("the outline crosses itself"));
    }

    #[test]
    fn an_outline_that_would_take_too_long_is_refused() {
        let tooth = |i| [f64::from(i % 2) * 1e3, f64::from(i)];
        let back = [[-1.0, 3000.0], [-1.0, 0.0]];
        let comb = (0..3000).map(tooth).chain(back).collect();
        assert_eq!(fault(&[comb]), Some("the outline is too intricate"));
    }
}
