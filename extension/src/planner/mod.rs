//! What the planner asks: statistics of columns of boxes, the selectivity of operators, and the
//! rows of functions.

mod analyze;
mod column;
mod feature_rows;
mod join;
mod query;
mod relation;
mod restriction;
mod support;
