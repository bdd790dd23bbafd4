//! Solid columns against meshes: right ones, and each way to be wrong.

use oracle::{
    Column, ColumnFault, Mesh, PlanPoint, Point, check_column, check_grounded, sample_column,
    sample_volumes,
};
use proptest::prelude::*;

use crate::solids::{box_mesh, cells_mesh, gable_house, inside_out, joined, prism};

/// Where cities lie, in millimetres that no f64 holds exactly.
fn placed([x, y, z]: Point) -> Point {
    [85_012.347 + x, 447_089.113 + y, -0.731 + z]
}

/// The same, turned by some angle that no axis is parallel to.
fn turned([x, y, z]: Point) -> Point {
    placed([0.8 * x - 0.6 * y + 0.1 * x, 0.6 * x + 0.8 * y, z])
}

/// A corner of a cell, 3 m wide and high.
fn cell_corner(corner: [i32; 3]) -> Point {
    placed(corner.map(|step| 3.0 * f64::from(step)))
}

/// A column over rectangles of cells, the first one the outer ring, from level to level.
fn cell_column(rings: &[[i32; 4]], levels: [i32; 2], grounded: bool) -> Column {
    let ring = |(i, &[west, south, east, north]): (usize, &[i32; 4])| {
        let corner = |x, y| {
            let [x, y, _] = cell_corner([x, y, 0]);
            [x, y]
        };
        let mut ring = vec![
            corner(west, south),
            corner(east, south),
            corner(east, north),
            corner(west, north),
        ];
        if i > 0 {
            ring.reverse();
        }
        ring
    };
    let rings: Vec<Vec<PlanPoint>> = rings.iter().enumerate().map(ring).collect();
    let [bottom, top] = levels.map(|level| cell_corner([0, 0, level])[2]);
    Column::new(&rings, bottom, top, grounded).unwrap()
}

/// A column over a rectangle given by two corners.
fn block(low: Point, high: Point, grounded: bool) -> Column {
    let ring = vec![
        [low[0], low[1]],
        [high[0], low[1]],
        [high[0], high[1]],
        [low[0], high[1]],
    ];
    Column::new(&[ring], low[2], high[2], grounded).unwrap()
}

/// All cells of a block of cells but some.
fn cells_but(size: [i32; 3], missing: &[[i32; 3]]) -> Vec<[i32; 3]> {
    let [width, depth, height] = size;
    let all =
        (0..width * depth * height).map(|i| [i % width, i / width % depth, i / width / depth]);
    all.filter(|cell| !missing.contains(cell)).collect()
}

fn assert_right(mesh: &Mesh, column: &Column) {
    assert_eq!(check_column(mesh, column), Ok(()));
    assert_eq!(sample_column(mesh, column, 400, 1), Vec::new());
}

/// A triangle reaches in, and some sample is outside.
fn assert_reached(mesh: &Mesh, column: &Column) {
    let fault = check_column(mesh, column).unwrap_err();
    assert!(
        matches!(fault, ColumnFault::TriangleInside { .. }),
        "{fault}"
    );
    let faults = sample_column(mesh, column, 400, 1);
    assert!(
        matches!(faults[0], ColumnFault::PointOutside { .. }),
        "{faults:?}"
    );
}

/// Only the winding number shows it.
fn assert_outside(mesh: &Mesh, column: &Column, expected: i32) {
    match check_column(mesh, column) {
        Err(ColumnFault::PointOutside { winding, .. }) => assert_eq!(winding, expected),
        other => panic!("another answer: {other:?}"),
    }
    assert!(!sample_column(mesh, column, 400, 1).is_empty());
}

#[test]
fn a_box_may_fill_its_mesh_and_not_grow() {
    let (low, high) = (placed([0.0; 3]), placed([10.0, 8.0, 5.0]));
    let mesh = box_mesh(&oracle::Aabb::new(low, high));
    assert_right(&mesh, &block(low, high, true));
    for grown in [0.01, 1e-9] {
        for axis in 0..3 {
            let (mut lower, mut higher) = (low, high);
            lower[axis] -= grown;
            higher[axis] += grown;
            assert_reached(&mesh, &block(lower, high, false));
            assert_reached(&mesh, &block(low, higher, false));
        }
    }
    for axis in 0..3 {
        let mut higher = high;
        higher[axis] = high[axis].next_up();
        assert_reached(&mesh, &block(low, higher, false));
    }
}

