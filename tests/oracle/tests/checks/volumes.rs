//! Segments, occlusion volumes and single occluders.

use oracle::{
    Aabb, Occluder, OccluderIndex, Point, Prism, ShapeFault, VolumeFault, box_hidden_by_any,
    check_volume, segment_meets_interior, single_occluder_hides,
};
use proptest::prelude::*;

/// The prism of a box that has a volume.
fn prism(aabb: &Aabb, grounded: bool) -> Prism {
    Prism::of_box(aabb, grounded).unwrap()
}

/// The check of a volume whose occluder is a box.
fn check(
    volume: &Aabb,
    occluder: &Aabb,
    grounded: bool,
    occludee: &Aabb,
) -> Result<(), VolumeFault> {
    check_volume(volume, &[prism(occluder, grounded)], occludee)
}

const UNIT: Aabb = Aabb {
    min: [0.0; 3],
    max: [1.0; 3],
};

#[test]
fn touching_and_grazing_do_not_hide() {
    let cases: [(&str, Point, Point, bool); 14] = [
        ("through", [-1.0, 0.5, 0.5], [2.0, 0.5, 0.5], true),
        ("from corner to corner", [0.0; 3], [1.0; 3], true),
        (
            "from a face inwards",
            [0.0, 0.5, 0.5],
            [0.5, 0.5, 0.5],
            true,
        ),
        ("wholly inside", [0.4; 3], [0.6; 3], true),
        ("in a face", [-1.0, 0.5, 1.0], [2.0, 0.5, 1.0], false),
        ("along an edge", [-1.0, 1.0, 1.0], [2.0, 1.0, 1.0], false),
        ("through an edge", [-1.0, 1.0, 0.5], [1.0, -1.0, 0.5], false),
        ("through a corner", [-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], false),
        ("ends on a face", [-1.0, 0.5, 0.5], [0.0, 0.5, 0.5], false),
        (
            "starts on a face, outwards",
            [1.0, 0.5, 0.5],
            [2.0, 0.5, 0.5],
            false,
        ),
        ("beside", [-1.0, 2.0, 0.5], [2.0, 2.0, 0.5], false),
        ("stops short", [-2.0, 0.5, 0.5], [-1.0, 0.5, 0.5], false),
        ("a point inside", [0.5; 3], [0.5; 3], false),
        ("not a number", [f64::NAN, 0.5, 0.5], [2.0, 0.5, 0.5], false),
    ];
    for (what, p, q, expected) in cases {
        assert_eq!(
            segment_meets_interior(p, q, &prism(&UNIT, false)),
            expected,
            "{what}"
        );
        assert_eq!(
            segment_meets_interior(q, p, &prism(&UNIT, false)),
            expected,
            "{what}, backwards"
        );
    }
}

#[test]
fn the_last_bit_decides() {
    for offset in [0.0, 85_000.0, 447_000.0, 1e15] {
        let aabb = Aabb::new([offset; 3], [offset + 8.0; 3]);
        let along = |z: f64| {
            let [p, q] = [offset - 8.0, offset + 16.0].map(|x| [x, offset + 4.0, z]);
            segment_meets_interior(p, q, &prism(&aabb, false))
        };
        assert!(!along(offset + 8.0), "{offset}");
        assert!(along((offset + 8.0).next_down()), "{offset}");
        // The diagonal past the edge at (offset, offset + 8), one unit in the last place inside.
        let past = |y: f64| {
            let (p, q) = (
                [offset - 4.0, y - 4.0, offset + 1.0],
                [offset + 4.0, y + 4.0, offset + 1.0],
            );
            segment_meets_interior(p, q, &prism(&aabb, false))
        };
        assert!(!past(offset + 8.0), "{offset}");
        assert!(past(offset + 7.5), "{offset}");
    }
}

#[test]
fn a_box_without_volume_is_refused() {
    let missing = Aabb::new([0.0, 0.0, f64::NAN], [1.0; 3]);
    let low = Aabb::new([0.0, 0.0, f64::NEG_INFINITY], [1.0; 3]);
    let inverted = Aabb::new([1.0; 3], [0.0; 3]);
    for aabb in [Aabb::new([0.0; 3], [1.0, 1.0, 0.0]), missing, low, inverted] {
        let fault = Prism::of_box(&aabb, true).unwrap_err();
        assert!(matches!(fault, ShapeFault::NoHeight { .. }), "{fault}");
    }
    let narrow = Aabb::new([0.0; 3], [0.0, 1.0, 1.0]);
    let mirrored = Aabb::new([1.0, 0.0, 0.0], [0.0, 1.0, 1.0]);
    for aabb in [narrow, mirrored] {
        let fault = Prism::of_box(&aabb, true).unwrap_err();
        assert!(matches!(fault, ShapeFault::NotConvex { .. }), "{fault}");
    }
}

