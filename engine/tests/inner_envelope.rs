//! Inner envelopes of random and hostile solids, against exact cell counts and against points and
//! rays that share no code with the search.

use engine::{Box3d, GROUND_TOLERANCE, InnerEnvelope, MeshDefect, TriangleMesh, inner_envelope};
use glam::{DMat3, DVec3};
use proptest::prelude::*;

type Triangles = Vec<[DVec3; 3]>;

/// Far from the origin, as in national grids.
const FAR: DVec3 = DVec3::new(85_000.0, 447_000.0, 0.0);

/// The faces of a box, turning anticlockwise seen from outside.
fn box_faces(bounds: &Box3d) -> Vec<[DVec3; 4]> {
    let c = bounds.corners();
    [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ]
    .map(|face| face.map(|i: usize| c[i]))
    .to_vec()
}

fn split([a, b, c, d]: [DVec3; 4]) -> [[DVec3; 3]; 2] {
    [[a, b, c], [a, c, d]]
}

fn box_triangles(bounds: &Box3d) -> Triangles {
    box_faces(bounds).into_iter().flat_map(split).collect()
}

fn boxed(min: [f64; 3], max: [f64; 3]) -> Triangles {
    box_triangles(&Box3d::new(DVec3::from_array(min), DVec3::from_array(max)))
}

fn flipped(triangles: Triangles) -> Triangles {
    triangles.into_iter().map(|[a, b, c]| [a, c, b]).collect()
}

fn moved(triangles: Triangles, place: impl Fn(DVec3) -> DVec3) -> Triangles {
    triangles.into_iter().map(|t| t.map(&place)).collect()
}

/// Coordinates as delivered: whole millimetres.
fn delivered(point: DVec3) -> DVec3 {
    (point * 1000.0).round() / 1000.0
}

fn search(triangles: &Triangles) -> Result<InnerEnvelope, MeshDefect> {
    inner_envelope(&TriangleMesh::from_triangles(triangles.iter().copied()))
}

/// Signed count of crossings on a ray: how often the surface winds around its start.
fn crossings(triangles: &Triangles, from: DVec3, direction: DVec3) -> i32 {
    let crossing = |[a, b, c]: &[DVec3; 3]| {
        let volume = |p: DVec3, q: DVec3| direction.dot((p - from).cross(q - from));
        let sides = [volume(*a, *b), volume(*b, *c), volume(*c, *a)];
        let ahead = (b - a).cross(c - a).dot(a - from);
        match sides {
            s if s.iter().all(|&x| x > 0.0) && ahead > 0.0 => 1,
            s if s.iter().all(|&x| x < 0.0) && ahead < 0.0 => -1,
            _ => 0,
        }
    };
    triangles.iter().map(crossing).sum()
}

/// Points spread over a closed unit cube, corners, edges and faces among them.
fn lattice(steps: usize) -> impl Iterator<Item = DVec3> {
    let share = move |i: usize| i as f64 / steps as f64;
    let count = steps + 1;
    (0..count.pow(3)).map(move |i| {
        DVec3::new(
            share(i % count),
            share(i / count % count),
            share(i / count / count),
        )
    })
}

/// Whether the box is inside as far as points can tell: points of it are wound around, seen along
/// two rays, and no point of the surface is in its open inside.
fn assert_inside(envelope: &InnerEnvelope, triangles: &Triangles) {
    let Box3d { min, max } = envelope.bounds;
    assert!(min.cmplt(max).all(), "empty box {envelope:?}");
    for share in lattice(4) {
        // A hair inside, so that flush faces do not count.
        let point = min + (max - min) * (share * (1.0 - 2e-6) + 1e-6);
        for direction in [
            DVec3::new(0.612_37, 0.353_55, 0.707_01),
            DVec3::new(-0.31, 0.77, -0.557),
        ] {
            let winding = crossings(triangles, point, direction);
            assert!(
                winding >= 1,
                "winding {winding} at {point:?} of {envelope:?}"
            );
        }
    }
    let (low, high) = (min + 1e-9, max - 1e-9);
    for [a, b, c] in triangles {
        for i in 0..=12 {
            for j in 0..=12 - i {
                let point = a + (b - a) * (i as f64 / 12.0) + (c - a) * (j as f64 / 12.0);
                let within = low.cmplt(point).all() && point.cmplt(high).all();
                assert!(!within, "surface point {point:?} in {envelope:?}");
            }
        }
    }
    let foot = triangles
        .iter()
        .flatten()
        .map(|p| p.z)
        .fold(f64::INFINITY, f64::min);
    assert_eq!(envelope.grounded, min.z - foot <= GROUND_TOLERANCE);
}

