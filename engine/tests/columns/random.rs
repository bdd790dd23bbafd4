//! Random solids.

use engine::{ColumnOptions, solid_columns};
use glam::{DMat3, DVec2, DVec3};
use proptest::prelude::*;

use crate::solids::*;

/// A solid of cells between uneven planes.
#[derive(Clone, Debug)]
struct Cells {
    planes: [Vec<f64>; 3],
    solid: Vec<bool>,
}

const SIDE: usize = 4;

impl Cells {
    fn solid(&self) -> impl Iterator<Item = [usize; 3]> {
        let all = (0..SIDE.pow(3)).filter(|&i| self.solid[i]);
        all.map(|i| [i % SIDE, i / SIDE % SIDE, i / SIDE / SIDE])
    }

    fn corner(&self, cell: [usize; 3]) -> [f64; 3] {
        [0, 1, 2].map(|axis| self.planes[axis][cell[axis]])
    }

    fn volume(&self) -> f64 {
        let size = |cell: [usize; 3]| {
            let (low, high) = (self.corner(cell), self.corner(cell.map(|i| i + 1)));
            (DVec3::from(high) - DVec3::from(low)).element_product()
        };
        self.solid().map(size).sum()
    }

    /// A box for each cell; the walls between them are delivered twice.
    fn surface(&self) -> Triangles {
        let cells = self.solid();
        cells
            .flat_map(|cell| boxed(self.corner(cell), self.corner(cell.map(|i| i + 1))))
            .collect()
    }
}

fn cells() -> impl Strategy<Value = Cells> {
    let widths = prop::collection::vec(0.3..6.0f64, 3 * SIDE);
    let solid = prop::collection::vec(prop::bool::weighted(0.6), SIDE * SIDE * SIDE);
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

/// A house: its plan an L, a U or a square, its roof flat, gabled, lean-to or hipped, anywhere.
fn house() -> impl Strategy<Value = Triangles> {
    let size = (4.0..15.0f64, 4.0..15.0f64, 2.0..12.0f64, 0.5..6.0f64);
    let place = (
        -10.0..10.0f64,
        -10.0..10.0f64,
        prop_oneof![Just(0.0), -3.0..6.0f64],
    );
    (0..6u8, size, place, 0.0..std::f64::consts::TAU).prop_map(|(kind, size, place, turn)| {
        let (x, y, z, roof) = size;
        let (a, b) = (x * 0.4, y * 0.4);
        let house = match kind {
            0 => boxed([0.0; 3], [x, y, z]),
            1 => gabled(x, y, z, z + roof),
            2 => prism(&[&rectangle([0.0; 2], [x, y])], 0.0, |p| z + roof * p.x / x),
            3 => prism(
                &[&[[0.0, 0.0], [x, 0.0], [x, b], [a, b], [a, y], [0.0, y]]],
                0.0,
                |_| z,
            ),
            4 => {
                let u = [
                    [0.0, 0.0],
                    [x, 0.0],
                    [x, y],
                    [x - a / 2.0, y],
                    [x - a / 2.0, b],
                    [a, b],
                    [a, y],
                    [0.0, y],
                ];
                prism(&[&u], 0.0, |p| z + roof * p.y / y)
            }
            _ => {
                let ring = rectangle([0.0; 2], [x, y]);
                let apex = [x / 2.0, y / 2.0];
                let slopes: Vec<_> = (0..4)
                    .map(|i| vec![ring[i], ring[(i + 1) % 4], apex])
                    .collect();
                roofed(&slopes, |p| {
                    if p == DVec2::from_array(apex) {
                        z + roof
                    } else {
                        z
                    }
                })
            }
        };
        let turn = DMat3::from_rotation_z(turn);
        moved(house, |p| turn * p + DVec3::from(place))
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn cells_are_filled(cells in cells(), turn in prop_oneof![Just(0.0), 0.0..1.6f64]) {
        let start = DVec3::from(cells.corner([0; 3]));
        let turn = DMat3::from_rotation_z(turn);
        let triangles = moved(cells.surface(), |p| turn * (p - start) + start);
        if cells.volume() > 0.0 {
            let found = search(&triangles, &ALL);
            prop_assert!((found.volume / cells.volume() - 1.0).abs() < 1e-6);
            prop_assert!(found.share > 0.999, "{}", found.share);
        }
    }

    #[test]
    fn a_house_reaches_what_is_asked(house in house(), far in any::<bool>()) {
        let origin = if far { FAR } else { DVec3::ZERO };
        let house = moved(house, |p| delivered(p + origin));
        let found = search(&house, &ColumnOptions { share: 0.95, most: 1000, least_gain: 0.0 });
        prop_assert!(found.share > 0.95 - 1e-3, "{}", found.share);
        prop_assert!(found.columns.len() <= 24, "{}", found.columns.len());
    }

    #[test]
    fn overlapping_houses_hold_their_columns(
        houses in prop::collection::vec(house(), 2..5),
        far in any::<bool>(),
    ) {
        let origin = if far { FAR } else { DVec3::ZERO };
        let houses = moved(houses.concat(), |p| delivered(p + origin));
        // Roofs that cross within the solid bound columns, so some volume is out of reach.
        prop_assert!(search(&houses, &ALL).share > 0.5);
    }

    #[test]
    fn random_triangles_never_panic(
        corners in prop::collection::vec(prop::array::uniform3(-3..3i8), 3..8),
        scale in prop_oneof![Just(1.0), Just(1e-300), Just(1e-20), Just(1e50), Just(1e300)],
    ) {
        let points: Vec<DVec3> =
            corners.iter().map(|c| DVec3::from_array(c.map(f64::from)) * scale).collect();
        let options = ColumnOptions::default();
        // Each triangle once with each side: closed, and holds nothing.
        let doubled: Triangles = points
            .windows(3)
            .flat_map(|w| [[w[0], w[1], w[2]], [w[0], w[2], w[1]]])
            .collect();
        prop_assert!(solid_columns(&mesh(&doubled), &options).is_err());
        // Tetrahedra through each other, some of them inside out.
        let tetrahedra: Triangles = points
            .windows(4)
            .flat_map(|w| [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]].map(|t| t.map(|i: usize| w[i])))
            .collect();
        if let Ok(found) = solid_columns(&mesh(&tetrahedra), &options) {
            for column in found.columns.iter().filter(|_| scale == 1.0) {
                prop_assert_eq!(outside(column, &mesh(&tetrahedra)), None);
            }
        }
    }
}
