//! Meshes, inner envelopes and the solid ground below.

use oracle::{Aabb, GROUND_TOLERANCE, InnerFault, Mesh, Point, check_inner_envelope, solid_ground};
use proptest::prelude::*;

use crate::solids::{box_mesh, inside_out, joined, prism};

const HOUSE: Aabb = Aabb {
    min: [85_000.1, 447_000.2, -0.7],
    max: [85_010.3, 447_012.4, 9.6],
};

/// HOUSE made smaller by `margin` on all sides.
fn shrunk(margin: f64) -> Aabb {
    Aabb::new(HOUSE.min.map(|x| x + margin), HOUSE.max.map(|x| x - margin))
}

/// A house of 10 x 10 x 9 m, 0 to 10 in x and y, with a passage of 5 x 10 x 3 m along its left foot.
fn house_with_passage() -> Mesh {
    lying_prism(&[
        [5.0, 0.0],
        [10.0, 0.0],
        [10.0, 9.0],
        [0.0, 9.0],
        [0.0, 3.0],
        [5.0, 3.0],
    ])
}

/// A prism over an outline in x and z, from 0 to 10 in y.
fn lying_prism(outline: &[[f64; 2]]) -> Mesh {
    let standing = prism(outline, -10.0, 0.0);
    let vertices = standing
        .vertices
        .iter()
        .map(|&[x, z, y]| [x, -y, z])
        .collect();
    Mesh {
        vertices,
        triangles: standing.triangles,
    }
}

#[test]
fn a_box_inside_is_right() {
    let mesh = box_mesh(&HOUSE);
    assert!(mesh.is_closed());
    assert_eq!(check_inner_envelope(&mesh, &HOUSE, true), Ok(()));
    assert_eq!(check_inner_envelope(&mesh, &shrunk(0.005), true), Ok(()));
    assert_eq!(check_inner_envelope(&mesh, &shrunk(1.0), false), Ok(()));
}

#[test]
fn a_box_that_pokes_out_a_millimetre_is_found() {
    let mesh = box_mesh(&HOUSE);
    for axis in 0..3 {
        let mut inner = shrunk(1.0);
        inner.max[axis] = HOUSE.max[axis] + 0.001;
        let fault = check_inner_envelope(&mesh, &inner, false).unwrap_err();
        assert!(
            matches!(fault, InnerFault::TriangleInside { .. }),
            "{fault}"
        );
        inner.max[axis] = HOUSE.max[axis].next_up();
        let fault = check_inner_envelope(&mesh, &inner, false).unwrap_err();
        assert!(
            matches!(fault, InnerFault::TriangleInside { .. }),
            "{fault}"
        );
    }
}

#[test]
fn a_box_under_a_slanted_roof_may_touch_it() {
    // A ridge roof z = 8 - |x|, and a box whose upper edges lie on it.
    let mesh = lying_prism(&[[-4.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 8.0], [-4.0, 4.0]]);
    let inner = |top: f64| Aabb::new([-2.0, 0.0, 0.0], [2.0, 10.0, top]);
    assert_eq!(check_inner_envelope(&mesh, &inner(6.0), true), Ok(()));
    let fault = check_inner_envelope(&mesh, &inner(6f64.next_up()), true).unwrap_err();
    assert!(
        matches!(fault, InnerFault::TriangleInside { .. }),
        "{fault}"
    );
}

#[test]
fn a_box_claimed_grounded_above_a_passage_is_found() {
    let mesh = house_with_passage();
    let above = Aabb::new([0.5, 1.0, 3.0], [9.0, 9.0, 9.0]);
    assert_eq!(check_inner_envelope(&mesh, &above, false), Ok(()));
    let fault = check_inner_envelope(&mesh, &above, true);
    assert_eq!(
        fault,
        Err(InnerFault::NotGrounded {
            bottom: 3.0,
            foot: 0.0
        })
    );
    let beside = Aabb::new([5.0, 1.0, 0.0], [10.0, 9.0, 9.0]);
    assert_eq!(check_inner_envelope(&mesh, &beside, true), Ok(()));
    let lifted = Aabb::new([5.0, 1.0, GROUND_TOLERANCE], [10.0, 9.0, 9.0]);
    assert_eq!(check_inner_envelope(&mesh, &lifted, true), Ok(()));
    let through = Aabb::new([1.0, 1.0, 0.0], [9.0, 9.0, 9.0]);
    let fault = check_inner_envelope(&mesh, &through, true).unwrap_err();
    assert!(
        matches!(fault, InnerFault::TriangleInside { .. }),
        "{fault}"
    );
    // In the passage itself: outside.
    let under = Aabb::new([1.0, 1.0, 0.0], [4.0, 9.0, 3.0]);
    let fault = check_inner_envelope(&mesh, &under, true).unwrap_err();
    assert!(
        matches!(fault, InnerFault::CentreOutside { winding: 0, .. }),
        "{fault}"
    );
}

