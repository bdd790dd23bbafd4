//! Generated cities: what is promised of every feature and street, over seeds and layouts.

use std::collections::HashSet;

use engine::{Box3d, CityFeature, CityLayout, Closedness, Street, generated_city, scattered_city};
use geo::{Area, BooleanOps, BoundingRect, Contains, Coord, Distance, Euclidean, Intersects, Line};
use geo::{LinesIter, Point, Polygon, Validation};
use glam::{DVec2, DVec3};
use proptest::prelude::*;

/// Square metres by which polygons may overlap in the sum of a computed intersection, whose
/// vertices are rounded to a grid of some micrometres.
const TINY: f64 = 1e-3;

const BUILT: [CityLayout; 2] = [CityLayout::Blocks, CityLayout::Streets];

fn built_layout() -> impl Strategy<Value = CityLayout> {
    prop::sample::select(&BUILT[..])
}

fn features(layout: CityLayout, count: usize, seed: u64) -> Vec<CityFeature> {
    generated_city(layout, count, seed).features().collect()
}

/// The bits of a number, by which "the same" is meant.
fn bits(point: DVec3) -> [u64; 3] {
    point.to_array().map(f64::to_bits)
}

fn near(a: &Polygon<f64>, b: &Polygon<f64>) -> bool {
    let rectangles = a.bounding_rect().zip(b.bounding_rect());
    rectangles.is_some_and(|(a, b)| a.intersects(&b))
}

fn overlap(a: &Polygon<f64>, b: &Polygon<f64>) -> f64 {
    if near(a, b) {
        a.intersection(b).unsigned_area()
    } else {
        0.0
    }
}

/// Whether the point is on the segment, decided without rounding: lattice coordinates and their
/// products are exact in f64.
fn is_on(point: Coord, segment: &Line) -> bool {
    let cross = (segment.end.x - segment.start.x) * (point.y - segment.start.y)
        - (segment.end.y - segment.start.y) * (point.x - segment.start.x);
    let between = |p: f64, a: f64, b: f64| a.min(b) <= p && p <= a.max(b);
    cross == 0.0
        && between(point.x, segment.start.x, segment.end.x)
        && between(point.y, segment.start.y, segment.end.y)
}

fn assert_closed_and_outward(feature: &CityFeature) {
    let mesh = &feature.mesh;
    assert_eq!(mesh.closedness(), Closedness::Closed);
    assert_eq!(mesh.untriangulable_faces, 0);
    assert!(mesh.signed_volume() > 0.0);
    assert_eq!(mesh.envelope(), Some(feature.envelope));
    let different: HashSet<_> = mesh.vertices.iter().map(|&v| bits(v)).collect();
    assert_eq!(different.len(), mesh.vertices.len());
    let on_lattice = |p: &DVec3| (*p * 2048.0).fract() == DVec3::ZERO;
    assert!(mesh.vertices.iter().all(on_lattice));
}

/// Under the eaves, in the column and in the solid are the same; so is, there, in the inner box.
fn assert_column_is_the_solid(feature: &CityFeature) {
    let column = &feature.column;
    assert!(column.grounded && column.bottom == 0.0 && feature.envelope.min.z == 0.0);
    assert!(column.footprint.is_valid());
    let around = feature.envelope.expanded(1.0).expect("it grows");
    for step in 1..60_u32 {
        let share = |prime: f64| (f64::from(step) * prime).fract();
        let at = around.min + around.size() * DVec3::new(share(0.754_877), share(0.569_840), 0.0);
        let plan = Point::new(at.x, at.y);
        if column
            .footprint
            .exterior()
            .lines()
            .any(|l| Euclidean.distance(&l, &plan) < 1e-3)
        {
            continue;
        }
        let inside = column.footprint.contains(&plan);
        for z in [0.001, 0.5, 0.999].map(|share| share * column.top) {
            let winding = feature.mesh.winding_number(at.with_z(z));
            assert!(
                (winding - f64::from(u8::from(inside))).abs() < 1e-3,
                "{at} {z}: {winding}"
            );
        }
    }
}

fn assert_box_is_inside(feature: &CityFeature) {
    let Box3d { min, max } = feature.inner_envelope;
    assert!(min.z == 0.0 && max.z == feature.column.top);
    assert!((max - min).min_element() > 2.0);
    let plan = geo::Rect::new(Coord { x: min.x, y: min.y }, Coord { x: max.x, y: max.y });
    // Neither a corner of the box outside nor a vertex of the footprint within: they do not cross.
    let edges = || feature.column.footprint.lines_iter();
    for corner in plan.to_polygon().exterior().points() {
        let on_edge = edges().any(|edge| is_on(corner.0, &edge));
        assert!(on_edge || feature.column.footprint.contains(&corner));
    }
    for edge in edges() {
        assert!(
            !plan.contains(&edge.start_point()),
            "{:?}",
            feature.inner_envelope
        );
    }
    let outside = plan.unsigned_area() - overlap(&plan.to_polygon(), &feature.column.footprint);
    assert!(outside.abs() < TINY, "{outside}");
}

