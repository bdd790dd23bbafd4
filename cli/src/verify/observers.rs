//! Where the observers of a verification stand.

use fastrand::Rng;
use geo::{Area, BoundingRect, Coord, Intersects};

use crate::scene::{Scene, Street, Volume};

/// How often a random choice is tried before another kind of observer takes its place.
pub const TRIES: usize = 64;

/// Where the observers stand.
#[derive(Clone, Debug, PartialEq)]
pub struct Observers {
    /// Their eyes.
    pub eyes: Vec<[f64; 3]>,
    /// How many of them are on corners and edges of volumes.
    pub on_volumes: usize,
}

/// Random eyes in the view region: every other one on a corner or an edge of a random volume, the
/// rest anywhere in the streets, evenly over their area. Without streets there are none.
pub fn choose(scene: &Scene, volumes: &[Volume], count: usize, seed: u64) -> Observers {
    let mut rng = Rng::with_seed(seed);
    let streets = Streets::new(&scene.streets);
    let mut observers = Observers {
        eyes: Vec::with_capacity(count),
        on_volumes: 0,
    };
    for i in 0..count {
        let on_volume = match i % 2 {
            1 => on_volume(volumes, &streets, &mut rng),
            _ => None,
        };
        observers.on_volumes += usize::from(on_volume.is_some());
        let eye = on_volume.or_else(|| in_street(scene, &streets, &mut rng));
        observers.eyes.extend(eye);
    }
    observers
}

/// An eye on a corner or an edge of the part of a volume that lies in the view region: volumes may
/// reach over the border of a street and of its eye heights.
fn on_volume(volumes: &[Volume], streets: &Streets, rng: &mut Rng) -> Option<[f64; 3]> {
    (0..TRIES).find_map(|_| {
        let volume = rng.choice(volumes)?;
        let (min, max) = (volume.bounds.min, volume.bounds.max);
        let mut eye = std::array::from_fn(|axis| if rng.bool() { min[axis] } else { max[axis] });
        if rng.bool() {
            let along = rng.usize(..3);
            eye[along] = between(rng, min[along], max[along]);
        }
        let [x, y, z] = eye;
        let [low, high] = streets.eyes_at([x, y], [min[2], max[2]])?;
        Some([x, y, z.clamp(low, high)])
    })
}

/// An eye anywhere in the streets, outside of what is known to be solid.
fn in_street(scene: &Scene, streets: &Streets, rng: &mut Rng) -> Option<[f64; 3]> {
    let is_free = |eye: &[f64; 3]| {
        !scene
            .features
            .iter()
            .any(|feature| feature.is_solid_at(*eye))
    };
    (0..TRIES)
        .filter_map(|_| streets.random_eye(rng))
        .find(is_free)
}

/// Streets by area.
pub struct Streets<'a> {
    streets: &'a [Street],
    /// For each street the area of it and all before it.
    areas: Vec<f64>,
}

impl<'a> Streets<'a> {
    /// Those of a scene.
    pub fn new(streets: &'a [Street]) -> Self {
        let areas = streets.iter().scan(0.0, |sum, street| {
            *sum += street.area.unsigned_area();
            Some(*sum)
        });
        Self {
            streets,
            areas: areas.collect(),
        }
    }

    /// The lowest and highest eye at a place within a range of heights, by the first street that
    /// holds some, its border included.
    pub fn eyes_at(&self, [x, y]: [f64; 2], [low, high]: [f64; 2]) -> Option<[f64; 2]> {
        let heights = |street: &Street| {
            let (low, high) = (low.max(street.eye_low), high.min(street.eye_high));
            let is_here = low <= high && street.area.intersects(&Coord { x, y });
            is_here.then_some([low, high])
        };
        self.streets.iter().find_map(heights)
    }

