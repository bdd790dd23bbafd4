//! New numbers for the part of a list that an excerpt uses, and nested indices rewritten to them.

use std::collections::HashMap;
use std::hash::Hash;

use crate::error::{Problem, shorten};

/// Old keys to new numbers, in order of first use.
#[derive(Debug)]
pub(super) struct Numbering<K> {
    number_of: HashMap<K, u64>,
    used: Vec<K>,
}

impl<K> Default for Numbering<K> {
    fn default() -> Self {
        Self {
            number_of: HashMap::new(),
            used: Vec::new(),
        }
    }
}

impl<K: Copy + Eq + Hash> Numbering<K> {
    /// The new number of a key.
    pub(super) fn number(&mut self, key: K) -> u64 {
        *self.number_of.entry(key).or_insert_with(|| {
            self.used.push(key);
            self.used.len() as u64 - 1
        })
    }

    /// The keys used so far, by new number.
    pub(super) fn used(&self) -> &[K] {
        &self.used
    }
}

/// Copies JSON text of nested arrays of indices and nulls, each index replaced by what `replace`
/// makes of it and of its place in its array. `what` names the member in the error for other text.
pub(super) fn rewrite_indices(
    what: &str,
    text: &str,
    out: &mut String,
    mut replace: impl FnMut(usize, u64) -> Result<u64, Problem>,
) -> Result<(), Problem> {
    let mut place = 0;
    let mut rest = text.trim_start();
    while let Some(first) = rest.chars().next() {
        let length = match first {
            '0'..='9' => rest
                .find(|c: char| !c.is_ascii_digit())
                .unwrap_or(rest.len()),
            'n' if rest.starts_with("null") => 4,
            '[' | ']' | ',' => 1,
            _ => return Err(no_index(what, rest)),
        };
        let (token, after) = rest.split_at(length);
        match first {
            '[' => place = 0,
            ',' => place += 1,
            _ => {}
        }
        match first.is_ascii_digit() {
            true => {
                let old = token.parse().map_err(|_| no_index(what, rest))?;
                out.push_str(&replace(place, old)?.to_string());
            }
            false => out.push_str(token),
        }
        rest = after.trim_start();
    }
    Ok(())
}

fn no_index(what: &str, rest: &str) -> Problem {
    Problem::Invalid {
        what: what.to_owned(),
        found: shorten(rest),
        expected: "nested arrays of indices",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_follow_first_use() {
        let mut numbering = Numbering::default();
        assert_eq!([7, 3, 7, 9].map(|key| numbering.number(key)), [0, 1, 0, 2]);
        assert_eq!(numbering.used(), [7, 3, 9]);
    }

    #[test]
    fn indices_are_replaced_by_place_and_value() {
        let mut out = String::new();
        let text = "[ [10, 20,\n30], [null], [1] ]";
        rewrite_indices(
            "values",
            text,
            &mut out,
            |place, old| Ok(old + place as u64),
        )
        .unwrap();
        assert_eq!(out, "[[10,21,32],[null],[1]]");
    }

    #[test]
    fn anything_else_is_refused() {
        let message = |text: &str| {
            let result = rewrite_indices("values", text, &mut String::new(), |_, old| Ok(old));
            result.unwrap_err().to_string()
        };
        let expected = "expected nested arrays of indices";
        assert_eq!(message("[-1]"), format!("values is -1], {expected}"));
        assert_eq!(message("[1.5]"), format!("values is .5], {expected}"));
        assert_eq!(message("[true]"), format!("values is true], {expected}"));
        let huge = "99999999999999999999";
        assert_eq!(message(huge), format!("values is {huge}, {expected}"));
    }
}
