//! The share of pairs that a join by an operator of boxes keeps.

use super::column::Column;
use super::relation::{relation_of, usual_share};
use super::restriction::share_of_pairs;
use crate::types::Raw;
use pgrx::{pg_extern, pg_sys};

/// Estimates a join on `column OPERATOR column`. For a semi-join or an anti-join it is the share of
/// the outer rows that have a partner.
#[pg_extern(stable, strict, parallel_safe)]
fn box3d_join_selectivity(
    root: Raw<pg_sys::PlannerInfo>,
    operator: pg_sys::Oid,
    arguments: Raw<pg_sys::List>,
    kind: i16,
    join: Raw<pg_sys::SpecialJoinInfo>,
) -> f64 {
    let relation = relation_of(operator);
    let mut data = [pg_sys::VariableStatData::default(); 2];
    let mut reversed = false;
    let [left, right] = &mut data;
    // SAFETY: the planner passes its query, the operator's two arguments and the join.
    unsafe {
        pg_sys::get_join_variables(
            root.as_ptr(),
            arguments.as_ptr(),
            join.as_ptr(),
            left,
            right,
            &raw mut reversed,
        );
    }
    let mut columns = data.map(Column::new);
    let pairs = relation
        .and_then(|relation| share_of_pairs(operator, relation, &mut columns))
        .unwrap_or_else(|| usual_share(relation));
    let inner = &columns[usize::from(!reversed)];
    match u32::try_from(kind) {
        Ok(pg_sys::JoinType::JOIN_SEMI | pg_sys::JoinType::JOIN_ANTI) => {
            with_partner(pairs, inner.rows())
        }
        _ => pairs,
    }
}

/// The share of outer rows with a partner among the inner ones, if partners fall at random.
fn with_partner(pairs: f64, inner_rows: Option<f64>) -> f64 {
    inner_rows.map_or(pairs, |rows| 1.0 - (-pairs * rows).exp())
}
