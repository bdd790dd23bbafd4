//! [`levels`], the heights at which columns may start and end.

use super::facets::{Facet, Facets};
use crate::GROUND_TOLERANCE;

/// Most levels of a mesh; each is cut through every slope. More win less than 0.1 % of volume on
/// real roofs, for time in proportion.
const MOST: usize = 24;

/// Steps into which the height of the solid is divided where it slopes.
const STEPS: f64 = 16.0;

/// Slopes are not divided into steps lower than this, metres.
const LEAST_STEP: f64 = 0.25;

/// Heights closer than this share a level, metres; doubled until few enough levels are left.
const GAP: f64 = 0.02;

/// Ascending heights, the first of them the foot: that of the faces that look down, within
/// [`GROUND_TOLERANCE`] of the lowest vertex. `[low, high]` is the height range of the mesh.
///
/// Of heights that lie close together, a roof's level is the lowest, so that it is solid up to
/// there, and an underside's the greatest.
pub fn levels(facets: &Facets, [low, high]: [f64; 2]) -> Vec<f64> {
    let broad = || facets.list.iter().filter(|facet| facet.is_broad);
    let heights = |faces: i32| {
        let facets = broad().filter(move |facet| facet.faces == faces);
        let mut heights: Vec<f64> = facets.flat_map(|f| f.corners.map(|c| c.z)).collect();
        heights.sort_unstable_by(f64::total_cmp);
        heights
    };
    let (roofs, mut undersides) = (heights(1), heights(-1));
    let feet = undersides.partition_point(|&z| z <= low + GROUND_TOLERANCE);
    let foot = undersides[..feet].last().copied().unwrap_or(low);
    undersides.drain(..feet);
    undersides.reverse();
    let slopes: Vec<[f64; 2]> = broad().map(Facet::heights).filter(|[a, b]| a < b).collect();
    let mut gap = GAP;
    loop {
        let corners = clustered(&roofs, gap).chain(clustered(&undersides, gap));
        let mut levels: Vec<f64> = corners.filter(|&z| z > foot).chain([foot]).collect();
        levels.sort_unstable_by(f64::total_cmp);
        levels.dedup();
        divide(
            &mut levels,
            &slopes,
            LEAST_STEP.max((high - foot) / STEPS).max(gap),
        );
        if levels.len() <= MOST || !gap.is_finite() {
            return levels;
        }
        gap *= 2.0;
    }
}

/// The first of each run of heights that lies within `gap` of it.
fn clustered(heights: &[f64], gap: f64) -> impl Iterator<Item = f64> {
    let mut last: Option<f64> = None;
    heights.iter().copied().filter(move |&z| {
        let is_first = last.is_none_or(|last| (z - last).abs() > gap);
        if is_first {
            last = Some(z);
        }
        is_first
    })
}

/// Adds levels between those that a slope spans, at most `step` apart.
fn divide(levels: &mut Vec<f64>, slopes: &[[f64; 2]], step: f64) {
    let mut between = Vec::new();
    for pair in levels.windows(2) {
        let (from, to) = (pair[0], pair[1]);
        let count = ((to - from) / step).ceil().min(STEPS);
        if count > 1.0 && slopes.iter().any(|&[low, high]| low < to && high > from) {
            let steps = (1..count as usize).map(|i| from + (to - from) * i as f64 / count);
            between.extend(steps);
        }
    }
    levels.extend(between);
    levels.sort_unstable_by(f64::total_cmp);
}
