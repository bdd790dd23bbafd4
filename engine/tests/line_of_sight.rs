//! Lines of sight against an exact oracle: in solids and surfaces on small grids, where running along
//! faces and through edges and corners is the rule, and chosen cases.

use engine::{
    Box3d, CityFeature, CityLayout, Closedness, Share, SightLine, TriangleMesh, generated_city,
};
use glam::{DVec3, I64Vec3};
use oracle::{Aabb, Mesh, Prism, RayCaster, Sight, Trace, segment_meets_interior};
use proptest::prelude::*;

/// How many random scenes a property is tried on.
const CASES: u32 = 4000;

/// Cells of a grid that may be full.
const GRID: I64Vec3 = I64Vec3::new(3, 3, 2);

/// Where a grid is, and how it is sheared.
#[derive(Clone, Copy, Debug)]
struct Frame {
    origin: DVec3,
    step: f64,
    /// Columns of an integer matrix whose determinant is positive.
    shear: [I64Vec3; 3],
}

impl Frame {
    const PLAIN: Self = Self {
        origin: DVec3::ZERO,
        step: 1.0,
        shear: [I64Vec3::X, I64Vec3::Y, I64Vec3::Z],
    };

    /// The point at half steps of the grid.
    fn at(&self, halves: I64Vec3) -> DVec3 {
        let [x, y, z] = self.shear;
        let place = x * halves.x + y * halves.y + z * halves.z;
        self.origin + place.as_dvec3() * (self.step * 0.5)
    }
}

fn frames() -> impl Strategy<Value = Frame> {
    let shears = prop_oneof![
        2 => Just(Frame::PLAIN.shear),
        1 => Just([I64Vec3::new(1, 1, 0), I64Vec3::new(-1, 2, 1), I64Vec3::new(0, 1, 3)]),
        1 => Just([I64Vec3::new(2, 0, 1), I64Vec3::new(1, 1, 0), I64Vec3::new(0, -1, 1)]),
    ];
    let places = prop_oneof![
        4 => Just((DVec3::ZERO, 1.0)),
        2 => Just((DVec3::new(85_000.0, 447_000.0, -2.0), 5.0)),
        2 => Just((DVec3::new(85_000.0, 447_000.0, 1.5), 0.1)),
        1 => Just((DVec3::ZERO, 1e-80)),
        1 => Just((DVec3::ZERO, 1e90)),
    ];
    (shears, places).prop_map(|(shear, (origin, step))| Frame {
        origin,
        step,
        shear,
    })
}

/// The ends of a segment, in half steps of a grid.
fn ends() -> impl Strategy<Value = [I64Vec3; 2]> {
    let end = || (-3..10_i64, -3..10_i64, -3..8_i64).prop_map(|(x, y, z)| I64Vec3::new(x, y, z));
    let straight = (end(), 0..3usize, -12..12_i64).prop_map(|(from, axis, by)| {
        let mut to = from;
        to[axis] += by;
        [from, to]
    });
    let any = (end(), end()).prop_map(|(a, b)| [a, b]);
    prop_oneof![2 => any, 1 => straight]
}

/// The four corners of a face of a cell, anticlockwise seen from outside.
fn face(cell: I64Vec3, axis: usize, is_far: bool) -> [I64Vec3; 4] {
    let unit = |axis: usize| I64Vec3::AXES[axis % 3] * 2;
    let (u, v) = (unit(axis + 1), unit(axis + 2));
    let base = cell * 2 + if is_far { unit(axis) } else { I64Vec3::ZERO };
    if is_far {
        [base, base + u, base + u + v, base + v]
    } else {
        [base, base + v, base + u + v, base + u]
    }
}