#[test]
fn a_column_under_a_gable_may_touch_it() {
    for place in [placed, turned] {
        let mesh = gable_house(place);
        let column = |top: f64, inset: f64| {
            let corner = |x, y| {
                let [x, y, _] = place([x, y, 0.0]);
                [x, y]
            };
            let ring = vec![
                corner(2.5, inset),
                corner(7.5, inset),
                corner(7.5, 8.0 - inset),
                corner(2.5, 8.0 - inset),
            ];
            let [bottom, top] = [0.0, top].map(|z| place([0.0, 0.0, z])[2]);
            Column::new(&[ring], bottom, top, true).unwrap()
        };
        // The roof is at 6.5 m over the long sides of the footprint.
        assert_right(&mesh, &column(6.5 - 1e-9, 0.001));
        assert_reached(&mesh, &column(6.5 + 1e-9, 0.001));
        assert_reached(&mesh, &column(6.51, 0.001));
        assert_reached(&mesh, &column(6.4, -1e-9));
        assert_reached(&mesh, &column(6.4, -0.01));
    }
}

#[test]
fn a_footprint_may_be_that_of_the_mesh() {
    // No corner is rounded anew, so walls in any direction touch exactly.
    let outline: Vec<PlanPoint> = [[0.0, 0.0], [9.0, 1.0], [11.0, 6.0], [4.0, 9.0], [-1.0, 4.0]]
        .map(|[x, y]| {
            let [x, y, _] = turned([x, y, 0.0]);
            [x, y]
        })
        .to_vec();
    let mesh = prism(&outline, -0.731, 7.2);
    let column =
        |outline: &[PlanPoint]| Column::new(&[outline.to_vec()], -0.731, 7.2, true).unwrap();
    assert_right(&mesh, &column(&outline));
    let mut grown = outline.clone();
    grown[2][0] += 1e-9;
    assert_reached(&mesh, &column(&grown));
    let mut shrunk = outline;
    shrunk[2][1] -= 1e-9;
    assert_right(&mesh, &column(&shrunk));
}

#[test]
fn a_courtyard_must_be_a_hole() {
    let mesh = cells_mesh(&cells_but([4, 3, 1], &[[1, 1, 0], [3, 2, 0]]), cell_corner);
    assert_right(
        &mesh,
        &cell_column(&[[0, 0, 3, 3], [1, 1, 2, 2]], [0, 1], true),
    );
    assert_right(&mesh, &cell_column(&[[2, 0, 4, 2]], [0, 1], true));
    assert_reached(&mesh, &cell_column(&[[0, 0, 3, 3]], [0, 1], true));
    assert_reached(
        &mesh,
        &cell_column(&[[0, 0, 4, 3], [1, 1, 2, 2]], [0, 1], true),
    );
    // The courtyard itself.
    assert_outside(&mesh, &cell_column(&[[1, 1, 2, 2]], [0, 1], false), 0);
    // A hole that is a nanometre too narrow.
    let at = |x: f64, y: f64| {
        let [x, y, _] = placed([x, y, 0.0]);
        [x, y]
    };
    let outer = vec![at(0.0, 0.0), at(9.0, 0.0), at(9.0, 9.0), at(0.0, 9.0)];
    let hole = vec![
        at(3.0, 3.0),
        at(3.0, 6.0),
        at(6.0 - 1e-9, 6.0),
        at(6.0 - 1e-9, 3.0),
    ];
    let column = Column::new(&[outer, hole], -0.731, -0.731 + 3.0, false).unwrap();
    assert_reached(&mesh, &column);
}

#[test]
fn a_passage_is_no_ground() {
    // Along y through the foot of the middle cells.
    let mesh = cells_mesh(&cells_but([3, 2, 3], &[[1, 0, 0], [1, 1, 0]]), cell_corner);
    let above = |grounded| cell_column(&[[0, 0, 3, 2]], [1, 3], grounded);
    assert_right(&mesh, &above(false));
    let fault = check_column(&mesh, &above(true)).unwrap_err();
    assert!(matches!(fault, ColumnFault::NotGrounded { .. }), "{fault}");
    assert_right(&mesh, &cell_column(&[[2, 0, 3, 2]], [0, 3], true));
    // Above the foot, over nothing but solid: it may reach down.
    assert_right(&mesh, &cell_column(&[[2, 0, 3, 2]], [1, 3], true));
    assert_reached(&mesh, &cell_column(&[[0, 0, 3, 2]], [0, 3], true));
    assert_outside(&mesh, &cell_column(&[[1, 0, 2, 2]], [0, 1], true), 0);
}

