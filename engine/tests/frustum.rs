//! Frusta against brute force: points sampled inside, and the corners of what frustum and box have
//! in common, found by trying every three of their planes.

use engine::{Box3d, Camera, Frustum};
use glam::{DMat3, DVec2, DVec3};
use proptest::prelude::*;

/// A plane: the points with `normal · (p - origin) <= offset` are kept.
type HalfSpace = (DVec3, f64);

/// Forward, right and up of a camera, by another way than the engine's.
fn frame(camera: &Camera) -> [DVec3; 3] {
    let forward = camera.direction / camera.direction.length();
    let level = camera.up - forward * camera.up.dot(forward);
    let up = level / level.length();
    [forward, forward.cross(up), up]
}

/// The point at a depth and a place in the image, from -1 to 1 each way.
fn point_at(camera: &Camera, depth: f64, image: DVec2) -> DVec3 {
    let [forward, right, up] = frame(camera);
    let half_height = (camera.fov * 0.5).tan();
    let place = (image + camera.shift) * DVec2::new(half_height * camera.aspect, half_height);
    camera.eye + (forward + right * place.x + up * place.y) * depth
}

/// The six half-spaces of a frustum, relative to the eye, moved outward by some metres.
fn half_spaces(camera: &Camera, outward: f64) -> Vec<HalfSpace> {
    let [forward, right, up] = frame(camera);
    let half_height = (camera.fov * 0.5).tan();
    let half_width = half_height * camera.aspect;
    let side = |across: DVec3, sign: f64, edge: f64| {
        let normal = (across - forward * edge) * sign;
        (normal / normal.length(), outward)
    };
    vec![
        (forward, camera.far + outward),
        (-forward, outward - camera.near),
        side(right, 1.0, (camera.shift.x + 1.0) * half_width),
        side(right, -1.0, (camera.shift.x - 1.0) * half_width),
        side(up, 1.0, (camera.shift.y + 1.0) * half_height),
        side(up, -1.0, (camera.shift.y - 1.0) * half_height),
    ]
}

/// Whether half-spaces and box have a point in common, up to `slack`: such a set has a corner, where
/// three of its planes meet.
fn have_common_point(mut planes: Vec<HalfSpace>, local: &Box3d, slack: f64) -> bool {
    for (axis, normal) in DVec3::AXES.into_iter().enumerate() {
        planes.push((normal, local.max[axis]));
        planes.push((-normal, -local.min[axis]));
    }
    let n = planes.len();
    (0..n).any(|i| {
        (i + 1..n).any(|j| {
            (j + 1..n).any(|k| {
                let [(a, p), (b, q), (c, r)] = [planes[i], planes[j], planes[k]];
                let rows = DMat3::from_cols(a, b, c).transpose();
                if rows.determinant().abs() < 1e-9 {
                    return false;
                }
                let corner = rows.inverse() * DVec3::new(p, q, r);
                planes
                    .iter()
                    .all(|(normal, offset)| normal.dot(corner) <= offset + slack)
            })
        })
    })
}

fn relative(target: &Box3d, eye: DVec3) -> Box3d {
    Box3d::new(target.min - eye, target.max - eye)
}

fn origin() -> impl Strategy<Value = DVec3> {
    prop_oneof![
        Just(DVec3::ZERO),
        Just(DVec3::new(85_000.0, 447_000.0, 3.0)),
        Just(DVec3::new(1e15, -1e15, 4.0)),
    ]
}

fn whole(low: i32, high: i32) -> impl Strategy<Value = DVec3> {
    prop::array::uniform3(low..high).prop_map(|c| DVec3::from(c.map(f64::from)))
}

/// Cameras in all directions, those along the axes among them, narrow and wide, centred and not.
fn camera() -> impl Strategy<Value = Camera> {
    let image = (1..36i32, 1..9i32, -6..7i32, -6..7i32);
    (
        origin(),
        whole(-2, 3),
        whole(-2, 3),
        image,
        0..6i32,
        1..40i32,
    )
        .prop_filter("parallel", |(_, direction, up, ..)| {
            direction.cross(*up) != DVec3::ZERO
        })
        .prop_map(
            |(eye, direction, up, (fov, aspect, x, y), near, depth)| Camera {
                eye,
                direction,
                up,
                fov: (f64::from(fov) * 5.0 - 2.0).to_radians(),
                aspect: f64::from(aspect) / 3.0,
                near: f64::from(near),
                far: f64::from(near + depth),
                shift: DVec2::new(f64::from(x / 3), f64::from(y / 3)) * 0.75,
            },
        )
}