/// The faces between full cells and empty ones, as triangles; a bit of `diagonals` says which way each
/// is cut.
fn shell(cells: &[I64Vec3], frame: &Frame, diagonals: u64) -> Vec<[DVec3; 3]> {
    let mut triangles = Vec::new();
    for &cell in cells {
        for (axis, is_far) in (0..3).flat_map(|axis| [(axis, false), (axis, true)]) {
            let way = if is_far { 1 } else { -1 };
            if cells.contains(&(cell + I64Vec3::AXES[axis] * way)) {
                continue;
            }
            let [a, b, c, d] = face(cell, axis, is_far).map(|corner| frame.at(corner));
            if diagonals >> (triangles.len() / 2 % 64) & 1 == 0 {
                triangles.extend([[a, b, c], [a, c, d]]);
            } else {
                triangles.extend([[b, c, d], [b, d, a]]);
            }
        }
    }
    triangles
}

fn full_cells(bits: u32) -> Vec<I64Vec3> {
    let cell = |i: i64| I64Vec3::new(i % 3, i / 3 % 3, i / 9);
    (0..GRID.element_product())
        .filter(|i| bits >> i & 1 == 1)
        .map(cell)
        .collect()
}

fn mesh(triangles: &[[DVec3; 3]]) -> TriangleMesh {
    TriangleMesh::from_triangles(triangles.iter().copied())
}

/// What the oracle says about a segment and triangles.
fn trace(line: [DVec3; 2], triangles: &[[DVec3; 3]]) -> Trace {
    let triangles: Vec<_> = triangles
        .iter()
        .map(|t| t.map(|corner| corner.to_array()))
        .collect();
    let [p, q] = line.map(|end| end.to_array());
    Mesh::from_triangles(&triangles).trace(p, q).unwrap()
}

/// The number of the piece of a trace with which a solid begins to hide, by the definition.
fn first_inside(trace: &Trace) -> Option<usize> {
    let is_inside = |winding: &Option<i32>| winding.is_some_and(|winding| winding > 0);
    let begins_inside = trace.cuts[0].touched.is_empty() && is_inside(&trace.windings[0]);
    let pieces = || trace.windings.iter().enumerate();
    let outside = if begins_inside {
        pieces()
            .find(|(_, winding)| winding.is_some_and(|w| w <= 0))?
            .0
    } else {
        0
    };
    let mut inside = pieces().skip(outside).filter(|(_, w)| is_inside(w));
    inside.next().map(|(piece, _)| piece)
}

/// Holds a share and what it means in metres against a cut of a trace.
fn assert_at_cut(line: &SightLine, from: DVec3, share: &Share, trace: &Trace, cut: usize) {
    let expected = DVec3::from_array(trace.cuts[cut].point);
    assert_eq!(line.point(share), expected);
    let distance = line.distance(share);
    // Both may be the origin.
    let size = from
        .abs()
        .max(expected.abs())
        .max_element()
        .max(f64::MIN_POSITIVE);
    let apart = (expected / size - from / size).length() * size;
    assert!(
        (distance - apart).abs() <= 1e-9 * apart.max(size * 1e-6),
        "{distance} {apart}"
    );
}

