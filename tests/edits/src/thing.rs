//! [`Thing`], what a feature is made to be, and its rows.

use fastrand::Rng;

use crate::plan::{Bounds, Place, ring_sql};

/// Blocks of houses, a side of the town.
pub const BLOCKS: u32 = 5;

/// From the middle of a street to that of the next one, metres.
pub const PITCH: f64 = 24.0;

/// Half the width of a street, metres.
pub const HALF_STREET: f64 = 4.0;

/// A feature with what hides in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Thing {
    pub envelope: Bounds,
    pub solid: Option<Solid>,
}

/// A prism on the ground, anticlockwise.
#[derive(Clone, Debug, PartialEq)]
pub struct Solid {
    pub ring: Vec<Place>,
    pub top: f64,
    /// Whether its surface is stored, too.
    pub has_mesh: bool,
    /// Whether an inner envelope claims it, and no column.
    pub is_inner: bool,
}

impl Thing {
    /// A house somewhere in a block, or one time in four something small that hides nothing.
    pub fn random(rng: &mut Rng) -> Self {
        if rng.u8(..4) == 0 {
            return Self::small(rng);
        }
        let is_whole = rng.bool();
        let number = |rng: &mut Rng, low: f64, high: f64| {
            let value = low + rng.f64() * (high - low);
            if is_whole { value.round() } else { value }
        };
        let size = PITCH - 2.0 * HALF_STREET;
        let (width, depth) = (number(rng, 3.0, 14.0), number(rng, 3.0, 14.0));
        let [x, y] = block(rng);
        let west = x + number(rng, 0.0, size - width);
        let south = y + number(rng, 0.0, size - depth);
        let (east, north) = (west + width, south + depth);
        let (mut ring, mut is_inner) = (
            vec![[west, south], [east, south], [east, north], [west, north]],
            false,
        );
        match rng.u8(..4) {
            0 => {
                ring.remove(rng.usize(..4));
            }
            1 => {
                ring = [0.5, 1.0, 0.7, 1.0]
                    .iter()
                    .enumerate()
                    .map(|(at, share)| {
                        let turn = at as f64 * std::f64::consts::FRAC_PI_2 + share;
                        let (radius, middle) = (
                            0.5 * width.min(depth),
                            [(west + east) / 2.0, (south + north) / 2.0],
                        );
                        [
                            middle[0] + radius * turn.cos(),
                            middle[1] + radius * turn.sin(),
                        ]
                    })
                    .collect();
            }
            _ => is_inner = rng.u8(..4) == 0,
        }
        Self::of(Solid {
            ring,
            top: number(rng, 2.0, 18.0),
            has_mesh: rng.bool(),
            is_inner,
        })
    }

    /// A thing as large as its solid.
    pub fn of(solid: Solid) -> Self {
        let bound = |of: fn(f64, f64) -> f64, axis: usize| {
            let values = solid.ring.iter().map(|place| place[axis]);
            values.reduce(of).expect("a ring has corners")
        };
        let envelope = Bounds {
            min: [bound(f64::min, 0), bound(f64::min, 1), 0.0],
            max: [bound(f64::max, 0), bound(f64::max, 1), solid.top],
        };
        Self {
            envelope,
            solid: Some(solid),
        }
    }

    fn small(rng: &mut Rng) -> Self {
        let side = PITCH * f64::from(BLOCKS);
        let min = [rng.f64() * side, rng.f64() * side, rng.f64() * 3.0];
        let size = [0.3, 0.3, 1.0].map(|most| rng.f64() * most);
        Self {
            envelope: Bounds {
                min,
                max: [0, 1, 2].map(|axis| min[axis] + size[axis]),
            },
            solid: None,
        }
    }

    /// The same, elsewhere.
    pub fn moved(&self, [x, y]: Place) -> Self {
        let mut thing = self.clone();
        for corner in [&mut thing.envelope.min, &mut thing.envelope.max] {
            corner[0] += x;
            corner[1] += y;
        }
        let Some(mut solid) = thing.solid else {
            return thing;
        };
        for corner in &mut solid.ring {
            corner[0] += x;
            corner[1] += y;
        }
        // Anew, since roundings may have moved corners out of the envelope.
        Self::of(solid)
    }

    /// The same, higher or lower.
    pub fn resized(&self, factor: f64) -> Self {
        match &self.solid {
            Some(solid) => Self::of(Solid {
                top: solid.top * factor,
                ..solid.clone()
            }),
            None => self.clone(),
        }
    }

    /// The columns class, envelope and outline of the feature.
    pub fn feature_values(&self) -> String {
        let (class, outline) = match &self.solid {
            Some(solid) => ("Building", ring_sql(&solid.ring)),
            None => ("Thing", "NULL".to_owned()),
        };
        format!("'{class}', {}, {outline}", self.envelope.sql())
    }

    /// Statements that insert what hides in the feature, and its surface.
    pub fn inserts(&self, scene: &str, id: i64) -> String {
        let Some(solid) = &self.solid else {
            return String::new();
        };
        let mut sql = if solid.is_inner {
            let bounds = self.envelope.sql();
            format!(
                "INSERT INTO {scene}.inner_envelope (feature, box, grounded) VALUES ({id}, {bounds}, true);"
            )
        } else {
            format!(
                "INSERT INTO {scene}.solid_column (feature, footprint, bottom, top, grounded)
                 VALUES ({id}, ARRAY[{}], 0, {:?}, true);",
                ring_sql(&solid.ring),
                solid.top
            )
        };
        if solid.has_mesh {
            sql += &format!(
                "INSERT INTO {scene}.mesh (feature, level_of_detail, vertices, triangles) VALUES ({id}, 1, {});",
                solid.mesh_values()
            );
        }
        sql
    }

    /// Statements that change rows of what hides in place, where they are the same tables.
    pub fn updates(&self, scene: &str, id: i64) -> Option<String> {
        let solid = self.solid.as_ref().filter(|solid| !solid.is_inner)?;
        let mesh = if solid.has_mesh {
            format!(
                "UPDATE {scene}.mesh SET (vertices, triangles) = ROW({}) WHERE feature = {id};",
                solid.mesh_values()
            )
        } else {
            String::new()
        };
        Some(format!(
            "UPDATE {scene}.solid_column SET footprint = ARRAY[{}], top = {:?} WHERE feature = {id}; {mesh}",
            ring_sql(&solid.ring),
            solid.top
        ))
    }
}

impl Solid {
    /// Vertices and triangles: the ring at the foot, the ring on top.
    fn mesh_values(&self) -> String {
        let heights = [0.0, self.top].into_iter();
        let vertices: Vec<String> = heights
            .flat_map(|z| {
                self.ring
                    .iter()
                    .map(move |[x, y]| format!("{x:?},{y:?},{z:?}"))
            })
            .collect();
        let n = self.ring.len();
        let caps = (1..n - 1).flat_map(|at| [[0, at + 1, at], [n, n + at, n + at + 1]]);
        let walls = (0..n).flat_map(|at| {
            let next = (at + 1) % n;
            [[at, next, n + next], [at, n + next, n + at]]
        });
        let triangles: Vec<String> = caps
            .chain(walls)
            .map(|[a, b, c]| format!("{a},{b},{c}"))
            .collect();
        format!(
            "ARRAY[{}]::float8[], ARRAY[{}]::int[]",
            vertices.join(","),
            triangles.join(",")
        )
    }
}

/// The south-west corner of a random block.
fn block(rng: &mut Rng) -> Place {
    [0, 1].map(|_| f64::from(rng.u32(..BLOCKS)) * PITCH + HALF_STREET)
}
