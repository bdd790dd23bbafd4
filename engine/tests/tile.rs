//! Tiles as bytes, and which features share one.

use engine::{
    Box3d, CityFeature, CityLayout, PointQuery, PointSolver, Roof, Tile, TileFeature, TileSource,
    generated_city, neighbourhoods,
};
use glam::DVec3;
use proptest::prelude::*;
use std::convert::Infallible;

/// A city of houses, each with an outline.
fn city(features: usize) -> Vec<TileFeature> {
    let houses = generated_city(CityLayout::Blocks, features, 7);
    let feature = |(id, house): (i64, CityFeature)| TileFeature {
        id,
        envelope: house.envelope,
        outline: house.mesh.vertices.iter().map(|v| v.truncate()).collect(),
        roof: Roof::of(&house.mesh, &house.envelope),
        columns: vec![house.column],
    };
    (0..).zip(houses.features()).map(feature).collect()
}

/// A tile, and which of its features are out of date.
struct Source {
    tile: Tile,
    bounds: Vec<Box3d>,
    outdated: Option<i64>,
}

impl TileSource for Source {
    type Error = Infallible;

    fn bounds(&self) -> &[Box3d] {
        &self.bounds
    }

    fn tile(&mut self, _: usize) -> Result<&Tile, Infallible> {
        Ok(&self.tile)
    }

    fn is_outdated(&self, _: usize, feature: i64) -> bool {
        self.outdated == Some(feature)
    }
}

fn seen(tile: &Tile, eye: DVec3, outdated: Option<i64>) -> Vec<i64> {
    let mut source = Source {
        bounds: tile.bounds().into_iter().collect(),
        tile: tile.clone(),
        outdated,
    };
    let query = PointQuery {
        eye,
        range: 400.0,
        prisms: true,
        wedge: None,
    };
    let mut sightings = Vec::new();
    let Ok(()) = PointSolver::default().solve(&query, &mut source, &mut sightings);
    let mut ids: Vec<i64> = sightings
        .iter()
        .map(|s| tile.feature(s.feature).0)
        .collect();
    ids.sort_unstable();
    ids
}

fn middle(tile: &Tile) -> DVec3 {
    tile.bounds().unwrap().center().truncate().extend(1.7)
}

#[test]
fn a_tile_survives_as_bytes() {
    for features in [0, 1, 5, 200] {
        let tile = Tile::new(&city(features));
        let bytes = tile.to_bytes();
        let read = Tile::from_bytes(&bytes).unwrap();
        assert_eq!(read.to_bytes(), bytes);
        assert_eq!(read.bounds(), tile.bounds());
        if features > 0 {
            let eye = middle(&tile);
            assert_eq!(seen(&read, eye, None), seen(&tile, eye, None));
        }
    }
}

#[test]
fn coordinates_come_back_as_they_were_however_they_are_written() {
    // Millimetres in the frame of Delft, binary fractions, and what is neither.
    let millimetres = |at: f64| ((85_000.0 + at) * 1000.0).round() / 1000.0;
    let ways: [(&dyn Fn(f64) -> f64, bool); 3] = [
        (&millimetres, true),
        (&|at: f64| (at * 1024.0).round() / 1024.0 - 447_000.0, true),
        (&|at: f64| at * std::f64::consts::PI, false),
    ];
    for (way, is_short) in ways {
        let moved = |at: DVec3| at.map(way);
        let features: Vec<TileFeature> = city(100)
            .into_iter()
            .map(|feature| {
                let envelope = Box3d::new(moved(feature.envelope.min), moved(feature.envelope.max));
                let footprint = geo::Rect::new(
                    (envelope.min.x, envelope.min.y),
                    (envelope.max.x, envelope.max.y),
                );
                TileFeature {
                    envelope,
                    outline: vec![envelope.min.truncate(), envelope.max.truncate()],
                    roof: None,
                    columns: vec![engine::SolidColumn {
                        footprint: footprint.to_polygon(),
                        bottom: envelope.min.z,
                        top: envelope.max.z,
                        grounded: feature.id % 2 == 0,
                    }],
                    ..feature
                }
            })
            .collect();
        let tile = Tile::new(&features);
        let bytes = tile.to_bytes();
        let read = Tile::from_bytes(&bytes).unwrap();
        for position in 0..tile.len() {
            assert_eq!(read.feature(position), tile.feature(position));
        }
        assert_eq!(format!("{read:?}"), format!("{tile:?}"));
        assert_eq!(2 * bytes.len() < tile.size(), is_short);
    }
}

