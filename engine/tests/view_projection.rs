//! Cameras out of matrices that another library made.

use engine::{Box3d, Camera, DepthRange, Frustum, MatrixDefect};
use glam::dcamera::rh::{proj, view};
use glam::{DMat4, DVec2, DVec3, DVec4};
use proptest::prelude::*;

fn rows(matrix: DMat4) -> [[f64; 4]; 4] {
    matrix.transpose().to_cols_array_2d()
}

/// A camera, its matrix by one of the conventions, and that convention's depth range.
fn projected(camera: &Camera, convention: usize) -> (DMat4, DepthRange) {
    let Camera { eye, near, far, .. } = *camera;
    let height = (camera.fov / 2.0).tan() * near;
    let width = height * camera.aspect;
    let [left, right] = [-1.0, 1.0].map(|side| (camera.shift.x + side) * width);
    let [bottom, top] = [-1.0, 1.0].map(|side| (camera.shift.y + side) * height);
    let looking = view::look_to_mat4(eye, camera.direction.normalize(), camera.up.normalize());
    // Near and far change places: so the depths are reversed.
    let reversed = DMat4::from_cols(
        DVec4::X,
        DVec4::Y,
        DVec4::new(0.0, 0.0, -1.0, 0.0),
        DVec4::new(0.0, 0.0, 1.0, 1.0),
    );
    let zero_to_one = proj::directx::frustum(left, right, bottom, top, near, far);
    let (projection, range) = match convention {
        0 => (
            proj::opengl::frustum(left, right, bottom, top, near, far),
            DepthRange::MinusOneToOne,
        ),
        1 => (zero_to_one, DepthRange::ZeroToOne),
        2 => (
            proj::vulkan::frustum(left, right, bottom, top, near, far),
            DepthRange::ZeroToOne,
        ),
        _ => (reversed * zero_to_one, DepthRange::ZeroToOne),
    };
    (projection * looking, range)
}

fn vector() -> impl Strategy<Value = DVec3> {
    prop::array::uniform3(-1.0..1.0f64).prop_map(DVec3::from)
}

fn camera() -> impl Strategy<Value = Camera> {
    let origin = prop_oneof![
        Just(DVec3::ZERO),
        Just(DVec3::new(85_000.0, 447_000.0, 1.7))
    ];
    let image = (0.1..2.8f64, 0.2..4.0f64, -1.5..1.5f64, -1.5..1.5f64);
    (
        origin,
        vector(),
        vector(),
        image,
        0.05..2.0f64,
        5.0..800.0f64,
    )
        .prop_filter("parallel", |(_, direction, up, ..)| {
            direction
                .normalize_or_zero()
                .cross(up.normalize_or_zero())
                .length()
                > 0.05
        })
        .prop_map(
            |(eye, direction, up, (fov, aspect, x, y), near, far)| Camera {
                eye,
                direction,
                up,
                fov,
                aspect,
                near,
                far,
                shift: DVec2::new(x, y),
            },
        )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn a_matrix_gives_back_its_camera(camera in camera(), convention in 0..4usize, scale in 1e-9..1e9f64) {
        let (matrix, range) = projected(&camera, convention);
        let found = Camera::from_matrix(rows(matrix * scale), range).expect("a camera's matrix");
        let (wanted, got) = (camera.corners().expect("not parallel"), found.corners().expect("not parallel"));
        for (i, (a, b)) in wanted.into_iter().zip(got).enumerate() {
            // Far planes are ill determined by a matrix: by the ratio of far and near.
            let distance = (a - camera.eye).length();
            let most = if i < 4 { 1e-7 } else { 1e-8 * camera.far / camera.near };
            prop_assert!((a - b).length() <= most * (1.0 + distance), "{i}: {a} {b}");
        }
        prop_assert!((found.eye - camera.eye).length() < 1e-8);
    }

    #[test]
    fn what_passes_in_clip_space_is_met(camera in camera(), convention in 0..4usize, ndc in prop::array::uniform3(-1.2..1.2f64)) {
        let (matrix, range) = projected(&camera, convention);
        let point = matrix.inverse().project_point3(DVec3::from(ndc));
        let clip = matrix * point.extend(1.0);
        let from = if range == DepthRange::ZeroToOne { 0.0 } else { -clip.w };
        // How far inside, by clip space's own measure.
        let depth = [clip.w - clip.x.abs(), clip.w - clip.y.abs(), clip.z - from, clip.w - clip.z]
            .into_iter().fold(f64::INFINITY, f64::min) / clip.w.abs();
        let found = Camera::from_matrix(rows(matrix), range).expect("a camera's matrix");
        let meets = Frustum::new(&found).expect("not parallel").meets(&Box3d::new(point, point));
        if clip.w > 0.0 && depth > 1e-6 {
            prop_assert!(meets);
        }
        if clip.w < 0.0 || depth < -1e-6 {
            prop_assert!(!meets);
        }
    }
}

