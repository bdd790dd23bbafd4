//! [`eroded`], columns from which a border is taken away.

use geo::bool_ops::unary_union;
use geo::orient::Direction;
use geo::{
    Area, BooleanOps, BoundingRect, ConvexHull, Coord, Line, LineString, MultiPoint, MultiPolygon,
    Orient, Polygon,
};

use super::crack::cracks;
use super::simpler::simpler;
use crate::SolidColumn;

/// Metres by which more is taken away than was asked for, in plan and from above. It covers the
/// roundings of polygon overlays, which are made on a grid of a billionth of their extent.
const EROSION_MARGIN: f64 = 1e-3;

/// Columns that reach farther than this in plan, metres, are not eroded but left out: the grid of an
/// overlay would be too coarse for [`EROSION_MARGIN`].
const FARTHEST: f64 = 50_000.0;

/// Heights of a group that are told apart differ by more than this, metres: in between, columns count as a
/// little lower than they are.
const STEP: f64 = 0.2;

/// Most heights that are told apart.
const MOST_HEIGHTS: usize = 24;

/// Pieces with less area than this, square metres, hide next to nothing.
const LEAST_AREA: f64 = 1e-2;

/// Corners of what is left that stick out by no more than this share of the erosion are cut off: the
/// erosion of a slanted wall has many.
const DRAWN_IN: f64 = 0.05;

/// All points around which a square of edge `2 * half` metres lies in the union of grounded columns, or
/// a little less. Columns that are not grounded are left out, and heights stay as they are.
#[must_use]
pub fn eroded<'a>(
    columns: impl IntoIterator<Item = &'a SolidColumn>,
    half: f64,
) -> Vec<SolidColumn> {
    let mut grounded: Vec<&SolidColumn> = columns.into_iter().filter(|c| c.grounded).collect();
    grounded.sort_by(|a, b| b.top.total_cmp(&a.top));
    let bottom = grounded
        .iter()
        .map(|c| c.bottom)
        .fold(f64::INFINITY, f64::min);
    let cracks = cracks(grounded.iter().map(|column| &column.footprint));
    let mut left: Vec<SolidColumn> = Vec::new();
    let mut solid = MultiPolygon::new(Vec::new());
    let mut rest = &grounded[..];
    for height in heights(&grounded) {
        let count = rest.partition_point(|column| column.top >= height);
        let (higher, lower) = rest.split_at(count);
        rest = lower;
        for level in higher.chunk_by(|a, b| a.top == b.top) {
            let added = level.iter().map(|column| &column.footprint);
            solid = unary_union(solid.iter().chain(added));
        }
        let pieces = without_border(&solid, &cracks, half + EROSION_MARGIN);
        let pieces: Vec<Polygon> = pieces
            .into_iter()
            .filter(|piece| adds(piece, &left))
            .collect();
        left.extend(pieces.into_iter().map(|footprint| SolidColumn {
            footprint: simpler(&footprint.orient(Direction::Default), DRAWN_IN * half),
            bottom,
            top: height,
            grounded: true,
        }));
    }
    left
}

/// Some of the heights of columns, which come highest first: no column is much higher than the next of them
/// below it, unless there are too many.
fn heights(columns: &[&SolidColumn]) -> Vec<f64> {
    let mut heights: Vec<f64> = Vec::new();
    for column in columns.iter().rev() {
        if heights.last().is_none_or(|below| column.top - below > STEP) {
            heights.push(column.top);
        }
    }
    heights.reverse();
    let count = heights.len();
    if count <= MOST_HEIGHTS {
        return heights;
    }
    // The lowest is one of them, so that no column is lost.
    (1..=MOST_HEIGHTS)
        .map(|step| heights[step * count / MOST_HEIGHTS - 1])
        .collect()
}

/// Whether a piece is more than one that is there already and higher.
fn adds(piece: &Polygon, left: &[SolidColumn]) -> bool {
    let area = piece.unsigned_area();
    let bounds = piece.bounding_rect();
    area > LEAST_AREA
        && !left.iter().any(|column| {
            column.footprint.bounding_rect() == bounds
                && column.footprint.unsigned_area() >= area - LEAST_AREA
        })
}

