//! [`Query`], what an index on `box3d` is asked for.

use crate::direct_call::guarded;
use crate::error::Refusal;
use crate::field_of_view::{FieldOfView, with_prepared};
use crate::types::{Box3d, Frustum, Point3d, ViewCone, ViewSector, read};
use engine::{BoxRange, BoxRelation};
use glam::DVec3;
use pgrx::{IntoDatum, PgSqlErrorCode, pg_sys};

/// Strategy numbers of the operator classes, the same for every kind of index. Those of boxes are
/// core's, as far as core knows them. An operator with another right side has one of its own, so
/// that the number says what the argument is.
mod strategy {
    pub const BEFORE_X: u16 = 1;
    pub const NOT_AFTER_X: u16 = 2;
    pub const NOT_BEFORE_X: u16 = 4;
    pub const AFTER_X: u16 = 5;
    pub const NOT_AFTER_Y: u16 = 9;
    pub const BEFORE_Y: u16 = 10;
    pub const AFTER_Y: u16 = 11;
    pub const NOT_BEFORE_Y: u16 = 12;
    pub const NOT_AFTER_Z: u16 = 29;
    pub const BEFORE_Z: u16 = 30;
    pub const AFTER_Z: u16 = 31;
    pub const NOT_BEFORE_Z: u16 = 32;
    pub const OVERLAPS: u16 = 3;
    pub const SAME: u16 = 6;
    pub const CONTAINS: u16 = 7;
    pub const CONTAINED_BY: u16 = 8;
    pub const DISTANCE: u16 = 15;
    pub const EQUALS: u16 = 18;
    pub const DISTANCE_TO_POINT: u16 = 25;
    pub const CONTAINS_POINT: u16 = 27;
    pub const MEETS_CONE: u16 = 33;
    pub const MEETS_SECTOR: u16 = 43;
    pub const MEETS_FRUSTUM: u16 = 53;
}

/// What a scan looks for.
pub enum Query<'a> {
    /// Boxes that lie so to a given one.
    Boxes(BoxRelation, &'a engine::Box3d),
    /// Boxes that hold a point.
    Holding(&'a DVec3),
    /// Boxes that share a point with a field of view.
    InView(FieldOfView),
}

impl Query<'_> {
    /// What an operator's strategy number and its right argument ask for.
    ///
    /// # Safety
    /// The argument must be of the type that the operator class gives the strategy.
    #[inline(always)]
    pub unsafe fn of(strategy: u16, argument: pg_sys::Datum) -> Self {
        // SAFETY: all these types are passed by reference, and the caller vouches for which it is.
        unsafe {
            if let Some(relation) = relation(strategy) {
                return Self::Boxes(relation, &*argument.cast_mut_ptr());
            }
            match strategy {
                strategy::CONTAINS_POINT => Self::Holding(&*argument.cast_mut_ptr()),
                strategy::MEETS_CONE => Self::InView(FieldOfView::Cone(read::<ViewCone>(argument))),
                strategy::MEETS_SECTOR => {
                    Self::InView(FieldOfView::Sector(read::<ViewSector>(argument)))
                }
                strategy::MEETS_FRUSTUM => {
                    Self::InView(FieldOfView::Frustum(read::<Frustum>(argument)))
                }
                other => unknown(other),
            }
        }
    }

    /// The same where the number alone does not say of what type the argument is, as in BRIN.
    ///
    /// # Safety
    /// The argument must be of the type `subtype`, and the operator class must give the strategy
    /// that type.
    pub unsafe fn of_type(strategy: u16, subtype: pg_sys::Oid, argument: pg_sys::Datum) -> Self {
        let strategy = match strategy {
            strategy::CONTAINS if subtype == Point3d::type_oid() => strategy::CONTAINS_POINT,
            strategy::OVERLAPS if subtype == ViewCone::type_oid() => strategy::MEETS_CONE,
            strategy::OVERLAPS if subtype == ViewSector::type_oid() => strategy::MEETS_SECTOR,
            strategy::OVERLAPS if subtype == Frustum::type_oid() => strategy::MEETS_FRUSTUM,
            other => other,
        };
        // SAFETY: as the caller says.
        unsafe { Self::of(strategy, argument) }
    }

    /// Whether a box is one of those looked for; exact.
    #[inline(always)]
    pub fn holds(&self, call: pg_sys::FunctionCallInfo, key: &engine::Box3d) -> bool {
        match self {
            Self::Boxes(relation, other) => relation.holds(key, other),
            Self::Holding(point) => key.contains_point(**point),
            Self::InView(view) => guarded(|| with_prepared(call, *view, |view| view.meets(key))),
        }
    }

    /// Whether some box of a range may be one of those looked for.
    #[inline(always)]
    pub fn possible(&self, call: pg_sys::FunctionCallInfo, range: &BoxRange) -> bool {
        match self {
            Self::Boxes(relation, other) => relation.possible(range, other),
            Self::Holding(point) => range.bounds().contains_point(**point),
            Self::InView(view) => {
                let bounds = finite(range.bounds());
                guarded(|| with_prepared(call, *view, |view| view.meets(&bounds)))
            }
        }
    }
}

