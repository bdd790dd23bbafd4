//! What view cells cost, and how much more they hold than the answers from the points in them. A point's
//! answer is an over-estimate, too: it may hold what the set of its cell rightly does not.
//!
//!     cargo run --release -p engine --example cell_figures -- streets 20000 500
//!     cargo run --release -p engine --example cell_figures -- FILE 0 500 [FINEST]

mod real_city;
mod tiled_city;

use std::collections::HashSet;
use std::sync::Arc;
use std::time::Instant;

use engine::{
    Box3d, CellQuery, CellScene, CellSolver, CellTile, PointQuery, PointSolver, Surface,
    SurfaceTile, Surfaces, ViewRegion, neighbourhoods,
};
use glam::{DVec2, DVec3};
use tiled_city::{Tiles, Whole, tiles};

/// Cells of each size.
const CELLS: usize = 40;

/// Edges of cells, metres.
const EDGES: [f64; 3] = [4.0, 8.0, 16.0];

/// Metres between the points of a cell from which its set is compared, and where the first one is: not on
/// the grid on which houses are generated, whose walls would be seen exactly edge on.
const POINTS: f64 = 0.5;
const FIRST: DVec2 = DVec2::new(0.013_57, 0.007_11);

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |i: usize, usual: f64| {
        arguments
            .get(i)
            .map_or(usual, |text| text.parse().expect("a number"))
    };
    let city = arguments.first().map_or("streets", String::as_str);
    let Whole {
        mut features,
        surfaces,
        streets,
    } = tiled_city::city(city, number(1, 20_000.0) as usize);
    let surfaces = surface_tiles(surfaces);
    // Ridges are not eroded, so that points are to see past columns alone.
    for roof in features
        .iter_mut()
        .filter_map(|feature| feature.roof.as_mut())
    {
        roof.hides = false;
    }
    let (range, precision) = (number(2, 500.0), number(3, 0.25));
    let eyes = real_city::eyes(&streets, CELLS);
    let region = ViewRegion::new(streets);
    let mut tiles = tiles(&features);
    println!(
        "{city}: {} features, range {range} m, precision {precision} m",
        features.len()
    );
    for edge in EDGES {
        let cells: Vec<Box3d> = eyes.iter().map(|eye| cell(*eye, edge, &region)).collect();
        let around = cell_tiles(&tiles);
        let scene = |bounds: &Box3d| {
            let is_near = |tile: &&Arc<CellTile>| {
                let around = tile.tile().bounds();
                around.is_some_and(|around| around.distance(bounds) <= range)
            };
            CellScene::new(around.iter().filter(is_near).cloned().collect())
        };
        let scenes: Vec<CellScene> = cells.iter().map(scene).collect();
        let surfaces = |bounds: &Box3d| {
            let is_near = |tile: &&Arc<SurfaceTile>| {
                let around = tile.bounds();
                around.is_some_and(|around| around.distance(bounds) <= range)
            };
            Surfaces::new(surfaces.iter().filter(is_near).cloned().collect())
        };
        let mut solver = CellSolver::default();
        let is_open = |bounds: &Box3d| region.touches(bounds);
        let query = |bounds: &Box3d| CellQuery {
            bounds: *bounds,
            range,
            precision,
        };
        // The first round pays for erosions.
        let mut seconds = [0.0; 2];
        let (mut held, mut seen, mut beyond, mut solves) = (0, 0, 0, 0);
        let (mut proven, mut proving) = (0, 0.0);
        let mut worst = 0.0_f64;
        for round in [0, 1] {
            let begun = Instant::now();
            for (bounds, scene) in cells.iter().zip(&scenes) {
                solver.solve(scene, &query(bounds), &is_open, &|| false);
            }
            seconds[round] = begun.elapsed().as_secs_f64();
        }
        for (bounds, scene) in cells.iter().zip(&scenes) {
            let visible = solver
                .solve(scene, &query(bounds), &is_open, &|| false)
                .unwrap_or_default();
            solves += solver.solves;
            let surfaces = surfaces(bounds);
            let begun = Instant::now();
            let witnesses = solver
                .prove(
                    scene,
                    &surfaces,
                    &query(bounds),
                    &visible,
                    &is_open,
                    &|| false,
                )
                .expect("it is not cancelled");
            proving += begun.elapsed().as_secs_f64();
            proven += witnesses.iter().flatten().count();
            let set: HashSet<_> = visible
                .into_iter()
                .map(|seen| scene.feature(seen.feature).0)
                .collect();
            let is_eye = |eye: DVec3| region.touches(&Box3d::new(eye, eye)) && !scene.holds(eye);
            let points = from_points(bounds, range, &is_eye, &mut tiles);
            held += set.len();
            seen += points.len();
            beyond += points.difference(&set).count();
            worst = worst.max(set.len() as f64 / points.len() as f64);
        }
        let count = cells.len() as f64;
        println!(
            "{edge} m: {:.1} ms a cell, {:.1} ms with erosion, {:.0} solves, {:.1} held, {:.1} by points: \
             {:.3}, at worst {worst:.3}; {beyond} by points alone; {:.3} proven in {:.1} ms",
            seconds[1] / count * 1e3,
            seconds[0] / count * 1e3,
            solves as f64 / count,
            held as f64 / count,
            seen as f64 / count,
            held as f64 / seen as f64,
            proven as f64 / held as f64,
            proving / count * 1e3,
        );
    }
}

