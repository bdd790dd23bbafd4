//! Boxes like occlusion volumes: along streets, of many sizes and shapes, many over each point.

use engine::{CityLayout, Street, generated_city};
use fastrand::Rng;
use geo::{BoundingRect, Coord, Intersects};

use crate::sql_types::Box3d;

/// Volumes for each building of the city whose streets they lie in.
const VOLUMES_OF_BUILDING: usize = 100;

/// Fewest buildings.
const FEWEST_BUILDINGS: usize = 100;

/// How often a place in a street's bounding rectangle is drawn before its corner is taken.
const TRIES: usize = 64;

/// Volumes and eyes of the sample from which the size of volumes is found.
const SAMPLE: (usize, usize) = (20_000, 2_000);

/// Halvings of the interval in which that size is, from a millimetre to 10 km: to a part in 10^6.
const HALVINGS: usize = 40;

/// The streets of a city, along a space-filling curve.
pub struct Streets(Vec<Street>);

/// A volume before it has a size: its middle, and width, length and height range.
struct Shape {
    middle: [f64; 2],
    half: [f64; 2],
    heights: [f64; 2],
}

impl Streets {
    /// The streets of a city for so many volumes.
    pub fn of_city(volumes: usize, seed: u64) -> Self {
        let buildings = (volumes / VOLUMES_OF_BUILDING).max(FEWEST_BUILDINGS);
        let city = generated_city(CityLayout::Streets, buildings, seed);
        Self(city.streets().collect())
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// A random eye in one of them.
    pub fn eye(&self, street: usize, rng: &mut Rng) -> [f64; 3] {
        let street = &self.0[street];
        let height = street.eye_low + rng.f64() * (street.eye_high - street.eye_low);
        let corner = street.area.exterior()[0];
        let place = street.area.bounding_rect().and_then(|rect| {
            let mut draw = || Coord {
                x: rect.min().x + rng.f64() * rect.width(),
                y: rect.min().y + rng.f64() * rect.height(),
            };
            (0..TRIES)
                .map(|_| draw())
                .find(|place| street.area.intersects(place))
        });
        let Coord { x, y } = place.unwrap_or(corner);
        [x, y, height]
    }
}

/// As many volumes as are asked for, so large that `depth` of them overlap an eye in the mean.
pub fn volumes(streets: &Streets, count: usize, depth: usize, seed: u64) -> Vec<Box3d> {
    let mut rng = Rng::with_seed(seed);
    let shapes: Vec<Shape> = (0..count)
        .map(|i| shape(streets.eye(i * streets.len() / count, &mut rng), &mut rng))
        .collect();
    let eyes: Vec<[f64; 3]> = (0..SAMPLE.1)
        .map(|_| streets.eye(rng.usize(..streets.len()), &mut rng))
        .collect();
    let size = size(&shapes, &eyes, depth);
    shapes.iter().map(|shape| shape.scaled(size)).collect()
}

/// A volume around an eye, up to 49 times as large in plan as another and up to four times as
/// long as wide, that reaches from below the eyes to some metres above them.
fn shape([x, y, _]: [f64; 3], rng: &mut Rng) -> Shape {
    let width = 0.25 + 1.5 * rng.f64() * rng.f64();
    let aspect = (1.0 + 3.0 * rng.f64()).sqrt();
    let mut half = [width / aspect, width * aspect];
    if rng.bool() {
        half.reverse();
    }
    let above = rng.f64();
    Shape {
        middle: [x, y],
        half,
        heights: [1.5 * rng.f64(), 2.0 + 10.0 * above * above],
    }
}

impl Shape {
    fn scaled(&self, size: f64) -> Box3d {
        let [x, y] = self.middle;
        let [dx, dy] = self.half.map(|half| half * size);
        let [low, high] = self.heights;
        Box3d {
            min: [x - dx, y - dy, low],
            max: [x + dx, y + dy, high],
        }
    }
}

/// The size at which `depth` of the shapes overlap an eye in the mean.
fn size(shapes: &[Shape], eyes: &[[f64; 3]], depth: usize) -> f64 {
    let step = (shapes.len() / SAMPLE.0).max(1);
    let sample: Vec<&Shape> = shapes.iter().step_by(step).collect();
    let wanted = depth as f64 * sample.len() as f64 / shapes.len() as f64 * eyes.len() as f64;
    let covers = |size: f64| {
        let volumes = sample.iter().map(|shape| shape.scaled(size));
        let over_eyes =
            |volume: Box3d| eyes.iter().filter(|eye| volume.holds(**eye)).count() as f64;
        volumes.map(over_eyes).sum::<f64>() >= wanted
    };
    let (mut small, mut large) = (1e-3_f64, 1e4_f64);
    for _ in 0..HALVINGS {
        let middle = (small * large).sqrt();
        if covers(middle) {
            large = middle;
        } else {
            small = middle;
        }
    }
    large
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_many_volumes_as_wanted_overlap_an_eye() {
        let streets = Streets::of_city(20_000, 1);
        for depth in [50, 500] {
            let volumes = volumes(&streets, 20_000, depth, 7);
            let mut rng = Rng::with_seed(3);
            let over = |_| {
                let eye = streets.eye(rng.usize(..streets.len()), &mut rng);
                volumes.iter().filter(|volume| volume.holds(eye)).count()
            };
            let mean = (0..300).map(over).sum::<usize>() as f64 / 300.0;
            let ratio = mean / depth as f64;
            assert!((0.85..1.15).contains(&ratio), "{mean} for {depth}");
        }
    }

    #[test]
    fn a_seed_means_the_same_volumes_along_the_streets() {
        let streets = Streets::of_city(1000, 1);
        let first = volumes(&streets, 1000, 20, 7);
        assert_eq!(first, volumes(&streets, 1000, 20, 7));
        assert_ne!(first, volumes(&streets, 1000, 20, 8));
        let heights = |volume: &Box3d| volume.min[2] <= 1.5 && volume.max[2] >= 2.0;
        assert!(first.iter().all(heights));
    }
}