#[test]
fn a_bridge_is_no_ground() {
    let deck = cells_mesh(
        &cells_but([5, 1, 2], &[[1, 0, 0], [2, 0, 0], [3, 0, 0]]),
        cell_corner,
    );
    assert_right(&deck, &cell_column(&[[0, 0, 5, 1]], [1, 2], false));
    for [west, east] in [[0, 5], [1, 4], [0, 2]] {
        let span = cell_column(&[[west, 0, east, 1]], [1, 2], true);
        let fault = check_grounded(&deck, &span).unwrap_err();
        assert!(matches!(fault, ColumnFault::NotGrounded { .. }), "{fault}");
        assert_eq!(check_column(&deck, &span), Err(fault));
    }
    let pier = cell_column(&[[4, 0, 5, 1]], [1, 2], true);
    assert_eq!(check_grounded(&deck, &pier), Ok(()));
}

#[test]
fn a_thin_floor_in_a_passage_is_no_ground() {
    // The floor is thinner than the tolerance of the foot, and 3 m of nothing are above it.
    let house = cells_mesh(&cells_but([3, 1, 2], &[[1, 0, 0]]), cell_corner);
    let [low, high] = [cell_corner([1, 0, 0]), cell_corner([2, 1, 0])];
    let floor = oracle::Aabb::new(low, [high[0], high[1], low[2] + 0.005]);
    let mesh = joined(&house, &box_mesh(&floor));
    let above = cell_column(&[[1, 0, 2, 1]], [1, 2], true);
    assert!(matches!(
        check_grounded(&mesh, &above),
        Err(ColumnFault::NotGrounded { .. })
    ));
    // A step of the foot within the tolerance is none.
    let stepped = joined(
        &box_mesh(&oracle::Aabb::new(
            placed([0.0; 3]),
            placed([5.0, 5.0, 4.0]),
        )),
        &box_mesh(&oracle::Aabb::new(
            placed([5.0, 0.0, 0.008]),
            placed([9.0, 5.0, 4.0]),
        )),
    );
    let column = |lift: f64| block(placed([5.0, 0.0, lift]), placed([9.0, 5.0, 4.0]), true);
    assert_eq!(check_column(&stepped, &column(0.008)), Ok(()));
    let higher = joined(
        &box_mesh(&oracle::Aabb::new(
            placed([0.0; 3]),
            placed([5.0, 5.0, 4.0]),
        )),
        &box_mesh(&oracle::Aabb::new(
            placed([5.0, 0.0, 0.02]),
            placed([9.0, 5.0, 4.0]),
        )),
    );
    assert!(matches!(
        check_column(&higher, &column(0.02)),
        Err(ColumnFault::NotGrounded { .. })
    ));
}

#[test]
fn a_slanting_bottom_is_no_ground() {
    // From 0 at x = 0 up to 2 m at x = 10, under a flat roof at 6 m.
    let outline = [[0.0, 0.0], [10.0, 2.0], [10.0, 6.0], [0.0, 6.0]];
    let standing = prism(&outline, -5.0, 0.0);
    let mesh = Mesh {
        vertices: standing
            .vertices
            .iter()
            .map(|&[x, z, y]| placed([x, -y, z]))
            .collect(),
        triangles: standing.triangles,
    };
    let column = block(placed([0.0, 0.0, 2.0]), placed([10.0, 5.0, 6.0]), false);
    assert_right(&mesh, &column);
    assert!(matches!(
        check_grounded(&mesh, &column),
        Err(ColumnFault::NotGrounded { .. })
    ));
    // The strip that starts within the tolerance is none of the foot either.
    let strip = block(placed([0.0, 0.0, 0.009]), placed([0.01, 5.0, 6.0]), true);
    assert!(matches!(
        check_column(&mesh, &strip),
        Err(ColumnFault::NotGrounded { .. })
    ));
}

#[test]
fn ground_needs_a_solid_above_it() {
    let mesh = cells_mesh(&cells_but([2, 1, 1], &[]), cell_corner);
    let beside = cell_column(&[[3, 0, 4, 1]], [0, 1], true);
    assert!(matches!(
        check_grounded(&mesh, &beside),
        Err(ColumnFault::PointOutside { winding: 0, .. })
    ));
}

