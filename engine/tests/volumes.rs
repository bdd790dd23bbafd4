//! Occlusion volumes against brute force: each is in the umbra, and together they hide nearly
//! all that single occluders can hide.

use engine::{
    Box3d, ConvexPrism, Occluder, OcclusionVolume, VolumeOptions, VolumeSolver, scattered_city,
};
use glam::DVec3;

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
