//! [`Kind`], what a random scene is like.

use fastrand::Rng;

use crate::plan::{Column, Feature, Place, rectangle};

/// What a random scene is like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Boxes on whole numbers, which often touch.
    Integers,
    /// Boxes anywhere, many within each other.
    Overlapping,
    /// L-shaped houses: one column, or two that share a wall.
    Angles,
    /// Houses around courtyards, with things in them.
    Courtyards,
    /// Houses with passages, and bridges: columns that do not stand on the ground.
    Bridges,
    /// Very thin towers.
    Needles,
    /// Walls of millimetres and centimetres.
    Walls,
    /// Rows of houses a millimetre apart, or less, or touching.
    Gaps,
    /// Triangles and quadrilaterals that turn any way.
    Turned,
    /// Rows of houses with shared corners, along streets that turn any way.
    Rows,
    /// Feet and roofs at many heights.
    Relief,
    /// A wall of five kilometres, and houses around it.
    Long,
    /// All roofs at a few heights.
    Flush,
    /// Houses of several columns that share corners.
    Parts,
    /// Houses whose corners are on one line with the eye, but for roundings.
    Lined,
    /// Houses a little above the ground around an eye that is hardly higher: one looks below the near ones.
    Raised,
}

/// The features of a random scene, and an eye if it is made for one.
pub struct Made {
    pub features: Vec<Feature>,
    pub eye: Option<Place>,
}

impl Kind {
    pub const ALL: [Self; 16] = [
        Self::Integers,
        Self::Overlapping,
        Self::Angles,
        Self::Courtyards,
        Self::Bridges,
        Self::Needles,
        Self::Walls,
        Self::Gaps,
        Self::Turned,
        Self::Rows,
        Self::Relief,
        Self::Long,
        Self::Flush,
        Self::Parts,
        Self::Lined,
        Self::Raised,
    ];

    /// A random scene of this kind.
    pub fn make(self, rng: &mut Rng) -> Made {
        if self == Self::Lined {
            return lined(rng);
        }
        if self == Self::Raised {
            return raised(rng);
        }
        Made {
            features: self.features(rng),
            eye: None,
        }
    }

    fn features(self, rng: &mut Rng) -> Vec<Feature> {
        let count = rng.usize(4..=28);
        match self {
            Self::Gaps => gaps(rng),
            Self::Rows => rows(rng),
            Self::Long => {
                let mut features = many(count, || integers(rng));
                let at = whole(rng, -2, 30);
                let thick = [0.001, 0.3, 1.0][rng.usize(..3)];
                let wall = if rng.bool() {
                    rectangle(-2500.0, at, 2500.0, at + thick)
                } else {
                    rectangle(at, -2500.0, at + thick, 2500.0)
                };
                features.push(Feature::of(vec![block(wall, 0.0, whole(rng, 1, 5))]));
                for _ in 0..4 {
                    let [x, y] = [whole(rng, -2400, 2400), whole(rng, -40, 60)];
                    let corners = rectangle(x, y, x + 10.0, y + 10.0);
                    features.push(Feature::of(vec![block(corners, 0.0, whole(rng, 2, 9))]));
                }
                features
            }
            Self::Integers => many(count, || integers(rng)),
            Self::Overlapping => many(count, || overlapping(rng)),
            Self::Angles => many(count, || angle(rng)),
            Self::Courtyards => courtyards(rng),
            Self::Bridges => many(count, || bridge(rng)),
            Self::Needles => many(count, || needle(rng)),
            Self::Walls => many(count, || wall(rng)),
            Self::Turned => many(count, || turned(rng)),
            Self::Relief => many(count, || relief(rng)),
            Self::Flush => many(count, || flush(rng)),
            Self::Parts => many(count / 2, || parts(rng)),
            Self::Lined => lined(rng).features,
            Self::Raised => raised(rng).features,
        }
    }
}

