//! How fast the checkers are on a generated city: `cargo run --release -p oracle --example
//! throughput`. One line a checker, one thread.

use std::hint::black_box;
use std::time::Instant;

use fastrand::Rng;
use oracle::{
    Aabb, Column, ColumnIndex, Mesh, Occluder, OccluderIndex, PlanPoint, Point, Prism, RayCaster,
    Sight, Triangle, check_column, check_inner_envelope, check_volume, sample_column,
    surface_samples,
};

/// Where the city lies.
const ORIGIN: Point = [85_000.0, 447_000.0, 0.0];

fn main() {
    volumes();
    inner_envelopes();
    columns();
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

/// A house turned by some angle, each wall cut into seven: an outline of 28 corners.
fn turned_outline(house: &Aabb, angle: f64) -> Vec<PlanPoint> {
    let (sin, cos) = angle.sin_cos();
    let [x0, y0, _] = house.min;
    let [x1, y1, _] = house.max;
    let corners = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]];
    let points = (0..28).map(|i| {
        let ([ax, ay], [bx, by]) = (corners[i / 7], corners[(i / 7 + 1) % 4]);
        let along = (i % 7) as f64 / 7.0;
        let (x, y) = (ax + along * (bx - ax) - x0, ay + along * (by - ay) - y0);
        [x0 + cos * x - sin * y, y0 + sin * x + cos * y]
    });
    points.collect()
}

/// The closed mesh over an outline: 108 triangles over 28 corners.
fn house_mesh(outline: &[PlanPoint], top: f64) -> Mesh {
    let count = outline.len();
    let at = |i: usize, z: f64| [outline[i % count][0], outline[i % count][1], z];
    let caps = (1..count - 1).flat_map(|i| {
        [
            [at(0, 0.0), at(i + 1, 0.0), at(i, 0.0)],
            [at(0, top), at(i, top), at(i + 1, top)],
        ]
    });
    let walls = (0..count).flat_map(|i| {
        [
            [at(i, 0.0), at(i + 1, 0.0), at(i + 1, top)],
            [at(i, 0.0), at(i + 1, top), at(i, top)],
        ]
    });
    Mesh::from_triangles(&caps.chain(walls).collect::<Vec<Triangle>>())
}

/// Eight columns of a house: two that touch its walls all around, six a centimetre inside.
fn house_columns(outline: &[PlanPoint], top: f64) -> Vec<Column> {
    let middle: PlanPoint = [0, 14]
        .map(|i| outline[i])
        .iter()
        .fold([0.0; 2], |sum, corner| {
            [sum[0] + 0.5 * corner[0], sum[1] + 0.5 * corner[1]]
        });
    let inner: Vec<PlanPoint> = outline
        .iter()
        .step_by(7)
        .map(|corner| [0, 1].map(|i| middle[i] + 0.998 * (corner[i] - middle[i])))
        .collect();
    (0..8)
        .filter_map(|i| {
            let ring = if i < 2 {
                outline.to_vec()
            } else {
                inner.clone()
            };
            let [bottom, top] = [i, i + 1].map(|step| top * f64::from(step) / 8.0);
            Column::new(&[ring], bottom, top, true).ok()
        })
        .collect()
}

fn columns() {
    let mut rng = Rng::with_seed(6);
    let houses: Vec<(Mesh, Vec<Column>)> = houses(33, &mut rng)
        .iter()
        .map(|house| {
            let outline = turned_outline(house, 0.4 * rng.f64());
            let top = house.max[2];
            (house_mesh(&outline, top), house_columns(&outline, top))
        })
        .collect();
    let pairs = || {
        let pairs = houses
            .iter()
            .map(|(mesh, columns)| columns.iter().map(move |c| (mesh, c)));
        pairs.flatten()
    };
    let count = pairs().count();
    let start = Instant::now();
    let right = pairs().filter(|(mesh, column)| check_column(mesh, column).is_ok());
    report("solid columns", count, start, right.count());

    let each = 1_000_000 / count;
    let start = Instant::now();
    let wrong = pairs().map(|(mesh, column)| sample_column(mesh, column, each, 7).len());
    report("column samples", each * count, start, wrong.sum());

    let tagged: Vec<(u32, Column)> = (0..)
        .zip(&houses)
        .flat_map(|(id, (_, columns))| columns.iter().map(move |column| (id, column.clone())))
        .collect();
    let index = ColumnIndex::new(&tagged);
    let start = Instant::now();
    let hidden = (0..300_000)
        .filter(|_| {
            let [eye, target] = [street_point(33, &mut rng), street_point(33, &mut rng)];
            index.hiding(eye, target, u32::MAX).is_some()
        })
        .count();
    report("points hidden by columns", 300_000, start, hidden);
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
