//! Solids over footprints of many forms: closed, planar, oriented outwards, of the right volume.

use std::f64::consts::{PI, TAU};

use proptest::prelude::*;

use super::*;

/// A corner of the Netherlands, where coordinates have few digits to spare.
const ORIGIN: Plan = [85_000.0, 447_000.0];

/// Most that a vertex may be off the plane of its surface, metres.
const PLANAR: f64 = 1e-4;

const SHAPES: [RoofShape; 8] = [
    RoofShape::Skillion,
    RoofShape::Gabled,
    RoofShape::Saltbox,
    RoofShape::Gambrel,
    RoofShape::Round,
    RoofShape::Hipped,
    RoofShape::Pyramidal,
    RoofShape::Dome,
];

fn roof(shape: RoofShape) -> Roof {
    Roof {
        shape,
        rise: Rise::Metres(3.0),
        across: false,
        direction: None,
    }
}

/// Positions turned by an angle and moved to the origin of the tests.
fn placed(ring: &[Plan], angle: f64) -> Vec<Plan> {
    let (sin, cos) = angle.sin_cos();
    let place = |[x, y]: &Plan| [ORIGIN[0] + x * cos - y * sin, ORIGIN[1] + x * sin + y * cos];
    ring.iter().map(place).collect()
}

fn rectangle(angle: f64) -> Footprint {
    let ring = [[0.0, 0.0], [12.0, 0.0], [12.0, 8.0], [0.0, 8.0]];
    Footprint::new(placed(&ring, angle), Vec::new()).unwrap()
}

fn surfaces(solid: &Extruded) -> impl Iterator<Item = &Rings> {
    solid
        .walls
        .iter()
        .chain(&solid.roofs)
        .chain([&solid.bottom])
}

/// Twice the area of a surface as a vector, by Newell's rule, around a point nearby.
fn normal(rings: &Rings, around: [f64; 3]) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for ring in rings {
        for (a, b) in ring.iter().zip(ring.iter().skip(1).chain(ring.first())) {
            let [a, b] = [a, b].map(|p| [0, 1, 2].map(|i| p[i] - around[i]));
            let cross = [
                a[1] * b[2] - a[2] * b[1],
                a[2] * b[0] - a[0] * b[2],
                a[0] * b[1] - a[1] * b[0],
            ];
            sum = [0, 1, 2].map(|i| sum[i] + cross[i]);
        }
    }
    sum
}

fn volume(solid: &Extruded) -> f64 {
    let around = [ORIGIN[0], ORIGIN[1], 0.0];
    let cone = |rings: &Rings| {
        let n = normal(rings, around);
        let p = rings[0][0];
        (0..3).map(|i| (p[i] - around[i]) * n[i]).sum::<f64>() / 6.0
    };
    surfaces(solid).map(cone).sum()
}

fn assert_sound(solid: &Extruded, what: &str) {
    assert!(solid.is_closed(), "{what} is open");
    for rings in surfaces(solid) {
        let p = rings[0][0];
        let n = normal(rings, p);
        let size = n.iter().map(|x| x * x).sum::<f64>().sqrt();
        assert!(size > 0.0, "{what} has a surface without area");
        for q in rings.iter().flatten() {
            let off: f64 = (0..3).map(|i| (q[i] - p[i]) * n[i] / size).sum();
            assert!(
                off.abs() <= PLANAR,
                "{what}: a vertex is {off} off its plane"
            );
        }
    }
    let looks_up = |rings: &Rings| normal(rings, rings[0][0])[2] > 0.0;
    assert!(
        solid.roofs.iter().all(looks_up),
        "{what} has a roof that looks down"
    );
}

