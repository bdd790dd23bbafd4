//! [`open_space`], the view region of a scene without streets.

use geo::{BooleanOps, BoundingRect, Polygon, unary_union};

use super::footprint::hull;
use super::site::{Site, SiteIndex};
use super::street::Street;
use super::tiling::{ViewRegionOptions, tile_by_tile, within};

/// The open space between features: the convex hull of all footprints less the footprints, cut
/// into tiles of their own eye bands.
///
/// Outer rings turn anticlockwise, holes clockwise; slivers are dropped. Sites without a finite
/// footprint are left out; without sites there is no open space.
#[must_use]
pub fn open_space(sites: &[Site], options: &ViewRegionOptions) -> Vec<Street> {
    let index = SiteIndex::new(sites);
    let Some(hull) = hull(index.all().flat_map(|site| &site.footprint)) else {
        return Vec::new();
    };
    let Some(extent) = hull.bounding_rect() else {
        return Vec::new();
    };
    tile_by_tile(extent, &index, options, |tile| {
        let ground = within(tile, &hull);
        let built: Vec<&Polygon<f64>> = index
            .near(tile, 0.0)
            .flat_map(|site| &site.footprint)
            .collect();
        if built.is_empty() {
            ground
        } else {
            ground.difference(&unary_union(built))
        }
    })
}
