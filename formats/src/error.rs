//! Why a file was refused, and where in it.

use std::fmt;

use thiserror::Error;

/// Most characters of the input that an error quotes.
const QUOTED_CHARACTERS: usize = 80;

/// A file that could not be read: where, and what is wrong there.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{location}: {problem}")]
pub struct FormatError {
    location: Box<Location>,
    problem: Box<Problem>,
}

impl FormatError {
    /// The file's name, as given to the reader.
    pub fn file(&self) -> &str {
        &self.location.file
    }

    /// The line, counted from 1, where the format has one object a line or the syntax is broken.
    pub fn line(&self) -> Option<usize> {
        self.location.line
    }

    /// Identifier of the object that is at fault.
    pub fn object(&self) -> Option<&str> {
        self.location.object.as_deref()
    }

    /// What is wrong.
    pub fn problem(&self) -> &Problem {
        &self.problem
    }
}

/// What is wrong with a file.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Problem {
    /// The input gave no more bytes.
    #[error("cannot read: {message}")]
    Unreadable {
        /// The system's words.
        message: String,
    },
    /// None of the formats that are known.
    #[error("the format is not known")]
    UnknownFormat,
    /// Something that the format allows and the reader does not take.
    #[error("{what} is not supported")]
    Unsupported {
        /// What was found, values quoted.
        what: String,
    },
    /// Nothing but white space.
    #[error("the file is empty")]
    Empty,
    /// A byte that is not part of UTF-8 text.
    #[error("the text is not utf-8 from byte {offset} on")]
    NotUtf8 {
        /// Bytes before the first wrong one.
        offset: usize,
    },
    /// The text is no JSON, or it ends too early.
    #[error("not valid json: {message}")]
    Syntax {
        /// The parser's words, with the place.
        message: String,
    },
    /// Another format, or another kind of document.
    #[error("type is {found}, expected {expected}")]
    DocumentType {
        /// The type found, quoted.
        found: String,
        /// The type wanted, quoted.
        expected: &'static str,
    },
    /// A version that this reader does not know.
    #[error("cityjson version {found} is not supported, expected \"1.1\" or \"2.0\"")]
    Version {
        /// The version found, quoted.
        found: String,
    },
    /// A member that the format requires is absent.
    #[error("{what} is missing")]
    Missing {
        /// The member's name.
        what: String,
    },
    /// A value of the wrong type or out of range.
    #[error("{what} is {found}, expected {expected}")]
    Invalid {
        /// The member or element.
        what: String,
        /// The value, quoted and shortened.
        found: String,
        /// What would be right.
        expected: &'static str,
    },
    /// A value that does not have the structure of its type.
    #[error("{what} is malformed: {message}")]
    Malformed {
        /// The member.
        what: String,
        /// The parser's words.
        message: String,
    },
    /// An index past the end of what it points into.
    #[error("{what} {index} is out of range, there are {count}")]
    IndexOutOfRange {
        /// What the index selects.
        what: &'static str,
        /// The index found.
        index: u64,
        /// How many there are to select from.
        count: usize,
    },
    /// A second member of the same name.
    #[error("{name} appears twice")]
    Duplicate {
        /// The name, quoted.
        name: String,
    },
    /// A child that is named and not there, so that geometry would be lost.
    #[error("child {child} is not in the document")]
    MissingChild {
        /// The child's identifier, quoted.
        child: String,
    },
    /// Parents that lead back to the object itself.
    #[error("the object is one of its own ancestors")]
    Cycle,
    /// More than the reader takes.
    #[error("{found} {what} exceed the limit of {limit}")]
    Limit {
        /// What was counted.
        what: &'static str,
        /// How many there are, or would be.
        found: u64,
        /// The most that is read.
        limit: u64,
    },
}

impl From<std::io::Error> for Problem {
    fn from(error: std::io::Error) -> Self {
        Self::Unreadable {
            message: error.to_string(),
        }
    }
}

/// A place in a file, from coarse to fine.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Location {
    file: String,
    line: Option<usize>,
    object: Option<String>,
    geometry: Option<usize>,
}

impl Location {
    /// The whole of a file.
    pub(crate) fn file(name: &str) -> Self {
        Self {
            file: name.to_owned(),
            ..Self::default()
        }
    }

    /// The same place, on a line counted from 1.
    pub(crate) fn line(&self, line: Option<usize>) -> Self {
        Self {
            line,
            ..self.clone()
        }
    }

    /// The same place, in an object.
    pub(crate) fn object(&self, id: &str) -> Self {
        Self {
            object: Some(id.to_owned()),
            ..self.clone()
        }
    }

    /// The same place, in the object's n-th geometry, counted from 0.
    pub(crate) fn geometry(&self, geometry: usize) -> Self {
        Self {
            geometry: Some(geometry),
            ..self.clone()
        }
    }

    /// The error that a problem is at this place.
    pub(crate) fn error(&self, problem: Problem) -> FormatError {
        FormatError {
            location: Box::new(self.clone()),
            problem: Box::new(problem),
        }
    }
}

impl fmt::Display for Location {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.file)?;
        if let Some(line) = self.line {
            write!(f, ", line {line}")?;
        }
        if let Some(object) = &self.object {
            write!(f, ", object {}", quote(object))?;
        }
        if let Some(geometry) = self.geometry {
            write!(f, ", geometry {geometry}")?;
        }
        Ok(())
    }
}

/// The text in double quotes, shortened, control characters escaped.
pub(crate) fn quote(text: &str) -> String {
    format!("{:?}", shorten(text))
}

/// The text, cut where it is longer than an error should be.
pub(crate) fn shorten(text: &str) -> String {
    match text.char_indices().nth(QUOTED_CHARACTERS) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_message_names_every_level_of_the_place() {
        let place = Location::file("a.json")
            .line(Some(3))
            .object("b")
            .geometry(1);
        assert_eq!(
            place.error(Problem::Cycle).to_string(),
            "a.json, line 3, object \"b\", geometry 1: the object is one of its own ancestors"
        );
    }

    #[test]
    fn long_values_are_cut_between_characters() {
        let long = "é".repeat(1000);
        assert_eq!(
            shorten(&long),
            format!("{}…", "é".repeat(QUOTED_CHARACTERS))
        );
        assert_eq!(quote("a\n"), "\"a\\n\"");
    }
}
