//! A file line by line, no more of it in memory than the line.

use std::io::{BufRead, Read};

use super::json::check_count;
use crate::error::Problem;
use crate::input::Input;

const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// A cursor over the lines of a file.
pub(super) struct Lines<'i> {
    input: &'i mut dyn Input,
    number: usize,
}

impl<'i> Lines<'i> {
    /// Before the first line, after a byte order mark.
    pub(super) fn new(input: &'i mut dyn Input) -> Result<Self, Problem> {
        if input.fill_buf()?.starts_with(BYTE_ORDER_MARK) {
            input.consume(BYTE_ORDER_MARK.len());
        }
        Ok(Self { input, number: 0 })
    }

    /// The line that was read last, counted from 1.
    pub(super) fn number(&self) -> usize {
        self.number
    }

    /// Reads the first line that is not blank, with the blank ones before it, so that a parser
    /// counts lines as the file has them. None where there is no such line.
    pub(super) fn first(&mut self, limit: u64) -> Result<Option<Vec<u8>>, Problem> {
        let mut text = Vec::new();
        loop {
            let start = text.len();
            if !self.extend(&mut text, "bytes of a document", limit)? {
                return Ok(None);
            }
            if !is_blank(&text[start..]) {
                return Ok(Some(text));
            }
        }
    }

    /// Reads the next line that is not blank into `line`. False where there is none.
    pub(super) fn next(&mut self, line: &mut Vec<u8>, limit: u64) -> Result<bool, Problem> {
        loop {
            line.clear();
            if !self.extend(line, "bytes of a line", limit)? {
                return Ok(false);
            }
            if !is_blank(line) {
                return Ok(true);
            }
        }
    }

    /// Appends the rest of the file.
    pub(super) fn rest(&mut self, text: &mut Vec<u8>, limit: u64) -> Result<(), Problem> {
        (&mut *self.input)
            .take(room(text, limit))
            .read_to_end(text)?;
        check_count("bytes of a document", text.len() as u64, limit)
    }

    /// Appends a line. False where there is none.
    fn extend(
        &mut self,
        text: &mut Vec<u8>,
        what: &'static str,
        limit: u64,
    ) -> Result<bool, Problem> {
        let read = (&mut *self.input)
            .take(room(text, limit))
            .read_until(b'\n', text)?;
        self.number += usize::from(read > 0);
        check_count(what, text.len() as u64, limit)?;
        Ok(read > 0)
    }
}

fn is_blank(line: &[u8]) -> bool {
    line.iter().all(u8::is_ascii_whitespace)
}

/// How many bytes to ask for: one more than are allowed, to see that there are more.
fn room(text: &[u8], limit: u64) -> u64 {
    (limit + 1).saturating_sub(text.len() as u64)
}
