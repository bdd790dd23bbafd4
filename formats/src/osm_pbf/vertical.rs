//! Heights and roofs by the Simple 3D Buildings rules.

use super::tags::Tags;
use crate::extrusion::{LEVEL_HEIGHT, MAX_HEIGHT, Plan, Rise, Roof, RoofShape, Top, length};

/// Thickness of a roof that stands on posts, metres.
const CANOPY_THICKNESS: f64 = 0.5;

/// Height of a building of which nothing is said, metres.
const DEFAULT_HEIGHT: f64 = 6.0;

/// Heights of buildings of which only the kind is known, metres.
const HEIGHTS_BY_KIND: [(f64, &[&str]); 7] = [
    (
        3.0,
        &[
            "garage",
            "garages",
            "carport",
            "shed",
            "hut",
            "kiosk",
            "cabin",
            "roof",
            "toilets",
            "service",
            "container",
            "greenhouse",
            "bungalow",
        ],
    ),
    (
        6.0,
        &[
            "house",
            "detached",
            "semidetached_house",
            "terrace",
            "farm",
            "barn",
            "stable",
            "farm_auxiliary",
            "kindergarten",
            "chapel",
        ],
    ),
    (
        8.0,
        &[
            "industrial",
            "warehouse",
            "retail",
            "supermarket",
            "hangar",
            "manufacture",
            "train_station",
            "transportation",
            "sports_hall",
            "sports_centre",
        ],
    ),
    (
        9.0,
        &[
            "school",
            "civic",
            "public",
            "government",
            "fire_station",
            "parking",
            "college",
        ],
    ),
    (
        12.0,
        &[
            "commercial",
            "office",
            "hospital",
            "university",
            "residential",
            "dormitory",
            "mosque",
            "synagogue",
            "temple",
        ],
    ),
    (
        15.0,
        &["apartments", "hotel", "church", "stadium", "grandstand"],
    ),
    (25.0, &["cathedral", "basilica", "tower"]),
];

/// From where to where a solid reaches, and its roof.
#[derive(Debug)]
pub(super) struct Vertical {
    /// Height of the underside.
    pub(super) bottom: f64,
    /// Height of the top.
    pub(super) top: Top,
    /// The roof, where it is not flat.
    pub(super) roof: Option<Roof>,
    /// What is not as the tags have it.
    pub(super) notes: Vec<String>,
}

impl Vertical {
    /// By the tags of a building, or of a part and then of the building around it.
    pub(super) fn of(tags: &Tags, around: Option<&Tags>) -> Self {
        let mut notes = Vec::new();
        let mut roof = None;
        if let Some(name) = tags.get("roof:shape") {
            let (shape, instead) = RoofShape::named(name);
            if let Some(instead) = instead {
                notes.push(format!(
                    "roof shape {} built as {instead}",
                    crate::error::quote(name)
                ));
            }
            roof = shape.map(|shape| roof_of(tags, shape, &mut notes));
        }
        let own = top(tags, roof.as_ref(), &mut notes);
        let others = || around.and_then(|tags| top(tags, roof.as_ref(), &mut Vec::new()));
        let top = own
            .or_else(others)
            .unwrap_or_else(|| Top::Ridge(default_height(tags, around)));
        let bottom = metres(tags, &["min_height"], &mut notes)
            .or_else(|| levels(tags, "building:min_level", &mut notes))
            .unwrap_or_else(|| default_bottom(tags, top));
        Self {
            bottom,
            top,
            roof,
            notes,
        }
    }
}

/// How high it reaches; none where nothing usable is said.
fn top(tags: &Tags, roof: Option<&Roof>, notes: &mut Vec<String>) -> Option<Top> {
    if let Some(height) = metres(tags, &["height", "building:height"], notes) {
        return Some(Top::Ridge(height));
    }
    let levels = levels(tags, "building:levels", notes)?;
    match roof {
        // A building may be all roof.
        Some(_) => Some(Top::Eaves(levels)),
        None => (levels > 0.0).then_some(Top::Ridge(levels)),
    }
}

/// The height for the kind of building.
fn default_height(tags: &Tags, around: Option<&Tags>) -> f64 {
    let kinds = [
        tags.get("building"),
        tags.get("building:part"),
        around.and_then(|t| t.get("building")),
    ];
    let by_kind = |kind: &str| {
        HEIGHTS_BY_KIND
            .iter()
            .find(|(_, kinds)| kinds.contains(&kind))
    };
    let found = kinds.into_iter().flatten().find_map(by_kind);
    found.map_or(DEFAULT_HEIGHT, |(height, _)| *height)
}

/// The ground, but for roofs on posts.
fn default_bottom(tags: &Tags, top: Top) -> f64 {
    let (Top::Ridge(z) | Top::Eaves(z)) = top;
    let is_canopy = tags.is("building", &["roof"]) || tags.is("building:part", &["roof"]);
    if is_canopy {
        (z - CANOPY_THICKNESS).max(0.0)
    } else {
        0.0
    }
}

