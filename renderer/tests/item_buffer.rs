//! The item buffer against scenes whose answer is known, and against brute force.

use proptest::prelude::*;
use renderer::{CubeMap, Error, Face, Renderer, SceneMesh, pixel_direction};
use std::collections::BTreeSet;
use std::sync::LazyLock;

static RENDERER: LazyLock<Renderer> = LazyLock::new(|| Renderer::new().unwrap());

/// Two triangles from four corners in order around.
fn add_quad(mesh: &mut SceneMesh, id: u32, corners: [[f64; 3]; 4]) {
    let base = mesh.positions.len() as u32;
    mesh.positions.extend(corners);
    mesh.triangles
        .extend([[base, base + 1, base + 2], [base, base + 2, base + 3]]);
    mesh.ids.extend([id, id]);
}

/// An upright square across +y, `half` to each side of the axis.
fn screen(y: f64, half: f64) -> [[f64; 3]; 4] {
    [
        [-half, y, -half],
        [half, y, -half],
        [half, y, half],
        [-half, y, half],
    ]
}

fn floor(z: f64, half: f64) -> [[f64; 3]; 4] {
    [
        [-half, -half, z],
        [half, -half, z],
        [half, half, z],
        [-half, half, z],
    ]
}

fn scene(quads: &[(u32, [[f64; 3]; 4])]) -> SceneMesh {
    let mut mesh = SceneMesh::default();
    quads
        .iter()
        .for_each(|&(id, corners)| add_quad(&mut mesh, id, corners));
    mesh
}

fn ids(mesh: &SceneMesh, eye: [f64; 3], resolution: u32) -> Vec<u32> {
    RENDERER
        .cube_map(mesh, eye, resolution)
        .unwrap()
        .seen()
        .into_keys()
        .collect()
}

#[test]
fn a_quad_hides_another_from_one_side_only() {
    let mesh = scene(&[
        (2, screen(20.0, 1.0)),
        (1, screen(10.0, 1.0)),
        (3, screen(30.0, 4.0)),
    ]);
    assert_eq!(ids(&mesh, [0.0; 3], 64), [1, 3]);
    assert_eq!(ids(&mesh, [0.0, 25.0, 0.0], 64), [2, 3]);
    assert_eq!(ids(&mesh, [0.0, 40.0, 0.0], 64), [3]);
    assert_eq!(ids(&mesh, [9.0, 15.0, 0.0], 64), [1, 2, 3]);
}

#[test]
fn pixels_are_counted_and_placed() {
    let map = RENDERER
        .cube_map(&scene(&[(5, screen(10.0, 5.0))]), [0.0; 3], 64)
        .unwrap();
    let seen = map.seen()[&5];
    assert_eq!((seen.pixels, seen.face), (32 * 32, Face::North));
    let columns: BTreeSet<u32> = (0..64)
        .filter(|&x| map.id(Face::North, x, 32) == Some(5))
        .collect();
    assert_eq!(columns, (16..48).collect());
    assert_eq!(map.id(Face::North, seen.x, seen.y), Some(5));
}

#[test]
fn id_zero_hides_and_is_not_seen() {
    let mesh = scene(&[(0, screen(10.0, 5.0)), (4, screen(20.0, 5.0))]);
    assert!(ids(&mesh, [0.0; 3], 64).is_empty());
}

#[test]
fn nothing_is_seen_in_an_empty_scene() {
    assert!(ids(&SceneMesh::default(), [1.0, 2.0, 3.0], 16).is_empty());
}

#[test]
fn streamed_and_kept_faces_agree() {
    let mesh = scene(&[
        (1, screen(10.0, 3.0)),
        (2, screen(-7.0, 5.0)),
        (3, floor(-2.0, 50.0)),
    ]);
    // A resolution whose rows need padding, and one below the smallest row.
    for resolution in [1, 7, 100] {
        let mut item_buffer = RENDERER.item_buffer(&mesh, resolution).unwrap();
        for eye in [[0.0; 3], [1.0, 4.0, 2.0], [-20.0, 0.5, 0.0]] {
            let map = item_buffer.cube_map(eye).unwrap();
            assert_eq!(map.resolution(), resolution);
            assert_eq!(item_buffer.seen(eye).unwrap(), map.seen());
        }
    }
}

