//! What an element is in the scene.

use super::tags::Tags;

/// What becomes of an element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// A building or its outline.
    Building,
    /// A part of a building.
    Part,
    /// A wall that stands free or holds the ground.
    Wall,
    /// The area of a bridge.
    Bridge,
    /// A line that people walk or drive along.
    Street,
    /// An area that people walk or drive on.
    Square,
}

impl Kind {
    /// The kind by its tags; none for what is not part of the scene.
    pub(super) fn of(tags: &Tags) -> Option<Self> {
        if tags.has("building") {
            Some(Self::Building)
        } else if tags.has("building:part") {
            Some(Self::Part)
        } else if tags.is("barrier", &["wall", "city_wall", "retaining_wall"]) {
            Some(Self::Wall)
        } else if tags.is("man_made", &["bridge"]) {
            Some(Self::Bridge)
        } else if tags.has("highway") {
            let is_area = tags.is("area", &["yes"]) || tags.is("type", &["multipolygon"]);
            Some(if is_area { Self::Square } else { Self::Street })
        } else if tags.is("place", &["square"]) || is_open_parking(tags) {
            Some(Self::Square)
        } else {
            None
        }
    }

    /// The class of what it becomes.
    pub(super) fn class(self) -> &'static str {
        match self {
            Self::Building => "Building",
            Self::Part => "BuildingPart",
            Self::Wall => "Wall",
            Self::Bridge => "Bridge",
            Self::Street => "Road",
            Self::Square => "TransportSquare",
        }
    }
}

/// Whether a key can make an element part of the scene.
pub(super) fn is_telling(key: &[u8]) -> bool {
    let keys: [&[u8]; 7] = [
        b"building",
        b"building:part",
        b"barrier",
        b"man_made",
        b"highway",
        b"place",
        b"amenity",
    ];
    keys.contains(&key)
}

/// Whether cars are parked there under the open sky.
fn is_open_parking(tags: &Tags) -> bool {
    let built = [
        "underground",
        "multi-storey",
        "rooftop",
        "sheds",
        "carports",
        "garage_boxes",
    ];
    tags.is("amenity", &["parking"]) && !tags.is("parking", &built)
}
