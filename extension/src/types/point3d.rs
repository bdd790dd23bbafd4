//! `point3d`, a point in space.

use super::array::from_array;
use super::datum::fixed_length_type;
use super::number::{finite, shortest};
use super::ordering::ordered_type;
use super::text::Literal;
use super::{Raw, wire};
use crate::error::{Refusal, or_raise};
use glam::DVec3;
use pgrx::{Array, pg_extern, pg_sys};
use std::ffi::{CStr, CString};

const LITERAL: Literal = Literal {
    type_name: "point3d",
    keyword: "POINT",
    groups: &[3],
    example: "POINT(x y z)",
};

/// A point, metres.
#[repr(transparent)]
#[derive(Clone, Copy, PartialEq)]
pub struct Point3d(pub DVec3);

fixed_length_type!(Point3d, "occlusion.point3d");
ordered_type!(
    Point3d,
    point3d_equals,
    point3d_differs,
    point3d_less,
    point3d_less_or_equal,
    point3d_greater_or_equal,
    point3d_greater,
    point3d_compare,
    point3d_hash,
    point3d_hash_extended
);

impl Point3d {
    /// A point of three finite coordinates.
    pub fn checked(coordinates: [f64; 3], type_name: &str) -> Result<Self, Refusal> {
        for (value, name) in coordinates.into_iter().zip(["x", "y", "z"]) {
            finite(value, name, type_name)?;
        }
        Ok(Self(DVec3::from(coordinates)))
    }

    /// `x y z`, as in a literal.
    pub fn coordinates(&self) -> String {
        self.0.to_array().map(shortest).join(" ")
    }
}

#[pg_extern(immutable, strict, parallel_safe)]
fn point3d_in(text: &CStr) -> Point3d {
    let numbers = or_raise(LITERAL.parse(&text.to_string_lossy()));
    or_raise(Point3d::checked(
        [numbers[0], numbers[1], numbers[2]],
        "point3d",
    ))
}

#[pg_extern(immutable, strict, parallel_safe)]
fn point3d_out(point: Point3d) -> CString {
    super::text_result(format!("POINT({})", point.coordinates()))
}

#[pg_extern(immutable, strict, parallel_safe)]
fn point3d_recv(message: Raw<pg_sys::StringInfoData>) -> Point3d {
    or_raise(wire::receive(&message, "point3d").and_then(|c| Point3d::checked(c, "point3d")))
}

#[pg_extern(immutable, strict, parallel_safe)]
fn point3d_send(point: Point3d) -> Vec<u8> {
    wire::send(&point.0.to_array())
}

#[pg_extern(immutable, strict, parallel_safe)]
fn point3d_make(x: f64, y: f64, z: f64) -> Point3d {
    or_raise(Point3d::checked([x, y, z], "point3d"))
}

#[pg_extern(immutable, strict, parallel_safe)]
fn point3d_x(point: Point3d) -> f64 {
    point.0.x
}

#[pg_extern(immutable, strict, parallel_safe)]
fn point3d_y(point: Point3d) -> f64 {
    point.0.y
}

#[pg_extern(immutable, strict, parallel_safe)]
fn point3d_z(point: Point3d) -> f64 {
    point.0.z
}

#[pg_extern(immutable, strict, parallel_safe)]
fn point3d_from_array(numbers: Array<'_, f64>) -> Point3d {
    or_raise(from_array(&numbers, "point3d").and_then(|c| Point3d::checked(c, "point3d")))
}

#[pg_extern(immutable, strict, parallel_safe)]
fn point3d_to_array(point: Point3d) -> Vec<f64> {
    point.0.to_array().to_vec()
}

#[pg_extern(immutable, strict, parallel_safe)]
fn point3d_translate(point: Point3d, dx: f64, dy: f64, dz: f64) -> Point3d {
    let by = or_raise(Point3d::checked([dx, dy, dz], "translation of point3d")).0;
    or_raise(Point3d::checked((point.0 + by).to_array(), "point3d"))
}

#[pg_extern(immutable, strict, parallel_safe)]
fn point3d_distance(a: Point3d, b: Point3d) -> f64 {
    engine::Box3d::new(a.0, a.0).distance_to_point(b.0)
}
