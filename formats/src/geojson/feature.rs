//! One feature: a solid over its footprint, or a street.

use serde_json::Value;
use serde_json::value::RawValue;

use super::document::{object, parse};
use super::geometry::{Geometry, Line};
use super::properties::{Properties, checked, name_of, within};
use super::reference::Reference;
use super::{FeatureError, numbered};
use crate::error::{Problem, quote};
use crate::extrusion::{
    Appearance, Ends, Extruded, Footprint, MAX_FEATURE_VERTICES, Plan, Top, strips,
};
use crate::limits::MAX_COORDINATE;
use crate::scene::{self, Feature, Skipped, Street, Surface};

/// Most bytes of one feature: as values in memory they take up to 10 times as much.
const MAX_FEATURE_BYTES: usize = 16 << 20;

/// Said of a feature whose rings did not end where they began.
const CLOSED: &str = "rings closed that were open";

/// What a feature became.
pub(super) enum Read {
    /// A solid, and how it differs from its source.
    Feature(Feature, Option<&'static str>),
    /// Something to walk or drive on.
    Street(Street),
    /// Neither.
    Skipped(Skipped),
}

#[derive(serde::Deserialize)]
struct RawFeature<'a> {
    #[serde(borrow)]
    id: Option<&'a RawValue>,
    #[serde(borrow)]
    geometry: Option<&'a RawValue>,
    #[serde(borrow)]
    properties: Option<&'a RawValue>,
}

/// The geometry of a feature, if it has one.
pub(super) fn geometry_of(raw: &RawValue) -> Result<Option<Geometry>, Problem> {
    within("bytes of a feature", raw.get().len(), MAX_FEATURE_BYTES)?;
    let feature: RawFeature<'_> = object("feature", raw)?;
    feature.geometry.map(Geometry::parse).transpose()
}

/// Reads features in one reference system.
pub(super) struct FeatureReader<'a> {
    reference: &'a Reference,
}

impl<'a> FeatureReader<'a> {
    /// A reader for coordinates of this system.
    pub(super) fn new(reference: &'a Reference) -> Self {
        Self { reference }
    }

    /// Reads the feature with this number.
    pub(super) fn read(&self, raw: &RawValue, number: usize) -> Result<Read, FeatureError> {
        let nameless = |problem| FeatureError {
            feature: Some(numbered(number)),
            problem,
        };
        let geometry = geometry_of(raw).map_err(nameless)?;
        let feature: RawFeature<'_> = object("feature", raw).map_err(nameless)?;
        let properties = Properties::parse(feature.properties).map_err(nameless)?;
        let name = name(&feature, &properties).map_err(nameless)?;
        let name = name.unwrap_or_else(|| numbered(number));
        let object = Object {
            name: &name,
            class: properties.class().map_err(nameless)?,
            reference: self.reference,
        };
        let read = match geometry {
            None => Ok(object.skipped("no geometry")),
            Some(Geometry::Areas(areas)) => object.areas(areas, properties),
            Some(Geometry::Lines(lines)) => object.lines(&lines, &properties),
            Some(Geometry::Other(kind)) => {
                Ok(object.skipped(&format!("a geometry of type {kind}")))
            }
        };
        read.map_err(|problem| FeatureError {
            feature: Some(name.clone()),
            problem,
        })
    }
}

/// The identifier, or a property that names the feature.
fn name(feature: &RawFeature<'_>, properties: &Properties) -> Result<Option<String>, Problem> {
    let Some(raw) = feature.id else {
        return properties.name();
    };
    let id: Value = parse("id", raw)?;
    let name = name_of(&id).ok_or_else(|| Problem::Invalid {
        what: "id".into(),
        found: quote(raw.get()),
        expected: "a string or a number",
    })?;
    checked(name).map(Some)
}

/// A feature whose name and class are known.
struct Object<'a> {
    name: &'a str,
    class: String,
    reference: &'a Reference,
}

/// An area in metres.
struct Area {
    footprint: Footprint,
    z: f64,
    was_open: bool,
}

