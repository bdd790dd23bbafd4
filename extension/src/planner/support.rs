//! Support functions: how many rows our set-returning functions return.

use super::feature_rows::visible_rows;
use super::restriction::constant;
use crate::types::{Raw, StoredSet};
use pgrx::{FromDatum, Internal, pg_extern, pg_sys};

/// Rows of `visible_features` and its kin, from the statistics of the scene.
#[pg_extern(immutable, strict, parallel_safe)]
fn visible_features_support(request: Raw<pg_sys::Node>) -> Internal {
    // SAFETY: the planner passes a request.
    unsafe { answered(&request, visible_rows) }
}

/// Rows of functions that return one for each feature of their second argument, an array.
#[pg_extern(immutable, strict, parallel_safe)]
fn feature_models_support(request: Raw<pg_sys::Node>) -> Internal {
    // SAFETY: the planner passes a request.
    unsafe {
        answered(&request, |arguments| {
            arguments.get(1).and_then(array_length)
        })
    }
}

/// Rows of `unnest` of a set.
#[pg_extern(immutable, strict, parallel_safe)]
fn feature_set_unnest_support(request: Raw<pg_sys::Node>) -> Internal {
    // SAFETY: the planner passes a request, and the argument was declared a set.
    unsafe {
        answered(&request, |arguments| {
            let set = StoredSet::from_datum(arguments.get(0)?.constvalue, false)?;
            Some(set.get().cardinality() as f64)
        })
    }
}

/// The arguments of a call, as far as the planner can tell their values.
pub struct Arguments(Vec<*mut pg_sys::Node>);

impl Arguments {
    /// The argument at a position, if its value is known and not null.
    pub fn get(&self, position: usize) -> Option<&pg_sys::Const> {
        // SAFETY: the values are expressions that live as long as the planning.
        unsafe { constant(*self.0.get(position)?) }.filter(|value| !value.constisnull)
    }
}

/// Answers a request for a number of rows. Null, for the declared number, if the request is another
/// one, or nothing is known: a null pointer, as a null result would be an error.
///
/// # Safety
/// The request must come from the planner.
unsafe fn answered(
    request: &Raw<pg_sys::Node>,
    rows: impl Fn(&Arguments) -> Option<f64>,
) -> Internal {
    // SAFETY: a request whose tag is that of one for rows is one.
    let answer = unsafe {
        if (*request.as_ptr()).type_ == pg_sys::NodeTag::T_SupportRequestRows {
            let request = request.as_ptr().cast::<pg_sys::SupportRequestRows>();
            arguments(&*request)
                .and_then(|arguments| rows(&arguments))
                .map(|rows| {
                    (*request).rows = rows.max(1.0);
                    request
                })
        } else {
            None
        }
    };
    Internal::from(Some(pg_sys::Datum::from(
        answer.unwrap_or(std::ptr::null_mut()),
    )))
}

/// The arguments of the call that a request is about.
///
/// # Safety
/// The request must come from the planner.
unsafe fn arguments(request: &pg_sys::SupportRequestRows) -> Option<Arguments> {
    let root = request.root;
    // SAFETY: a node whose tag is that of a call is one; its arguments are expressions.
    unsafe {
        let is_call = request.node.as_ref()?.type_ == pg_sys::NodeTag::T_FuncExpr;
        if root.is_null() || !is_call {
            return None;
        }
        let list = (*request.node.cast::<pg_sys::FuncExpr>()).args;
        let count = list.as_ref().map_or(0, |list| list.length);
        let values = (0..count)
            .map(|at| pg_sys::estimate_expression_value(root, pg_sys::list_nth(list, at).cast()))
            .collect();
        Some(Arguments(values))
    }
}

/// The number of elements of a known array.
fn array_length(array: &pg_sys::Const) -> Option<f64> {
    // SAFETY: the argument was declared an array, and is not null.
    unsafe {
        let array =
            pg_sys::pg_detoast_datum(array.constvalue.cast_mut_ptr()).cast::<pg_sys::ArrayType>();
        let dimensions = array
            .cast::<u8>()
            .add(size_of::<pg_sys::ArrayType>())
            .cast::<i32>();
        let length = pg_sys::ArrayGetNItems((*array).ndim, dimensions);
        Some(f64::from(length))
    }
}
