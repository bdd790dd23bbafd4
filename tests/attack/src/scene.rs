//! [`Scene`], random features with small things around them, somewhere on earth.

use fastrand::Rng;

use crate::kind::{Kind, Made, between, whole};
use crate::plan::{Feature, Place, rectangle};

/// A random scene.
#[derive(Clone, Debug)]
pub struct Scene {
    pub kind: Kind,
    pub features: Vec<Feature>,
    /// The eye that it is made for, if there is one.
    pub eye: Option<Place>,
}

impl Scene {
    pub fn random(rng: &mut Rng) -> Self {
        let kind = Kind::ALL[rng.usize(..Kind::ALL.len())];
        let Made { mut features, eye } = kind.make(rng);
        for feature in &mut features {
            if rng.u8(..4) == 0 {
                widen(rng, feature);
            }
        }
        for _ in 0..rng.usize(1..=8) {
            let host = rng.usize(..features.len());
            let small = small(rng, &features[host]);
            features.push(small);
        }
        // What is small may come first as well as last.
        rng.shuffle(&mut features);
        features.truncate(40);
        let place = place(rng);
        for feature in &mut features {
            *feature = moved(feature, place);
        }
        let eye = eye.map(|[x, y]| [x + place[0], y + place[1]]);
        Self {
            kind,
            features,
            eye,
        }
    }
}

/// Gives a feature more than its columns hold: a roof over them, eaves around them.
fn widen(rng: &mut Rng, feature: &mut Feature) {
    let high = feature.max[2] + [0.0, 1.0, 1e-9][rng.usize(..3)] * between(rng, 0.0, 3.0);
    let eaves = [0.0, 0.5, 1e-9][rng.usize(..3)];
    let mut places = feature.outline.clone();
    places.push([feature.min[0] - eaves, feature.min[1]]);
    places.push([feature.max[0] + eaves, feature.max[1]]);
    let columns = std::mem::take(&mut feature.columns);
    *feature = Feature::around(&places, feature.min[2], high);
    feature.columns = columns;
}

/// A thing that hides nothing, on or near a host: a sign, a point, a flat box or a lamp.
fn small(rng: &mut Rng, host: &Feature) -> Feature {
    let ring = match host.columns.first() {
        Some(column) => &column.rings[rng.usize(..column.rings.len())],
        None => &host.outline,
    };
    let at = rng.usize(..ring.len());
    let (from, to) = (ring[at], ring[(at + 1) % ring.len()]);
    let on_wall = |share: f64| [0, 1].map(|axis| from[axis] + (to[axis] - from[axis]) * share);
    let anywhere = [between(rng, -3.0, 34.0), between(rng, -3.0, 34.0)];
    let low = between(rng, 0.0, 3.0);
    match rng.u8(..8) {
        0 | 1 => {
            let high = low + between(rng, 0.0, 1.0);
            Feature::around(&[on_wall(0.25), on_wall(0.75)], low, high)
        }
        2 => Feature::around(&[on_wall(rng.f64())], low, low),
        3 => Feature::around(&[anywhere], low, low),
        4 => {
            let [x, y] = anywhere;
            Feature::around(&rectangle(x, y, x + 2.0, y + 1.0), low, low)
        }
        5 => {
            let [x, y] = [whole(rng, 0, 30), whole(rng, 0, 30)];
            Feature::around(&rectangle(x, y, x + 1.0, y + 1.0), 0.0, whole(rng, 0, 3))
        }
        6 => {
            let [x, y] = on_wall(0.5);
            Feature::around(
                &rectangle(x - 0.1, y - 0.1, x + 0.1, y + 0.1),
                0.0,
                between(rng, 0.2, 9.0),
            )
        }
        _ => {
            let [x, y] = anywhere;
            Feature::around(
                &rectangle(x, y, x + 0.2, y + 0.2),
                0.0,
                between(rng, 0.2, 9.0),
            )
        }
    }
}

/// Where a scene lies.
fn place(rng: &mut Rng) -> Place {
    match rng.u8(..12) {
        0 => [85_000.0, 447_000.0],
        1 => [85_000.3, 447_000.7],
        2 => [1e6, -1e6],
        3 => [-15.0, -15.0],
        4 => [0.1, 0.7],
        _ => [0.0, 0.0],
    }
}

fn moved(feature: &Feature, [x, y]: Place) -> Feature {
    let put = |place: &Place| [place[0] + x, place[1] + y];
    let mut feature = feature.clone();
    for column in &mut feature.columns {
        for ring in &mut column.rings {
            for corner in ring {
                *corner = put(corner);
            }
        }
    }
    // Anew, since roundings may have moved corners in or out of line, or columns out of the outline.
    let corners = feature
        .columns
        .iter()
        .flat_map(|column| column.rings.concat());
    let places: Vec<Place> = feature.outline.iter().map(put).chain(corners).collect();
    Feature {
        columns: feature.columns,
        ..Feature::around(&places, feature.min[2], feature.max[2])
    }
}
