//! Cities made from a seed, for tests and benchmarks.

use crate::{Box3d, Street};
use geo::{Coord, Rect};
use glam::{DVec2, DVec3};

/// Side of the scattered city's square, metres (2004 report, section 8).
const SIDE: f64 = 1000.0;

/// The scattered city's one street runs along x between these two y, metres.
const STREET: [f64; 2] = [475.0, 525.0];

/// Least and greatest edge of the scattered city's boxes, metres.
const EDGE: [f64; 2] = [0.5, 100.0];

/// Eye heights above the ground, metres.
const EYES: [f64; 2] = [1.5, 2.0];

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
    let mut random = SplitMix64(seed);
    let boxes = (0..features)
        .map(|_| {
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
        .collect();
    let area = Rect::new(
        Coord {
            x: 0.0,
            y: STREET[0],
        },
        Coord {
            x: SIDE,
            y: STREET[1],
        },
    );
    let street = Street {
        area: area.to_polygon(),
        eye_low: EYES[0],
        eye_high: EYES[1],
    };
    BoxCity {
        boxes,
        streets: vec![street],
    }
}

/// Steele, Lea, Flood 2014, "Fast splittable pseudorandom number generators": integer steps only,
/// so that a seed means the same city everywhere and forever.
struct SplitMix64(u64);

impl SplitMix64 {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// A number in [0, 1) with 53 random bits.
    fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + self.unit() * (high - low)
    }
}

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
    fn the_generator_gives_its_published_numbers() {
        let mut random = SplitMix64(1_234_567);
        assert_eq!(random.next(), 6_457_827_717_110_365_317);
        assert_eq!(random.next(), 3_203_168_211_198_807_973);
    }
}