proptest! {
    #![proptest_config(ProptestConfig { max_global_rejects: 1_000_000, ..ProptestConfig::with_cases(CASES) })]

    #[test]
    fn solids_agree_with_the_oracle(
        frame in frames(), bits in 1..1u32 << 18, diagonals: u64, ends in ends(),
    ) {
        let [from, to] = ends.map(|end| frame.at(end));
        let Some(line) = SightLine::new(from, to) else {
            prop_assert_eq!(ends[0], ends[1]);
            return Ok(());
        };
        let triangles = shell(&full_cells(bits), &frame, diagonals);
        let trace = trace([from, to], &triangles);
        let share = line.enters(&mesh(&triangles));
        let expected = first_inside(&trace);
        prop_assert_eq!(share.is_some(), expected.is_some(), "{:?}", trace);
        if let Some((share, piece)) = share.zip(expected) {
            assert_at_cut(&line, from, &share, &trace, piece);
        }
    }

    /// Boxes that overlap, touch, and lie within each other, in one mesh: walls within it hide too.
    #[test]
    fn boxes_of_one_mesh_agree_with_cells(
        place in prop_oneof![Just((DVec3::ZERO, 1.0)), Just((DVec3::new(85_000.0, 447_000.0, 0.25), 0.5))],
        corners in prop::collection::vec(((0..5i64, 0..5i64, 0..4i64), (1..4i64, 1..4i64, 1..4i64)), 1..5),
        ends in ends(),
    ) {
        let at = |p: I64Vec3| place.0 + p.as_dvec3() * place.1;
        let [from, to] = ends.map(at);
        let Some(line) = SightLine::new(from, to) else { return Ok(()); };
        let boxes: Vec<[I64Vec3; 2]> = corners
            .iter()
            .map(|&(min, size)| [min.into(), I64Vec3::from(min) + I64Vec3::from(size)])
            .collect();
        let triangles: Vec<[DVec3; 3]> = boxes
            .iter()
            .flat_map(|&[min, max]| box_triangles(&Box3d::new(at(min), at(max))))
            .collect();
        let expected = lattice_entry(&boxes, ends).map(|point| place.0 + point * place.1);
        let share = line.enters(&mesh(&triangles));
        prop_assert_eq!(share.is_some(), expected.is_some());
        if let Some((share, point)) = share.zip(expected) {
            prop_assert!((line.point(&share) - point).length() < 1e-9);
        }
        for [min, max] in boxes {
            let bounds = Box3d::new(at(min), at(max));
            let prism = Prism::of_box(&Aabb::new(bounds.min.to_array(), bounds.max.to_array()), false);
            let crosses = segment_meets_interior(from.to_array(), to.to_array(), &prism.unwrap());
            prop_assert!(!crosses || line.meets(&bounds), "a box that it meets is not found");
        }
    }

    /// A surface of a solid with a simple surface, some of its triangles missing: the line passes
    /// through it where it crosses a triangle, and where it touches all triangles that the solid has
    /// there, and changes from inside to outside or back.
    #[test]
    fn surfaces_agree_with_the_oracle(
        frame in frames(), solid in 0..SIMPLE.len(), diagonals: u64, missing in 0..6usize, seed: u64,
        ends in ends(),
    ) {
        let [from, to] = ends.map(|end| frame.at(end));
        let Some(line) = SightLine::new(from, to) else { return Ok(()); };
        let whole = shell(&simple(solid), &frame, diagonals);
        let is_missing = |number: usize| {
            (0..missing).any(|i| (seed.rotate_left(11 * i as u32) % whole.len() as u64) as usize == number)
        };
        let rest: Vec<[DVec3; 3]> = whole.iter().enumerate()
            .filter(|(number, _)| !is_missing(*number)).map(|(_, t)| *t).collect();
        let trace = trace([from, to], &whole);
        let last = trace.cuts.len() - 1;
        let expected = (1..last).find(|&number| {
            let cut = &trace.cuts[number];
            let crosses = cut.crossed.iter().any(|&triangle| !is_missing(triangle));
            let is_whole = cut.along.is_empty() && !cut.touched.iter().any(|&t| is_missing(t));
            let changes = trace.windings[number - 1] != trace.windings[number];
            crosses || is_whole && changes
        });
        let share = line.passes_through(&mesh(&rest));
        prop_assert_eq!(share.is_some(), expected.is_some(), "{:?}", trace);
        if let Some((share, cut)) = share.zip(expected) {
            assert_at_cut(&line, from, &share, &trace, cut);
        }
        if (0..whole.len()).any(is_missing) {
            // What is not closed is no solid, whatever is said of it.
            prop_assert_eq!(line.enters(&mesh(&rest)), line.passes_through(&mesh(&rest)));
        }
    }

    #[test]
    fn pieces_hold_what_they_are_of(frame in frames(), ends in ends(), first in 0.0..1.0, size in 0.0..1.0) {
        let [from, to] = ends.map(|end| frame.at(end));
        let Some(line) = SightLine::new(from, to) else { return Ok(()); };
        let last = f64::min(first + size, 1.0);
        let piece = line.piece(first, last);
        for share in [first, first * 0.5 + last * 0.5, last] {
            let point = line.point(&Share::of(share));
            prop_assert!(piece.contains(&Box3d::new(point, point)));
            prop_assert!(line.meets(&Box3d::new(point.map(f64::next_down), point.map(f64::next_up))));
        }
    }
}