#[test]
fn an_inside_out_mesh_is_found() {
    let mesh = inside_out(&box_mesh(&HOUSE));
    assert!(mesh.is_closed());
    let fault = check_inner_envelope(&mesh, &shrunk(1.0), false).unwrap_err();
    assert!(
        matches!(fault, InnerFault::CentreOutside { winding: -1, .. }),
        "{fault}"
    );
}

#[test]
fn a_box_in_a_cavity_is_found() {
    let mesh = joined(&box_mesh(&HOUSE), &inside_out(&box_mesh(&shrunk(2.0))));
    let fault = check_inner_envelope(&mesh, &shrunk(2.5), false).unwrap_err();
    assert!(
        matches!(fault, InnerFault::CentreOutside { winding: 0, .. }),
        "{fault}"
    );
    let wall = Aabb::new(HOUSE.min, [HOUSE.min[0] + 1.9, HOUSE.max[1], HOUSE.max[2]]);
    assert_eq!(check_inner_envelope(&mesh, &wall, true), Ok(()));
}

#[test]
fn an_open_mesh_is_found() {
    let whole = box_mesh(&HOUSE);
    for missing in 0..whole.triangles.len() {
        let mut mesh = whole.clone();
        mesh.triangles.remove(missing);
        assert!(!mesh.is_closed());
        let fault = check_inner_envelope(&mesh, &shrunk(1.0), false);
        assert_eq!(fault, Err(InnerFault::OpenMesh));
    }
    let mut turned = whole.clone();
    turned.triangles[3].swap(0, 1);
    assert!(!turned.is_closed());
    let mut out_of_range = whole.clone();
    out_of_range.triangles[3][1] = 8;
    assert!(!out_of_range.is_closed());
    assert_eq!(
        out_of_range.winding_number([85_005.0, 447_005.0, 3.0]),
        None
    );
    let mut missing = whole.clone();
    missing.vertices[3][1] = f64::NAN;
    assert_eq!(
        check_inner_envelope(&missing, &HOUSE, false),
        Err(InnerFault::OpenMesh)
    );
    assert!(!Mesh::default().is_closed());
}

#[test]
fn a_gap_of_one_bit_is_open() {
    let whole = box_mesh(&HOUSE);
    let mut split = Mesh::from_triangles(&whole.corners().unwrap());
    assert!(split.is_closed());
    split.vertices[0][2] = split.vertices[0][2].next_up();
    assert!(!split.is_closed());
}

#[test]
fn needles_and_signed_zeros_do_not_open_a_mesh() {
    let whole = box_mesh(&Aabb::new([0.0; 3], [2.0; 3]));
    let mut split = Mesh::from_triangles(&whole.corners().unwrap());
    let zero = split
        .vertices
        .iter_mut()
        .flatten()
        .find(|x| **x == 0.0)
        .unwrap();
    *zero = -0.0;
    assert!(split.is_closed());
    for needle in [[0, 0, 1], [1, 0, 0], [3, 3, 3], [0, 1, 0]] {
        let mut mesh = whole.clone();
        mesh.triangles.push(needle);
        assert!(mesh.is_closed(), "{needle:?}");
        assert_eq!(mesh.winding_number([1.0; 3]), Some(1), "{needle:?}");
    }
}

