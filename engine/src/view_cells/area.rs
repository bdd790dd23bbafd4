//! [`plan_of_boxes`], the plan of view cells as polygons.

use geo::bool_ops::unary_union;
use geo::orient::Direction;
use geo::{Coord, LineString, MapCoords, Orient, Polygon, Rect};
use glam::DVec3;

use crate::Box3d;

/// What boxes cover of the plan: polygons that have no more than corners in common, with the corners of the
/// boxes, outer rings anticlockwise and holes clockwise.
#[must_use]
pub fn plan_of_boxes(boxes: &[Box3d]) -> Vec<Polygon> {
    let place = |corner: DVec3| Coord {
        x: corner.x,
        y: corner.y,
    };
    let rectangles: Vec<Polygon> = boxes
        .iter()
        .map(|bounds| Rect::new(place(bounds.min), place(bounds.max)).to_polygon())
        .collect();
    let edges = [0, 1].map(|axis| {
        let ends = boxes
            .iter()
            .flat_map(|bounds| [bounds.min[axis], bounds.max[axis]]);
        let mut edges: Vec<f64> = ends.collect();
        edges.sort_unstable_by(f64::total_cmp);
        edges
    });
    let union = unary_union(&rectangles).into_iter();
    let whole = union.map(|polygon| {
        // An overlay rounds places to a grid.
        let placed = polygon.map_coords(|Coord { x, y }| Coord {
            x: nearest(&edges[0], x),
            y: nearest(&edges[1], y),
        });
        without_middles(&placed).orient(Direction::Default)
    });
    whole.collect()
}

/// Of sorted numbers, the one nearest to another.
fn nearest(sorted: &[f64], to: f64) -> f64 {
    let next = sorted.partition_point(|&number| number < to);
    let around = [next.saturating_sub(1), next.min(sorted.len() - 1)].map(|at| sorted[at]);
    match to - around[0] < around[1] - to {
        true => around[0],
        false => around[1],
    }
}

/// The polygon without corners in the middle of upright or level sides.
fn without_middles(polygon: &Polygon) -> Polygon {
    let ring = |ring: &LineString| {
        let corners = &ring.0[1..];
        let is_turn = |at: &usize| {
            let [before, here, after] =
                [corners.len() - 1, 0, 1].map(|step| corners[(at + step) % corners.len()]);
            !(before.x == here.x && here.x == after.x || before.y == here.y && here.y == after.y)
        };
        let kept = (0..corners.len()).filter(is_turn).map(|at| corners[at]);
        kept.collect::<LineString>()
    };
    Polygon::new(
        ring(polygon.exterior()),
        polygon.interiors().iter().map(ring).collect(),
    )
}

#[cfg(test)]
mod tests {
    use geo::Area;

    use super::*;

    fn cell(x: f64, y: f64) -> Box3d {
        let min = DVec3::new(85_000.1 + x, 447_000.3 + y, 1.5);
        Box3d::new(min, min + DVec3::new(4.0, 4.0, 0.5))
    }

    #[test]
    fn boxes_that_touch_make_one_polygon_with_their_corners() {
        let boxes = [cell(0.0, 0.0), cell(4.0, 0.0), cell(8.0, 0.0)];
        let row = plan_of_boxes(&boxes);
        assert_eq!(row.len(), 1);
        assert_eq!(row[0].exterior().0.len(), 5);
        let far = boxes[2].max;
        assert!(row[0].exterior().0.contains(&Coord { x: far.x, y: far.y }));
        assert_eq!(plan_of_boxes(&[]), []);
    }

    #[test]
    fn courtyards_are_holes_and_boxes_apart_are_polygons_of_their_own() {
        let places = (0..9).filter(|at| *at != 4);
        let ring = places.map(|at| cell(4.0 * f64::from(at % 3), 4.0 * f64::from(at / 3)));
        let boxes: Vec<Box3d> = ring.chain([cell(40.0, 0.0)]).collect();
        let mut areas: Vec<(usize, f64)> = plan_of_boxes(&boxes)
            .iter()
            .map(|polygon| (polygon.interiors().len(), polygon.signed_area().round()))
            .collect();
        areas.sort_by(|a, b| a.1.total_cmp(&b.1));
        assert_eq!(areas, [(0, 16.0), (1, 128.0)]);
    }
}