#[test]
fn matrices_that_no_camera_has_are_told_apart() {
    let defect = |matrix: DMat4, range| Camera::from_matrix(rows(matrix), range).err();
    let gl = proj::opengl::perspective(1.0, 1.5, 0.1, 100.0);
    let (both, zero) = (DepthRange::MinusOneToOne, DepthRange::ZeroToOne);
    assert_eq!(defect(gl, both), None);
    assert_eq!(defect(DMat4::ZERO, both), Some(MatrixDefect::Singular));
    assert_eq!(
        defect(DMat4::IDENTITY, both),
        Some(MatrixDefect::Orthographic)
    );
    let orthographic = proj::opengl::orthographic(-1.0, 1.0, -1.0, 1.0, 0.1, 9.0);
    assert_eq!(defect(orthographic, both), Some(MatrixDefect::Orthographic));
    let flat = DMat4::from_scale(DVec3::new(1.0, 0.0, 1.0)) * gl;
    assert_eq!(defect(flat, both), Some(MatrixDefect::Singular));
    let infinite = proj::directx::perspective_infinite(1.0, 1.5, 0.1);
    assert_eq!(defect(infinite, zero), Some(MatrixDefect::Endless));
    let reversed = proj::directx::perspective_infinite_reverse(1.0, 1.5, 0.1);
    assert_eq!(defect(reversed, zero), Some(MatrixDefect::Endless));
    assert_eq!(defect(-gl, both), Some(MatrixDefect::Empty));
    let shear = DMat4::from_cols(DVec4::X, DVec4::new(0.1, 1.0, 0.0, 0.0), DVec4::Z, DVec4::W);
    assert_eq!(defect(gl * shear, both), Some(MatrixDefect::Sheared));
    let mut oblique = gl.transpose();
    oblique.z_axis += DVec4::new(0.1, 0.0, 0.0, 0.0);
    assert_eq!(
        defect(oblique.transpose(), both),
        Some(MatrixDefect::Oblique)
    );
}

#[test]
fn a_matrix_of_single_precision_is_a_camera_too() {
    let camera = Camera {
        eye: DVec3::new(30.0, -20.0, 1.7),
        direction: DVec3::new(0.3, 0.9, -0.1),
        up: DVec3::Z,
        fov: 1.0,
        aspect: 1.6,
        near: 0.5,
        far: 300.0,
        shift: DVec2::ZERO,
    };
    for convention in 0..4 {
        let (matrix, range) = projected(&camera, convention);
        let single = rows(matrix).map(|row| row.map(|entry| f64::from(entry as f32)));
        let found = Camera::from_matrix(single, range).expect("a camera's matrix");
        assert!((found.eye - camera.eye).length() < 1e-4, "{found:?}");
        assert!((found.far / camera.far - 1.0).abs() < 1e-2, "{found:?}");
    }
}
