//! In which directions features are seen from a point, what hides a target there, and the isovist:
//! chosen cases, and boxes against rays. Random scenes are judged exactly in `tests/attack`.

use std::convert::Infallible;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};

use engine::{
    Box3d, Extents, PointQuery, PointSolver, PointTarget, SolidColumn, TargetShape, Tile,
    TileFeature, TileSource, ViewSector,
};
use geo::{LineString, Polygon};
use glam::{DVec2, DVec3};
use proptest::prelude::*;

/// Where the scenes stand: a place of the Dutch national grid.
const PLACE: DVec2 = DVec2::new(85_000.0, 447_000.0);

/// Features in one tile.
struct Scene {
    bounds: [Box3d; 1],
    tile: Tile,
}

impl TileSource for Scene {
    type Error = Infallible;

    fn bounds(&self) -> &[Box3d] {
        &self.bounds
    }

    fn tile(&mut self, _: usize) -> Result<&Tile, Infallible> {
        Ok(&self.tile)
    }
}

impl Scene {
    fn new(features: &[TileFeature]) -> Self {
        let tile = Tile::new(features);
        Self {
            bounds: [tile.bounds().expect("a feature")],
            tile,
        }
    }

    /// Ranges of a feature, as azimuths from and to.
    fn ranges(&mut self, id: i64, eye: DVec3) -> Vec<(f64, f64)> {
        let mut found: Vec<_> = self
            .extents(eye)
            .into_iter()
            .filter(|(of, ..)| *of == id)
            .map(|(_, from, to, _)| (from, to))
            .collect();
        found.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        found
    }

    /// Number, range and façade, for each range of each feature.
    fn extents(&mut self, eye: DVec3) -> Vec<(i64, f64, f64, Vec<DVec2>)> {
        let mut extents = Extents::default();
        let query = PointQuery {
            eye,
            range: 1000.0,
            prisms: true,
            wedge: None,
        };
        let Ok(()) = PointSolver::default().visible_extent(&query, self, &mut extents);
        let mut found = Vec::new();
        for (sighting, ranges) in extents.iter() {
            let (id, _) = self.tile.feature(sighting.feature);
            for range in ranges {
                let facade = range.facade.iter().map(|point| point - PLACE).collect();
                found.push((id, range.from, range.to, facade));
            }
        }
        found
    }

    fn hiders(&mut self, target: &TileFeature, eye: DVec3) -> Option<Vec<i64>> {
        let target = PointTarget {
            id: target.id,
            envelope: target.envelope,
            shape: match target.outline[..] {
                [] => TargetShape::Envelope,
                _ => TargetShape::Prism(&target.outline),
            },
        };
        let Ok(found) = PointSolver::default().hidden_by(eye, &target, self);
        found.map(|hiders| hiders.iter().map(|hider| hider.id).collect())
    }

    fn isovist(&mut self, eye: DVec3, range: f64) -> Vec<DVec2> {
        let mut corners = Vec::new();
        let Ok(()) = PointSolver::default().isovist(eye, range, self, &mut corners);
        corners.iter().map(|corner| corner - PLACE).collect()
    }
}

/// A feature that fills its envelope.
fn house(id: i64, min: [f64; 2], max: [f64; 2], top: f64) -> TileFeature {
    let corners = [min, [max[0], min[1]], max, [min[0], max[1]]];
    let ring: LineString = corners
        .iter()
        .map(|&[x, y]| (x + PLACE.x, y + PLACE.y))
        .collect();
    let corner = |at: [f64; 2], z: f64| (DVec2::from_array(at) + PLACE).extend(z);
    TileFeature {
        id,
        envelope: Box3d::new(corner(min, 0.0), corner(max, top)),
        outline: Vec::new(),
        roof: None,
        columns: vec![SolidColumn {
            footprint: Polygon::new(ring, Vec::new()),
            bottom: 0.0,
            top,
            grounded: true,
        }],
    }
}

fn eye(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x + PLACE.x, y + PLACE.y, z)
}

