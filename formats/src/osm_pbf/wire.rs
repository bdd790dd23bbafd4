//! Protocol buffers, field by field and without a copy.

use prost::encoding::{WireType, decode_key, decode_varint};

use crate::error::Problem;

/// A message that is not as protocol buffers or the schema have it, and why.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Broken(pub(super) &'static str);

impl Broken {
    /// The problem that the part of the file at this byte is broken.
    pub(super) fn at(self, what: &str, offset: u64) -> Problem {
        Problem::Malformed {
            what: format!("{what} at byte {offset}"),
            message: self.0.to_owned(),
        }
    }
}

/// The value of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Value<'a> {
    /// A varint.
    Number(u64),
    /// A string, bytes, a message, or packed numbers.
    Bytes(&'a [u8]),
    /// Of a type that OpenStreetMap does not use.
    Other,
}

impl<'a> Value<'a> {
    /// The value of a field that holds a number.
    pub(super) fn number(self) -> Result<u64, Broken> {
        match self {
            Self::Number(number) => Ok(number),
            _ => Err(Broken("a field is no number")),
        }
    }

    /// The value of a field that holds bytes.
    pub(super) fn bytes(self) -> Result<&'a [u8], Broken> {
        match self {
            Self::Bytes(bytes) => Ok(bytes),
            _ => Err(Broken("a field is not of the type that the format has")),
        }
    }
}

/// The fields of a message with their numbers, in the order of the message.
pub(super) struct Fields<'a>(pub(super) &'a [u8]);

impl<'a> Iterator for Fields<'a> {
    type Item = Result<(u32, Value<'a>), Broken>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.0.is_empty() {
            return None;
        }
        let field = self.field();
        if field.is_err() {
            self.0 = &[];
        }
        Some(field)
    }
}

impl<'a> Fields<'a> {
    fn field(&mut self) -> Result<(u32, Value<'a>), Broken> {
        let (tag, kind) =
            decode_key(&mut self.0).map_err(|_| Broken("a field has no valid key"))?;
        let value = match kind {
            WireType::Varint => Value::Number(varint(&mut self.0)?),
            WireType::LengthDelimited => {
                let length = varint(&mut self.0)?;
                Value::Bytes(self.take(usize::try_from(length).unwrap_or(usize::MAX))?)
            }
            WireType::SixtyFourBit => self.take(8).map(|_| Value::Other)?,
            WireType::ThirtyTwoBit => self.take(4).map(|_| Value::Other)?,
            WireType::StartGroup | WireType::EndGroup => {
                return Err(Broken("a field is a group"));
            }
        };
        Ok((tag, value))
    }

    fn take(&mut self, count: usize) -> Result<&'a [u8], Broken> {
        let (taken, rest) = self
            .0
            .split_at_checked(count)
            .ok_or(Broken("a field is longer than its message"))?;
        self.0 = rest;
        Ok(taken)
    }
}

fn varint(bytes: &mut &[u8]) -> Result<u64, Broken> {
    decode_varint(bytes).map_err(|_| Broken("a number does not end"))
}

/// Packed numbers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Packed<'a>(pub(super) &'a [u8]);

impl Iterator for Packed<'_> {
    type Item = Result<u64, Broken>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.0.is_empty() {
            return None;
        }
        let number = varint(&mut self.0);
        if number.is_err() {
            self.0 = &[];
        }
        Some(number)
    }
}

/// Packed numbers of which each is stored as its difference from the one before.
#[derive(Clone, Copy, Debug)]
pub(super) struct Deltas<'a> {
    packed: Packed<'a>,
    last: i64,
}

impl<'a> Deltas<'a> {
    /// The numbers of a field.
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self {
            packed: Packed(bytes),
            last: 0,
        }
    }
}

impl Iterator for Deltas<'_> {
    type Item = Result<i64, Broken>;

    fn next(&mut self) -> Option<Self::Item> {
        let step = self.packed.next()?.map(signed);
        let number = step.and_then(|step| {
            self.last
                .checked_add(step)
                .ok_or(Broken("a number is out of range"))
        });
        if let Ok(number) = number {
            self.last = number;
        }
        Some(number)
    }
}

/// A signed number in the zigzag form.
pub(super) fn signed(number: u64) -> i64 {
    (number >> 1) as i64 ^ -((number & 1) as i64)
}
