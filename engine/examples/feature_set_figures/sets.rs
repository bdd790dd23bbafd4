//! Sets of features of a generated city, by their place in its order.

use engine::{Box3d, CityFeature, CityLayout, generated_city};
use glam::{DVec2, DVec3};
use proptest::prelude::Rng;
use proptest::test_runner::{RngAlgorithm, TestRng};

/// Sets of each family.
const SETS: usize = 300;

/// Sets that are alike.
pub struct Family {
    pub name: &'static str,
    pub sets: Vec<Vec<u32>>,
}

/// All families.
pub fn families(features: usize) -> Vec<Family> {
    let city: Vec<CityFeature> = generated_city(CityLayout::Streets, features, 1)
        .features()
        .collect();
    let centers: Vec<DVec2> = city
        .iter()
        .map(|feature| feature.envelope.center().truncate())
        .collect();
    let mut random = Random::new();
    let shuffled = random.permutation(features);
    let eyes: Vec<DVec2> = (0..SETS)
        .map(|_| centers[random.below(features)] + DVec2::new(9.0, 13.0))
        .collect();
    let near = |count: usize| -> Vec<Vec<u32>> {
        eyes.iter()
            .map(|&eye| nearest(&centers, eye, count))
            .collect()
    };
    let mut thinned = |count: usize, one_in: usize| {
        let mut sets = near(count);
        for set in &mut sets {
            set.retain(|_| random.below(one_in) == 0);
        }
        sets
    };
    let half = thinned(1000, 2);
    let tenth = thinned(5000, 10);
    let renumbered = |set: &Vec<u32>| {
        let mut set: Vec<u32> = set.iter().map(|&n| shuffled[n as usize]).collect();
        set.sort_unstable();
        set
    };
    let visible = near(1000)
        .into_iter()
        .zip(&eyes)
        .map(|(set, &eye)| seen(&city, set, eye));
    let family = |name, sets| Family { name, sets };
    vec![
        family("seen of the nearest 1,000", visible.collect()),
        family("nearest 500", near(500)),
        family("random tenth of the nearest 5,000", tenth),
        family(
            "random half of the nearest 1,000, ids in no order",
            half.iter().map(renumbered).collect(),
        ),
        family("random half of the nearest 1,000", half),
    ]
}

fn nearest(centers: &[DVec2], eye: DVec2, count: usize) -> Vec<u32> {
    let mut order: Vec<u32> = (0..centers.len() as u32).collect();
    let distance = |&i: &u32| centers[i as usize].distance_squared(eye);
    order.select_nth_unstable_by(count - 1, |a, b| distance(a).total_cmp(&distance(b)));
    order.truncate(count);
    order.sort_unstable();
    order
}

/// Those of the features of which a corner of the top, or the middle of it, can be seen from one of
/// five eyes that are 10 m apart at most, past all inner envelopes.
fn seen(city: &[CityFeature], features: Vec<u32>, eye: DVec2) -> Vec<u32> {
    let corners = [
        (0.0, 0.0),
        (5.0, 5.0),
        (-5.0, 5.0),
        (5.0, -5.0),
        (-5.0, -5.0),
    ];
    let eyes = corners.map(|(x, y)| DVec3::new(eye.x + x, eye.y + y, 1.75));
    let boxes: Vec<(u32, Box3d)> = features
        .iter()
        .map(|&i| (i, city[i as usize].inner_envelope))
        .collect();
    let is_seen = |&i: &u32| {
        let Box3d { min, max } = city[i as usize].envelope;
        let tops = [
            min.with_z(max.z),
            min.with_y(max.y).with_z(max.z),
            min.with_x(max.x).with_z(max.z),
            max,
            ((min + max) / 2.0).with_z(max.z),
        ];
        let free = |from: DVec3, to: DVec3| {
            !boxes
                .iter()
                .any(|(other, solid)| *other != i && crosses(solid, from, to))
        };
        eyes.iter()
            .any(|&from| tops.iter().any(|&to| free(from, to)))
    };
    features.iter().copied().filter(is_seen).collect()
}

/// Whether a segment runs through a box.
fn crosses(solid: &Box3d, from: DVec3, to: DVec3) -> bool {
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for axis in 0..3 {
        let along = to[axis] - from[axis];
        let ends = [solid.min[axis], solid.max[axis]].map(|end| (end - from[axis]) / along);
        enter = enter.max(ends[0].min(ends[1]));
        leave = leave.min(ends[0].max(ends[1]));
    }
    enter < leave
}

/// Random numbers, the same in every run.
struct Random(TestRng);

impl Random {
    fn new() -> Self {
        Self(TestRng::deterministic_rng(RngAlgorithm::ChaCha))
    }

    fn below(&mut self, bound: usize) -> usize {
        (self.0.next_u64() % bound as u64) as usize
    }

    fn permutation(&mut self, count: usize) -> Vec<u32> {
        let mut numbers: Vec<u32> = (0..count as u32).collect();
        for i in (1..count).rev() {
            numbers.swap(i, self.below(i + 1));
        }
        numbers
    }
}