    fn random_eye(&self, rng: &mut Rng) -> Option<[f64; 3]> {
        let place = rng.f64() * self.areas.last()?;
        let position = self.areas.partition_point(|&area| area <= place);
        let street = self.streets.get(position)?;
        let rect = street.area.bounding_rect()?;
        let place = (0..TRIES).find_map(|_| {
            let x = between(rng, rect.min().x, rect.max().x);
            let y = between(rng, rect.min().y, rect.max().y);
            street.area.intersects(&Coord { x, y }).then_some([x, y])
        });
        let [x, y] = place?;
        Some([x, y, between(rng, street.eye_low, street.eye_high)])
    }
}

fn between(rng: &mut Rng, low: f64, high: f64) -> f64 {
    (low + rng.f64() * (high - low)).clamp(low, high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sql_types::{Box3d, Ring};

    /// An L of two streets, 10 m wide.
    fn scene() -> Scene {
        let rect = |left: f64, bottom: f64, right: f64, top: f64| {
            let ring = Ring(vec![
                [left, bottom],
                [right, bottom],
                [right, top],
                [left, top],
            ]);
            Street::new(vec![ring], 1.5, 2.0)
        };
        Scene {
            features: Vec::new(),
            streets: [rect(0.0, 0.0, 90.0, 10.0), rect(0.0, 10.0, 10.0, 20.0)]
                .into_iter()
                .flatten()
                .collect(),
            attribution: None,
        }
    }

    fn volume(min: [f64; 3], max: [f64; 3]) -> Volume {
        Volume {
            occluder: 1,
            occludee: 2,
            bounds: Box3d { min, max },
        }
    }

    #[test]
    fn observers_are_spread_by_area_and_repeat_with_their_seed() {
        let observers = choose(&scene(), &[], 1000, 7);
        let eyes = &observers.eyes;
        assert_eq!(eyes.len(), 1000);
        let short = eyes.iter().filter(|eye| eye[1] > 10.0).count();
        assert!((60..140).contains(&short), "{short}");
        assert!(
            eyes.iter()
                .all(|eye| eye[0] <= 90.0 && (1.5..=2.0).contains(&eye[2]))
        );
        assert_eq!(choose(&scene(), &[], 1000, 7), observers);
        assert_ne!(choose(&scene(), &[], 1000, 8), observers);
    }

    #[test]
    fn half_of_them_stand_on_edges_of_volumes() {
        let within = volume([20.0, 0.0, 1.5], [25.0, 10.0, 2.0]);
        let on_edge = |eye: &&[f64; 3]| {
            let on = |axis: usize| {
                [within.bounds.min[axis], within.bounds.max[axis]].contains(&eye[axis])
            };
            (0..3).filter(|&axis| on(axis)).count() >= 2
        };
        let Observers { eyes, on_volumes } = choose(&scene(), &[within], 100, 1);
        assert_eq!((on_volumes, eyes.len()), (50, 100));
        assert_eq!(eyes.iter().filter(on_edge).count(), 50);
    }

    #[test]
    fn volumes_are_cut_to_the_eye_heights() {
        let tall = volume([20.0, -5.0, 1.75], [25.0, 10.0, 9.0]);
        let Observers { eyes, on_volumes } = choose(&scene(), &[tall], 100, 1);
        assert_eq!(on_volumes, 50);
        let on_volume: Vec<f64> = eyes.iter().skip(1).step_by(2).map(|eye| eye[2]).collect();
        assert!(
            on_volume.iter().all(|z| (1.75..=2.0).contains(z)),
            "{on_volume:?}"
        );
        assert!(on_volume.contains(&1.75) && on_volume.contains(&2.0));
    }

    #[test]
    fn volumes_outside_the_streets_are_passed_over() {
        let outside = volume([20.0, 20.0, 1.5], [25.0, 30.0, 2.0]);
        let Observers { eyes, on_volumes } = choose(&scene(), &[outside], 100, 1);
        assert_eq!((on_volumes, eyes.len()), (0, 100));
        assert!(eyes.iter().all(|eye| eye[1] <= 20.0));
        let nowhere = Scene {
            streets: Vec::new(),
            ..scene()
        };
        assert_eq!(
            choose(&nowhere, &[outside], 100, 1).eyes,
            Vec::<[f64; 3]>::new()
        );
    }
}
