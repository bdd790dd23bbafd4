//! From text to tokens, after ISO/IEC 14772-1, annex A.

use std::borrow::Cow;

use crate::error::{Problem, quote};

/// What is wrong, and at which byte of the text.
#[derive(Debug)]
pub(super) struct Fault {
    pub(super) offset: usize,
    pub(super) problem: Problem,
}

impl Fault {
    /// The fault of a problem at a byte.
    pub(super) fn at(offset: usize) -> impl Fn(Problem) -> Self {
        move |problem| Self { offset, problem }
    }
}

/// A piece of the text.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Token<'a> {
    /// A name or a keyword.
    Identifier(&'a str),
    /// A number as it stands.
    Number(&'a str),
    /// What a string says.
    Text(Cow<'a, str>),
    /// One of `{}[].`.
    Mark(u8),
    /// The end of the text.
    End,
}

impl Token<'_> {
    /// What an error says was found.
    pub(super) fn quoted(&self) -> String {
        match self {
            Self::Identifier(text) | Self::Number(text) => quote(text),
            Self::Text(text) => format!("the string {}", quote(text)),
            Self::Mark(mark) => quote(&char::from(*mark).to_string()),
            Self::End => "the end of the file".to_owned(),
        }
    }
}

/// Gives one token after the other.
#[derive(Debug)]
pub(super) struct Lexer<'a> {
    text: &'a str,
    at: usize,
}

impl<'a> Lexer<'a> {
    /// Begins at the first byte of a text.
    pub(super) fn new(text: &'a str) -> Self {
        Self { text, at: 0 }
    }

    /// The next token, and the byte that it begins at.
    pub(super) fn next(&mut self) -> Result<(usize, Token<'a>), Fault> {
        self.skip_white_space();
        let start = self.at;
        let rest = self.rest();
        let token = match rest.bytes().next() {
            None => Token::End,
            Some(b'"') => return self.string().map(|text| (start, Token::Text(text))),
            Some(mark @ (b'{' | b'}' | b'[' | b']')) => Token::Mark(self.take(1, mark)),
            Some(first) => match number_length(rest.as_bytes()) {
                0 if first == b'.' => Token::Mark(self.take(1, first)),
                0 => Token::Identifier(self.identifier()?),
                length => Token::Number(self.take(length, &rest[..length])),
            },
        };
        Ok((start, token))
    }

    fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    /// Moves on and gives the token's content.
    fn take<T>(&mut self, length: usize, content: T) -> T {
        self.at += length;
        content
    }

    fn identifier(&mut self) -> Result<&'a str, Fault> {
        let rest = self.rest();
        match identifier_length(rest) {
            0 => Err(self.unexpected()),
            length => Ok(self.take(length, &rest[..length])),
        }
    }

    fn unexpected(&self) -> Fault {
        let character: String = self.rest().chars().take(1).collect();
        Fault::at(self.at)(Problem::Malformed {
            what: "the text".to_owned(),
            message: format!("no token begins with {}", quote(&character)),
        })
    }

    /// Skips blanks, commas and comments.
    fn skip_white_space(&mut self) {
        let bytes = self.text.as_bytes();
        let mut in_comment = false;
        while let Some(&byte) = bytes.get(self.at) {
            in_comment = match byte {
                b'\n' | b'\r' => false,
                b'#' => true,
                b' ' | b'\t' | b',' => in_comment,
                _ if in_comment => true,
                _ => return,
            };
            self.at += 1;
        }
    }

    /// The string whose first quotation mark comes next. Only `\"` and `\\` are escapes.
    fn string(&mut self) -> Result<Cow<'a, str>, Fault> {
        let start = self.at;
        let body = &self.text[start + 1..];
        let mut escaped = false;
        let end = body.bytes().position(|byte| {
            let ends = byte == b'"' && !escaped;
            escaped = byte == b'\\' && !escaped;
            ends
        });
        let Some(end) = end else {
            return Err(Fault::at(start)(Problem::Malformed {
                what: "a string".to_owned(),
                message: "it does not end".to_owned(),
            }));
        };
        self.at = start + 1 + end + 1;
        let raw = &body[..end];
        Ok(match raw.contains('\\') {
            true => raw.replace("\\\"", "\"").replace("\\\\", "\\").into(),
            false => raw.into(),
        })
    }
}

