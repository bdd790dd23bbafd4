//! Occlusion volumes against brute force: each is in the umbra, and together they hide nearly
//! all that single occluders can hide.

use engine::{
    Box3d, ConvexPrism, Occluder, OcclusionVolume, VolumeOptions, VolumeSolver, scattered_city,
};
use geo::{Coord, MapCoordsInPlace};
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

const OPTIONS: VolumeOptions = VolumeOptions {
    smallest: 1.0,
    worth: 4.0,
    range: None,
};

/// Whether the open segment meets the open box, by clipping.
fn blocks(solid: &Box3d, p: DVec3, q: DVec3) -> bool {
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for axis in 0..3 {
        let run = q[axis] - p[axis];
        let (low, high) = (solid.min[axis] - p[axis], solid.max[axis] - p[axis]);
        if run == 0.0 {
            if low >= 0.0 || high <= 0.0 {
                return false;
            }
        } else {
            let (a, b) = (low / run, high / run);
            enter = enter.max(a.min(b));
            leave = leave.min(a.max(b));
        }
    }
    enter < leave
}

fn hides(solid: &Box3d, eye: DVec3, occludee: &Box3d) -> bool {
    occludee
        .corners()
        .iter()
        .all(|&corner| blocks(solid, eye, corner))
}

fn solve(boxes: &[Box3d], solver: &VolumeSolver) -> Vec<OcclusionVolume> {
    boxes
        .iter()
        .enumerate()
        .flat_map(|(i, b)| {
            solver
                .volumes(i as i64, b, || false)
                .expect("never cancelled")
        })
        .collect()
}

fn solver(boxes: &[Box3d], seed: u64) -> VolumeSolver {
    let occluders = boxes
        .iter()
        .enumerate()
        .map(|(i, &bounds)| Occluder {
            feature: i as i64,
            prism: ConvexPrism::from_box(&bounds, true).expect("not flat"),
        })
        .collect();
    VolumeSolver::new(occluders, &scattered_city(0, seed).streets, OPTIONS)
}

#[test]
fn volumes_of_the_scattered_city_are_right_and_hide_what_single_boxes_can() {
    for seed in 1..=5 {
        let boxes = scattered_city(326, seed).boxes;
        let volumes = solve(&boxes, &solver(&boxes, seed));
        for volume in &volumes {
            let occluder = &boxes[volume.occluder as usize];
            let occludee = &boxes[volume.occludee as usize];
            for eye in volume.bounds.corners() {
                assert!(hides(occluder, eye, occludee), "seed {seed}: {volume:?}");
            }
        }
        let (mut by_single, mut by_volume) = (0, 0);
        for i in 0..400 {
            let eye = DVec3::new(
                (f64::from(i) * 0.618_033_988_75).fract() * 1000.0,
                475.0 + (f64::from(i) + 0.5) / 400.0 * 50.0,
                1.75,
            );
            let mut hidden = vec![false; boxes.len()];
            for volume in volumes.iter().filter(|v| v.bounds.contains_point(eye)) {
                hidden[volume.occludee as usize] = true;
            }
            for (b, occludee) in boxes.iter().enumerate() {
                let single = boxes
                    .iter()
                    .enumerate()
                    .any(|(a, occluder)| a != b && hides(occluder, eye, occludee));
                assert!(
                    single || !hidden[b],
                    "seed {seed}: {b} falsely hidden from {eye}"
                );
                by_single += usize::from(single);
                by_volume += usize::from(hidden[b]);
            }
        }
        let share = by_volume as f64 / by_single as f64;
        println!(
            "seed {seed}: {} volumes hide {share:.4} of {by_single} pairs",
            volumes.len()
        );
        assert!(share >= 0.985, "seed {seed}: {share}");
    }
}

#[test]
fn a_cancelled_search_gives_nothing() {
    let boxes = scattered_city(326, 1).boxes;
    assert_eq!(solver(&boxes, 1).volumes(0, &boxes[0], || true), None);
}

