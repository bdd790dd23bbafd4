//! [`Solid`], a generated building before it is drawn.

use glam::{DVec3, I64Vec2};

use super::feature::CityFeature;
use super::inner_box::largest_rectangle;
use super::lattice::{length, position};
use super::strip::Strip;
use crate::{Box3d, SolidColumn, TriangleMesh};

/// What a building ends in, above its eaves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Roof {
    /// A level roof.
    Flat,
    /// Two slopes up to a ridge over a footprint of four corners.
    Gable {
        /// Height of the ridge above the eaves.
        rise: i64,
        /// Whether the gable faces the first edge of the footprint, or the ridge runs along it.
        faces_front: bool,
    },
}

/// A building: all lengths in lattice units.
#[derive(Clone, Debug, PartialEq)]
pub struct Solid {
    /// What it is called.
    pub kind: &'static str,
    pub footprint: Strip,
    pub eaves: i64,
    pub roof: Roof,
}

impl Solid {
    /// The building as a feature; under its eaves it is solid all over its footprint.
    pub fn feature(&self) -> CityFeature {
        let eaves = length(self.eaves);
        let [min, max] = largest_rectangle(&self.footprint).map(position);
        CityFeature::new(
            self.kind,
            self.mesh(),
            SolidColumn {
                footprint: self.footprint.polygon(),
                bottom: 0.0,
                top: eaves,
                grounded: true,
            },
            Box3d::new(min.extend(0.0), max.extend(eaves)),
        )
    }

    fn mesh(&self) -> TriangleMesh {
        let eaves = length(self.eaves);
        match (self.roof, self.footprint.quads().next()) {
            (Roof::Gable { rise, faces_front }, Some(mut quad)) => {
                if faces_front {
                    quad.rotate_left(1);
                }
                gabled_house(quad, eaves, eaves + length(rise))
            }
            _ => self.footprint.prism(eaves),
        }
    }
}

/// A house over four corners, anticlockwise, whose ridge runs along the first edge.
fn gabled_house(corners: [I64Vec2; 4], eaves: f64, ridge: f64) -> TriangleMesh {
    let [a, b, c, d] = corners.map(position);
    let level = |z: f64| [a, b, c, d].map(|p| p.extend(z));
    let ends: [DVec3; 2] = [(b + c) / 2.0, (d + a) / 2.0].map(|p| p.extend(ridge));
    TriangleMesh {
        vertices: level(0.0)
            .into_iter()
            .chain(level(eaves))
            .chain(ends)
            .collect(),
        triangles: GABLED_HOUSE.to_vec(),
        untriangulable_faces: 0,
    }
}

/// Corners 0 to 3 on the ground, 4 to 7 at the eaves above them, 8 and 9 the ends of the ridge.
const GABLED_HOUSE: [[u32; 3]; 16] = [
    [0, 2, 1], // bottom
    [0, 3, 2],
    [0, 1, 5], // walls under the eaves
    [0, 5, 4],
    [2, 3, 7],
    [2, 7, 6],
    [1, 2, 6], // gables
    [1, 6, 5],
    [5, 6, 8],
    [3, 0, 4],
    [3, 4, 7],
    [7, 4, 9],
    [4, 5, 8], // slopes
    [4, 8, 9],
    [6, 7, 9],
    [6, 9, 8],
];