/// Bytes of the number that a text begins with, 0 if it begins with none.
fn number_length(text: &[u8]) -> usize {
    let run = |from: usize, wanted: fn(&u8) -> bool| {
        let rest = text.get(from..).unwrap_or_default();
        rest.iter().take_while(|byte| wanted(byte)).count()
    };
    let byte = |at: usize| text.get(at).copied();
    let sign = |at: usize| usize::from(matches!(byte(at), Some(b'+' | b'-')));
    let start = sign(0);
    if byte(start) == Some(b'0') && matches!(byte(start + 1), Some(b'x' | b'X')) {
        let digits = run(start + 2, u8::is_ascii_hexdigit);
        if digits > 0 {
            return start + 2 + digits;
        }
    }
    let whole = run(start, u8::is_ascii_digit);
    let mut end = start + whole;
    let mut fraction = 0;
    if byte(end) == Some(b'.') {
        fraction = run(end + 1, u8::is_ascii_digit);
        end += 1 + fraction;
    }
    if whole + fraction == 0 {
        return 0;
    }
    if matches!(byte(end), Some(b'e' | b'E')) {
        let digits_at = end + 1 + sign(end + 1);
        let exponent = run(digits_at, u8::is_ascii_digit);
        if exponent > 0 {
            end = digits_at + exponent;
        }
    }
    end
}

/// Bytes of the identifier that a text begins with, 0 if it begins with none.
fn identifier_length(text: &str) -> usize {
    let first_is_right = |byte: u8| !byte.is_ascii_digit() && !matches!(byte, b'+' | b'-');
    let length = text.bytes().take_while(|byte| !is_excluded(*byte)).count();
    match text.bytes().next().is_some_and(first_is_right) {
        true => length,
        false => 0,
    }
}

/// Whether no identifier holds this byte.
pub(super) fn is_excluded(byte: u8) -> bool {
    matches!(
        byte,
        0..=0x20 | b'"' | b'#' | b'\'' | b',' | b'.' | b'[' | b'\\' | b']' | b'{' | b'}' | 0x7f
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tokens(text: &str) -> Vec<Token<'_>> {
        let mut lexer = Lexer::new(text);
        let mut all = Vec::new();
        loop {
            match lexer.next().unwrap().1 {
                Token::End => return all,
                token => all.push(token),
            }
        }
    }

    #[test]
    fn numbers_end_where_the_grammar_says() {
        let numbers = [
            "1", "-2.5", "+.5", "3.", "1e5", "1E-5", "0x1F", "-0Xff", "7", "-1", "0",
        ];
        let text = "1,-2.5 +.5\t3. 1e5 1E-5 0x1F -0Xff 7-1 0x";
        let mut expected: Vec<_> = numbers.map(Token::Number).into();
        expected.push(Token::Identifier("x"));
        assert_eq!(tokens(text), expected);
    }

    #[test]
    fn routes_names_and_marks() {
        use Token::{Identifier, Mark};
        let text = "a-b_1.set_é TO{[ ]}# to the end } \"\r# again\n.";
        let expected = [
            Identifier("a-b_1"),
            Mark(b'.'),
            Identifier("set_é"),
            Identifier("TO"),
            Mark(b'{'),
            Mark(b'['),
            Mark(b']'),
            Mark(b'}'),
            Mark(b'.'),
        ];
        assert_eq!(tokens(text), expected);
    }

    #[test]
    fn strings_may_hold_anything_but_their_end() {
        let text = r#""a # b" "say \"x\"" "c:\\""#;
        let expected = ["a # b", "say \"x\"", "c:\\"];
        assert_eq!(tokens(text), expected.map(|text| Token::Text(text.into())));
    }

    #[test]
    fn what_is_no_token_is_refused() {
        let fault = |text| Lexer::new(text).next().unwrap_err().problem.to_string();
        assert_eq!(
            fault(" 'a"),
            "the text is malformed: no token begins with \"'\""
        );
        assert_eq!(
            fault("+-"),
            "the text is malformed: no token begins with \"+\""
        );
        assert_eq!(fault("\"a\\\""), "a string is malformed: it does not end");
    }
}
