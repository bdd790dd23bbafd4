//! The layout `scattered`: the city of the 2004 report.

use geo::{Coord, Rect};
use glam::{DVec2, DVec3};

use super::feature::CityFeature;
use super::random::SplitMix64;
use super::street;
use crate::{Box3d, SolidColumn, Street, TriangleMesh};

/// Side of the scattered city's square, metres (2004 report, section 8).
const SIDE: f64 = 1000.0;

/// The scattered city's one street runs along x between these two y, metres.
const STREET: [f64; 2] = [475.0, 525.0];

/// Least and greatest edge of the scattered city's boxes, metres.
const EDGE: [f64; 2] = [0.5, 100.0];

/// Random numbers that one box takes.
const DRAWS: u64 = 6;

/// A city of boxes with its streets.
#[derive(Clone, Debug, PartialEq)]
pub struct BoxCity {
    /// One solid box a feature, all standing on z = 0.
    pub boxes: Vec<Box3d>,
    /// Where observers can be.
    pub streets: Vec<Street>,
}

/// The city of the 2004 report's test: `features` boxes of random size and place on both sides
/// of one straight street. The same seed gives the same boxes on every machine.
#[must_use]
pub fn scattered_city(features: usize, seed: u64) -> BoxCity {
    BoxCity {
        boxes: boxes(seed, 0).take(features).collect(),
        streets: vec![main_street()],
    }
}

/// The boxes of a seed without end, from number `first` on.
pub fn boxes(seed: u64, first: u64) -> impl Iterator<Item = Box3d> {
    let mut random = SplitMix64::new(seed, first.wrapping_mul(DRAWS));
    std::iter::repeat_with(move || {
        let size = DVec3::new(
            random.between(EDGE[0], EDGE[1]),
            random.between(EDGE[0], EDGE[1]),
            random.between(EDGE[0], EDGE[1]),
        );
        let x = random.between(0.0, SIDE - size.x);
        let north = random.unit() < 0.5;
        let room = STREET[0] - size.y;
        let y = random.between(0.0, room) + if north { STREET[1] } else { 0.0 };
        let foot = DVec2::new(x, y).extend(0.0);
        Box3d::new(foot, foot + size)
    })
}

/// The one street.
pub fn main_street() -> Street {
    let corner = |x: f64, y: f64| Coord { x, y };
    street(Rect::new(corner(0.0, STREET[0]), corner(SIDE, STREET[1])).to_polygon())
}

/// A box as a feature: all of it is solid.
pub fn feature(bounds: Box3d) -> CityFeature {
    let corner = |p: DVec3| Coord { x: p.x, y: p.y };
    let mesh = TriangleMesh {
        vertices: bounds.corners().to_vec(),
        triangles: BOX.to_vec(),
        untriangulable_faces: 0,
    };
    let column = SolidColumn {
        footprint: Rect::new(corner(bounds.min), corner(bounds.max)).to_polygon(),
        bottom: bounds.min.z,
        top: bounds.max.z,
        grounded: true,
    };
    CityFeature::new("box", mesh, column, bounds)
}

/// The triangles of a box whose corners are numbered by bits: 1 for x, 2 for y, 4 for z.
const BOX: [[u32; 3]; 12] = [
    [0, 2, 3], // bottom
    [0, 3, 1],
    [4, 5, 7], // top
    [4, 7, 6],
    [0, 1, 5], // front
    [0, 5, 4],
    [2, 6, 7], // back
    [2, 7, 3],
    [0, 4, 6], // left
    [0, 6, 2],
    [1, 3, 7], // right
    [1, 7, 5],
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_seed_gives_the_same_city_and_another_seed_another() {
        assert_eq!(scattered_city(50, 7), scattered_city(50, 7));
        assert_ne!(scattered_city(50, 7).boxes, scattered_city(50, 8).boxes);
    }

    #[test]
    fn boxes_stand_inside_the_square_and_off_the_street() {
        for found in scattered_city(2000, 1).boxes {
            assert!(
                found.min.cmpge(DVec3::ZERO).all() && found.max.x <= SIDE && found.max.y <= SIDE
            );
            assert!(found.max.y <= STREET[0] || found.min.y >= STREET[1]);
            assert!(found.size().min_element() >= EDGE[0]);
            assert!(found.size().max_element() <= EDGE[1]);
        }
    }

    #[test]
    fn boxes_may_be_taken_from_any_number_on() {
        let later: Vec<Box3d> = boxes(7, 30).take(20).collect();
        assert_eq!(later, scattered_city(50, 7).boxes[30..]);
    }
}
