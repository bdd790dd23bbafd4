//! [`RoofTrial`], scenes of houses with roofs: nothing that an answer leaves out can be seen past the
//! surfaces of the others.

use std::fmt::{Display, Formatter, Result};

use engine::{OuterPrism, PointQuery, PointSolver, Roof, SolidColumn, TileFeature, TriangleMesh};
use fastrand::Rng;
use glam::{DVec2, DVec3};
use oracle::{RayCaster, Sight};

use crate::kind::{between, whole};
use crate::tiling::Tiling;
use crate::trial::{Counts, EYES, FIELDS, range};

/// Vertical planes to aim in, a feature that was left out, and points of its surface.
const PLANES: usize = 6;
const POINTS: usize = 6;

/// Walls on each side of an intricate block: more than most roofs have edges.
const WALLS: usize = 6;

/// Share of the way to its middle by which such a block is drawn in: not more than the millimetre within which
/// what is beside an eye hides nothing.
const DRAWN_IN: f64 = 1e-4;

/// A house: what is seen of it, and a block in it.
#[derive(Clone, Debug)]
struct House {
    mesh: TriangleMesh,
    block: Option<[DVec3; 4]>,
    /// Whether the block has so many walls that the roof hides in its place.
    is_intricate: bool,
}

/// Something that was left out and can be seen.
#[derive(Clone, Debug)]
pub struct RoofFinding {
    scene: u64,
    query: PointQuery,
    house: House,
    witness: DVec3,
}

/// A scene of houses and all that is asked of it.
pub struct RoofTrial {
    number: u64,
    rng: Rng,
    houses: Vec<House>,
    pub counts: Counts,
    pub findings: Vec<RoofFinding>,
}

impl RoofTrial {
    /// The scene of this number.
    pub fn new(seed: u64, number: u64) -> Self {
        let mut rng = Rng::with_seed(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ !number);
        let place = [DVec2::ZERO, DVec2::new(85_000.3, 447_000.7)][rng.usize(..2)];
        let count = rng.usize(3..=14);
        let houses = std::iter::repeat_with(|| House::random(&mut rng, place));
        Self {
            number,
            houses: houses.take(count).collect(),
            rng,
            counts: Counts::default(),
            findings: Vec::new(),
        }
    }

    /// Asks as many queries as are wanted.
    pub fn run(&mut self, solver: &mut PointSolver, queries: u64) {
        let features: Vec<TileFeature> = self.houses.iter().zip(0..).map(House::feature).collect();
        let triangles: Vec<(u32, [[f64; 3]; 3])> = self
            .houses
            .iter()
            .zip(0..)
            .flat_map(|(house, id)| {
                let corners = house.mesh.corners();
                corners.map(move |corners| (id, corners.map(|corner| corner.to_array())))
            })
            .collect();
        let caster = RayCaster::new(&triangles).expect("coordinates that rays can be cast at");
        let mut tiling = Tiling::random(&mut self.rng, &features);
        for _ in 0..EYES {
            let eye = self.random_eye();
            for field in 0..FIELDS {
                if self.counts.queries == queries {
                    return;
                }
                let query = PointQuery {
                    eye,
                    range: range(&mut self.rng, field),
                    prisms: field % 2 == 1,
                    wedge: None,
                };
                let answer = tiling.answer(solver, &query);
                self.counts.queries += 1;
                self.counts.returned += answer.len() as u64;
                self.judge(&caster, &query, &features, &answer);
            }
        }
    }

    /// Beside a corner or a wall, or anywhere; above the foot of all houses.
    fn random_eye(&mut self) -> DVec3 {
        let rng = &mut self.rng;
        let house = &self.houses[rng.usize(..self.houses.len())];
        let corner = |rng: &mut Rng| house.mesh.vertices[rng.usize(..house.mesh.vertices.len())];
        let (from, to) = (corner(rng), corner(rng));
        let plan = match rng.u8(..4) {
            0 => from.truncate(),
            1 => from.lerp(to, between(rng, -2.0, 3.0)).truncate(),
            _ => from.truncate() + DVec2::new(between(rng, -9.0, 9.0), between(rng, -9.0, 9.0)),
        };
        let beside = [0.0, 1e-9, 1e-4, 1.1e-3, 0.3][rng.usize(..5)];
        let turn = between(rng, 0.0, std::f64::consts::TAU);
        let height = match rng.u8(..5) {
            0 => from.z,
            1 => 0.0,
            2 => between(rng, 5.0, 15.0),
            _ => between(rng, 0.0, 3.0),
        };
        (plan + DVec2::from_angle(turn) * beside).extend(height)
    }

