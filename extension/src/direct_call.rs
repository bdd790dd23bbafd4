//! Functions that are called millions of times in a statement: tests of index keys, operators,
//! comparisons. Around such a function the wrapper of `pg_extern` takes longer than the function. These
//! take their arguments from the call as they lie there, and must be declared STRICT.

use crate::types::Raw;
use pgrx::pg_sys::submodules::panic::pgrx_extern_c_guard;
use pgrx::pg_sys::{self, Datum};

/// The arguments of a call, taken one after the other.
pub struct Arguments {
    call: pg_sys::FunctionCallInfo,
    taken: usize,
}

impl Arguments {
    /// Those of a call.
    pub fn of(call: pg_sys::FunctionCallInfo) -> Self {
        Self { call, taken: 0 }
    }

    /// The next one.
    ///
    /// # Safety
    /// SQL must declare it, with the type that corresponds to `T`, and the function STRICT.
    #[inline]
    pub unsafe fn next<T: Argument>(&mut self) -> T {
        // SAFETY: as the caller says.
        unsafe { T::take(self) }
    }

    /// The next datum.
    ///
    /// # Safety
    /// SQL must declare it.
    #[inline]
    unsafe fn datum(&mut self) -> Datum {
        let place = self.taken;
        self.taken += 1;
        // SAFETY: a call is followed by as many arguments as SQL declares.
        unsafe { (*(*self.call).args.as_ptr().add(place)).value }
    }
}

/// What a function can be given.
pub trait Argument {
    /// Takes it.
    ///
    /// # Safety
    /// As for [`Arguments::next`].
    unsafe fn take(arguments: &mut Arguments) -> Self;
}

/// What a function can return.
pub trait Returned {
    /// As a datum; what is passed by reference lives in the current memory context.
    fn datum(self) -> Datum;
}

/// The call itself, which is no argument in SQL.
impl Argument for pg_sys::FunctionCallInfo {
    #[inline]
    unsafe fn take(arguments: &mut Arguments) -> Self {
        arguments.call
    }
}

impl Argument for i16 {
    #[inline]
    unsafe fn take(arguments: &mut Arguments) -> Self {
        // SAFETY: as the caller says; a smallint is the low bits of its datum.
        unsafe { arguments.datum() }.value() as Self
    }
}

impl Argument for i64 {
    #[inline]
    unsafe fn take(arguments: &mut Arguments) -> Self {
        // SAFETY: as the caller says; a bigint is its datum.
        unsafe { arguments.datum() }.value() as Self
    }
}

impl Argument for pg_sys::Oid {
    #[inline]
    unsafe fn take(arguments: &mut Arguments) -> Self {
        // SAFETY: as the caller says; an oid is the low bits of its datum.
        Self::from(unsafe { arguments.datum() }.value() as u32)
    }
}

impl<T> Argument for Raw<T> {
    #[inline]
    unsafe fn take(arguments: &mut Arguments) -> Self {
        // SAFETY: as the caller says; PostgreSQL passes no null where a function is STRICT.
        unsafe { Self::of(arguments.datum().cast_mut_ptr()) }
    }
}

impl Returned for bool {
    #[inline]
    fn datum(self) -> Datum {
        Datum::from(self)
    }
}

impl Returned for i32 {
    #[inline]
    fn datum(self) -> Datum {
        Datum::from(self)
    }
}

impl Returned for i64 {
    #[inline]
    fn datum(self) -> Datum {
        Datum::from(self)
    }
}

impl Returned for f64 {
    #[inline]
    fn datum(self) -> Datum {
        Datum::from(self.to_bits() as usize)
    }
}

impl Returned for () {
    #[inline]
    fn datum(self) -> Datum {
        Datum::null()
    }
}

/// A pointer, for functions that return what they were given.
impl<T> Returned for *mut T {
    #[inline]
    fn datum(self) -> Datum {
        Datum::from(self)
    }
}

/// Runs what may panic or raise an error: what unwinds from it becomes an error of PostgreSQL.
pub fn guarded<T>(run: impl FnOnce() -> T) -> T {
    // SAFETY: this is called from functions that PostgreSQL calls.
    unsafe { pgrx_extern_c_guard(run) }
}

/// Runs what can do neither: a guard takes longer than the comparison of two boxes.
#[inline]
pub fn unguarded<T>(run: impl FnOnce() -> T) -> T {
    run()
}

/// Makes a function callable from SQL, as the symbol `NAME_wrapper`; with `unguarded` one that does
/// arithmetic and nothing else.
macro_rules! direct_function {
    (unguarded $($function:tt)*) => {
        $crate::direct_call::direct_function! { @ unguarded $($function)* }
    };
    ($(#[doc = $doc:literal])* fn $($function:tt)*) => {
        $crate::direct_call::direct_function! { @ guarded $(#[doc = $doc])* fn $($function)* }
    };
    (@ $guard:ident $(#[doc = $doc:literal])*
     fn $name:ident($($argument:ident: $type:ty),* $(,)?) $(-> $result:ty)? $body:block) => {
        $(#[doc = $doc])*
        #[inline]
        fn $name($($argument: $type),*) $(-> $result)? $body

        const _: () = {
            #[unsafe(export_name = concat!("pg_finfo_", stringify!($name), "_wrapper"))]
            extern "C" fn information() -> &'static pgrx::pg_sys::Pg_finfo_record {
                &pgrx::pg_sys::Pg_finfo_record { api_version: 1 }
            }

            #[unsafe(export_name = concat!(stringify!($name), "_wrapper"))]
            unsafe extern "C-unwind" fn function(
                call: pgrx::pg_sys::FunctionCallInfo,
            ) -> pgrx::pg_sys::Datum {
                $crate::direct_call::$guard(|| {
                    let mut arguments = $crate::direct_call::Arguments::of(call);
                    // SAFETY: the SQL in sql/ declares these arguments, and the function STRICT.
                    $(let $argument = unsafe { arguments.next::<$type>() };)*
                    $crate::direct_call::Returned::datum($name($($argument),*))
                })
            }
        };
    };
}
pub(crate) use direct_function;