#[test]
fn a_far_sliver_is_seen_through_a_gap_at_4096() {
    // A gap of 2 cm at 10 m: 4 pixels of 4096. Behind it, at 2 km, a wall.
    let wall = |from: f64, to: f64| {
        [
            [from, 10.0, -9.0],
            [to, 10.0, -9.0],
            [to, 10.0, 9.0],
            [from, 10.0, 9.0],
        ]
    };
    let mesh = scene(&[
        (1, wall(-9.0, -0.01)),
        (2, wall(0.01, 9.0)),
        (3, screen(2000.0, 30.0)),
    ]);
    let mut item_buffer = RENDERER.item_buffer(&mesh, 4096).unwrap();
    let seen = item_buffer.seen([0.0; 3]).unwrap();
    assert_eq!(seen.keys().copied().collect::<Vec<_>>(), [1, 2, 3]);
    let sliver = seen[&3];
    assert_eq!((sliver.face, sliver.pixels % 4), (Face::North, 0));
    assert!((2046..2050).contains(&sliver.x), "{sliver:?}");
    let [x, y, _] = pixel_direction(sliver.face, sliver.x, sliver.y, 4096);
    assert!((10.0 * x / y).abs() < 0.01);
}

#[test]
fn an_eye_close_to_a_wall_sees_the_wall_and_the_rest() {
    let around = [
        (2, screen(-5.0, 9.0)),
        (3, floor(-2.0, 100.0)),
        (4, screen(3.0, 0.1)),
    ];
    for distance in [1.0, 0.01, 0.001, 0.000_2] {
        let mut quads = vec![(1, screen(distance, 50.0))];
        quads.extend(around);
        let map = RENDERER.cube_map(&scene(&quads), [0.0; 3], 128).unwrap();
        assert!(
            map.face(Face::North).iter().all(|&id| id == 1),
            "at {distance} m"
        );
        assert_eq!(
            map.seen().into_keys().collect::<Vec<_>>(),
            [1, 2, 3],
            "at {distance} m"
        );
    }
}

#[test]
fn ground_that_passes_under_the_eye_fills_the_lower_half() {
    let n = 256_u32;
    for height in [1.75, 0.01, 0.000_5] {
        let mesh = scene(&[(1, floor(-height, 1e4))]);
        let seen = RENDERER.cube_map(&mesh, [0.0; 3], n).unwrap().seen();
        assert_eq!(
            seen[&1].pixels,
            3 * u64::from(n * n),
            "eye {height} m above the ground"
        );
    }
}

#[test]
fn a_triangle_through_the_near_plane_takes_no_other_along() {
    // A sheet through the eye itself, or closer above it than the near plane; below it a ring of
    // posts.
    for height in [0.0, 0.000_05, 0.001] {
        let mut mesh = scene(&[(1, floor(height, 50.0))]);
        for post in 0..36_u32 {
            let (sin, cos) = f64::from(10 * post + 3).to_radians().sin_cos();
            let at = |side: f64, z: f64| [30.0 * cos - side * sin, 30.0 * sin + side * cos, z];
            let corners = [at(-1.0, -6.0), at(1.0, -6.0), at(1.0, -1.0), at(-1.0, -1.0)];
            add_quad(&mut mesh, 100 + post, corners);
        }
        let seen = ids(&mesh, [0.0; 3], 256);
        assert!(
            (100..136).all(|id| seen.contains(&id)),
            "{height} m: {seen:?}"
        );
    }
}