/// What is left of polygons where no square around a point of their border, or of a crack, reaches.
fn without_border(solid: &MultiPolygon, cracks: &[Line], half: f64) -> MultiPolygon {
    let Some(bounds) = solid.bounding_rect() else {
        return MultiPolygon::new(Vec::new());
    };
    if !(..=FARTHEST).contains(&bounds.width().max(bounds.height())) {
        return MultiPolygon::new(Vec::new());
    }
    let rings = solid
        .iter()
        .flat_map(|polygon| std::iter::once(polygon.exterior()).chain(polygon.interiors()));
    let edges = rings
        .flat_map(LineString::lines)
        .chain(cracks.iter().copied());
    let border: Vec<Polygon> = edges.map(|edge| swept(&edge, half)).collect();
    solid.difference(&unary_union(&border))
}

/// All points of squares around those of an edge.
fn swept(edge: &Line, half: f64) -> Polygon {
    let corners: MultiPoint = [edge.start, edge.end]
        .into_iter()
        .flat_map(|Coord { x, y }| {
            [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
                .map(|(right, up)| (x + right * half, y + up * half))
        })
        .collect::<Vec<_>>()
        .into();
    corners.convex_hull()
}

#[cfg(test)]
mod tests {
    use geo::{Rect, coord};

    use super::*;

    fn column([x, y]: [f64; 2], [far_x, far_y]: [f64; 2], top: f64) -> SolidColumn {
        SolidColumn {
            footprint: Rect::new(coord! { x: x, y: y }, coord! { x: far_x, y: far_y })
                .to_polygon()
                .orient(Direction::Default),
            bottom: 0.0,
            top,
            grounded: true,
        }
    }

    fn areas(columns: &[SolidColumn]) -> Vec<(f64, f64)> {
        let area =
            |column: &SolidColumn| (column.footprint.unsigned_area() * 100.0).round() / 100.0;
        columns
            .iter()
            .map(|column| (column.top, area(column)))
            .collect()
    }

    #[test]
    fn houses_that_touch_are_eroded_as_one() {
        let place = [85_000.0, 447_000.0];
        let at = |x: f64, y: f64| [place[0] + x, place[1] + y];
        let row = [
            column(at(0.0, 0.0), at(6.0, 10.0), 9.0),
            column(at(6.0, 0.0), at(12.0, 10.0), 7.0),
        ];
        // 2 m less on each side, and a millimetre.
        let both = (7.0, 47.97);
        assert_eq!(areas(&eroded(&row, 2.0)), [(9.0, 11.98), both]);
        assert_eq!(areas(&eroded(&row[..1], 2.0)), [(9.0, 11.98)]);
        assert_eq!(areas(&eroded(&row, 4.0)), [(7.0, 7.99)]);
        assert_eq!(areas(&eroded(&row, 6.0)), []);
    }

    #[test]
    fn a_courtyard_grows() {
        let outer = column([0.0, 0.0], [30.0, 30.0], 8.0);
        let mut hollow = outer.clone();
        let yard = column([10.0, 10.0], [20.0, 20.0], 8.0);
        hollow
            .footprint
            .interiors_push(yard.footprint.exterior().clone());
        hollow.footprint = hollow.footprint.orient(Direction::Default);
        assert_eq!(areas(&eroded([&hollow], 1.0)), [(8.0, 639.84)]);
        assert_eq!(areas(&eroded([&hollow, &yard], 1.0)), [(8.0, 783.89)]);
    }

    #[test]
    fn what_is_lower_counts_where_nothing_higher_is() {
        let parts = [
            column([0.0, 0.0], [20.0, 20.0], 3.0),
            column([5.0, 5.0], [15.0, 15.0], 9.0),
        ];
        let found = areas(&eroded(&parts, 1.0));
        assert_eq!(found, [(9.0, 63.97), (3.0, 323.93)]);
    }
}
