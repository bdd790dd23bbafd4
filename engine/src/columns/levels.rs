//! [`levels`], the heights at which columns may start and end.
//!
//! With A(z) the area of roofs at z or above, levels z1 < z2 < … let columns from z0 cover
//! Σ A(zᵢ)(zᵢ − zᵢ₋₁). The best levels for a price each are found by dynamic programming over
//! candidates. Undersides are roofs seen upside down.

use super::facets::{Facet, Facets};
use crate::GROUND_TOLERANCE;

/// Most levels for roofs, and for undersides; each is cut through every slope. The price of a level
/// rises until they are no more.
const MOST: usize = 24;

/// Candidates that divide the height of the solid evenly, for slopes.
const EVEN: usize = 64;

/// Most candidates at heights of vertices. Those that lie closest together share one.
const MOST_CORNERS: usize = 192;

/// Heights closer than this share a candidate, metres: doubled until they are few enough.
const GAP: f64 = 0.002;

/// Ascending heights, the first of them the foot: that of the faces that look down, within
/// [`GROUND_TOLERANCE`] of the lowest vertex. `[low, high]` is the height range of the mesh, and a
/// level that adds less than `least_gain` of volume is not worth its time.
pub fn levels(facets: &Facets, [low, high]: [f64; 2], least_gain: f64) -> Vec<f64> {
    let broad = |faces: i32| {
        let facets = facets.list.iter();
        facets.filter(move |facet| facet.is_broad && facet.faces == faces)
    };
    let undersides = || broad(-1).map(|facet| facet.corners.map(|corner| corner.z));
    let feet = undersides()
        .flatten()
        .filter(|&z| z <= low + GROUND_TOLERANCE);
    let foot = feet.fold(low, f64::max);
    let roofs: Vec<Slope> = broad(1).map(|facet| Slope::new(facet, 1.0)).collect();
    let undersides = broad(-1).filter(|facet| facet.heights()[1] > foot);
    let undersides: Vec<Slope> = undersides.map(|facet| Slope::new(facet, -1.0)).collect();
    let mut levels = steps(&roofs, [foot, high], least_gain);
    let bottoms = steps(&undersides, [-high, -foot], least_gain);
    levels.extend(bottoms.into_iter().map(|z| -z));
    levels.push(foot);
    levels.sort_unstable_by(f64::total_cmp);
    levels.dedup();
    levels
}

/// The heights of a facet at its corners, ascending, and its area in plan.
struct Slope {
    heights: [f64; 3],
    area: f64,
}

impl Slope {
    /// The facet with heights times `sign`.
    fn new(facet: &Facet, sign: f64) -> Self {
        let mut heights = facet.corners.map(|corner| sign * corner.z);
        heights.sort_unstable_by(f64::total_cmp);
        Self {
            heights,
            area: facet.area,
        }
    }

    /// The area at a height or above.
    fn area_above(&self, height: f64) -> f64 {
        let [low, middle, high] = self.heights;
        if height <= low {
            self.area
        } else if height > high {
            0.0
        } else if height <= middle {
            // What is below is similar to the part up to the middle corner.
            let below = (height - low).powi(2) / ((middle - low) * (high - low));
            self.area * (1.0 - below)
        } else {
            self.area * (high - height).powi(2) / ((high - middle) * (high - low))
        }
    }
}

/// The best steps of a staircase from `from` up, under the slopes.
fn steps(slopes: &[Slope], [from, to]: [f64; 2], least_gain: f64) -> Vec<f64> {
    let mut heights = candidates(slopes, [from, to]);
    let areas: Vec<f64> = heights
        .iter()
        .map(|&z| slopes.iter().map(|slope| slope.area_above(z)).sum())
        .collect();
    let mut price = least_gain;
    loop {
        let chosen = best_steps(&heights, &areas, from, price);
        if chosen.len() <= MOST || !price.is_finite() {
            heights = chosen.into_iter().map(|i| heights[i]).collect();
            return heights;
        }
        price = (2.0 * price).max(f64::MIN_POSITIVE);
    }
}

/// Ascending heights above `from`: of corners that lie close together the lowest, so that a roof
/// covers all up to there, and even steps.
fn candidates(slopes: &[Slope], [from, to]: [f64; 2]) -> Vec<f64> {
    let mut corners: Vec<f64> = slopes.iter().flat_map(|slope| slope.heights).collect();
    corners.retain(|&z| z > from);
    corners.sort_unstable_by(f64::total_cmp);
    let mut gap = GAP;
    loop {
        corners.dedup_by(|next, last| *next - *last <= gap);
        if corners.len() <= MOST_CORNERS || !gap.is_finite() {
            break;
        }
        gap *= 2.0;
    }
    if slopes
        .iter()
        .any(|slope| slope.heights[0] < slope.heights[2])
    {
        let step = (to - from) / EVEN as f64;
        corners.extend((1..EVEN).map(|i| from + step * i as f64));
        corners.sort_unstable_by(f64::total_cmp);
    }
    corners
}

/// Which heights to step to from `from`, so that the volume less the price of each is greatest.
fn best_steps(heights: &[f64], areas: &[f64], from: f64, price: f64) -> Vec<usize> {
    // The greatest worth of steps that end at each height, and the step before.
    let mut best: Vec<(f64, Option<usize>)> = Vec::with_capacity(heights.len());
    for (i, (&height, &area)) in heights.iter().zip(areas).enumerate() {
        let first = (area * (height - from) - price, None);
        let later = (0..i).map(|j| (best[j].0 + area * (height - heights[j]) - price, Some(j)));
        let greatest = later.fold(first, |a, b| if b.0 > a.0 { b } else { a });
        best.push(greatest);
    }
    let last = (0..best.len()).max_by(|&i, &j| best[i].0.total_cmp(&best[j].0));
    let mut chosen = Vec::new();
    let mut at = last.filter(|&i| best[i].0 > 0.0);
    while let Some(i) = at {
        chosen.push(i);
        at = best[i].1;
    }
    chosen
}
