//! [`streets_from_surfaces`], the view region of a scene with streets.

use geo::{BoundingRect, MultiPolygon, Polygon, unary_union};
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

use super::footprint::footprint;
use super::site::{Site, SiteIndex};
use super::street::Street;
use super::tiling::{ViewRegionOptions, tile_by_tile, within};
use crate::TriangleMesh;

/// The streets that road surfaces cover: their union seen from above, cut into tiles, each with an
/// eye band from the feet of the sites nearby.
///
/// Outer rings turn anticlockwise, holes clockwise; slivers are dropped. Without sites the ground
/// is not known, and there is nothing to see: the answer is empty.
#[must_use]
pub fn streets_from_surfaces(
    surfaces: &[TriangleMesh],
    sites: &[Site],
    options: &ViewRegionOptions,
) -> Vec<Street> {
    let pieces: Vec<Polygon<f64>> = surfaces.iter().flat_map(footprint).collect();
    let Some(extent) = MultiPolygon::new(pieces.clone()).bounding_rect() else {
        return Vec::new();
    };
    let entries = pieces.iter().enumerate().filter_map(|(number, piece)| {
        let rect = piece.bounding_rect()?;
        let corners =
            Rectangle::from_corners([rect.min().x, rect.min().y], [rect.max().x, rect.max().y]);
        Some(GeomWithData::new(corners, number))
    });
    let tree = RTree::bulk_load(entries.collect());
    tile_by_tile(extent, &SiteIndex::new(sites), options, |tile| {
        let window = AABB::from_corners([tile.min().x, tile.min().y], [tile.max().x, tile.max().y]);
        let near = tree.locate_in_envelope_intersecting(window);
        within(tile, &unary_union(near.map(|entry| &pieces[entry.data])))
    })
}