#[test]
fn a_ray_up_through_a_ridge_counts_once() {
    let along_y = lying_prism(&[[-4.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 8.0], [-4.0, 4.0]]);
    let swapped = along_y
        .vertices
        .iter()
        .map(|&[x, y, z]| [y, x, z])
        .collect();
    let along_x = inside_out(&Mesh {
        vertices: swapped,
        triangles: along_y.triangles.clone(),
    });
    for y in [2.0, 5.0, 9.5] {
        assert_eq!(along_y.winding_number([0.0, y, 5.0]), Some(1));
        assert_eq!(along_x.winding_number([y, 0.0, 5.0]), Some(1));
        assert_eq!(along_x.winding_number([y, 0.0, -5.0]), Some(0));
    }
}

#[test]
fn a_box_without_volume_is_found() {
    let mesh = box_mesh(&HOUSE);
    let [x, y, z] = [85_005.0, 447_005.0, 3.0];
    let boxes = [
        Aabb::new([x, y, z], [x + 1.0, y + 1.0, z]),
        Aabb::new([x, y, z], [x + 1.0, y + 1.0, z.next_up()]),
        Aabb::new([x, y, z], [x + 1.0, y - 1.0, z + 1.0]),
        Aabb::new([x, y, f64::NEG_INFINITY], [x + 1.0, y + 1.0, z]),
        Aabb::new([x, f64::NAN, z], [x + 1.0, y + 1.0, z + 1.0]),
    ];
    for inner in boxes {
        let fault = check_inner_envelope(&mesh, &inner, false).unwrap_err();
        assert!(matches!(fault, InnerFault::NoVolume { .. }), "{fault}");
    }
}

#[test]
fn winding_of_points_on_the_surface_is_undefined() {
    let mesh = box_mesh(&Aabb::new([0.0; 3], [2.0; 3]));
    for point in [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 2.0], [2.0, 1.0, 0.5]] {
        assert_eq!(mesh.winding_number(point), None, "{point:?}");
    }
    // The ray up from these passes through vertices, edges and vertical faces.
    for point in [
        [0.0, 0.0, -1.0],
        [1.0, 1.0, -1.0],
        [2.0, 1.0, -1.0],
        [1.0, 0.0, -1.0],
    ] {
        assert_eq!(mesh.winding_number(point), Some(0), "{point:?}");
    }
    for point in [[1.0, 1.0, 1.0], [0.5, 0.5, 1.0], [1e-300, 1e-300, 1e-300]] {
        assert_eq!(mesh.winding_number(point), Some(1), "{point:?}");
    }
    let twice = joined(&mesh, &mesh);
    assert_eq!(twice.winding_number([1.0; 3]), Some(2));
    assert_eq!(mesh.winding_number([f64::NAN; 3]), None);
}