fn is_near(found: &[(f64, f64)], expected: &[(f64, f64)]) -> bool {
    found.len() == expected.len()
        && found.iter().zip(expected).all(|(found, expected)| {
            (found.0 - expected.0).abs() < 1e-9 && (found.1 - expected.1).abs() < 1e-9
        })
}

#[test]
fn azimuths_are_clockwise_from_north_and_pass_it() {
    let mut scene = Scene::new(&[
        house(1, [10.0, -10.0], [20.0, 10.0], 5.0),
        house(2, [-10.0, 10.0], [10.0, 20.0], 5.0),
        house(3, [-20.0, -10.0], [-10.0, 10.0], 5.0),
    ]);
    let eye = eye(0.0, 0.0, 1.75);
    let east = [(FRAC_PI_4, 3.0 * FRAC_PI_4)];
    assert!(is_near(&scene.ranges(1, eye), &east));
    let north = [(TAU - FRAC_PI_4, TAU + FRAC_PI_4)];
    assert!(is_near(&scene.ranges(2, eye), &north));
    let west = [(5.0 * FRAC_PI_4, 7.0 * FRAC_PI_4)];
    assert!(is_near(&scene.ranges(3, eye), &west));
}

#[test]
fn a_house_in_front_parts_what_is_seen_and_its_facade() {
    let mut scene = Scene::new(&[
        house(1, [-1.0, 10.0], [1.0, 12.0], 5.0),
        house(2, [-5.0, 20.0], [5.0, 30.0], 5.0),
    ]);
    let found = scene.extents(eye(0.0, 0.0, 1.75));
    let mut back: Vec<_> = found.iter().filter(|found| found.0 == 2).collect();
    back.sort_unstable_by(|a, b| a.1.total_cmp(&b.1));
    assert_eq!(back.len(), 2);
    let side = (5.0_f64).atan2(20.0);
    let middle = (1.0_f64).atan2(10.0);
    assert!(is_near(
        &[(back[0].1, back[0].2), (back[1].1, back[1].2)],
        &[(middle, side), (TAU - side, TAU - middle)]
    ));
    let near = |a: &[DVec2], b: &[[f64; 2]]| {
        a.len() == b.len()
            && a.iter()
                .zip(b)
                .all(|(a, b)| (*a - DVec2::from_array(*b)).length() < 1e-9)
    };
    assert!(near(&back[0].3, &[[2.0, 20.0], [5.0, 20.0]]));
    assert!(near(&back[1].3, &[[-5.0, 20.0], [-2.0, 20.0]]));
}

#[test]
fn a_facade_goes_around_corners_clockwise() {
    let mut scene = Scene::new(&[house(1, [10.0, 10.0], [20.0, 30.0], 5.0)]);
    let found = scene.extents(eye(0.0, 0.0, 1.75));
    let corners = [[10.0, 30.0], [10.0, 10.0], [20.0, 10.0]];
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].3.len(), 3);
    for (point, corner) in found[0].3.iter().zip(corners) {
        assert!((*point - DVec2::from_array(corner)).length() < 1e-9);
    }
}

#[test]
fn in_a_house_and_over_it_it_is_all_around() {
    let mut scene = Scene::new(&[
        house(1, [-10.0, -10.0], [10.0, 10.0], 5.0),
        house(2, [-10.0, 20.0], [10.0, 30.0], 5.0),
    ]);
    for z in [1.75, 20.0] {
        let found = scene.extents(eye(0.0, 0.0, z));
        let all = found.iter().find(|found| found.0 == 1).unwrap();
        assert_eq!((all.1, all.2), (0.0, TAU));
        assert_eq!(all.3.len(), 5);
        assert_eq!(all.3[0], all.3[4]);
        assert_eq!(scene.ranges(2, eye(0.0, 0.0, z)).len(), 1);
    }
}