fn many(count: usize, feature: impl FnMut() -> Feature) -> Vec<Feature> {
    std::iter::repeat_with(feature).take(count).collect()
}

/// A random whole number.
pub fn whole(rng: &mut Rng, from: i32, to: i32) -> f64 {
    f64::from(rng.i32(from..=to))
}

/// A random number.
pub fn between(rng: &mut Rng, from: f64, to: f64) -> f64 {
    from + (to - from) * rng.f64()
}

/// A column that stands on the ground.
fn block(corners: Vec<Place>, bottom: f64, top: f64) -> Column {
    Column {
        rings: vec![corners],
        bottom,
        top,
        grounded: true,
    }
}

fn whole_rectangle(rng: &mut Rng) -> Vec<Place> {
    let [x, y] = [whole(rng, 0, 24), whole(rng, 0, 24)];
    rectangle(x, y, x + whole(rng, 1, 7), y + whole(rng, 1, 7))
}

fn integers(rng: &mut Rng) -> Feature {
    Feature::of(vec![block(whole_rectangle(rng), 0.0, whole(rng, 2, 8))])
}

fn overlapping(rng: &mut Rng) -> Feature {
    let count = rng.usize(1..=3);
    let [x, y] = [between(rng, 0.0, 24.0), between(rng, 0.0, 24.0)];
    let columns = std::iter::repeat_with(|| {
        let [west, south] = [x + between(rng, -2.0, 2.0), y + between(rng, -2.0, 2.0)];
        let [east, north] = [
            west + between(rng, 0.5, 6.0),
            south + between(rng, 0.5, 6.0),
        ];
        block(
            rectangle(west, south, east, north),
            0.0,
            between(rng, 1.0, 9.0),
        )
    });
    Feature::of(columns.take(count).collect())
}

fn angle(rng: &mut Rng) -> Feature {
    let [x, y] = [whole(rng, 0, 22), whole(rng, 0, 22)];
    let [a, b] = [whole(rng, 1, 3), whole(rng, 1, 3)];
    let [c, d] = [a + whole(rng, 1, 4), b + whole(rng, 1, 4)];
    // Quarter turns about the middle keep whole numbers.
    let turns = rng.u8(..4);
    let put = |[mut u, mut v]: Place| {
        for _ in 0..turns {
            (u, v) = (-v, u);
        }
        [x + u, y + v]
    };
    let top = whole(rng, 2, 8);
    let ring = |corners: &[Place]| corners.iter().copied().map(put).collect::<Vec<_>>();
    if rng.bool() {
        let corners = [[0.0, 0.0], [c, 0.0], [c, b], [a, b], [a, d], [0.0, d]];
        return Feature::of(vec![block(ring(&corners), 0.0, top)]);
    }
    let other = if rng.bool() { top } else { whole(rng, 2, 8) };
    Feature::of(vec![
        block(ring(&rectangle(0.0, 0.0, a, d)), 0.0, top),
        block(ring(&rectangle(a, 0.0, c, b)), 0.0, other),
    ])
}

fn courtyards(rng: &mut Rng) -> Vec<Feature> {
    let mut features = Vec::new();
    for _ in 0..rng.usize(2..=6) {
        let [x, y] = [whole(rng, 0, 24), whole(rng, 0, 24)];
        let [width, depth] = [whole(rng, 6, 14), whole(rng, 6, 14)];
        let thick = if rng.bool() {
            whole(rng, 1, 2)
        } else {
            between(rng, 0.1, 2.0)
        };
        let outer = rectangle(x, y, x + width, y + depth);
        let mut holes = vec![];
        let [west, south] = [x + thick, y + thick];
        let [east, north] = [x + width - thick, y + depth - thick];
        if rng.u8(..3) == 0 {
            let middle = f64::midpoint(west, east);
            holes.push(rectangle(west, south, middle - 0.25, north));
            holes.push(rectangle(middle + 0.25, south, east, north));
        } else {
            holes.push(rectangle(west, south, east, north));
        }
        for hole in &mut holes {
            hole.reverse();
        }
        let mut column = block(outer, 0.0, whole(rng, 2, 9));
        column.rings.extend(holes);
        features.push(Feature::of(vec![column]));
        for _ in 0..rng.usize(..3) {
            let [u, v] = [between(rng, west, east), between(rng, south, north)];
            let inside = rectangle(u, v, (u + 1.0).min(east), (v + 1.0).min(north));
            features.push(Feature::of(vec![block(inside, 0.0, whole(rng, 1, 9))]));
        }
    }
    for _ in 0..rng.usize(..8) {
        features.push(integers(rng));
    }
    features
}

