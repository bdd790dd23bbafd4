//! [`Block`], streets computed together.

use super::coverage::Coverage;
use crate::{Box3d, Street};
use geo::BoundingRect;
use glam::{DVec2, DVec3};

/// Metres of relief that one block may span: a volume covers the whole height band of its block,
/// so more relief would loosen it, and less would cut it up.
const MOST_RELIEF: f64 = 0.75;

/// Metres below which a block is not split for its relief.
const LEAST_SIDE: f64 = 60.0;

/// Metres above which a block is always split, to bound its raster.
const MOST_SIDE: f64 = 1500.0;

/// A group of streets with one height band of eyes.
#[derive(Debug)]
pub struct Block {
    /// The plan rectangle around the streets: least and greatest corner, metres.
    pub window: [DVec2; 2],
    /// Lowest and highest eye, metres.
    pub band: [f64; 2],
    /// Where in the window the streets are.
    pub(super) coverage: Coverage,
}

impl Block {
    /// Groups streets into blocks; `cell` is the width in metres to which lanes will be cut.
    #[must_use]
    pub fn group(streets: &[Street], cell: f64) -> Vec<Self> {
        let mut blocks = Vec::new();
        let mut waiting = vec![streets.iter().collect::<Vec<_>>()];
        while let Some(group) = waiting.pop() {
            let Some(window) = window(&group) else {
                continue;
            };
            match split(&group, window) {
                Some(parts) => waiting.extend(parts),
                None => blocks.push(Self {
                    window,
                    band: band(&group),
                    coverage: Coverage::new(&group, window, cell),
                }),
            }
        }
        blocks
    }

    /// The box that holds every eye of the block.
    #[must_use]
    pub fn eyes(&self) -> Box3d {
        let [min, max] = self.window;
        Box3d {
            min: min.extend(self.band[0]),
            max: max.extend(self.band[1]),
        }
    }

    /// The axis-aligned box over the streets in a lane's interval: `span` along `axis`, `lane`
    /// across.
    pub(super) fn volume(&self, axis: usize, lane: [f64; 2], span: [f64; 2]) -> Option<Box3d> {
        let span = self.coverage.trimmed(axis, lane, span)?;
        let corner = |i: usize| match axis {
            0 => DVec3::new(span[i], lane[i], self.band[i]),
            _ => DVec3::new(lane[i], span[i], self.band[i]),
        };
        Some(Box3d {
            min: corner(0),
            max: corner(1),
        })
    }
}

/// The rectangle around all streets of a group.
fn window(group: &[&Street]) -> Option<[DVec2; 2]> {
    group
        .iter()
        .filter_map(|street| street.area.bounding_rect())
        .map(|r| {
            [
                DVec2::new(r.min().x, r.min().y),
                DVec2::new(r.max().x, r.max().y),
            ]
        })
        .reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])
}

/// Lowest and highest eye of a group.
fn band(group: &[&Street]) -> [f64; 2] {
    group
        .iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], street| {
            [low.min(street.eye_low), high.max(street.eye_high)]
        })
}

/// The two parts of a group that is too large or too uneven, if it can be parted: streets whose own
/// band is far from usual go apart, so as not to loosen the volumes of the others.
fn split<'a>(group: &[&'a Street], [min, max]: [DVec2; 2]) -> Option<[Vec<&'a Street>; 2]> {
    let height = |street: &Street| street.eye_high - street.eye_low;
    let mut heights: Vec<f64> = group.iter().map(|street| height(street)).collect();
    heights.sort_by(f64::total_cmp);
    let usual = heights[heights.len() / 2] + MOST_RELIEF;
    let (tall, others): (Vec<_>, Vec<_>) = group.iter().partition(|s| height(s) > usual);
    if !tall.is_empty() {
        return Some([tall, others]);
    }
    let [low, high] = band(group);
    let tallest = heights[heights.len() - 1];
    let side = (max - min).max_element();
    let hilly = high - low > tallest + MOST_RELIEF && side > LEAST_SIDE;
    if !hilly && side <= MOST_SIDE {
        return None;
    }
    let axis = usize::from(max.y - min.y > max.x - min.x);
    let middle = |street: &Street| {
        street.area.bounding_rect().map_or(0.0, |r| {
            if axis == 0 {
                r.center().x
            } else {
                r.center().y
            }
        })
    };
    let cut = (min[axis] + max[axis]) / 2.0;
    let (left, right): (Vec<_>, Vec<_>) = group.iter().partition(|s| middle(s) < cut);
    (!left.is_empty() && !right.is_empty()).then_some([left, right])
}