/// Boxes of all shapes, flat ones among them, at whole coordinates around the eye.
fn scene() -> impl Strategy<Value = (Camera, Box3d)> {
    (camera(), whole(-30, 30), whole(0, 25)).prop_map(|(camera, corner, size)| {
        let corner = camera.eye + corner;
        (camera, Box3d::new(corner, corner + size))
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    #[test]
    fn never_misses_a_box_with_a_point_inside(
        camera in camera(),
        image in (-1.0..=1.0, -1.0..=1.0),
        share in prop_oneof![Just(0.0), Just(1.0), 0.0..1.0],
        size in prop::array::uniform3(prop_oneof![Just(0.0), -9.0..3.0f64]),
        place in whole(0, 3),
    ) {
        let depth = camera.near + (camera.far - camera.near) * share;
        let point = point_at(&camera, depth, DVec2::from(image));
        let size = DVec3::from(size.map(|exponent: f64| if exponent == 0.0 { 0.0 } else { exponent.exp2().powi(3) }));
        let min = point - size * place / 2.0;
        let target = Box3d::new(min.min(point), (min + size).max(point));
        // A point that was rounded may be outside by as much.
        let rounded = point.abs().max_element() * 1e-15;
        let frustum = Frustum::new(&camera).expect("not parallel");
        prop_assert!(frustum.meets(&target.expanded(rounded).expect("grows")));
    }

    #[test]
    fn meets_just_what_has_a_common_point((camera, target) in scene()) {
        let local = relative(&target, camera.eye);
        let meets = Frustum::new(&camera).expect("not parallel").meets(&target);
        if have_common_point(half_spaces(&camera, -1e-9), &local, 1e-10) {
            prop_assert!(meets);
        }
        if meets {
            prop_assert!(have_common_point(half_spaces(&camera, 1e-8), &local, 1e-9));
        }
    }

    #[test]
    fn a_box_around_one_that_is_met_is_met((camera, target) in scene(), margin in 0.0..1e16f64) {
        let frustum = Frustum::new(&camera).expect("not parallel");
        if frustum.meets(&target) {
            for grown in [margin, margin.sqrt(), margin.cbrt()] {
                prop_assert!(frustum.meets(&target.expanded(grown).expect("grows")));
            }
        }
    }
}

fn level() -> Camera {
    Camera {
        eye: DVec3::ZERO,
        direction: DVec3::Y,
        up: DVec3::Z,
        fov: 90f64.to_radians(),
        aspect: 2.0,
        near: 1.0,
        far: 10.0,
        shift: DVec2::ZERO,
    }
}

fn meets(camera: &Camera, corner: [f64; 3], opposite: [f64; 3]) -> bool {
    Frustum::new(camera)
        .expect("not parallel")
        .meets(&Box3d::new(corner.into(), opposite.into()))
}

#[test]
fn boxes_that_touch_are_met_and_those_a_hair_away_are_not() {
    let camera = level();
    // Near and far plane, an edge, a corner, and the same from a micrometre away.
    assert!(meets(&camera, [-9.0, -9.0, -9.0], [9.0, 1.0, 9.0]));
    assert!(!meets(&camera, [-9.0, -9.0, -9.0], [9.0, 1.0 - 1e-6, 9.0]));
    assert!(meets(&camera, [-9.0, 10.0, -9.0], [9.0, 12.0, 9.0]));
    assert!(!meets(&camera, [-9.0, 10.0 + 1e-6, -9.0], [9.0, 12.0, 9.0]));
    assert!(meets(&camera, [4.0, 0.0, -9.0], [5.0, 2.0, 9.0]));
    assert!(!meets(&camera, [4.0 + 1e-6, 0.0, -9.0], [5.0, 2.0, 9.0]));
    assert!(meets(&camera, [20.0, 10.0, 10.0], [21.0, 11.0, 11.0]));
    assert!(!meets(
        &camera,
        [20.0, 10.0, 10.0 + 1e-6],
        [21.0, 11.0, 11.0]
    ));
    assert!(meets(&camera, [0.0, 5.0, 0.0], [0.0, 5.0, 0.0]));
}

#[test]
fn a_box_past_an_edge_of_the_frustum_is_told_by_a_pair_of_edges_alone() {
    // A lens turned by 45 degrees about its axis: its upper edge is a corner of the image.
    let camera = Camera {
        up: DVec3::new(1.0, 0.0, 1.0),
        aspect: 1.0,
        ..level()
    };
    let edge = 5.0 * 2f64.sqrt();
    assert!(meets(&camera, [-1.0, 4.0, edge], [1.0, 5.0, 8.0]));
    assert!(!meets(&camera, [-1.0, 4.0, edge + 1e-6], [1.0, 5.0, 8.0]));
}

#[test]
fn a_pyramid_without_a_near_distance_holds_its_eye() {
    let camera = Camera {
        near: 0.0,
        ..level()
    };
    assert!(meets(&camera, [-1.0, -1.0, -1.0], [0.0, 0.0, 0.0]));
    assert!(!meets(&camera, [-1.0, -1.0, -1.0], [1.0, -1e-6, 1.0]));
    assert!(!meets(&level(), [-0.5, -0.5, -0.5], [0.5, 0.5, 0.5]));
}

#[test]
fn a_box_of_enormous_extent_is_met_where_a_small_part_of_it_is() {
    let small = Box3d::new(DVec3::new(106.0, 106.0, 0.0), DVec3::new(107.0, 107.0, 1.0));
    let large = Box3d::new(
        DVec3::new(-1e15, 0.0, -1.0),
        DVec3::new(1e300, 1e15 + 1.0, 50.0),
    );
    let everything = Box3d::new(DVec3::splat(f64::MIN), DVec3::splat(f64::MAX));
    let camera = Camera {
        eye: DVec3::new(110.0, 110.0, 1.5),
        direction: DVec3::new(-1.0, -1.0, -0.2),
        fov: 0.5,
        near: 0.1,
        far: 7.0,
        ..level()
    };
    let frustum = Frustum::new(&camera).expect("not parallel");
    assert!(large.contains(&small));
    assert!(
        [small, large, everything]
            .iter()
            .all(|target| frustum.meets(target))
    );
    // Nor does it matter how far the frustum goes, or how far it is from the origin.
    for far in [1e6, 1e15, 1e150, 1e300] {
        let frustum = Frustum::new(&Camera { far, ..camera }).expect("not parallel");
        assert!(
            [small, large, everything]
                .iter()
                .all(|target| frustum.meets(target)),
            "{far}"
        );
        let behind = Box3d::new(DVec3::splat(111.0), DVec3::splat(112.0));
        let above = Box3d::new(DVec3::new(105.0, 105.0, 4.0), DVec3::new(106.0, 106.0, 5.0));
        assert!(!frustum.meets(&behind) && !frustum.meets(&above), "{far}");
    }
}

#[test]
fn vectors_of_any_length_that_are_almost_parallel_make_a_frustum() {
    for scale in [1e-300, 1.0, 1e300] {
        let camera = Camera {
            direction: DVec3::new(0.0, 1.0, 1.0) * scale,
            up: DVec3::new(1e-8, 1.0, 1.0) / scale,
            ..level()
        };
        let [right, up, forward] = camera.axes().expect("not parallel");
        assert!((up - DVec3::X).length() < 1e-15, "{up}");
        assert!(right.dot(forward).abs() < 1e-15);
    }
    let parallel = Camera {
        up: DVec3::new(0.0, -3.0, 0.0),
        ..level()
    };
    let nowhere = Camera {
        direction: DVec3::ZERO,
        ..level()
    };
    assert_eq!(
        [parallel, nowhere].map(|camera| Frustum::new(&camera)),
        [None, None]
    );
}
