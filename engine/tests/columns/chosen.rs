//! Solids that are hard in one way each.

use engine::{ColumnOptions, MeshDefect, SolidColumn, TriangleMesh, solid_columns};
use geo::{Area, Buffer, Polygon};
use glam::{DMat3, DVec3};

use crate::solids::*;

/// The column grown by a centimetre to the sides, upwards and downwards.
fn grown(column: &SolidColumn) -> Vec<SolidColumn> {
    let wide = column.footprint.buffer(0.01).0.into_iter();
    let mut grown: Vec<_> = wide
        .map(|footprint| SolidColumn {
            footprint,
            ..column.clone()
        })
        .collect();
    grown.push(SolidColumn {
        top: column.top + 0.01,
        ..column.clone()
    });
    grown.push(SolidColumn {
        bottom: column.bottom - 0.01,
        ..column.clone()
    });
    grown
}

fn places(polygon: &Polygon) -> Vec<[f64; 2]> {
    polygon.exterior().0.iter().map(|c| [c.x, c.y]).collect()
}

fn volume(column: &SolidColumn) -> f64 {
    column.footprint.unsigned_area() * (column.top - column.bottom)
}

/// The best share that nested columns of a gabled house can reach, by trying levels.
fn best_share(eaves: f64, ridge: f64, columns: usize) -> f64 {
    const STEPS: usize = 200;
    let height = |i: usize| eaves + (ridge - eaves) * i as f64 / STEPS as f64;
    let area = |i: usize| 1.0 - i as f64 / STEPS as f64;
    let mut best: Vec<f64> = (0..STEPS).map(|i| area(i) * height(i)).collect();
    for _ in 1..columns {
        let step = |i: usize| {
            let before = (0..i).map(|j| best[j] + area(i) * (height(i) - height(j)));
            before.fold(best[i], f64::max)
        };
        best = (0..STEPS).map(step).collect();
    }
    best.into_iter().fold(0.0, f64::max) / ((eaves + ridge) / 2.0)
}

#[test]
fn a_box_is_its_own_column() {
    let cuboid = moved(boxed([1.1, 2.2, 3.3], [11.7, 9.1, 14.9]), |p| p + FAR);
    let found = search(&cuboid, &ColumnOptions::default());
    let [column] = &found.columns[..] else {
        panic!("{found:?}")
    };
    let (min, max) = (
        FAR + DVec3::new(1.1, 2.2, 3.3),
        FAR + DVec3::new(11.7, 9.1, 14.9),
    );
    let mut corners = places(&column.footprint);
    assert_eq!(corners.pop(), corners.first().copied());
    corners.sort_by(|a, b| a.partial_cmp(b).expect("numbers"));
    assert_eq!(
        corners,
        [
            [min.x, min.y],
            [min.x, max.y],
            [max.x, min.y],
            [max.x, max.y]
        ]
    );
    assert_eq!(
        (column.bottom, column.top, column.grounded),
        (min.z, max.z, true)
    );
    assert!((found.share - 1.0).abs() < 1e-12);
}

#[test]
fn row_houses_share_their_wall_bit_for_bit() {
    let turn = DMat3::from_rotation_z(0.3);
    let house = |x: f64| {
        let house = moved(gabled(6.0, 9.0, 5.0, 8.0), |p| p + DVec3::X * x);
        search(
            &moved(house, |p| delivered(turn * p + FAR)),
            &ColumnOptions::default(),
        )
    };
    let (one, other) = (house(0.0), house(6.0));
    let wall = [DVec3::new(6.0, 0.0, 0.0), DVec3::new(6.0, 9.0, 0.0)]
        .map(|p| delivered(turn * p + FAR).truncate().to_array());
    for column in [&one.columns[0], &other.columns[0]] {
        assert!(
            wall.iter()
                .all(|end| places(&column.footprint).contains(end)),
            "{column:?}"
        );
    }
}