#[test]
fn roofs_over_a_rectangle_have_their_volume() {
    let (base, rise) = (12.0 * 8.0, 3.0);
    let vault: f64 = {
        let points: Vec<Plan> = (0..=8)
            .map(|i| PI * f64::from(i) / 8.0)
            .map(|angle| [-angle.cos(), angle.sin()])
            .collect();
        let strip = |p: &[Plan]| (p[1][0] - p[0][0]) * (p[0][1] + p[1][1]) / 2.0;
        points.windows(2).map(strip).sum::<f64>() / 2.0
    };
    // The dome is a stack of four frustums.
    let dome: f64 = (0..4)
        .map(|i| [i, i + 1].map(|i| PI / 8.0 * f64::from(i)))
        .map(|[a, b]| {
            (a.cos() * a.cos() + a.cos() * b.cos() + b.cos() * b.cos()) / 3.0 * (b.sin() - a.sin())
        })
        .sum();
    for (shape, share) in [
        (RoofShape::Skillion, 0.5),
        (RoofShape::Gabled, 0.5),
        (RoofShape::Saltbox, 0.5),
        (
            RoofShape::Gambrel,
            0.4 * 0.65 / 2.0 + 0.6 * (0.65 + 1.0) / 2.0,
        ),
        (RoofShape::Round, vault),
        (
            RoofShape::Hipped,
            (4.0 * 8.0 / 2.0 + 8.0 * 8.0 / 3.0) / base,
        ),
        (RoofShape::Pyramidal, 1.0 / 3.0),
        (RoofShape::Dome, dome),
    ] {
        for angle in [0.0, 0.3, 1.0, PI / 2.0, 4.0] {
            let what = format!("{shape:?} at {angle}");
            let (solid, lost) =
                Extruded::new(&rectangle(angle), 1.0, Top::Ridge(10.0), Some(&roof(shape)))
                    .unwrap();
            assert!(!lost && !solid.is_flat, "{what} was built flat");
            assert_sound(&solid, &what);
            let expected = base * (6.0 + rise * share);
            let found = volume(&solid);
            assert!(
                (found - expected).abs() < 1e-3,
                "{what}: {found}, expected {expected}"
            );
        }
    }
}

#[test]
fn the_ridge_follows_orientation_and_direction() {
    let ridge_length = |roof: &Roof| {
        let (solid, _) = Extruded::new(&rectangle(0.3), 0.0, Top::Ridge(9.0), Some(roof)).unwrap();
        let mut ends: Vec<_> = solid
            .roofs
            .iter()
            .flatten()
            .flatten()
            .filter(|p| p[2] == 9.0)
            .collect();
        ends.dedup();
        let far = |a: &[f64; 3]| {
            ends.iter()
                .map(|b| (a[0] - b[0]).hypot(a[1] - b[1]))
                .fold(0.0, f64::max)
        };
        ends.iter().map(|a| far(a)).fold(0.0, f64::max)
    };
    let along = roof(RoofShape::Gabled);
    let across = Roof {
        across: true,
        ..along
    };
    assert!((ridge_length(&along) - 12.0).abs() < 1e-6);
    assert!((ridge_length(&across) - 8.0).abs() < 1e-6);
    // Down the long side, ten degrees off.
    let direction = Some([(0.3_f64 + 0.17).cos(), (0.3_f64 + 0.17).sin()]);
    assert!((ridge_length(&Roof { direction, ..along }) - 8.0).abs() < 1e-6);
    let skillion = Roof {
        shape: RoofShape::Skillion,
        direction,
        ..along
    };
    assert!((ridge_length(&skillion) - 8.0).abs() < 1e-6);
}

#[test]
fn a_roof_that_does_not_fit_is_flat_at_full_height() {
    let ring = [[0.0, 0.0], [12.0, 0.0], [12.0, 8.0], [6.0, 1.0], [0.0, 8.0]];
    let notched = Footprint::new(placed(&ring, 0.2), Vec::new()).unwrap();
    let court = [[2.0, 2.0], [4.0, 2.0], [4.0, 4.0], [2.0, 4.0]];
    let outer = [[0.0, 0.0], [12.0, 0.0], [12.0, 8.0], [0.0, 8.0]];
    let courtyard = Footprint::new(placed(&outer, 0.2), vec![placed(&court, 0.2)]).unwrap();
    for footprint in [&notched, &courtyard] {
        for shape in [RoofShape::Hipped, RoofShape::Pyramidal, RoofShape::Dome] {
            let (solid, lost) =
                Extruded::new(footprint, 0.0, Top::Ridge(9.0), Some(&roof(shape))).unwrap();
            assert!(lost && solid.is_flat);
            assert!((volume(&solid) - footprint.area() * 9.0).abs() < 1e-6);
        }
    }
    let (solid, lost) = Extruded::new(
        &courtyard,
        0.0,
        Top::Ridge(9.0),
        Some(&roof(RoofShape::Gabled)),
    )
    .unwrap();
    assert!(!lost);
    assert_sound(&solid, "a gabled roof around a court");
}

