//! [`FieldOfView`], what an observer looks at, as a value of one of several SQL types.

use crate::types::{Frustum, ViewCone, ViewSector};
use engine::{Box3d, PlanWedge};
use glam::DVec3;
use pgrx::pg_sys;

/// What an observer looks at, as the user gave it.
#[derive(Clone, Copy, PartialEq)]
pub enum FieldOfView {
    /// A circular cone.
    Cone(ViewCone),
    /// A horizontal sector of any pitch.
    Sector(ViewSector),
    /// What a camera sees.
    Frustum(Frustum),
}

/// The same, ready to be compared with many boxes.
#[derive(Clone, Copy)]
#[expect(
    clippy::large_enum_variant,
    reason = "one a call site, in memory that runs no destructors"
)]
pub enum Prepared {
    /// A circular cone.
    Cone(engine::ViewCone),
    /// A horizontal sector of any pitch.
    Sector(engine::ViewSector),
    /// What a camera sees. One that cannot be made, as no stored value is, would see everything.
    Frustum(Option<engine::Frustum>),
}

impl FieldOfView {
    /// The eye, and how far it sees in metres.
    pub fn eye_and_range(&self) -> (DVec3, f64) {
        match self {
            Self::Cone(cone) => cone.eye_and_range(),
            Self::Sector(sector) => sector.eye_and_range(),
            Self::Frustum(frustum) => frustum.eye_and_range(),
        }
    }

    /// The same, prepared.
    pub fn prepared(&self) -> Prepared {
        match self {
            Self::Cone(cone) => Prepared::Cone(cone.in_radians()),
            Self::Sector(sector) => Prepared::Sector(sector.in_radians()),
            Self::Frustum(frustum) => Prepared::Frustum(frustum.in_radians()),
        }
    }
}

impl Prepared {
    /// The directions in plan that it holds; `None` if these are all, or may be.
    pub fn plan_wedge(&self) -> Option<PlanWedge> {
        match self {
            Self::Cone(cone) => cone.plan_wedge(),
            Self::Sector(sector) => sector.plan_wedge(),
            Self::Frustum(frustum) => frustum.as_ref().and_then(|frustum| frustum.plan_wedge()),
        }
    }

    /// Whether it shares a point with a box.
    pub fn meets(&self, target: &Box3d) -> bool {
        match self {
            Self::Cone(cone) => cone.meets(target),
            Self::Sector(sector) => sector.meets(target),
            Self::Frustum(frustum) => frustum.as_ref().is_none_or(|frustum| frustum.meets(target)),
        }
    }
}

/// What a call site remembers from one call to the next.
struct Remembered {
    field_of_view: FieldOfView,
    prepared: Prepared,
}

/// Calls `test` with the field of view prepared. It is prepared once for all calls of one call site
/// in a row that have the same one, as those of a scan have.
pub fn with_prepared<T>(
    call: pg_sys::FunctionCallInfo,
    field_of_view: FieldOfView,
    test: impl FnOnce(&Prepared) -> T,
) -> T {
    // SAFETY: a function is called with its call site's data, if it has one; `fn_extra` is ours to
    // use, null at first, and what it points to lives in `fn_mcxt` as long as the call site.
    let remembered = unsafe {
        let Some(site) = call.as_ref().and_then(|call| call.flinfo.as_mut()) else {
            return test(&field_of_view.prepared());
        };
        let remember = || Remembered {
            field_of_view,
            prepared: field_of_view.prepared(),
        };
        if site.fn_extra.is_null() {
            let room = pg_sys::MemoryContextAlloc(site.fn_mcxt, size_of::<Remembered>());
            room.cast::<Remembered>().write(remember());
            site.fn_extra = room;
        }
        let remembered = &mut *site.fn_extra.cast::<Remembered>();
        if remembered.field_of_view != field_of_view {
            *remembered = remember();
        }
        remembered
    };
    test(&remembered.prepared)
}
