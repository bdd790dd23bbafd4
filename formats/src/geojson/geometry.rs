//! Geometries with positions as they are written.

use std::borrow::Cow;
use std::fmt;

use serde::de::{Deserialize, Deserializer, Error, IgnoredAny, SeqAccess, Visitor};
use serde_json::value::RawValue;

use super::document::{object, parse};
use crate::error::{Problem, quote};

/// A position: two coordinates, and a height where there is one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Position {
    /// Longitude and latitude, or east and north.
    pub(super) plan: [f64; 2],
    /// The third coordinate.
    pub(super) z: Option<f64>,
}

/// A ring or a line.
pub(super) type Line = Vec<Position>;

/// The geometries that can be part of a scene.
#[derive(Debug, PartialEq)]
pub(super) enum Geometry {
    /// Outer rings, each with its holes.
    Areas(Vec<Vec<Line>>),
    /// Lines.
    Lines(Vec<Line>),
    /// Of another type, quoted.
    Other(String),
}

#[derive(serde::Deserialize)]
struct RawGeometry<'a> {
    #[serde(borrow, rename = "type")]
    kind: Cow<'a, str>,
    #[serde(borrow)]
    coordinates: Option<&'a RawValue>,
}

impl Geometry {
    /// Reads a geometry.
    pub(super) fn parse(raw: &RawValue) -> Result<Self, Problem> {
        let RawGeometry { kind, coordinates } = object("geometry", raw)?;
        let coordinates = || {
            coordinates.ok_or_else(|| Problem::Missing {
                what: "coordinates".into(),
            })
        };
        let what = "coordinates";
        Ok(match kind.as_ref() {
            "Polygon" => Self::Areas(vec![parse(what, coordinates()?)?]),
            "MultiPolygon" => Self::Areas(parse(what, coordinates()?)?),
            "LineString" => Self::Lines(vec![parse(what, coordinates()?)?]),
            "MultiLineString" => Self::Lines(parse(what, coordinates()?)?),
            kind => Self::Other(quote(kind)),
        })
    }

    /// All positions.
    pub(super) fn positions(&self) -> impl Iterator<Item = &Position> {
        let (areas, lines) = match self {
            Self::Areas(areas) => (areas.as_slice(), [].as_slice()),
            Self::Lines(lines) => ([].as_slice(), lines.as_slice()),
            Self::Other(_) => ([].as_slice(), [].as_slice()),
        };
        areas.iter().flatten().chain(lines).flatten()
    }
}

impl<'de> Deserialize<'de> for Position {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(PositionVisitor)
    }
}

struct PositionVisitor;

impl<'de> Visitor<'de> for PositionVisitor {
    type Value = Position;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a position of two or three numbers")
    }

    fn visit_seq<S: SeqAccess<'de>>(self, mut seq: S) -> Result<Position, S::Error> {
        let short = |count| S::Error::invalid_length(count, &"a position of two or three numbers");
        let x = seq.next_element()?.ok_or_else(|| short(0))?;
        let y = seq.next_element()?.ok_or_else(|| short(1))?;
        let z = seq.next_element()?;
        // Some writers add a measure, which the format says to pass over.
        while seq.next_element::<IgnoredAny>()?.is_some() {}
        Ok(Position { plan: [x, y], z })
    }
}
