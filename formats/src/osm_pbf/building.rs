//! Buildings and their parts.

use std::collections::HashMap;

use geo::{Contains, InteriorPoint, Point, Polygon};
use rstar::RTree;
use rstar::primitives::{GeomWithData, Rectangle};

use super::tags::Tags;
use super::vertical::Vertical;
use crate::error::Problem;
use crate::extrusion::{Appearance, Extruded, Footprint};
use crate::scene::{Feature, Geometry, Part};

/// Most vertices that are compared to find the buildings around parts.
const MAX_COMPARISONS: u64 = 2_000_000_000;

/// An outline or a part.
pub(super) struct Block {
    /// Its name, such as `way/1`.
    pub(super) name: String,
    /// Its tags.
    pub(super) tags: Tags,
    /// Its areas.
    pub(super) areas: Vec<Footprint>,
}

/// What became of a building.
pub(super) struct Built {
    /// The building, or why there is none.
    pub(super) feature: Result<Feature, &'static str>,
    /// How it differs from its tags.
    pub(super) notes: Vec<String>,
    /// Parts that were left out, with the reason.
    pub(super) skipped: Vec<(String, &'static str)>,
}

/// For each part the number of the building that it belongs to: by a relation, or else the smallest
/// one around it.
pub(super) fn owners(
    buildings: &[Block],
    parts: &[Block],
    related: &HashMap<String, String>,
) -> Result<Vec<Option<usize>>, Problem> {
    let numbers: HashMap<&str, usize> = buildings
        .iter()
        .enumerate()
        .map(|(i, building)| (building.name.as_str(), i))
        .collect();
    let by_relation = |part: &Block| numbers.get(related.get(&part.name)?.as_str()).copied();
    let areas: Vec<(usize, f64, Polygon)> = buildings
        .iter()
        .enumerate()
        .flat_map(|(i, building)| {
            building
                .areas
                .iter()
                .map(move |a| (i, a.area(), a.polygon()))
        })
        .collect();
    let boxes = areas.iter().enumerate().filter_map(|(i, (_, _, area))| {
        let bounds = geo::BoundingRect::bounding_rect(area)?;
        let corners = (bounds.min(), bounds.max());
        let bounds =
            Rectangle::from_corners([corners.0.x, corners.0.y], [corners.1.x, corners.1.y]);
        Some(GeomWithData::new(bounds, i))
    });
    let tree = RTree::bulk_load(boxes.collect());
    let mut compared = 0;
    let mut around = |point: Point| -> Result<Option<usize>, Problem> {
        let mut smallest: Option<(usize, f64)> = None;
        for found in tree.locate_all_at_point([point.x(), point.y()]) {
            let (building, size, area) = &areas[found.data];
            compared += area.exterior().0.len() as u64;
            if compared > MAX_COMPARISONS {
                let what = "vertices around parts of buildings";
                return Err(Problem::Limit {
                    what,
                    found: compared,
                    limit: MAX_COMPARISONS,
                });
            }
            if area.contains(&point) && smallest.is_none_or(|(_, least)| *size < least) {
                smallest = Some((*building, *size));
            }
        }
        Ok(smallest.map(|(building, _)| building))
    };
    let owner = |part: &Block| match by_relation(part) {
        Some(building) => Ok(Some(building)),
        None => match part
            .areas
            .first()
            .and_then(|area| area.polygon().interior_point())
        {
            Some(point) => around(point),
            None => Ok(None),
        },
    };
    parts.iter().map(owner).collect()
}

/// A building of its parts; or of its outline, where none of them can be built.
pub(super) fn build(outline: &Block, parts: &[&Block]) -> Built {
    let mut notes = Vec::new();
    let mut skipped = Vec::new();
    let mut built = Vec::new();
    for part in parts {
        match Solids::of(part, Some(&outline.tags)) {
            Ok(solids) => built.push((*part, solids)),
            Err(why) => skipped.push((part.name.clone(), why)),
        }
    }
    let level_of_detail = |flat: bool| if flat { 1.0 } else { 2.0 };
    let geometry = |solids: Solids, part: Option<&Block>, flat: bool| Geometry {
        level_of_detail: level_of_detail(flat),
        part: part.map(|part| part.name.clone()),
        shape: solids.appearance.shape(solids.solids),
        placement: None,
    };
    let geometries = if built.is_empty() {
        Solids::of(outline, None).map(|solids| {
            notes.extend(solids.notes.iter().cloned());
            let flat = solids.is_flat();
            vec![geometry(solids, None, flat)]
        })
    } else {
        notes.extend(
            built
                .iter()
                .flat_map(|(_, solids)| solids.notes.iter().cloned()),
        );
        // One level for the whole building, or a delivery by level would lose parts of it.
        let flat = built.iter().all(|(_, solids)| solids.is_flat());
        Ok(built
            .into_iter()
            .map(|(part, solids)| geometry(solids, Some(part), flat))
            .collect())
    };
    let has = |geometries: &[Geometry], part: &Block| {
        geometries
            .iter()
            .any(|geometry| geometry.part.as_ref() == Some(&part.name))
    };
    notes.sort();
    notes.dedup();
    Built {
        feature: geometries.map(|geometries| Feature {
            name: outline.name.clone(),
            class: "Building".to_owned(),
            attributes: outline.tags.attributes(),
            parts: parts
                .iter()
                .filter(|part| has(&geometries, part))
                .map(|part| part_of(part))
                .collect(),
            geometries,
        }),
        notes,
        skipped,
    }
}

fn part_of(part: &Block) -> Part {
    Part {
        name: part.name.clone(),
        class: "BuildingPart".to_owned(),
        attributes: part.tags.attributes(),
    }
}

/// The solids of an outline or a part.
struct Solids {
    solids: Vec<(Extruded, bool)>,
    appearance: Appearance,
    notes: Vec<String>,
}

impl Solids {
    fn of(block: &Block, around: Option<&Tags>) -> Result<Self, &'static str> {
        if block.tags.is("location", &["underground"]) {
            return Err("under the ground");
        }
        let vertical = Vertical::of(&block.tags, around);
        let mut notes = vertical.notes;
        let mut solids = Vec::new();
        for area in &block.areas {
            let roof = vertical.roof.as_ref();
            let (solid, lost_roof) = Extruded::new(area, vertical.bottom, vertical.top, roof)?;
            if lost_roof {
                notes.push("roof built flat, since the outline does not fit its shape".to_owned());
            }
            solids.push((solid, vertical.bottom > 0.0));
        }
        let colour = |key| {
            let text = block
                .tags
                .get(key)
                .or_else(|| around.and_then(|tags| tags.get(key)));
            text.and_then(colour)
        };
        Ok(Self {
            solids,
            appearance: Appearance {
                wall: colour("building:colour"),
                roof: colour("roof:colour"),
            },
            notes,
        })
    }

    fn is_flat(&self) -> bool {
        self.solids.iter().all(|(solid, _)| solid.is_flat)
    }
}

/// A colour by its name in CSS or in hexadecimal.
fn colour(text: &str) -> Option<[f64; 3]> {
    let text = text.trim().replace(['_', ' '], "");
    let colour = csscolorparser::parse(&text).ok()?;
    Some([colour.r, colour.g, colour.b].map(|part| f64::from(part).clamp(0.0, 1.0)))
}