/// A turned house whose box holds the eye, which is beside it.
#[test]
fn beside_a_prism_it_is_on_one_side_though_its_box_is_all_around() {
    let mut turned = house(1, [-10.0, -10.0], [10.0, 10.0], 5.0);
    turned.columns.clear();
    turned.outline = [[-10.0, 9.0], [9.0, -10.0], [10.0, -9.0], [-9.0, 10.0]]
        .map(|at| DVec2::from_array(at) + PLACE)
        .to_vec();
    let mut scene = Scene::new(&[turned]);
    let found = scene.ranges(1, eye(-5.0, -5.0, 1.75));
    let first = (-5.0_f64).atan2(14.0) + TAU;
    let last = FRAC_PI_2 - (-5.0_f64).atan2(14.0) + TAU;
    assert!(is_near(&found, &[(first, last)]), "{found:?}");
}

/// A wall that is nearer than the outline of its own feature, but for a millimetre.
#[test]
fn a_column_that_sticks_out_of_its_outline_does_not_hide_its_feature() {
    let mut feature = house(1, [-5.0, 9.999], [5.0, 20.0], 5.0);
    feature.outline = [[-5.0, 10.0], [5.0, 10.0], [5.0, 20.0], [-5.0, 20.0]]
        .map(|at| DVec2::from_array(at) + PLACE)
        .to_vec();
    let mut scene = Scene::new(&[feature]);
    let half = 5.0_f64.atan2(10.0);
    let found = scene.ranges(1, eye(0.0, 0.0, 1.75));
    assert!(is_near(&found, &[(TAU - half, TAU + half)]), "{found:?}");
    assert_eq!(scene.ranges(1, eye(0.0, 0.0, 9.0)).len(), 1);
}

#[test]
fn from_above_one_sees_a_lower_house_where_it_stands_out_behind() {
    let mut scene = Scene::new(&[
        house(1, [-1.0, 10.0], [1.0, 12.0], 9.0),
        house(2, [-5.0, 20.0], [5.0, 30.0], 5.0),
    ]);
    // From 10 m the line over the near house comes down 1 m in 12: to 8 m at 24 m, to 5 m at 60 m.
    assert_eq!(scene.ranges(2, eye(0.0, 0.0, 10.0)).len(), 2);
    // From 20 m it is below 5 m at 30 m.
    assert_eq!(scene.ranges(2, eye(0.0, 0.0, 20.0)).len(), 1);
}

#[test]
fn the_biggest_of_what_hides_is_named_alone() {
    let row = |id: i64| {
        house(
            id,
            [4.0 * id as f64 - 22.0, 10.0],
            [4.0 * id as f64 - 18.0, 12.0],
            9.0,
        )
    };
    let mut houses: Vec<TileFeature> = (1..=10).map(row).collect();
    houses.push(house(20, [-40.0, 14.0], [40.0, 16.0], 9.0));
    houses.push(house(30, [-12.0, 40.0], [12.0, 50.0], 9.0));
    let target = houses[11].clone();
    let eye = eye(0.0, 0.0, 1.75);
    assert_eq!(Scene::new(&houses).hiders(&target, eye), Some(vec![20]));
    houses.remove(10);
    // Of the row, those 3 m to both sides at 10 m, as it is 12 m at 40 m.
    let mut found = Scene::new(&houses).hiders(&target, eye).unwrap();
    found.sort_unstable();
    assert_eq!(found, [4, 5, 6]);
    houses.remove(4);
    assert_eq!(Scene::new(&houses).hiders(&target, eye), None);
}

#[test]
fn of_a_row_those_before_the_target_hide_it_and_no_feature_hides_itself() {
    let mut houses = vec![
        house(1, [-20.0, 10.0], [-2.0, 12.0], 9.0),
        house(2, [-2.0, 10.0], [0.0, 12.0], 9.0),
        house(3, [0.0, 10.0], [2.0, 12.0], 9.0),
        house(4, [2.0, 10.0], [20.0, 12.0], 9.0),
        house(5, [-5.0, 40.0], [5.0, 50.0], 9.0),
    ];
    let target = houses[4].clone();
    let eye = eye(0.5, 0.0, 1.75);
    let found = Scene::new(&houses).hiders(&target, eye).unwrap();
    assert_eq!(found.len(), 2);
    assert!(found.contains(&2) && found.contains(&3));
    // A part of the target in front of it has its number.
    houses[2].id = 5;
    assert_eq!(Scene::new(&houses).hiders(&target, eye), None);
    // In its own place, and behind nothing.
    assert_eq!(
        Scene::new(&houses).hiders(&target, eye + DVec3::Y * 45.0),
        None
    );
    assert_eq!(Scene::new(&houses).hiders(&houses[3], eye), None);
}

