//! The share of rows that an operator of boxes keeps.

use super::column::{Analyzed, Column};
use super::query::Query;
use super::relation::{relation_of, usual_share};
use crate::types::Raw;
use engine::BoxRelation;
use pgrx::{pg_extern, pg_sys};

/// Estimates `column OPERATOR value`, either way round.
#[pg_extern(stable, strict, parallel_safe)]
fn box3d_selectivity(
    root: Raw<pg_sys::PlannerInfo>,
    operator: pg_sys::Oid,
    arguments: Raw<pg_sys::List>,
    relation_number: i32,
) -> f64 {
    let relation = relation_of(operator);
    let mut data = pg_sys::VariableStatData::default();
    let mut value = std::ptr::null_mut();
    let mut column_first = false;
    // SAFETY: the planner passes its query and the operator's two arguments.
    let found = unsafe {
        pg_sys::get_restriction_variable(
            root.as_ptr(),
            arguments.as_ptr(),
            relation_number,
            &raw mut data,
            &raw mut value,
            &raw mut column_first,
        )
    };
    if !found {
        return usual_share(relation);
    }
    let mut column = Column::new(data);
    // SAFETY: the value is an expression of the same query.
    let share = unsafe {
        if is_null(value) {
            return 0.0;
        }
        share(root.as_ptr(), operator, &mut column, value, column_first)
    };
    share.unwrap_or_else(|| usual_share(relation))
}

/// The share of rows, if statistics tell it.
///
/// # Safety
/// `value` must be an expression of the query of `root`.
unsafe fn share(
    root: *mut pg_sys::PlannerInfo,
    operator: pg_sys::Oid,
    column: &mut Column,
    value: *mut pg_sys::Node,
    column_first: bool,
) -> Option<f64> {
    let relation = relation_of(operator)?;
    let relation = if column_first {
        relation
    } else {
        relation.commuted()?
    };
    let Analyzed { boxes, present } = column.analyzed(operator)?;
    // SAFETY: as above; a node whose tag is that of a constant is one.
    let among_present = unsafe {
        if let Some(constant) = constant(value) {
            Query::of(constant)?.share(&boxes, relation)
        } else {
            // A column of another table, of which one row at a time is compared.
            let others = Column::examine(root, value).analyzed(operator)?;
            boxes.share_of_pairs(relation, &others.boxes) * others.present
        }
    };
    Some(among_present * present)
}

/// Estimates `column OPERATOR column`, for two tables.
pub fn share_of_pairs(
    operator: pg_sys::Oid,
    relation: BoxRelation,
    columns: &mut [Column; 2],
) -> Option<f64> {
    let [left, right] = columns;
    let (left, right) = (left.analyzed(operator)?, right.analyzed(operator)?);
    Some(left.boxes.share_of_pairs(relation, &right.boxes) * left.present * right.present)
}

/// The constant that an expression is.
///
/// # Safety
/// `node` must be an expression, or null.
pub unsafe fn constant<'a>(node: *mut pg_sys::Node) -> Option<&'a pg_sys::Const> {
    // SAFETY: a node whose tag is that of a constant is one.
    unsafe {
        let is_constant = node.as_ref()?.type_ == pg_sys::NodeTag::T_Const;
        is_constant.then(|| &*node.cast::<pg_sys::Const>())
    }
}

/// Whether an expression is the null constant: no row passes, as the operators are strict.
///
/// # Safety
/// `node` must be an expression, or null.
unsafe fn is_null(node: *mut pg_sys::Node) -> bool {
    // SAFETY: as above.
    unsafe { constant(node) }.is_some_and(|constant| constant.constisnull)
}
