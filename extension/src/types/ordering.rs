//! Equality, order and hash of the types that are nothing but numbers: number by number, in the
//! order of their text. The order has no meaning in space; it is for sorting and grouping.

use std::cmp::Ordering;
use std::ffi::c_int;

unsafe extern "C-unwind" {
    /// The server's own hash of bytes, which hash indexes may rely on.
    fn hash_bytes(bytes: *const u8, length: c_int) -> u32;
    /// The same with a seed.
    fn hash_bytes_extended(bytes: *const u8, length: c_int, seed: u64) -> u64;
}

/// A type that is nothing but finite numbers.
pub trait Numbers: Copy {
    /// The numbers, in the order of the text.
    fn numbers(&self) -> &[f64];

    /// The order of two values, that of the first numbers that differ. 0 equals -0.
    fn compare(&self, other: &Self) -> Ordering {
        let pairs = self.numbers().iter().zip(other.numbers());
        let orders = pairs.map(|(a, b)| a.partial_cmp(b).unwrap_or(Ordering::Equal));
        orders
            .into_iter()
            .find(|order| order.is_ne())
            .unwrap_or(Ordering::Equal)
    }

    /// Calls a function with the bytes of the value, the same for all values that are equal.
    fn with_bytes<T>(&self, call: impl FnOnce(*const u8, c_int) -> T) -> T {
        let bytes: Vec<u8> = self
            .numbers()
            .iter()
            // A sum turns -0 into 0.
            .flat_map(|number| (number + 0.0).to_le_bytes())
            .collect();
        call(bytes.as_ptr(), c_int::try_from(bytes.len()).unwrap_or(0))
    }

    /// The hash of a value.
    fn hash(&self) -> i32 {
        // SAFETY: the server reads as many bytes as there are.
        self.with_bytes(|bytes, length| unsafe { hash_bytes(bytes, length) })
            .cast_signed()
    }

    /// The hash of a value, with a seed.
    fn hash_extended(&self, seed: i64) -> i64 {
        // SAFETY: the server reads as many bytes as there are.
        self.with_bytes(|bytes, length| unsafe {
            hash_bytes_extended(bytes, length, seed.cast_unsigned())
        })
        .cast_signed()
    }
}

/// Makes the SQL functions of a type's B-tree and hash classes, by the names given. The type must
/// be `#[repr(C)]` and nothing but `f64`.
macro_rules! ordered_type {
    ($type:ty, $equals:ident, $differs:ident, $less:ident, $less_or_equal:ident,
     $greater_or_equal:ident, $greater:ident, $compare:ident, $hash:ident, $hash_extended:ident) => {
        impl $crate::types::ordering::Numbers for $type {
            fn numbers(&self) -> &[f64] {
                const COUNT: usize = size_of::<$type>() / size_of::<f64>();
                // SAFETY: the type is nothing but so many numbers, one after the other.
                unsafe { std::slice::from_raw_parts(std::ptr::from_ref(self).cast(), COUNT) }
            }
        }

        $crate::direct_call::direct_function! {
            unguarded
            fn $equals(a: $type, b: $type) -> bool {
                $crate::types::ordering::Numbers::compare(&a, &b).is_eq()
            }
        }

        $crate::direct_call::direct_function! {
            unguarded
            fn $differs(a: $type, b: $type) -> bool {
                $crate::types::ordering::Numbers::compare(&a, &b).is_ne()
            }
        }

        $crate::direct_call::direct_function! {
            unguarded
            fn $less(a: $type, b: $type) -> bool {
                $crate::types::ordering::Numbers::compare(&a, &b).is_lt()
            }
        }

        $crate::direct_call::direct_function! {
            unguarded
            fn $less_or_equal(a: $type, b: $type) -> bool {
                $crate::types::ordering::Numbers::compare(&a, &b).is_le()
            }
        }

        $crate::direct_call::direct_function! {
            unguarded
            fn $greater_or_equal(a: $type, b: $type) -> bool {
                $crate::types::ordering::Numbers::compare(&a, &b).is_ge()
            }
        }

        $crate::direct_call::direct_function! {
            unguarded
            fn $greater(a: $type, b: $type) -> bool {
                $crate::types::ordering::Numbers::compare(&a, &b).is_gt()
            }
        }

        $crate::direct_call::direct_function! {
            unguarded
            fn $compare(a: $type, b: $type) -> i32 {
                $crate::types::ordering::Numbers::compare(&a, &b) as i32
            }
        }

        $crate::direct_call::direct_function! {
            fn $hash(value: $type) -> i32 {
                $crate::types::ordering::Numbers::hash(&value)
            }
        }

        $crate::direct_call::direct_function! {
            fn $hash_extended(value: $type, seed: i64) -> i64 {
                $crate::types::ordering::Numbers::hash_extended(&value, seed)
            }
        }
    };
}
pub(super) use ordered_type;
