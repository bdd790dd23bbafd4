//! [`StoredSet`], a value of the type as an argument.

use engine::FeatureSet;
use pgrx::callconv::{Arg, ArgAbi};
use pgrx::pg_sys;
use std::ptr::NonNull;

/// A set, detoasted; the copy that this may have taken goes with it.
pub struct StoredSet {
    value: NonNull<pg_sys::varlena>,
    copied: bool,
}

impl StoredSet {
    /// The set itself.
    pub fn get(&self) -> FeatureSet<'_> {
        // SAFETY: the value is a varlena that is not compressed or external, and outlives `self`.
        FeatureSet::trusted(unsafe { pgrx::varlena::varlena_to_byte_slice(self.value.as_ptr()) })
    }

    /// The first bytes of a value that may be stored elsewhere, without fetching the others.
    pub fn beginning(datum: pg_sys::Datum, bytes: i32) -> Self {
        // SAFETY: the caller's datum is a varlena; the slice is a copy of some of it.
        let slice = unsafe { pg_sys::pg_detoast_datum_slice(datum.cast_mut_ptr(), 0, bytes) };
        Self {
            value: not_null(slice),
            copied: true,
        }
    }
}

impl pgrx::FromDatum for StoredSet {
    unsafe fn from_polymorphic_datum(
        datum: pg_sys::Datum,
        is_null: bool,
        _: pg_sys::Oid,
    ) -> Option<Self> {
        if is_null {
            return None;
        }
        let given = datum.cast_mut_ptr::<pg_sys::varlena>();
        // SAFETY: a datum of this type that is not null points to a varlena.
        let value = unsafe { pg_sys::pg_detoast_datum_packed(given) };
        Some(Self {
            value: not_null(value),
            copied: value != given,
        })
    }
}

// SAFETY: SQL declares the type as of variable length, so a datum of it points to a varlena.
unsafe impl<'fcx> ArgAbi<'fcx> for StoredSet {
    unsafe fn unbox_arg_unchecked(arg: Arg<'_, 'fcx>) -> Self {
        // SAFETY: as above; functions are STRICT, or take an `Option`, which asks first.
        match unsafe { arg.unbox_arg_using_from_datum() } {
            Some(set) => set,
            None => unreachable!("strict functions get no null"),
        }
    }
}

impl Drop for StoredSet {
    fn drop(&mut self) {
        if self.copied {
            // SAFETY: the copy was allocated for us, and nothing else refers to it.
            unsafe { pg_sys::pfree(self.value.as_ptr().cast()) };
        }
    }
}

fn not_null(value: *mut pg_sys::varlena) -> NonNull<pg_sys::varlena> {
    match NonNull::new(value) {
        Some(value) => value,
        None => unreachable!("a value that is not null has an address"),
    }
}
