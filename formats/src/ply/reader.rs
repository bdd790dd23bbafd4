//! From a file to its features.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use super::header::{Element, read_header};
use super::values::Values;
use crate::error::{FormatError, Location, Problem};
use crate::input::{Input, ReadOptions, Sink};
use crate::limits::{Budget, Limits};
use crate::scene::{Changed, Feature, Geometry, SceneDescription, Skipped};
use crate::shape_builder::{MAX_FEATURE_VERTICES, ShapeBuilder};

/// Most that is read: everything is held until the end, since faces of one feature may stand
/// anywhere.
const LIMITS: Limits = Limits {
    objects: 1_000_000,
    vertices: 16_000_000,
    ..Limits::STANDARD
};

/// Level of detail of everything, since the format knows none.
const LEVEL_OF_DETAIL: f64 = 2.0;

const CLASS: &str = "Generic";

/// Reads a file.
///
/// # Errors
/// A header that is not the format's, values that are no numbers, faces with indices of no vertex,
/// and more than the reader's limits; the error names the line of the header or the element.
pub(crate) fn read(
    name: &str,
    input: &mut dyn Input,
    _options: &ReadOptions<'_>,
    sink: &mut Sink<'_>,
) -> Result<(), FormatError> {
    let file = Location::file(name);
    let mut input = input;
    let header =
        read_header(&mut input).map_err(|(line, problem)| file.line(Some(line)).error(problem))?;
    let mut values = Values::new(input, header.encoding);
    let budget = Budget::new(&LIMITS, 0).map_err(|problem| file.error(problem))?;
    let mut mesh = Mesh {
        budget,
        vertices: Vec::new(),
        features: BTreeMap::new(),
        corners: 0,
        has_colors: false,
    };
    for element in &header.elements {
        mesh.add(element, &mut values)
            .map_err(|(number, problem)| match number {
                Some(number) => file
                    .object(&format!("{} {number}", element.name))
                    .error(problem),
                None => file.error(problem),
            })?;
    }
    let stem = Path::new(name).file_stem().unwrap_or_default();
    let _ = sink(mesh.finish(&stem.to_string_lossy()));
    Ok(())
}

/// What has been read.
struct Mesh {
    budget: Budget,
    vertices: Vec<[f64; 3]>,
    /// The features by the value that tells them apart, where there is one.
    features: BTreeMap<Option<i64>, ShapeBuilder>,
    /// Corners of all faces.
    corners: usize,
    has_colors: bool,
}

/// Where the properties are that a face needs.
struct FaceProperties {
    corners: usize,
    feature: Option<usize>,
}

impl Mesh {
    /// Reads all elements of a kind. Gives with a problem the number of the element.
    fn add(
        &mut self,
        element: &Element,
        values: &mut Values<&mut dyn Input>,
    ) -> Result<(), (Option<u64>, Problem)> {
        let colors = element.property(&["red", "diffuse_red"], false);
        self.has_colors |= colors.is_some();
        match element.name.as_str() {
            "vertex" => {
                let count = usize::try_from(element.count).unwrap_or(usize::MAX);
                let axes = axes(element).map_err(|problem| (None, problem))?;
                let counted = self.budget.vertices(count);
                counted.map_err(|problem| (None, problem))?;
                each(element, values, |all| {
                    self.vertices.push(position(axes, all));
                    Ok(())
                })
            }
            "face" => {
                let properties = face_properties(element).map_err(|problem| (None, problem))?;
                each(element, values, |all| self.face(&properties, all))
            }
            "tristrips" if element.count > 0 => {
                let what = "element \"tristrips\"".to_owned();
                Err((None, Problem::Unsupported { what }))
            }
            _ => each(element, values, |_| Ok(())),
        }
    }

    fn face(&mut self, properties: &FaceProperties, all: &[Vec<f64>]) -> Result<(), Problem> {
        let position = |index: &f64| {
            let place = (*index >= 0.0 && index.fract() == 0.0).then_some(*index as usize);
            let position = place.and_then(|place| self.vertices.get(place));
            position.copied().ok_or_else(|| Problem::Invalid {
                what: "a corner of a face".to_owned(),
                found: index.to_string(),
                expected: "the number of a vertex before it, from 0 on",
            })
        };
        let corners = &all[properties.corners];
        let ring: Result<Vec<_>, Problem> = corners.iter().map(position).collect();
        let ring = ring?;
        let feature = properties.feature.and_then(|place| all[place].first());
        let feature = feature.map(|value| feature_number(*value)).transpose()?;
        self.corners += ring.len();
        if self.corners > MAX_FEATURE_VERTICES {
            return Err(Problem::Limit {
                what: "corners of faces",
                found: self.corners as u64,
                limit: MAX_FEATURE_VERTICES as u64,
            });
        }
        if !self.features.contains_key(&feature) {
            self.budget.objects(1)?;
        }
        let builder = self.features.entry(feature);
        builder
            .or_insert_with(|| ShapeBuilder::new(MAX_FEATURE_VERTICES))
            .add(ring, None, &mut self.budget)
    }

