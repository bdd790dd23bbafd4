//! Cuts areas into tiles, so that each piece is small and has a ground of its own.

use geo::orient::Direction;
use geo::{Area, BooleanOps, Coord, Euclidean, Length, MultiPolygon, Orient, Polygon, Rect};

use super::site::SiteIndex;
use super::street::Street;

/// Pieces and holes with less area are dropped, square metres.
const SLIVER_AREA: f64 = 0.01;

/// Pieces narrower than this on average are dropped, metres: nobody stands in the gap between two
/// row houses, and an eye outside the view region is answered from the live kernel.
const SLIVER_WIDTH: f64 = 0.1;

/// The most tiles a side. An extent that would need more gets larger tiles, so that one stray
/// feature at the origin of the frame cannot ask for millions of them.
const MOST_TILES: f64 = 1000.0;

/// How the view region is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewRegionOptions {
    /// Side of the square tiles in metres.
    pub tile: f64,
    /// Lowest eye above the lowest ground nearby, metres.
    pub eye_low: f64,
    /// Highest eye above the highest ground nearby, metres.
    pub eye_high: f64,
}

impl Default for ViewRegionOptions {
    fn default() -> Self {
        Self {
            tile: 50.0,
            eye_low: 1.5,
            eye_high: 2.0,
        }
    }
}

/// Cuts what `area_of` finds in each tile of `extent` into streets, with the eye band of the tile.
/// Tiles lie on whole multiples of their size, so neighbouring extents share them.
pub fn tile_by_tile(
    extent: Rect<f64>,
    index: &SiteIndex,
    options: &ViewRegionOptions,
    area_of: impl Fn(&Rect<f64>) -> MultiPolygon<f64>,
) -> Vec<Street> {
    let mut streets = Vec::new();
    for tile in tiles(extent, options.tile) {
        let area = area_of(&tile);
        let Some([low, high]) = index.ground(&tile) else {
            continue;
        };
        let street = |area| Street {
            area,
            eye_low: low + options.eye_low,
            eye_high: high + options.eye_high,
        };
        streets.extend(area.into_iter().filter_map(without_slivers).map(street));
    }
    streets
}

/// The part of `area` in the tile.
pub fn within(tile: &Rect<f64>, area: &impl BooleanOps<Scalar = f64>) -> MultiPolygon<f64> {
    tile.to_polygon().intersection(area)
}

fn tiles(extent: Rect<f64>, size: f64) -> impl Iterator<Item = Rect<f64>> {
    let longest = extent.width().max(extent.height());
    let least = longest / MOST_TILES;
    // A size that is zero, negative or NaN asks for the least.
    let size = if size >= least { size } else { least };
    let first = |low: f64| (low / size).floor();
    let count = |low: f64, high: f64| ((high / size).ceil() - first(low)).max(1.0) as usize;
    let (left, bottom) = (first(extent.min().x), first(extent.min().y));
    let columns = count(extent.min().x, extent.max().x);
    let rows = count(extent.min().y, extent.max().y);
    let place = move |column: usize, row: usize| Coord {
        x: (left + column as f64) * size,
        y: (bottom + row as f64) * size,
    };
    (0..columns)
        .flat_map(move |column| (0..rows).map(move |row| (column, row)))
        .map(move |(column, row)| Rect::new(place(column, row), place(column + 1, row + 1)))
}

/// The polygon with its rings in order, without tiny holes; `None` when it is itself a sliver.
pub fn without_slivers(polygon: Polygon<f64>) -> Option<Polygon<f64>> {
    let area = polygon.unsigned_area();
    let border = Euclidean.length(polygon.exterior());
    // Mean width of something long: area over half of its border.
    if area < SLIVER_AREA || area < SLIVER_WIDTH * border / 2.0 {
        return None;
    }
    let (outer, holes) = polygon.into_inner();
    let ring_area =
        |ring: &geo::LineString<f64>| Polygon::new(ring.clone(), vec![]).unsigned_area();
    let holes = holes
        .into_iter()
        .filter(|hole| ring_area(hole) >= SLIVER_AREA)
        .collect();
    Some(Polygon::new(outer, holes).orient(Direction::Default))
}
