//! Lanes: strips of a block along one axis, halved where that finds more.

use super::block::Block;
use crate::ShadowRegion;

/// What one occluder hides of the occludee, over one block.
pub struct Shadow {
    /// Position of the occluder in the solver's list.
    pub occluder: usize,
    /// The plan region.
    pub region: ShadowRegion,
}

/// A box of a lane that lies wholly inside one shadow.
#[derive(Clone, Copy, Debug)]
pub struct Piece {
    pub occluder: usize,
    pub lane: [f64; 2],
    pub span: [f64; 2],
}

/// A set of pieces and the street area that they serve, square metres.
#[derive(Default)]
pub struct Cover {
    pub pieces: Vec<Piece>,
    pub area: f64,
}

impl Cover {
    /// The area, less `worth` for each piece.
    pub fn score(&self, worth: f64) -> f64 {
        self.area - worth * self.pieces.len() as f64
    }
}

/// Fills the lanes of one block along one axis.
pub struct LaneFiller<'a> {
    pub block: &'a Block,
    /// 0: lanes along x, 1: along y.
    pub axis: usize,
    /// Square metres of street that each further piece must add.
    pub worth: f64,
    /// Metres below which no lane is halved.
    pub smallest: f64,
    /// Asked at each lane: whether to give up, with whatever is found so far.
    pub cancelled: &'a dyn Fn() -> bool,
}

impl LaneFiller<'_> {
    /// The best cover of `lane` (low and high across the axis): its own, or that of its halves
    /// when each piece they cost more adds its worth.
    pub fn cover(&self, lane: [f64; 2], shadows: &[&Shadow]) -> Cover {
        let (own, covered) = self.cover_whole(lane, shadows);
        if lane[1] - lane[0] < 2.0 * self.smallest || (self.cancelled)() {
            return own;
        }
        let (useful, possible) = self.useful(lane, shadows, &own, &covered);
        if possible - own.area <= self.worth {
            return own;
        }
        let middle = (lane[0] + lane[1]) / 2.0;
        let mut halves = self.cover([lane[0], middle], &useful);
        let upper = self.cover([middle, lane[1]], &useful);
        halves.pieces.extend(upper.pieces);
        halves.area += upper.area;
        if halves.score(self.worth) > own.score(self.worth) {
            halves
        } else {
            own
        }
    }

    /// Covers what single shadows hold of the full width of the lane, with the fewest intervals;
    /// also returns the covered intervals, in order.
    fn cover_whole(&self, lane: [f64; 2], shadows: &[&Shadow]) -> (Cover, Vec<[f64; 2]>) {
        let mut strips: Vec<(usize, [f64; 2])> = shadows
            .iter()
            .filter_map(|s| Some((s.occluder, s.region.strip(self.axis, lane[0], lane[1])?)))
            .collect();
        strips.sort_by(|a, b| a.1[0].total_cmp(&b.1[0]));
        let mut cover = Cover::default();
        let mut covered: Vec<[f64; 2]> = Vec::new();
        let mut reached = f64::NEG_INFINITY;
        let mut next = 0;
        while next < strips.len() {
            // Of those that start in what is covered the one that ends last, else the next one.
            let mut best = next;
            while next < strips.len() && strips[next].1[0] <= reached.max(strips[best].1[0]) {
                if strips[next].1[1] > strips[best].1[1] {
                    best = next;
                }
                next += 1;
            }
            let (occluder, [start, end]) = strips[best];
            if end <= reached {
                continue;
            }
            let piece = [start.max(reached), end];
            let area = self.block.coverage.area(self.axis, lane, piece);
            if area > self.worth {
                cover.pieces.push(Piece {
                    occluder,
                    lane,
                    span: piece,
                });
                cover.area += area;
                covered.push(piece);
                reached = end;
            }
        }
        (cover, covered)
    }

    /// The shadows that can still matter in parts of the lane, those in use and those that reach
    /// beyond what is covered; and the street area within reach of any: no cover can serve more.
    fn useful<'s>(
        &self,
        lane: [f64; 2],
        shadows: &[&'s Shadow],
        own: &Cover,
        covered: &[[f64; 2]],
    ) -> (Vec<&'s Shadow>, f64) {
        let inside = |reach: [f64; 2]| {
            covered
                .iter()
                .any(|span| span[0] <= reach[0] && reach[1] <= span[1])
        };
        let used = |shadow: &Shadow| own.pieces.iter().any(|p| p.occluder == shadow.occluder);
        let (useful, reaches) = shadows
            .iter()
            .filter_map(|&s| Some((s, s.region.reach(self.axis, lane[0], lane[1])?)))
            .filter(|&(shadow, reach)| !inside(reach) || used(shadow))
            .unzip();
        (useful, self.area_of_union(lane, reaches))
    }

    /// Street area of a lane within any of some intervals.
    fn area_of_union(&self, lane: [f64; 2], mut spans: Vec<[f64; 2]>) -> f64 {
        spans.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]));
        spans.dedup_by(|next, last| {
            let joined = next[0] <= last[1];
            if joined {
                last[1] = last[1].max(next[1]);
            }
            joined
        });
        spans
            .into_iter()
            .map(|span| self.block.coverage.area(self.axis, lane, span))
            .sum()
    }
}