/// Where a point of a lattice line is: whether all unit cells next to it are in a box, and whether one
/// is. Its coordinates are those given over `share_of`.
fn cells_around(boxes: &[[I64Vec3; 2]], point: I64Vec3, share_of: i64) -> [bool; 2] {
    let along = |axis: usize| {
        let low = point[axis].div_euclid(share_of);
        let is_between = point[axis].rem_euclid(share_of) == 0;
        if is_between { low - 1..=low } else { low..=low }
    };
    let is_full = |cell: I64Vec3| {
        boxes
            .iter()
            .any(|[min, max]| min.cmple(cell).all() && cell.cmplt(*max).all())
    };
    let (mut all, mut any) = (true, false);
    for x in along(0) {
        for (y, z) in along(1).flat_map(|y| along(2).map(move |z| (y, z))) {
            let full = is_full(I64Vec3::new(x, y, z));
            all &= full;
            any |= full;
        }
    }
    [all, any]
}

/// Where a line between lattice points enters what boxes fill together, by counting cells at the
/// middle of each piece that lattice planes cut from it.
fn lattice_entry(boxes: &[[I64Vec3; 2]], [from, to]: [I64Vec3; 2]) -> Option<DVec3> {
    let way = to - from;
    // All shares at which a plane is met are whole multiples of one over this.
    let whole: i64 = (0..3).map(|axis| way[axis].abs().max(1)).product();
    let mut cuts: Vec<i64> = (0..3)
        .flat_map(|axis| (0..way[axis].abs()).map(move |i| i * (whole / way[axis].abs())))
        .chain([0, whole])
        .collect();
    cuts.sort_unstable();
    cuts.dedup();
    let [mut holds_eye, _] = cells_around(boxes, from, 1);
    for pair in cuts.windows(2) {
        let middle = from * (2 * whole) + way * (pair[0] + pair[1]);
        let [inside, touched] = cells_around(boxes, middle, 2 * whole);
        holds_eye &= touched;
        if inside && !holds_eye {
            return Some(from.as_dvec3() + way.as_dvec3() * (pair[0] as f64 / whole as f64));
        }
    }
    None
}

/// Solids whose surface is one sheet around every edge and corner.
const SIMPLE: [&[(i64, i64, i64)]; 5] = [
    &[(1, 1, 0)],
    &[(0, 0, 0), (1, 0, 0), (1, 1, 0)],
    &[(0, 0, 0), (1, 0, 0), (2, 0, 0), (0, 1, 0), (2, 1, 0)],
    &[(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1)],
    &[(0, 0, 0), (0, 0, 1), (0, 1, 0), (1, 0, 0)],
];

fn simple(number: usize) -> Vec<I64Vec3> {
    SIMPLE[number].iter().map(|&cell| cell.into()).collect()
}

fn box_triangles(bounds: &Box3d) -> Vec<[DVec3; 3]> {
    let faces = (0..3).flat_map(|axis| [(axis, false), (axis, true)]);
    faces
        .flat_map(|(axis, is_far)| {
            let [a, b, c, d] = face(I64Vec3::ZERO, axis, is_far)
                .map(|corner| bounds.min + bounds.size() * (corner.as_dvec3() * 0.5))
                // The far side exactly.
                .map(|p| {
                    DVec3::from_array(std::array::from_fn(|i| {
                        if p[i] == bounds.min[i] {
                            p[i]
                        } else {
                            bounds.max[i]
                        }
                    }))
                });
            [[a, b, c], [a, c, d]]
        })
        .collect()
}

fn house() -> TriangleMesh {
    mesh(&box_triangles(&Box3d::new(
        DVec3::new(10.0, 0.0, 0.0),
        DVec3::new(20.0, 8.0, 6.0),
    )))
}

/// Where a line from one point to another enters a mesh, in metres from its beginning.
fn entered(mesh: &TriangleMesh, from: [f64; 3], to: [f64; 3]) -> Option<f64> {
    let line = SightLine::new(from.into(), to.into()).unwrap();
    line.enters(mesh).map(|share| line.distance(&share))
}