#[test]
fn a_wall_beside_the_eye_hides_what_is_a_centimetre_behind_it() {
    let wall = |x: f64| {
        [
            [x, -1.0, -5.0],
            [x, 100.0, -5.0],
            [x, 100.0, 5.0],
            [x, -1.0, 5.0],
        ]
    };
    let mesh = scene(&[(2, wall(0.31)), (1, wall(0.3))]);
    assert_eq!(ids(&mesh, [0.0; 3], 1024), [1]);
}

#[test]
fn map_coordinates_cost_nothing() {
    // Multiples of 1/1024, so that the shifted scene is the same scene.
    let mut state = 9_u64;
    let mut next = || {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        ((state >> 40) % 65536) as f64 / 1024.0 - 32.0
    };
    let mut mesh = SceneMesh::default();
    for id in 1..=40 {
        add_quad(
            &mut mesh,
            id,
            std::array::from_fn(|_| [next(), next(), next()]),
        );
    }
    let eye = [0.5, -0.25, 1.75];
    let shift = [85_000.0, 447_000.0, 40.0];
    let moved = |p: [f64; 3]| -> [f64; 3] { std::array::from_fn(|axis| p[axis] + shift[axis]) };
    let mut far = mesh.clone();
    far.positions.iter_mut().for_each(|p| *p = moved(*p));
    let near_map: CubeMap = RENDERER.cube_map(&mesh, eye, 256).unwrap();
    assert!(near_map.seen().len() > 5);
    assert_eq!(near_map, RENDERER.cube_map(&far, moved(eye), 256).unwrap());
}

#[test]
fn more_triangles_than_one_draw_holds() {
    let count = (1 << 19) + 1000;
    let mut behind = SceneMesh {
        positions: vec![[-1.0, 20.0, -1.0], [1.0, 20.0, -1.0], [0.0, 20.0, 1.0]],
        triangles: vec![[0, 1, 2]; count],
        ids: vec![9; count],
    };
    *behind.ids.last_mut().unwrap() = 8;
    assert_eq!(ids(&behind, [0.0; 3], 32), [9]);
    let mut first = scene(&[(1, screen(10.0, 8.0))]);
    let mut last = behind.clone();
    add_quad(&mut last, 1, screen(10.0, 8.0));
    first.positions.extend(&behind.positions);
    first
        .triangles
        .extend(behind.triangles.iter().map(|t| t.map(|corner| corner + 4)));
    first.ids.extend(&behind.ids);
    assert_eq!(ids(&first, [0.0; 3], 32), [1]);
    assert_eq!(ids(&last, [0.0; 3], 32), [1]);
}

#[test]
fn refusals_quote_the_value() {
    let mesh = scene(&[(1, screen(10.0, 1.0))]);
    let refusal = |eye, resolution| RENDERER.cube_map(&mesh, eye, resolution).unwrap_err();
    assert!(matches!(
        refusal([0.0; 3], 0),
        Error::Resolution { asked: 0, .. }
    ));
    let beyond = RENDERER.max_resolution() + 1;
    assert!(
        refusal([0.0; 3], beyond)
            .to_string()
            .contains(&beyond.to_string())
    );
    assert!(refusal([0.0, f64::NAN, 0.0], 8).to_string().contains("NaN"));
    let broken = SceneMesh {
        ids: vec![],
        ..mesh.clone()
    };
    assert!(matches!(
        RENDERER.cube_map(&broken, [0.0; 3], 8),
        Err(Error::Mesh(_))
    ));
}

type Triangle = [[f64; 3]; 3];

fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| a[i] - b[i])
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|i| a[i] * b[i]).sum()
}

/// Where along `direction` from the origin the ray meets the triangle (Möller and Trumbore 1997).
fn hit([a, b, c]: Triangle, direction: [f64; 3]) -> Option<f64> {
    let (e1, e2) = (sub(b, a), sub(c, a));
    let p = cross(direction, e2);
    let determinant = dot(e1, p);
    if determinant == 0.0 {
        return None;
    }
    let s = a.map(|coordinate| -coordinate);
    let u = dot(s, p) / determinant;
    let q = cross(s, e1);
    let v = dot(direction, q) / determinant;
    let t = dot(e2, q) / determinant;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0).then_some(t)
}

