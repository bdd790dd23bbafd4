//! [`Source`], a row that is to become a feature.

use crate::scene::polygon;
use geo::Polygon;
use pgrx::JsonB;
use pgrx::spi::SpiHeapTupleData;

/// A row that is to become a feature. Its columns: name text, class text, attributes jsonb, then
/// footprint text[] (rings as core's polygon writes them, a null between polygons), bottom and top in metres, or surfaces
/// bytea (well-known binary).
pub struct Source {
    /// Identifier, if it has one.
    pub name: Option<String>,
    /// Kind of object, if it names one.
    class: Option<String>,
    /// Attributes.
    pub attributes: Option<serde_json::Value>,
    /// What it is made of.
    pub shape: Shape,
}

/// What a feature is made from.
pub enum Shape {
    /// Footprints raised from one height to another, metres.
    Raised(Vec<Polygon<f64>>, f64, f64),
    /// Surfaces in well-known binary.
    Surfaces(Vec<u8>),
    /// Nothing that can be used, with the reason.
    Nothing(String),
}

impl Source {
    /// Kind of object: a building where the row names none.
    pub fn class(&self) -> &str {
        self.class.as_deref().unwrap_or("Building")
    }

    /// Takes a row apart.
    pub fn of(row: &SpiHeapTupleData) -> Result<Self, pgrx::spi::Error> {
        let rings: Option<Vec<Option<String>>> = row.get(4)?;
        let surfaces: Option<Vec<u8>> = row.get(7)?;
        let shape = match (rings, surfaces) {
            (_, Some(surfaces)) => Shape::Surfaces(surfaces),
            (Some(rings), None) => raised(rings, row.get(5)?, row.get(6)?),
            (None, None) => Shape::Nothing("no footprint".to_owned()),
        };
        Ok(Self {
            name: row.get(1)?,
            class: row.get(2)?,
            attributes: row.get::<JsonB>(3)?.map(|attributes| attributes.0),
            shape,
        })
    }
}

fn raised(rings: Vec<Option<String>>, bottom: Option<f64>, top: Option<f64>) -> Shape {
    let why = match (footprints(&rings), bottom, top) {
        (None, _, _) => "no footprint".to_owned(),
        (_, None, _) | (_, _, None) => "no height".to_owned(),
        (Some(footprints), Some(bottom), Some(top)) => {
            if bottom < top && bottom.is_finite() && top.is_finite() {
                return Shape::Raised(footprints, bottom, top);
            }
            format!("heights {bottom} to {top} are out of order")
        }
    };
    Shape::Nothing(why)
}

/// The polygons of rings, those after a null another one's; `None` where there is none.
fn footprints(rings: &[Option<String>]) -> Option<Vec<Polygon<f64>>> {
    let polygons = rings
        .split(Option::is_none)
        .filter(|rings| !rings.is_empty());
    let polygons: Option<Vec<_>> = polygons
        .map(|rings| polygon::area(&rings.iter().flatten().cloned().collect::<Vec<_>>()))
        .collect();
    polygons.filter(|polygons| !polygons.is_empty())
}
