//! Pairs of edges that may meet, found by a sweep along the longer side of them all.

use super::Plan;

/// Most pairs of edges that are compared: what 2,000 edges need at worst, and 100,000 in practice.
/// Beyond, a hostile outline would take minutes.
const MAX_PAIRS: usize = 2_000_000;

/// Why edges are not compared further.
pub(super) const INTRICATE: &str = "the outline is too intricate";

/// An edge with its box.
pub(super) struct Edge {
    /// Where it starts and ends.
    pub(super) ends: [Plan; 2],
    /// Number of its ring or line.
    pub(super) ring: usize,
    /// Its number in the ring.
    pub(super) index: usize,
    low: Plan,
    high: Plan,
}

impl Edge {
    /// The edges between neighbours of a ring or line.
    pub(super) fn between(positions: &[Plan], ring: usize) -> impl Iterator<Item = Self> + '_ {
        positions.windows(2).enumerate().map(move |(index, pair)| {
            let [a, b] = [pair[0], pair[1]];
            Self {
                ends: [a, b],
                ring,
                index,
                low: [a[0].min(b[0]), a[1].min(b[1])],
                high: [a[0].max(b[0]), a[1].max(b[1])],
            }
        })
    }

    /// Whether two edges on one line share a piece of it.
    pub(super) fn overlaps(&self, other: &Self) -> bool {
        let axis = usize::from(self.high[0] - self.low[0] < self.high[1] - self.low[1]);
        self.low[axis] < other.high[axis] && other.low[axis] < self.high[axis]
    }

    /// Whether the boxes come this near along an axis.
    fn is_near(&self, other: &Self, axis: usize, reach: f64) -> bool {
        self.low[axis] <= other.high[axis] + reach && other.low[axis] <= self.high[axis] + reach
    }
}

/// Shows each pair of edges whose boxes come within reach of each other, until one is a fault.
pub(super) fn each_pair(
    mut edges: Vec<Edge>,
    reach: f64,
    visit: &mut dyn FnMut(&Edge, &Edge) -> Result<(), &'static str>,
) -> Result<(), &'static str> {
    let extent = |axis: usize| {
        let low = edges
            .iter()
            .map(|edge| edge.low[axis])
            .fold(f64::INFINITY, f64::min);
        let high = edges
            .iter()
            .map(|edge| edge.high[axis])
            .fold(f64::NEG_INFINITY, f64::max);
        high - low
    };
    let along = usize::from(extent(1) > extent(0));
    edges.sort_by(|a, b| a.low[along].total_cmp(&b.low[along]));
    let mut pairs = 0;
    for (i, edge) in edges.iter().enumerate() {
        for other in &edges[i + 1..] {
            if !edge.is_near(other, along, reach) {
                break;
            }
            pairs += 1;
            if pairs > MAX_PAIRS {
                return Err(INTRICATE);
            }
            if edge.is_near(other, 1 - along, reach) {
                visit(edge, other)?;
            }
        }
    }
    Ok(())
}
