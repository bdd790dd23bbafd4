//! `view_sector`, a horizontal sector of view of any pitch.

use super::datum::fixed_length_type;
use super::number::{aperture, finite, range, shortest};
use super::ordering::ordered_type;
use super::text::Literal;
use super::{Point3d, Raw, wire};
use crate::error::{Refusal, or_raise};
use glam::DVec3;
use pgrx::{pg_extern, pg_sys};
use std::ffi::{CStr, CString};

const LITERAL: Literal = Literal {
    type_name: "view_sector",
    keyword: "VIEW_SECTOR",
    groups: &[3, 1, 1, 1],
    example: "VIEW_SECTOR(x y z, heading, angle, range)",
};

/// A sector of view as the user gave it: degrees and metres.
#[repr(C)]
#[derive(Clone, Copy, PartialEq)]
pub struct ViewSector {
    observer: Point3d,
    heading: f64,
    angle: f64,
    range: f64,
}

fixed_length_type!(ViewSector, "occlusion.view_sector");
ordered_type!(
    ViewSector,
    view_sector_equals,
    view_sector_differs,
    view_sector_less,
    view_sector_less_or_equal,
    view_sector_greater_or_equal,
    view_sector_greater,
    view_sector_compare,
    view_sector_hash,
    view_sector_hash_extended
);

impl ViewSector {
    fn checked(n: [f64; 6]) -> Result<Self, Refusal> {
        const NAME: &str = "view_sector";
        Ok(Self {
            observer: Point3d::checked([n[0], n[1], n[2]], NAME)?,
            heading: finite(n[3], "heading", NAME)?,
            angle: aperture(n[4], NAME)?,
            range: range(n[5], NAME)?,
        })
    }

    fn numbers(&self) -> [f64; 6] {
        let [x, y, z] = self.observer.0.to_array();
        [x, y, z, self.heading, self.angle, self.range]
    }

    /// The eye, and how far it sees in metres.
    pub fn eye_and_range(&self) -> (DVec3, f64) {
        (self.observer.0, self.range)
    }

    /// The sector to compute with.
    pub fn in_radians(&self) -> engine::ViewSector {
        engine::ViewSector::new(
            self.observer.0,
            self.heading.to_radians(),
            self.angle.to_radians(),
            self.range,
        )
    }
}

#[pg_extern(immutable, strict, parallel_safe)]
fn view_sector_in(text: &CStr) -> ViewSector {
    let n = or_raise(LITERAL.parse(&text.to_string_lossy()));
    or_raise(ViewSector::checked([n[0], n[1], n[2], n[3], n[4], n[5]]))
}

#[pg_extern(immutable, strict, parallel_safe)]
fn view_sector_out(sector: ViewSector) -> CString {
    let rest = [sector.heading, sector.angle, sector.range]
        .map(shortest)
        .join(", ");
    super::text_result(format!(
        "VIEW_SECTOR({}, {rest})",
        sector.observer.coordinates()
    ))
}

#[pg_extern(immutable, strict, parallel_safe)]
fn view_sector_recv(message: Raw<pg_sys::StringInfoData>) -> ViewSector {
    or_raise(wire::receive(&message, "view_sector").and_then(ViewSector::checked))
}

#[pg_extern(immutable, strict, parallel_safe)]
fn view_sector_send(sector: ViewSector) -> Vec<u8> {
    wire::send(&sector.numbers())
}

#[pg_extern(immutable, strict, parallel_safe)]
fn view_sector_make(observer: Point3d, heading: f64, angle: f64, range: f64) -> ViewSector {
    let [x, y, z] = observer.0.to_array();
    or_raise(ViewSector::checked([x, y, z, heading, angle, range]))
}

#[pg_extern(immutable, strict, parallel_safe)]
fn view_sector_observer(sector: ViewSector) -> Point3d {
    sector.observer
}

#[pg_extern(immutable, strict, parallel_safe)]
fn view_sector_heading(sector: ViewSector) -> f64 {
    sector.heading
}

#[pg_extern(immutable, strict, parallel_safe)]
fn view_sector_angle(sector: ViewSector) -> f64 {
    sector.angle
}

#[pg_extern(immutable, strict, parallel_safe)]
fn view_sector_range(sector: ViewSector) -> f64 {
    sector.range
}
