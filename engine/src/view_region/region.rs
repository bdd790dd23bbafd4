//! [`ViewRegion`], where eyes may be.

use geo::{BoundingRect, Intersects, Rect, coord};
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

use super::street::Street;
use crate::Box3d;

/// All streets of a scene, under a spatial index.
#[derive(Debug)]
pub struct ViewRegion {
    streets: Vec<Street>,
    index: RTree<GeomWithData<Rectangle<[f64; 2]>, usize>>,
}

impl ViewRegion {
    /// The union of some streets.
    #[must_use]
    pub fn new(streets: Vec<Street>) -> Self {
        let entries = streets.iter().enumerate().filter_map(|(at, street)| {
            let bounds = street.area.bounding_rect()?;
            let [min, max] = [bounds.min(), bounds.max()].map(|corner| [corner.x, corner.y]);
            Some(GeomWithData::new(Rectangle::from_corners(min, max), at))
        });
        Self {
            index: RTree::bulk_load(entries.collect()),
            streets,
        }
    }

    /// The streets.
    #[must_use]
    pub fn streets(&self) -> &[Street] {
        &self.streets
    }

    /// Whether an eye may be somewhere in a closed box, which may be a single point.
    #[must_use]
    pub fn touches(&self, bounds: &Box3d) -> bool {
        self.within(bounds).next().is_some()
    }

    /// A square of the plan, as low and high as eyes may be over it; `None` where they may be nowhere.
    #[must_use]
    pub fn filled(&self, square: &Box3d) -> Option<Box3d> {
        let upright = Box3d {
            min: square.min.with_z(f64::MIN),
            max: square.max.with_z(f64::MAX),
        };
        let bands = self
            .within(&upright)
            .map(|street| [street.eye_low, street.eye_high]);
        let [low, high] = bands.reduce(|[a, b], [c, d]| [a.min(c), b.max(d)])?;
        Some(Box3d {
            min: square.min.with_z(low),
            max: square.max.with_z(high),
        })
    }

    /// The streets that share a point with a closed box.
    pub fn within(&self, bounds: &Box3d) -> impl Iterator<Item = &Street> {
        let Box3d { min, max } = *bounds;
        let plan = AABB::from_corners([min.x, min.y], [max.x, max.y]);
        let rectangle = Rect::new(coord! { x: min.x, y: min.y }, coord! { x: max.x, y: max.y });
        self.index
            .locate_in_envelope_intersecting(plan)
            .map(|entry| &self.streets[entry.data])
            .filter(move |street| street.eye_low <= max.z && min.z <= street.eye_high)
            .filter(move |street| street.area.intersects(&rectangle))
    }
}
