//! How much single convex occluders hide in a real city: inner envelopes against convex pieces of
//! solid columns.
//!
//!     cargo run --release -p engine --example piece_figures -- FILE [PIECES [SHARE [WORTH]]]

mod real_city;

use std::collections::HashSet;
use std::time::Instant;

use engine::{
    Box3d, ConvexPieceOptions, ConvexPrism, InnerEnvelope, LocalGround, Occluder, Site,
    SolidColumn, Street, ViewRegionOptions, VolumeOptions, VolumeSolver, convex_pieces,
    inner_envelope, open_space,
};
use formats::{ReadOptions, read_bytes};
use glam::{DVec2, DVec3};
use real_city::{House, columns, eyes};

/// As in docs/benchmarks.md.
const SMALLEST: f64 = 2.0;
const RANGE: f64 = 500.0;

const EYES: usize = 200;

/// Prisms stand on the ground or end here.
const FAR_BELOW: f64 = -1e6;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let file = arguments.first().expect("name a file");
    let number = |i: usize| {
        arguments
            .get(i)
            .map(|text| text.parse::<f64>().expect("a number"))
    };
    let usual = ConvexPieceOptions::default();
    let options = ConvexPieceOptions {
        most: number(1).map_or(usual.most, |most| most as usize),
        least_share: number(2).unwrap_or(usual.least_share),
    };
    let bytes = std::fs::read(file).expect("a readable file");
    let scene = read_bytes(file, &bytes, &ReadOptions::default()).expect("a city model");
    let houses: Vec<House> = scene.features.iter().map(House::of).collect();
    let envelopes: Vec<Box3d> = houses.iter().map(|house| house.envelope()).collect();
    let ground = LocalGround::new(&envelopes);
    let sites: Vec<Site> = houses.iter().map(House::site).collect();
    let streets = open_space(&sites, &ViewRegionOptions::default());
    let eyes = eyes(&streets, EYES);
    let volumes = VolumeOptions {
        smallest: SMALLEST,
        worth: number(3).unwrap_or(VolumeOptions::usual_worth(SMALLEST, &streets)),
        range: Some(RANGE),
    };
    println!(
        "{} features, {} streets, {volumes:?}, {options:?}",
        houses.len(),
        streets.len()
    );
    let stands = |house: &House| ground.holds(&house.envelope(), house.envelope().min.z);
    let boxes = houses.iter().map(|house| {
        let inner = inner_envelope(&house.mesh).ok();
        let grounded = |inner: &InnerEnvelope| inner.grounded && stands(house);
        let prism = inner.and_then(|inner| ConvexPrism::from_box(&inner.bounds, grounded(&inner)));
        Vec::from_iter(prism)
    });
    let boxes = occluders(boxes);
    report(
        "inner envelopes",
        &boxes,
        &envelopes,
        &streets,
        &eyes,
        volumes,
    );
    let columns: Vec<Vec<SolidColumn>> = houses
        .iter()
        .map(|house| columns(house, stands(house)))
        .collect();
    let begun = Instant::now();
    let pieces: Vec<Vec<ConvexPrism>> = columns
        .iter()
        .map(|columns| convex_pieces(columns, &options))
        .collect();
    let count: usize = columns.iter().map(Vec::len).sum();
    println!(
        "{count} columns to pieces: {:.2} s",
        begun.elapsed().as_secs_f64()
    );
    let pieces = occluders(pieces);
    report(
        "convex pieces",
        &pieces,
        &envelopes,
        &streets,
        &eyes,
        volumes,
    );
}

/// Numbers features in turn.
fn occluders(prisms: impl IntoIterator<Item = Vec<ConvexPrism>>) -> Vec<Occluder> {
    let of = |(feature, prisms): (usize, Vec<ConvexPrism>)| {
        let feature = feature as i64;
        prisms
            .into_iter()
            .map(move |prism| Occluder { feature, prism })
    };
    prisms.into_iter().enumerate().flat_map(of).collect()
}