    fn judge(
        &mut self,
        caster: &RayCaster,
        query: &PointQuery,
        features: &[TileFeature],
        answer: &[i64],
    ) {
        for (at, id) in (0..features.len()).zip(0_u32..) {
            // What is at the limit of the range may be in it or not, by a rounding.
            let envelope = &features[at].envelope;
            let nearest = query.eye.clamp(envelope.min, envelope.max);
            if nearest.distance(query.eye) > query.range - 1e-6 {
                continue;
            }
            self.counts.features += 1;
            let is_returned = answer.binary_search(&i64::from(id)).is_ok();
            if is_returned && self.rng.u8(..16) != 0 {
                continue;
            }
            let points = self.aims(query, at);
            let is_clear = |point: &&DVec3| {
                let sight = caster.is_clear(query.eye.to_array(), point.to_array(), Some(id));
                sight == Sight::Clear
            };
            let witness = points.iter().find(is_clear);
            if is_returned {
                self.counts.looked_at += 1;
                self.counts.seen += u64::from(witness.is_some());
                continue;
            }
            self.counts.left_out += 1;
            self.counts.aims += points.len() as u64;
            if let Some(&witness) = witness {
                self.counts.false_occlusions += 1;
                self.findings.push(RoofFinding {
                    scene: self.number,
                    query: *query,
                    house: self.houses[at].clone(),
                    witness,
                });
            }
        }
    }

    /// Points of a house, or of its box, that are most likely to be seen: its corners, and where its edges
    /// meet the vertical planes through the eye and corners of others, or next to them.
    fn aims(&mut self, query: &PointQuery, at: usize) -> Vec<DVec3> {
        let house = &self.houses[at];
        let triangles: Vec<[DVec3; 3]> = if query.prisms {
            house.mesh.corners().collect()
        } else {
            let envelope = house.mesh.envelope().expect("a house has corners");
            lids(&envelope.corners())
        };
        let mut points: Vec<DVec3> = triangles.as_flattened().to_vec();
        let rng = &mut self.rng;
        for _ in 0..POINTS {
            let [a, b, c] = triangles[rng.usize(..triangles.len())];
            let (u, v) = (rng.f64(), rng.f64());
            points.push(a + (b - a) * u + (c - a) * (v * (1.0 - u)));
        }
        for _ in 0..PLANES {
            let other = &self.houses[rng.usize(..self.houses.len())];
            let corner = other.mesh.vertices[rng.usize(..other.mesh.vertices.len())];
            let turn = [0.0, 1e-9, -1e-9, 1e-6, -1e-6, 1e-3, -1e-3][rng.usize(..7)];
            let towards = DVec2::from_angle(turn).rotate((corner - query.eye).truncate());
            for [a, b, c] in &triangles {
                for (from, to) in [(a, b), (b, c), (c, a)] {
                    // An edge is one of two triangles.
                    if from.to_array() > to.to_array() {
                        continue;
                    }
                    let side = |end: &DVec3| towards.perp_dot((end - query.eye).truncate());
                    let (left, right) = (side(from), side(to));
                    if left * right < 0.0 {
                        points.push(from.lerp(*to, left / (left - right)));
                    }
                }
            }
        }
        points
    }
}

/// The faces of a box, by its corners as [`engine::Box3d::corners`] gives them.
fn lids(corners: &[DVec3; 8]) -> Vec<[DVec3; 3]> {
    let faces = [
        [0, 1, 3, 2],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 3, 7, 6],
        [0, 2, 6, 4],
        [1, 3, 7, 5],
    ];
    let split = faces.map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
    let triangles = split.into_iter().flatten();
    triangles
        .map(|ends| ends.map(|at: usize| corners[at]))
        .collect()
}

impl House {
    fn random(rng: &mut Rng, place: DVec2) -> Self {
        let angle = [0.0, 0.0, between(rng, 0.0, 3.0)][rng.usize(..3)];
        let corner = DVec2::new(whole(rng, 0, 24), whole(rng, 0, 24));
        let put =
            |p: DVec3| (place + corner + DVec2::from_angle(angle).rotate(p.truncate())).extend(p.z);
        let (width, depth) = (whole(rng, 1, 9), whole(rng, 1, 9));
        let house = match rng.u8(..8) {
            0 => pyramid(rng, width, depth, &put),
            1 => on_stilts(rng, width, depth, &put),
            2 => field(rng, width, depth, &put),
            3 => sheltered(rng, width, depth, &put),
            _ => House::ridged(rng, [width, depth], &put),
        };
        Self {
            is_intricate: rng.bool(),
            ..house
        }
    }

    /// A house whose roof has one profile all along: flat, gabled, lean-to, or like the teeth of a saw.
    fn ridged(rng: &mut Rng, size: [f64; 2], put: Put) -> Self {
        let heights: Vec<f64> = (0..=rng.usize(1..=4)).map(|_| whole(rng, 1, 9)).collect();
        let [roof, rest] = profile(&heights, size, 0.0, put);
        let top = heights.into_iter().fold(f64::INFINITY, f64::min);
        Self::of(&[roof, rest], Some(rectangle([0.0; 2], size, top, put)))
    }