#[test]
fn a_gabled_house_gets_the_best_staircase() {
    let turn = DMat3::from_rotation_z(0.7);
    let house = moved(gabled(12.0, 8.0, 6.0, 10.0), |p| turn * p + FAR);
    for most in 1..6 {
        let options = ColumnOptions {
            share: 1.0,
            most,
            least_gain: 0.0,
        };
        let found = search(&house, &options);
        let best = best_share(6.0, 10.0, most);
        assert_eq!(found.columns.len(), most);
        assert!(
            found.share > best - 0.01,
            "{} of {best} with {most}",
            found.share
        );
        assert!(found.columns.iter().all(|column| column.grounded));
    }
}

#[test]
fn grown_columns_are_found_out() {
    let turn = DMat3::from_rotation_z(0.7);
    let corner = [
        [0.0, 0.0],
        [9.0, 0.0],
        [9.0, 4.0],
        [4.0, 4.0],
        [4.0, 9.0],
        [0.0, 9.0],
    ];
    for solid in [
        gabled(12.0, 8.0, 6.0, 10.0),
        prism(&[&corner], 0.0, |_| 7.0),
    ] {
        let solid = moved(solid, |p| turn * p + FAR);
        for column in search(&solid, &ColumnOptions::default()).columns {
            for mutant in grown(&column) {
                assert!(outside(&mutant, &mesh(&solid)).is_some(), "{mutant:?}");
            }
        }
    }
}

#[test]
fn a_courtyard_stays_a_hole() {
    let outer = rectangle([0.0, 0.0], [20.0, 30.0]);
    let mut yard = rectangle([5.0, 6.0], [15.0, 24.0]);
    yard.reverse();
    let block = moved(prism(&[&outer, &yard], 0.0, |_| 12.0), |p| p + FAR);
    let found = search(&block, &ColumnOptions::default());
    let [column] = &found.columns[..] else {
        panic!("{found:?}")
    };
    assert_eq!(column.footprint.interiors().len(), 1);
    assert_eq!(column.footprint.unsigned_area(), 600.0 - 180.0);
}

#[test]
fn what_is_above_a_passage_is_not_grounded() {
    // One solid: the passage is cut out of its side.
    let side = [
        [0.0, 0.0],
        [4.0, 0.0],
        [4.0, 3.0],
        [8.0, 3.0],
        [8.0, 0.0],
        [12.0, 0.0],
        [12.0, 9.0],
        [0.0, 9.0],
    ];
    let gate = moved(prism(&[&side], 0.0, |_| 10.0), |p| {
        DVec3::new(p.x, -p.z, p.y) + FAR
    });
    let found = search(&gate, &ColumnOptions::default());
    let (standing, above): (Vec<_>, Vec<_>) = found.columns.iter().partition(|c| c.grounded);
    assert_eq!((standing.len(), above.len()), (2, 1));
    assert_eq!((above[0].bottom, above[0].top), (3.0, 9.0));
    assert_eq!(above[0].footprint.unsigned_area(), 40.0);
    assert!((found.share - 1.0).abs() < 1e-12);
}

#[test]
fn an_overhang_is_not_grounded() {
    let side = [
        [0.0, 0.0],
        [6.0, 0.0],
        [6.0, 4.0],
        [9.0, 4.0],
        [9.0, 8.0],
        [0.0, 8.0],
    ];
    let house = moved(prism(&[&side], 0.0, |_| 5.0), |p| {
        DVec3::new(p.x, -p.z, p.y)
    });
    let found = search(&house, &ColumnOptions::default());
    let [standing, hanging] = &found.columns[..] else {
        panic!("{found:?}")
    };
    assert_eq!(
        (standing.bottom, standing.top, standing.grounded),
        (0.0, 8.0, true)
    );
    assert_eq!(
        (hanging.bottom, hanging.top, hanging.grounded),
        (4.0, 8.0, false)
    );
    assert!((found.share - 1.0).abs() < 1e-12);
}

