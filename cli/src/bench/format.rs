//! [`Format`], how benchmarks print.

use clap::ValueEnum;

use crate::terminal;

/// How tables are printed.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Format {
    /// For a terminal
    Plain,
    /// For a document
    Markdown,
}

impl Format {
    /// A title.
    pub fn title(self, text: &str) -> String {
        match self {
            Self::Plain => format!("{text}\n\n"),
            Self::Markdown => format!("### {text}\n\n"),
        }
    }

    /// A table; columns of numbers are flush right.
    pub fn table(self, heading: &[&str], right: &[bool], rows: &[Vec<String>]) -> String {
        match self {
            Self::Plain => terminal::table(heading, right, rows),
            Self::Markdown => {
                let line = |cells: Vec<&str>| format!("| {} |", cells.join(" | "));
                let rule = right
                    .iter()
                    .map(|&right| if right { "---:" } else { "---" });
                let body = rows
                    .iter()
                    .map(|row| line(row.iter().map(String::as_str).collect()));
                let head = [line(heading.to_vec()), line(rule.collect())];
                head.into_iter().chain(body).collect::<Vec<_>>().join("\n")
            }
        }
    }
}