#[test]
fn a_cavity_is_outside() {
    let hollow = cells_mesh(&cells_but([3, 3, 3], &[[1, 1, 1]]), cell_corner);
    assert_outside(&hollow, &cell_column(&[[1, 1, 2, 2]], [1, 2], false), 0);
    assert_reached(&hollow, &cell_column(&[[0, 0, 3, 3]], [0, 3], false));
    assert_right(
        &hollow,
        &cell_column(&[[0, 0, 3, 3], [1, 1, 2, 2]], [0, 3], true),
    );
    assert_right(&hollow, &cell_column(&[[0, 0, 3, 3]], [2, 3], false));
    // Over the cavity nothing is grounded.
    assert!(check_grounded(&hollow, &cell_column(&[[0, 0, 3, 3]], [2, 3], true)).is_err());
}

#[test]
fn an_inside_out_or_open_mesh_has_no_inside() {
    let mesh = cells_mesh(&cells_but([2, 2, 1], &[]), cell_corner);
    let column = cell_column(&[[0, 0, 2, 2]], [0, 1], true);
    assert_right(&mesh, &column);
    assert_outside(&inside_out(&mesh), &column, -1);
    let mut open = mesh;
    open.triangles.pop();
    assert_eq!(check_column(&open, &column), Err(ColumnFault::OpenMesh));
    assert_eq!(check_grounded(&open, &column), Err(ColumnFault::OpenMesh));
    assert_eq!(sample_column(&open, &column, 9, 1), [ColumnFault::OpenMesh]);
    assert_eq!(sample_volumes(&open, &[column], 9, 1), None);
}

#[test]
fn columns_keep_to_one_shell() {
    let shell = |from: f64, to: f64| {
        box_mesh(&oracle::Aabb::new(
            placed([from, 0.0, 0.0]),
            placed([to, 5.0, 5.0]),
        ))
    };
    let column = |from: f64, to: f64| block(placed([from, 0.0, 0.0]), placed([to, 5.0, 5.0]), true);
    let is_reached = |mesh: &Mesh, column: &Column| {
        matches!(
            check_column(mesh, column),
            Err(ColumnFault::TriangleInside { .. })
        )
    };
    let touching = joined(&shell(0.0, 4.0), &shell(4.0, 9.0));
    assert_right(&touching, &column(0.0, 4.0));
    assert_right(&touching, &column(4.0, 9.0));
    // A wall within the solid keeps a column from being taken as one piece; no point is outside.
    assert!(is_reached(&touching, &column(0.0, 9.0)));
    assert!(sample_column(&touching, &column(0.0, 9.0), 400, 1).is_empty());
    let overlapping = joined(&shell(0.0, 5.0), &shell(4.0, 9.0));
    assert_right(&overlapping, &column(4.0, 5.0));
    assert_right(&overlapping, &column(0.0, 4.0));
    assert!(is_reached(&overlapping, &column(0.0, 5.0)));
    let apart = joined(&shell(0.0, 4.0), &shell(4.0 + 1e-9, 9.0));
    assert!(is_reached(&apart, &column(0.0, 4.0 + 1e-9)));
}

