//! The object classes of CityJSON 2.0.

const ROOTS: [&str; 16] = [
    "Bridge",
    "Building",
    "CityFurniture",
    "CityObjectGroup",
    "GenericCityObject",
    "LandUse",
    "OtherConstruction",
    "PlantCover",
    "Railway",
    "Road",
    "SolitaryVegetationObject",
    "TINRelief",
    "TransportSquare",
    "Tunnel",
    "WaterBody",
    "Waterway",
];

/// What objects of the first three classes here may be made of.
const PARTS: [(&str, &[&str]); 3] = [
    (
        "Bridge",
        &[
            "BridgePart",
            "BridgeInstallation",
            "BridgeConstructiveElement",
            "BridgeRoom",
            "BridgeFurniture",
        ],
    ),
    (
        "Building",
        &[
            "BuildingPart",
            "BuildingInstallation",
            "BuildingConstructiveElement",
            "BuildingFurniture",
            "BuildingStorey",
            "BuildingRoom",
            "BuildingUnit",
        ],
    ),
    (
        "Tunnel",
        &[
            "TunnelPart",
            "TunnelInstallation",
            "TunnelConstructiveElement",
            "TunnelHollowSpace",
            "TunnelFurniture",
        ],
    ),
];

const GENERIC: &str = "GenericCityObject";

/// The class of a root: its own where CityJSON has it or an extension may.
pub(super) fn root_class(class: &str) -> &str {
    match is_known(class) {
        true => class,
        false => GENERIC,
    }
}

/// The class of a part: its own likewise, else the general one for parts of the root.
pub(super) fn part_class<'a>(class: &'a str, root: &str) -> &'a str {
    let of_root = PARTS
        .iter()
        .find(|(of, _)| *of == root)
        .and_then(|(_, parts)| parts.first());
    match is_known(class) {
        true => class,
        false => of_root.copied().unwrap_or(GENERIC),
    }
}

fn is_known(class: &str) -> bool {
    let mut parts = PARTS.iter().flat_map(|(_, parts)| parts.iter());
    class.starts_with('+') || ROOTS.contains(&class) || parts.any(|part| *part == class)
}
