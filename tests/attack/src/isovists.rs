//! Isovists of random scenes: no point outside can be seen, and few inside cannot.

use engine::PointSolver;
use fastrand::Rng;
use glam::{DVec2, DVec3};
use oracle::{LeftOut, PointJudge};

use crate::kind::Kind;
use crate::observer::random_eye;
use crate::plan::Feature;
use crate::scene::Scene;
use crate::tiling::Tiling;
use crate::trial::Trial;

/// Scenes, eyes in each, and points around each eye.
const SCENES: u64 = 300;
const EYES: usize = 4;
const POINTS: usize = 120;

/// How far outside or inside of the polygon a point is plainly so, metres.
const OUTSIDE: f64 = 1e-9;
const INSIDE: f64 = 0.01;

/// Whether a point is in a polygon, and how far from its boundary, metres.
fn place(corners: &[DVec2], point: DVec2) -> (bool, f64) {
    let mut crossings = 0;
    let mut distance = f64::INFINITY;
    for (at, &from) in corners.iter().enumerate() {
        let (from, along) = (from - point, corners[(at + 1) % corners.len()] - from);
        let to = from + along;
        let share = (-from.dot(along) / along.length_squared().max(1e-300)).clamp(0.0, 1.0);
        distance = distance.min((from + along * share).length());
        let is_left = from.perp_dot(along) > 0.0;
        if (from.y > 0.0) != (to.y > 0.0) {
            crossings += usize::from(is_left == (to.y > from.y));
        }
    }
    (crossings % 2 == 1, distance)
}

/// Whether an isovist is to be tight: where all columns stand on the ground and are thick, unless the
/// eye is in a feature or at it, where one of its columns or more hide nothing, or on a level with a
/// roof: the judge takes what glides over two columns of one feature for hidden.
fn is_plain(scene: &Scene, eye: DVec3) -> bool {
    let has_courtyard = |feature: &Feature| feature.columns.iter().any(|c| c.rings.len() > 1);
    let is_within = |feature: &Feature| {
        let is_between = |axis: usize| {
            feature.min[axis] - 0.01 <= eye[axis] && eye[axis] <= feature.max[axis] + 0.01
        };
        !has_courtyard(feature) && (0..2).all(is_between) && eye.z < feature.max[2] + 0.01
    };
    let is_plain = matches!(
        scene.kind,
        Kind::Integers | Kind::Angles | Kind::Turned | Kind::Rows | Kind::Courtyards | Kind::Parts
    );
    let is_level = |feature: &Feature| feature.columns.iter().any(|c| c.top == eye.z);
    is_plain && !scene.features.iter().any(|f| is_within(f) || is_level(f))
}

/// Points anywhere in range, and just in front of and behind the boundary.
fn points(rng: &mut Rng, corners: &[DVec2], eye: DVec2, range: f64) -> Vec<DVec2> {
    let mut points = Vec::new();
    for _ in 0..POINTS {
        let way = DVec2::from_angle(rng.f64() * std::f64::consts::TAU);
        points.push(eye + way * range * rng.f64().sqrt());
        let at = rng.usize(..corners.len());
        let next = corners[(at + 1) % corners.len()];
        let edge = corners[at] + (next - corners[at]) * rng.f64();
        let far = [1e-5, 1e-3, 0.02, 1.0][rng.usize(..4)];
        let out = (edge - eye).normalize();
        points.extend([edge + out * far, edge - out * far, corners[at] + out * far]);
    }
    points
}

#[test]
fn what_can_be_seen_is_inside_and_what_is_plainly_inside_can_be_seen() {
    let mut solver = PointSolver::default();
    let mut rng = Rng::with_seed(11);
    let mut corners = Vec::new();
    let (mut outside, mut inside, mut hidden) = (0, 0, 0);
    for number in 0..SCENES {
        let trial = Trial::new(11, number);
        let mut tiling = Tiling::random(&mut rng, &trial.features);
        for _ in 0..EYES {
            let eye = DVec3::from(random_eye(&mut rng, &trial.scene));
            let range = [3.0, 10.0, 40.0, 200.0][rng.usize(..4)];
            let Ok(()) = solver.isovist(eye, range, &mut tiling, &mut corners);
            let is_plain = is_plain(&trial.scene, eye);
            let judge = PointJudge::new(&trial.judged, eye.to_array());
            // No feature of its own.
            let left_out = LeftOut {
                feature: usize::MAX,
                prism: false,
                range,
            };
            for point in points(&mut rng, &corners, eye.truncate(), range) {
                let (is_inside, distance) = place(&corners, point);
                let is_seen = judge.can_see(&left_out, point.extend(eye.z).to_array());
                let message = format!("scene {number}, {eye:?}, {range}, {point:?}, {distance}");
                if !is_inside && distance > OUTSIDE {
                    outside += 1;
                    assert!(!is_seen, "{message}");
                } else if is_inside && distance > INSIDE {
                    inside += 1;
                    let is_in_range = (point - eye.truncate()).length() < range;
                    if is_in_range && !is_seen {
                        hidden += 1;
                        assert!(!is_plain, "{message}");
                    }
                }
            }
        }
    }
    assert!(outside > 100_000 && inside > 100_000, "{outside} {inside}");
    // Level sight lines that end at columns with air below them are followed on.
    assert!(hidden * 30 < inside, "{hidden} of {inside}");
}

#[test]
fn an_isovist_is_a_star_around_the_eye() {
    let mut solver = PointSolver::default();
    let mut rng = Rng::with_seed(12);
    let mut corners = Vec::new();
    for number in 0..SCENES {
        let trial = Trial::new(12, number);
        let mut tiling = Tiling::random(&mut rng, &trial.features);
        let eye = DVec3::from(random_eye(&mut rng, &trial.scene));
        let Ok(()) = solver.isovist(eye, 100.0, &mut tiling, &mut corners);
        let mut turns = 0.0;
        for (at, &corner) in corners.iter().enumerate() {
            let from = corner - eye.truncate();
            let to = corners[(at + 1) % corners.len()] - eye.truncate();
            let angle = from.angle_to(to);
            assert!(angle > -1e-9, "scene {number}, {eye:?}, {at}: {angle}");
            turns += angle;
        }
        assert!((turns - std::f64::consts::TAU).abs() < 1e-6, "{turns}");
    }
}
