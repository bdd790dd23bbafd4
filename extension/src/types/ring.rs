//! Core's `polygon`, read as it is stored.

use glam::DVec2;
use pgrx::pg_sys::{self, Datum};

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