#[test]
fn each_piece_of_a_footprint_counts() {
    // The hole touches the outer ring on the left and on the right: two pieces.
    let outer = vec![[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
    let hole = vec![[0.0, 2.0], [2.0, 3.0], [4.0, 2.0], [2.0, 1.0]];
    let column = Column::new(&[outer, hole], 0.0, 3.0, true).unwrap();
    let south = [[2.0, 1.0], [0.0, 2.0], [0.0, 0.0], [4.0, 0.0], [4.0, 2.0]];
    let north = [[2.0, 3.0], [4.0, 2.0], [4.0, 4.0], [0.0, 4.0], [0.0, 2.0]];
    let [south, north] = [south, north].map(|outline| prism(&outline, 0.0, 3.0));
    assert_right(&joined(&south, &north), &column);
    assert_outside(&south, &column, 0);
    assert_outside(&north, &column, 0);
    assert_outside(&joined(&inside_out(&south), &north), &column, -1);
}

#[test]
fn shares_are_those_of_the_volumes() {
    let gable = gable_house(placed);
    let below_eaves = block(placed([0.0; 3]), placed([10.0, 8.0, 5.0]), true);
    let upper_half = block(placed([0.0, 0.0, 2.5]), placed([10.0, 8.0, 5.0]), false);
    let columns = [below_eaves, upper_half];
    let volumes = sample_volumes(&gable, &columns, 30_000, 7).unwrap();
    assert!((volumes.solid - 520.0).abs() < 5.0, "{volumes:?}");
    assert!((volumes.in_columns - 400.0).abs() < 4.0, "{volumes:?}");
    assert_eq!(sample_volumes(&gable, &columns, 30_000, 7), Some(volumes));
    // What two shells share counts once, what a column holds outside not at all.
    let shell = |from: f64, to: f64| box_mesh(&oracle::Aabb::new([from, 0.0, 0.0], [to, 4.0, 4.0]));
    let both = joined(&shell(0.0, 6.0), &shell(4.0, 10.0));
    let column = block([-9.0; 3], [5.0, 9.0, 9.0], false);
    let volumes = sample_volumes(&both, &[column], 30_000, 7).unwrap();
    assert!((volumes.solid - 160.0).abs() < 1e-6, "{volumes:?}");
    assert!((volumes.in_columns - 80.0).abs() < 1.0, "{volumes:?}");
}

/// Footprints on a grid: an L, a ring, a rectangle.
fn footprints() -> impl Strategy<Value = Vec<Vec<[i32; 2]>>> {
    let l = vec![[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]];
    let outer = vec![[0, 0], [3, 0], [3, 3], [0, 3]];
    let hole = vec![[1, 1], [1, 2], [2, 2], [2, 1]];
    prop_oneof![
        Just(vec![l]),
        Just(vec![outer, hole]),
        (1..4i32, 1..4i32).prop_map(|(w, d)| vec![vec![[0, 0], [w, 0], [w, d], [0, d]]]),
    ]
}

/// The cells of the same footprints, by the even-odd rule along x.
fn covered(rings: &[Vec<[i32; 2]>], [x, y]: [i32; 2]) -> bool {
    let edges = rings
        .iter()
        .flat_map(|ring| (0..ring.len()).map(move |i| (ring[i], ring[(i + 1) % ring.len()])));
    let crossings = edges.filter(|(u, v)| (u[1] <= y) != (v[1] <= y) && u[0] > x);
    crossings.count() % 2 == 1
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]
    /// A column over whole cells is right exactly when all its cells are solid, and grounded
    /// exactly when all below them, down to the lowest cell, are too.
    #[test]
    fn columns_of_cells(
        solid in proptest::collection::vec(prop::bool::weighted(0.8), 36),
        rings in footprints(),
        shift in [-1..3i32, -1..3],
        [bottom, height] in [0..3i32, 1..4],
        turn in 0..3usize,
        grounded in any::<bool>(),
    ) {
        let all = cells_but([4, 3, 3], &[]);
        let cells: Vec<[i32; 3]> = all
            .into_iter()
            .zip(&solid)
            .filter_map(|(cell, is_solid)| is_solid.then_some(cell))
            .collect();
        prop_assume!(!cells.is_empty());
        // Turned and sheared by whole numbers, so that nothing is rounded.
        let [a, b, c, d] = [[1.0, 0.0, 0.0, 1.0], [3.0, -1.0, 2.0, 5.0], [0.0, -2.0, 2.0, 1.0]][turn];
        let place = |[x, y, z]: [i32; 3]| {
            let [x, y, z] = [x, y, z].map(f64::from);
            [85_000.0 + a * x + b * y, 447_000.0 + c * x + d * y, z]
        };
        let mesh = cells_mesh(&cells, place);
        prop_assert!(mesh.is_closed());
        let corner = |&[x, y]: &[i32; 2]| {
            let [x, y, _] = place([x + shift[0], y + shift[1], 0]);
            [x, y]
        };
        let corners: Vec<Vec<PlanPoint>> =
            rings.iter().map(|ring| ring.iter().map(corner).collect()).collect();
        let top = bottom + height;
        let column = Column::new(&corners, f64::from(bottom), f64::from(top), grounded).unwrap();
        let foot = cells.iter().map(|cell| cell[2]).min().unwrap();
        let is_solid_from = |lowest: i32| {
            let plan = (-2..8).flat_map(|x| (-2..8).map(move |y| [x, y]));
            plan.filter(|[x, y]| covered(&rings, [x - shift[0], y - shift[1]]))
                .all(|[x, y]| (lowest..top).all(|z| cells.contains(&[x, y, z])))
        };
        let expected = is_solid_from(bottom) && (!grounded || is_solid_from(foot.min(bottom)));
        let answer = check_column(&mesh, &column);
        prop_assert_eq!(answer.is_ok(), expected, "{:?}", answer);
        if top > foot {
            prop_assert_eq!(check_grounded(&mesh, &column).is_ok(), is_solid_from(foot));
        }
        let faults = sample_column(&mesh, &column, 200, 3);
        prop_assert!(faults.is_empty() || !is_solid_from(bottom), "{:?}", faults);
    }
}