#[test]
fn a_house_hides_what_is_behind_it_and_inside_it() {
    assert_eq!(
        entered(&house(), [0.0, 4.0, 2.0], [30.0, 4.0, 2.0]),
        Some(10.0)
    );
    assert_eq!(
        entered(&house(), [0.0, 4.0, 2.0], [12.0, 4.0, 2.0]),
        Some(10.0)
    );
    assert_eq!(entered(&house(), [0.0, 4.0, 2.0], [9.0, 4.0, 2.0]), None);
    assert_eq!(entered(&house(), [0.0, 4.0, 7.0], [30.0, 4.0, 7.0]), None);
    assert_eq!(entered(&house(), [7.0, 4.0, 2.0], [13.0, 8.0, 14.0]), None);
}

#[test]
fn a_house_does_not_hide_its_own_front() {
    assert_eq!(entered(&house(), [0.0, 4.0, 2.0], [10.0, 3.0, 5.0]), None);
    assert_eq!(entered(&house(), [0.0, 4.0, 2.0], [10.0, 0.0, 0.0]), None);
    // Its back it does.
    assert_eq!(
        entered(&house(), [0.0, 4.0, 2.0], [20.0, 4.0, 2.0]),
        Some(10.0)
    );
}

#[test]
fn touching_a_house_hides_nothing() {
    for (from, to, how) in [
        ([0.0, 0.0, 2.0], [30.0, 0.0, 2.0], "along a wall"),
        ([0.0, 4.0, 6.0], [30.0, 4.0, 6.0], "along the roof"),
        ([0.0, 0.0, 6.0], [30.0, 0.0, 6.0], "along an edge"),
        ([5.0, 5.0, 2.0], [15.0, -5.0, 2.0], "past an upright edge"),
        (
            [10.0, 4.0, 2.0],
            [10.0, 4.0, 60.0],
            "up the wall from a point on it",
        ),
        ([5.0, 0.0, 1.0], [15.0, 0.0, 11.0], "past a corner"),
        (
            [5.0, 5.0, 6.0],
            [15.0, -5.0, 6.0],
            "past a corner, along the roof",
        ),
    ] {
        assert_eq!(entered(&house(), from, to), None, "{how}");
    }
}

#[test]
fn a_house_that_holds_the_eye_hides_nothing_until_one_comes_back() {
    assert_eq!(entered(&house(), [15.0, 4.0, 2.0], [30.0, 4.0, 2.0]), None);
    assert_eq!(entered(&house(), [15.0, 4.0, 2.0], [16.0, 4.0, 2.0]), None);
    // From one wing of a courtyard into the other.
    let court = mesh(&shell(&simple(2), &Frame::PLAIN, 0));
    assert_eq!(entered(&court, [0.5, 1.5, 0.5], [2.5, 1.5, 0.5]), Some(1.5));
    assert_eq!(entered(&court, [0.5, 1.5, 0.5], [1.5, 1.5, 0.5]), None);
    // Along the back wall of the court one has not been outside.
    assert_eq!(entered(&court, [0.5, 1.0, 0.5], [2.5, 1.0, 0.5]), None);
    // An eye on a wall looks into the house at once.
    assert_eq!(
        entered(&house(), [10.0, 4.0, 2.0], [15.0, 4.0, 2.0]),
        Some(0.0)
    );
}

