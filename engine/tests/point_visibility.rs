//! What can be seen from a point: chosen cases. Random ones are attacked exactly elsewhere.

use engine::{
    Box3d, CityLayout, PointQuery, PointSolver, Roof, SolidColumn, Tile, TileFeature, TileSource,
    TriangleMesh, generated_city, visible_from_point,
};
use geo::{LineString, Polygon};
use glam::{DVec2, DVec3};

/// Where the scenes stand: a place of the Dutch national grid.
const PLACE: DVec2 = DVec2::new(85_000.0, 447_000.0);

fn ring(corners: &[[f64; 2]]) -> LineString<f64> {
    corners
        .iter()
        .map(|&[x, y]| (x + PLACE.x, y + PLACE.y))
        .collect()
}

fn column(rings: &[&[[f64; 2]]], bottom: f64, top: f64, grounded: bool) -> SolidColumn {
    SolidColumn {
        footprint: Polygon::new(ring(rings[0]), rings[1..].iter().map(|r| ring(r)).collect()),
        bottom,
        top,
        grounded,
    }
}

fn rectangle([west, south]: [f64; 2], [east, north]: [f64; 2]) -> [[f64; 2]; 4] {
    [[west, south], [east, south], [east, north], [west, north]]
}

/// A feature that fills its envelope.
fn house(id: i64, min: [f64; 2], max: [f64; 2], top: f64) -> TileFeature {
    let columns = vec![column(&[&rectangle(min, max)], 0.0, top, true)];
    TileFeature {
        columns,
        ..thing(id, min, max, [0.0, top])
    }
}

/// A feature that hides nothing.
fn thing(id: i64, min: [f64; 2], max: [f64; 2], heights: [f64; 2]) -> TileFeature {
    let corner = |at: [f64; 2], z: f64| (DVec2::from_array(at) + PLACE).extend(z);
    TileFeature {
        id,
        envelope: Box3d::new(corner(min, heights[0]), corner(max, heights[1])),
        outline: Vec::new(),
        roof: None,
        columns: Vec::new(),
    }
}

fn query(x: f64, y: f64, z: f64) -> PointQuery {
    PointQuery {
        eye: DVec3::new(x + PLACE.x, y + PLACE.y, z),
        range: 1000.0,
        prisms: true,
        wedge: None,
    }
}

fn seen(features: &[TileFeature], query: &PointQuery) -> Vec<i64> {
    let mut seen = visible_from_point(features, query);
    seen.sort_unstable();
    seen
}

#[test]
fn a_house_hides_what_is_lower_behind_it() {
    let houses = [
        house(1, [-10.0, 10.0], [10.0, 20.0], 10.0),
        house(2, [-5.0, 40.0], [5.0, 50.0], 12.0),
        house(3, [-5.0, 60.0], [5.0, 70.0], 80.0),
        thing(4, [-1.0, 20.5], [1.0, 21.0], [0.0, 8.9]),
    ];
    assert_eq!(seen(&houses, &query(0.0, 0.0, 1.75)), [1, 3]);
    assert_eq!(seen(&houses, &query(0.0, 0.0, 30.0)), [1, 2, 3]);
    assert_eq!(seen(&houses, &query(-60.0, 45.0, 1.75)), [1, 2, 3, 4]);
}

#[test]
fn houses_hide_together_what_none_of_them_hides() {
    let row = |gap: f64| {
        [
            house(1, [-20.0, 10.0], [0.0, 20.0], 10.0),
            house(2, [gap, 10.0], [20.0, 20.0], 10.0),
            house(3, [-5.0, 40.0], [5.0, 50.0], 10.0),
        ]
    };
    for x in [-1.0, 0.5, 3.0] {
        assert_eq!(seen(&row(0.0), &query(x, 0.0, 1.75)), [1, 2]);
    }
    // A gap of a millimetre is a gap, for an eye that looks along it.
    assert_eq!(seen(&row(0.001), &query(0.0005, 0.0, 1.75)), [1, 2, 3]);
}

#[test]
fn a_sight_line_that_grazes_two_houses_is_free() {
    let houses = [
        house(1, [-20.0, 10.0], [0.0, 20.0], 10.0),
        house(2, [0.0, 30.0], [20.0, 40.0], 10.0),
        thing(3, [-5.0, 60.0], [5.0, 61.0], [0.0, 5.0]),
    ];
    assert_eq!(seen(&houses, &query(0.0, 0.0, 1.75)), [1, 2, 3]);
    assert_eq!(seen(&houses, &query(-0.5, 0.0, 1.75)), [1, 2]);
}

