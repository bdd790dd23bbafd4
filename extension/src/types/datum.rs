//! How the types travel in a `Datum`: as a pointer to their bytes.

use pgrx::callconv::{Arg, ArgAbi};
use std::ptr::NonNull;

/// Makes a `#[repr(C)]`, `Copy` type of plain `f64` an argument and a result of SQL functions.
macro_rules! fixed_length_type {
    ($type:ty, $sql_name:literal) => {
        // SAFETY: SQL declares the type with the length and alignment of this struct, passed by
        // reference, so a datum of it points to its bytes; every bit pattern is a valid f64.
        unsafe impl<'fcx> pgrx::callconv::ArgAbi<'fcx> for $type {
            unsafe fn unbox_arg_unchecked(arg: pgrx::callconv::Arg<'_, 'fcx>) -> Self {
                // SAFETY: as above; functions are STRICT, so the argument is not null.
                unsafe {
                    match arg.unbox_arg_using_from_datum() {
                        Some(value) => value,
                        None => unreachable!("strict functions get no null"),
                    }
                }
            }
        }

        impl pgrx::FromDatum for $type {
            unsafe fn from_polymorphic_datum(
                datum: pgrx::pg_sys::Datum,
                is_null: bool,
                _: pgrx::pg_sys::Oid,
            ) -> Option<Self> {
                // SAFETY: a datum of this type that is not null points to its bytes.
                (!is_null).then(|| unsafe { datum.cast_mut_ptr::<Self>().read() })
            }
        }

        impl pgrx::IntoDatum for $type {
            fn into_datum(mut self) -> Option<pgrx::pg_sys::Datum> {
                // SAFETY: the copy is as long as the type and lives in the current context.
                let copy = unsafe {
                    pgrx::PgMemoryContexts::CurrentMemoryContext
                        .copy_ptr_into(&mut self, size_of::<Self>())
                };
                Some(copy.into())
            }

            fn type_oid() -> pgrx::pg_sys::Oid {
                pgrx::wrappers::regtypein($sql_name)
            }
        }

        impl $crate::direct_call::Argument for $type {
            unsafe fn take(arguments: &mut $crate::direct_call::Arguments) -> Self {
                // SAFETY: as the caller says, and as above.
                unsafe { *arguments.next::<$crate::types::Raw<Self>>().as_ptr() }
            }
        }

        impl $crate::direct_call::Returned for $type {
            fn datum(self) -> pgrx::pg_sys::Datum {
                match pgrx::IntoDatum::into_datum(self) {
                    Some(datum) => datum,
                    None => unreachable!("a value is not null"),
                }
            }
        }

        // SAFETY: the result is a pointer to a copy in the caller's memory context.
        unsafe impl pgrx::callconv::BoxRet for $type {
            unsafe fn box_into<'fcx>(
                self,
                fcinfo: &mut pgrx::callconv::FcInfo<'fcx>,
            ) -> pgrx::datum::Datum<'fcx> {
                match pgrx::IntoDatum::into_datum(self) {
                    // SAFETY: the copy lives as long as the function's result must.
                    Some(datum) => unsafe { fcinfo.return_raw_datum(datum) },
                    None => fcinfo.return_null(),
                }
            }
        }
    };
}
pub(super) use fixed_length_type;

/// A value passed by reference.
///
/// # Safety
/// The datum must point to a `T`.
pub unsafe fn read<T: Copy>(datum: pgrx::pg_sys::Datum) -> T {
    // SAFETY: as the caller says.
    unsafe { datum.cast_mut_ptr::<T>().read() }
}

/// An argument of SQL type `internal` that is known to point to a `T`.
pub struct Raw<T>(NonNull<T>);

impl<T> Raw<T> {
    /// A pointer that PostgreSQL passed.
    ///
    /// # Safety
    /// It must not be null.
    pub unsafe fn of(pointer: *mut T) -> Self {
        // SAFETY: as the caller says.
        Self(unsafe { NonNull::new_unchecked(pointer) })
    }

    /// The pointer itself.
    pub fn as_ptr(&self) -> *mut T {
        self.0.as_ptr()
    }
}

// SAFETY: `internal` arguments are pointers made by PostgreSQL, which calls these functions with
// the types that the index access method documents; users cannot make one.
unsafe impl<'fcx, T> ArgAbi<'fcx> for Raw<T> {
    unsafe fn unbox_arg_unchecked(arg: Arg<'_, 'fcx>) -> Self {
        // SAFETY: reads the datum as the address that it is.
        let address: Option<pgrx::datum::Internal> = unsafe { arg.unbox_arg_using_from_datum() };
        let pointer = address
            .and_then(|internal| internal.unwrap())
            .and_then(|datum| NonNull::new(datum.cast_mut_ptr::<T>()));
        match pointer {
            Some(pointer) => Self(pointer),
            None => unreachable!("strict functions get no null"),
        }
    }
}
