//! `frustum`, the pyramid that a camera sees.
//!
//! A value keeps a camera's numbers as they were given. The eight corners would do for the tests, but
//! nobody writes them, and a corner that is off by a rounding leaves its plane. An image that is off
//! centre, as a matrix may have it, is a shift more; a matrix is taken apart once, when it comes in, and
//! what is stored then means the same for ever.

mod constructors;

use super::datum::fixed_length_type;
use super::number::{finite, out_of_bounds, shortest};
use super::ordering::{Numbers, ordered_type};
use super::text::Literal;
use super::{Box3d, Point3d, Raw, wire};
use crate::error::{Refusal, or_raise};
use crate::field_of_view::{FieldOfView, with_prepared};
use glam::{DVec2, DVec3};
use pgrx::{PgSqlErrorCode, pg_extern, pg_sys};
use std::ffi::{CStr, CString};

/// Name of the type in SQL.
const NAME: &str = "frustum";
const EXAMPLE: &str = "FRUSTUM(x y z, dx dy dz, ux uy uz, fov, aspect, near, far[, right up])";

const CENTRED: Literal = Literal {
    type_name: NAME,
    keyword: "FRUSTUM",
    groups: &[3, 3, 3, 1, 1, 1, 1],
    example: EXAMPLE,
};

/// The text of a frustum whose image is off centre has one group more.
const SHIFTED: Literal = Literal {
    groups: &[3, 3, 3, 1, 1, 1, 1, 2],
    ..CENTRED
};

/// A frustum as the user gave it: degrees and metres.
#[repr(C)]
#[derive(Clone, Copy, PartialEq)]
pub struct Frustum {
    observer: Point3d,
    direction: Point3d,
    up: Point3d,
    fov: f64,
    aspect: f64,
    near: f64,
    far: f64,
    shift: DVec2,
}

fixed_length_type!(Frustum, "occlusion.frustum");
ordered_type!(
    Frustum,
    frustum_equals,
    frustum_differs,
    frustum_less,
    frustum_less_or_equal,
    frustum_greater_or_equal,
    frustum_greater,
    frustum_compare,
    frustum_hash,
    frustum_hash_extended
);

impl Frustum {
    /// The frustum of its numbers, in the order of the binary form.
    pub fn checked(n: [f64; 15]) -> Result<Self, Refusal> {
        let names = ["x", "y", "z", "direction x", "direction y", "direction z"]
            .into_iter()
            .chain(["up x", "up y", "up z", "fov", "aspect", "near", "far"])
            .chain(["shift right", "shift up"]);
        for (value, name) in n.into_iter().zip(names) {
            finite(value, name, NAME)?;
        }
        let vector = |from: usize| Point3d(DVec3::new(n[from], n[from + 1], n[from + 2]));
        let frustum = Self {
            observer: vector(0),
            direction: vector(3),
            up: vector(6),
            fov: n[9],
            aspect: n[10],
            near: n[11],
            far: n[12],
            shift: DVec2::new(n[13], n[14]),
        };
        frustum.has_image()?;
        frustum.has_corners()?;
        Ok(frustum)
    }

    /// Refuses numbers of the image and its depth that are out of bounds.
    fn has_image(&self) -> Result<(), Refusal> {
        let refusal = |value, name, detail| Err(out_of_bounds(value, name, NAME).detail(detail));
        if self.fov <= 0.0 || self.fov >= 180.0 {
            let detail = "The vertical field of view is more than 0 and less than 180 degrees.";
            return refusal(self.fov, "fov", detail);
        }
        if self.aspect <= 0.0 {
            let detail = "The aspect is the image's width by its height, more than 0.";
            return refusal(self.aspect, "aspect", detail);
        }
        if self.near < 0.0 {
            let detail = "The distance of the near plane is 0 or more.";
            return refusal(self.near, "near", detail);
        }
        if self.far <= self.near {
            let near = shortest(self.near);
            let detail = format!("The far plane is beyond the near plane, which is at {near}.");
            return Err(out_of_bounds(self.far, "far", NAME).detail(detail));
        }
        Ok(())
    }

    /// Refuses vectors that do not say where the corners are, and corners that are no points.
    fn has_corners(&self) -> Result<(), Refusal> {
        let (direction, up) = (self.direction.coordinates(), self.up.coordinates());
        let refusal = |message: String| {
            Refusal::new(PgSqlErrorCode::ERRCODE_NUMERIC_VALUE_OUT_OF_RANGE, message)
        };
        for (vector, name) in [(self.direction, "direction"), (self.up, "up")] {
            if vector.0 == DVec3::ZERO {
                return Err(refusal(format!(
                    "{name} {} of {NAME} has no length",
                    vector.coordinates()
                )));
            }
        }
        let Some(corners) = self.camera().corners() else {
            let message = format!("direction {direction} and up {up} of {NAME} are parallel");
            return Err(
                refusal(message).detail("The up vector says which side of the image is up.")
            );
        };
        if !corners.iter().all(|corner| corner.is_finite()) {
            return Err(
                refusal(format!("corners of {NAME} are out of bounds")).detail(format!(
                    "The far plane is at {}, the field of view is {} degrees high.",
                    shortest(self.far),
                    shortest(self.fov)
                )),
            );
        }
        Ok(())
    }

