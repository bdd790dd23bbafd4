//! What the solver from a point costs and how much it returns too much, against rays through the
//! columns.
//!
//!     cargo run --release -p engine --example point_figures -- streets 100000 500
//!     cargo run --release -p engine --example point_figures -- FILE 0 500 [HEIGHT]

mod real_city;
mod tiled_city;

use std::collections::HashSet;
use std::f64::consts::TAU;
use std::time::Instant;

use engine::{
    Box3d, Extents, PointQuery, PointSolver, PointTarget, Roof, SolidColumn, TargetShape,
    TileFeature,
};
use glam::{DVec2, DVec3};
use tiled_city::{Tiles, Whole, tiles};

/// Observers that are timed, and how often the whole round is.
const EYES: usize = 1000;
const ROUNDS: usize = 5;

/// Observers whose answers are held against rays, and rays around each.
const JUDGED: usize = 12;
const RAYS: usize = 32_768;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |i: usize, usual: f64| {
        arguments
            .get(i)
            .map_or(usual, |text| text.parse().expect("a number"))
    };
    let city = arguments.first().map_or("streets", String::as_str);
    let Whole {
        features, streets, ..
    } = tiled_city::city(city, number(1, 100_000.0) as usize);
    let range = number(2, 500.0);
    let mut eyes = real_city::eyes(&streets, EYES);
    let height = number(3, 0.0);
    eyes.iter_mut().for_each(|eye| eye.z += height);
    let begun = Instant::now();
    let mut tiles = tiles(&features);
    println!(
        "{city}: {} features, {} tiles in {:.2} s, range {range} m, {height} m up",
        features.len(),
        tiles.tiles.len(),
        begun.elapsed().as_secs_f64()
    );
    let roofs: Vec<&Roof> = features.iter().filter_map(|f| f.roof.as_ref()).collect();
    println!(
        "{} roofs, {} of them hide, {} edges",
        roofs.len(),
        roofs.iter().filter(|roof| roof.hides).count(),
        roofs.iter().map(|roof| roof.edges.len()).sum::<usize>()
    );
    let mut solver = PointSolver::default();
    for prisms in [false, true] {
        let (time, returned) = timed(&eyes, |eye| {
            answer(&mut solver, &mut tiles, eye, range, prisms).len()
        });
        println!("prisms {prisms}: {time:.1} us a query, {returned:.1} returned");
    }
    directions(&eyes, range, &mut solver, &mut tiles);
    isovists(&eyes, range, &mut solver, &mut tiles);
    hiders(&features, &eyes, range, &mut solver, &mut tiles);
    // The rays know boxes, prisms and columns alone.
    let bare = |feature: TileFeature| TileFeature {
        roof: None,
        ..feature
    };
    let features: Vec<TileFeature> = features.into_iter().map(bare).collect();
    let mut tiles = self::tiles(&features);
    judge(&features, &eyes[..JUDGED], range, &mut solver, &mut tiles);
}

/// Runs all eyes several times; the least microseconds an eye, and the sum of what one round gives.
fn timed(eyes: &[DVec3], mut answer: impl FnMut(DVec3) -> usize) -> (f64, f64) {
    let mut best = f64::INFINITY;
    let mut sum = 0;
    for _ in 0..ROUNDS {
        let begun = Instant::now();
        sum = eyes.iter().map(|&eye| answer(eye)).sum();
        best = best.min(begun.elapsed().as_secs_f64());
    }
    let count = eyes.len() as f64;
    (best / count * 1e6, sum as f64 / count)
}

/// What the directions of all that is seen cost.
fn directions(eyes: &[DVec3], range: f64, solver: &mut PointSolver, tiles: &mut Tiles) {
    let mut extents = Extents::default();
    let mut seen = 0;
    let (time, ranges) = timed(eyes, |eye| {
        let query = PointQuery {
            eye,
            range,
            prisms: true,
            wedge: None,
        };
        let Ok(()) = solver.visible_extent(&query, tiles, &mut extents);
        seen += extents.len();
        extents.iter().map(|(_, ranges)| ranges.count()).sum()
    });
    let seen = seen as f64 / (ROUNDS * eyes.len()) as f64;
    println!("directions: {time:.1} us a query, {seen:.1} features, {ranges:.1} ranges");
}

/// What isovists cost.
fn isovists(eyes: &[DVec3], range: f64, solver: &mut PointSolver, tiles: &mut Tiles) {
    let mut corners = Vec::new();
    let (time, count) = timed(eyes, |eye| {
        let Ok(()) = solver.isovist(eye, range, tiles, &mut corners);
        corners.len()
    });
    println!("isovist: {time:.1} us a query, {count:.1} corners");
}