#[test]
fn an_arch_stands_on_its_piers() {
    let arch = (0..=12).map(|i| {
        let angle = std::f64::consts::PI * f64::from(i) / 12.0;
        [10.0 - 7.0 * angle.cos(), 5.0 * angle.sin()]
    });
    let mut side = vec![[0.0, 0.0]];
    side.extend(arch);
    side.extend([[20.0, 0.0], [20.0, 7.0], [0.0, 7.0]]);
    let bridge = prism(&[&side], 0.0, |_| 6.0);
    let turn = DMat3::from_rotation_z(0.4);
    let bridge = moved(bridge, |p| {
        delivered(turn * DVec3::new(p.x, -p.z, p.y) + FAR)
    });
    let found = search(&bridge, &ALL);
    assert_eq!(
        found
            .columns
            .iter()
            .filter(|column| column.grounded)
            .count(),
        2
    );
    assert!(found.share > 0.95, "{}", found.share);
    let found = search(&bridge, &ColumnOptions::default());
    assert!(found.share > 0.9, "{}", found.share);
}

#[test]
fn stacked_floors_are_one_column() {
    let floors = (0..5).map(|i| f64::from(i) * 3.0);
    let floors = floors.flat_map(|z| boxed([0.0, 0.0, z], [8.0, 7.0, z + 3.0]));
    let found = search(&floors.collect(), &ColumnOptions::default());
    let [column] = &found.columns[..] else {
        panic!("{found:?}")
    };
    assert_eq!(
        (column.bottom, column.top, column.grounded),
        (0.0, 15.0, true)
    );
}

#[test]
fn touching_and_overlapping_shells_are_solid() {
    // The wall between the first two is delivered twice, the third overlaps both.
    let shells = [
        boxed([0.0, 0.0, 0.0], [5.0, 8.0, 6.0]),
        boxed([5.0, 0.0, 0.0], [12.0, 8.0, 6.0]),
        boxed([3.0, -2.0, 0.0], [7.0, 5.0, 6.0]),
    ];
    let turn = DMat3::from_rotation_z(0.2);
    let row = moved(shells.concat(), |p| turn * p + FAR);
    let found = search(&row, &ColumnOptions::default());
    assert!(found.columns.len() <= 5 && found.columns.iter().all(|column| column.grounded));
    assert!(found.share > 0.9999, "{}", found.share);
    assert!(
        (found.volume - 6.0 * (96.0 + 8.0)).abs() < 0.01,
        "{}",
        found.volume
    );
}

#[test]
fn solids_apart_get_columns_each() {
    let pair = [
        boxed([0.0; 3], [4.0, 4.0, 9.0]),
        boxed([10.0, 0.0, 2.0], [14.0, 4.0, 5.0]),
    ];
    let found = search(&pair.concat(), &ColumnOptions::default());
    let grounded: Vec<bool> = found.columns.iter().map(|column| column.grounded).collect();
    assert_eq!(grounded, [true, false]);
    assert!((found.share - 1.0).abs() < 1e-12);
    // Corner to corner, they are two as well.
    let pair = [
        boxed([0.0; 3], [4.0, 4.0, 9.0]),
        boxed([4.0, 4.0, 0.0], [8.0, 8.0, 9.0]),
    ];
    assert_eq!(
        search(&pair.concat(), &ColumnOptions::default())
            .columns
            .len(),
        2
    );
}

#[test]
fn hollows_are_outside() {
    let shell = [
        boxed([0.0; 3], [10.0; 3]),
        flipped(boxed([1.0; 3], [9.0; 3])),
    ]
    .concat();
    let found = search(&shell, &ALL);
    assert!((found.volume - (1000.0 - 512.0)).abs() < 1e-9);
    assert!((found.share - 1.0).abs() < 1e-9);
    // A solid within the hollow counts again.
    let nested = [shell, boxed([2.0; 3], [8.0; 3])].concat();
    let found = search(&nested, &ALL);
    assert!((found.volume - (1000.0 - 512.0 + 216.0)).abs() < 1e-9);
    assert!((found.share - 1.0).abs() < 1e-9);
}