    /// The camera to compute with.
    fn camera(&self) -> engine::Camera {
        engine::Camera {
            eye: self.observer.0,
            direction: self.direction.0,
            up: self.up.0,
            fov: self.fov.to_radians(),
            aspect: self.aspect,
            near: self.near,
            far: self.far,
            shift: self.shift,
        }
    }

    /// The frustum of a camera, checked like any other.
    pub fn of_camera(camera: &engine::Camera) -> Result<Self, Refusal> {
        let vectors = [camera.eye, camera.direction, camera.up].map(|vector| vector.to_array());
        let mut numbers = [0.0; 15];
        numbers[..9].copy_from_slice(vectors.as_flattened());
        numbers[9..13].copy_from_slice(&[
            camera.fov.to_degrees(),
            camera.aspect,
            camera.near,
            camera.far,
        ]);
        numbers[13..].copy_from_slice(&camera.shift.to_array());
        // Without the minus zeros that a matrix's zeros leave.
        Self::checked(numbers.map(|number| number + 0.0))
    }

    /// The eye, and the distance of what is farthest from it in metres.
    pub fn eye_and_range(&self) -> (DVec3, f64) {
        let reach = self
            .in_radians()
            .map_or(f64::MAX, |frustum| frustum.reach());
        (self.observer.0, reach)
    }

    /// The frustum to compute with; there is one, or the value would have been refused.
    pub fn in_radians(&self) -> Option<engine::Frustum> {
        engine::Frustum::new(&self.camera())
    }
}

#[pg_extern(immutable, strict, parallel_safe)]
fn frustum_in(text: &CStr) -> Frustum {
    let text = text.to_string_lossy();
    let shifted = text.matches(',').count() == CENTRED.groups.len();
    let literal = if shifted { &SHIFTED } else { &CENTRED };
    let given = or_raise(literal.parse(&text));
    let mut numbers = [0.0; 15];
    numbers[..given.len()].copy_from_slice(&given);
    or_raise(Frustum::checked(numbers))
}

#[pg_extern(immutable, strict, parallel_safe)]
fn frustum_out(frustum: Frustum) -> CString {
    let vectors = [frustum.observer, frustum.direction, frustum.up].map(|v| v.coordinates());
    let image = [frustum.fov, frustum.aspect, frustum.near, frustum.far].map(shortest);
    // A shift of minus zero is written out: text keeps every bit.
    let centred = frustum.shift.to_array().iter().all(|n| n.to_bits() == 0);
    let shift = (!centred).then(|| frustum.shift.to_array().map(shortest).join(" "));
    let groups: Vec<String> = vectors.into_iter().chain(image).chain(shift).collect();
    super::text_result(format!("FRUSTUM({})", groups.join(", ")))
}

#[pg_extern(immutable, strict, parallel_safe)]
fn frustum_recv(message: Raw<pg_sys::StringInfoData>) -> Frustum {
    or_raise(wire::receive(&message, NAME).and_then(Frustum::checked))
}

#[pg_extern(immutable, strict, parallel_safe)]
fn frustum_send(frustum: Frustum) -> Vec<u8> {
    wire::send(frustum.numbers())
}

#[pg_extern(immutable, strict, parallel_safe)]
fn frustum_observer(frustum: Frustum) -> Point3d {
    frustum.observer
}

#[pg_extern(immutable, strict, parallel_safe)]
fn frustum_direction(frustum: Frustum) -> Point3d {
    frustum.direction
}

#[pg_extern(immutable, strict, parallel_safe)]
fn frustum_up(frustum: Frustum) -> Point3d {
    frustum.up
}

#[pg_extern(immutable, strict, parallel_safe)]
fn frustum_fov(frustum: Frustum) -> f64 {
    frustum.fov
}

#[pg_extern(immutable, strict, parallel_safe)]
fn frustum_aspect(frustum: Frustum) -> f64 {
    frustum.aspect
}

#[pg_extern(immutable, strict, parallel_safe)]
fn frustum_near(frustum: Frustum) -> f64 {
    frustum.near
}

#[pg_extern(immutable, strict, parallel_safe)]
fn frustum_far(frustum: Frustum) -> f64 {
    frustum.far
}

#[pg_extern(immutable, strict, parallel_safe)]
fn frustum_shift_right(frustum: Frustum) -> f64 {
    frustum.shift.x
}

#[pg_extern(immutable, strict, parallel_safe)]
fn frustum_shift_up(frustum: Frustum) -> f64 {
    frustum.shift.y
}

#[pg_extern(immutable, strict, parallel_safe)]
fn frustum_corners(frustum: Frustum) -> Vec<Point3d> {
    let corners = frustum.camera().corners();
    corners.into_iter().flatten().map(Point3d).collect()
}

#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_meets_frustum(call: pg_sys::FunctionCallInfo, target: Box3d, frustum: Frustum) -> bool {
    with_prepared(call, FieldOfView::Frustum(frustum), |view| {
        view.meets(&target.0)
    })
}

#[pg_extern(immutable, strict, parallel_safe)]
fn frustum_meets_box3d(call: pg_sys::FunctionCallInfo, frustum: Frustum, target: Box3d) -> bool {
    with_prepared(call, FieldOfView::Frustum(frustum), |view| {
        view.meets(&target.0)
    })
}