/// What it costs to find what hides one feature, any in range.
fn hiders(
    features: &[TileFeature],
    eyes: &[DVec3],
    range: f64,
    solver: &mut PointSolver,
    tiles: &mut Tiles,
) {
    let targets: Vec<&TileFeature> = eyes
        .iter()
        .enumerate()
        .map(|(at, &eye)| {
            let is_near = |f: &&TileFeature| f.envelope.distance_to_point(eye) <= range;
            let all = features.iter().cycle().skip(at * 7919 % features.len());
            all.take(features.len())
                .find(is_near)
                .unwrap_or(&features[0])
        })
        .collect();
    let (mut at, mut hidden) = (0, 0);
    let (time, count) = timed(eyes, |eye| {
        let target = targets[at % targets.len()];
        at += 1;
        let target = PointTarget {
            id: target.id,
            envelope: target.envelope,
            shape: TargetShape::Prism(&target.outline),
        };
        let Ok(hiders) = solver.hidden_by(eye, &target, tiles);
        hidden += usize::from(hiders.is_some());
        hiders.map_or(0, |hiders| hiders.len())
    });
    let share = hidden as f64 / at as f64;
    println!(
        "hidden by: {time:.1} us a query, {:.0} % hidden, by {:.2} features",
        share * 100.0,
        count / share
    );
}

fn answer(
    solver: &mut PointSolver,
    tiles: &mut Tiles,
    eye: DVec3,
    range: f64,
    prisms: bool,
) -> Vec<i64> {
    let mut seen = Vec::new();
    let query = PointQuery {
        eye,
        range,
        prisms,
        wedge: None,
    };
    let Ok(()) = solver.solve(&query, tiles, &mut seen);
    seen.iter()
        .map(|s| tiles.tiles[s.tile].feature(s.feature).0)
        .collect()
}

fn judge(
    features: &[TileFeature],
    eyes: &[DVec3],
    range: f64,
    solver: &mut PointSolver,
    tiles: &mut Tiles,
) {
    let mut totals = [[0usize; 3]; 2];
    let mut directions = [0usize; 3];
    let mut extents = Extents::default();
    for &eye in eyes {
        let near: Vec<&TileFeature> = features
            .iter()
            .filter(|f| f.envelope.distance_to_point(eye) <= range)
            .collect();
        for (prisms, total) in [false, true].into_iter().zip(&mut totals) {
            let rays = seen_by_rays(&near, eye, prisms);
            if prisms {
                let query = PointQuery {
                    eye,
                    range,
                    prisms,
                    wedge: None,
                };
                let Ok(()) = solver.visible_extent(&query, tiles, &mut extents);
                let said = rays_in_ranges(&extents, tiles);
                directions[0] += said.len();
                directions[1] += rays.len();
                directions[2] += rays.difference(&said).count();
            }
            let truth: HashSet<i64> = rays.into_iter().map(|(_, id)| id).collect();
            let answer: HashSet<i64> = answer(solver, tiles, eye, range, prisms)
                .into_iter()
                .collect();
            total[0] += answer.len();
            total[1] += truth.len();
            total[2] += truth.difference(&answer).count();
        }
    }
    let all = totals.into_iter().chain([directions]);
    for (name, [returned, visible, missed]) in ["box", "prism", "direction"].into_iter().zip(all) {
        println!(
            "{name} truth by {RAYS} rays, {} eyes: returned {returned}, visible {visible}, missed \
             {missed}, Q {:.4}",
            eyes.len(),
            (returned + missed) as f64 / visible as f64 - 1.0
        );
    }
}

/// Rays in the ranges of features, with the features.
fn rays_in_ranges(extents: &Extents, tiles: &Tiles) -> HashSet<(i64, i64)> {
    let mut found = HashSet::new();
    for (sighting, ranges) in extents.iter() {
        let (id, _) = tiles.tiles[sighting.tile].feature(sighting.feature);
        for range in ranges {
            // Rays are anticlockwise from +x, each in the middle of its share.
            let at = |azimuth: f64| (TAU / 4.0 - azimuth) / TAU * RAYS as f64 - 0.5;
            let rays = at(range.to).ceil() as i64..=at(range.from).floor() as i64;
            found.extend(rays.map(|ray| (ray.rem_euclid(RAYS as i64), id)));
        }
    }
    found
}