#[test]
fn an_isovist_ends_at_walls_that_stand_up_over_the_eye_and_at_the_range() {
    let houses = [
        house(1, [-100.0, 10.0], [100.0, 20.0], 9.0),
        house(2, [-100.0, -20.0], [100.0, -10.0], 1.0),
    ];
    let mut scene = Scene::new(&houses);
    let corners = scene.isovist(eye(0.0, 0.0, 1.75), 50.0);
    let area = |corners: &[DVec2]| {
        let pairs = corners.iter().zip(corners.iter().cycle().skip(1));
        pairs.map(|(a, b)| a.perp_dot(*b) / 2.0).sum::<f64>()
    };
    // The circle less what is beyond the northern wall.
    let angle = 2.0 * (10.0_f64 / 50.0).acos();
    let beyond = 50.0 * 50.0 * (angle - angle.sin()) / 2.0;
    let expected = PI * 50.0 * 50.0 - beyond;
    let share = area(&corners) / expected;
    assert!((1.0..1.0002).contains(&share), "{share}");
    let north = corners.iter().map(|corner| corner.y);
    assert!((north.fold(0.0, f64::max) - 10.0).abs() < 2e-6);
    // Over the roofs, and in a house that hides nothing then.
    for free in [eye(0.0, 0.0, 9.5), eye(0.0, 15.0, 1.75)] {
        let circle = area(&scene.isovist(free, 50.0)) / (PI * 50.0 * 50.0);
        assert!((1.0..1.0002).contains(&circle), "{circle}");
    }
    assert!(scene.isovist(eye(0.0, 0.0, 1.75), 0.0).is_empty());
    assert!(scene.isovist(eye(0.0, 0.0, 1.75), f64::INFINITY).is_empty());
    assert!(scene.isovist(eye(0.0, 0.0, 1.75), f64::NAN).is_empty());
}

/// Whether a ray along a direction in plan sees a box past all others, by its highest point.
fn sees(houses: &[TileFeature], at: usize, eye: DVec3, way: DVec2) -> bool {
    let chord = |bounds: &Box3d| {
        let (mut near, mut far) = (0.0_f64, f64::INFINITY);
        for axis in 0..2 {
            let ends =
                [bounds.min[axis], bounds.max[axis]].map(|end| (end - eye[axis]) / way[axis]);
            near = near.max(ends[0].min(ends[1]));
            far = far.min(ends[0].max(ends[1]));
        }
        (near < far).then_some((near, far))
    };
    let Some((near, far)) = chord(&houses[at].envelope) else {
        return false;
    };
    let top = houses[at].envelope.max.z - eye.z;
    let highest = if top >= 0.0 { top / near } else { top / far };
    // A house that holds the eye hides nothing.
    let holds = |house: &TileFeature| house.envelope.distance_to_point(eye) <= 1e-3;
    let others = (0..houses.len()).filter(|&other| other != at && !holds(&houses[other]));
    others.into_iter().all(|other| {
        let height = houses[other].envelope.max.z - eye.z;
        match chord(&houses[other].envelope) {
            Some((enter, leave)) => {
                let slope = if height >= 0.0 {
                    height / enter
                } else {
                    height / leave
                };
                enter >= near || leave > near && height < 0.0 || slope <= highest
            }
            None => true,
        }
    })
}

