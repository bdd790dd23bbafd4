//! [`Street`], a piece of the view region.

use geo::{Coord, LineString, Polygon};

use crate::sql_types::Ring;

/// A polygon of ground with the heights of the eyes there.
#[derive(Clone, Debug, PartialEq)]
pub struct Street {
    /// Where observers stand.
    pub area: Polygon<f64>,
    /// Lowest eye, absolute metres.
    pub eye_low: f64,
    /// Highest eye, absolute metres.
    pub eye_high: f64,
}

impl Street {
    /// From its rings, the outer one first; `None` without any.
    pub fn new(rings: Vec<Ring>, eye_low: f64, eye_high: f64) -> Option<Self> {
        Some(Self {
            area: polygon(rings)?,
            eye_low,
            eye_high,
        })
    }
}

/// The polygon of rings, the outer one first; `None` without any.
pub fn polygon(rings: Vec<Ring>) -> Option<Polygon<f64>> {
    let line = |ring: Ring| -> LineString<f64> {
        ring.0.into_iter().map(|[x, y]| Coord { x, y }).collect()
    };
    let mut rings = rings.into_iter().map(line);
    let outer = rings.next()?;
    Some(Polygon::new(outer, rings.collect()))
}

/// The rings of a polygon as tables hold them.
pub fn rings(area: &Polygon<f64>) -> Vec<Ring> {
    let ring = |line: &LineString<f64>| {
        // The closing vertex is left out.
        let vertices = &line.0[..line.0.len().saturating_sub(1)];
        Ring(vertices.iter().map(|c| [c.x, c.y]).collect())
    };
    std::iter::once(area.exterior())
        .chain(area.interiors())
        .map(ring)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polygons_survive_as_rings() {
        let outer = Ring(vec![[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]]);
        let hole = Ring(vec![[1.0, 1.0], [1.0, 2.0], [2.0, 2.0]]);
        let street = Street::new(vec![outer.clone(), hole.clone()], 1.5, 2.0).unwrap();
        assert_eq!(rings(&street.area), [outer, hole]);
        assert_eq!(Street::new(Vec::new(), 1.5, 2.0), None);
    }
}
