//! What every reader gives: the small description of a scene that an import needs.

use std::borrow::Cow;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::placement::Placement;

/// A city model as read, or a batch of it: metres, z up, right-handed, in a projected frame.
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
    /// Objects that are not quite as in their source, each with the difference.
    pub changed: Vec<Changed>,
    /// Rings dropped because fewer than three distinct vertices were left of them. A surface goes
    /// with its outer ring.
    pub degenerate_rings: usize,
}

impl SceneDescription {
    /// Adds another batch of the same file, or another file in the same frame.
    pub fn add(&mut self, batch: Self) {
        self.srid = self.srid.or(batch.srid);
        self.title = self.title.take().or(batch.title);
        self.attribution = self.attribution.take().or(batch.attribution);
        self.features.extend(batch.features);
        self.streets.extend(batch.streets);
        self.skipped.extend(batch.skipped);
        self.changed.extend(batch.changed);
        self.degenerate_rings += batch.degenerate_rings;
    }
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
    /// The descendants that have geometry or attributes of their own.
    pub parts: Vec<Part>,
    /// The geometries of the root and its descendants; never empty, and none of them is empty.
    pub geometries: Vec<Geometry>,
}

/// A feature as it is delivered: with its number in the database.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    /// Number of the feature.
    pub id: i64,
    /// The feature with the geometries that are delivered, all of one level of detail.
    pub feature: Feature,
}

/// A descendant of a feature's root object.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Part {
    /// The object's identifier in its source.
    pub name: String,
    /// The object's class, such as `BuildingPart`.
    pub class: String,
    /// The object's attributes, always a JSON object.
    pub attributes: serde_json::Value,
}

/// One geometry of one object, at one level of detail.
#[derive(Clone, Debug, PartialEq)]
pub struct Geometry {
    /// Level of detail, such as 2.2. Formats that know none have 2.
    pub level_of_detail: f64,
    /// Name of the [`Part`] that it belongs to; `None` for the root itself.
    pub part: Option<String>,
    /// The surfaces, shared by all instances of one template.
    pub shape: Arc<Shape>,
    /// Where the shape goes; `None` where its positions are those of the scene already.
    pub placement: Option<Placement>,
}

impl Geometry {
    /// Triangles in the frame of the scene.
    pub fn of_triangles(
        level_of_detail: f64,
        triangles: impl IntoIterator<Item = [[f64; 3]; 3]>,
    ) -> Self {
        let surface = |corners: [[f64; 3]; 3]| Surface {
            rings: vec![corners.to_vec()],
            ..Surface::default()
        };
        Self {
            level_of_detail,
            part: None,
            shape: Arc::new(Shape {
                surfaces: triangles.into_iter().map(surface).collect(),
                ..Shape::default()
            }),
            placement: None,
        }
    }

    /// The surfaces in the frame of the scene.
    pub fn surfaces(&self) -> Cow<'_, [Surface]> {
        match &self.placement {
            None => Cow::Borrowed(&self.shape.surfaces),
            Some(placement) => Cow::Owned(
                self.shape
                    .surfaces
                    .iter()
                    .map(|surface| placement.surface(surface))
                    .collect(),
            ),
        }
    }
}

/// Surfaces with what they look like and mean.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Shape {
    /// The surfaces; those of a solid are oriented outwards, as the source has them.
    pub surfaces: Vec<Surface>,
    /// The materials that surfaces refer to.
    pub materials: Vec<Material>,
    /// The meanings that surfaces refer to.
    pub semantics: Vec<Semantic>,
}

/// A planar polygon in space.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Surface {
    /// The outer ring, then the holes. Positions in metres, at least three a ring, neighbours
    /// distinct, the first not repeated at the end.
    pub rings: Vec<Vec<[f64; 3]>>,
    /// Index into the materials of its shape.
    pub material: Option<u32>,
    /// Index into the semantics of its shape.
    pub semantic: Option<u32>,
}

/// What a surface is, such as a roof.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Semantic {
    /// Kind of surface, such as `RoofSurface`.
    pub class: String,
    /// Its attributes, always a JSON object.
    pub attributes: serde_json::Value,
}

/// What a surface looks like: the model that VRML97, CityJSON and X3D share, with the two factors
/// of glTF that it lacks. Colours are red, green, blue, each from 0 to 1, encoded as sRGB.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Material {
    /// Name in the source.
    pub name: Option<String>,
    /// Colour in diffuse light.
    pub diffuse: [f64; 3],
    /// Colour of the light that it gives off itself.
    pub emissive: [f64; 3],
    /// Colour of highlights.
    pub specular: [f64; 3],
    /// How sharp highlights are, 0 to 1.
    pub shininess: f64,
    /// Share of ambient light that it reflects, 0 to 1.
    pub ambient_intensity: f64,
    /// 0 opaque, 1 not to be seen.
    pub transparency: f64,
    /// How metallic it is, 0 to 1, where the source says.
    pub metallic: Option<f64>,
    /// How rough it is, 0 to 1, where the source says.
    pub roughness: Option<f64>,
}

impl Default for Material {
    /// The defaults of VRML97 (ISO/IEC 14772-1, 6.27).
    fn default() -> Self {
        Self {
            name: None,
            diffuse: [0.8; 3],
            emissive: [0.0; 3],
            specular: [0.0; 3],
            shininess: 0.2,
            ambient_intensity: 0.2,
            transparency: 0.0,
            metallic: None,
            roughness: None,
        }
    }
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

/// An object that is not quite as in its source.
#[derive(Clone, Debug, PartialEq)]
pub struct Changed {
    /// The object's identifier in its source.
    pub name: String,
    /// The object's class.
    pub class: String,
    /// What is different, as a phrase in lower case that many objects can share, such as
    /// `textures left out`.
    pub how: String,
}
