//! The text form shared by all types: `NAME(group, group, …)`, numbers in a group apart by spaces.

use crate::error::Refusal;
use pgrx::PgSqlErrorCode;

/// Longest literal quoted whole in a message.
const QUOTED: usize = 100;

/// The shape of a type's literal.
pub struct Literal {
    /// Name of the type in SQL.
    pub type_name: &'static str,
    /// Word before the parenthesis, in any case; a `Z` may follow it.
    pub keyword: &'static str,
    /// How many numbers stand in each group.
    pub groups: &'static [usize],
    /// An example, for the error.
    pub example: &'static str,
}

impl Literal {
    /// The numbers of a literal, in order.
    pub fn parse(&self, text: &str) -> Result<Vec<f64>, Refusal> {
        self.numbers(text).ok_or_else(|| {
            let shown = shortened(text);
            Refusal::new(
                PgSqlErrorCode::ERRCODE_INVALID_TEXT_REPRESENTATION,
                format!(
                    "invalid input syntax for type {}: \"{shown}\"",
                    self.type_name
                ),
            )
            .detail(format!("Expected the form {}.", self.example))
        })
    }

    fn numbers(&self, text: &str) -> Option<Vec<f64>> {
        let text = text.trim();
        let open = text.find('(')?;
        let mut words = text[..open].split_ascii_whitespace();
        let keyword = words.next()?;
        let flag = words.next();
        let named = keyword.eq_ignore_ascii_case(self.keyword)
            && flag.is_none_or(|word| word.eq_ignore_ascii_case("z"))
            && words.next().is_none();
        if !named {
            return None;
        }
        let groups: Vec<&str> = text[open + 1..].strip_suffix(')')?.split(',').collect();
        if groups.len() != self.groups.len() {
            return None;
        }
        let mut numbers = Vec::new();
        for (group, &count) in groups.iter().zip(self.groups) {
            let before = numbers.len();
            for word in group.split_ascii_whitespace() {
                numbers.push(word.parse::<f64>().ok()?);
            }
            if numbers.len() - before != count {
                return None;
            }
        }
        Some(numbers)
    }
}

/// Text as it is quoted in a message.
pub fn shortened(text: &str) -> String {
    let mut shown: String = text.chars().take(QUOTED).collect();
    if shown.len() < text.len() {
        shown.push('…');
    }
    shown
}
