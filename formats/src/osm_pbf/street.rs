//! How wide streets are.

use super::tags::Tags;
use crate::extrusion::{Ends, Footprint, Plan, STREET_WIDTHS, street_width, strips};

/// Width of a lane where only lanes are counted, metres.
const LANE: f64 = 3.0;

/// Width of a pavement beside counted lanes, metres.
const PAVEMENT: f64 = 2.0;

/// Why nobody is in the open air on a street or square; none where people are.
pub(super) fn hidden(tags: &Tags) -> Option<&'static str> {
    if tags.has("tunnel") {
        Some("in a tunnel or a passage")
    } else if tags.has("bridge") {
        Some("on a bridge")
    } else if tags.has("indoor") || tags.is("highway", &["corridor"]) {
        Some("indoors")
    } else if tags
        .get("layer")
        .is_some_and(|layer| layer.trim().starts_with('-'))
        || tags.is("location", &["underground"])
    {
        Some("under the ground")
    } else {
        None
    }
}

/// The area of a street along lines; or why there is none.
pub(super) fn area(tags: &Tags, lines: &[Vec<Plan>]) -> Result<Vec<Footprint>, &'static str> {
    let width = width(tags).ok_or("a highway of a kind that is no street")?;
    strips(lines, width, Ends::Round)
}

/// The width of a street; none for what is no street.
fn width(tags: &Tags) -> Option<f64> {
    let by_kind = street_width(tags.get("highway")?)?;
    let said = |key| {
        tags.length(key)
            .filter(|width| STREET_WIDTHS.contains(width))
    };
    let counted = || {
        let lanes = tags.length("lanes").map(|lanes| lanes * LANE)?;
        let width = lanes + pavements(tags) * PAVEMENT;
        (lanes > 0.0 && STREET_WIDTHS.contains(&width)).then_some(width)
    };
    let said = said("width").or_else(|| said("est_width"));
    Some(said.or_else(counted).unwrap_or(by_kind))
}

/// How many pavements are said to be beside the lanes.
fn pavements(tags: &Tags) -> f64 {
    match tags.get("sidewalk") {
        Some("both") => 2.0,
        Some("left" | "right") => 1.0,
        _ => f64::from(tags.is("sidewalk:both", &["yes"])) * 2.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tags(tags: &[(&str, &str)]) -> Tags {
        let mut all = Tags::default();
        for (key, value) in tags {
            all.add(key, value).unwrap();
        }
        all
    }

    #[test]
    fn widths_come_before_lanes_and_kinds() {
        let width = |all: &[(&str, &str)]| width(&tags(all));
        let street = ("highway", "residential");
        assert_eq!(
            width(&[street, ("width", "7,5 m"), ("lanes", "4")]),
            Some(7.5)
        );
        assert_eq!(
            width(&[street, ("width", "1e9"), ("lanes", "2")]),
            Some(6.0)
        );
        assert_eq!(
            width(&[street, ("lanes", "2"), ("sidewalk", "both")]),
            Some(10.0)
        );
        assert_eq!(width(&[street]), Some(6.0));
        assert_eq!(width(&[("highway", "construction"), ("width", "5")]), None);
    }

    #[test]
    fn streets_that_nobody_sees_from_are_hidden() {
        assert_eq!(hidden(&tags(&[("layer", "-1")])), Some("under the ground"));
        assert_eq!(
            hidden(&tags(&[("tunnel", "building_passage")])),
            Some("in a tunnel or a passage")
        );
        assert_eq!(hidden(&tags(&[("bridge", "no"), ("layer", "1")])), None);
    }
}