fn bridge(rng: &mut Rng) -> Feature {
    let corners = whole_rectangle(rng);
    let top = whole(rng, 3, 8);
    let deck = |corners: Vec<Place>, bottom: f64| Column {
        grounded: false,
        ..block(corners, bottom, top)
    };
    match rng.u8(..4) {
        0 => Feature::of(vec![deck(corners, whole(rng, 1, 2))]),
        1 => {
            // A passage through a house.
            let [west, south, east, north] = [
                corners[0][0],
                corners[0][1],
                corners[2][0] + 2.0,
                corners[2][1],
            ];
            Feature::of(vec![
                block(rectangle(west, south, west + 1.0, north), 0.0, top),
                deck(rectangle(west + 1.0, south, east - 1.0, north), 2.0),
                block(rectangle(east - 1.0, south, east, north), 0.0, top),
            ])
        }
        2 => {
            // A tower that widens above its foot.
            let [west, south, east, north] =
                [corners[0][0], corners[0][1], corners[2][0], corners[2][1]];
            let wide = rectangle(west - 2.0, south - 2.0, east + 2.0, north + 2.0);
            Feature::of(vec![block(corners, 0.0, 2.0), deck(wide, 2.0)])
        }
        _ => Feature::of(vec![block(corners, 0.0, top)]),
    }
}

fn needle(rng: &mut Rng) -> Feature {
    if rng.u8(..3) == 0 {
        return integers(rng);
    }
    let [x, y] = if rng.bool() {
        [whole(rng, 0, 12), whole(rng, 0, 12)]
    } else {
        [between(rng, 0.0, 12.0), between(rng, 0.0, 12.0)]
    };
    let size = [1e-6, 0.001, 0.01, 0.125, 0.5][rng.usize(..5)];
    Feature::of(vec![block(
        rectangle(x, y, x + size, y + size),
        0.0,
        whole(rng, 2, 60),
    )])
}

fn wall(rng: &mut Rng) -> Feature {
    if rng.u8(..4) == 0 {
        return integers(rng);
    }
    let thick = [0.0005, 0.001, 0.003, 0.01, 0.0625][rng.usize(..5)];
    let [x, y] = [whole(rng, 0, 20), whole(rng, 0, 20)];
    let [u, v] = match rng.u8(..3) {
        0 => [whole(rng, 1, 12), 0.0],
        1 => [0.0, whole(rng, 1, 12)],
        _ => [between(rng, -8.0, 8.0), between(rng, 1.0, 8.0)],
    };
    let length = u.hypot(v);
    let across = [-v / length * thick, u / length * thick];
    let corners = vec![
        [x, y],
        [x + u, y + v],
        [x + u + across[0], y + v + across[1]],
        [x + across[0], y + across[1]],
    ];
    Feature::of(vec![block(corners, 0.0, whole(rng, 2, 5))])
}

