//! Names as identifiers of VRML97, and back.

use std::fmt::Write;

use super::lexer::is_excluded;

/// Words of the grammar, which are no names.
const KEYWORDS: [&str; 14] = [
    "DEF",
    "EXTERNPROTO",
    "FALSE",
    "IS",
    "NULL",
    "PROTO",
    "ROUTE",
    "TO",
    "TRUE",
    "USE",
    "eventIn",
    "eventOut",
    "exposedField",
    "field",
];

/// The identifier that stands for a name: what identifiers cannot hold, and the per cent sign,
/// is written as in addresses of the web. Never holds a colon.
pub(super) fn encode(name: &str) -> String {
    let keyword = KEYWORDS.contains(&name);
    let mut identifier = String::with_capacity(name.len());
    for (i, character) in name.char_indices() {
        let is_first = i == 0 && (keyword || character.is_ascii_digit());
        let is_sign = matches!(character, '%' | '+' | '-' | ':');
        match u8::try_from(character) {
            Ok(byte) if byte < 0x80 && (is_first || is_sign || is_excluded(byte)) => {
                // Writing to a string cannot fail.
                let _ = write!(identifier, "%{byte:02X}");
            }
            _ => identifier.push(character),
        }
    }
    identifier
}

/// The name that an identifier stands for; per cent signs of another meaning stay.
pub(super) fn decode(identifier: &str) -> String {
    let mut pieces = identifier.split('%');
    let mut name = pieces.next().unwrap_or_default().to_owned();
    for piece in pieces {
        match piece.get(..2).map(|digits| u8::from_str_radix(digits, 16)) {
            Some(Ok(byte)) if byte.is_ascii() && !piece.starts_with('+') => {
                name.push(char::from(byte));
                name.push_str(&piece[2..]);
            }
            _ => {
                name.push('%');
                name.push_str(piece);
            }
        }
    }
    name
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_come_back_and_are_identifiers_between() {
        let names = [
            "a",
            "3d",
            "NL.IMBAG.Pand.05-1",
            "a b{}[]'\"#\\,+\n",
            "USE",
            "50%",
            "%41",
            "é:ü",
        ];
        for name in names {
            let identifier = encode(name);
            let excluded = identifier.bytes().any(is_excluded);
            let digit = identifier.starts_with(|c: char| c.is_ascii_digit());
            assert!(!excluded && !digit, "{identifier}");
            assert!(!KEYWORDS.contains(&identifier.as_str()));
            assert_eq!(decode(&identifier), name);
        }
        assert_eq!(encode("3.d"), "%33%2Ed");
    }

    #[test]
    fn other_per_cent_signs_stay() {
        for identifier in ["100%", "%zz", "%é", "a%+1", "%FF"] {
            assert_eq!(decode(identifier), identifier);
        }
    }
}