#[test]
fn a_sheet_hides_where_it_is_crossed() {
    let sheet = |corners: [[f64; 3]; 4]| {
        let [a, b, c, d] = corners.map(DVec3::from_array);
        vec![[a, b, c], [a, c, d]]
    };
    let wall = sheet([
        [5.0, 0.0, 0.0],
        [5.0, 4.0, 0.0],
        [5.0, 4.0, 4.0],
        [5.0, 0.0, 4.0],
    ]);
    let passed = |triangles: &[[DVec3; 3]], from: [f64; 3], to: [f64; 3]| {
        let line = SightLine::new(from.into(), to.into()).unwrap();
        line.passes_through(&mesh(triangles))
            .map(|share| line.distance(&share))
    };
    assert_eq!(passed(&wall, [0.0, 1.0, 2.0], [9.0, 1.0, 2.0]), Some(5.0));
    // Through the diagonal, and past its border, to a point on it, and along it.
    assert_eq!(passed(&wall, [0.0, 2.0, 2.0], [9.0, 2.0, 2.0]), Some(5.0));
    assert_eq!(passed(&wall, [0.0, 2.0, 4.0], [9.0, 2.0, 4.0]), None);
    assert_eq!(passed(&wall, [0.0, 0.0, 0.0], [9.0, 0.0, 0.0]), None);
    assert_eq!(passed(&wall, [0.0, 2.0, 2.0], [5.0, 2.0, 2.0]), None);
    assert_eq!(passed(&wall, [5.0, -1.0, 2.0], [5.0, 9.0, 2.0]), None);
    // Over a ridge one passes on one side, through it from side to side.
    let roof = [
        sheet([
            [0.0, 0.0, 0.0],
            [0.0, 9.0, 0.0],
            [5.0, 9.0, 5.0],
            [5.0, 0.0, 5.0],
        ]),
        sheet([
            [5.0, 0.0, 5.0],
            [5.0, 9.0, 5.0],
            [10.0, 9.0, 0.0],
            [10.0, 0.0, 0.0],
        ]),
    ]
    .concat();
    assert_eq!(passed(&roof, [0.0, 4.0, 5.0], [9.0, 4.0, 5.0]), None);
    assert_eq!(passed(&roof, [5.0, 4.0, 9.0], [5.0, 4.0, 0.0]), Some(4.0));
    assert_eq!(passed(&roof, [5.0, 5.0, 9.0], [5.0, 5.0, 0.0]), Some(4.0));
    // Two sheets that touch in a point close around nothing.
    let corners = [
        [[5.0, 0.0, 0.0], [5.0, 4.0, 0.0], [5.0, 4.0, 4.0]],
        [[5.0, 4.0, 4.0], [5.0, 8.0, 4.0], [5.0, 8.0, 8.0]],
    ]
    .map(|t| t.map(DVec3::from_array));
    assert_eq!(passed(&corners, [0.0, 4.0, 4.0], [9.0, 4.0, 4.0]), None);
    // A triangle whose corner is in the middle of another's edge closes the wall as well.
    let joined = [
        [[5.0, 0.0, 0.0], [5.0, 8.0, 0.0], [5.0, 4.0, 4.0]],
        [[5.0, 4.0, 4.0], [5.0, 8.0, 4.0], [5.0, 8.0, 0.0]],
        [[5.0, 0.0, 4.0], [5.0, 4.0, 4.0], [5.0, 0.0, 0.0]],
        [[5.0, 0.0, 4.0], [5.0, 8.0, 4.0], [5.0, 4.0, 8.0]],
    ]
    .map(|t| t.map(DVec3::from_array));
    assert_eq!(passed(&joined, [0.0, 4.0, 4.0], [9.0, 4.0, 4.0]), Some(5.0));
    assert_eq!(passed(&joined[1..], [0.0, 4.0, 4.0], [9.0, 4.0, 4.0]), None);
    // Three that share a corner and cross each other below it do, without a common edge.
    let crossed = [
        [[0.0, 0.0, 0.0], [-4.0, -1.0, -1.0], [4.0, -1.0, -1.0]],
        [[0.0, 0.0, 0.0], [4.0, -4.0, -1.0], [-2.0, 5.0, -1.0]],
        [[0.0, 0.0, 0.0], [2.0, 5.0, -1.0], [-4.0, -4.0, -1.0]],
    ]
    .map(|t| t.map(DVec3::from_array));
    assert_eq!(
        passed(&crossed, [0.0, 0.0, 5.0], [0.0, 0.0, -5.0]),
        Some(5.0)
    );
    assert_eq!(
        passed(&crossed[1..], [0.0, 0.0, 5.0], [0.0, 0.0, -5.0]),
        None
    );
}

