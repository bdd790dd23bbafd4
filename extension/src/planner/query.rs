//! [`Query`], the constant that boxes are compared with.

use crate::field_of_view::{FieldOfView, Prepared};
use crate::types::{Box3d, Point3d, read};
use engine::{BoxRelation, BoxStatistics};
use glam::DVec3;
use pgrx::pg_sys;
use std::ffi::CStr;

/// What boxes are compared with.
pub enum Query {
    /// A box, or a point as a box.
    Bounds(engine::Box3d),
    /// A field of view, with its eye and range.
    InView(Box<Prepared>, DVec3, f64),
    /// All that is within a range of an eye, metres.
    InRange(DVec3, f64),
}

impl Query {
    /// The query in a constant that is not null; `None` if it is of no type that is estimated.
    pub fn of(constant: &pg_sys::Const) -> Option<Self> {
        let value = constant.constvalue;
        let in_view = |view: FieldOfView| {
            let (eye, range) = view.eye_and_range();
            Self::InView(Box::new(view.prepared()), eye, range)
        };
        let name = type_name(constant.consttype);
        // SAFETY: the constant is not null, and its type's name tells what it points to.
        unsafe {
            Some(match name.as_str() {
                "occlusion.box3d" => Self::Bounds(read::<Box3d>(value).0),
                "occlusion.point3d" => {
                    let point = read::<Point3d>(value).0;
                    Self::Bounds(engine::Box3d::new(point, point))
                }
                "occlusion.view_cone" => in_view(FieldOfView::Cone(read(value))),
                "occlusion.view_sector" => in_view(FieldOfView::Sector(read(value))),
                "occlusion.frustum" => in_view(FieldOfView::Frustum(read(value))),
                _ => return None,
            })
        }
    }

    /// The share of boxes that stand in `relation` to the query; one that meets a field of view
    /// overlaps it.
    pub fn share(&self, boxes: &BoxStatistics, relation: BoxRelation) -> f64 {
        match self {
            Self::Bounds(bounds) => boxes.share(relation, bounds),
            Self::InView(view, ..) => boxes.share_meeting(|target| view.meets(target)),
            Self::InRange(eye, range) => {
                boxes.share_meeting(|target| engine::in_range(*eye, *range, target))
            }
        }
    }
}

/// The name of a type, with its schema.
pub fn type_name(oid: pg_sys::Oid) -> String {
    // SAFETY: the result is a palloc'd string.
    unsafe { CStr::from_ptr(pg_sys::format_type_be_qualified(oid)) }
        .to_string_lossy()
        .into_owned()
}