fn gaps(rng: &mut Rng) -> Vec<Feature> {
    let mut features = Vec::new();
    for row in 0..rng.usize(2..=5) {
        let south = 7.0 * row as f64 + [0.0, 0.001, 0.5][rng.usize(..3)];
        let mut west = whole(rng, 0, 4);
        for _ in 0..rng.usize(2..=8) {
            let east = west + whole(rng, 1, 5);
            let corners = rectangle(west, south, east, south + whole(rng, 1, 5));
            features.push(Feature::of(vec![block(corners, 0.0, whole(rng, 3, 8))]));
            west = east + [0.0, 0.0, 0.001, 1e-4, 1e-7, 1e-10, 2e-15][rng.usize(..7)];
        }
    }
    features
}

/// The corners of a convex polygon about a place, anticlockwise.
fn convex(rng: &mut Rng, [x, y]: Place, radius: f64) -> Vec<Place> {
    let count = rng.usize(3..=6);
    let first = between(rng, 0.0, std::f64::consts::TAU);
    let step = std::f64::consts::TAU / count as f64;
    (0..count)
        .map(|at| {
            let azimuth = first + step * (at as f64 + between(rng, -0.2, 0.2));
            [x + radius * azimuth.cos(), y + radius * azimuth.sin()]
        })
        .collect()
}

fn turned(rng: &mut Rng) -> Feature {
    let place = [between(rng, 0.0, 26.0), between(rng, 0.0, 26.0)];
    let radius = between(rng, 0.3, 4.5);
    let corners = convex(rng, place, radius);
    Feature::of(vec![block(corners, 0.0, between(rng, 1.0, 9.0))])
}

fn rows(rng: &mut Rng) -> Vec<Feature> {
    let mut features = Vec::new();
    let azimuth = if rng.u8(..3) == 0 {
        0.0
    } else {
        between(rng, 0.0, std::f64::consts::TAU)
    };
    let (sine, cosine) = azimuth.sin_cos();
    let put = |u: f64, v: f64| [15.0 + u * cosine - v * sine, 15.0 + u * sine + v * cosine];
    for row in 0..rng.usize(2..=5) {
        let south = 9.0 * row as f64 - 18.0;
        let mut ends = vec![between(rng, -16.0, -8.0)];
        for _ in 0..rng.usize(2..=9) {
            ends.push(ends[ends.len() - 1] + between(rng, 2.0, 6.0));
        }
        // Both neighbours have the corners of their common wall bit for bit.
        for pair in ends.windows(2) {
            let corners = vec![
                put(pair[0], south),
                put(pair[1], south),
                put(pair[1], south + 6.0),
                put(pair[0], south + 6.0),
            ];
            features.push(Feature::of(vec![block(
                corners,
                0.0,
                between(rng, 3.0, 8.0),
            )]));
        }
    }
    features
}

fn relief(rng: &mut Rng) -> Feature {
    let [x, y] = [whole(rng, 0, 24), whole(rng, 0, 24)];
    let foot = (0.25 * x - 0.5 * y).round() * 0.5 + whole(rng, -1, 1);
    let corners = rectangle(x, y, x + whole(rng, 1, 6), y + whole(rng, 1, 6));
    let mut columns = vec![block(corners, foot, foot + whole(rng, 1, 7))];
    if rng.u8(..3) == 0 {
        let corners = rectangle(x - 1.0, y - 1.0, x + 1.0, y);
        columns.push(block(corners, foot - 2.0, foot + whole(rng, 1, 3)));
    }
    Feature::of(columns)
}

fn flush(rng: &mut Rng) -> Feature {
    let top = [3.0, 3.0, 4.0, 3.0 + 1e-9][rng.usize(..4)];
    let corners = if rng.bool() {
        whole_rectangle(rng)
    } else {
        let place = [between(rng, 0.0, 26.0), between(rng, 0.0, 26.0)];
        convex(rng, place, 3.0)
    };
    Feature::of(vec![block(corners, 0.0, top)])
}

