//! [`Lines`], the statements of a file one by one.

use std::io::{BufRead, Read};

use crate::error::Problem;

/// Longest statement, as many lines as it goes on for: a face of a million corners.
const MAX_LINE_BYTES: u64 = 16 << 20;

/// Reads statements: lines, joined where one ends in a backslash.
pub(super) struct Lines<R> {
    input: R,
    buffer: Vec<u8>,
    ended: bool,
    /// Number of the last line read, counted from 1.
    pub(super) number: usize,
}

impl<R: BufRead> Lines<R> {
    /// Begins where the input stands.
    pub(super) fn new(input: R) -> Self {
        Self {
            input,
            buffer: Vec::new(),
            ended: false,
            number: 0,
        }
    }

    /// The next statement: its keyword, which may be empty, and the rest. `None` at the end.
    pub(super) fn next(&mut self) -> Result<Option<(String, String)>, Problem> {
        self.buffer.clear();
        loop {
            self.read_line()?;
            let continues = self.buffer.ends_with(b"\\") && !self.ended;
            if !continues {
                break;
            }
            self.buffer.pop();
        }
        if self.ended && self.buffer.is_empty() {
            return Ok(None);
        }
        let text = String::from_utf8_lossy(&self.buffer);
        let text = text.split('#').next().unwrap_or_default().trim();
        let (keyword, rest) = text.split_once([' ', '\t']).unwrap_or((text, ""));
        Ok(Some((keyword.to_owned(), rest.trim().to_owned())))
    }

    /// Adds a line to the buffer, without its end.
    fn read_line(&mut self) -> Result<(), Problem> {
        let left = MAX_LINE_BYTES.saturating_sub(self.buffer.len() as u64);
        let mut limited = self.input.by_ref().take(left + 1);
        let count = limited.read_until(b'\n', &mut self.buffer)?;
        if count as u64 > left {
            return Err(Problem::Limit {
                what: "bytes of a statement",
                found: self.buffer.len() as u64,
                limit: MAX_LINE_BYTES,
            });
        }
        self.number += usize::from(count > 0);
        self.ended = !self.buffer.ends_with(b"\n");
        while self.buffer.ends_with(b"\n") || self.buffer.ends_with(b"\r") {
            self.buffer.pop();
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statements_go_on_after_backslashes() {
        let mut lines = Lines::new(&b"f 1 \\\r\n2\t3 # a\r\n\n  o  a b \n#\nv\\"[..]);
        let mut all = Vec::new();
        while let Some((keyword, rest)) = lines.next().unwrap() {
            all.push((keyword, rest, lines.number));
        }
        let expected = [
            ("f", "1 2\t3", 2),
            ("", "", 3),
            ("o", "a b", 4),
            ("", "", 5),
            ("v\\", "", 6),
        ];
        let expected =
            expected.map(|(keyword, rest, line)| (keyword.to_owned(), rest.to_owned(), line));
        assert_eq!(all, expected);
    }

    #[test]
    fn endless_lines_are_refused() {
        let problem = Lines::new(std::io::BufReader::new(std::io::repeat(b'a'))).next();
        assert_eq!(
            problem.unwrap_err().to_string(),
            "16777217 bytes of a statement exceed the limit of 16777216"
        );
    }
}