proptest! {
    /// Boxes apart from each other: where a range says that a box is seen, rays mostly see it, and where
    /// they do, a range says so.
    #[test]
    fn ranges_are_tight(
        places in prop::collection::vec((0..6_i32, 0..6_i32, 1..7_i32, 1..7_i32, 2..12_i32), 4..30),
        x in -30.0..100.0_f64,
        y in -30.0..100.0_f64,
        z in prop_oneof![Just(1.75), 0.0..15.0_f64],
    ) {
        let mut known = std::collections::HashSet::new();
        let mut houses = Vec::new();
        for (column, row, width, depth, top) in places {
            if known.insert((column, row)) {
                let west = 10.0 * f64::from(column);
                let south = 10.0 * f64::from(row);
                let max = [west + f64::from(width), south + f64::from(depth)];
                houses.push(house(houses.len() as i64, [west, south], max, f64::from(top)));
            }
        }
        let eye = eye(x, y, z);
        let mut scene = Scene::new(&houses);
        let extents = scene.extents(eye);
        let (mut said, mut seen) = (0, 0);
        for ray in 0..720 {
            let azimuth = (f64::from(ray) + 0.3) / 720.0 * TAU;
            let way = DVec2::new(azimuth.sin(), azimuth.cos());
            for at in 0..houses.len() {
                let is_said = extents.iter().any(|(id, from, to, _)| {
                    *id == at as i64
                        && (*from..=*to).contains(&if azimuth < *from { azimuth + TAU } else { azimuth })
                });
                let bounds = houses[at].envelope;
                let is_over = (0..2).all(|axis| bounds.min[axis] <= eye[axis] && eye[axis] <= bounds.max[axis]);
                let is_seen = is_over || sees(&houses, at, eye, way);
                prop_assert!(is_said || !is_seen, "{at} at {azimuth}");
                said += usize::from(is_said);
                seen += usize::from(is_seen);
            }
        }
        prop_assert!(said as f64 <= 1.1 * seen as f64 + 10.0, "{said} {seen}");
    }
}

/// Houses on a lattice, and an eye among or over them.
fn town() -> impl Strategy<Value = (Vec<TileFeature>, DVec3)> {
    let heights = prop::collection::vec(1_u8..30, 49);
    (heights, 0_u8..70, 0_u8..70, 1_u8..30).prop_map(|(heights, x, y, z)| {
        let town = (0_u8..).zip(heights).map(|(at, top)| {
            let (west, south) = (f64::from(at % 7) * 10.0, f64::from(at / 7) * 10.0);
            house(
                i64::from(at),
                [west, south],
                [west + 7.0, south + 6.0],
                top.into(),
            )
        });
        (town.collect(), eye(x.into(), y.into(), z.into()))
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..Default::default() })]

    #[test]
    fn a_field_of_view_returns_what_is_seen_in_its_directions(
        (features, eye) in town(),
        heading in 0.0..TAU,
        half in 0.01..PI,
    ) {
        let sector = ViewSector::new(eye, heading, 2.0 * half, 1000.0);
        let mut scene = Scene::new(&features);
        let mut looks = |wedge| {
            let query = PointQuery { eye, range: 1000.0, prisms: true, wedge };
            let mut seen = Vec::new();
            let Ok(()) = PointSolver::default().solve(&query, &mut scene, &mut seen);
            seen.iter().map(|s| scene.tile.feature(s.feature).0).collect::<Vec<i64>>()
        };
        let (all, inside) = (looks(None), looks(sector.plan_wedge()));
        prop_assert!(inside.iter().all(|id| all.contains(id)));
        let mut is_within = |id| {
            // The middle of a range: whether some direction of it is well within the sector.
            let overlap = |(from, to): (f64, f64)| (0..=64).any(|step| {
                let azimuth = from + (to - from) * f64::from(step) / 64.0;
                ((azimuth - heading + PI).rem_euclid(TAU) - PI).abs() < half
            });
            scene.ranges(id, eye).into_iter().any(overlap)
        };
        for id in all {
            prop_assert!(inside.contains(&id) || !is_within(id), "{id} is seen in the sector");
        }
    }
}