/// A house cut into columns of their own heights, whose common corners are the same bit for bit.
fn parts(rng: &mut Rng) -> Feature {
    let [x, y] = [whole(rng, 0, 24), whole(rng, 0, 24)];
    let azimuth = if rng.bool() {
        0.0
    } else {
        between(rng, 0.0, 1.5)
    };
    let (sine, cosine) = azimuth.sin_cos();
    let [columns, rows] = [rng.usize(1..=3), rng.usize(1..=2)];
    let corner = |column: usize, row: usize| {
        let [u, v] = [column as f64 * 2.0, row as f64 * 3.0];
        [x + u * cosine - v * sine, y + u * sine + v * cosine]
    };
    let level = rng.bool();
    let mut found = Vec::new();
    for column in 0..columns {
        for row in 0..rows {
            let corners = [
                corner(column, row),
                corner(column + 1, row),
                corner(column + 1, row + 1),
                corner(column, row + 1),
            ];
            let mut put = |corners: Vec<Place>| {
                let top = if level { 5.0 } else { whole(rng, 2, 7) };
                found.push(block(corners, 0.0, top));
            };
            let [a, b, c, d] = corners;
            if column == row {
                put(vec![a, b, c]);
                put(vec![a, c, d]);
            } else {
                put(corners.to_vec());
            }
        }
    }
    Feature::of(found)
}

/// Houses on the left and on the right of lines of sight, each with a corner on the line.
fn raised(rng: &mut Rng) -> Made {
    let houses = rng.usize(6..=24);
    let features = many(houses, || {
        let [x, y] = [whole(rng, -70, 70), whole(rng, -70, 70)];
        let corners = rectangle(x, y, x + whole(rng, 1, 20), y + whole(rng, 1, 20));
        let foot = [0.0, 0.02, 0.1, 0.3, 1.0][rng.usize(..5)];
        let column = block(corners, foot, foot + between(rng, 0.1, 6.0));
        Feature::of(vec![Column {
            grounded: foot == 0.0 && rng.bool(),
            ..column
        }])
    });
    Made {
        features,
        eye: Some([between(rng, -20.0, 20.0), between(rng, -20.0, 20.0)]),
    }
}

fn lined(rng: &mut Rng) -> Made {
    let eye = [between(rng, 0.0, 20.0), between(rng, 0.0, 20.0)];
    let mut features = Vec::new();
    for _ in 0..rng.usize(1..=3) {
        let azimuth = if rng.u8(..4) == 0 {
            f64::from(rng.u8(..8)) * std::f64::consts::FRAC_PI_4
        } else {
            between(rng, 0.0, std::f64::consts::TAU)
        };
        let (sine, cosine) = azimuth.sin_cos();
        let put = |along: f64, left: f64| {
            [
                eye[0] + along * cosine - left * sine,
                eye[1] + along * sine + left * cosine,
            ]
        };
        for left in [1.0, -1.0] {
            for _ in 0..rng.usize(1..=2) {
                let near = between(rng, 2.0, 9.0);
                let bulge = between(rng, 0.2, 2.0);
                let mut corners = vec![
                    put(near, 0.0),
                    put(near + bulge, 0.5 * left),
                    put(near + 1.0, 6.0 * left),
                    put(near - 0.3, 5.0 * left),
                ];
                if left < 0.0 {
                    corners.reverse();
                }
                features.push(Feature::of(vec![block(
                    corners,
                    0.0,
                    between(rng, 5.0, 9.0),
                )]));
            }
        }
        for _ in 0..2 {
            let far = between(rng, 12.0, 25.0);
            let [x, y] = put(far, 0.0);
            let target = match rng.u8(..3) {
                0 => rectangle(x - 1.0, y - 1.0, x + 1.0, y + 1.0),
                1 => vec![put(far, 0.0), put(far + 1.0, 1.0), put(far, 1.0)],
                _ => vec![put(far, 0.0), put(far, -1.0), put(far + 1.0, -1.0)],
            };
            features.push(Feature::around(&target, 0.0, between(rng, 0.5, 4.0)));
        }
    }
    Made {
        features,
        eye: Some(eye),
    }
}
