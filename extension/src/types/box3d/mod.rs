//! `box3d`, an axis-aligned box.

mod measures;
mod relations;

use super::array::from_array;
use super::datum::fixed_length_type;
use super::ordering::ordered_type;
use super::text::Literal;
use super::{Point3d, Raw, wire};
use crate::error::{Refusal, or_raise};
use glam::DVec3;
use pgrx::{Array, pg_extern, pg_sys};
use std::ffi::{CStr, CString};

const LITERAL: Literal = Literal {
    type_name: "box3d",
    keyword: "BOX3D",
    groups: &[3, 3],
    example: "BOX3D(xmin ymin zmin, xmax ymax zmax)",
};

/// A closed box, metres: the least corner, then the greatest.
#[repr(transparent)]
#[derive(Clone, Copy)]
pub struct Box3d(pub engine::Box3d);

fixed_length_type!(Box3d, "occlusion.box3d");
ordered_type!(
    Box3d,
    box3d_equals,
    box3d_differs,
    box3d_less,
    box3d_less_or_equal,
    box3d_greater_or_equal,
    box3d_greater,
    box3d_compare,
    box3d_hash,
    box3d_hash_extended
);

impl Box3d {
    /// The box of six finite coordinates, its corners sorted.
    pub fn checked(c: [f64; 6]) -> Result<Self, Refusal> {
        let corner = Point3d::checked([c[0], c[1], c[2]], "box3d")?;
        let opposite = Point3d::checked([c[3], c[4], c[5]], "box3d")?;
        Ok(Self(engine::Box3d::new(corner.0, opposite.0)))
    }

    /// The middle. Halved first: the sum of two huge coordinates is infinite.
    pub fn center(&self) -> DVec3 {
        self.0.min * 0.5 + self.0.max * 0.5
    }

    /// A box that was computed, unless it left the bounds of numbers.
    fn finite(value: engine::Box3d) -> Result<Self, Refusal> {
        Point3d::checked(value.min.to_array(), "box3d")?;
        Point3d::checked(value.max.to_array(), "box3d")?;
        Ok(Self(value))
    }
}

#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_in(text: &CStr) -> Box3d {
    let n = or_raise(LITERAL.parse(&text.to_string_lossy()));
    or_raise(Box3d::checked([n[0], n[1], n[2], n[3], n[4], n[5]]))
}

#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_out(value: Box3d) -> CString {
    let corner = |point| Point3d(point).coordinates();
    super::text_result(format!(
        "BOX3D({}, {})",
        corner(value.0.min),
        corner(value.0.max)
    ))
}

#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_recv(message: Raw<pg_sys::StringInfoData>) -> Box3d {
    or_raise(wire::receive(&message, "box3d").and_then(Box3d::checked))
}

#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_send(value: Box3d) -> Vec<u8> {
    wire::send(&[value.0.min.to_array(), value.0.max.to_array()].concat())
}

#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_from_array(numbers: Array<'_, f64>) -> Box3d {
    or_raise(from_array(&numbers, "box3d").and_then(Box3d::checked))
}

#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_to_array(value: Box3d) -> Vec<f64> {
    [value.0.min.to_array(), value.0.max.to_array()].concat()
}

#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_from_point(point: Point3d) -> Box3d {
    Box3d(engine::Box3d::new(point.0, point.0))
}

#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_make(corner: Point3d, opposite: Point3d) -> Box3d {
    Box3d(engine::Box3d::new(corner.0, opposite.0))
}
