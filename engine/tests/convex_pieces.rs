//! Convex pieces of known and of random columns, against exact arithmetic in integers.

use std::f64::consts::TAU;

use engine::{ConvexPieceOptions, ConvexPrism, SolidColumn, convex_pieces};
use geo::{LineString, Polygon};
use glam::DVec2;
use proptest::prelude::*;

/// Far from the origin, as in national grids.
const FAR: DVec2 = DVec2::new(85_000.0, 447_000.0);

/// Corners that are not the column's own lie at most this far inside, metres.
const INSIDE: f64 = 1e-4;

fn line(ring: &[[f64; 2]]) -> LineString<f64> {
    ring.iter().map(|v| [v[0] + FAR.x, v[1] + FAR.y]).collect()
}

fn column(outer: &[[f64; 2]], holes: &[&[[f64; 2]]], top: f64) -> SolidColumn {
    SolidColumn {
        footprint: Polygon::new(line(outer), holes.iter().map(|hole| line(hole)).collect()),
        bottom: 0.0,
        top,
        grounded: true,
    }
}

fn pieces(columns: &[SolidColumn]) -> Vec<ConvexPrism> {
    let all = ConvexPieceOptions {
        most: 20,
        least_share: 1e-5,
    };
    convex_pieces(columns, &all)
}

fn has_rectangle(pieces: &[ConvexPrism], min: [f64; 2], max: [f64; 2]) -> bool {
    let (min, max) = (DVec2::from(min) + FAR, DVec2::from(max) + FAR);
    pieces.iter().any(|piece| {
        let bounds = piece.envelope();
        piece.footprint().len() == 4
            && bounds.min.truncate().distance(min) < INSIDE
            && bounds.max.truncate().distance(max) < INSIDE
    })
}

/// Signs of orientations in integers: all coordinates here are multiples of 2⁻³⁶, since they are
/// above 2¹⁶, and below 2²⁰, so that products of differences fit into 128 bits.
fn turn(a: DVec2, b: DVec2, c: DVec2) -> i128 {
    let whole = |x: f64| {
        let scaled = x * 2.0_f64.powi(36);
        assert_eq!(scaled, scaled.trunc(), "{x} is not on the grid");
        scaled as i128
    };
    let [a, b, c] = [a, b, c].map(|p| [whole(p.x), whole(p.y)]);
    ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).signum()
}

fn edges(ring: &[DVec2]) -> Vec<[DVec2; 2]> {
    (0..ring.len())
        .map(|i| [ring[i], ring[(i + 1) % ring.len()]])
        .collect()
}

/// Whether a piece lies in a simple polygon: none of its sides crosses an edge, no vertex is
/// within it, and it is not outside as a whole.
fn is_inside(piece: &[DVec2], rings: &[Vec<DVec2>]) -> bool {
    let border: Vec<[DVec2; 2]> = rings.iter().flat_map(|ring| edges(ring)).collect();
    let crosses = |[a, b]: [DVec2; 2], [c, d]: [DVec2; 2]| {
        turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0
    };
    let sides = edges(piece);
    let no_crossing = sides
        .iter()
        .all(|&s| border.iter().all(|&edge| !crosses(s, edge)));
    let within = |v: DVec2| sides.iter().all(|&[a, b]| turn(a, b, v) > 0);
    let none_within = rings.iter().flatten().all(|&v| !within(v));
    let middle = piece.iter().sum::<DVec2>() / piece.len() as f64;
    let crossed = border.iter().filter(|[a, b]| {
        let [low, high] = if a.y < b.y { [a, b] } else { [b, a] };
        low.y <= middle.y && middle.y < high.y && turn(*low, *high, middle) > 0
    });
    no_crossing && none_within && within(middle) && crossed.count() % 2 == 1
}

fn rings(column: &SolidColumn) -> Vec<Vec<DVec2>> {
    let all = std::iter::once(column.footprint.exterior()).chain(column.footprint.interiors());
    all.map(|ring| {
        ring.coords()
            .skip(1)
            .map(|c| DVec2::new(c.x, c.y))
            .collect()
    })
    .collect()
}

#[test]
fn a_convex_column_is_its_own_piece_bit_for_bit() {
    let hexagon: Vec<[f64; 2]> = (0..6)
        .map(|i| (DVec2::from_angle(f64::from(i) * TAU / 6.0) * 10.0).to_array())
        .collect();
    let column = column(&hexagon, &[], 9.0);
    let found = pieces(std::slice::from_ref(&column));
    assert_eq!(found.len(), 1);
    assert_eq!(
        (found[0].bottom(), found[0].top(), found[0].grounded()),
        (0.0, 9.0, true)
    );
    let mut corners = found[0].footprint().to_vec();
    let mut vertices = rings(&column).remove(0);
    let by_bits = |a: &DVec2, b: &DVec2| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y));
    corners.sort_by(by_bits);
    vertices.sort_by(by_bits);
    assert_eq!(corners, vertices);
}

