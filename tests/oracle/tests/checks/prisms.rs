//! Convex prisms as pieces of columns and as occluders, and what columns hide together.

use oracle::{
    Aabb, Column, ColumnIndex, PieceFault, PlanPoint, Point, Prism, VolumeFault,
    check_piece_in_column, check_volume, segment_meets_interior,
};
use proptest::prelude::*;

const AT: PlanPoint = [85_012.347, 447_089.113];

/// Corners relative to a place in a city.
fn at(corners: &[PlanPoint]) -> Vec<PlanPoint> {
    let moved = corners.iter().map(|[x, y]| [AT[0] + x, AT[1] + y]);
    moved.collect()
}

fn rectangle(west: f64, south: f64, east: f64, north: f64) -> Vec<PlanPoint> {
    at(&[[west, south], [east, south], [east, north], [west, north]])
}

fn piece(corners: &[PlanPoint], bottom: f64, top: f64, grounded: bool) -> Prism {
    Prism::new(corners, bottom, top, grounded).unwrap()
}

/// A square of 12 m around a courtyard of 4 m.
fn courtyard(grounded: bool) -> Column {
    let mut hole = rectangle(4.0, 4.0, 8.0, 8.0);
    hole.reverse();
    Column::new(&[rectangle(0.0, 0.0, 12.0, 12.0), hole], 0.0, 9.0, grounded).unwrap()
}

#[test]
fn pieces_may_touch_what_holds_them() {
    let columns = [courtyard(false)];
    let held = [
        rectangle(0.0, 0.0, 12.0, 4.0),
        rectangle(0.0, 0.0, 4.0, 12.0),
        rectangle(8.0, 4.0, 12.0, 8.0),
        at(&[[0.0, 0.0], [8.0, 0.0], [0.0, 8.0]]),
        at(&[[4.0, 0.0], [12.0, 0.0], [12.0, 8.0]]),
    ];
    for corners in held {
        let prism = piece(&corners, 0.0, 9.0, false);
        assert_eq!(check_piece_in_column(&prism, &columns), Ok(0));
    }
}

#[test]
fn pieces_that_leave_are_found() {
    let columns = [courtyard(false)];
    let outside = [
        rectangle(0.0, 0.0, 12.0, 4.0 + 1e-9),
        rectangle(-1e-9, 0.0, 12.0, 4.0),
        rectangle(-1.0, -1.0, 13.0, 13.0),
        rectangle(0.0, 0.0, 12.0, 12.0),
        rectangle(4.0, 4.0, 8.0, 8.0),
        rectangle(5.0, 5.0, 6.0, 6.0),
        rectangle(20.0, 0.0, 24.0, 4.0),
        at(&[[0.0, 0.0], [8.0 + 1e-9, 0.0], [0.0, 8.0 + 1e-9]]),
    ];
    for corners in &outside {
        let prism = piece(corners, 0.0, 9.0, false);
        let fault = check_piece_in_column(&prism, &columns).unwrap_err();
        assert!(
            matches!(fault, PieceFault::InNoColumn { columns: 1, .. }),
            "{fault}"
        );
    }
    let inside = rectangle(1.0, 1.0, 3.0, 9.0);
    for (bottom, top) in [(-1e-9, 9.0), (0.0, 9.0 + 1e-9)] {
        assert!(check_piece_in_column(&piece(&inside, bottom, top, false), &columns).is_err());
    }
    assert!(check_piece_in_column(&piece(&inside, 0.0, 9.0, false), &[]).is_err());
}

#[test]
fn a_piece_is_grounded_by_its_column() {
    let corners = rectangle(1.0, 1.0, 3.0, 9.0);
    let floating = Column::new(&[rectangle(0.0, 0.0, 4.0, 9.0)], 0.0, 9.0, false).unwrap();
    let columns = [floating, courtyard(true)];
    assert_eq!(
        check_piece_in_column(&piece(&corners, 0.0, 9.0, false), &columns),
        Ok(0)
    );
    assert_eq!(
        check_piece_in_column(&piece(&corners, 0.0, 9.0, true), &columns),
        Ok(1)
    );
    assert_eq!(
        check_piece_in_column(&piece(&corners, -5.0, 9.0, false), &columns),
        Ok(1)
    );
    assert_eq!(
        check_piece_in_column(&piece(&corners, 0.0, 9.0, true), &columns[..1]),
        Err(PieceFault::NotGrounded { column: 0 })
    );
}

