//! `box3d`, an axis-aligned box, and its operators.

use super::datum::fixed_length_type;
use super::number::finite;
use super::text::Literal;
use super::{Point3d, Raw, ViewCone, ViewSector, wire};
use crate::error::{Refusal, or_raise};
use pgrx::{pg_extern, pg_sys};
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

impl Box3d {
    /// The box of six finite coordinates, its corners sorted.
    fn checked(c: [f64; 6]) -> Result<Self, Refusal> {
        let corner = Point3d::checked([c[0], c[1], c[2]], "box3d")?;
        let opposite = Point3d::checked([c[3], c[4], c[5]], "box3d")?;
        Ok(Self(engine::Box3d::new(corner.0, opposite.0)))
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
fn box3d_make(corner: Point3d, opposite: Point3d) -> Box3d {
    Box3d(engine::Box3d::new(corner.0, opposite.0))
}

#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_lower(value: Box3d) -> Point3d {
    Point3d(value.0.min)
}

#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_upper(value: Box3d) -> Point3d {
    Point3d(value.0.max)
}

#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_volume(value: Box3d) -> f64 {
    value.0.volume()
}

#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_expand(value: Box3d, margin: f64) -> Option<Box3d> {
    or_raise(finite(margin, "margin", "box3d"));
    let grown = value.0.expanded(margin)?;
    or_raise(Point3d::checked(grown.min.to_array(), "box3d"));
    or_raise(Point3d::checked(grown.max.to_array(), "box3d"));
    Some(Box3d(grown))
}

#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_equals(a: Box3d, b: Box3d) -> bool {
    a.0 == b.0
}

#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_overlaps(a: Box3d, b: Box3d) -> bool {
    a.0.overlaps(&b.0)
}

#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_contains(a: Box3d, b: Box3d) -> bool {
    a.0.contains(&b.0)
}

#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_contained_by(a: Box3d, b: Box3d) -> bool {
    b.0.contains(&a.0)
}

#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_contains_point(a: Box3d, point: Point3d) -> bool {
    a.0.contains_point(point.0)
}

#[pg_extern(immutable, strict, parallel_safe)]
fn point3d_contained_by(point: Point3d, a: Box3d) -> bool {
    a.0.contains_point(point.0)
}

#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_meets_cone(a: Box3d, cone: ViewCone) -> bool {
    cone.in_radians().meets(&a.0)
}

#[pg_extern(immutable, strict, parallel_safe)]
fn cone_meets_box3d(cone: ViewCone, a: Box3d) -> bool {
    cone.in_radians().meets(&a.0)
}

#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_meets_sector(a: Box3d, sector: ViewSector) -> bool {
    sector.in_radians().meets(&a.0)
}

#[pg_extern(immutable, strict, parallel_safe)]
fn sector_meets_box3d(sector: ViewSector, a: Box3d) -> bool {
    sector.in_radians().meets(&a.0)
}

#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_distance(a: Box3d, b: Box3d) -> f64 {
    a.0.distance(&b.0)
}

#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_distance_point(a: Box3d, point: Point3d) -> f64 {
    a.0.distance_to_point(point.0)
}

#[pg_extern(immutable, strict, parallel_safe)]
fn point3d_distance_box(point: Point3d, a: Box3d) -> f64 {
    a.0.distance_to_point(point.0)
}
