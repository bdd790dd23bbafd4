//! Footprints and view regions, against points that are placed by hand or at random.

use engine::{
    Box3d, Site, Street, TriangleMesh, ViewRegionOptions, footprint, open_space,
    streets_from_surfaces,
};
use geo::{Area, Contains, Coord, LineString, MultiPolygon, Polygon, Rect, Winding};
use glam::DVec3;
use proptest::prelude::*;

/// Far from the origin, as in national grids.
const FAR: DVec3 = DVec3::new(85_000.0, 447_000.0, 0.0);

/// A box turned about its lower left corner, as triangles.
fn turned_box(min: DVec3, size: DVec3, turn: f64) -> TriangleMesh {
    let (sin, cos) = turn.sin_cos();
    let corners = Box3d::new(DVec3::ZERO, size)
        .corners()
        .map(|p| min + DVec3::new(cos * p.x - sin * p.y, sin * p.x + cos * p.y, p.z));
    let faces = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    TriangleMesh::from_polygons(faces.map(|f| [f.map(|i: usize| corners[i]).to_vec()]))
}

fn site(min: DVec3, size: DVec3, turn: f64) -> Site {
    Site {
        footprint: footprint(&turned_box(min, size, turn)),
        foot: min.z,
    }
}

fn rectangle(x: [f64; 2], y: [f64; 2]) -> MultiPolygon<f64> {
    let corner = |i: usize| Coord {
        x: FAR.x + x[i],
        y: FAR.y + y[i],
    };
    MultiPolygon::new(vec![Rect::new(corner(0), corner(1)).to_polygon()])
}

fn total(streets: &[Street]) -> f64 {
    streets
        .iter()
        .map(|street| street.area.unsigned_area())
        .sum()
}

fn covers(streets: &[Street], x: f64, y: f64) -> bool {
    let point = Coord {
        x: FAR.x + x,
        y: FAR.y + y,
    };
    streets.iter().any(|street| street.area.contains(&point))
}

fn assert_rings_in_order(area: &Polygon<f64>) {
    assert!(area.exterior().is_ccw(), "outer ring turns clockwise");
    assert!(
        area.interiors().iter().all(LineString::is_cw),
        "hole turns anticlockwise"
    );
}

#[test]
fn a_box_stands_on_its_base() {
    let area = footprint(&turned_box(FAR, DVec3::new(8.0, 5.0, 3.0), 0.3));
    assert!((area.unsigned_area() - 40.0).abs() < 1e-6);
    assert_rings_in_order(&area.0[0]);
}

#[test]
fn a_sheet_has_no_footprint_and_a_courtyard_stays_open() {
    let sheet = TriangleMesh::from_triangles([[FAR, FAR + DVec3::X, FAR + DVec3::Z]]);
    assert_eq!(footprint(&sheet), MultiPolygon::new(vec![]));
    assert_eq!(
        footprint(&TriangleMesh::default()),
        MultiPolygon::new(vec![])
    );
    let ring = |size: f64| {
        [[0.0, 0.0], [size, 0.0], [size, size], [0.0, size]]
            .map(|[x, y]| FAR + DVec3::new(x + 5.0 - size / 2.0, y + 5.0 - size / 2.0, 9.0))
            .to_vec()
    };
    let hole = ring(4.0).into_iter().rev().collect();
    let area = footprint(&TriangleMesh::from_polygons([[ring(10.0), hole]]));
    assert!((area.unsigned_area() - 84.0).abs() < 1e-6);
    assert_eq!(area.0[0].interiors().len(), 1);
    assert_rings_in_order(&area.0[0]);
}