/// Ids that a ray may see: the nearest, and those within the precision of f32 depth.
fn seen_along(triangles: &[Triangle], direction: [f64; 3]) -> Vec<u32> {
    let hits: Vec<_> = triangles
        .iter()
        .map(|&triangle| hit(triangle, direction))
        .collect();
    let Some(nearest) = hits.iter().flatten().copied().reduce(f64::min) else {
        return vec![0];
    };
    let near = |t: f64| t <= nearest * 1.000_1;
    (0..)
        .zip(&hits)
        .filter(|(_, t)| t.is_some_and(near))
        .map(|(i, _)| i + 1)
        .collect()
}

/// The pixel's ray, moved by a part of a pixel.
fn moved_direction(face: Face, x: u32, y: u32, n: u32, [dx, dy]: [f64; 2]) -> [f64; 3] {
    let centre = pixel_direction(face, x, y, n);
    let right = sub(pixel_direction(face, x + 1, y, n), centre);
    let down = sub(pixel_direction(face, x, y + 1, n), centre);
    std::array::from_fn(|axis| centre[axis] + dx * right[axis] + dy * down[axis])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    /// Every pixel of a random scene sees what its ray meets first; within 1/64 pixel of an edge,
    /// what a ray this far beside it meets.
    #[test]
    fn every_pixel_agrees_with_its_ray(
        triangles in prop::collection::vec(
            prop::array::uniform3(prop::array::uniform3(-20.0..20.0f64)), 1..40),
        origin in prop::sample::select(vec![[0.0; 3], [85_000.0, 447_000.0, 3.0]]),
    ) {
        // What passes nearer than the near plane, a tenth of a millimetre, is not drawn.
        prop_assume!(triangles.iter().all(|&[p, q, r]| {
            let (u, v) = (sub(q, p), sub(r, p));
            let normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
            let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
            dot(normal, p).abs() > 0.001 * dot(normal, normal).sqrt()
        }));
        let n = 48;
        let mut mesh = SceneMesh::default();
        for (id, triangle) in (1..).zip(&triangles) {
            let base = mesh.positions.len() as u32;
            mesh.positions.extend(
                triangle.map(|p| -> [f64; 3] { std::array::from_fn(|axis| p[axis] + origin[axis]) }));
            mesh.triangles.push([base, base + 1, base + 2]);
            mesh.ids.push(id);
        }
        let map = RENDERER.cube_map(&mesh, origin, n).unwrap();
        let mut disagreements = 0;
        for face in Face::ALL {
            for (x, y) in (0..n).flat_map(|x| (0..n).map(move |y| (x, y))) {
                let drawn = map.id(face, x, y).unwrap();
                if seen_along(&triangles, pixel_direction(face, x, y, n)).contains(&drawn) {
                    continue;
                }
                let step = [-1.0 / 64.0, 0.0, 1.0 / 64.0];
                let beside = step.iter().flat_map(|&dx| step.iter().map(move |&dy| [dx, dy]));
                let agrees = beside.into_iter().any(|by| {
                    seen_along(&triangles, moved_direction(face, x, y, n, by)).contains(&drawn)
                });
                disagreements += u32::from(!agrees);
            }
        }
        prop_assert_eq!(disagreements, 0);
    }

    /// The sample pixel of every id that is seen is a pixel of it.
    #[test]
    fn sample_pixels_show_their_id(
        quads in prop::collection::vec(
            prop::array::uniform4(prop::array::uniform3(-20.0..20.0f64)), 1..20),
    ) {
        let mut mesh = SceneMesh::default();
        for (id, corners) in (1..).zip(&quads) {
            add_quad(&mut mesh, id, *corners);
        }
        let map = RENDERER.cube_map(&mesh, [0.0; 3], 32).unwrap();
        for (id, sighting) in map.seen() {
            prop_assert_eq!(map.id(sighting.face, sighting.x, sighting.y), Some(id));
        }
    }
}
