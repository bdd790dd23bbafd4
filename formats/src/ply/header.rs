//! The header of a file: which elements follow, with which properties, and how they are encoded.

use std::io::{BufRead, Read};

use crate::error::{Problem, quote};

/// Longest line of a header.
const MAX_LINE_BYTES: u64 = 4096;

/// Most lines of a header; a property takes one.
const MAX_LINES: usize = 10_000;

/// How numbers are encoded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Ascii,
    LittleEndian,
    BigEndian,
}

/// A type of number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

/// A property of an element.
#[derive(Debug)]
pub(super) struct Property {
    pub(super) name: String,
    /// The type of its value, or of each value of a list.
    pub(super) scalar: Scalar,
    /// The type of a list's length; `None` for a single value.
    pub(super) length: Option<Scalar>,
}

/// So many elements with the same properties.
#[derive(Debug)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
}

/// A header.
#[derive(Debug)]
pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
}

impl Element {
    /// The number of the first property that has one of these names and is a list or not.
    pub(super) fn property(&self, names: &[&str], is_list: bool) -> Option<usize> {
        self.properties.iter().position(|property| {
            names.contains(&property.name.as_str()) && property.length.is_some() == is_list
        })
    }
}

impl Scalar {
    fn named(name: &str) -> Result<Self, Problem> {
        Ok(match name {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return Err(invalid("a type of property", name, "one of the format's")),
        })
    }
}

/// Reads a header up to its end. Gives with a problem the number of its line.
pub(super) fn read_header(input: &mut impl BufRead) -> Result<Header, (usize, Problem)> {
    let mut encoding = None;
    let mut elements = Vec::new();
    for number in 1..=MAX_LINES {
        let line = read_line(input).map_err(|problem| (number, problem))?;
        let words: Vec<&str> = line.split_whitespace().collect();
        if words == ["end_header"] {
            let missing = || Problem::Missing {
                what: "format".to_owned(),
            };
            return Ok(Header {
                encoding: encoding.ok_or_else(|| (number, missing()))?,
                elements,
            });
        }
        add_line(&words, number, &mut encoding, &mut elements)
            .map_err(|problem| (number, problem))?;
    }
    Err((
        MAX_LINES,
        Problem::Limit {
            what: "lines of the header",
            found: MAX_LINES as u64 + 1,
            limit: MAX_LINES as u64,
        },
    ))
}

fn add_line(
    words: &[&str],
    number: usize,
    encoding: &mut Option<Encoding>,
    elements: &mut Vec<Element>,
) -> Result<(), Problem> {
    match words {
        ["ply"] if number == 1 => Ok(()),
        [] | ["comment" | "obj_info", ..] if number > 1 => Ok(()),
        ["format", name, "1.0"] => {
            *encoding = Some(match *name {
                "ascii" => Encoding::Ascii,
                "binary_little_endian" => Encoding::LittleEndian,
                "binary_big_endian" => Encoding::BigEndian,
                _ => return Err(invalid("format", name, "ascii or a binary one")),
            });
            Ok(())
        }
        ["element", name, count] => {
            let count = count.parse();
            let count = count.map_err(|_| invalid("a number of elements", words[2], "a count"))?;
            elements.push(Element {
                name: (*name).to_owned(),
                count,
                properties: Vec::new(),
            });
            Ok(())
        }
        ["property", "list", length, scalar, name] => {
            let length = Scalar::named(length)?;
            if matches!(length, Scalar::F32 | Scalar::F64) {
                return Err(invalid("the type of a length", words[2], "a whole number"));
            }
            add_property(elements, name, Some(length), Scalar::named(scalar)?)
        }
        ["property", scalar, name] => add_property(elements, name, None, Scalar::named(scalar)?),
        _ => Err(invalid(
            "a line of the header",
            &words.join(" "),
            "one of the format's",
        )),
    }
}

fn add_property(
    elements: &mut [Element],
    name: &str,
    length: Option<Scalar>,
    scalar: Scalar,
) -> Result<(), Problem> {
    let Some(element) = elements.last_mut() else {
        return Err(invalid("a property", name, "an element before it"));
    };
    element.properties.push(Property {
        name: name.to_owned(),
        scalar,
        length,
    });
    Ok(())
}

fn read_line(input: &mut impl BufRead) -> Result<String, Problem> {
    let mut line = Vec::new();
    let mut limited = input.by_ref().take(MAX_LINE_BYTES + 1);
    limited.read_until(b'\n', &mut line)?;
    if line.len() as u64 > MAX_LINE_BYTES {
        return Err(Problem::Limit {
            what: "bytes of a line of the header",
            found: line.len() as u64,
            limit: MAX_LINE_BYTES,
        });
    }
    if !line.ends_with(b"\n") {
        return Err(Problem::Malformed {
            what: "the header".to_owned(),
            message: "it does not end".to_owned(),
        });
    }
    Ok(String::from_utf8_lossy(&line).into_owned())
}

fn invalid(what: &str, found: &str, expected: &'static str) -> Problem {
    Problem::Invalid {
        what: what.to_owned(),
        found: quote(found),
        expected,
    }
}
