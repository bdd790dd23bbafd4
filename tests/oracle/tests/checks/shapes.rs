//! The shapes of columns and prisms, right ones and each way to be wrong.

use oracle::{Column, MAX_CORNERS, PlanPoint, Prism, ShapeFault};

const SQUARE: [PlanPoint; 4] = [[0.0, 0.0], [8.0, 0.0], [8.0, 8.0], [0.0, 8.0]];

fn shape(rings: &[&[PlanPoint]]) -> Result<Column, ShapeFault> {
    let rings: Vec<Vec<PlanPoint>> = rings.iter().map(|ring| ring.to_vec()).collect();
    Column::new(&rings, 0.0, 3.0, false)
}

/// A clockwise square with its lower left corner there.
fn hole(x: f64, y: f64, side: f64) -> [PlanPoint; 4] {
    [[x, y], [x, y + side], [x + side, y + side], [x + side, y]]
}

#[test]
fn rings_may_touch_in_points() {
    let diamond = [[0.0, 4.0], [4.0, 8.0], [8.0, 4.0], [4.0, 0.0]];
    let good: [&[&[PlanPoint]]; 6] = [
        &[&SQUARE],
        &[&SQUARE, &hole(1.0, 1.0, 2.0)],
        &[&SQUARE, &hole(1.0, 1.0, 2.0), &hole(3.0, 3.0, 2.0)],
        &[&SQUARE, &diamond],
        &[&SQUARE, &[[0.0, 0.0], [2.0, 4.0], [4.0, 2.0]]],
        // Corners on straight sides.
        &[&[
            [0.0, 0.0],
            [4.0, 0.0],
            [8.0, 0.0],
            [8.0, 8.0],
            [4.0, 8.0],
            [0.0, 8.0],
        ]],
    ];
    for rings in good {
        assert!(shape(rings).is_ok(), "{rings:?}");
    }
}

#[test]
fn rings_that_meet_themselves_are_refused() {
    let bad: [&[PlanPoint]; 7] = [
        // A bow tie, a spike, a spike at the first corner, an edge there and back.
        &[[0.0, 0.0], [8.0, 8.0], [8.0, 0.0], [0.0, 8.0]],
        &[
            [0.0, 0.0],
            [8.0, 0.0],
            [8.0, 8.0],
            [8.0, 9.0],
            [8.0, 8.0],
            [0.0, 8.0],
        ],
        &[[0.0, -2.0], [0.0, 0.0], [8.0, 0.0], [8.0, 8.0], [0.0, 8.0]],
        &[[0.0, 0.0], [8.0, 0.0], [4.0, 0.0]],
        // A corner twice in a row, a corner met again, a corner on another edge.
        &[[0.0, 0.0], [8.0, 0.0], [8.0, 0.0], [0.0, 8.0]],
        &[
            [0.0, 0.0],
            [4.0, 0.0],
            [4.0, 4.0],
            [8.0, 4.0],
            [4.0, 8.0],
            [4.0, 4.0],
            [0.0, 4.0],
        ],
        &[[0.0, 0.0], [8.0, 0.0], [8.0, 8.0], [4.0, 0.0], [0.0, 8.0]],
    ];
    for ring in bad {
        let fault = shape(&[ring]).unwrap_err();
        assert!(
            matches!(fault, ShapeFault::NotSimple { ring: 0, .. }),
            "{ring:?}: {fault}"
        );
    }
}

#[test]
fn holes_must_lie_inside_and_apart() {
    let outside: [&[PlanPoint]; 5] = [
        &hole(9.0, 9.0, 2.0),
        &hole(7.0, 7.0, 2.0),
        // Along a side, around the whole, a nanometre out.
        &hole(0.0, 1.0, 2.0),
        &hole(-1.0, -1.0, 20.0),
        &hole(6.0, 1.0, 2.0 + 1e-9),
    ];
    for ring in outside {
        let fault = shape(&[&SQUARE, ring]).unwrap_err();
        assert!(
            matches!(fault, ShapeFault::HoleOutside { ring: 1, .. }),
            "{ring:?}: {fault}"
        );
    }
    let first = hole(1.0, 1.0, 4.0);
    let overlapping = [
        hole(2.0, 2.0, 1.0),
        hole(4.0, 4.0, 2.0),
        hole(5.0, 1.0, 1.0),
        first,
    ];
    for ring in overlapping {
        for rings in [[&SQUARE, &first, &ring], [&SQUARE, &ring, &first]] {
            let fault = shape(&rings.map(|ring| ring.as_slice())).unwrap_err();
            assert!(
                matches!(fault, ShapeFault::HolesOverlap { .. }),
                "{ring:?}: {fault}"
            );
        }
    }
}