/// What a scan wants the nearest of.
pub struct Nearest(engine::Box3d);

impl Nearest {
    /// What an ordering operator's strategy number and its right argument ask for.
    ///
    /// # Safety
    /// The argument must be of the type that the operator class gives the strategy.
    pub unsafe fn of(strategy: u16, argument: pg_sys::Datum) -> Self {
        // SAFETY: both types are passed by reference, and the caller vouches for which it is.
        unsafe {
            match strategy {
                strategy::DISTANCE => Self(read::<Box3d>(argument).0),
                strategy::DISTANCE_TO_POINT => {
                    let point = read::<Point3d>(argument).0;
                    Self(engine::Box3d::new(point, point))
                }
                other => unknown(other),
            }
        }
    }

    /// The distance of a box, as the operator gives it; for a box around others, no greater than
    /// theirs.
    #[inline]
    pub fn distance(&self, key: &engine::Box3d) -> f64 {
        key.distance(&self.0)
    }
}

/// The relation that a strategy number stands for, if its argument is a box.
#[inline]
fn relation(strategy: u16) -> Option<BoxRelation> {
    use BoxRelation::{After, Before, NotAfter, NotBefore};
    Some(match strategy {
        strategy::OVERLAPS => BoxRelation::Overlaps,
        strategy::SAME | strategy::EQUALS => BoxRelation::Equals,
        strategy::CONTAINS => BoxRelation::Contains,
        strategy::CONTAINED_BY => BoxRelation::ContainedBy,
        strategy::BEFORE_X => Before(0),
        strategy::BEFORE_Y => Before(1),
        strategy::BEFORE_Z => Before(2),
        strategy::NOT_AFTER_X => NotAfter(0),
        strategy::NOT_AFTER_Y => NotAfter(1),
        strategy::NOT_AFTER_Z => NotAfter(2),
        strategy::NOT_BEFORE_X => NotBefore(0),
        strategy::NOT_BEFORE_Y => NotBefore(1),
        strategy::NOT_BEFORE_Z => NotBefore(2),
        strategy::AFTER_X => After(0),
        strategy::AFTER_Y => After(1),
        strategy::AFTER_Z => After(2),
        _ => return None,
    })
}

/// The part of a box that finite boxes can be in.
fn finite(bounds: engine::Box3d) -> engine::Box3d {
    engine::Box3d {
        min: bounds.min.max(DVec3::splat(f64::MIN)),
        max: bounds.max.min(DVec3::splat(f64::MAX)),
    }
}

#[cold]
fn unknown(strategy: u16) -> ! {
    guarded(|| {
        Refusal::new(
            PgSqlErrorCode::ERRCODE_INTERNAL_ERROR,
            format!("unknown strategy number {strategy} for box3d"),
        )
        .raise()
    })
}
