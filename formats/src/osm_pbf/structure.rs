//! Walls and bridges.

use super::kind::Kind;
use super::tags::Tags;
use crate::extrusion::{Extruded, Footprint, MAX_HEIGHT, Top, length};

/// Room under a bridge for each layer that it crosses, metres.
const LAYER_HEIGHT: f64 = 5.0;

/// Thickness of a bridge, metres.
const DECK_THICKNESS: f64 = 1.0;

/// Widths of walls that are believed, metres.
const WALL_WIDTHS: std::ops::RangeInclusive<f64> = 0.05..=30.0;

/// Height and width of a wall of which nothing is said, metres.
fn wall_size(tags: &Tags) -> [f64; 2] {
    match tags.get("barrier") {
        Some("city_wall") => [6.0, 2.0],
        Some("retaining_wall") => [1.5, 0.5],
        _ => [2.0, 0.3],
    }
}

/// How wide a wall is.
pub(super) fn wall_width(tags: &Tags) -> f64 {
    let said = tags
        .length("width")
        .filter(|width| WALL_WIDTHS.contains(width));
    said.unwrap_or(wall_size(tags)[1])
}

/// The solids of a wall or a bridge over its areas, each with whether it is above the ground.
pub(super) fn solids(
    kind: Kind,
    tags: &Tags,
    areas: &[Footprint],
) -> Result<Vec<(Extruded, bool)>, &'static str> {
    let (bottom, top) = if kind == Kind::Bridge {
        deck(tags)
    } else {
        wall(tags)
    };
    let solid = |area| {
        let (solid, _) = Extruded::new(area, bottom, Top::Ridge(top), None)?;
        Ok((solid, bottom > 0.0))
    };
    areas.iter().map(solid).collect()
}

fn wall(tags: &Tags) -> (f64, f64) {
    let height = height(tags, "height").filter(|height| *height > 0.0);
    (
        height_or(tags, "min_height", 0.0),
        height.unwrap_or(wall_size(tags)[0]),
    )
}

/// A slab over what the bridge crosses.
fn deck(tags: &Tags) -> (f64, f64) {
    let layer = tags
        .get("layer")
        .and_then(length)
        .filter(|layer| (1.0..=10.0).contains(layer));
    let bottom = height_or(tags, "min_height", layer.unwrap_or(1.0) * LAYER_HEIGHT);
    let top = height(tags, "height").filter(|top| *top > bottom);
    (bottom, top.unwrap_or(bottom + DECK_THICKNESS))
}

fn height(tags: &Tags, key: &str) -> Option<f64> {
    tags.length(key).filter(|height| *height <= MAX_HEIGHT)
}

fn height_or(tags: &Tags, key: &str, otherwise: f64) -> f64 {
    height(tags, key).unwrap_or(otherwise)
}
