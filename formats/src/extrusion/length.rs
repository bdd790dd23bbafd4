//! Lengths as people write them.

/// Greatest height of anything built, metres: the highest building has 828.
pub(crate) const MAX_HEIGHT: f64 = 1000.0;

const FOOT: f64 = 0.3048;
const INCH: f64 = 0.0254;

/// A length in metres, such as `12`, `12,5 m`, `40 ft`, `40'` or `5'6"`; none for anything else.
pub(crate) fn length(text: &str) -> Option<f64> {
    let text = text
        .trim()
        .replace(',', ".")
        .replace('′', "'")
        .replace('″', "\"");
    if let Some((feet, inches)) = text.split_once('\'') {
        let inches = match inches.trim() {
            "" => 0.0,
            inches => number(inches.strip_suffix('"')?)?,
        };
        return Some(number(feet)? * FOOT + inches * INCH);
    }
    let unit_at = text
        .find(|c: char| c.is_alphabetic() || c == '"')
        .unwrap_or(text.len());
    let (value, unit) = text.split_at(unit_at);
    let factor = match unit.trim() {
        "" | "m" | "metre" | "metres" | "meter" | "meters" => 1.0,
        "cm" => 0.01,
        "km" => 1000.0,
        "ft" | "foot" | "feet" => FOOT,
        "in" | "\"" => INCH,
        _ => return None,
    };
    Some(number(value)? * factor)
}

/// A plain number: no exponent, no sign but minus, so no infinity either.
fn number(text: &str) -> Option<f64> {
    let text = text.trim();
    let plain = text
        .bytes()
        .all(|byte| byte.is_ascii_digit() || matches!(byte, b'.' | b'-'));
    let value: f64 = text.parse().ok()?;
    (plain && value.is_finite()).then_some(value)
}

#[cfg(test)]
mod tests {
    use super::length;

    #[test]
    fn lengths_are_read_with_their_units() {
        for (text, metres) in [
            ("12", 12.0),
            ("12,5", 12.5),
            (" 12 m ", 12.0),
            ("12.5m", 12.5),
            ("40'", 12.192),
            ("40 ft", 12.192),
            ("5'6\"", 1.6764),
            ("0", 0.0),
            ("-3", -3.0),
        ] {
            let found = length(text).unwrap();
            assert!((found - metres).abs() < 1e-9, "{text}: {found}");
        }
    }

    #[test]
    fn what_is_no_length_is_none() {
        for text in [
            "",
            "m",
            "tall",
            "12 parsecs",
            "1e3",
            "inf",
            "NaN",
            "12;13",
            "1.2.3",
            "'",
            "5'x",
        ] {
            assert_eq!(length(text), None, "{text}");
        }
    }
}
