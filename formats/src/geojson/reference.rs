//! What the coordinates of a document mean.

use std::borrow::Cow;

use serde_json::value::RawValue;

use super::document::{Document, object};
use super::feature::geometry_of;
use super::geometry::Position;
use super::{FeatureError, invalid, numbered};
use crate::error::{Problem, shorten};
use crate::extrusion::Plan;
use crate::input::ReadOptions;
use crate::limits::MAX_COORDINATE;
use crate::projection::{Bounds, Projection, is_geographic};

/// EPSG codes of longitude and latitude in WGS 84, in two and three dimensions.
const WGS_84: [i32; 2] = [4326, 4979];

/// How coordinates become metres.
pub(super) enum Reference {
    /// They are longitude and latitude.
    Geographic(Box<Projection>),
    /// They are metres already, in the frame with this EPSG code.
    Projected(i32),
    /// There are none.
    Nothing,
}

impl Reference {
    /// By the document and what was asked for.
    pub(super) fn of(
        document: &Document<'_>,
        options: &ReadOptions<'_>,
    ) -> Result<Self, FeatureError> {
        let whole = |problem| FeatureError {
            feature: None,
            problem,
        };
        if let Some(srid) = document.crs.map(srid).transpose().map_err(whole)?.flatten() {
            let projection = Projection::to_srid(srid).map_err(whole)?;
            return Ok(Self::Projected(projection.srid()));
        }
        let centre = match options.srid {
            Some(_) => Some([0.0; 2]),
            None => centre(document)?,
        };
        let Some(centre) = centre else {
            return Ok(Self::Nothing);
        };
        let projection = Projection::to_srid_or_zone(options.srid, centre).map_err(whole)?;
        Ok(Self::Geographic(Box::new(projection)))
    }

    /// The EPSG code of the frame in metres.
    pub(super) fn srid(&self) -> Option<i32> {
        match self {
            Self::Geographic(projection) => Some(projection.srid()),
            Self::Projected(srid) => Some(*srid),
            Self::Nothing => None,
        }
    }

    /// Where a position is, metres.
    pub(super) fn place(&self, position: &Position) -> Result<Plan, Problem> {
        let [x, y] = position.plan;
        let place = match self {
            Self::Geographic(projection) => {
                geographic(position)?;
                projection.project([x, y])
            }
            Self::Projected(_) | Self::Nothing => {
                let within = x.abs() <= MAX_COORDINATE && y.abs() <= MAX_COORDINATE;
                within.then_some([x + 0.0, y + 0.0])
            }
        };
        place.ok_or_else(|| wrong(position, "coordinates within reach of the projection"))
    }
}

/// Refuses what is no longitude and latitude: coordinates of another system read as degrees would
/// put a city anywhere.
fn geographic(position: &Position) -> Result<(), Problem> {
    match is_geographic(position.plan) {
        true => Ok(()),
        false => Err(wrong(
            position,
            "a longitude and a latitude, or a crs member that names the system",
        )),
    }
}

fn wrong(position: &Position, expected: &'static str) -> Problem {
    let [x, y] = position.plan;
    invalid("position", &format!("{x} {y}"), expected)
}

/// The middle of the box around all positions.
fn centre(document: &Document<'_>) -> Result<Option<Plan>, FeatureError> {
    let mut bounds = Bounds::default();
    for (number, raw) in document.features.iter().enumerate() {
        let inside = |problem| FeatureError {
            feature: Some(numbered(number)),
            problem,
        };
        let Some(geometry) = geometry_of(raw).map_err(inside)? else {
            continue;
        };
        for position in geometry.positions() {
            geographic(position).map_err(inside)?;
            bounds.add(position.plan);
        }
    }
    Ok(bounds.centre())
}

#[derive(serde::Deserialize)]
struct Crs<'a> {
    #[serde(borrow)]
    properties: Option<CrsProperties<'a>>,
}

#[derive(serde::Deserialize)]
struct CrsProperties<'a> {
    #[serde(borrow)]
    name: Option<Cow<'a, str>>,
}

/// The EPSG code of a system that is not longitude and latitude, by the last part of a name such
/// as `urn:ogc:def:crs:EPSG::28992`.
fn srid(crs: &RawValue) -> Result<Option<i32>, Problem> {
    let system: Crs<'_> = object("crs", crs)?;
    let name = system.properties.and_then(|properties| properties.name);
    let name = name.ok_or_else(|| invalid("crs", &shorten(crs.get()), "a system by name"))?;
    let last = name.rsplit([':', '/']).next().unwrap_or_default();
    if last.eq_ignore_ascii_case("CRS84") || last.eq_ignore_ascii_case("CRS84h") {
        return Ok(None);
    }
    let parts = || name.split([':', '/']);
    let is_epsg = parts().any(|part| part.eq_ignore_ascii_case("EPSG"));
    let code = last.parse().ok().filter(|code: &i32| is_epsg && *code > 0);
    let code = code.ok_or_else(|| invalid("crs", &name, "the name of a system of epsg"))?;
    Ok((!WGS_84.contains(&code)).then_some(code))
}