/// From the eye, the corner of the first house and that of the sign are on one diagonal: where the
/// sides of the square meet that the plan is seen through.
#[test]
fn past_a_corner_on_the_diagonal_one_sees_over_a_lower_house() {
    let features = [
        house(1, [18.0, 6.0], [25.0, 11.0], 4.0),
        house(2, [19.0, 15.0], [23.0, 18.0], 2.0),
        thing(3, [13.0, 11.0], [20.0, 16.0], [0.0, 5.0]),
    ];
    assert_eq!(seen(&features, &query(28.0, 8.0, 0.5)), [1, 2, 3]);
    assert_eq!(seen(&features, &query(28.0, 8.001, 0.5)), [1, 2, 3]);
    assert_eq!(seen(&features, &query(28.0, 7.999, 0.5)), [1, 2]);
}

/// The corners of both houses and the sign are on one sight line but for roundings of places.
#[test]
fn a_gap_as_wide_as_a_rounding_is_a_gap() {
    let corners = |corners: &[[f64; 2]]| -> Vec<(f64, f64)> {
        corners.iter().map(|&[x, y]| (x, y)).collect()
    };
    let left = corners(&[
        [7.98768496205144, 6.043158223221848],
        [8.06392347099652, 6.826503513353475],
        [4.452151056118704, 10.992905691527682],
        [4.240019021762739, 9.366560094798622],
    ]);
    let right = corners(&[
        [8.961425662559096, -0.05416888813596987],
        [10.587771259288155, 0.15796314621999397],
        [6.586132073918331, 3.934498553902192],
        [5.638023790982324, 3.693497052152732],
    ]);
    let around = |id: i64, places: &[(f64, f64)], top: f64| {
        let ends = places
            .iter()
            .flat_map(|&(x, y)| [DVec3::new(x, y, 0.0), DVec3::new(x, y, top)]);
        TileFeature {
            id,
            envelope: Box3d::around(ends).unwrap(),
            outline: Vec::new(),
            roof: None,
            columns: Vec::new(),
        }
    };
    let house = |id: i64, places: Vec<(f64, f64)>| TileFeature {
        roof: None,
        columns: vec![SolidColumn {
            footprint: Polygon::new(LineString::from(places.clone()), Vec::new()),
            bottom: 0.0,
            top: 7.0,
            grounded: true,
        }],
        ..around(id, &places, 7.0)
    };
    let sign = [
        (17.267484981654146, 14.615851462638007),
        (18.681698546027242, 15.322958243824555),
    ];
    let features = [house(1, left), house(2, right), around(3, &sign, 3.5)];
    let query = PointQuery {
        eye: DVec3::new(2.4141800425032693, 0.46965330367367875, 0.82),
        range: f64::INFINITY,
        prisms: false,
        wedge: None,
    };
    assert_eq!(seen(&features, &query), [1, 2, 3]);
}

#[test]
fn an_outline_may_turn_either_way() {
    let corners = [[-5.0, 30.0], [5.0, 30.0], [5.0, 34.0], [-5.0, 60.0]];
    for reversed in [false, true] {
        let mut tower = thing(2, [-5.0, 30.0], [5.0, 60.0], [0.0, 20.0]);
        tower.outline = corners.map(|at| DVec2::from_array(at) + PLACE).to_vec();
        if reversed {
            tower.outline.reverse();
        }
        // Its near side stands out over the house, its far side would not.
        let house = house(1, [-20.0, 10.0], [20.0, 20.0], 7.0);
        assert_eq!(seen(&[house, tower], &query(0.0, 0.0, 1.75)), [1, 2]);
    }
}

#[test]
fn a_sign_on_a_wall_is_seen_from_its_side_only() {
    let houses = [
        house(1, [-10.0, 10.0], [10.0, 20.0], 10.0),
        thing(2, [-1.0, 10.0], [1.0, 10.0], [2.0, 4.0]),
    ];
    assert_eq!(seen(&houses, &query(0.0, 0.0, 1.75)), [1, 2]);
    assert_eq!(seen(&houses, &query(0.0, 40.0, 1.75)), [1]);
}