/// Rays that can see a feature's box or prism past the columns, with the features.
fn seen_by_rays(near: &[&TileFeature], eye: DVec3, prisms: bool) -> HashSet<(i64, i64)> {
    let mut by_ray: Vec<Vec<u32>> = vec![Vec::new(); RAYS];
    for (at, feature) in near.iter().enumerate() {
        let (middle, half) = azimuths(&feature.envelope, eye);
        let first = ((middle - half) / TAU * RAYS as f64).floor() as i64;
        let last = ((middle + half) / TAU * RAYS as f64).ceil() as i64;
        for ray in first..=last {
            by_ray[ray.rem_euclid(RAYS as i64) as usize].push(at as u32);
        }
    }
    let mut seen = HashSet::new();
    for (ray, items) in by_ray.iter().enumerate() {
        let angle = (ray as f64 + 0.5) / RAYS as f64 * TAU;
        let direction = DVec2::new(angle.cos(), angle.sin());
        // Distance from where a slope is blocked, slope, feature.
        let mut blocks: Vec<(f64, f64, u32)> = Vec::new();
        for &at in items {
            for column in near[at as usize].columns.iter().filter(|c| c.grounded) {
                let height = column.top - eye.z;
                for (distance, enters) in crossings(column, eye, direction) {
                    if enters == (height >= 0.0) {
                        blocks.push((distance, height / distance, at));
                    }
                }
            }
        }
        for &at in items {
            let feature = near[at as usize];
            let top = feature.envelope.max.z - eye.z;
            let Some((enter, leave)) = range_of(feature, eye, direction, prisms) else {
                continue;
            };
            let place = if top >= 0.0 { enter } else { leave };
            let slope = top / place.max(1e-9);
            let is_clear = blocks
                .iter()
                .all(|&(d, s, of)| of == at || d >= place || s <= slope);
            if is_clear {
                seen.insert((ray as i64, feature.id));
            }
        }
    }
    seen
}

/// Middle and half width of the azimuths of a box.
fn azimuths(bounds: &Box3d, eye: DVec3) -> (f64, f64) {
    let middle = (bounds.center() - eye).truncate();
    let nearest = eye.clamp(bounds.min, bounds.max) - eye;
    if nearest.truncate().length() < 1e-9 {
        return (0.0, TAU / 2.0);
    }
    let half = bounds
        .corners()
        .map(|corner| middle.angle_to((corner - eye).truncate()).abs());
    (middle.to_angle(), half.into_iter().fold(0.0, f64::max))
}

/// Where a ray crosses the rings of a column, and whether inwards.
fn crossings(column: &SolidColumn, eye: DVec3, direction: DVec2) -> Vec<(f64, bool)> {
    let mut found = Vec::new();
    let rings = std::iter::once(column.footprint.exterior()).chain(column.footprint.interiors());
    for line in rings.flat_map(|ring| ring.lines()) {
        let a = DVec2::new(line.start.x, line.start.y) - eye.truncate();
        let b = DVec2::new(line.end.x, line.end.y) - eye.truncate();
        let (side_a, side_b) = (direction.perp_dot(a), direction.perp_dot(b));
        if (side_a > 0.0) != (side_b > 0.0) {
            let point = a + (b - a) * (side_a / (side_a - side_b));
            let distance = point.dot(direction);
            if distance > 0.0 {
                found.push((distance, side_a > side_b));
            }
        }
    }
    found
}

fn range_of(
    feature: &TileFeature,
    eye: DVec3,
    direction: DVec2,
    prisms: bool,
) -> Option<(f64, f64)> {
    let bounds = &feature.envelope;
    let corners = if prisms && feature.outline.len() > 2 {
        feature.outline.clone()
    } else {
        let (min, max) = (bounds.min, bounds.max);
        vec![
            DVec2::new(min.x, min.y),
            DVec2::new(max.x, min.y),
            DVec2::new(max.x, max.y),
            DVec2::new(min.x, max.y),
        ]
    };
    let (mut enter, mut leave) = (0.0_f64, f64::INFINITY);
    for i in 0..corners.len() {
        let from = corners[i] - eye.truncate();
        let along = corners[(i + 1) % corners.len()] - corners[i];
        // Inside is to the left.
        let depth = along.perp_dot(-from);
        let rate = along.perp_dot(direction);
        if rate > 0.0 {
            enter = enter.max(-depth / rate);
        } else if rate < 0.0 {
            leave = leave.min(depth / -rate);
        } else if depth < 0.0 {
            return None;
        }
    }
    (enter < leave).then_some((enter, leave))
}