fn report(
    name: &str,
    occluders: &[Occluder],
    envelopes: &[Box3d],
    streets: &[Street],
    eyes: &[DVec3],
    options: VolumeOptions,
) {
    let limit = hidden_by_single(occluders, envelopes, eyes);
    let begun = Instant::now();
    let solver = VolumeSolver::new(occluders.to_vec(), streets, options);
    let (mut count, mut found, mut false_ones) = (0, 0, 0);
    for (feature, envelope) in envelopes.iter().enumerate() {
        let volumes = solver
            .volumes(feature as i64, envelope, || false)
            .expect("not cancelled");
        count += volumes.len();
        for (i, eye) in eyes.iter().enumerate() {
            if in_range(*eye, envelope) && volumes.iter().any(|v| v.bounds.contains_point(*eye)) {
                found += 1;
                false_ones += usize::from(!limit.contains(&(i, feature)));
            }
        }
    }
    let seconds = begun.elapsed().as_secs_f64();
    let pairs: usize = eyes
        .iter()
        .map(|eye| envelopes.iter().filter(|e| in_range(*eye, e)).count())
        .sum();
    let share = |part: usize| part as f64 / pairs as f64 * 100.0;
    println!(
        "{name}: {} occluders; of {pairs} pairs single ones hide {:.2} %, volumes {:.2} % \
         ({false_ones} falsely); {count} volumes, {seconds:.1} s",
        occluders.len(),
        share(limit.len()),
        share(found),
    );
}

fn in_range(eye: DVec3, envelope: &Box3d) -> bool {
    envelope.distance_to_point(eye) <= RANGE
}

/// Pairs of eye and feature such that one prism of another feature hides the whole envelope.
fn hidden_by_single(
    occluders: &[Occluder],
    envelopes: &[Box3d],
    eyes: &[DVec3],
) -> HashSet<(usize, usize)> {
    let mut hidden = HashSet::new();
    let bounds: Vec<Box3d> = occluders
        .iter()
        .map(|occluder| {
            let mut bounds = occluder.prism.envelope();
            if occluder.prism.grounded() {
                bounds.min.z = FAR_BELOW;
            }
            bounds
        })
        .collect();
    for (i, eye) in eyes.iter().enumerate() {
        for (feature, envelope) in envelopes.iter().enumerate() {
            if !in_range(*eye, envelope) {
                continue;
            }
            let corners = envelope.corners();
            let between = Box3d::new(*eye, corners[0]);
            let hides = |(occluder, bounds): (&Occluder, &Box3d)| {
                occluder.feature != feature as i64
                    && bounds.overlaps(&between)
                    && corners
                        .iter()
                        .all(|corner| blocks(&occluder.prism, *eye, *corner))
            };
            if occluders.iter().zip(&bounds).any(hides) {
                hidden.insert((i, feature));
            }
        }
    }
    hidden
}

/// Whether the open segment meets the inside of the prism, by clipping.
fn blocks(prism: &ConvexPrism, p: DVec3, q: DVec3) -> bool {
    let footprint = prism.footprint();
    let bottom = if prism.grounded() {
        FAR_BELOW
    } else {
        prism.bottom()
    };
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    let mut clip = |a: f64, b: f64| {
        if a <= 0.0 && b <= 0.0 {
            return false;
        }
        if a < 0.0 {
            enter = enter.max(a / (a - b));
        } else if b < 0.0 {
            leave = leave.min(a / (a - b));
        }
        enter < leave
    };
    clip(prism.top() - p.z, prism.top() - q.z)
        && clip(p.z - bottom, q.z - bottom)
        && (0..footprint.len()).all(|i| {
            let from = footprint[i];
            let along: DVec2 = footprint[(i + 1) % footprint.len()] - from;
            let depth = |r: DVec3| along.perp_dot(r.truncate() - from);
            clip(depth(p), depth(q))
        })
}