#[test]
fn a_courtyard_is_not_inside_and_its_far_wall_hides() {
    let outer = rectangle([-20.0, -20.0], [20.0, 20.0]);
    let mut inner = rectangle([-10.0, -10.0], [10.0, 10.0]);
    inner.reverse();
    let block = TileFeature {
        columns: vec![column(&[&outer, &inner], 0.0, 15.0, true)],
        ..thing(1, [-20.0, -20.0], [20.0, 20.0], [0.0, 15.0])
    };
    let scene = [
        block,
        thing(2, [-1.0, 4.0], [1.0, 5.0], [0.0, 2.0]),
        thing(3, [-1.0, 40.0], [1.0, 41.0], [0.0, 9.0]),
    ];
    assert_eq!(seen(&scene, &query(0.0, 0.0, 1.75)), [1, 2]);
    assert_eq!(seen(&scene, &query(0.0, 30.0, 1.75)), [1, 3]);
    // In the wall of the block the block hides nothing.
    assert_eq!(seen(&scene, &query(0.0, 15.0, 1.75)), [1, 2, 3]);
}

/// A house with eaves at 3 m and a ridge at 8 m.
fn gabled(id: i64, grounded: [bool; 2]) -> TileFeature {
    let point = |x: f64, y: f64, z: f64| DVec3::new(x + PLACE.x, y + PLACE.y, z);
    let end = |x: f64| {
        let [front, middle, back] = [10.0, 15.0, 20.0];
        [
            [point(x, front, 0.0), point(x, front, 3.0)],
            [point(x, middle, 0.0), point(x, middle, 8.0)],
            [point(x, back, 0.0), point(x, back, 3.0)],
        ]
    };
    let [[a, b], [c, d], [e, f]] = end(-10.0);
    let [[p, q], [r, s], [t, u]] = end(10.0);
    let faces = [
        [a, c, r, p],
        [c, e, t, r],
        [b, q, s, d],
        [d, s, u, f],
        [a, p, q, b],
        [t, e, f, u],
        [c, a, b, d],
        [e, c, d, f],
        [p, r, s, q],
        [r, t, u, s],
    ];
    let mesh = TriangleMesh::from_polygons(faces.map(|face| [face.to_vec()]));
    let envelope = mesh.envelope().expect("vertices");
    let half = |west: f64, grounded| {
        let footprint = rectangle([west, 10.0], [west + 10.0, 20.0]);
        column(&[&footprint], 0.0, 3.0, grounded)
    };
    TileFeature {
        id,
        envelope,
        outline: Vec::new(),
        roof: Roof::of(&mesh, &envelope),
        columns: vec![half(-10.0, grounded[0]), half(0.0, grounded[1])],
    }
}

#[test]
fn a_ridge_hides_where_all_columns_do() {
    // Above the eaves, below the ridge, and above it.
    let scene = |grounded| {
        [
            gabled(1, grounded),
            thing(2, [-1.0, 40.0], [1.0, 41.0], [0.0, 10.0]),
            thing(3, [-1.0, 60.0], [1.0, 61.0], [0.0, 40.0]),
        ]
    };
    assert_eq!(seen(&scene([true; 2]), &query(0.0, 0.0, 1.75)), [1, 3]);
    for grounded in [[true, false], [false; 2]] {
        assert_eq!(seen(&scene(grounded), &query(0.0, 0.0, 1.75)), [1, 2, 3]);
    }
    // Beside the house in its envelope or over it, columns alone hide.
    let from_the_roof = query(0.0, 12.0, 4.5);
    assert_eq!(seen(&scene([true; 2]), &from_the_roof), [1, 2, 3]);
}

#[test]
fn a_roof_is_hidden_where_its_prism_is_not() {
    let wall = house(9, [-10.0, 5.0], [10.0, 6.0], 4.0);
    let plain = TileFeature {
        roof: None,
        ..gabled(1, [true; 2])
    };
    // The sight line over the wall meets the front of the prism 6.25 m high, and is over the ridge at 8.5 m.
    let query = query(0.0, 0.0, 1.75);
    assert_eq!(seen(&[wall.clone(), plain], &query), [1, 9]);
    assert_eq!(seen(&[wall, gabled(1, [true; 2])], &query), [9]);
}

#[test]
fn under_a_bridge_one_looks_through() {
    let deck = |grounded| TileFeature {
        columns: vec![column(
            &[&rectangle([-30.0, 10.0], [30.0, 20.0])],
            5.0,
            6.0,
            grounded,
        )],
        ..thing(1, [-30.0, 10.0], [30.0, 20.0], [5.0, 6.0])
    };
    let behind = house(2, [-5.0, 40.0], [5.0, 50.0], 5.0);
    assert_eq!(
        seen(&[deck(false), behind.clone()], &query(0.0, 0.0, 1.75)),
        [1, 2]
    );
    assert_eq!(seen(&[deck(true), behind], &query(0.0, 0.0, 1.75)), [1]);
}

