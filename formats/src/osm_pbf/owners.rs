//! Which building a part belongs to.

use std::collections::HashMap;

use geo::{BoundingRect, Contains, InteriorPoint, Point, Polygon};
use rstar::RTree;
use rstar::primitives::{GeomWithData, Rectangle};

use super::building::Block;
use crate::error::Problem;

/// Most vertices that are compared to find the buildings around parts.
const MAX_COMPARISONS: u64 = 2_000_000_000;

/// For each part the number of the building that it belongs to: by a relation, or else the smallest
/// one around it.
pub(super) fn owners(
    buildings: &[Block<'_>],
    parts: &[Block<'_>],
    related: &HashMap<String, String>,
) -> Result<Vec<Option<usize>>, Problem> {
    if parts.is_empty() {
        return Ok(Vec::new());
    }
    let numbered = buildings.iter().enumerate();
    let numbers: HashMap<&str, usize> = numbered.map(|(i, b)| (b.name.as_str(), i)).collect();
    let by_relation = |part: &Block<'_>| numbers.get(related.get(&part.name)?.as_str()).copied();
    let mut outlines = Outlines::of(buildings);
    let owner = |part: &Block<'_>| match by_relation(part) {
        Some(building) => Ok(Some(building)),
        None => outlines.around(part),
    };
    parts.iter().map(owner).collect()
}

/// The outlines of buildings, to be searched by place.
struct Outlines {
    outlines: Vec<Outline>,
    boxes: RTree<GeomWithData<Rectangle<[f64; 2]>, usize>>,
    compared: u64,
}

/// One outline of a building.
struct Outline {
    building: usize,
    size: f64,
    area: Polygon,
}

impl Outlines {
    fn of(buildings: &[Block<'_>]) -> Self {
        let areas = buildings.iter().enumerate();
        let areas = areas.flat_map(|(i, block)| block.areas.iter().map(move |area| (i, area)));
        let outline = |(building, area): (usize, &crate::extrusion::Footprint)| Outline {
            building,
            size: area.area(),
            area: area.polygon(),
        };
        let outlines: Vec<_> = areas.map(outline).collect();
        let boxes = outlines.iter().enumerate().filter_map(|(i, outline)| {
            let bounds = outline.area.bounding_rect()?;
            let corners = [bounds.min(), bounds.max()].map(|corner| [corner.x, corner.y]);
            Some(GeomWithData::new(
                Rectangle::from_corners(corners[0], corners[1]),
                i,
            ))
        });
        Self {
            boxes: RTree::bulk_load(boxes.collect()),
            outlines,
            compared: 0,
        }
    }

    /// The smallest building around a part.
    fn around(&mut self, part: &Block<'_>) -> Result<Option<usize>, Problem> {
        let area = part.areas.first().map(|area| area.polygon());
        let Some(point) = area.and_then(|area| area.interior_point()) else {
            return Ok(None);
        };
        let candidates = self.candidates(point)?;
        let around = candidates
            .into_iter()
            .filter(|outline| outline.area.contains(&point));
        let smallest = around.min_by(|a, b| a.size.total_cmp(&b.size));
        Ok(smallest.map(|outline| outline.building))
    }

    /// The outlines whose boxes hold a point.
    fn candidates(&mut self, point: Point) -> Result<Vec<&Outline>, Problem> {
        let found = self.boxes.locate_all_at_point([point.x(), point.y()]);
        let found: Vec<_> = found.map(|found| &self.outlines[found.data]).collect();
        let vertices = |outline: &&Outline| outline.area.exterior().0.len() as u64;
        self.compared += found.iter().map(vertices).sum::<u64>();
        match self.compared > MAX_COMPARISONS {
            true => Err(Problem::Limit {
                what: "vertices around parts of buildings",
                found: self.compared,
                limit: MAX_COMPARISONS,
            }),
            false => Ok(found),
        }
    }
}
