//! [`Site`], a feature as the view region sees it, and the ground that sites imply.

use geo::{BoundingRect, CoordsIter, MultiPolygon, Rect};
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

/// Sites this near to a place tell its ground, metres.
const NEARBY: f64 = 50.0;

/// With no site nearby, so many of the nearest ones tell the ground.
const NEAREST: usize = 4;

/// Share of feet left out at each end of the ground's range: a basement, a bridge or a part on a
/// roof is not the ground.
const OUTLIERS: f64 = 0.1;

/// Metres of relief at most, on each side of the median foot: one sunken foot among a few must not
/// pull the eyes of a whole tile into the ground. Eyes outside the band are answered in full.
const RELIEF: f64 = 1.0;

/// Where a feature stands.
#[derive(Clone, Debug, PartialEq)]
pub struct Site {
    /// What it covers, as [`footprint`](crate::footprint) tells.
    pub footprint: MultiPolygon<f64>,
    /// Its lowest point, absolute metres.
    pub foot: f64,
}

/// A site's bounding rectangle with its number.
type Entry = GeomWithData<Rectangle<[f64; 2]>, usize>;

/// Sites by place. A site without a finite footprint is not found.
pub struct SiteIndex<'a> {
    sites: &'a [Site],
    tree: RTree<Entry>,
}

impl<'a> SiteIndex<'a> {
    pub fn new(sites: &'a [Site]) -> Self {
        let entries = sites.iter().enumerate().filter_map(|(number, site)| {
            let mut coordinates = site.footprint.coords_iter();
            let finite = coordinates.all(|c| c.x.is_finite() && c.y.is_finite());
            if !finite || !site.foot.is_finite() {
                return None;
            }
            let rect = site.footprint.bounding_rect()?;
            let (min, max) = ([rect.min().x, rect.min().y], [rect.max().x, rect.max().y]);
            Some(Entry::new(Rectangle::from_corners(min, max), number))
        });
        Self {
            sites,
            tree: RTree::bulk_load(entries.collect()),
        }
    }

    /// All sites that are found.
    pub fn all(&self) -> impl Iterator<Item = &'a Site> {
        self.tree.iter().map(|entry| &self.sites[entry.data])
    }

    /// The sites whose bounding rectangle touches `rect` grown by `margin` metres.
    pub fn near(&self, rect: &Rect<f64>, margin: f64) -> impl Iterator<Item = &'a Site> {
        let min = [rect.min().x - margin, rect.min().y - margin];
        let max = [rect.max().x + margin, rect.max().y + margin];
        let window = AABB::from_corners(min, max);
        self.tree
            .locate_in_envelope_intersecting(window)
            .map(|entry| &self.sites[entry.data])
    }

    /// Lowest and highest ground in and around `rect`, absolute metres: the feet of the sites
    /// there, less a tenth at each end and what is far from the median, or else of the nearest.
    /// `None` without sites.
    pub fn ground(&self, rect: &Rect<f64>) -> Option<[f64; 2]> {
        let mut feet: Vec<f64> = self.near(rect, NEARBY).map(|site| site.foot).collect();
        let relief = if feet.is_empty() {
            f64::INFINITY
        } else {
            RELIEF
        };
        if feet.is_empty() {
            let center = rect.center();
            let nearest = self
                .tree
                .nearest_neighbor_iter([center.x, center.y])
                .take(NEAREST);
            feet.extend(nearest.map(|entry| self.sites[entry.data].foot));
        }
        feet.sort_unstable_by(f64::total_cmp);
        let last = feet.len().checked_sub(1)?;
        let left_out = (OUTLIERS * last as f64).floor() as usize;
        let median = feet[last / 2];
        Some([
            feet[left_out].max(median - relief),
            feet[last - left_out].min(median + relief),
        ])
    }
}

/// Whether features of this class (CityJSON's names) can stand on solid ground, as buildings and
/// their parts do, and never a bridge or a tunnel.
#[must_use]
pub fn is_building(class: &str) -> bool {
    class.starts_with("Building")
}

/// Whether features of this class (CityJSON's names) cover the ground without standing in the
/// way: observers walk on them.
#[must_use]
pub fn covers_ground(class: &str) -> bool {
    matches!(
        class,
        "LandUse" | "PlantCover" | "WaterBody" | "WaterSurface" | "Waterway"
    )
}
