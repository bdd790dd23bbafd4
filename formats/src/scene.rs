//! What every reader gives: the small description of a scene that an import needs.

/// A city model as read, in the frame of its file: metres, z up, right-handed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneDescription {
    /// EPSG code of the reference system, where the file names one.
    pub srid: Option<i32>,
    /// Title of the data set.
    pub title: Option<String>,
    /// Whom to credit for the data: the point of contact and its address on the web.
    pub attribution: Option<String>,
    /// The features, in the order of the file.
    pub features: Vec<Feature>,
    /// The streets, in the order of the file.
    pub streets: Vec<Street>,
    /// Objects that became neither, each with the reason.
    pub skipped: Vec<Skipped>,
    /// Rings dropped because fewer than three distinct vertices were left of them. A surface goes
    /// with its outer ring.
    pub degenerate_rings: usize,
}

/// One indivisible city object: a root object with all its descendants merged in.
#[derive(Clone, Debug, PartialEq)]
pub struct Feature {
    /// The root object's identifier in its source.
    pub name: String,
    /// The root object's class, such as `Building`.
    pub class: String,
    /// The root object's attributes, always a JSON object.
    pub attributes: serde_json::Value,
    /// The surfaces of the root and its descendants; never empty, and none of them is empty.
    pub geometries: Vec<Geometry>,
    /// The source model: for CityJSON a document of its own with just these objects.
    pub source: String,
}

/// One geometry of one object, at one level of detail.
#[derive(Clone, Debug, PartialEq)]
pub struct Geometry {
    /// Level of detail, such as 2.2.
    pub level_of_detail: f64,
    /// Identifier of the object that it came from: the root or a descendant.
    pub part: String,
    /// The surfaces; those of a solid are oriented outwards, as the source has them.
    pub surfaces: Vec<Surface>,
}

/// A planar polygon in space.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// The outer ring, then the holes. Positions in metres, at least three a ring, neighbours
    /// distinct, the first not repeated at the end.
    pub rings: Vec<Vec<[f64; 3]>>,
}

/// A surface that observers can walk or drive on.
#[derive(Clone, Debug, PartialEq)]
pub struct Street {
    /// The object's identifier in its source.
    pub name: String,
    /// The object's class, such as `Road`.
    pub class: String,
    /// The surfaces of each part's highest level of detail.
    pub surfaces: Vec<Surface>,
}

/// An object that is not part of the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Skipped {
    /// The object's identifier in its source.
    pub name: String,
    /// The object's class.
    pub class: String,
    /// Why it was left out, as a phrase in lower case.
    pub why: String,
}