/// Whether the open segment meets the inside of the prism, by clipping.
fn prism_blocks(prism: &ConvexPrism, p: DVec3, q: DVec3) -> bool {
    let bottom = if prism.grounded() {
        -1e6
    } else {
        prism.bottom()
    };
    let mut depths = vec![
        [prism.top() - p.z, prism.top() - q.z],
        [p.z - bottom, q.z - bottom],
    ];
    let footprint = prism.footprint();
    for (i, &from) in footprint.iter().enumerate() {
        let along = footprint[(i + 1) % footprint.len()] - from;
        depths.push([p, q].map(|r| along.perp_dot(r.truncate() - from)));
    }
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for [a, b] in depths {
        if a <= 0.0 && b <= 0.0 {
            return false;
        }
        if a < 0.0 {
            enter = enter.max(a / (a - b));
        } else if b < 0.0 {
            leave = leave.min(a / (a - b));
        }
    }
    enter < leave
}

/// Corners, middles of edges and faces, and the middle.
fn stations(bounds: &Box3d) -> impl Iterator<Item = DVec3> {
    let steps = |i: i32| f64::from(i) / 2.0;
    (0..27).map(move |i| {
        let at = DVec3::new(steps(i % 3), steps(i / 3 % 3), steps(i / 9));
        bounds.min + bounds.size() * at
    })
}

/// Turned prisms of 3 to 12 sides, two that cross for each feature, some of them off the ground.
fn turned_scene(seed: u64) -> Vec<Occluder> {
    let shift = DVec3::new(85_000.0, 447_000.0, 0.0);
    let boxes = scattered_city(40, seed).boxes;
    let sides = [3, 4, 4, 5, 7, 12];
    let prism = |i: usize, bounds: &Box3d, turn: f64, narrow: f64| {
        let count = sides[i % sides.len()];
        let half = bounds.size().truncate() * 0.5;
        let corner = |k: usize| {
            let on_circle = DVec2::from_angle(k as f64 / count as f64 * TAU);
            let turned = DVec2::from_angle(turn).rotate(on_circle * half * DVec2::new(1.0, narrow));
            (bounds.center() + shift).truncate() + turned
        };
        let grounded = !i.is_multiple_of(4);
        let bottom = if grounded { 0.0 } else { 1.0 };
        let footprint = (0..count).map(corner).collect();
        ConvexPrism::new(footprint, bottom, bounds.max.z + 2.0, grounded).expect("convex")
    };
    let pair = |(i, bounds): (usize, &Box3d)| {
        [(i as f64, 1.0), (i as f64 + 1.0, 0.4)].map(|(turn, narrow)| Occluder {
            feature: i as i64,
            prism: prism(i, bounds, turn, narrow),
        })
    };
    boxes.iter().enumerate().flat_map(pair).collect()
}

#[test]
fn volumes_among_turned_prisms_are_right() {
    let shift = |c: Coord<f64>| Coord {
        x: c.x + 85_000.0,
        y: c.y + 447_000.0,
    };
    let mut found = [0; 2];
    for seed in 1..=4 {
        let occluders = turned_scene(seed);
        let mut streets = scattered_city(0, seed).streets;
        streets
            .iter_mut()
            .for_each(|street| street.area.map_coords_in_place(shift));
        let solver = VolumeSolver::new(occluders.clone(), &streets, OPTIONS);
        for feature in 0..40 {
            let own: Vec<&Occluder> = occluders.iter().filter(|o| o.feature == feature).collect();
            let envelope = own
                .iter()
                .map(|o| o.prism.envelope())
                .reduce(|a, b| a.union(&b))
                .expect("two prisms");
            for volume in solver
                .volumes(feature, &envelope, || false)
                .expect("never cancelled")
            {
                assert_ne!(volume.occluder, feature);
                let hides = |occluder: &&Occluder| {
                    stations(&volume.bounds).all(|eye| {
                        let blocks = |corner| prism_blocks(&occluder.prism, eye, corner);
                        envelope.corners().into_iter().all(blocks)
                    })
                };
                let mut prisms = occluders.iter().filter(|o| o.feature == volume.occluder);
                let by = prisms.position(|occluder| hides(&occluder));
                assert!(by.is_some(), "seed {seed}: {volume:?}");
                found[by.unwrap_or(0)] += 1;
            }
        }
    }
    assert!(
        found[0] > 100 && found[1] > 10,
        "too few to tell: {found:?}"
    );
}
