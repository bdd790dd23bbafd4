//! `view_cone`, a circular cone of view.

use super::datum::fixed_length_type;
use super::number::{aperture, finite, pitch, range, shortest};
use super::ordering::ordered_type;
use super::text::Literal;
use super::{Point3d, Raw, wire};
use crate::error::{Refusal, or_raise};
use glam::DVec3;
use pgrx::{default, pg_extern, pg_sys};
use std::ffi::{CStr, CString};

const LITERAL: Literal = Literal {
    type_name: "view_cone",
    keyword: "VIEW_CONE",
    groups: &[3, 1, 1, 1, 1],
    example: "VIEW_CONE(x y z, heading, angle, range, pitch)",
};

/// A cone of view as the user gave it: degrees and metres.
#[repr(C)]
#[derive(Clone, Copy, PartialEq)]
pub struct ViewCone {
    observer: Point3d,
    heading: f64,
    angle: f64,
    range: f64,
    pitch: f64,
}

fixed_length_type!(ViewCone, "occlusion.view_cone");
ordered_type!(
    ViewCone,
    view_cone_equals,
    view_cone_differs,
    view_cone_less,
    view_cone_less_or_equal,
    view_cone_greater_or_equal,
    view_cone_greater,
    view_cone_compare,
    view_cone_hash,
    view_cone_hash_extended
);

impl ViewCone {
    fn checked(n: [f64; 7]) -> Result<Self, Refusal> {
        const NAME: &str = "view_cone";
        Ok(Self {
            observer: Point3d::checked([n[0], n[1], n[2]], NAME)?,
            heading: finite(n[3], "heading", NAME)?,
            angle: aperture(n[4], NAME)?,
            range: range(n[5], NAME)?,
            pitch: pitch(n[6], NAME)?,
        })
    }

    fn numbers(&self) -> [f64; 7] {
        let [x, y, z] = self.observer.0.to_array();
        [x, y, z, self.heading, self.angle, self.range, self.pitch]
    }

    /// The eye, and how far it sees in metres.
    pub fn eye_and_range(&self) -> (DVec3, f64) {
        (self.observer.0, self.range)
    }

    /// The cone to compute with.
    pub fn in_radians(&self) -> engine::ViewCone {
        engine::ViewCone::new(
            self.observer.0,
            self.heading.to_radians(),
            self.angle.to_radians(),
            self.range,
            self.pitch.to_radians(),
        )
    }
}

#[pg_extern(immutable, strict, parallel_safe)]
fn view_cone_in(text: &CStr) -> ViewCone {
    let n = or_raise(LITERAL.parse(&text.to_string_lossy()));
    or_raise(ViewCone::checked([
        n[0], n[1], n[2], n[3], n[4], n[5], n[6],
    ]))
}

#[pg_extern(immutable, strict, parallel_safe)]
fn view_cone_out(cone: ViewCone) -> CString {
    let rest = [cone.heading, cone.angle, cone.range, cone.pitch]
        .map(shortest)
        .join(", ");
    super::text_result(format!(
        "VIEW_CONE({}, {rest})",
        cone.observer.coordinates()
    ))
}

#[pg_extern(immutable, strict, parallel_safe)]
fn view_cone_recv(message: Raw<pg_sys::StringInfoData>) -> ViewCone {
    or_raise(wire::receive(&message, "view_cone").and_then(ViewCone::checked))
}

#[pg_extern(immutable, strict, parallel_safe)]
fn view_cone_send(cone: ViewCone) -> Vec<u8> {
    wire::send(&cone.numbers())
}

#[pg_extern(immutable, strict, parallel_safe)]
fn view_cone_make(
    observer: Point3d,
    heading: f64,
    angle: f64,
    range: f64,
    pitch: default!(f64, 0),
) -> ViewCone {
    let [x, y, z] = observer.0.to_array();
    or_raise(ViewCone::checked([x, y, z, heading, angle, range, pitch]))
}

#[pg_extern(immutable, strict, parallel_safe)]
fn view_cone_observer(cone: ViewCone) -> Point3d {
    cone.observer
}

#[pg_extern(immutable, strict, parallel_safe)]
fn view_cone_heading(cone: ViewCone) -> f64 {
    cone.heading
}

#[pg_extern(immutable, strict, parallel_safe)]
fn view_cone_angle(cone: ViewCone) -> f64 {
    cone.angle
}

#[pg_extern(immutable, strict, parallel_safe)]
fn view_cone_range(cone: ViewCone) -> f64 {
    cone.range
}

#[pg_extern(immutable, strict, parallel_safe)]
fn view_cone_pitch(cone: ViewCone) -> f64 {
    cone.pitch
}