    fn of(faces: &[Vec<Vec<DVec3>>], block: Option<[DVec3; 4]>) -> Self {
        let faces = faces.iter().flatten().map(|face| [face.clone()]);
        Self {
            mesh: TriangleMesh::from_polygons(faces),
            block,
            is_intricate: false,
        }
    }

    /// The corners of its block in plan: those of an intricate one are a little within it.
    fn ring(&self, corners: &[DVec3; 4]) -> Vec<(f64, f64)> {
        let place = |corner: DVec3| (corner.x, corner.y);
        if !self.is_intricate {
            return corners.map(place).to_vec();
        }
        let middle = corners[0].midpoint(corners[2]);
        let drawn_in = corners.map(|corner| corner.lerp(middle, DRAWN_IN));
        let of_a_side = |at: usize| {
            let [from, to] = [drawn_in[at], drawn_in[(at + 1) % 4]];
            (0..WALLS).map(move |step| place(from.lerp(to, step as f64 / WALLS as f64)))
        };
        (0..4).flat_map(of_a_side).collect()
    }

    fn feature((house, id): (&Self, i64)) -> TileFeature {
        let envelope = house.mesh.envelope().expect("a house has corners");
        let prism = OuterPrism::around(house.mesh.vertices.iter().copied());
        let columns = house.block.iter().map(|corners| {
            let top = corners[0].z;
            SolidColumn {
                footprint: geo::Polygon::new(house.ring(corners).into(), Vec::new()),
                bottom: 0.0,
                top,
                grounded: true,
            }
        });
        TileFeature {
            id,
            envelope,
            outline: prism.expect("a house has corners").hull,
            roof: Roof::of(&house.mesh, &envelope),
            columns: columns.collect(),
        }
    }
}

type Put<'a> = &'a dyn Fn(DVec3) -> DVec3;

fn rectangle(min: [f64; 2], max: [f64; 2], z: f64, put: Put) -> [DVec3; 4] {
    let corners = [min, [max[0], min[1]], max, [min[0], max[1]]];
    corners.map(|[x, y]| put(DVec3::new(x, y, z)))
}

/// The faces of a roof whose profile is the same all along, and those of the walls and the bottom below it.
fn profile(heights: &[f64], [width, depth]: [f64; 2], foot: f64, put: Put) -> [Vec<Vec<DVec3>>; 2] {
    let last = heights.len() - 1;
    let point = |i: usize, y: f64, z: f64| put(DVec3::new(width * i as f64 / last as f64, y, z));
    let low = |i: usize, y: f64| point(i, y, foot);
    let high = |i: usize, y: f64| point(i, y, heights[i]);
    let (mut roof, mut rest) = (Vec::new(), Vec::new());
    for (i, j) in (0..last).map(|i| (i, i + 1)) {
        roof.push(vec![
            high(i, 0.0),
            high(j, 0.0),
            high(j, depth),
            high(i, depth),
        ]);
        rest.push(vec![low(i, 0.0), low(j, 0.0), high(j, 0.0), high(i, 0.0)]);
        rest.push(vec![
            low(j, depth),
            low(i, depth),
            high(i, depth),
            high(j, depth),
        ]);
        rest.push(vec![low(i, depth), low(j, depth), low(j, 0.0), low(i, 0.0)]);
    }
    rest.push(vec![
        low(0, depth),
        low(0, 0.0),
        high(0, 0.0),
        high(0, depth),
    ]);
    rest.push(vec![
        low(last, 0.0),
        low(last, depth),
        high(last, depth),
        high(last, 0.0),
    ]);
    [roof, rest]
}

/// Four walls with nothing on them but a tip.
fn pyramid(rng: &mut Rng, width: f64, depth: f64, put: Put) -> House {
    let (eaves, tip) = (whole(rng, 0, 4), whole(rng, 5, 12));
    let low = rectangle([0.0; 2], [width, depth], 0.0, put);
    let high = low.map(|corner| corner.with_z(eaves));
    let tip = put(DVec3::new(width * rng.f64(), depth * rng.f64(), tip));
    let mut faces = vec![vec![low[3], low[2], low[1], low[0]]];
    for i in 0..4 {
        let next = (i + 1) % 4;
        if eaves > 0.0 {
            faces.push(vec![low[i], low[next], high[next], high[i]]);
        }
        faces.push(vec![high[i], high[next], tip]);
    }
    House::of(&[faces], (eaves > 0.0).then_some(high))
}