fn assert_apart(features: &[CityFeature], streets: &[Street]) {
    for (i, one) in features.iter().enumerate() {
        let ground = &one.column.footprint;
        for other in &features[..i] {
            assert!(overlap(ground, &other.column.footprint) < TINY);
        }
        for street in streets {
            assert!(
                overlap(ground, &street.area) < TINY,
                "{ground:?} {:?}",
                street.area
            );
        }
    }
    for (i, one) in streets.iter().enumerate() {
        assert!(one.area.is_valid(), "{:?}", one.area);
        for other in &streets[..i] {
            assert!(overlap(&one.area, &other.area) < TINY);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn features_are_solid_as_described(seed: u64, layout in built_layout(), count in 1usize..150) {
        let features = features(layout, count, seed);
        prop_assert_eq!(features.len(), count);
        for feature in &features {
            assert_closed_and_outward(feature);
            assert_column_is_the_solid(feature);
            assert_box_is_inside(feature);
            prop_assert!((6.0..=40.0).contains(&feature.envelope.max.z));
            prop_assert_eq!(feature.class, "Building");
        }
    }

    #[test]
    fn nothing_overlaps(seed: u64, layout in built_layout(), count in 1usize..300) {
        let city = generated_city(layout, count, seed);
        let features: Vec<CityFeature> = city.features().collect();
        assert_apart(&features, &city.streets().collect::<Vec<_>>());
    }

    #[test]
    fn a_smaller_city_is_the_beginning(seed: u64, layout in prop::sample::select(&CityLayout::ALL[..]),
                                       count in 0usize..400) {
        let larger = generated_city(layout, 400, seed);
        let smaller = features(layout, count, seed);
        prop_assert_eq!(smaller.len(), count);
        prop_assert!(larger.features().zip(&smaller).all(|(a, b)| a == *b));
        let parts: Vec<CityFeature> = (0..400).flat_map(|part| larger.features_of(part..part + 1)).take(400).collect();
        prop_assert!(larger.features().eq(parts));
    }
}

#[test]
fn row_houses_stand_flush_with_a_street() {
    let city = generated_city(CityLayout::Streets, 1500, 11);
    let streets: Vec<Street> = city.streets().collect();
    for house in city.features().filter(|f| f.kind == "house") {
        let front: Vec<Coord> = house
            .column
            .footprint
            .exterior()
            .coords()
            .take(2)
            .copied()
            .collect();
        let flush = |edge: Line| front.iter().all(|&corner| is_on(corner, &edge));
        assert!(
            streets.iter().any(|s| s.area.lines_iter().any(flush)),
            "{front:?}"
        );
        let width = distance(front[0], front[1]);
        let depth = distance(front[1], house.column.footprint.exterior().0[2]);
        assert!(
            (5.0..=12.0).contains(&width) && (8.0..=14.0).contains(&depth),
            "{width} {depth}"
        );
    }
}

fn distance(a: Coord, b: Coord) -> f64 {
    DVec2::new(b.x - a.x, b.y - a.y).length()
}

#[test]
fn neighbours_share_their_walls_bit_for_bit() {
    for layout in BUILT {
        let features = features(layout, 2000, 5);
        let shared = |pair: &&[CityFeature]| {
            let of_one: HashSet<_> = pair[0].mesh.vertices.iter().map(|&v| bits(v)).collect();
            let same = pair[1]
                .mesh
                .vertices
                .iter()
                .filter(|&&v| of_one.contains(&bits(v)));
            // Both ends of the wall on the ground, and none or more above.
            same.filter(|v| v.z == 0.0).count() == 2
        };
        let count = features.windows(2).filter(shared).count();
        assert!(count > 1000, "{layout:?}: {count}");
    }
}

#[test]
fn blocks_have_buildings_of_every_shape() {
    let features = features(CityLayout::Blocks, 3000, 1);
    let corners = |f: &CityFeature| f.column.footprint.exterior().0.len() - 1;
    for count in [4, 6, 8] {
        let same = features.iter().filter(|f| corners(f) == count).count();
        assert!(same > 40, "{count}: {same}");
    }
    let closed = features
        .iter()
        .filter(|f| !f.column.footprint.interiors().is_empty())
        .count();
    assert!(closed > 10, "{closed}");
    assert!(features.iter().any(|f| f.envelope.max.z < 8.0));
    assert!(features.iter().any(|f| f.envelope.max.z > 38.0));
}

#[test]
fn streets_run_in_all_directions() {
    let features = features(CityLayout::Streets, 20_000, 3);
    let mut seen = [0; 18];
    for house in &features {
        let ring = &house.column.footprint.exterior().0;
        let turned = (ring[1].y - ring[0].y)
            .atan2(ring[1].x - ring[0].x)
            .to_degrees();
        seen[(turned.rem_euclid(90.0) / 5.0) as usize % 18] += 1;
    }
    // All but some of the directions between those of the grid and its diagonals.
    let used = seen.iter().filter(|&&count| count > 20).count();
    assert!(used >= 12, "{seen:?}");
}

#[test]
fn squares_go_around_their_towers() {
    let streets = generated_city(CityLayout::Streets, 20_000, 3).streets();
    let with_tower = streets.filter(|s| !s.area.interiors().is_empty());
    assert!(with_tower.count() > 5);
}

#[test]
fn a_city_without_features_has_streets() {
    for layout in CityLayout::ALL {
        let city = generated_city(layout, 0, 1);
        assert_eq!(city.features().count(), 0);
        assert!(city.streets().count() > 0, "{layout:?}");
    }
}

#[test]
fn the_scattered_city_is_that_of_the_report() {
    let city = scattered_city(326, 1);
    let generated = generated_city(CityLayout::Scattered, 326, 1);
    assert!(generated.streets().eq(city.streets));
    let features: Vec<CityFeature> = generated.features().collect();
    assert_eq!(features.len(), 326);
    for (feature, &bounds) in features.iter().zip(&city.boxes) {
        assert_eq!(feature.envelope, bounds);
        assert_eq!(feature.inner_envelope, bounds);
        assert_eq!(feature.mesh.closedness(), Closedness::Closed);
        assert!((feature.mesh.signed_volume() / bounds.volume() - 1.0).abs() < 1e-9);
        let area = feature.column.footprint.unsigned_area();
        assert!((area / (bounds.size().x * bounds.size().y) - 1.0).abs() < 1e-9);
    }
}

/// The bits of all coordinates of a polygon.
fn plan_bits(polygon: &Polygon<f64>) -> impl Iterator<Item = u64> {
    let rings = std::iter::once(polygon.exterior()).chain(polygon.interiors());
    rings.flat_map(|ring| ring.coords().flat_map(|c| [c.x.to_bits(), c.y.to_bits()]))
}

/// Fowler, Noll and Vo's hash, 64 bits, over all bits of a city.
fn fingerprint(layout: CityLayout, count: usize, seed: u64) -> u64 {
    let city = generated_city(layout, count, seed);
    let mut hash = 0xCBF2_9CE4_8422_2325_u64;
    let mut add = |number: u64| {
        for byte in number.to_le_bytes() {
            hash = (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01B3);
        }
    };
    for feature in city.features() {
        let corners = [feature.inner_envelope.min, feature.inner_envelope.max];
        for point in feature.mesh.vertices.iter().chain(&corners) {
            bits(*point).into_iter().for_each(&mut add);
        }
        for triangle in &feature.mesh.triangles {
            triangle.iter().for_each(|&number| add(u64::from(number)));
        }
        plan_bits(&feature.column.footprint).for_each(&mut add);
        add(feature.column.top.to_bits());
    }
    for street in city.streets() {
        plan_bits(&street.area).for_each(&mut add);
        add(street.eye_high.to_bits());
    }
    hash
}

/// The same in debug and release builds, on every machine and with every compiler.
#[test]
fn seeds_mean_the_same_cities_forever() {
    let found = [
        fingerprint(CityLayout::Scattered, 326, 1),
        fingerprint(CityLayout::Blocks, 1000, 1),
        fingerprint(CityLayout::Blocks, 333, u64::MAX),
        fingerprint(CityLayout::Streets, 1000, 1),
        fingerprint(CityLayout::Streets, 333, u64::MAX),
    ];
    let known = [
        0x40C4_884E_648F_7B6D,
        0x0242_A98F_41B6_01E0,
        0x542E_1A1C_84A5_9057,
        0x38B2_663B_D7D3_FF05,
        0xD324_E782_703C_889D,
    ];
    assert_eq!(found, known, "{found:#018X?}");
}
