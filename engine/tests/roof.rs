//! Roofs: no point of a mesh is seen higher than the edges of its roof, and few edges are left.

use engine::{Box3d, Roof, TriangleMesh};
use glam::{DVec2, DVec3};
use proptest::prelude::*;

/// Where the meshes stand: a place of the Dutch national grid.
const PLACE: DVec3 = DVec3::new(85_000.0, 447_000.0, 0.0);

/// Slack for the roundings of this test's own arithmetic.
const ROUNDING: f64 = 1e-6;

fn roof(mesh: &TriangleMesh) -> Option<Roof> {
    Roof::of(mesh, &mesh.envelope().expect("vertices"))
}

/// A mesh of quadrilaterals and triangles.
fn mesh(faces: &[&[[f64; 3]]]) -> TriangleMesh {
    let polygons = faces.iter().map(|ring| {
        let ring = ring.iter().map(|&corner| DVec3::from_array(corner) + PLACE);
        [ring.collect::<Vec<_>>()]
    });
    TriangleMesh::from_polygons(polygons)
}

/// A house of 8 by 6 metres with walls of 3 and a ridge of 5.
fn gabled() -> TriangleMesh {
    let (a, b, c, d) = ([0., 0., 0.], [8., 0., 0.], [8., 6., 0.], [0., 6., 0.]);
    let (e, f, g, h) = ([0., 0., 3.], [8., 0., 3.], [8., 6., 3.], [0., 6., 3.]);
    let (r, s) = ([0., 3., 5.], [8., 3., 5.]);
    mesh(&[
        &[a, d, c, b],
        &[a, b, f, e],
        &[c, d, h, g],
        &[b, c, g, s, f],
        &[d, a, e, r, h],
        &[e, f, s, r],
        &[g, h, r, s],
    ])
}

#[test]
fn a_gabled_roof_is_its_eaves_its_verges_and_its_ridge() {
    let roof = roof(&gabled()).expect("more than a prism");
    assert_eq!((roof.corners.len(), roof.edges.len()), (6, 7));
    let high = |end: u32| roof.corners[end as usize].z;
    let ridges = roof
        .edges
        .iter()
        .filter(|edge| edge.map(high) == [5.0, 5.0]);
    assert_eq!(ridges.count(), 1);
    // The highest come first, and the foot is seen below others.
    assert_eq!(
        roof.edges[0].map(high).iter().copied().fold(0.0, f64::max),
        5.0
    );
    assert!(roof.corners.iter().all(|corner| corner.z >= 3.0));
}

#[test]
fn a_box_is_no_more_than_its_prism() {
    let (a, b, c, d) = ([0., 0., 0.], [8., 0., 0.], [8., 6., 0.], [0., 6., 0.]);
    let (e, f, g, h) = ([0., 0., 3.], [8., 0., 3.], [8., 6., 3.], [0., 6., 3.]);
    let faces: [&[[f64; 3]]; 6] = [
        &[a, d, c, b],
        &[e, f, g, h],
        &[a, b, f, e],
        &[b, c, g, f],
        &[c, d, h, g],
        &[d, a, e, h],
    ];
    assert_eq!(roof(&mesh(&faces)), None);
}

#[test]
fn an_envelope_that_holds_more_is_trusted_more() {
    let mesh = gabled();
    let envelope = mesh.envelope().expect("vertices");
    let grown = |by: f64| envelope.expanded(by).expect("a larger box");
    assert!(Roof::of(&mesh, &grown(0.005)).is_some());
    assert_eq!(Roof::of(&mesh, &grown(0.02)), None);
    let taller = Box3d::new(envelope.min, envelope.max + DVec3::new(0.0, 0.0, 4.0));
    assert_eq!(Roof::of(&mesh, &taller), None);
    let moved = Box3d::new(envelope.min + DVec3::X, envelope.max + DVec3::X);
    assert_eq!(Roof::of(&mesh, &moved), None);
    assert_eq!(Roof::of(&TriangleMesh::default(), &envelope), None);
}

#[test]
fn a_surface_with_too_many_edges_has_none() {
    let peak =
        |x: i32, y: i32| DVec3::new(f64::from(x), f64::from(y), f64::from(x * x + y * y) * -0.1);
    let mut faces = Vec::new();
    for (x, y) in (0..40).flat_map(|x| (0..40).map(move |y| (x, y))) {
        faces.push([peak(x, y), peak(x + 1, y), peak(x + 1, y + 1)]);
        faces.push([peak(x, y), peak(x + 1, y + 1), peak(x, y + 1)]);
    }
    assert_eq!(roof(&TriangleMesh::from_triangles(faces)), None);
}

