//! [`Window`], the part of a scene in which cells are measured.

use std::collections::HashSet;
use std::sync::Arc;

use engine::{
    Box3d, CellScene, CellTile, Roof, SolidColumn, Street, Tile, TileFeature, TriangleMesh,
    ViewRegion, neighbourhoods,
};
use fastrand::Rng;
use geo::Orient;
use geo::orient::Direction;
use glam::{DVec2, DVec3};
use postgres::Client;

use crate::bench::surroundings::Surroundings;
use crate::database::quoted;
use crate::failure::Failure;
use crate::scene::{self, Feature};
use crate::sql_types;

/// Features of one tile, at the most.
const MOST: usize = 64;

/// How often a place is sought for each one that is wanted.
const TRIES: usize = 10_000;

/// A square in the middle of a scene, and what is around it.
pub struct Window {
    square: Box3d,
    /// Features in range of the window, and those that may hide them.
    pub around: Surroundings,
    /// The streets of the window.
    pub region: ViewRegion,
    /// All that is around in tiles, not eroded.
    pub tiles: Vec<Tile>,
    solids: CellScene,
}

impl Window {
    /// Reads a window with edges of so many metres; `margin` metres around it cells may reach.
    pub fn load(
        client: &mut Client,
        scene: &str,
        edge: f64,
        margin: f64,
        range: f64,
    ) -> Result<Self, Failure> {
        let square = square(client, scene, edge)?;
        let place = Box3d {
            min: square.min - margin,
            max: square.max + margin,
        };
        let place = sql_types::Box3d::from(place);
        let streets = scene::streets_over(client, scene, place)?;
        let street = |street: scene::Street| Street {
            area: street.area.orient(Direction::Default),
            eye_low: street.eye_low,
            eye_high: street.eye_high,
        };
        let region = ViewRegion::new(streets.into_iter().map(street).collect());
        let around = Surroundings::load(client, scene, &place, range)?;
        let tiles = tiles(&around.features);
        let solids = tiles.iter().cloned().map(CellTile::new).map(Arc::new);
        let window = Self {
            square,
            around,
            region,
            solids: CellScene::new(solids.collect()),
            tiles,
        };
        if window.eyes(1, &mut Rng::with_seed(0)).is_empty() {
            return Err(Failure::Unready(format!(
                "scene \"{scene}\" has no streets within {edge} m around its middle\n  \
                 hint: a larger --window, or streets"
            )));
        }
        Ok(window)
    }

    /// Its middle, as high as eyes are somewhere.
    #[cfg(feature = "embree")]
    pub fn middle(&self) -> DVec3 {
        let heights = self.region.streets().first();
        let z = heights.map_or(0.0, |street| street.eye_high);
        self.square.center().with_z(z)
    }

    /// Different cells with edges of so many metres, each around a random place of the streets.
    pub fn cells(&self, edge: f64, count: usize, rng: &mut Rng) -> Vec<Box3d> {
        let mut taken = HashSet::new();
        let mut cells = Vec::new();
        for _ in 0..TRIES * count {
            if cells.len() == count {
                break;
            }
            let Some(eye) = self.try_eye(rng) else {
                continue;
            };
            let corner = (eye.truncate() / edge).floor();
            if taken.insert([corner.x as i64, corner.y as i64]) {
                cells.extend(self.cell(corner, edge));
            }
        }
        cells
    }

    /// Random places in the streets.
    pub fn eyes(&self, count: usize, rng: &mut Rng) -> Vec<DVec3> {
        let tries = 0..TRIES * count;
        let found = tries.filter_map(|_| self.try_eye(rng));
        found.take(count).collect()
    }

    /// How many cells with edges of so many metres cover the streets of the window.
    pub fn count(&self, edge: f64) -> usize {
        let [low, high] = [self.square.min, self.square.max].map(|corner| corner / edge);
        let places = |axis: usize| low[axis].floor() as i64..high[axis].ceil() as i64;
        let rows = places(1).flat_map(|y| places(0).map(move |x| DVec2::new(x as f64, y as f64)));
        rows.filter_map(|corner| self.cell(corner, edge)).count()
    }