#[test]
fn an_l_gives_two_overlapping_rectangles_and_a_courtyard_four() {
    let l = [
        [0.0, 0.0],
        [20.0, 0.0],
        [20.0, 8.0],
        [6.0, 8.0],
        [6.0, 30.0],
        [0.0, 30.0],
    ];
    let found = pieces(&[column(&l, &[], 10.0)]);
    assert_eq!(found.len(), 2);
    assert!(has_rectangle(&found, [0.0, 0.0], [20.0, 8.0]), "{found:?}");
    assert!(has_rectangle(&found, [0.0, 0.0], [6.0, 30.0]), "{found:?}");
    let block = [[0.0, 0.0], [50.0, 0.0], [50.0, 40.0], [0.0, 40.0]];
    let yard = [[10.0, 10.0], [10.0, 30.0], [40.0, 30.0], [40.0, 10.0]];
    let found = pieces(&[column(&block, &[&yard], 10.0)]);
    for (min, max) in [
        ([0.0, 0.0], [50.0, 10.0]),
        ([0.0, 30.0], [50.0, 40.0]),
        ([0.0, 0.0], [10.0, 40.0]),
        ([40.0, 0.0], [50.0, 40.0]),
    ] {
        assert!(has_rectangle(&found, min, max), "{found:?}");
    }
}

#[test]
fn low_wide_and_high_narrow_columns_both_count_and_repetitions_do_not() {
    let wide = [[0.0, 0.0], [30.0, 0.0], [30.0, 20.0], [0.0, 20.0]];
    let tower = [[5.0, 5.0], [10.0, 5.0], [10.0, 10.0], [5.0, 10.0]];
    let columns = [
        column(&tower, &[], 3.0),
        column(&wide, &[], 6.0),
        column(&tower, &[], 25.0),
        column(&wide, &[], 6.0),
    ];
    let found = pieces(&columns);
    let tops: Vec<f64> = found.iter().map(ConvexPrism::top).collect();
    assert_eq!(tops, [6.0, 25.0]);
    let one = ConvexPieceOptions {
        most: 1,
        least_share: 0.0,
    };
    assert_eq!(convex_pieces(&columns, &one), found[..1]);
    let large = ConvexPieceOptions {
        most: 6,
        least_share: 0.9,
    };
    assert_eq!(convex_pieces(&columns, &large).len(), 1);
}

#[test]
fn nonsense_has_no_pieces() {
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let bow_tie = [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
    let gap = [[0.0, 0.0], [f64::NAN, 0.0], [1.0, 1.0]];
    for outer in [&square[..0], &square[..1], &square[..2], &bow_tie, &gap] {
        assert_eq!(pieces(&[column(outer, &[], 1.0)]), [], "{outer:?}");
    }
    assert_eq!(pieces(&[column(&square, &[], 0.0)]), []);
    assert_eq!(pieces(&[column(&square, &[], f64::INFINITY)]), []);
    let fine: Vec<[f64; 2]> = (0..5000)
        .map(|i| (DVec2::from_angle(f64::from(i) * TAU / 5000.0) * 10.0).to_array())
        .collect();
    assert_eq!(pieces(&[column(&fine, &[], 1.0)]), []);
}

/// A ring around the origin with a vertex in each direction, in millimetres.
fn star() -> impl Strategy<Value = Vec<[f64; 2]>> {
    prop::collection::vec(3_000..30_000i32, 5..30).prop_map(|radii| {
        let step = TAU / radii.len() as f64;
        let vertex = |(i, radius): (usize, &i32)| {
            let at = DVec2::from_angle(i as f64 * step) * f64::from(*radius);
            (at.round() / 1000.0).to_array()
        };
        radii.iter().enumerate().map(vertex).collect()
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]
    #[test]
    fn every_piece_is_inside_its_column(outer in star(), yard in any::<bool>()) {
        let hole = [[-0.5, -0.5], [0.0, 1.2], [0.5, -0.5]];
        let holes: &[&[[f64; 2]]] = if yard { &[&hole] } else { &[] };
        let column = column(&outer, holes, 12.0);
        let found = pieces(std::slice::from_ref(&column));
        prop_assert!(!found.is_empty());
        for piece in &found {
            prop_assert!(piece.footprint().len() <= ConvexPrism::MOST_VERTICES);
            prop_assert!(is_inside(piece.footprint(), &rings(&column)), "{piece:?}");
        }
    }

    #[test]
    fn crosses_of_any_size_and_direction_give_both_bars(
        half in prop::array::uniform2(1..20i32),
        arm in prop::array::uniform2(5..20i32),
        degrees in 0..90i32,
    ) {
        let [a, c] = half.map(f64::from);
        let [x, y] = [a + f64::from(arm[0]), c + f64::from(arm[1])];
        let turned = DVec2::from_angle(f64::from(degrees).to_radians());
        let cross = [
            [x, -c], [x, c], [a, c], [a, y], [-a, y], [-a, c],
            [-x, c], [-x, -c], [-a, -c], [-a, -y], [a, -y], [a, -c],
        ];
        let cross = cross.map(|v| turned.rotate(DVec2::from(v)).to_array());
        let column = column(&cross, &[], 5.0);
        let found = pieces(std::slice::from_ref(&column));
        for half in [DVec2::new(x, c), DVec2::new(a, y)] {
            let bar = [half, DVec2::new(-half.x, half.y), -half, DVec2::new(half.x, -half.y)];
            let is_bar = |piece: &ConvexPrism| bar.iter().all(|&corner| {
                let corner = turned.rotate(corner) + FAR;
                piece.footprint().iter().any(|v| v.distance(corner) < INSIDE)
            });
            prop_assert!(found.iter().any(is_bar), "{found:?}");
        }
        for piece in &found {
            prop_assert!(is_inside(piece.footprint(), &rings(&column)), "{piece:?}");
        }
    }
}
