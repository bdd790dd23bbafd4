//! Ranges of azimuths in random scenes: in no direction outside of them can the feature be seen.

use std::f64::consts::TAU;

use engine::{Extents, PointQuery, PointSolver};
use fastrand::Rng;
use oracle::{LeftOut, PointJudge};

use crate::observer::random_eye;
use crate::plan::{Feature, Place};
use crate::tiling::Tiling;
use crate::trial::Trial;

/// Scenes, and eyes in each.
const SCENES: u64 = 300;
const EYES: usize = 4;

/// How far outside of a range to aim, radians: from a little more than its margin upwards.
const OUTSIDE: [f64; 6] = [3e-12, 1e-11, 1e-9, 1e-6, 1e-3, 0.1];

/// Radians that an azimuth of a point is rounded by.
const ROUNDED: f64 = 1e-15;

fn azimuth(eye: [f64; 3], point: [f64; 3]) -> f64 {
    (point[0] - eye[0]).atan2(point[1] - eye[1]).rem_euclid(TAU)
}

/// Whether an azimuth is in one of some ranges.
fn is_in(ranges: &[(f64, f64)], azimuth: f64) -> bool {
    ranges.iter().any(|(from, to)| {
        [azimuth, azimuth + TAU]
            .iter()
            .any(|azimuth| from - ROUNDED <= *azimuth && *azimuth <= to + ROUNDED)
    })
}

/// Points of a feature in a direction: of its nearest and farthest part, and between, high and low.
fn points(
    rng: &mut Rng,
    feature: &Feature,
    prism: bool,
    eye: [f64; 3],
    way: Place,
) -> Vec<[f64; 3]> {
    let rectangle = crate::plan::rectangle(
        feature.min[0],
        feature.min[1],
        feature.max[0],
        feature.max[1],
    );
    let corners = if prism { &feature.outline } else { &rectangle };
    let (mut near, mut far) = (0.0_f64, f64::INFINITY);
    for (at, from) in corners.iter().enumerate() {
        let to = corners[(at + 1) % corners.len()];
        let along = [to[0] - from[0], to[1] - from[1]];
        let inside = along[0] * (eye[1] - from[1]) - along[1] * (eye[0] - from[0]);
        let rate = along[0] * way[1] - along[1] * way[0];
        if rate > 0.0 {
            near = near.max(-inside / rate);
        } else if rate < 0.0 {
            far = far.min(-inside / rate);
        }
    }
    if near > far || far.is_infinite() {
        return Vec::new();
    }
    let share = rng.f64();
    let mut found = Vec::new();
    for at in [near, near + (far - near) * share, far] {
        // A little further in, so that roundings do not leave the feature.
        let at = at.clamp(near + 1e-9, (far - 1e-9).max(near + 1e-9));
        let height = feature.min[2] + (feature.max[2] - feature.min[2]) * rng.f64();
        for z in [feature.max[2], height] {
            found.push([eye[0] + way[0] * at, eye[1] + way[1] * at, z]);
        }
    }
    found.retain(|point| {
        (0..2).all(|axis| feature.min[axis] <= point[axis] && point[axis] <= feature.max[axis])
            && corners.iter().enumerate().all(|(at, from)| {
                let to = corners[(at + 1) % corners.len()];
                let along = [to[0] - from[0], to[1] - from[1]];
                along[0] * (point[1] - from[1]) >= along[1] * (point[0] - from[0])
            })
    });
    found
}

#[test]
fn what_can_be_seen_is_in_a_range() {
    let mut solver = PointSolver::default();
    let mut extents = Extents::default();
    let mut rng = Rng::with_seed(9);
    let (mut seen, mut aimed) = (0, 0);
    for number in 0..SCENES {
        let trial = Trial::new(9, number);
        let mut tiling = Tiling::random(&mut rng, &trial.features);
        for _ in 0..EYES {
            let eye = random_eye(&mut rng, &trial.scene);
            let query = PointQuery {
                eye: eye.into(),
                range: f64::INFINITY,
                prisms: rng.bool(),
                wedge: None,
            };
            let Ok(()) = solver.visible_extent(&query, &mut tiling, &mut extents);
            let mut ranges = vec![Vec::new(); trial.features.len()];
            for (sighting, found) in extents.iter() {
                let id = tiling.id(sighting.tile, sighting.feature);
                let of_this = &mut ranges[usize::try_from(id).expect("a position")];
                of_this.extend(found.map(|range| (range.from, range.to)));
            }
            let mut judge = PointJudge::new(&trial.judged, eye);
            for (at, feature) in trial.scene.features.iter().enumerate() {
                let left_out = LeftOut {
                    feature: at,
                    prism: query.prisms,
                    range: query.range,
                };
                let place = format!("scene {number}, {query:?}, feature {at}: {:?}", ranges[at]);
                let prism = query.prisms && !feature.outline.is_empty();
                for _ in 0..3 {
                    if let Some(witness) = judge.search(&left_out, 12, &mut rng).witness {
                        seen += 1;
                        let is_above = witness[..2] == eye[..2];
                        assert!(
                            is_above || is_in(&ranges[at], azimuth(eye, witness)),
                            "{place} {witness:?}"
                        );
                    }
                }
                for (from, to) in ranges[at].clone() {
                    let step = OUTSIDE[rng.usize(..OUTSIDE.len())];
                    for azimuth in [from - step, to + step, rng.f64() * TAU] {
                        let azimuth = azimuth.rem_euclid(TAU);
                        let way = [azimuth.sin(), azimuth.cos()];
                        for point in points(&mut rng, feature, prism, eye, way) {
                            aimed += 1;
                            let (x, y) = (point[0] - eye[0], point[1] - eye[1]);
                            let real = x.atan2(y).rem_euclid(TAU);
                            assert!(
                                is_in(&ranges[at], real) || !judge.can_see(&left_out, point),
                                "{place} {point:?} at {real}"
                            );
                        }
                    }
                }
            }
        }
    }
    assert!(seen > 30_000 && aimed > 50_000, "{seen} {aimed}");
}
