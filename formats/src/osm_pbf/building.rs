//! Buildings and their parts.

use super::tags::Tags;
use super::vertical::Vertical;
use crate::extrusion::{Appearance, Extruded, Footprint, MAX_FEATURE_VERTICES};
use crate::scene::{Feature, Geometry, Part};

/// An outline or a part.
pub(super) struct Block<'a> {
    /// Its name, such as `way/1`.
    pub(super) name: String,
    /// Its tags.
    pub(super) tags: &'a Tags,
    /// Its areas.
    pub(super) areas: Vec<Footprint>,
}

impl Block<'_> {
    fn vertices(&self) -> usize {
        self.areas.iter().map(Footprint::vertices).sum()
    }
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

/// A building of its parts; or of its outline, where none of them can be built.
pub(super) fn build(outline: &Block<'_>, parts: &[&Block<'_>]) -> Built {
    let mut skipped = Vec::new();
    let pieces = match pieces(outline, parts, &mut skipped) {
        Ok(pieces) => pieces,
        Err(why) => {
            return Built {
                feature: Err(why),
                notes: Vec::new(),
                skipped,
            };
        }
    };
    let notes = pieces
        .iter()
        .flat_map(|(_, solids)| solids.notes.iter().cloned());
    let mut notes: Vec<String> = notes.collect();
    notes.sort();
    notes.dedup();
    // One level for the whole building, or a delivery by level would lose parts of it.
    let is_flat = pieces.iter().all(|(_, solids)| solids.is_flat());
    let level_of_detail = if is_flat { 1.0 } else { 2.0 };
    let parts = pieces
        .iter()
        .filter_map(|(part, _)| part.map(part_of))
        .collect();
    let geometry = |(part, solids): (Option<&Block<'_>>, Solids)| Geometry {
        level_of_detail,
        part: part.map(|part| part.name.clone()),
        shape: solids.appearance.shape(solids.solids),
        placement: None,
    };
    Built {
        feature: Ok(Feature {
            name: outline.name.clone(),
            class: "Building".to_owned(),
            attributes: outline.tags.attributes(),
            parts,
            geometries: pieces.into_iter().map(geometry).collect(),
        }),
        notes,
        skipped,
    }
}

/// The parts that can be built with their solids, or else the outline.
fn pieces<'a, 'b>(
    outline: &Block<'_>,
    parts: &[&'a Block<'b>],
    skipped: &mut Vec<(String, &'static str)>,
) -> Result<Vec<(Option<&'a Block<'b>>, Solids)>, &'static str> {
    let vertices = parts.iter().map(|part| part.vertices()).sum::<usize>();
    if vertices.max(outline.vertices()) > MAX_FEATURE_VERTICES {
        return Err("more than 1000000 vertices");
    }
    let mut pieces = Vec::new();
    for part in parts {
        match Solids::of(part, Some(outline.tags)) {
            Ok(solids) => pieces.push((Some(*part), solids)),
            Err(why) => skipped.push((part.name.clone(), why)),
        }
    }
    if pieces.is_empty() {
        pieces.push((None, Solids::of(outline, None)?));
    }
    Ok(pieces)
}

fn part_of(part: &Block<'_>) -> Part {
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
    fn of(block: &Block<'_>, around: Option<&Tags>) -> Result<Self, &'static str> {
        if block.tags.is("location", &["underground"]) {
            return Err("under the ground");
        }
        let vertical = Vertical::of(block.tags, around);
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
