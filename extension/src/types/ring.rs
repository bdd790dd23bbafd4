//! Core's `polygon` and `path`, read and written as they are stored.

use glam::DVec2;
use pgrx::IntoDatum;
use pgrx::callconv::{BoxRet, FcInfo};
use pgrx::pg_sys::{self, Datum, Oid};

/// The corners of a `polygon`.
///
/// # Safety
/// The datum must be a `polygon` that is not null.
pub unsafe fn ring(datum: Datum) -> Vec<DVec2> {
    // SAFETY: as the caller says; the polygon is unpacked, and is followed by as many points as it tells.
    unsafe {
        let polygon = pg_sys::pg_detoast_datum(datum.cast_mut_ptr()).cast::<pg_sys::POLYGON>();
        let count = usize::try_from((*polygon).npts).unwrap_or(0);
        let points = (&raw const (*polygon).p).cast::<pg_sys::Point>();
        (0..count)
            .map(|at| {
                let point = &*points.add(at);
                DVec2::new(point.x, point.y)
            })
            .collect()
    }
}

/// The corners of each element of a `polygon[]`; `None` if one is null.
///
/// # Safety
/// The datum must be a `polygon[]` that is not null.
pub unsafe fn rings(datum: Datum) -> Option<Vec<Vec<DVec2>>> {
    /// How core stores polygons: of variable length, aligned as doubles are.
    const LENGTH: i32 = -1;
    const ALIGNMENT: std::ffi::c_char = b'd' as std::ffi::c_char;
    let (mut elements, mut nulls, mut count) = (std::ptr::null_mut(), std::ptr::null_mut(), 0);
    // SAFETY: as the caller says; both arrays that it makes hold `count` elements.
    unsafe {
        let array = pg_sys::pg_detoast_datum(datum.cast_mut_ptr()).cast::<pg_sys::ArrayType>();
        pg_sys::deconstruct_array(
            array,
            pg_sys::POLYGONOID,
            LENGTH,
            false,
            ALIGNMENT,
            &raw mut elements,
            &raw mut nulls,
            &raw mut count,
        );
        (0..usize::try_from(count).unwrap_or(0))
            .map(|at| (!*nulls.add(at)).then(|| ring(*elements.add(at))))
            .collect()
    }
}

/// Corners as a `polygon`.
pub struct Ring(pub Vec<DVec2>);

/// Points as an open `path`; one as a closed one, since core has no open path of a single point.
pub struct Path(pub Vec<DVec2>);

impl IntoDatum for Ring {
    fn into_datum(self) -> Option<Datum> {
        let polygon = packed::<pg_sys::POLYGON>(&self.0)?;
        // SAFETY: it was just made.
        unsafe {
            (*polygon).npts = count(&self.0);
            (*polygon).boundbox = around(&self.0);
        }
        Some(Datum::from(polygon))
    }

    fn type_oid() -> Oid {
        pg_sys::POLYGONOID
    }
}

impl IntoDatum for Path {
    fn into_datum(self) -> Option<Datum> {
        let path = packed::<pg_sys::PATH>(&self.0)?;
        // SAFETY: it was just made.
        unsafe {
            (*path).npts = count(&self.0);
            (*path).closed = i32::from(self.0.len() == 1);
            (*path).dummy = 0;
        }
        Some(Datum::from(path))
    }

    fn type_oid() -> Oid {
        pg_sys::PATHOID
    }
}

// SAFETY: the result is a polygon in the caller's memory context, or null.
unsafe impl BoxRet for Ring {
    unsafe fn box_into<'fcx>(self, fcinfo: &mut FcInfo<'fcx>) -> pgrx::datum::Datum<'fcx> {
        boxed(self, fcinfo)
    }
}

// SAFETY: the result is a path in the caller's memory context, or null.
unsafe impl BoxRet for Path {
    unsafe fn box_into<'fcx>(self, fcinfo: &mut FcInfo<'fcx>) -> pgrx::datum::Datum<'fcx> {
        boxed(self, fcinfo)
    }
}

fn boxed<'fcx>(value: impl IntoDatum, fcinfo: &mut FcInfo<'fcx>) -> pgrx::datum::Datum<'fcx> {
    match value.into_datum() {
        // SAFETY: it was made in the current memory context, where the function's result must be.
        Some(datum) => unsafe { fcinfo.return_raw_datum(datum) },
        None => fcinfo.return_null(),
    }
}

/// A value of variable length that begins as `T` does and ends with points; `None` where there are none.
fn packed<T>(points: &[DVec2]) -> Option<*mut T> {
    if points.is_empty() {
        return None;
    }
    let size = size_of::<T>() + size_of_val(points);
    // SAFETY: as many bytes are written as were allocated; a point of core's is two doubles.
    unsafe {
        let value = pg_sys::palloc0(size);
        pgrx::set_varsize_4b(value.cast(), i32::try_from(size).unwrap_or(i32::MAX));
        let end = value.byte_add(size_of::<T>()).cast::<DVec2>();
        std::ptr::copy_nonoverlapping(points.as_ptr(), end, points.len());
        Some(value.cast())
    }
}

fn count(points: &[DVec2]) -> i32 {
    i32::try_from(points.len()).unwrap_or(i32::MAX)
}

fn around(points: &[DVec2]) -> pg_sys::BOX {
    let low = points.iter().copied().fold(DVec2::INFINITY, DVec2::min);
    let high = points.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max);
    let point = |p: DVec2| pg_sys::Point { x: p.x, y: p.y };
    pg_sys::BOX {
        high: point(high),
        low: point(low),
    }
}