/// Surfaces by neighbourhood.
fn surface_tiles(surfaces: Vec<Surface>) -> Vec<Arc<SurfaceTile>> {
    let surface_box =
        |surface: &Surface| Box3d::around(surface.triangles.iter().flatten().copied());
    let boxes: Vec<Box3d> = surfaces
        .iter()
        .map(|surface| surface_box(surface).expect("a triangle"))
        .collect();
    let tile = |group: Vec<usize>| {
        let members = group.iter().map(|&at| surfaces[at].clone());
        Arc::new(SurfaceTile::new(members))
    };
    let groups = neighbourhoods(&boxes, |_| 1, tiled_city::MOST);
    groups.into_iter().map(tile).collect()
}

fn cell_tiles(tiles: &Tiles) -> Vec<Arc<CellTile>> {
    let tiles = tiles.tiles.iter();
    tiles
        .map(|tile| Arc::new(CellTile::new(tile.clone())))
        .collect()
}

/// The cell of a grid around an eye, as high as eyes are there.
fn cell(eye: DVec3, edge: f64, region: &ViewRegion) -> Box3d {
    let min = ((eye.truncate() / edge).floor() * edge).extend(0.0);
    let square = Box3d::new(min, min + DVec3::new(edge, edge, 0.0));
    region.filled(&square).expect("the eye is in a street")
}

/// What is seen from a grid of points.
fn from_points(
    bounds: &Box3d,
    range: f64,
    is_eye: &dyn Fn(DVec3) -> bool,
    tiles: &mut Tiles,
) -> HashSet<i64> {
    let mut solver = PointSolver::default();
    let mut seen = HashSet::new();
    let steps = (bounds.size().x / POINTS).round() as usize;
    let heights = [bounds.min.z, bounds.max.z];
    let heights = if heights[0] == heights[1] {
        &heights[..1]
    } else {
        &heights[..]
    };
    for (x, y) in (0..steps).flat_map(|x| (0..steps).map(move |y| (x, y))) {
        let place = bounds.min.truncate() + FIRST + DVec2::new(x as f64, y as f64) * POINTS;
        for z in heights {
            let eye = place.extend(*z);
            if !is_eye(eye) {
                continue;
            }
            let query = PointQuery {
                eye,
                range,
                prisms: true,
                wedge: None,
            };
            let mut sightings = Vec::new();
            let Ok(()) = solver.solve(&query, tiles, &mut sightings);
            seen.extend(
                sightings
                    .iter()
                    .map(|s| tiles.tiles[s.tile].feature(s.feature).0),
            );
        }
    }
    seen
}
