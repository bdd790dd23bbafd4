//! Constructors of `frustum`: from vectors, from angles, and from a view-projection matrix.

use super::{Frustum, NAME};
use crate::error::{Refusal, or_raise};
use crate::types::Point3d;
use crate::types::number::{self, finite, shortest};
use glam::DVec3;
use pgrx::{Array, PgSqlErrorCode, pg_extern};

#[pg_extern(immutable, strict, parallel_safe)]
fn frustum_make(
    observer: Point3d,
    direction: Point3d,
    up: Point3d,
    fov: f64,
    aspect: f64,
    near: f64,
    far: f64,
) -> Frustum {
    frustum_make_shifted(observer, direction, up, fov, aspect, near, far, 0.0, 0.0)
}

#[pg_extern(immutable, strict, parallel_safe)]
#[expect(clippy::too_many_arguments, reason = "those of the SQL function")]
fn frustum_make_shifted(
    observer: Point3d,
    direction: Point3d,
    up: Point3d,
    fov: f64,
    aspect: f64,
    near: f64,
    far: f64,
    shift_right: f64,
    shift_up: f64,
) -> Frustum {
    let mut numbers = [0.0; 15];
    numbers[..9].copy_from_slice(
        [observer, direction, up]
            .map(|v| v.0.to_array())
            .as_flattened(),
    );
    numbers[9..].copy_from_slice(&[fov, aspect, near, far, shift_right, shift_up]);
    or_raise(Frustum::checked(numbers))
}

#[pg_extern(immutable, strict, parallel_safe)]
#[expect(clippy::too_many_arguments, reason = "those of the SQL function")]
fn frustum_make_turned(
    observer: Point3d,
    heading: f64,
    pitch: f64,
    roll: f64,
    fov: f64,
    aspect: f64,
    near: f64,
    far: f64,
) -> Frustum {
    or_raise(finite(heading, "heading", NAME));
    or_raise(number::pitch(pitch, NAME));
    or_raise(finite(roll, "roll", NAME));
    let [(east, north), (rise, level), (tilt, upright)] = [heading, pitch, roll].map(sin_cos);
    let direction = DVec3::new(east * level, north * level, rise);
    let right = DVec3::new(north, -east, 0.0);
    let up = DVec3::new(-east * rise, -north * rise, level) * upright + right * tilt;
    // Without the minus zeros that products with 0 leave.
    let [direction, up] = [direction, up].map(|vector| Point3d(vector + 0.0));
    frustum_make(observer, direction, up, fov, aspect, near, far)
}

#[pg_extern(immutable, strict, parallel_safe)]
fn frustum_from_matrix(matrix: Array<f64>, depth_from_zero: bool) -> Frustum {
    or_raise(of_matrix(&matrix, depth_from_zero))
}

/// The rows of a matrix of 16 finite numbers.
fn rows(matrix: &Array<f64>) -> Result<[[f64; 4]; 4], Refusal> {
    if matrix.len() != 16 {
        return Err(Refusal::new(
            PgSqlErrorCode::ERRCODE_ARRAY_ELEMENT_ERROR,
            format!("matrix of {NAME} has {} numbers", matrix.len()),
        )
        .detail("A view-projection matrix has 4 rows of 4 numbers, one row after the other."));
    }
    let mut rows = [[0.0; 4]; 4];
    for (place, entry) in matrix.iter().enumerate() {
        let name = format!("matrix[{}][{}]", place / 4 + 1, place % 4 + 1);
        let Some(value) = entry else {
            return Err(Refusal::new(
                PgSqlErrorCode::ERRCODE_NULL_VALUE_NOT_ALLOWED,
                format!("{name} of {NAME} must not be null"),
            ));
        };
        rows[place / 4][place % 4] = finite(value, &name, NAME)?;
    }
    Ok(rows)
}

/// The frustum of a matrix, or what keeps it from being one.
fn of_matrix(matrix: &Array<f64>, depth_from_zero: bool) -> Result<Frustum, Refusal> {
    let rows = rows(matrix)?;
    let range = if depth_from_zero {
        engine::DepthRange::ZeroToOne
    } else {
        engine::DepthRange::MinusOneToOne
    };
    let camera = engine::Camera::from_matrix(rows, range).map_err(|defect| {
        let shown = rows.map(|row| row.map(shortest).join(","));
        let refusal = Refusal::new(
            PgSqlErrorCode::ERRCODE_INVALID_PARAMETER_VALUE,
            format!("matrix of {NAME} {defect}"),
        )
        .detail(format!("The matrix is {{{}}}.", shown.join(", ")));
        match defect {
            engine::MatrixDefect::Endless => {
                refusal.hint("Give the projection a far plane: how far the observer sees.")
            }
            engine::MatrixDefect::Empty => refusal.hint(
                "Depths go from -w to w, or with depth_from_zero from 0 to w; column vectors are \
                 multiplied from the left, so the numbers may have to be transposed.",
            ),
            _ => refusal.hint(
                "A perspective view-projection matrix, by rows, is expected; columns first have to \
                 be transposed.",
            ),
        }
    })?;
    Frustum::of_camera(&camera)
}

/// Sine and cosine of an angle in degrees, exact for whole quarter turns.
fn sin_cos(degrees: f64) -> (f64, f64) {
    let turned = degrees % 360.0;
    let quarters = (turned / 90.0).round();
    let (sin, cos) = (turned - 90.0 * quarters).to_radians().sin_cos();
    match quarters.rem_euclid(4.0) as u8 {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    }
}