#[test]
fn open_space_is_the_hull_less_the_footprints() {
    // Four towers at the corners of 100 x 100 m, a block in the middle: a hole in its tile.
    let towers = [[0.0, 0.0], [90.0, 0.0], [90.0, 90.0], [0.0, 90.0]];
    let size = DVec3::new(10.0, 10.0, 30.0);
    let mut sites: Vec<Site> = towers
        .map(|[x, y]| site(FAR + DVec3::new(x, y, 2.0), size, 0.0))
        .to_vec();
    sites.push(site(FAR + DVec3::new(60.0, 60.0, 3.0), size, 0.0));
    let streets = open_space(&sites, &ViewRegionOptions::default());
    assert!(
        (total(&streets) - 9500.0).abs() < 1e-3,
        "{}",
        total(&streets)
    );
    assert_eq!(streets.len(), 4);
    assert!(
        streets
            .iter()
            .any(|street| street.area.interiors().len() == 1)
    );
    streets
        .iter()
        .for_each(|street| assert_rings_in_order(&street.area));
    assert!(covers(&streets, 50.5, 1.0) && covers(&streets, 71.0, 65.0));
    assert!(!covers(&streets, 5.0, 5.0) && !covers(&streets, 65.0, 65.0));
    assert!(!covers(&streets, 101.0, 50.0));
    for street in streets {
        assert_eq!((street.eye_low, street.eye_high), (3.5, 5.0));
    }
}

#[test]
fn ground_follows_the_feet_nearby_without_outliers() {
    // A terrace of 20 houses at 1 m, a bridge at 8 m among them; far off, a village at 40 m.
    let size = DVec3::new(4.0, 8.0, 6.0);
    let at = |x: f64, z: f64| site(FAR + DVec3::new(x, 0.0, z), size, 0.0);
    let mut sites: Vec<Site> = (0..20).map(|i| at(f64::from(i) * 5.0, 1.0)).collect();
    sites.push(at(101.0, 8.0));
    sites.extend((0..3).map(|i| at(1000.0 + 5.0 * f64::from(i), 40.0)));
    sites.push(site(FAR + DVec3::new(500.0, 400.0, 20.0), size, 0.0));
    let streets = open_space(&sites, &ViewRegionOptions::default());
    let band = |x: f64, y: f64| {
        let point = Coord {
            x: FAR.x + x,
            y: FAR.y + y,
        };
        let street = streets.iter().find(|street| street.area.contains(&point));
        street
            .map(|street| (street.eye_low, street.eye_high))
            .expect("open space")
    };
    assert_eq!(band(49.0, 10.5), (2.5, 3.0));
    assert_eq!(band(1004.5, 4.0), (41.5, 42.0));
    // Nobody nearby: the nearest feet, whatever they are.
    let (low, high) = band(510.0, 210.0);
    assert!(low >= 2.5 && high >= 22.0, "{low} {high}");
}

#[test]
fn roads_are_joined_and_cut() {
    let strip = |y: f64, z: f64| {
        let ring = [[0.0, 0.0], [120.0, 0.0], [120.0, 6.0], [0.0, 6.0]]
            .map(|[dx, dy]| FAR + DVec3::new(dx, y + dy, z));
        TriangleMesh::from_polygons([[ring.to_vec()]])
    };
    let sites = [site(
        FAR + DVec3::new(20.0, 20.0, 1.0),
        DVec3::splat(10.0),
        0.0,
    )];
    // The second overlaps the first by half.
    let roads = [strip(10.0, 0.5), strip(13.0, 0.7), TriangleMesh::default()];
    let streets = streets_from_surfaces(&roads, &sites, &ViewRegionOptions::default());
    assert!((total(&streets) - 120.0 * 9.0).abs() < 1e-3);
    assert_eq!(streets.len(), 3);
    assert!(
        streets
            .iter()
            .all(|s| (s.eye_low, s.eye_high) == (2.5, 3.0))
    );
    streets
        .iter()
        .for_each(|street| assert_rings_in_order(&street.area));
    assert_eq!(
        streets_from_surfaces(&roads, &[], &ViewRegionOptions::default()),
        Vec::new()
    );
}

#[test]
fn slivers_are_dropped() {
    // Two houses 5 cm apart: nobody stands between them.
    let row = [[0.0, 10.0], [10.05, 20.0]].map(|x| Site {
        footprint: rectangle(x, [0.0, 10.0]),
        foot: 0.0,
    });
    assert_eq!(open_space(&row, &ViewRegionOptions::default()), Vec::new());
    let row = [[0.0, 9.0], [11.0, 20.0]].map(|x| Site {
        footprint: rectangle(x, [0.0, 10.0]),
        foot: 0.0,
    });
    assert!((total(&open_space(&row, &ViewRegionOptions::default())) - 20.0).abs() < 1e-6);
}

