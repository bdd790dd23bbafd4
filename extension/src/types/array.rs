//! Numbers in arrays.

use crate::error::Refusal;
use pgrx::{Array, PgSqlErrorCode};

/// The `N` numbers of an array; refuses another length and nulls.
pub fn from_array<const N: usize>(
    numbers: &Array<'_, f64>,
    type_name: &str,
) -> Result<[f64; N], Refusal> {
    let given: Vec<Option<f64>> = numbers.iter().collect();
    let refusal = |message: String| {
        Refusal::new(PgSqlErrorCode::ERRCODE_INVALID_PARAMETER_VALUE, message)
            .detail(format!("It is made of {N} numbers."))
    };
    if let Some(place) = given.iter().position(Option::is_none) {
        let place = place + 1;
        return Err(refusal(format!("number {place} of {type_name} is null")));
    }
    let given: Vec<f64> = given.into_iter().flatten().collect();
    let count = given.len();
    <[f64; N]>::try_from(given)
        .map_err(|_| refusal(format!("{type_name} cannot be made of {count} numbers")))
}
