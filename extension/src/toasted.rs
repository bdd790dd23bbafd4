//! [`Toasted`], a value of a row that is read when it is needed.

use crate::snapshot_read::Row;
use pgrx::pg_sys;
use pgrx::varlena::{varlena_to_byte_slice, varsize_any};

/// What a row holds of a value of variable length: the value, or where it lies in a TOAST table. It may be read
/// as long as the snapshot that showed the row is in use, during the query that found it.
#[derive(Debug)]
pub struct Toasted(
    /// Words, as a value may be aligned to them.
    Box<[u64]>,
);

impl Toasted {
    /// The value in a column, counted from 1; `None` if it is null.
    pub fn of(row: &Row, column: i32) -> Option<Self> {
        let (datum, is_null) = row.datum(column);
        if is_null {
            return None;
        }
        let value = datum.cast_mut_ptr::<pg_sys::varlena>();
        // SAFETY: the statement's column is of variable length, so the datum points to a varlena, whose size its
        // header tells. The words have room for it.
        unsafe {
            let size = varsize_any(value);
            let mut words = vec![0_u64; size.div_ceil(size_of::<u64>())].into_boxed_slice();
            std::ptr::copy_nonoverlapping(value.cast::<u8>(), words.as_mut_ptr().cast(), size);
            Some(Self(words))
        }
    }

    /// Gives the bytes of the value to `read`.
    pub fn read<T>(&self, read: impl FnOnce(&[u8]) -> T) -> T {
        let stored = self.0.as_ptr().cast::<pg_sys::varlena>().cast_mut();
        // SAFETY: the words are a copy of a varlena, which is not changed; what it points to cannot be removed
        // while its snapshot is in use. The copy that detoasting makes is freed when nobody borrows it any more.
        unsafe {
            let value = pg_sys::pg_detoast_datum_packed(stored);
            let result = read(varlena_to_byte_slice(value));
            if value != stored {
                pg_sys::pfree(value.cast());
            }
            result
        }
    }
}
