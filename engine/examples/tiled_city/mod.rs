//! A city, generated or real, in tiles as visibility is found from.

use engine::{
    Box3d, CityLayout, LocalGround, OuterPrism, Roof, Site, Street, Surface, Tile, TileFeature,
    TileSource, TriangleMesh, ViewRegionOptions, generated_city, neighbourhoods, open_space,
};
use formats::{ReadOptions, read_bytes};
use glam::{DVec2, DVec3};

use crate::real_city::{House, columns};

/// Features of one tile, at the most.
pub const MOST: usize = 64;

/// The features of a city in neighbourhoods.
pub struct Tiles {
    pub bounds: Vec<Box3d>,
    pub tiles: Vec<Tile>,
}

impl TileSource for Tiles {
    type Error = std::convert::Infallible;

    fn bounds(&self) -> &[Box3d] {
        &self.bounds
    }

    fn tile(&mut self, position: usize) -> Result<&Tile, Self::Error> {
        Ok(&self.tiles[position])
    }
}

pub fn tiles(features: &[TileFeature]) -> Tiles {
    let boxes: Vec<Box3d> = features.iter().map(|feature| feature.envelope).collect();
    let tile = |group: Vec<usize>| {
        let members: Vec<TileFeature> = group.iter().map(|&at| features[at].clone()).collect();
        Tile::new(&members)
    };
    let tiles: Vec<Tile> = neighbourhoods(&boxes, |_| 1, MOST)
        .into_iter()
        .map(tile)
        .collect();
    Tiles {
        bounds: tiles.iter().filter_map(Tile::bounds).collect(),
        tiles,
    }
}

/// A city before it is divided.
pub struct Whole {
    pub features: Vec<TileFeature>,
    #[allow(dead_code, reason = "not every example looks at surfaces")]
    pub surfaces: Vec<Surface>,
    pub streets: Vec<Street>,
}

/// That of a file, or "streets" with so many houses.
pub fn city(name: &str, count: usize) -> Whole {
    match name {
        "streets" => made(count),
        file => read(file),
    }
}

fn surface(mesh: &TriangleMesh, id: i64) -> Surface {
    Surface {
        id,
        triangles: mesh.corners().collect(),
    }
}

fn made(count: usize) -> Whole {
    let city = generated_city(CityLayout::Streets, count, 1);
    let features = city
        .features()
        .zip(0..)
        .map(|(feature, id)| TileFeature {
            id,
            envelope: feature.envelope,
            outline: outline(feature.mesh.vertices.iter().copied()),
            roof: Roof::of(&feature.mesh, &feature.envelope),
            columns: vec![feature.column],
        })
        .collect();
    let meshes = city.features().map(|feature| feature.mesh);
    let surfaces = meshes.zip(0..).map(|(mesh, id)| surface(&mesh, id));
    Whole {
        features,
        surfaces: surfaces.collect(),
        streets: city.streets().collect(),
    }
}

fn outline(points: impl Iterator<Item = DVec3>) -> Vec<DVec2> {
    OuterPrism::around(points).map_or(Vec::new(), |prism| prism.hull)
}

fn read(file: &str) -> Whole {
    let bytes = std::fs::read(file).expect("a readable file");
    let scene = read_bytes(file, &bytes, &ReadOptions::default()).expect("a city model");
    let houses: Vec<House> = scene.features.iter().map(House::of).collect();
    let envelopes: Vec<Box3d> = houses.iter().map(|house| house.envelope()).collect();
    let ground = LocalGround::new(&envelopes);
    let sites: Vec<Site> = houses.iter().map(House::site).collect();
    let feature = |(house, id): (&House, i64)| TileFeature {
        id,
        envelope: house.envelope(),
        outline: outline(house.points.iter().copied()),
        roof: Roof::of(&house.mesh, &house.envelope()),
        columns: columns(
            house,
            ground.holds(&house.envelope(), house.envelope().min.z),
        ),
    };
    let surfaces = houses.iter().zip(0..);
    Whole {
        features: houses.iter().zip(0..).map(feature).collect(),
        surfaces: surfaces
            .map(|(house, id)| surface(&house.mesh, id))
            .collect(),
        streets: open_space(&sites, &ViewRegionOptions::default()),
    }
}