#[test]
fn what_is_not_known_to_be_solid_hides_only_by_its_surface() {
    let (from, to) = ([0.0, 4.0, 2.0], [30.0, 4.0, 2.0]);
    let whole = house();
    let is_front = |t: &[u32; 3]| t.iter().all(|&i| whole.vertices[i as usize].x == 10.0);
    let mut open = whole.clone();
    open.triangles.retain(|t| !is_front(t));
    assert_eq!(open.closedness(), Closedness::Open { unpaired: 4 });
    assert_eq!(entered(&open, from, to), Some(20.0));
    // A vertex that is nowhere, or not there.
    let mut lost = house();
    lost.vertices[0].x = f64::NAN;
    assert_eq!(entered(&lost, from, to), None);
    let mut short = house();
    short.triangles[0][0] = 99;
    assert_eq!(entered(&short, from, to), None);
    assert_eq!(entered(&TriangleMesh::default(), from, to), None);
}

/// The fractional parts of multiples of irrational numbers fill a box evenly.
fn spread(number: u32, within: &Box3d, by: DVec3) -> DVec3 {
    within.min + within.size() * (by * f64::from(number)).fract()
}

#[test]
fn a_city_is_seen_as_the_ray_caster_sees_it() {
    let city: Vec<CityFeature> = generated_city(CityLayout::Streets, 150, 7)
        .features()
        .collect();
    let triangles: Vec<(u32, [[f64; 3]; 3])> = (0..)
        .zip(&city)
        .flat_map(|(id, feature)| {
            let corners = feature.mesh.corners();
            corners.map(move |triangle| (id, triangle.map(|corner| corner.to_array())))
        })
        .collect();
    let caster = RayCaster::new(&triangles).unwrap();
    let extent = (city.iter().map(|feature| feature.envelope))
        .reduce(|a, b| a.union(&b))
        .unwrap();
    let [mut clear, mut hidden] = [0, 0];
    for number in 1..3000 {
        let from = spread(number, &extent, DVec3::new(2.0, 3.0, 5.0).map(f64::sqrt));
        let to = spread(number, &extent, DVec3::new(7.0, 11.0, 13.0).map(f64::sqrt));
        let holds_eye = |feature: &CityFeature| feature.mesh.winding_number(from) > 0.5;
        if city.iter().any(holds_eye) {
            continue;
        }
        let line = SightLine::new(from, to).unwrap();
        let met = city.iter().filter(|f| line.meets(&f.envelope));
        let first = met.filter_map(|feature| line.enters(&feature.mesh)).min();
        match (caster.is_clear(from.to_array(), to.to_array(), None), first) {
            (Sight::Clear, None) => clear += 1,
            (Sight::Blocked { .. }, Some(share)) => {
                let way = (to - from).to_array();
                let hit = caster.first_hit(from.to_array(), way).unwrap();
                assert!((line.distance(&share) - hit.distance).abs() < 1e-6);
                hidden += 1;
            }
            other => panic!("{from} {to} {other:?}"),
        }
    }
    assert!(clear > 100 && hidden > 100, "{clear} {hidden}");
}

#[test]
fn a_line_needs_two_points() {
    let point = DVec3::new(1.0, 2.0, 3.0);
    assert!(SightLine::new(point, point).is_none());
    assert!(SightLine::new(point, DVec3::new(f64::NAN, 0.0, 0.0)).is_none());
    assert!(SightLine::new(DVec3::INFINITY, point).is_none());
    assert!(SightLine::new(DVec3::ZERO, -DVec3::ZERO).is_none());
}

#[test]
fn distances_are_rounded_once() {
    let line = SightLine::new(DVec3::new(1.0, 2.0, 3.0), DVec3::new(7.0, 10.0, 27.0)).unwrap();
    assert_eq!(line.distance(&Share::of(0.5)), 13.0);
    assert_eq!(line.distance(&Share::of(0.0)), 0.0);
    for scale in [1e-200, 1e200, 1e300] {
        let line = SightLine::new(DVec3::ZERO, DVec3::new(3.0, 4.0, 0.0) * scale).unwrap();
        let distance = line.distance(&Share::of(1.0)) / scale;
        assert!((distance - 5.0).abs() < 1e-14, "{distance}");
    }
}
