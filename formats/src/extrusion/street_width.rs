//! How wide streets are of which only the kind is known.

use std::ops::RangeInclusive;

/// Widths of streets that are believed, metres.
pub(crate) const STREET_WIDTHS: RangeInclusive<f64> = 0.5..=100.0;

/// Widths by the value of `highway`, metres.
const WIDTHS: [(f64, &[&str]); 9] = [
    (12.0, &["motorway"]),
    (10.0, &["trunk", "primary"]),
    (8.0, &["secondary"]),
    (7.0, &["tertiary", "busway"]),
    (
        6.0,
        &[
            "residential",
            "unclassified",
            "road",
            "motorway_link",
            "trunk_link",
            "primary_link",
            "secondary_link",
            "tertiary_link",
        ],
    ),
    (5.0, &["living_street", "pedestrian"]),
    (4.0, &["service"]),
    (3.0, &["track", "platform"]),
    (
        2.0,
        &[
            "footway",
            "cycleway",
            "path",
            "steps",
            "bridleway",
            "crossing",
        ],
    ),
];

/// The width of a street by its kind, metres; none for what is no street.
pub(crate) fn street_width(highway: &str) -> Option<f64> {
    let width = WIDTHS.iter().find(|(_, kinds)| kinds.contains(&highway));
    width.map(|(width, _)| *width)
}