fn roof_of(tags: &Tags, shape: RoofShape, notes: &mut Vec<String>) -> Roof {
    let rise = metres(tags, &["roof:height"], notes)
        .or_else(|| levels(tags, "roof:levels", notes))
        .filter(|rise| *rise > 0.0)
        .map(Rise::Metres);
    let slope = || {
        let degrees: f64 = tags
            .get("roof:angle")?
            .trim()
            .trim_end_matches('°')
            .parse()
            .ok()?;
        (1.0..=80.0)
            .contains(&degrees)
            .then(|| Rise::Slope(degrees.to_radians().tan()))
    };
    Roof {
        shape,
        rise: rise.or_else(slope).unwrap_or(Rise::Unsaid),
        across: tags.is("roof:orientation", &["across"]),
        direction: tags.get("roof:direction").and_then(direction),
    }
}

/// The first of these tags that says a height, metres.
fn metres(tags: &Tags, keys: &[&str], notes: &mut Vec<String>) -> Option<f64> {
    keys.iter().find_map(|key| {
        let found = length(tags.get(key)?).filter(|metres| (0.0..=MAX_HEIGHT).contains(metres));
        if found.is_none() {
            notes.push(format!(
                "{key} is no height from 0 to {MAX_HEIGHT} m, ignored"
            ));
        }
        found
    })
}

/// A number of storeys, in metres.
fn levels(tags: &Tags, key: &str, notes: &mut Vec<String>) -> Option<f64> {
    let metres = |text| length(text).map(|levels| levels * LEVEL_HEIGHT);
    let found = metres(tags.get(key)?).filter(|metres| (0.0..=MAX_HEIGHT).contains(metres));
    if found.is_none() {
        notes.push(format!("{key} is no number of storeys, ignored"));
    }
    found
}

/// A direction as degrees clockwise from north or a point of the compass, as a unit vector.
fn direction(text: &str) -> Option<Plan> {
    const COMPASS: [&str; 16] = [
        "N", "NNE", "NE", "ENE", "E", "ESE", "SE", "SSE", "S", "SSW", "SW", "WSW", "W", "WNW",
        "NW", "NNW",
    ];
    let text = text.trim();
    let named = COMPASS
        .iter()
        .position(|name| text.eq_ignore_ascii_case(name));
    let degrees = match named {
        Some(index) => index as f64 * 22.5,
        None => text
            .trim_end_matches('°')
            .parse()
            .ok()
            .filter(|degrees| f64::abs(*degrees) <= 360.0)?,
    };
    let (sin, cos) = degrees.to_radians().sin_cos();
    Some([sin, cos])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn vertical(tags: &[(&str, &str)]) -> Vertical {
        let mut all = Tags::default();
        for (key, value) in tags {
            all.add(key, value).unwrap();
        }
        Vertical::of(&all, None)
    }

    #[test]
    fn heights_come_before_levels_and_kinds() {
        let top = |tags: &[(&str, &str)]| vertical(tags).top;
        assert_eq!(
            top(&[("height", "40'"), ("building:levels", "9")]),
            Top::Ridge(40.0 * 0.3048)
        );
        assert_eq!(top(&[("building:levels", "3")]), Top::Ridge(9.0));
        assert_eq!(
            top(&[("building:levels", "3"), ("roof:shape", "gabled")]),
            Top::Eaves(9.0)
        );
        assert_eq!(top(&[("building", "garage")]), Top::Ridge(3.0));
        assert_eq!(top(&[("building", "yes")]), Top::Ridge(DEFAULT_HEIGHT));
        assert_eq!(vertical(&[("building:min_level", "2")]).bottom, 6.0);
        assert_eq!(
            vertical(&[("building", "roof"), ("height", "4")]).bottom,
            3.5
        );
    }

    #[test]
    fn what_is_not_understood_is_noted() {
        let found = vertical(&[
            ("height", "tall"),
            ("roof:shape", "onion"),
            ("building:levels", "2"),
        ]);
        assert_eq!(found.top, Top::Eaves(6.0));
        let notes = [
            "roof shape \"onion\" built as a dome",
            "height is no height from 0 to 1000 m, ignored",
        ];
        assert_eq!(found.notes, notes);
        assert_eq!(
            vertical(&[("height", "1e300")]).top,
            Top::Ridge(DEFAULT_HEIGHT)
        );
    }

    #[test]
    fn directions_run_clockwise_from_north() {
        let near = |text, expected: Plan| {
            let found = direction(text).unwrap();
            assert!(
                (found[0] - expected[0]).abs() + (found[1] - expected[1]).abs() < 1e-12,
                "{text}"
            );
        };
        near("N", [0.0, 1.0]);
        near("90", [1.0, 0.0]);
        near("sw", [-0.5_f64.sqrt(), -0.5_f64.sqrt()]);
        assert_eq!(direction("up"), None);
        assert_eq!(direction("inf"), None);
    }
}