    /// A grid of eyes in a cell, from border to border or so far inside it, at some heights: so many steps along each
    /// side, less where no eye may be.
    pub fn eyes_in(
        &self,
        cell: &Box3d,
        steps: usize,
        inside: DVec2,
        heights: &[f64],
    ) -> Vec<DVec3> {
        let (low, high) = (cell.min.truncate() + inside, cell.max.truncate() - inside);
        let at = |step: usize| step as f64 / steps as f64;
        let places = (0..=steps).flat_map(|y| (0..=steps).map(move |x| DVec2::new(at(x), at(y))));
        let eyes = places.flat_map(|share| {
            let place = low + share * (high - low);
            heights.iter().map(move |&z| place.extend(z))
        });
        let is_eye =
            |eye: &DVec3| self.region.touches(&Box3d::new(*eye, *eye)) && !self.solids.holds(*eye);
        eyes.filter(is_eye).collect()
    }

    /// The cell of a grid that begins at so many edges, as high as eyes are there.
    fn cell(&self, corner: DVec2, edge: f64) -> Option<Box3d> {
        let (min, max) = (corner * edge, (corner + 1.0) * edge);
        let square = Box3d::new(min.extend(0.0), max.extend(0.0));
        self.region.filled(&square)
    }

    /// A random place of the window, if eyes may be there.
    fn try_eye(&self, rng: &mut Rng) -> Option<DVec3> {
        let size = self.square.size();
        let place = self.square.min + DVec3::new(rng.f64(), rng.f64(), 0.0) * size;
        let bounds = self.region.filled(&Box3d::new(place, place))?;
        Some(place.with_z(bounds.center().z))
    }
}

/// Features in tiles.
fn tiles(features: &[Feature]) -> Vec<Tile> {
    let features: Vec<TileFeature> = features.iter().map(tile_feature).collect();
    let boxes: Vec<Box3d> = features.iter().map(|feature| feature.envelope).collect();
    let tile = |group: Vec<usize>| {
        let members: Vec<TileFeature> = group.iter().map(|&at| features[at].clone()).collect();
        Tile::new(&members)
    };
    let groups = neighbourhoods(&boxes, |_| 1, MOST);
    groups.into_iter().map(tile).collect()
}

/// The square in the middle of all features.
fn square(client: &mut Client, scene: &str, edge: f64) -> Result<Box3d, Failure> {
    client.execute("SELECT occlusion.require_scene($1)", &[&scene])?;
    let statement = format!(
        "SELECT occlusion.extent(envelope) FROM {}.feature",
        quoted(scene)
    );
    let extent: Option<sql_types::Box3d> = client.query_one(&statement, &[])?.get(0);
    let extent = extent.ok_or_else(|| Failure::Unready(format!("scene \"{scene}\" is empty")))?;
    let middle = Box3d::from(extent).center();
    let half = DVec3::new(edge, edge, 0.0) * 0.5;
    Ok(Box3d::new(middle - half, middle + half))
}

/// A feature as the database packs it into tiles, but for ridges, which do not hide here: they are not
/// eroded, and points are to see past what cells see past.
fn tile_feature(feature: &Feature) -> TileFeature {
    let envelope = Box3d::from(feature.envelope);
    let mesh = feature
        .mesh
        .as_ref()
        .and_then(|mesh| mesh.corners())
        .map(|triangles| {
            TriangleMesh::from_triangles(
                triangles
                    .into_iter()
                    .map(|corners| corners.map(DVec3::from)),
            )
        });
    let roof = mesh.as_ref().and_then(|mesh| Roof::of(mesh, &envelope));
    let outline = mesh.map_or(Vec::new(), |mesh| {
        mesh.vertices.iter().map(|v| v.truncate()).collect()
    });
    TileFeature {
        id: feature.id,
        envelope,
        outline,
        roof: roof.map(|roof| Roof {
            hides: false,
            ..roof
        }),
        columns: columns(feature),
    }
}

/// What hides in a feature: its columns, or its inner envelope where none is grounded.
fn columns(feature: &Feature) -> Vec<SolidColumn> {
    let upright = |column: SolidColumn| SolidColumn {
        footprint: column.footprint.orient(Direction::Default),
        ..column
    };
    let is_grounded = feature.columns.iter().any(|column| column.grounded);
    let solids = feature.solids().take(match is_grounded {
        true => feature.columns.len(),
        false => usize::MAX,
    });
    solids.map(upright).collect()
}