/// Boxes, gabled houses and loose triangles, which touch, overlap and overhang, turned by any angle.
fn meshes() -> impl Strategy<Value = TriangleMesh> {
    let part = (
        prop::array::uniform3(0..6i32),
        prop::array::uniform3(1..5i32),
        0..3u8,
    );
    let loose = prop::array::uniform3(prop::array::uniform3(0..8i32));
    (
        prop::collection::vec(part, 0..4),
        prop::collection::vec(loose, 0..6),
        prop_oneof![Just(0.0), 0.0..1.6f64],
    )
        .prop_filter("something", |(parts, loose, _)| {
            !parts.is_empty() || !loose.is_empty()
        })
        .prop_map(|(parts, loose, angle)| {
            let mut triangles = Vec::new();
            for (low, size, kind) in parts {
                let low = DVec3::from_array(low.map(f64::from));
                triangles.extend(solid(low, DVec3::from_array(size.map(f64::from)), kind));
            }
            let point = |corner: [i32; 3]| DVec3::from_array(corner.map(f64::from));
            triangles.extend(loose.into_iter().map(|corners| corners.map(point)));
            let rotation = DVec2::from_angle(angle);
            let put = |p: DVec3| rotation.rotate(p.truncate()).extend(p.z) + PLACE;
            TriangleMesh::from_triangles(triangles.into_iter().map(|corners| corners.map(put)))
        })
}

/// A gabled house of a low corner and a size, turned one way or the other, or with a flat roof.
fn solid(low: DVec3, size: DVec3, kind: u8) -> Vec<[DVec3; 3]> {
    let mesh = gabled();
    let corners = mesh.corners().map(|corners| {
        corners.map(|corner| {
            let [x, y, z] = (corner - PLACE).to_array();
            let z = if kind == 2 { z.min(3.0) } else { z };
            let (x, y) = if kind == 1 {
                (y / 6.0, x / 8.0)
            } else {
                (x / 8.0, y / 6.0)
            };
            low + DVec3::new(x, y, z / 5.0) * size
        })
    });
    corners.collect()
}

/// The highest slope of the edges of a roof in a direction, relative to an eye.
fn highest(roof: &Roof, eye: DVec3, direction: DVec2) -> f64 {
    let direction = direction.normalize();
    let slope = |point: DVec3| {
        let ahead = direction.dot(point.truncate());
        let is_met = direction.perp_dot(point.truncate()).abs() < 1e-7 && ahead > 0.0;
        is_met.then(|| point.z / ahead)
    };
    let of_edge = |edge: &[u32; 2]| {
        let [a, b] = edge.map(|end| roof.corners[end as usize] - eye);
        let [left, right] = [a, b].map(|end| direction.perp_dot(end.truncate()));
        let crossing = (left * right < 0.0).then(|| a + (b - a) * (left / (left - right)));
        [Some(a), Some(b), crossing]
    };
    let points = roof.edges.iter().flat_map(of_edge).flatten();
    points.filter_map(slope).fold(f64::NEG_INFINITY, f64::max)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2_000))]

    #[test]
    fn nothing_of_a_mesh_is_seen_higher_than_its_roof(
        mesh in meshes(),
        turn in 0.0..std::f64::consts::TAU,
        away in prop_oneof![12.0..14.0f64, 12.0..500.0f64],
        height in prop_oneof![Just(0.0), Just(1.0), -5.0..30.0f64],
        shares in prop::collection::vec((0.0..1.0f64, 0.0..1.0f64), 4),
    ) {
        let Some(roof) = roof(&mesh) else { return Ok(()) };
        let envelope = mesh.envelope().expect("vertices");
        let plan = envelope.center().truncate() + DVec2::from_angle(turn) * away;
        let eye = plan.extend(height);
        for [a, b, c] in mesh.corners() {
            let inner = shares.iter().map(|&(u, v)| {
                let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
                a + (b - a) * u + (c - a) * v
            });
            for point in inner.chain([a, b, c]) {
                let to = point - eye;
                let slope = to.z / to.truncate().length();
                let most = highest(&roof, eye, to.truncate());
                prop_assert!(most >= slope - ROUNDING, "{point} at {slope}, roof at {most}");
            }
        }
    }
}