/// A solid of cells between uneven planes.
#[derive(Clone, Debug)]
struct Cells {
    planes: [Vec<f64>; 3],
    solid: Vec<bool>,
}

const SIDE: usize = 4;

impl Cells {
    fn is_solid(&self, cell: [i64; 3]) -> bool {
        let inside = cell.iter().all(|&i| (0..SIDE as i64).contains(&i));
        inside && self.solid[cell.iter().fold(0, |sum, &i| sum * SIDE + i as usize)]
    }

    fn bounds(&self, low: [usize; 3], high: [usize; 3]) -> Box3d {
        let corner = |at: [usize; 3]| DVec3::from_array([0, 1, 2].map(|a| self.planes[a][at[a]]));
        Box3d::new(corner(low), corner(high))
    }

    /// The faces between solid and empty.
    fn surface(&self) -> Triangles {
        let mut triangles = Vec::new();
        for cell in blocks([0; 3], [SIDE; 3]).filter(|c| self.is_solid(c.map(|i| i as i64))) {
            let faces = box_faces(&self.bounds(cell, cell.map(|i| i + 1)));
            for (face, (axis, step)) in
                faces
                    .into_iter()
                    .zip([(2, -1), (2, 1), (1, -1), (1, 1), (0, -1), (0, 1)])
            {
                let mut beside = cell.map(|i| i as i64);
                beside[axis] += step;
                if !self.is_solid(beside) {
                    triangles.extend(split(face));
                }
            }
        }
        triangles
    }

    /// The largest solid box of cells, by trying all.
    fn largest(&self) -> Option<Box3d> {
        let boxes = blocks([0; 3], [SIDE; 3])
            .flat_map(|low| blocks(low.map(|i| i + 1), [SIDE + 1; 3]).map(move |high| (low, high)));
        let solid = boxes.filter(|&(low, high)| {
            blocks(low, high).all(|cell| self.is_solid(cell.map(|i| i as i64)))
        });
        solid
            .map(|(low, high)| self.bounds(low, high))
            .max_by(|a, b| a.volume().total_cmp(&b.volume()))
    }
}

/// All cells from `low` up to, not including, `high`.
fn blocks(low: [usize; 3], high: [usize; 3]) -> impl Iterator<Item = [usize; 3]> {
    (low[0]..high[0]).flat_map(move |x| {
        (low[1]..high[1]).flat_map(move |y| (low[2]..high[2]).map(move |z| [x, y, z]))
    })
}

fn cells() -> impl Strategy<Value = Cells> {
    let widths = prop::collection::vec(0.3..6.0f64, 3 * SIDE);
    let solid = prop::collection::vec(prop::bool::weighted(0.7), SIDE * SIDE * SIDE);
    (widths, solid, any::<bool>()).prop_map(|(widths, solid, far)| {
        let planes = [0, 1, 2].map(|axis| {
            let mut planes = vec![if far { FAR[axis] } else { 0.0 }];
            for width in &widths[axis * SIDE..(axis + 1) * SIDE] {
                planes.push(planes[planes.len() - 1] + width);
            }
            planes
        });
        Cells { planes, solid }
    })
}

/// Less than the search promises for a solid that holds `optimum`: whole grid cells of it.
fn promised(optimum: &Box3d, triangles: &Triangles) -> f64 {
    let envelope = Box3d::around(triangles.iter().flatten().copied()).expect("has triangles");
    let cell = envelope.size() / 24.0;
    (optimum.size() - 2.01 * cell)
        .max(DVec3::ZERO)
        .element_product()
}