#[test]
fn a_gathered_tile_is_as_one_of_the_same_features() {
    let features = city(300);
    let halves = [
        Tile::new(&features[..120]),
        Tile::from_bytes(&Tile::new(&features[120..]).to_bytes()).unwrap(),
    ];
    let places = halves
        .iter()
        .flat_map(|tile| (0..tile.len()).map(move |position| (tile, position)));
    let wanted = |id: i64| id % 3 != 0;
    let picks: Vec<(&Tile, usize)> = places
        .filter(|(tile, position)| wanted(tile.feature(*position).0))
        .collect();
    let gathered = Tile::gathered(&picks);
    let same: Vec<TileFeature> = features.into_iter().filter(|f| wanted(f.id)).collect();
    let same = Tile::new(&same);
    assert_eq!(gathered.len(), same.len());
    assert_eq!(gathered.size(), same.size());
    let again = Tile::from_bytes(&gathered.to_bytes()).unwrap();
    assert_eq!(again.bounds(), same.bounds());
    for place in [DVec3::ZERO, DVec3::new(60.0, -45.0, 12.0)] {
        let eye = middle(&same) + place;
        assert_eq!(seen(&gathered, eye, None), seen(&same, eye, None));
    }
    assert!(Tile::gathered(&[]).is_empty());
}

#[test]
fn what_is_out_of_date_is_passed_over_and_hides_nothing() {
    let features = city(300);
    let tile = Tile::new(&features);
    let eye = middle(&tile);
    let all = seen(&tile, eye, None);
    let mut uncovered = 0;
    for &id in &all {
        let without: Vec<TileFeature> = features.iter().filter(|f| f.id != id).cloned().collect();
        let left = seen(&tile, eye, Some(id));
        assert_eq!(left, seen(&Tile::new(&without), eye, None));
        uncovered += usize::from(left.len() >= all.len());
    }
    assert!(uncovered > 0, "some feature hides another one");
}

#[test]
fn bytes_that_are_no_tile_are_told() {
    let bytes = Tile::new(&city(10)).to_bytes();
    let told = |bytes: &[u8]| Tile::from_bytes(bytes).unwrap_err().to_string();
    assert_eq!(told(&[]), "form 0 of a tile is not known");
    assert_eq!(told(&[9, 0, 0, 0]), "form 9 of a tile is not known");
    let short = &bytes[..bytes.len() - 1];
    let (found, expected) = (short.len(), bytes.len());
    assert_eq!(
        told(short),
        format!("a tile of {found} bytes should have {expected}")
    );
    let (at_layout, at_tree) = (4 + 7 * 4, 4 + 7 * 4 + 3 + 3 * 8);
    let real = usize::from(bytes[at_layout + 1]);
    let mut loose = bytes.clone();
    loose[at_tree..at_tree + real].fill(0xff);
    assert_eq!(told(&loose), "boxes of a tile are not in order");
    let mut circular = bytes.clone();
    circular[at_tree + 6 * real] = 0;
    assert_eq!(told(&circular), "nodes of a tile are not in order");
    for (at, byte) in [(0, 3), (1, 7), (2, 99), (10, 0x7f)] {
        let mut odd = bytes.clone();
        odd[at_layout + at] = byte;
        assert_eq!(told(&odd), "numbers of a tile are not in order");
    }
}

#[test]
fn neighbours_share_tiles_and_long_features_have_their_own() {
    let mut boxes: Vec<Box3d> = city(1000).iter().map(|feature| feature.envelope).collect();
    let wall = Box3d::new(DVec3::new(0.0, 0.0, 0.0), DVec3::new(900.0, 1.0, 3.0));
    boxes.extend([wall; 3]);
    let groups = neighbourhoods(&boxes, |_| 1, 64);
    let mut all: Vec<usize> = groups.concat();
    all.sort_unstable();
    assert_eq!(all, (0..boxes.len()).collect::<Vec<_>>());
    assert!(groups.contains(&vec![1000, 1001, 1002]));
    assert!(groups.iter().all(|group| group.len() <= 64));
    let weight = |at: usize| if at == 7 { 1000 } else { 1 };
    assert!(neighbourhoods(&boxes, weight, 64).contains(&vec![7]));
    let around = |group: &[usize]| group.iter().map(|&at| boxes[at]).reduce(|a, b| a.union(&b));
    let area = |bounds: Box3d| bounds.size().x * bounds.size().y;
    let usual = groups.iter().filter(|group| group[0] < 1000);
    let covered: f64 = usual.map(|group| area(around(group).unwrap())).sum();
    let city = around(&(0..1000).collect::<Vec<_>>()).unwrap();
    assert!(
        covered < 1.5 * area(city),
        "tiles of {covered} m² overlap much"
    );
    assert!(neighbourhoods(&[], |_| 1, 64).is_empty());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..Default::default() })]

    #[test]
    fn no_mutation_makes_a_tile_that_cannot_be_searched(
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..4),
    ) {
        let mut bytes = Tile::new(&city(20)).to_bytes();
        for (at, byte) in changes {
            let at = at.index(bytes.len());
            bytes[at] ^= byte;
        }
        if let Ok(tile) = Tile::from_bytes(&bytes) {
            let count = seen(&tile, middle(&tile), None).len();
            prop_assert!(count <= 20);
        }
    }
}