#[test]
fn hostile_input_is_survived() {
    let options = ViewRegionOptions::default();
    assert_eq!(open_space(&[], &options), Vec::new());
    let mut nan = rectangle([0.0, 10.0], [0.0, 10.0]);
    nan.0[0].exterior_mut(|ring| ring.0[2].x = f64::NAN);
    let sites = [
        Site {
            footprint: nan,
            foot: 0.0,
        },
        Site {
            footprint: rectangle([0.0, 10.0], [0.0, 10.0]),
            foot: f64::NAN,
        },
    ];
    assert_eq!(open_space(&sites, &options), Vec::new());
    // One stray feature 450 km away, and tiles that make no sense: the count stays bounded.
    let stray = [
        Site {
            footprint: rectangle([0.0, 10.0], [0.0, 10.0]),
            foot: 0.0,
        },
        Site {
            footprint: rectangle([-85_000.0, -84_999.0], [0.0, 1.0]),
            foot: 0.0,
        },
    ];
    for tile in [0.0, -5.0, f64::NAN, f64::INFINITY] {
        let streets = open_space(&stray, &ViewRegionOptions { tile, ..options });
        assert!(streets.len() <= 1002, "{} tiles of {tile}", streets.len());
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn a_point_is_open_or_built(
        houses in prop::collection::vec(
            ((0.0..150.0f64, 0.0..150.0f64, -2.0..2.0f64), (2.0..30.0f64, 2.0..30.0f64), 0.0..1.6f64),
            1..25,
        ),
        points in prop::collection::vec((0.0..170.0f64, 0.0..170.0f64), 40),
    ) {
        let sites: Vec<Site> = houses
            .iter()
            .map(|&(min, size, turn)| {
                site(FAR + DVec3::from(min), DVec3::new(size.0, size.1, 9.0), turn)
            })
            .collect();
        let streets = open_space(&sites, &ViewRegionOptions::default());
        for street in &streets {
            assert_rings_in_order(&street.area);
            prop_assert!(street.eye_low <= street.eye_high);
        }
        for (x, y) in points {
            // In a house by its own frame, at least `margin` from its walls.
            let within = |margin: f64| {
                houses.iter().any(|&((hx, hy, _), size, turn)| {
                    let (sin, cos) = turn.sin_cos();
                    let u = cos * (x - hx) + sin * (y - hy);
                    let v = cos * (y - hy) - sin * (x - hx);
                    u > margin && u < size.0 - margin && v > margin && v < size.1 - margin
                })
            };
            let open = covers(&streets, x, y);
            prop_assert!(!(open && within(0.01)), "open in a house at {x} {y}");
            // Neither open nor built: outside, in a sliver beside a house, or between two tiles.
            let lost = !open && !within(-1.0) && in_hull(&sites, x, y) && !near_tile_edge(x, y);
            prop_assert!(!lost, "lost at {x} {y}");
        }
    }
}

/// Whether the point is well within the hull: some corner lies 2 m beyond it in each direction.
fn in_hull(sites: &[Site], x: f64, y: f64) -> bool {
    let corners = || {
        sites
            .iter()
            .flat_map(|s| &s.footprint.0)
            .flat_map(|p| &p.exterior().0)
    };
    (0..720).all(|step| {
        let (sin, cos) = (f64::from(step) * std::f64::consts::TAU / 720.0).sin_cos();
        corners().any(|c| (c.x - FAR.x - x) * cos + (c.y - FAR.y - y) * sin > 2.0)
    })
}

/// Points on the line between two tiles belong to neither open polygon.
fn near_tile_edge(x: f64, y: f64) -> bool {
    [x, y]
        .iter()
        .any(|c| (c / 50.0 - (c / 50.0).round()).abs() < 1e-3)
}