/// A house in the air over a smaller one: what is below its rim, or between both, can be seen.
fn on_stilts(rng: &mut Rng, width: f64, depth: f64, put: Put) -> House {
    let low = whole(rng, 1, 4);
    let air = [0.0, 1.0, 2.0][rng.usize(..3)];
    let heights = [(); 3].map(|()| low + air + whole(rng, 1, 6));
    let inner = |p: DVec3| put(p + DVec3::new(width * 0.25, depth * 0.25, 0.0));
    let size = [width * 0.5, depth * 0.5];
    let [top, below] = profile(&[low; 2], size, 0.0, &inner);
    let [roof, rest] = profile(&heights, [width, depth], low + air, put);
    let block = rectangle([0.0; 2], size, low, &inner);
    House::of(&[top, below, roof, rest], Some(block))
}

/// A block with a roof over it that has no walls.
fn sheltered(rng: &mut Rng, width: f64, depth: f64, put: Put) -> House {
    let low = whole(rng, 1, 4);
    let heights = [(); 3].map(|()| low + whole(rng, 1, 6));
    let [top, below] = profile(&[low; 2], [width, depth], 0.0, put);
    let [roof, _] = profile(&heights, [width, depth], 0.0, put);
    let block = rectangle([0.0; 2], [width, depth], low, put);
    House::of(&[top, below, roof], Some(block))
}

/// A house whose roof is a field of heights, with ridges and valleys.
fn field(rng: &mut Rng, width: f64, depth: f64, put: Put) -> House {
    const CELLS: usize = 3;
    let mut top = f64::INFINITY;
    let mut heights = [[0.0; CELLS + 1]; CELLS + 1];
    for height in heights.as_flattened_mut() {
        *height = whole(rng, 1, 9);
        top = top.min(*height);
    }
    let share = |i: usize| i as f64 / CELLS as f64;
    let at = |i: usize, j: usize, z: f64| put(DVec3::new(width * share(i), depth * share(j), z));
    let roof = |i: usize, j: usize| at(i, j, heights[i][j]);
    let foot = |i: usize, j: usize| at(i, j, 0.0);
    let mut triangles = Vec::new();
    let mut add = |face: [DVec3; 4]| {
        let [a, b, c, d] = face;
        triangles.extend([[a, b, c], [a, c, d]]);
    };
    for i in 0..CELLS {
        for j in 0..CELLS {
            add([
                roof(i, j),
                roof(i + 1, j),
                roof(i + 1, j + 1),
                roof(i, j + 1),
            ]);
            add([
                foot(i, j),
                foot(i, j + 1),
                foot(i + 1, j + 1),
                foot(i + 1, j),
            ]);
        }
        add([foot(i, 0), foot(i + 1, 0), roof(i + 1, 0), roof(i, 0)]);
        add([
            foot(i + 1, CELLS),
            foot(i, CELLS),
            roof(i, CELLS),
            roof(i + 1, CELLS),
        ]);
        add([foot(0, i + 1), foot(0, i), roof(0, i), roof(0, i + 1)]);
        add([
            foot(CELLS, i),
            foot(CELLS, i + 1),
            roof(CELLS, i + 1),
            roof(CELLS, i),
        ]);
    }
    House {
        mesh: TriangleMesh::from_triangles(triangles),
        block: Some(rectangle([0.0; 2], [width, depth], top, put)),
        is_intricate: false,
    }
}

impl Display for RoofFinding {
    fn fmt(&self, f: &mut Formatter) -> Result {
        writeln!(
            f,
            "false occlusion in scene {} (roofs): from {:?}, range {}, prisms {}, one can see {:?} of",
            self.scene,
            self.query.eye.to_array(),
            self.query.range,
            self.query.prisms,
            self.witness.to_array()
        )?;
        writeln!(f, "  {:?}", self.house)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::QUERIES;

    #[test]
    fn roofs_hide_and_are_hidden_and_nothing_is_lost() {
        let mut counts = Counts::default();
        let mut hiding = [0; 2];
        for number in 0..300 {
            let mut trial = RoofTrial::new(3, number);
            trial.run(&mut PointSolver::default(), QUERIES);
            assert!(trial.findings.is_empty(), "{}", trial.findings[0]);
            counts += trial.counts;
            for feature in trial.houses.iter().zip(0..).map(House::feature) {
                let roof = feature.roof.as_ref();
                hiding[usize::from(roof.is_some_and(|roof| roof.hides))] += 1;
            }
        }
        assert_eq!(counts.queries, 300 * QUERIES);
        assert!(hiding.iter().all(|&count| count > 300), "{hiding:?}");
        assert!(8 * counts.left_out > counts.features, "{counts:?}");
        assert!(2 * counts.seen > counts.looked_at, "{counts:?}");
    }
}
