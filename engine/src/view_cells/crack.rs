//! Cracks: gaps so narrow that a polygon overlay may close them.

use std::cmp::Ordering;

use geo::{Line, LinesIter, Polygon};
use glam::DVec2;
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

use crate::predicates::turn;

/// Gaps narrower than this share of the extent of what is overlaid may be closed: some steps of the
/// grid of an overlay.
const WIDTH: f64 = 16.0 / (1 << 30) as f64;

/// Edges of polygons along which there may be a crack: those that a corner nearly touches, from outside.
/// A corner exactly on an edge leaves no gap, and none is within it.
pub fn cracks<'a>(polygons: impl IntoIterator<Item = &'a Polygon>) -> Vec<Line> {
    let edges: Vec<Line> = polygons
        .into_iter()
        .flat_map(LinesIter::lines_iter)
        .collect();
    let entry = |(at, edge): (usize, &Line)| {
        let ends = [edge.start, edge.end].map(|end| [end.x, end.y]);
        GeomWithData::new(Rectangle::from_corners(ends[0], ends[1]), at)
    };
    let index = RTree::bulk_load(edges.iter().enumerate().map(entry).collect());
    let bounds = index.root().envelope();
    let [low, high] = [bounds.lower(), bounds.upper()];
    let width = WIDTH * (high[0] - low[0]).max(high[1] - low[1]);
    let mut cracks: Vec<Line> = edges
        .iter()
        .flat_map(|edge| {
            let [x, y] = [edge.start.x, edge.start.y];
            let near = AABB::from_corners([x - width, y - width], [x + width, y + width]);
            let near = index.locate_in_envelope_intersecting(near);
            let edges = near.map(|entry| edges[entry.data]);
            edges.filter(move |edge| nearly_touches(DVec2::new(x, y), edge, width))
        })
        .collect();
    cracks.sort_unstable_by(|a, b| order(a).partial_cmp(&order(b)).unwrap_or(Ordering::Equal));
    cracks.dedup();
    cracks
}

fn order(edge: &Line) -> [f64; 4] {
    [edge.start.x, edge.start.y, edge.end.x, edge.end.y]
}

/// Whether a corner is near an edge of a ring whose inside is to the left, and neither on it nor inside.
fn nearly_touches(corner: DVec2, edge: &Line, width: f64) -> bool {
    let [from, to] = [edge.start, edge.end].map(|end| DVec2::new(end.x, end.y));
    if corner == from || corner == to {
        return false;
    }
    let along = to - from;
    let share = (corner - from).dot(along) / along.length_squared();
    let is_inside = (0.0..=1.0).contains(&share) && turn(from, to, corner) >= 0.0;
    let nearest = from + along * share.clamp(0.0, 1.0);
    !is_inside && corner.distance(nearest) <= width
}

#[cfg(test)]
mod tests {
    use geo::{Rect, coord};

    use super::*;

    fn rectangle([x, y]: [f64; 2], [far_x, far_y]: [f64; 2]) -> Polygon {
        Rect::new(coord! { x: x, y: y }, coord! { x: far_x, y: far_y }).to_polygon()
    }

    fn count(second: Polygon) -> usize {
        let first = rectangle([85_000.0, 447_000.0], [85_010.0, 447_010.0]);
        cracks([&first, &second]).len()
    }

    #[test]
    fn a_gap_below_the_grid_is_a_crack_and_a_common_wall_is_none() {
        let beside = |gap: f64| rectangle([85_010.0 + gap, 447_002.0], [85_020.0, 447_006.0]);
        assert_eq!(count(beside(0.0)), 0);
        // Of the first house the wall that two corners nearly touch.
        assert_eq!(count(beside(1e-9)), 1);
        assert_eq!(count(beside(-1e-9)), 0);
        assert_eq!(count(beside(1e-3)), 0);
        // Corners that nearly touch: of each house the wall with the gap, and two that end at it.
        assert!(
            count(rectangle(
                [85_010.0 + 1e-9, 447_000.0],
                [85_020.0, 447_010.0]
            )) >= 2
        );
        assert_eq!(
            count(rectangle([85_010.0, 447_000.0], [85_020.0, 447_010.0])),
            0
        );
    }
}
