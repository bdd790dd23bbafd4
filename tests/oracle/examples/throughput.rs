//! How fast the checkers are on a generated city: `cargo run --release -p oracle --example
//! throughput`. One line a checker, one thread.

use std::hint::black_box;
use std::time::Instant;

use fastrand::Rng;
use oracle::{
    Aabb, Mesh, Occluder, OccluderIndex, Point, Prism, RayCaster, Sight, Triangle,
    check_inner_envelope, check_volume, surface_samples,
};

/// Where the city lies.
const ORIGIN: Point = [85_000.0, 447_000.0, 0.0];

fn main() {
    volumes();
    inner_envelopes();
    single_occluders();
    lines_of_sight();
}

/// A house every 20 m, `side` x `side` of them.
fn houses(side: usize, rng: &mut Rng) -> Vec<Aabb> {
    (0..side * side)
        .map(|i| {
            let x = ORIGIN[0] + 20.0 * (i % side) as f64 + 3.0 * rng.f64();
            let y = ORIGIN[1] + 20.0 * (i / side) as f64 + 3.0 * rng.f64();
            let size = [
                8.0 + 4.0 * rng.f64(),
                8.0 + 4.0 * rng.f64(),
                6.0 + 9.0 * rng.f64(),
            ];
            Aabb::new([x, y, ORIGIN[2]], [x + size[0], y + size[1], size[2]])
        })
        .collect()
}

/// The surface of a box, each face cut into `cuts` x `cuts` squares.
fn surface(aabb: &Aabb, cuts: u32) -> Vec<Triangle> {
    let mut triangles = Vec::new();
    for (axis, upper) in (0..6).map(|face| (face / 2, face % 2 == 1)) {
        let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
        let point = |s: u32, t: u32| {
            // The last cut is the edge itself, bit for bit, or the mesh would not close.
            let along = |k: usize, step: u32| {
                if step == cuts {
                    aabb.max[k]
                } else {
                    aabb.min[k] + (aabb.max[k] - aabb.min[k]) * f64::from(step) / f64::from(cuts)
                }
            };
            let mut point = if upper { aabb.max } else { aabb.min };
            point[i] = along(i, s);
            point[j] = along(j, t);
            point
        };
        for (s, t) in (0..cuts * cuts).map(|k| (k % cuts, k / cuts)) {
            let [a, b, c, d] = [
                point(s, t),
                point(s + 1, t),
                point(s + 1, t + 1),
                point(s, t + 1),
            ];
            triangles.extend(if upper {
                [[a, b, c], [a, c, d]]
            } else {
                [[a, c, b], [a, d, c]]
            });
        }
    }
    triangles
}

/// The box half a centimetre smaller on each side: cut points of the surface are rounded.
fn shrunk(aabb: &Aabb) -> Aabb {
    Aabb::new(aabb.min.map(|x| x + 0.005), aabb.max.map(|x| x - 0.005))
}

fn report(what: &str, count: usize, start: Instant, found: usize) {
    let seconds = start.elapsed().as_secs_f64();
    println!(
        "{what}: {count} in {seconds:.2} s, {:.0}/s ({found} found)",
        count as f64 / seconds
    );
}

fn volumes() {
    let mut rng = Rng::with_seed(1);
    let start = Instant::now();
    let mut right = 0;
    let count = 1_000_000;
    for _ in 0..count {
        let [x, y] = [
            ORIGIN[0] + 1000.0 * rng.f64(),
            ORIGIN[1] + 1000.0 * rng.f64(),
        ];
        let volume = Aabb::new([x, y, 1.5], [x + 3.0, y + 2.0, 2.0]);
        let occluder = Aabb::new([x - 20.0, y + 10.0, 0.0], [x + 20.0, y + 20.0, 15.0]);
        let occludee = Aabb::new([x - 4.0, y + 30.0, 0.0], [x + 8.0, y + 40.0, 12.0]);
        let prisms: Vec<Prism> = Prism::of_box(&occluder, true).into_iter().collect();
        right += usize::from(check_volume(&volume, &prisms, &occludee).is_ok());
    }
    report("occlusion volumes", count, start, right);
}

fn inner_envelopes() {
    let mut rng = Rng::with_seed(2);
    let meshes: Vec<(Mesh, Aabb)> = houses(33, &mut rng)
        .iter()
        .map(|house| (Mesh::from_triangles(&surface(house, 3)), shrunk(house)))
        .collect();
    let start = Instant::now();
    let right = meshes
        .iter()
        .filter(|(mesh, inner)| check_inner_envelope(mesh, inner, true).is_ok());
    report("inner envelopes", meshes.len(), start, right.count());
}

fn single_occluders() {
    let mut rng = Rng::with_seed(3);
    let houses = houses(33, &mut rng);
    let occluders: Vec<Occluder> = houses
        .iter()
        .zip(0..)
        .filter_map(|(house, id)| {
            let solid = Prism::of_box(house, true).ok()?;
            Some(Occluder { id, solid })
        })
        .collect();
    let start = Instant::now();
    let index = OccluderIndex::new(&occluders);
    let eyes: Vec<Point> = (0..300).map(|_| street_point(33, &mut rng)).collect();
    let hidden = eyes
        .iter()
        .flat_map(|eye| {
            houses
                .iter()
                .zip(0..)
                .map(move |(house, id)| (eye, house, id))
        })
        .filter(|(eye, house, id)| index.hiding(**eye, *id, house).is_some())
        .count();
    report("single occluders", eyes.len() * houses.len(), start, hidden);
}

fn lines_of_sight() {
    let mut rng = Rng::with_seed(4);
    let surfaces: Vec<Vec<Triangle>> = houses(33, &mut rng)
        .iter()
        .map(|house| surface(house, 3))
        .collect();
    let triangles: Vec<(u32, Triangle)> = surfaces
        .iter()
        .zip(0..)
        .flat_map(|(surface, id)| surface.iter().map(move |triangle| (id, *triangle)))
        .collect();
    let start = Instant::now();
    let Ok(caster) = RayCaster::new(&triangles) else {
        return;
    };
    report("triangles indexed", triangles.len(), start, surfaces.len());

    let samples: Vec<Vec<Point>> = surfaces
        .iter()
        .map(|surface| surface_samples(surface, 64, 5))
        .collect();
    let segments: Vec<(Point, Point, u32)> = (0..1_000_000)
        .map(|_| {
            let id = rng.usize(..surfaces.len());
            (
                street_point(33, &mut rng),
                samples[id][rng.usize(..64)],
                id as u32,
            )
        })
        .collect();
    let start = Instant::now();
    let clear = segments
        .iter()
        .filter(|(eye, target, id)| caster.is_clear(*eye, *target, Some(*id)) == Sight::Clear)
        .count();
    report("lines of sight", segments.len(), start, clear);

    let start = Instant::now();
    let hits = segments
        .iter()
        .filter(|(eye, target, _)| {
            let direction = std::array::from_fn(|axis| target[axis] - eye[axis]);
            black_box(caster.first_hit(*eye, direction)).is_some()
        })
        .count();
    report("first hits", segments.len(), start, hits);
}

/// A point at eye height in one of the streets between the houses.
fn street_point(side: usize, rng: &mut Rng) -> Point {
    let across = 20.0 * rng.usize(..side) as f64 + 15.5 + 4.0 * rng.f64();
    let along = 20.0 * side as f64 * rng.f64();
    let [x, y] = if rng.bool() {
        [across, along]
    } else {
        [along, across]
    };
    [ORIGIN[0] + x, ORIGIN[1] + y, 1.5 + 0.5 * rng.f64()]
}
