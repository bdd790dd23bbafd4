//! [`extruded`], a footprint with heights as a solid.

use geo::{LineString, Polygon};
use glam::DVec3;

use super::triangle_mesh::TriangleMesh;
use super::triangulate::{PolygonDefect, edges, triangulate_strictly};
use crate::SolidColumn;

/// A footprint raised to a solid.
#[derive(Clone, Debug, PartialEq)]
pub struct Extrusion {
    /// Its closed surface.
    pub mesh: TriangleMesh,
    /// The solid itself, which is one column, not yet known to stand on the ground.
    pub column: SolidColumn,
}

/// The solid over `footprint` (rings in any direction, the first vertex repeated at the end or not)
/// from height `bottom` up to `top`, metres.
///
/// Heights out of order give a solid turned inside out.
///
/// # Errors
/// [`PolygonDefect`] when the rings bound no polygon, or bound no area.
pub fn extruded(
    footprint: &Polygon<f64>,
    bottom: f64,
    top: f64,
) -> Result<Extrusion, PolygonDefect> {
    let flat = |ring: &LineString<f64>| -> Vec<DVec3> {
        let mut ring: Vec<DVec3> = ring.0.iter().map(|c| DVec3::new(c.x, c.y, 0.0)).collect();
        ring.dedup();
        while ring.len() > 1 && ring.first() == ring.last() {
            ring.pop();
        }
        ring
    };
    let mut rings = vec![flat(footprint.exterior())];
    rings.extend(footprint.interiors().iter().map(flat));
    for (number, ring) in rings.iter_mut().enumerate() {
        if (signed_area(ring) > 0.0) != (number == 0) {
            ring.reverse();
        }
    }
    let cover = triangulate_strictly(&rings)?;
    if rings.iter().any(|ring| signed_area(ring) == 0.0) {
        return Err(PolygonDefect::Overlapping);
    }
    let flat: Vec<DVec3> = rings.iter().flatten().copied().collect();
    let at = |p: DVec3, z: f64| DVec3::new(p.x, p.y, z);
    let roof = cover.iter().map(|t| t.map(|i| at(flat[i], top)));
    let floor = cover
        .iter()
        .map(|&[a, b, c]| [a, c, b].map(|i| at(flat[i], bottom)));
    let walls = rings
        .iter()
        .flat_map(|ring| edges(ring))
        .flat_map(|(from, to)| {
            let [a, b] = [at(from, bottom), at(to, bottom)];
            let [c, d] = [at(to, top), at(from, top)];
            [[a, b, c], [a, c, d]]
        });
    Ok(Extrusion {
        mesh: TriangleMesh::from_triangles(roof.chain(floor).chain(walls)),
        column: SolidColumn {
            footprint: polygon(&rings),
            bottom,
            top,
            grounded: true,
        },
    })
}

/// Twice the area, positive when the ring turns anticlockwise.
fn signed_area(ring: &[DVec3]) -> f64 {
    let origin = ring.first().copied().unwrap_or_default();
    edges(ring)
        .map(|(from, to)| {
            (from - origin)
                .truncate()
                .perp_dot((to - origin).truncate())
        })
        .sum()
}

fn polygon(rings: &[Vec<DVec3>]) -> Polygon<f64> {
    let mut rings = rings
        .iter()
        .map(|ring| LineString::from_iter(ring.iter().map(|p| (p.x, p.y))));
    let exterior = rings.next().unwrap_or(LineString::new(Vec::new()));
    Polygon::new(exterior, rings.collect())
}

#[cfg(test)]
mod tests {
    use geo::{Area, polygon};

    use super::*;
    use crate::Closedness;

    fn footprint() -> Polygon<f64> {
        // The outer ring turns clockwise, the hole anticlockwise.
        polygon!(
            exterior: [
                (x: 85_000.001, y: 447_000.0), (x: 85_000.001, y: 447_020.0),
                (x: 85_030.0, y: 447_020.0), (x: 85_030.0, y: 447_000.0),
            ],
            interiors: [[
                (x: 85_010.0, y: 447_005.0), (x: 85_020.0, y: 447_005.0), (x: 85_020.0, y: 447_015.0),
            ]],
        )
    }

    #[test]
    fn the_solid_is_closed_and_turned_outwards() {
        let solid = extruded(&footprint(), -1.5, 8.0).unwrap();
        assert_eq!(solid.mesh.closedness(), Closedness::Closed);
        let volume = footprint().unsigned_area() * 9.5;
        assert!((solid.mesh.signed_volume() - volume).abs() < 1e-3);
        assert!((solid.column.footprint.signed_area() * 9.5 - volume).abs() < 1e-3);
        assert_eq!(solid.column.footprint.interiors().len(), 1);
        assert_eq!((solid.column.bottom, solid.column.top), (-1.5, 8.0));
    }

    #[test]
    fn rings_that_bound_nothing_are_refused() {
        let bow = polygon![(x: 0.0, y: 0.0), (x: 4.0, y: 4.0), (x: 4.0, y: 0.0), (x: 0.0, y: 4.0)];
        assert!(extruded(&bow, 0.0, 1.0).is_err());
        let line = polygon![(x: 0.0, y: 0.0), (x: 4.0, y: 4.0), (x: 8.0, y: 8.0)];
        assert!(extruded(&line, 0.0, 1.0).is_err());
        let nothing = Polygon::new(LineString::new(Vec::new()), Vec::new());
        assert!(extruded(&nothing, 0.0, 1.0).is_err());
        let nowhere = polygon![(x: f64::NAN, y: 0.0), (x: 4.0, y: 4.0), (x: 8.0, y: 0.0)];
        assert_eq!(extruded(&nowhere, 0.0, 1.0), Err(PolygonDefect::NotFinite));
    }
}