#[test]
fn what_is_no_ring_is_refused() {
    let mut clockwise = SQUARE;
    clockwise.reverse();
    assert_eq!(shape(&[&clockwise]), Err(ShapeFault::WrongTurn { ring: 0 }));
    let mut anticlockwise = hole(1.0, 1.0, 2.0);
    anticlockwise.reverse();
    let fault = shape(&[&SQUARE, &anticlockwise]);
    assert_eq!(fault, Err(ShapeFault::WrongTurn { ring: 1 }));
    let fault = shape(&[]);
    assert_eq!(
        fault,
        Err(ShapeFault::TooFewCorners {
            ring: 0,
            corners: 0
        })
    );
    let fault = shape(&[&SQUARE, &SQUARE[..2]]);
    assert_eq!(
        fault,
        Err(ShapeFault::TooFewCorners {
            ring: 1,
            corners: 2
        })
    );
    for corner in [[f64::NAN, 1.0], [1.0, f64::INFINITY], [1e101, 0.0]] {
        let fault = shape(&[&[[0.0, 0.0], [8.0, 0.0], corner]]).unwrap_err();
        assert!(
            matches!(fault, ShapeFault::BadCorner { ring: 0, .. }),
            "{fault}"
        );
    }
    let many = vec![[0.0, 0.0]; MAX_CORNERS + 1];
    let fault = shape(&[&many]);
    assert_eq!(
        fault,
        Err(ShapeFault::TooManyCorners {
            corners: MAX_CORNERS + 1
        })
    );
    assert_eq!(
        fault.unwrap_err().to_string(),
        "the footprint has 4097 corners, more than 4096"
    );
}

#[test]
fn heights_must_be_in_order() {
    for (bottom, top) in [
        (3.0, 3.0),
        (3.0, 0.0),
        (f64::NEG_INFINITY, 3.0),
        (0.0, f64::NAN),
    ] {
        let fault = Column::new(&[SQUARE.to_vec()], bottom, top, true).unwrap_err();
        assert!(matches!(fault, ShapeFault::NoHeight { .. }), "{fault}");
        let fault = Prism::new(&SQUARE, bottom, top, true).unwrap_err();
        assert!(matches!(fault, ShapeFault::NoHeight { .. }), "{fault}");
    }
}

#[test]
fn prisms_must_be_convex() {
    let bad: [&[PlanPoint]; 6] = [
        &[[0.0, 0.0], [8.0, 0.0], [4.0, 1e-300], [0.0, 8.0]],
        &[[0.0, 0.0], [0.0, 8.0], [8.0, 8.0], [8.0, 0.0]],
        &[[0.0, 0.0], [4.0, 4.0], [8.0, 8.0]],
        &[[0.0, 0.0], [8.0, 0.0], [8.0, 0.0], [0.0, 8.0]],
        &[
            [0.0, 0.0],
            [8.0, 0.0],
            [8.0, 8.0],
            [4.0, 4.0 - 1e-9],
            [0.0, 8.0],
        ],
        // A star.
        &[[0.0, 6.0], [8.0, 6.0], [1.0, 0.0], [4.0, 9.0], [7.0, 0.0]],
    ];
    for corners in bad {
        let fault = Prism::new(corners, 0.0, 1.0, false).unwrap_err();
        assert!(
            matches!(fault, ShapeFault::NotConvex { .. }),
            "{corners:?}: {fault}"
        );
    }
    let straight = [[0.0, 0.0], [4.0, 0.0], [8.0, 0.0], [0.0, 8.0]];
    assert!(Prism::new(&straight, 0.0, 1.0, false).is_ok());
    let fault = Prism::new(&SQUARE[..2], 0.0, 1.0, false).unwrap_err();
    assert!(matches!(fault, ShapeFault::TooFewCorners { .. }), "{fault}");
}
