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

/// Steps in a metre of the grid on which what is taken away ends: walls that nearly coincide, as those of neighbours
/// in rounded data do, take away the same. The overlay of many that nearly do may take for ever.
const GRID: f64 = 1024.0;

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

/// All points of squares around those of an edge, and some more: the squares end on a grid.
fn swept(edge: &Line, half: f64) -> Polygon {
    let low = |value: f64| ((value - half) * GRID).floor() / GRID;
    let high = |value: f64| ((value + half) * GRID).ceil() / GRID;
    let corners: MultiPoint = [edge.start, edge.end]
        .into_iter()
        .flat_map(|Coord { x, y }| {
            let ([west, east], [south, north]) = ([low(x), high(x)], [low(y), high(y)]);
            [(west, south), (east, south), (east, north), (west, north)]
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
        // 2 m less on each side, and two millimetres.
        let both = (7.0, 47.95);
        assert_eq!(areas(&eroded(&row, 2.0)), [(9.0, 11.97), both]);
        assert_eq!(areas(&eroded(&row[..1], 2.0)), [(9.0, 11.97)]);
        assert_eq!(areas(&eroded(&row, 4.0)), [(7.0, 7.98)]);
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
        assert_eq!(areas(&eroded([&hollow], 1.0)), [(8.0, 639.69)]);
        assert_eq!(areas(&eroded([&hollow, &yard], 1.0)), [(8.0, 783.78)]);
    }

    #[test]
    fn what_is_lower_counts_where_nothing_higher_is() {
        let parts = [
            column([0.0, 0.0], [20.0, 20.0], 3.0),
            column([5.0, 5.0], [15.0, 15.0], 9.0),
        ];
        let found = areas(&eroded(&parts, 1.0));
        assert_eq!(found, [(9.0, 63.94), (3.0, 323.86)]);
    }

    /// Stepped columns of two houses, with coordinates rounded to 10 µm before the steps were found.
    fn rounded_steps() -> Vec<SolidColumn> {
        let steps: Vec<(f64, Vec<[f64; 2]>)> = vec![
            (
                11.953125000000002,
                vec![
                    [124.7815858827155, -125.81398929064015],
                    [126.76235279064225, -124.86666561728524],
                    [123.21743850786042, -117.454567571476],
                    [121.23667159993369, -118.40189124483092],
                ],
            ),
            (
                12.351562500000002,
                vec![
                    [125.2767788827155, -125.57715697814015],
                    [126.26715872814225, -125.10349686728524],
                    [122.72224475103336, -117.69139946061074],
                    [121.73186490560661, -118.16505957146565],
                ],
            ),
            (
                8.625,
                vec![
                    [121.11133000000001, -127.56933999999998],
                    [124.9248, -135.54297],
                    [134.24609, -131.08496],
                    [130.43262, -123.11132999999998],
                ],
            ),
            (
                9.253906250000002,
                vec![
                    [122.36531643941929, -128.41941531461924],
                    [125.61447527426068, -135.2131203549779],
                    [133.55641275387492, -131.41480094816882],
                    [132.99210356058072, -130.2348832056013],
                    [129.74294515146, -123.44117905538718],
                    [121.8010076718467, -127.23949846219578],
                ],
            ),
            (
                9.656250000000002,
                vec![
                    [123.1675539026546, -128.9632534212369],
                    [126.05569489742246, -135.00210194505144],
                    [133.11519407740434, -131.6258184114041],
                    [132.18986609734543, -129.69104415229248],
                    [129.30172580065374, -123.65219708809379],
                    [122.24222662067335, -127.02848062174036],
                ],
            ),
            (
                10.058593750000002,
                vec![
                    [123.96979136588988, -129.50709152785456],
                    [126.49691452058421, -134.79108353512495],
                    [132.67397540093376, -131.8368358746394],
                    [131.38762863411014, -129.14720509898365],
                    [128.86050644984743, -123.86321512080042],
                    [122.6834455695, -126.81746278128495],
                ],
            ),
            (
                10.460937500000002,
                vec![
                    [124.77202882912518, -130.0509296344722],
                    [126.93813414374598, -134.58006512519847],
                    [132.23275672446317, -132.04785333787473],
                    [130.58539117087486, -128.60336604567485],
                    [128.41928709904116, -124.07423315350704],
                    [123.12466451832665, -126.60644494082953],
                ],
            ),
            (
                10.863281250000002,
                vec![
                    [125.57426629236048, -130.59476774108984],
                    [127.37935376690774, -134.369046715272],
                    [131.7915380479926, -132.25887080111],
                    [129.78315370763954, -128.05952699236602],
                    [127.97806774823488, -124.28525118621366],
                    [123.56588346715328, -126.39542710037412],
                ],
            ),
            (
                11.265625000000002,
                vec![
                    [126.37650375559576, -131.13860584770748],
                    [127.82057339006951, -134.15802830534554],
                    [131.350319371522, -132.4698882643453],
                    [128.98091624440426, -127.51568793905719],
                    [127.53684839742859, -124.49626921892029],
                    [124.00710241597993, -126.1844092599187],
                ],
            ),
            (
                11.667968750000002,
                vec![
                    [127.17874121883105, -131.68244395432512],
                    [128.26179301323128, -133.94700989541906],
                    [130.9091006950514, -132.68090572758058],
                    [128.17867878116897, -126.97184888574837],
                    [127.0956290466223, -124.70728725162692],
                    [124.44832136480659, -125.97339141946325],
                ],
            ),
        ];
        let column = |(top, ring): (f64, Vec<[f64; 2]>)| SolidColumn {
            footprint: Polygon::new(ring.into(), Vec::new()).orient(Direction::Default),
            bottom: 0.0,
            top,
            grounded: true,
        };
        steps.into_iter().map(column).collect()
    }

    #[test]
    fn walls_that_nearly_coincide_are_eroded_soon() {
        let (send, receive) = std::sync::mpsc::channel();
        // In a thread of its own: an overlay that does not end would keep the test from failing.
        std::thread::spawn(move || {
            let columns = rounded_steps();
            let counts = [2.0, 1.0, 0.5].map(|half| eroded(&columns, half).len());
            send.send(counts)
        });
        let patience = std::time::Duration::from_secs(60);
        let counts = receive.recv_timeout(patience).expect("it ends");
        assert!(counts.iter().all(|&count| count > 0), "{counts:?}");
    }
}