impl Object<'_> {
    fn skipped(&self, why: &str) -> Read {
        Read::Skipped(Skipped {
            name: self.name.to_owned(),
            class: self.class.clone(),
            why: why.to_owned(),
        })
    }

    fn street(&self, class: &str, surfaces: Vec<Surface>) -> Read {
        Read::Street(Street {
            name: self.name.to_owned(),
            class: class.to_owned(),
            surfaces,
        })
    }

    fn areas(&self, areas: Vec<Vec<Line>>, properties: Properties) -> Result<Read, Problem> {
        let areas: Result<Vec<Result<Area, _>>, _> =
            areas.iter().map(|rings| self.area(rings)).collect();
        let areas: Vec<Area> = match areas?.into_iter().collect() {
            Ok(areas) => areas,
            Err(why) => return Ok(self.skipped(why)),
        };
        if areas.is_empty() {
            return Ok(self.skipped("no geometry"));
        }
        if let Some(class) = properties.street() {
            let surfaces = areas.iter().map(|area| surface(&area.footprint, area.z));
            return Ok(self.street(class, surfaces.collect()));
        }
        Ok(self
            .solids(&areas, properties)
            .unwrap_or_else(|why| self.skipped(why)))
    }

    fn solids(&self, areas: &[Area], properties: Properties) -> Result<Read, &'static str> {
        let [base, height] = properties.heights()?;
        let vertices = areas.iter().map(|area| area.footprint.vertices());
        if vertices.sum::<usize>() > MAX_FEATURE_VERTICES {
            return Err("more than 1000000 vertices");
        }
        let solid = |area: &Area| {
            let (bottom, top) = (area.z + base, Top::Ridge(area.z + height));
            let (solid, _) = Extruded::new(&area.footprint, bottom, top, None)?;
            Ok((solid, base > 0.0))
        };
        let solids = areas.iter().map(solid).collect::<Result<_, &str>>()?;
        let feature = Feature {
            name: self.name.to_owned(),
            class: self.class.clone(),
            attributes: properties.into_attributes(),
            parts: Vec::new(),
            geometries: vec![scene::Geometry {
                level_of_detail: 1.0,
                part: None,
                shape: Appearance::default().shape(solids),
                placement: None,
            }],
        };
        let was_open = areas.iter().any(|area| area.was_open);
        Ok(Read::Feature(feature, was_open.then_some(CLOSED)))
    }

    fn lines(&self, lines: &[Line], properties: &Properties) -> Result<Read, Problem> {
        let Some(class) = properties.line_street() else {
            return Ok(self.skipped("a line that is no street"));
        };
        let Some(width) = properties.width() else {
            return Ok(self.skipped("a line without a width"));
        };
        let z = self.lowest(lines)?;
        let lines = lines
            .iter()
            .map(|line| self.plan(line))
            .collect::<Result<Vec<_>, _>>()?;
        Ok(match strips(&lines, width, Ends::Round) {
            Ok(areas) => self.street(class, areas.iter().map(|area| surface(area, z)).collect()),
            Err(why) => self.skipped(why),
        })
    }

    /// The area of an outer ring and its holes; or why it is none.
    fn area(&self, rings: &[Line]) -> Result<Result<Area, &'static str>, Problem> {
        let z = self.lowest(rings)?;
        let was_open = rings.iter().any(|ring| ring.first() != ring.last());
        let plans = rings
            .iter()
            .map(|ring| self.plan(ring))
            .collect::<Result<Vec<_>, _>>()?;
        let mut plans = plans.into_iter();
        let footprint = Footprint::new(plans.next().unwrap_or_default(), plans.collect());
        Ok(footprint.map(|footprint| Area {
            footprint,
            z,
            was_open,
        }))
    }

    fn plan(&self, line: &Line) -> Result<Vec<Plan>, Problem> {
        line.iter()
            .map(|position| self.reference.place(position))
            .collect()
    }

    /// The ground below: the lowest height of all positions, zero where there is none.
    fn lowest(&self, lines: &[Line]) -> Result<f64, Problem> {
        let heights = lines.iter().flatten().filter_map(|position| position.z);
        let lowest = heights.reduce(f64::min).unwrap_or(0.0);
        match lowest.abs() <= MAX_COORDINATE {
            true => Ok(lowest + 0.0),
            false => Err(Problem::Invalid {
                what: "height of a position".into(),
                found: lowest.to_string(),
                expected: "coordinates within 1e9 of zero",
            }),
        }
    }
}

fn surface(area: &Footprint, z: f64) -> Surface {
    Surface {
        rings: area.at(z),
        ..Surface::default()
    }
}