    fn finish(self, stem: &str) -> SceneDescription {
        let mut scene = SceneDescription::default();
        if self.features.is_empty() && !self.vertices.is_empty() {
            scene.skipped.push(Skipped {
                name: stem.to_owned(),
                class: CLASS.to_owned(),
                why: "only points".to_owned(),
            });
        }
        for (number, builder) in self.features {
            let name = match number {
                Some(number) => format!("{stem}-{number}"),
                None => stem.to_owned(),
            };
            add_feature(&mut scene, name, builder, self.has_colors);
        }
        scene
    }
}

fn add_feature(scene: &mut SceneDescription, name: String, builder: ShapeBuilder, colors: bool) {
    let class = CLASS.to_owned();
    scene.degenerate_rings += builder.degenerate_rings;
    if builder.shape.surfaces.is_empty() {
        let why = "no surface with three distinct vertices".to_owned();
        return scene.skipped.push(Skipped { name, class, why });
    }
    if colors {
        scene.changed.push(Changed {
            name: name.clone(),
            class: class.clone(),
            how: "colours of vertices and faces left out".to_owned(),
        });
    }
    scene.features.push(Feature {
        name,
        class,
        attributes: serde_json::Value::Object(serde_json::Map::new()),
        parts: Vec::new(),
        geometries: vec![Geometry {
            level_of_detail: LEVEL_OF_DETAIL,
            part: None,
            shape: Arc::new(builder.shape),
            placement: None,
        }],
    });
}

/// Reads elements one by one, and hands over the values of their properties.
fn each(
    element: &Element,
    values: &mut Values<&mut dyn Input>,
    mut take: impl FnMut(&[Vec<f64>]) -> Result<(), Problem>,
) -> Result<(), (Option<u64>, Problem)> {
    // Elements without properties take no bytes, so any number of them could be claimed.
    if element.properties.is_empty() {
        return Ok(());
    }
    let mut all = vec![Vec::new(); element.properties.len()];
    for number in 0..element.count {
        let mut read = element.properties.iter().zip(&mut all);
        read.try_for_each(|(property, list)| values.property(property, MAX_FEATURE_VERTICES, list))
            .and_then(|()| take(&all))
            .map_err(|problem| (Some(number), problem))?;
    }
    Ok(())
}

/// Where the coordinates of a vertex are.
fn axes(element: &Element) -> Result<[usize; 3], Problem> {
    let axis = |name| {
        element
            .property(&[name], false)
            .ok_or_else(|| Problem::Missing {
                what: format!("property {name} of vertex"),
            })
    };
    Ok([axis("x")?, axis("y")?, axis("z")?])
}

/// The position of a vertex.
fn position(axes: [usize; 3], all: &[Vec<f64>]) -> [f64; 3] {
    // Adding zero makes a negative zero positive, so that equal positions are equal in bits.
    axes.map(|axis| all[axis].first().copied().unwrap_or(0.0) + 0.0)
}

fn face_properties(element: &Element) -> Result<FaceProperties, Problem> {
    let corners = element.property(&["vertex_indices", "vertex_index"], true);
    Ok(FaceProperties {
        corners: corners.ok_or_else(|| Problem::Missing {
            what: "property vertex_indices of face".to_owned(),
        })?,
        feature: element.property(&["object", "feature_id"], false),
    })
}

/// The number that a feature has.
fn feature_number(value: f64) -> Result<i64, Problem> {
    // All whole numbers up to here are exact in 64-bit floating point.
    const LARGEST: f64 = 9_007_199_254_740_992.0;
    match value.abs() <= LARGEST && value.fract() == 0.0 {
        true => Ok(value as i64),
        false => Err(Problem::Invalid {
            what: "the feature of a face".to_owned(),
            found: value.to_string(),
            expected: "a whole number",
        }),
    }
}
