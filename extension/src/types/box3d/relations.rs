//! The operators of boxes that answer yes or no.

use super::Box3d;
use crate::direct_call::direct_function;
use crate::field_of_view::{FieldOfView, with_prepared};
use crate::types::{Point3d, ViewCone, ViewSector};
use engine::BoxRelation;
use pgrx::pg_sys;

direct_function! {
    unguarded
    fn box3d_overlaps(a: Box3d, b: Box3d) -> bool {
        a.0.overlaps(&b.0)
    }
}

direct_function! {
    unguarded
    fn box3d_contains(a: Box3d, b: Box3d) -> bool {
        a.0.contains(&b.0)
    }
}

direct_function! {
    unguarded
    fn box3d_contained_by(a: Box3d, b: Box3d) -> bool {
        b.0.contains(&a.0)
    }
}

direct_function! {
    unguarded
    fn box3d_contains_point(a: Box3d, point: Point3d) -> bool {
        a.0.contains_point(point.0)
    }
}

direct_function! {
    unguarded
    fn point3d_contained_by(point: Point3d, a: Box3d) -> bool {
        a.0.contains_point(point.0)
    }
}

direct_function! {
    fn box3d_meets_cone(call: pg_sys::FunctionCallInfo, a: Box3d, cone: ViewCone) -> bool {
        with_prepared(call, FieldOfView::Cone(cone), |view| view.meets(&a.0))
    }
}

direct_function! {
    fn cone_meets_box3d(call: pg_sys::FunctionCallInfo, cone: ViewCone, a: Box3d) -> bool {
        with_prepared(call, FieldOfView::Cone(cone), |view| view.meets(&a.0))
    }
}

direct_function! {
    fn box3d_meets_sector(call: pg_sys::FunctionCallInfo, a: Box3d, sector: ViewSector) -> bool {
        with_prepared(call, FieldOfView::Sector(sector), |view| view.meets(&a.0))
    }
}

direct_function! {
    fn sector_meets_box3d(call: pg_sys::FunctionCallInfo, sector: ViewSector, a: Box3d) -> bool {
        with_prepared(call, FieldOfView::Sector(sector), |view| view.meets(&a.0))
    }
}

direct_function! {
    unguarded
    fn box3d_left_of(a: Box3d, b: Box3d) -> bool {
        BoxRelation::Before(0).holds(&a.0, &b.0)
    }
}

direct_function! {
    unguarded
    fn box3d_not_right_of(a: Box3d, b: Box3d) -> bool {
        BoxRelation::NotAfter(0).holds(&a.0, &b.0)
    }
}

direct_function! {
    unguarded
    fn box3d_not_left_of(a: Box3d, b: Box3d) -> bool {
        BoxRelation::NotBefore(0).holds(&a.0, &b.0)
    }
}

direct_function! {
    unguarded
    fn box3d_right_of(a: Box3d, b: Box3d) -> bool {
        BoxRelation::After(0).holds(&a.0, &b.0)
    }
}

direct_function! {
    unguarded
    fn box3d_below(a: Box3d, b: Box3d) -> bool {
        BoxRelation::Before(1).holds(&a.0, &b.0)
    }
}

direct_function! {
    unguarded
    fn box3d_not_above(a: Box3d, b: Box3d) -> bool {
        BoxRelation::NotAfter(1).holds(&a.0, &b.0)
    }
}

direct_function! {
    unguarded
    fn box3d_not_below(a: Box3d, b: Box3d) -> bool {
        BoxRelation::NotBefore(1).holds(&a.0, &b.0)
    }
}

direct_function! {
    unguarded
    fn box3d_above(a: Box3d, b: Box3d) -> bool {
        BoxRelation::After(1).holds(&a.0, &b.0)
    }
}

direct_function! {
    unguarded
    fn box3d_in_front_of(a: Box3d, b: Box3d) -> bool {
        BoxRelation::Before(2).holds(&a.0, &b.0)
    }
}

direct_function! {
    unguarded
    fn box3d_not_behind(a: Box3d, b: Box3d) -> bool {
        BoxRelation::NotAfter(2).holds(&a.0, &b.0)
    }
}

direct_function! {
    unguarded
    fn box3d_not_in_front_of(a: Box3d, b: Box3d) -> bool {
        BoxRelation::NotBefore(2).holds(&a.0, &b.0)
    }
}

direct_function! {
    unguarded
    fn box3d_behind(a: Box3d, b: Box3d) -> bool {
        BoxRelation::After(2).holds(&a.0, &b.0)
    }
}
