//! Checks of single numbers, and their shortest text.

use crate::error::Refusal;
use pgrx::PgSqlErrorCode;

/// Refuses NaN and infinities, naming what the number is.
pub fn finite(value: f64, name: &str, type_name: &str) -> Result<f64, Refusal> {
    if value.is_finite() {
        return Ok(value);
    }
    Err(Refusal::new(
        PgSqlErrorCode::ERRCODE_NUMERIC_VALUE_OUT_OF_RANGE,
        format!(
            "{name} of {type_name} must be finite, not {}",
            shortest(value)
        ),
    ))
}

/// The shortest decimal text that reads back as the same number.
pub fn shortest(value: f64) -> String {
    let size = value.abs();
    if value.is_nan() {
        "NaN".into()
    } else if value.is_infinite() {
        if value > 0.0 {
            "Infinity".into()
        } else {
            "-Infinity".into()
        }
    } else if value == 0.0 || (1e-5..1e16).contains(&size) {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

/// The refusal of a number that is finite, but not one that its place allows.
pub fn out_of_bounds(value: f64, name: &str, type_name: &str) -> Refusal {
    Refusal::new(
        PgSqlErrorCode::ERRCODE_NUMERIC_VALUE_OUT_OF_RANGE,
        format!("{name} {} of {type_name} is out of bounds", shortest(value)),
    )
}

/// Refuses an aperture outside (0, 360) degrees.
pub fn aperture(value: f64, type_name: &str) -> Result<f64, Refusal> {
    finite(value, "angle", type_name)?;
    if value > 0.0 && value < 360.0 {
        return Ok(value);
    }
    Err(out_of_bounds(value, "angle", type_name)
        .detail("The angle is the full aperture, more than 0 and less than 360 degrees."))
}

/// Refuses a negative range.
pub fn range(value: f64, type_name: &str) -> Result<f64, Refusal> {
    finite(value, "range", type_name)?;
    if value >= 0.0 {
        return Ok(value);
    }
    Err(Refusal::new(
        PgSqlErrorCode::ERRCODE_NUMERIC_VALUE_OUT_OF_RANGE,
        format!("range {} of {type_name} is negative", shortest(value)),
    ))
}

/// Refuses a pitch beyond straight up or down.
pub fn pitch(value: f64, type_name: &str) -> Result<f64, Refusal> {
    finite(value, "pitch", type_name)?;
    if (-90.0..=90.0).contains(&value) {
        return Ok(value);
    }
    Err(out_of_bounds(value, "pitch", type_name)
        .detail("The pitch is between -90 and 90 degrees, upward from the horizon."))
}