/// A house with a gabled roof, a rotated box, a needle, or a wedge, anywhere.
fn part() -> impl Strategy<Value = Triangles> {
    let size = (0.5..15.0f64, 0.5..15.0f64, 0.5..15.0f64);
    let place = (
        -10.0..10.0f64,
        -10.0..10.0f64,
        prop_oneof![Just(0.0), -3.0..8.0f64],
    );
    (0..4u8, size, place, 0.0..std::f64::consts::TAU, 0.0..0.6f64).prop_map(
        |(kind, size, place, turn, tilt)| {
            let (size, place) = (DVec3::from(size), DVec3::from(place));
            let size = if kind == 2 {
                size * DVec3::new(0.05, 0.05, 1.0)
            } else {
                size
            };
            let mut part = boxed([0.0; 3], size.to_array());
            if kind != 2 && kind != 1 {
                // The upper face leans over to a ridge (0) or an edge (3).
                let lean = if kind == 0 { 0.5 } else { 0.0 };
                part = moved(part, |p| {
                    let x = if p.z > 0.0 {
                        lean * size.x + p.x * 1e-3
                    } else {
                        p.x
                    };
                    DVec3::new(x, p.y, p.z)
                });
            }
            let tilt = if kind == 1 { tilt } else { 0.0 };
            let turn = DMat3::from_rotation_z(turn) * DMat3::from_rotation_x(tilt);
            moved(part, |p| turn * p + place)
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn cells_hold_the_box_and_it_is_large(cells in cells()) {
        let triangles = cells.surface();
        let Some(optimum) = cells.largest() else { return Ok(()) };
        match search(&triangles) {
            Ok(envelope) => {
                // Exact: each cell that the open box meets is solid.
                let Box3d { min, max } = envelope.bounds;
                for cell in blocks([0; 3], [SIDE; 3]) {
                    let bounds = cells.bounds(cell, cell.map(|i| i + 1));
                    let meets = min.cmplt(bounds.max).all() && bounds.min.cmplt(max).all();
                    prop_assert!(!meets || cells.is_solid(cell.map(|i| i as i64)));
                }
                prop_assert!(envelope.bounds.volume() <= optimum.volume() * (1.0 + 1e-12));
                prop_assert!(envelope.bounds.volume() >= promised(&optimum, &triangles));
                assert_inside(&envelope, &triangles);
            }
            Err(defect) => prop_assert!(promised(&optimum, &triangles) == 0.0, "{defect}"),
        }
    }

    #[test]
    fn turned_cells_hold_the_box(cells in cells(), turn in 0.0..1.6f64) {
        let start = cells.bounds([0; 3], [0; 3]).min;
        let turn = DMat3::from_rotation_z(turn);
        let triangles = moved(cells.surface(), |p| delivered(turn * (p - start) + start));
        if let Ok(envelope) = search(&triangles) {
            assert_inside(&envelope, &triangles);
        }
    }

    #[test]
    fn overlapping_parts_hold_the_box(
        parts in prop::collection::vec(part(), 1..6),
        far in any::<bool>(),
    ) {
        let origin = if far { FAR } else { DVec3::ZERO };
        let triangles = moved(parts.concat(), |p| delivered(p + origin));
        match search(&triangles) {
            Ok(envelope) => assert_inside(&envelope, &triangles),
            Err(defect) => prop_assert_eq!(defect, MeshDefect::TooThin),
        }
    }

    #[test]
    fn a_box_is_its_own_inner_envelope(
        a in prop::array::uniform3(-1e6..1e6f64),
        size in prop::array::uniform3(1e-3..1e3f64),
        swap in any::<bool>(),
    ) {
        let bounds = Box3d::new(DVec3::from_array(a), DVec3::from_array(a) + DVec3::from_array(size));
        let mut triangles = box_triangles(&bounds);
        if swap {
            triangles.reverse();
        }
        let envelope = search(&triangles);
        prop_assert_eq!(envelope, Ok(InnerEnvelope { bounds, grounded: true }));
    }

    #[test]
    fn random_triangles_never_panic(
        corners in prop::collection::vec(prop::array::uniform3(-3..3i8), 3..40),
        scale in prop_oneof![Just(1.0), Just(1e-300), Just(1e300), Just(f64::NAN)],
    ) {
        let points: Vec<DVec3> =
            corners.iter().map(|c| DVec3::from_array(c.map(f64::from)) * scale).collect();
        // Each triangle once with each side: closed, and holds nothing.
        let doubled: Triangles = points
            .windows(3)
            .flat_map(|w| [[w[0], w[1], w[2]], [w[0], w[2], w[1]]])
            .collect();
        prop_assert!(search(&doubled).is_err());
        let single: Triangles = points.windows(3).map(|w| [w[0], w[1], w[2]]).collect();
        if let Ok(envelope) = search(&single) {
            assert_inside(&envelope, &single);
        }
    }
}

#[test]
fn flush_neighbours_keep_their_common_wall() {
    // Two touching solids: the wall between them, delivered twice, stays in the way. At 6 m it is
    // in the middle, where a plane of the search grid would be.
    for wall in [5.0, 5.999, 6.0] {
        let row = [
            boxed([0.0; 3], [wall, 8.0, 6.0]),
            boxed([wall, 0.0, 0.0], [12.0, 8.0, 6.0]),
        ]
        .concat();
        let envelope = search(&row).expect("solid");
        assert_eq!(envelope.bounds.volume(), (12.0 - wall) * 48.0);
        assert!(envelope.grounded);
    }
}

#[test]
fn a_passage_lifts_the_box_off_the_ground() {
    let walls = [[0.0, 1.0], [11.0, 12.0]].map(|[x0, x1]| boxed([x0, 0.0, 0.0], [x1, 8.0, 3.0]));
    let above = boxed([0.0, 0.0, 3.0], [12.0, 8.0, 9.0]);
    let gate = [walls.concat(), above].concat();
    let bounds = Box3d::new(DVec3::new(0.0, 0.0, 3.0), DVec3::new(12.0, 8.0, 9.0));
    assert_eq!(
        search(&gate),
        Ok(InnerEnvelope {
            bounds,
            grounded: false
        })
    );
}

#[test]
fn hollows_are_outside() {
    let shell = [
        boxed([0.0; 3], [10.0; 3]),
        flipped(boxed([1.0; 3], [9.0; 3])),
    ]
    .concat();
    let envelope = search(&shell).expect("walls of 1 m hold a box");
    assert_inside(&envelope, &shell);
    assert_eq!(envelope.bounds.volume(), 100.0);
    // A solid within the hollow counts again.
    let nested = [shell, boxed([2.0; 3], [8.0; 3])].concat();
    let envelope = search(&nested).expect("the core holds a box");
    assert_eq!(
        envelope.bounds,
        Box3d::new(DVec3::splat(2.0), DVec3::splat(8.0))
    );
    assert!(!envelope.grounded);
}

#[test]
fn a_turned_square_gets_its_inscribed_square() {
    let turn = DMat3::from_rotation_z(std::f64::consts::FRAC_PI_4);
    let tower = moved(boxed([-5.0, -5.0, 0.0], [5.0, 5.0, 20.0]), |p| {
        turn * p + FAR
    });
    let envelope = search(&tower).expect("solid");
    assert_inside(&envelope, &tower);
    assert!(
        envelope.bounds.volume() > 0.995 * 50.0 * 20.0,
        "{envelope:?}"
    );
    assert!(envelope.grounded);
}

#[test]
fn a_sphere_gets_nearly_its_cube() {
    let around = 100;
    let at = |i: usize, j: usize| {
        let (theta, phi) = (i as f64 / 50.0, (j % around) as f64 / 50.0);
        let (theta, phi) = (theta * std::f64::consts::PI, phi * std::f64::consts::PI);
        let ring = if i == 0 || i == 50 { 0.0 } else { theta.sin() };
        FAR + 10.0 * DVec3::new(ring * phi.cos(), ring * phi.sin(), -theta.cos())
    };
    let quads = (0..50).flat_map(|i| {
        (0..around).map(move |j| [at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)])
    });
    let sphere: Triangles = quads.flat_map(split).collect();
    let envelope = search(&flipped(sphere.clone()));
    assert_eq!(envelope, Err(MeshDefect::InsideOut));
    let envelope = search(&sphere).expect("solid");
    assert_inside(&envelope, &sphere);
    let cube = (20.0 / 3.0f64.sqrt()).powi(3);
    assert!(envelope.bounds.volume() > 0.98 * cube, "{envelope:?}");
    assert!(!envelope.grounded);
}

#[test]
fn defects_are_told_apart() {
    let cube = boxed([0.0; 3], [10.0; 3]);
    let report = |triangles: &Triangles| search(triangles).expect_err("no solid").to_string();
    assert_eq!(report(&Vec::new()), "no faces");
    assert_eq!(report(&cube[2..].to_vec()), "open: 4 unpaired edge(s)");
    assert_eq!(report(&flipped(cube.clone())), "inside out");
    assert_eq!(
        report(&[cube.clone(), flipped(cube.clone())].concat()),
        "zero volume"
    );
    assert_eq!(report(&boxed([0.0; 3], [10.0, 10.0, 0.0])), "zero volume");
    let turn = DMat3::from_rotation_z(0.7);
    let sheet = moved(boxed([0.0; 3], [10.0, 0.001, 3.0]), |p| turn * p);
    assert_eq!(report(&sheet), "too thin for an inner box");
    let bow_tie = vec![
        DVec3::ZERO,
        DVec3::new(2.0, 2.0, 0.0),
        DVec3::X * 2.0,
        DVec3::Y * 2.0,
    ];
    let mesh = TriangleMesh::from_polygons([vec![bow_tie]]);
    assert_eq!(
        inner_envelope(&mesh),
        Err(MeshDefect::UntriangulableFaces { faces: 1 })
    );
}
