//! Functions of boxes: their parts, sizes and distances, and boxes made of boxes.

use super::Box3d;
use crate::direct_call::direct_function;
use crate::error::or_raise;
use crate::types::Point3d;
use crate::types::number::finite;
use pgrx::pg_extern;

direct_function! {
    fn box3d_lower(value: Box3d) -> Point3d {
        Point3d(value.0.min)
    }
}

direct_function! {
    fn box3d_upper(value: Box3d) -> Point3d {
        Point3d(value.0.max)
    }
}

#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_volume(value: Box3d) -> f64 {
    value.0.volume()
}

#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_surface_area(value: Box3d) -> f64 {
    value.0.surface_area()
}

#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_center(value: Box3d) -> Point3d {
    Point3d(value.center())
}

#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_size(value: Box3d) -> Point3d {
    let size = value.0.size().to_array();
    or_raise(Point3d::checked(size, "size of box3d"))
}

#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_corners(value: Box3d) -> Vec<Point3d> {
    value.0.corners().map(Point3d).to_vec()
}

#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_expand(value: Box3d, margin: f64) -> Option<Box3d> {
    or_raise(finite(margin, "margin", "box3d"));
    let grown = value.0.expanded(margin)?;
    Some(or_raise(Box3d::finite(grown)))
}

#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_translate(value: Box3d, dx: f64, dy: f64, dz: f64) -> Box3d {
    let by = or_raise(Point3d::checked([dx, dy, dz], "translation of box3d")).0;
    or_raise(Box3d::finite(engine::Box3d {
        min: value.0.min + by,
        max: value.0.max + by,
    }))
}

#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_intersection(a: Box3d, b: Box3d) -> Option<Box3d> {
    a.0.intersection(&b.0).map(Box3d)
}

direct_function! {
    fn box3d_merge(a: Box3d, b: Box3d) -> Box3d {
        Box3d(a.0.union(&b.0))
    }
}

/// The step of the aggregate of points.
#[pg_extern(immutable, parallel_safe)]
fn box3d_extend(extent: Option<Box3d>, point: Option<Point3d>) -> Option<Box3d> {
    let point = point.map(|point| Box3d(engine::Box3d::new(point.0, point.0)));
    match (extent, point) {
        (Some(a), Some(b)) => Some(Box3d(a.0.union(&b.0))),
        (a, b) => a.or(b),
    }
}

direct_function! {
    unguarded
    fn box3d_distance(a: Box3d, b: Box3d) -> f64 {
        a.0.distance(&b.0)
    }
}

direct_function! {
    unguarded
    fn box3d_distance_point(a: Box3d, point: Point3d) -> f64 {
        a.0.distance_to_point(point.0)
    }
}

direct_function! {
    unguarded
    fn point3d_distance_box(point: Point3d, a: Box3d) -> f64 {
        a.0.distance_to_point(point.0)
    }
}

#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_max_distance(a: Box3d, b: Box3d) -> f64 {
    a.0.max_distance(&b.0)
}

#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_max_distance_point(a: Box3d, point: Point3d) -> f64 {
    a.0.max_distance(&engine::Box3d::new(point.0, point.0))
}

#[pg_extern(immutable, strict, parallel_safe)]
fn box3d_curve_position(a: Box3d) -> Vec<u8> {
    engine::hilbert_key(a.0.center()).to_be_bytes().to_vec()
}