#[test]
fn fins_without_thickness_hide_nothing_and_do_no_harm() {
    let sheet = |a: [f64; 3], b: [f64; 3], c: [f64; 3], d: [f64; 3]| {
        let [a, b, c, d] = [a, b, c, d].map(DVec3::from_array);
        vec![[a, b, c], [a, c, d], [a, c, b], [a, d, c]]
    };
    let solid = [
        boxed([0.0; 3], [10.0, 8.0, 6.0]),
        // On the roof, through the solid and out of the wall, and level in the air.
        sheet(
            [2.0, 4.0, 6.0],
            [8.0, 4.0, 6.0],
            [8.0, 4.0, 9.0],
            [2.0, 4.0, 9.0],
        ),
        sheet(
            [5.0, 3.0, 1.0],
            [14.0, 3.0, 1.0],
            [14.0, 3.0, 5.0],
            [5.0, 3.0, 5.0],
        ),
        sheet(
            [20.0, 0.0, 3.0],
            [22.0, 0.0, 3.0],
            [22.0, 2.0, 3.0],
            [20.0, 2.0, 3.0],
        ),
    ]
    .concat();
    let turn = DMat3::from_rotation_z(0.6);
    let found = search(&moved(solid, |p| turn * p + FAR), &ColumnOptions::default());
    let [column] = &found.columns[..] else {
        panic!("{found:?}")
    };
    assert!((volume(column) - 480.0).abs() < 0.01, "{}", volume(column));
}

#[test]
fn a_foot_that_is_not_quite_level_is_grounded() {
    let house = moved(boxed([0.0; 3], [10.0, 8.0, 6.0]), |p| {
        DVec3::new(p.x, p.y, if p.z == 0.0 { p.x * 5e-4 } else { p.z })
    });
    let found = search(&house, &ColumnOptions::default());
    assert!(found.columns[0].grounded && found.columns[0].bottom == 5e-3);
    // On a slope, what is above the foot's lowest corner is not.
    let slope = moved(house, |p| {
        DVec3::new(p.x, p.y, if p.z < 1.0 { p.x * 0.2 } else { p.z })
    });
    let found = search(&slope, &ColumnOptions::default());
    assert!(found.share > 0.9, "{}", found.share);
    assert!(
        found
            .columns
            .iter()
            .all(|column| column.grounded == (column.bottom == 0.0))
    );
}

#[test]
fn options_trade_columns_for_volume() {
    let house = gabled(12.0, 8.0, 6.0, 10.0);
    let count = |share: f64, most: usize, least_gain: f64| {
        search(
            &house,
            &ColumnOptions {
                share,
                most,
                least_gain,
            },
        )
        .columns
        .len()
    };
    assert_eq!(count(0.7, 100, 0.0), 1);
    assert!(count(0.97, 100, 0.0) < count(0.985, 100, 0.0));
    assert_eq!(count(1.0, 3, 0.0), 3);
    assert!(count(1.0, 100, 0.05) < count(1.0, 100, 0.005));
    let none = ColumnOptions { most: 0, ..ALL };
    let found = solid_columns(&mesh(&house), &none).expect("solid");
    assert_eq!((found.columns.len(), found.share), (0, 0.0));
}

#[test]
fn defects_are_told_apart() {
    let cube = boxed([0.0; 3], [10.0; 3]);
    let report = |triangles: &Triangles| {
        solid_columns(&mesh(triangles), &ALL)
            .expect_err("no solid")
            .to_string()
    };
    assert_eq!(report(&Vec::new()), "no faces");
    assert_eq!(report(&cube[1..].to_vec()), "open: 3 unpaired edge(s)");
    assert_eq!(report(&flipped(cube.clone())), "inside out");
    assert_eq!(
        report(&[cube.clone(), flipped(cube.clone())].concat()),
        "zero volume"
    );
    assert_eq!(report(&boxed([0.0; 3], [10.0, 10.0, 0.0])), "zero volume");
    let nan = moved(cube, |p| if p.x > 0.0 { p * f64::NAN } else { p });
    assert_eq!(report(&nan), "not finite: a coordinate is NaN or infinite");
    let bow_tie = vec![
        DVec3::ZERO,
        DVec3::new(2.0, 2.0, 0.0),
        DVec3::X * 2.0,
        DVec3::Y * 2.0,
    ];
    let mesh = TriangleMesh::from_polygons([vec![bow_tie]]);
    let defect = MeshDefect::UntriangulableFaces { faces: 1 };
    assert_eq!(solid_columns(&mesh, &ALL), Err(defect));
}