#[test]
fn a_roof_may_reach_down_to_the_ground() {
    for shape in SHAPES {
        let roof = Roof {
            rise: Rise::Metres(50.0),
            ..roof(shape)
        };
        let (solid, lost) =
            Extruded::new(&rectangle(0.5), 0.0, Top::Ridge(5.0), Some(&roof)).unwrap();
        assert!(!lost, "{shape:?}");
        assert_sound(&solid, &format!("{shape:?}"));
    }
}

#[test]
fn what_has_no_height_is_refused() {
    for top in [Top::Ridge(1.0), Top::Ridge(0.5), Top::Eaves(1.0)] {
        assert!(Extruded::new(&rectangle(0.0), 1.0, top, None).is_err());
    }
}

/// Vertices in turn around a middle, so that no edges cross, at distances that differ wildly.
fn ring() -> impl Strategy<Value = Vec<Plan>> {
    let distances = prop::collection::vec(1.0..30.0_f64, 3..24);
    (distances, 0.0..TAU).prop_map(|(distances, start)| {
        let step = TAU / distances.len() as f64;
        let place = |(i, r): (usize, &f64)| {
            let angle = start + step * i as f64;
            [ORIGIN[0] + r * angle.cos(), ORIGIN[1] + r * angle.sin()]
        };
        distances.iter().enumerate().map(place).collect()
    })
}

/// Coordinates on a coarse grid, where vertices fall on folds and edges lie along them.
fn staircase() -> impl Strategy<Value = Vec<Plan>> {
    prop::collection::vec((1..4_i32, 1..6_i32), 1..8).prop_map(|steps| {
        let mut x = 0;
        let mut ring = vec![[0.0, 0.0]];
        for (width, height) in &steps {
            let before = f64::from(x);
            x += width;
            ring.push([before, f64::from(*height)]);
            ring.push([f64::from(x), f64::from(*height)]);
        }
        ring.push([f64::from(x), 0.0]);
        placed(&ring, 0.0)
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..Default::default() })]

    #[test]
    fn every_roof_over_every_footprint_is_a_closed_solid(
        ring in prop_oneof![ring(), staircase()],
        shape in 0..SHAPES.len(),
        across: bool,
        angle in prop::option::of(0.0..TAU),
    ) {
        // The middle of a ring around it need not be inside: some of these are refused.
        let Ok(footprint) = Footprint::new(ring, Vec::new()) else {
            return Ok(());
        };
        let direction = angle.map(|angle: f64| [angle.cos(), angle.sin()]);
        let roof = Roof { across, direction, ..roof(SHAPES[shape]) };
        let (solid, _) = Extruded::new(&footprint, 0.0, Top::Eaves(5.0), Some(&roof)).unwrap();
        assert_sound(&solid, &format!("{roof:?}"));
        let (least, most) = (footprint.area() * 5.0, footprint.area() * 8.0);
        let found = volume(&solid);
        prop_assert!(found >= least - 1e-3 && found <= most + 1e-3, "{} {} {}", least, found, most);
    }

    #[test]
    fn ridged_roofs_fit_every_footprint(ring in prop_oneof![ring(), staircase()], shape in 0..5_usize) {
        let Ok(footprint) = Footprint::new(ring, Vec::new()) else {
            return Ok(());
        };
        let roof = roof(SHAPES[shape]);
        let (_, lost) = Extruded::new(&footprint, 0.0, Top::Ridge(9.0), Some(&roof)).unwrap();
        prop_assert!(!lost);
    }
}