#[test]
fn the_far_edge_of_a_roof_decides_from_above() {
    let scene = [
        house(1, [-10.0, 10.0], [10.0, 20.0], 10.0),
        // From 20 m the line over the far edge comes down 10 m further on.
        thing(2, [-1.0, 21.0], [1.0, 29.0], [0.0, 0.1]),
        thing(3, [-1.0, 21.0], [1.0, 41.0], [0.0, 0.1]),
    ];
    assert_eq!(seen(&scene, &query(0.0, 0.0, 20.0)), [1, 3]);
    assert_eq!(seen(&scene, &query(0.0, 15.0, 20.0)), [1, 2, 3]);
    assert_eq!(seen(&scene, &query(0.0, 15.0, 10.5)), [1]);
}

#[test]
fn the_range_is_euclidean_and_may_have_no_end() {
    let scene = [thing(1, [3.0, 4.0], [9.0, 9.0], [12.0, 20.0])];
    let at = |range: f64| PointQuery {
        range,
        ..query(0.0, 0.0, 0.0)
    };
    assert_eq!(seen(&scene, &at(13.0)), [1]);
    assert_eq!(seen(&scene, &at(12.999_999)), [0; 0]);
    assert_eq!(seen(&scene, &at(f64::INFINITY)), [1]);
    assert_eq!(seen(&[], &at(10.0)), [0; 0]);
}

/// Features in several tiles that count how often they are read.
struct Counted {
    bounds: Vec<Box3d>,
    tiles: Vec<Tile>,
    read: Vec<usize>,
}

impl TileSource for Counted {
    type Error = usize;

    fn bounds(&self) -> &[Box3d] {
        &self.bounds
    }

    fn tile(&mut self, position: usize) -> Result<&Tile, usize> {
        self.read[position] += 1;
        Ok(&self.tiles[position])
    }
}

impl Counted {
    fn new(features: &[TileFeature], size: usize) -> Self {
        let tiles: Vec<Tile> = features.chunks(size).map(Tile::new).collect();
        Self {
            bounds: tiles.iter().filter_map(Tile::bounds).collect(),
            read: vec![0; tiles.len()],
            tiles,
        }
    }
}

#[test]
fn tiles_do_not_change_the_answer_and_hidden_ones_are_not_read() {
    let city = generated_city(CityLayout::Streets, 3000, 7);
    let features: Vec<TileFeature> = city
        .features()
        .zip(0..)
        .map(|(feature, id)| TileFeature {
            id,
            envelope: feature.envelope,
            outline: Vec::new(),
            roof: None,
            columns: vec![feature.column],
        })
        .collect();
    let mut source = Counted::new(&features, 50);
    let mut solver = PointSolver::default();
    let (mut queries, mut read) = (0, 0);
    for street in city.streets().step_by(4) {
        let corner = street.area.exterior().0[0];
        let query = PointQuery {
            eye: DVec3::new(corner.x, corner.y, 1.75),
            range: 400.0,
            prisms: false,
            wedge: None,
        };
        let mut found = Vec::new();
        source.read.fill(0);
        assert_eq!(solver.solve(&query, &mut source, &mut found), Ok(()));
        queries += 1;
        read += source.read.iter().filter(|&&times| times > 0).count();
        let mut tiled: Vec<i64> = found
            .iter()
            .map(|s| source.tiles[s.tile].feature(s.feature).0)
            .collect();
        tiled.sort_unstable();
        assert_eq!(tiled, seen(&features, &query));
    }
    assert!(
        queries > 10 && read < queries * source.tiles.len() / 3,
        "{queries} {read}"
    );
}

/// A source that fails.
struct Broken([Box3d; 1]);

impl TileSource for Broken {
    type Error = &'static str;

    fn bounds(&self) -> &[Box3d] {
        &self.0
    }

    fn tile(&mut self, _: usize) -> Result<&Tile, &'static str> {
        Err("gone")
    }
}

#[test]
fn errors_of_the_source_are_passed_on_and_the_solver_can_be_used_again() {
    let wall = house(1, [-10.0, 10.0], [10.0, 20.0], 10.0);
    let mut solver = PointSolver::default();
    let query = query(0.0, 0.0, 1.75);
    let mut found = Vec::new();
    let mut broken = Broken([wall.envelope]);
    assert_eq!(solver.solve(&query, &mut broken, &mut found), Err("gone"));
    let mut whole = Counted::new(&[wall], 1);
    assert_eq!(solver.solve(&query, &mut whole, &mut found), Ok(()));
    assert_eq!(found.len(), 1);
}