fn grid_box() -> impl Strategy<Value = Aabb> {
    ([0..6i32, 0..6, 0..6], [1..4i32, 1..4, 1..4]).prop_map(|(min, size)| {
        let min = min.map(f64::from);
        Aabb::new(
            min,
            std::array::from_fn(|axis| min[axis] + f64::from(size[axis])),
        )
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]
    /// The winding number of many boxes is how many of them hold the point.
    #[test]
    fn winding_counts_boxes(
        boxes in proptest::collection::vec((grid_box(), any::<bool>()), 1..6),
        points in proptest::collection::vec([0..40i32, 0..40, 0..40], 20),
    ) {
        let meshes = boxes.iter().map(|(aabb, out)| {
            if *out { box_mesh(aabb) } else { inside_out(&box_mesh(aabb)) }
        });
        let mesh = meshes.reduce(|a, b| joined(&a, &b)).unwrap();
        prop_assert!(mesh.is_closed());
        for point in points {
            let point: Point = point.map(|step| 0.25 * f64::from(step));
            let mut expected = Some(0);
            for (aabb, out) in &boxes {
                let holds = |strict: bool| (0..3).all(|i| {
                    let (lo, x, hi) = (aabb.min[i], point[i], aabb.max[i]);
                    if strict { lo < x && x < hi } else { lo <= x && x <= hi }
                });
                let sign = if *out { 1 } else { -1 };
                expected = match (holds(true), holds(false)) {
                    (true, _) => expected.map(|winding| winding + sign),
                    (false, true) => None,
                    (false, false) => expected,
                };
            }
            prop_assert_eq!(mesh.winding_number(point), expected);
        }
    }

    /// A turned prism: no face is parallel to an axis but the caps.
    #[test]
    fn winding_in_a_turned_prism(angle in 0.0..6.3, u in -1.2..1.2, v in -1.2..1.2, z in -1.0..11.0) {
        let (sin, cos) = f64::sin_cos(angle);
        let turned = |x: f64, y: f64| {
            [85_000.0 + 10.0 * (cos * x - sin * y), 447_000.0 + 10.0 * (sin * x + cos * y)]
        };
        let outline = [turned(-1.0, -1.0), turned(1.0, -1.0), turned(1.0, 1.0), turned(-1.0, 1.0)];
        let mesh = prism(&outline, 0.0, 10.0);
        prop_assume!((f64::abs(u) - 1.0).abs() > 1e-6 && (f64::abs(v) - 1.0).abs() > 1e-6);
        let [x, y] = turned(u, v);
        let inside = f64::abs(u) < 1.0 && f64::abs(v) < 1.0 && 0.0 < z && z < 10.0;
        prop_assert_eq!(mesh.winding_number([x, y, z]), Some(i32::from(inside)));
    }
}

/// The ground closed by the foot above and a cap below winds once around points under the foot.
fn closed_ground(mesh: &Mesh, foot: &Aabb, depth: f64) -> Mesh {
    let mut triangles = solid_ground(mesh, depth);
    let cap = box_mesh(&Aabb::new([foot.min[0], foot.min[1], depth], foot.max));
    triangles.extend(&cap.corners().unwrap()[..4]);
    Mesh::from_triangles(&triangles)
}

#[test]
fn ground_hangs_from_the_foot() {
    let mesh = box_mesh(&HOUSE);
    let ground = closed_ground(
        &mesh,
        &Aabb::new(HOUSE.min, [HOUSE.max[0], HOUSE.max[1], HOUSE.min[2]]),
        -50.0,
    );
    assert!(ground.is_closed());
    assert_eq!(ground.winding_number([85_005.0, 447_005.0, -20.0]), Some(1));
    assert_eq!(ground.winding_number([85_005.0, 447_005.0, 0.0]), Some(0));
    assert_eq!(ground.winding_number([84_999.0, 447_005.0, -20.0]), Some(0));
}

#[test]
fn no_ground_under_a_passage() {
    let mesh = house_with_passage();
    let foot = Aabb::new([5.0, 0.0, 0.0], [10.0, 10.0, 0.0]);
    let ground = closed_ground(&mesh, &foot, -5.0);
    assert_eq!(solid_ground(&mesh, -5.0).len(), 8);
    assert!(ground.is_closed());
    assert_eq!(ground.winding_number([7.0, 5.0, -2.0]), Some(1));
    assert_eq!(ground.winding_number([2.0, 5.0, -2.0]), Some(0));
}

#[test]
fn ground_leaves_out_what_does_not_stand() {
    let mesh = box_mesh(&HOUSE);
    let mut open = mesh.clone();
    open.triangles.pop();
    assert!(solid_ground(&open, -50.0).is_empty());
    assert!(solid_ground(&mesh, HOUSE.min[2]).is_empty());
    assert!(solid_ground(&mesh, f64::NAN).is_empty());
    // A slab thinner than the tolerance stands on its bottom alone.
    let slab = Aabb::new(
        HOUSE.min,
        [HOUSE.max[0], HOUSE.max[1], HOUSE.min[2] + 0.005],
    );
    assert_eq!(solid_ground(&box_mesh(&slab), -50.0).len(), 8);
    // Two parts, one 2 cm higher than the other: only the lower one stands.
    let higher = |lift: f64| {
        let [x, y, z] = HOUSE.min;
        box_mesh(&Aabb::new(
            [x + 20.0, y, z + lift],
            [x + 30.0, y + 10.0, 9.0],
        ))
    };
    assert_eq!(solid_ground(&joined(&mesh, &higher(0.02)), -50.0).len(), 8);
    assert_eq!(
        solid_ground(&joined(&mesh, &higher(0.005)), -50.0).len(),
        16
    );
}