#[test]
fn one_prism_must_hide_alone() {
    let box_at = |low: Point, high: Point| {
        let moved = |[x, y, z]: Point| [AT[0] + x, AT[1] + y, z];
        Aabb::new(moved(low), moved(high))
    };
    let volume = box_at([8.0, -6.0, 1.5], [12.0, -4.0, 2.0]);
    let occludee = box_at([8.0, 20.0, 0.0], [12.0, 24.0, 6.0]);
    let whole = piece(&rectangle(0.0, 0.0, 20.0, 10.0), 0.0, 12.0, true);
    let halves = [
        piece(&rectangle(0.0, 0.0, 10.0, 10.0), 0.0, 12.0, true),
        piece(&rectangle(10.0, 0.0, 20.0, 10.0), 0.0, 12.0, true),
    ];
    assert_eq!(
        check_volume(&volume, std::slice::from_ref(&whole), &occludee),
        Ok(())
    );
    let fault = check_volume(&volume, &halves, &occludee).unwrap_err();
    let VolumeFault::SegmentMisses {
        met,
        volume_corner,
        occludee_corner,
        ..
    } = fault
    else {
        panic!("another fault: {fault}");
    };
    assert!(0 < met && met < 64, "{fault}");
    assert!(
        halves
            .iter()
            .any(|half| { segment_meets_interior(volume_corner, occludee_corner, half) })
    );
    let [left, right] = halves;
    assert_eq!(
        check_volume(&volume, &[left, whole, right], &occludee),
        Ok(())
    );
}

#[test]
fn a_turned_prism_hides_to_its_edge() {
    // A wall across y = x + 10, seen along y = -x: what it hides ends where its end does.
    let wall = at(&[[-10.0, 0.0], [-9.0, -1.0], [11.0, 19.0], [10.0, 20.0]]);
    let prism = [piece(&wall, 0.0, 30.0, true)];
    let flat = |[x, y]: PlanPoint, z: f64| {
        let corner = [AT[0] + x, AT[1] + y, z];
        Aabb::new(corner, corner)
    };
    let eye = flat([10.0, -1.0], 1.7);
    let hides = |end: PlanPoint| check_volume(&eye, &prism, &flat(end, 5.0)).is_ok();
    assert!(hides([-5.0, 14.0]));
    // The sight past the end at (11, 19), along x = 10 + (y + 1) / 20.
    assert!(hides([10.0 + 21.0 / 20.0 - 0.1, 20.0]));
    assert!(hides([10.0 + 41.0 / 20.0 - 1e-6, 40.0]));
    assert!(!hides([10.0 + 41.0 / 20.0 + 1e-6, 40.0]));
}