#[test]
fn the_ground_below_hides() {
    let (p, q) = ([-1.0, 0.5, -1e9], [2.0, 0.5, -1e9]);
    assert!(!segment_meets_interior(p, q, &prism(&UNIT, false)));
    assert!(segment_meets_interior(p, q, &prism(&UNIT, true)));
    // In a wall of it: still only touched.
    assert!(!segment_meets_interior(
        [-1.0, 1.0, -5.0],
        [2.0, 1.0, -5.0],
        &prism(&UNIT, true)
    ));
}

/// A house of 20 x 10 x 10 m, and 20 m behind it one of 10 x 10 x 5 m that it hides from the street.
fn houses(shift: Point) -> (Aabb, Aabb) {
    let moved = |p: Point| std::array::from_fn(|axis| p[axis] + shift[axis]);
    let occluder = Aabb::new(moved([0.0, 0.0, 0.0]), moved([20.0, 10.0, 10.0]));
    let occludee = Aabb::new(moved([5.0, 30.0, 0.0]), moved([15.0, 40.0, 5.0]));
    (occluder, occludee)
}

#[test]
fn a_volume_in_the_umbra_is_right() {
    for shift in [[0.0; 3], [85_000.0, 447_000.0, -2.0]] {
        let (occluder, occludee) = houses(shift);
        let at = |p: Point| std::array::from_fn(|axis| p[axis] + shift[axis]);
        let volume = Aabb::new(at([5.0, -10.0, 1.5]), at([15.0, -1.0, 2.0]));
        assert_eq!(check(&volume, &occluder, true, &occludee), Ok(()));
        // Not grounded, the ray along the ground from z = 1.5 to z = 0 still meets the house.
        assert_eq!(check(&volume, &occluder, false, &occludee), Ok(()));
    }
}

#[test]
fn a_volume_a_centimetre_out_of_the_umbra_is_found() {
    let (occluder, occludee) = houses([0.0; 3]);
    let volume = |right: f64| Aabb::new([10.0, -10.0, 1.5], [right, -9.0, 2.0]);
    let limit = (0..40_000)
        .map(|step| 10.0 + f64::from(step) * 0.001)
        .take_while(|&right| check(&volume(right), &occluder, true, &occludee).is_ok())
        .last()
        .unwrap();
    // In plan, the lines from the right corners of the occludee past the corner (20, 10) of the
    // occluder bound the umbra; the volume must keep to the left of them with both right corners.
    let umbra = [-9.0, -10.0]
        .iter()
        .flat_map(|y| [30.0, 40.0].map(|from| 20.0 + (10.0 - y) * 5.0 / (from - 10.0)))
        .fold(f64::INFINITY, f64::min);
    assert!((limit - umbra).abs() < 0.002, "{limit} is not {umbra}");
    let fault = check(&volume(umbra + 0.01), &occluder, true, &occludee).unwrap_err();
    let VolumeFault::SegmentMisses {
        volume_corner,
        occludee_corner,
        ..
    } = fault
    else {
        panic!("another fault: {fault}");
    };
    assert_eq!(volume_corner[0], umbra + 0.01);
    assert_eq!(occludee_corner[0], 15.0);
}

#[test]
fn a_claim_of_ground_that_is_not_there_is_found() {
    // The house floats 3 m up; from 1.5 m one looks under it.
    let (mut occluder, occludee) = houses([0.0; 3]);
    occluder.min[2] = 3.0;
    let volume = Aabb::new([5.0, -10.0, 1.5], [15.0, -5.0, 2.0]);
    assert_eq!(check(&volume, &occluder, true, &occludee), Ok(()));
    let fault = check(&volume, &occluder, false, &occludee).unwrap_err();
    assert!(
        matches!(fault, VolumeFault::SegmentMisses { .. }),
        "{fault}"
    );
}

#[test]
fn faults_that_are_no_near_miss() {
    let (occluder, occludee) = houses([0.0; 3]);
    let touching = Aabb::new([4.0, 20.0, 0.0], [5.0, 30.0, 5.0]);
    let covering = Aabb::new([-99.0; 3], [99.0; 3]);
    let fault = check(&touching, &covering, false, &occludee);
    assert_eq!(
        fault,
        Err(VolumeFault::CommonCorner {
            corner: [5.0, 30.0, 0.0]
        })
    );
    let missing = Aabb::new([0.0, f64::NAN, 0.0], [1.0; 3]);
    let fault = check(&missing, &occluder, true, &occludee).unwrap_err();
    assert!(matches!(
        fault,
        VolumeFault::NotABox {
            role: "occlusion volume",
            ..
        }
    ));
    let inverted = Aabb::new(occludee.max, occludee.min);
    let fault = check(&touching, &occluder, true, &inverted).unwrap_err();
    assert!(matches!(
        fault,
        VolumeFault::NotABox {
            role: "occludee",
            ..
        }
    ));
    let fault = check_volume(&covering, &[], &occludee);
    assert_eq!(fault, Err(VolumeFault::NoOccluder));
}

