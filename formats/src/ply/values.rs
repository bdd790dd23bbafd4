//! [`Values`], the numbers after a header one by one.

use std::io::{BufRead, ErrorKind, Read};

use super::header::{Encoding, Property, Scalar};
use crate::error::{Problem, quote};

/// Longest number as text.
const MAX_NUMBER_BYTES: usize = 400;

/// Reads numbers of any encoding.
pub(super) struct Values<R> {
    input: R,
    encoding: Encoding,
}

impl<R: BufRead> Values<R> {
    /// Begins where the input stands.
    pub(super) fn new(input: R, encoding: Encoding) -> Self {
        Self { input, encoding }
    }

    /// Reads all values of a property into a list; a single value is a list of one.
    pub(super) fn property(
        &mut self,
        property: &Property,
        most: usize,
        values: &mut Vec<f64>,
    ) -> Result<(), Problem> {
        values.clear();
        let length = match property.length {
            None => 1.0,
            Some(scalar) => self.scalar(scalar)?,
        };
        if !(0.0..=most as f64).contains(&length) || length.fract() != 0.0 {
            return Err(Problem::Invalid {
                what: format!("the length of {}", quote(&property.name)),
                found: length.to_string(),
                expected: "a count of up to ten million",
            });
        }
        let mut left = length;
        while left > 0.0 {
            values.push(self.scalar(property.scalar)?);
            left -= 1.0;
        }
        Ok(())
    }

    fn scalar(&mut self, scalar: Scalar) -> Result<f64, Problem> {
        if self.encoding == Encoding::Ascii {
            return self.text();
        }
        Ok(match scalar {
            Scalar::I8 => i8::from_le_bytes(self.bytes()?).into(),
            Scalar::U8 => u8::from_le_bytes(self.bytes()?).into(),
            Scalar::I16 => i16::from_le_bytes(self.bytes()?).into(),
            Scalar::U16 => u16::from_le_bytes(self.bytes()?).into(),
            Scalar::I32 => i32::from_le_bytes(self.bytes()?).into(),
            Scalar::U32 => u32::from_le_bytes(self.bytes()?).into(),
            Scalar::F32 => f32::from_le_bytes(self.bytes()?).into(),
            Scalar::F64 => f64::from_le_bytes(self.bytes()?),
        })
    }

    /// The bytes of a number, the lowest first.
    fn bytes<const N: usize>(&mut self) -> Result<[u8; N], Problem> {
        let mut bytes = [0; N];
        self.input
            .read_exact(&mut bytes)
            .map_err(|error| match error.kind() {
                ErrorKind::UnexpectedEof => ended(),
                _ => error.into(),
            })?;
        if self.encoding == Encoding::BigEndian {
            bytes.reverse();
        }
        Ok(bytes)
    }

    /// The number that the next word is.
    fn text(&mut self) -> Result<f64, Problem> {
        let mut word = String::new();
        for byte in self.input.by_ref().bytes() {
            match byte? {
                byte if !byte.is_ascii_whitespace() => word.push(char::from(byte)),
                _ if word.is_empty() => continue,
                _ => break,
            }
            if word.len() > MAX_NUMBER_BYTES {
                break;
            }
        }
        if word.is_empty() {
            return Err(ended());
        }
        word.parse().map_err(|_| Problem::Invalid {
            what: "a value".to_owned(),
            found: quote(&word),
            expected: "a number",
        })
    }
}

fn ended() -> Problem {
    Problem::Malformed {
        what: "the file".to_owned(),
        message: "it ends before its last element".to_owned(),
    }
}