#[test]
fn columns_hide_together() {
    let street: Vec<(u32, Column)> = (0..4u8)
        .map(|i| {
            let west = 10.0 * f64::from(i);
            let ring = rectangle(west, 0.0, west + 10.0, 8.0);
            (u32::from(i), Column::new(&[ring], 0.0, 9.0, true).unwrap())
        })
        .chain([(9, courtyard(true))])
        .collect();
    let index = ColumnIndex::new(&street);
    let point = |x: f64, y: f64, z: f64| [AT[0] + x, AT[1] + y, z];
    let hiding = |eye: Point, target: Point, feature| index.hiding(eye, target, feature);
    assert_eq!(
        hiding(point(35.0, -5.0, 1.7), point(36.0, 30.0, 1.0), 7),
        Some(3)
    );
    // The ground hides too, a feature never itself, and touching never.
    assert_eq!(
        hiding(point(35.0, -5.0, -3.0), point(36.0, 30.0, -3.0), 7),
        Some(3)
    );
    assert_eq!(
        hiding(point(35.0, -5.0, 1.7), point(36.0, 30.0, 1.0), 3),
        None
    );
    assert_eq!(
        hiding(point(25.0, -5.0, 1.7), point(25.0, 0.0, 1.0), 7),
        None
    );
    assert_eq!(
        hiding(point(45.0, -5.0, 1.7), point(40.0, 20.0, 1.0), 7),
        None
    );
    // Along the wall between two houses, which touch.
    assert_eq!(
        hiding(point(30.0, -5.0, 1.7), point(30.0, 30.0, 1.0), 7),
        None
    );
    // An eye inside is hidden from nothing by what holds it.
    assert_eq!(
        hiding(point(35.0, 4.0, 1.7), point(36.0, 30.0, 1.0), 7),
        None
    );
    assert_eq!(hiding([f64::NAN; 3], point(36.0, 30.0, 1.0), 7), None);
    // Inside a courtyard nothing hides but what is around it.
    let alone = ColumnIndex::new(&street[4..]);
    assert_eq!(
        alone.hiding(point(5.0, 5.0, 1.7), point(7.0, 7.0, 1.0), 7),
        None
    );
    assert_eq!(
        alone.hiding(point(5.0, 5.0, 1.7), point(7.0, 9.0, 1.0), 7),
        Some(9)
    );
    assert_eq!(
        alone.hiding(point(5.0, 5.0, 1.7), point(5.0, 30.0, 200.0), 7),
        None
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]
    #[test]
    fn the_index_finds_what_all_columns_find(
        houses in proptest::collection::vec(([0..12i32, 0..12], [1..5i32, 1..5, 1..5], any::<bool>()), 1..30),
        ends in proptest::collection::vec([0..34i32, 0..34, -2..12], 20),
    ) {
        let columns: Vec<(u32, Column)> = (0..)
            .zip(&houses)
            .map(|(id, ([x, y], size, grounded))| {
                let ([x, y], [w, d, h]) = ([x, y].map(|x| f64::from(*x)), size.map(f64::from));
                // Turned, so that sides are not parallel to axes.
                let corners = [[x, y], [x + w, y], [x + w, y + d], [x, y + d]];
                let ring = corners.map(|[x, y]| [x + 0.5 * y, y]).to_vec();
                (id, Column::new(&[ring], 1.0, 1.0 + h, *grounded).unwrap())
            })
            .collect();
        let index = ColumnIndex::new(&columns);
        let ends: Vec<Point> =
            ends.iter().map(|end| end.map(|step| 0.5 * f64::from(step))).collect();
        for pair in ends.chunks_exact(2) {
            let alone = |column: &(u32, Column)| {
                ColumnIndex::new(std::slice::from_ref(column)).hiding(pair[0], pair[1], 3)
            };
            let expected = columns.iter().any(|column| alone(column).is_some());
            let found = index.hiding(pair[0], pair[1], 3);
            prop_assert_eq!(found.is_some(), expected);
            if let Some(id) = found {
                prop_assert!(alone(&columns[id as usize]).is_some());
            }
        }
    }

    /// The answer for points of the piece: none of them is outside the column.
    #[test]
    fn held_pieces_hold_no_other_point(
        corners in proptest::array::uniform3([0..13i32, 0..13]),
        weights in proptest::collection::vec((0.0..1.0, 0.0..1.0), 20),
    ) {
        let corners = corners.map(|corner| corner.map(f64::from));
        let Ok(prism) = Prism::new(&corners, 0.0, 9.0, false) else {
            return Ok(());
        };
        let hole = vec![[4.0, 4.0], [4.0, 8.0], [8.0, 8.0], [8.0, 4.0]];
        let outer = vec![[0.0, 0.0], [12.0, 0.0], [12.0, 12.0], [0.0, 12.0]];
        let column = Column::new(&[outer, hole], 0.0, 9.0, false).unwrap();
        let is_held = check_piece_in_column(&prism, &[column]).is_ok();
        let is_outside = |[x, y]: PlanPoint| {
            let in_hole = 4.0 < x && x < 8.0 && 4.0 < y && y < 8.0;
            in_hole || x > 12.0 || y > 12.0
        };
        let strays = weights.iter().any(|(s, t)| {
            let [s, t] = if s + t > 1.0 { [1.0 - s, 1.0 - t] } else { [*s, *t] };
            let [a, b, c] = corners;
            is_outside([0, 1].map(|i| a[i] + s * (b[i] - a[i]) + t * (c[i] - a[i])))
        });
        prop_assert!(!(is_held && strays));
        // A triangle keeps out of the square hole exactly when a line along a side of either does.
        let sides = |axis: usize| {
            corners.iter().all(|c| c[axis] <= 4.0) || corners.iter().all(|c| c[axis] >= 8.0)
        };
        let past = |u: PlanPoint, v: PlanPoint| {
            [[4.0, 4.0], [8.0, 4.0], [8.0, 8.0], [4.0, 8.0]].iter().all(|p| {
                (v[0] - u[0]) * (p[1] - u[1]) - (v[1] - u[1]) * (p[0] - u[0]) <= 0.0
            })
        };
        let [a, b, c] = corners;
        let apart = sides(0) || sides(1) || past(a, b) || past(b, c) || past(c, a);
        let is_within = corners.iter().flatten().all(|x| *x <= 12.0);
        prop_assert_eq!(is_held, apart && is_within);
    }
}