#[test]
fn an_eye_inside_or_a_house_itself_hides_nothing() {
    let (occluder, occludee) = houses([0.0; 3]);
    let solid = prism(&occluder, true);
    let hides = |eye: Point| single_occluder_hides(eye, &solid, &occludee);
    assert!(hides([10.0, -5.0, 1.7]));
    for eye in [
        [10.0, 5.0, 1.7],
        [10.0, 5.0, -7.0],
        [10.0, 15.0, 1.7],
        [10.0, -5.0, 30.0],
        [f64::NAN; 3],
    ] {
        assert!(!hides(eye), "{eye:?}");
    }
    let itself = [Occluder { id: 4, solid }];
    assert_eq!(
        box_hidden_by_any([10.0, -5.0, 1.7], &itself, 5, &occludee),
        Some(4)
    );
    assert_eq!(
        box_hidden_by_any([10.0, -5.0, 1.7], &itself, 4, &occludee),
        None
    );
}

fn grid_box() -> impl Strategy<Value = Aabb> {
    (0..12i32, 0..12i32, 0..3i32, 0..5i32, 0..5i32, 0..5i32).prop_map(|(x, y, z, dx, dy, dz)| {
        let [x, y, z] = [
            85_000.0 + f64::from(x),
            447_000.0 + f64::from(y),
            f64::from(z),
        ];
        let size = [dx, dy, dz].map(f64::from);
        Aabb::new([x, y, z], [x + size[0], y + size[1], z + size[2]])
    })
}

/// A box with its corners on the grid from `origin` to `size` beyond it.
fn box_within(origin: [i32; 3], size: i32) -> impl Strategy<Value = Aabb> {
    proptest::array::uniform3((0..=size, 0..=size)).prop_map(move |sides| {
        let corner = |pick: fn(i32, i32) -> i32| {
            std::array::from_fn(|axis| f64::from(origin[axis] + pick(sides[axis].0, sides[axis].1)))
        };
        Aabb::new(corner(i32::min), corner(i32::max))
    })
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 400,
        max_global_rejects: 100_000,
        ..ProptestConfig::default()
    })]
    #[test]
    fn the_index_finds_what_all_pairs_find(
        boxes in proptest::collection::vec((grid_box(), any::<bool>()), 1..40),
        eyes in proptest::collection::vec([0..24i32, 0..24, 0..8], 4),
    ) {
        let occluders: Vec<Occluder> = boxes
            .iter()
            .zip(0..)
            .filter_map(|((aabb, grounded), id)| {
                Some(Occluder { id, solid: Prism::of_box(aabb, *grounded).ok()? })
            })
            .collect();
        let index = OccluderIndex::new(&occluders);
        for [x, y, z] in eyes.iter().map(|eye| eye.map(|step| 0.5 * f64::from(step))) {
            let eye = [85_000.0 + x, 447_000.0 + y, z];
            for (id, (occludee, _)) in (0..).zip(&boxes) {
                let found = index.hiding(eye, id, occludee);
                let any = box_hidden_by_any(eye, &occluders, id, occludee);
                prop_assert_eq!(found.is_some(), any.is_some());
                if let Some(by) = found {
                    prop_assert!(by != id);
                    let hider = occluders.iter().find(|occluder| occluder.id == by).unwrap();
                    prop_assert!(single_occluder_hides(eye, &hider.solid, occludee));
                }
            }
        }
    }

    /// The 64 segments speak for all points of the two boxes.
    #[test]
    fn corners_speak_for_all_points(
        volume in box_within([0, 0, 0], 3),
        occluder in box_within([-6, 4, -2], 14),
        occludee in box_within([0, 12, 0], 4),
        grounded in any::<bool>(),
        weights in proptest::collection::vec((0.0..1.0, 0.0..1.0, 0.0..1.0), 16),
    ) {
        let Ok(solid) = Prism::of_box(&occluder, grounded) else {
            return Ok(());
        };
        prop_assume!(check_volume(&volume, std::slice::from_ref(&solid), &occludee).is_ok());
        let within = |aabb: &Aabb, (u, v, w): (f64, f64, f64)| {
            let size: Point = std::array::from_fn(|axis| aabb.max[axis] - aabb.min[axis]);
            [aabb.min[0] + u * size[0], aabb.min[1] + v * size[1], aabb.min[2] + w * size[2]]
        };
        for pair in weights.chunks_exact(2) {
            let (p, b) = (within(&volume, pair[0]), within(&occludee, pair[1]));
            prop_assert!(segment_meets_interior(p, b, &solid));
        }
    }
}
