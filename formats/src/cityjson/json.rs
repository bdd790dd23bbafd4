//! JSON as raw text, taken apart one level at a time. Nothing below a member is parsed before
//! somebody asks for it, so nesting costs no stack, and lists are cut at a limit before they take
//! more memory than their text.

use std::borrow::Cow;
use std::collections::HashSet;
use std::fmt;
use std::marker::PhantomData;

use serde::de::{
    Deserialize, DeserializeSeed, Deserializer, IgnoredAny, MapAccess, SeqAccess, Visitor,
};
use serde_json::value::RawValue;

use crate::error::{Problem, quote, shorten};
use crate::limits::MAX_NESTING;

/// Most members of an object that are compared pairwise for duplicates; above, they are hashed.
const FEW_MEMBERS: usize = 16;

/// Most members of an object: 40 bytes of memory each, for as little as six of text.
const MAX_MEMBERS: u64 = 2_000_000;

/// Most elements of a list of names or of raw values: up to 24 bytes each, for two of text.
const MAX_ELEMENTS: u64 = 2_000_000;

/// The members of a JSON object, in their order, each value as raw text.
#[derive(Debug, Default)]
pub(super) struct Members<'a>(Vec<(Cow<'a, str>, &'a RawValue)>);

impl<'a> Members<'a> {
    /// The members of a raw value that has to be an object, no name twice.
    pub(super) fn of(what: &str, raw: &'a RawValue) -> Result<Self, Problem> {
        if !raw.get().starts_with('{') {
            return Err(invalid(what, raw, "an object"));
        }
        let (members, count) = parse_with(what, raw, FirstMembers)?;
        check_count("members of an object", count, MAX_MEMBERS)?;
        members.refuse_duplicates()?;
        Ok(members)
    }

    /// A member's value; null counts as absent.
    pub(super) fn get(&self, name: &str) -> Option<&'a RawValue> {
        let (_, value) = self.0.iter().find(|(key, _)| key == name)?;
        (value.get() != "null").then_some(*value)
    }

    /// The first member's value.
    pub(super) fn first(&self) -> Option<&'a RawValue> {
        self.0.first().map(|(_, value)| *value)
    }

    /// A member's value that has to be there; `what` names it in the error.
    pub(super) fn require(&self, name: &str, what: &str) -> Result<&'a RawValue, Problem> {
        self.get(name).ok_or_else(|| Problem::Missing {
            what: what.to_owned(),
        })
    }

    /// All names and values, given away.
    pub(super) fn into_vec(self) -> Vec<(Cow<'a, str>, &'a RawValue)> {
        self.0
    }

    /// Refuses two members of one name: readers disagree on which of them counts.
    fn refuse_duplicates(&self) -> Result<(), Problem> {
        let duplicate = if self.0.len() <= FEW_MEMBERS {
            let is_twice = |i: &usize| self.0[..*i].iter().any(|(key, _)| *key == self.0[*i].0);
            (1..self.0.len()).find(is_twice)
        } else {
            let mut seen = HashSet::with_capacity(self.0.len());
            self.0
                .iter()
                .position(|(key, _)| !seen.insert(key.as_ref()))
        };
        match duplicate {
            Some(i) => Err(Problem::Duplicate {
                name: quote(&self.0[i].0),
            }),
            None => Ok(()),
        }
    }
}

/// Reads an object and keeps as many members as are allowed; gives the number of all.
struct FirstMembers;

impl<'de> DeserializeSeed<'de> for FirstMembers {
    type Value = (Members<'de>, u64);

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Self::Value, D::Error> {
        deserializer.deserialize_map(self)
    }
}

impl<'de> Visitor<'de> for FirstMembers {
    type Value = (Members<'de>, u64);

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object")
    }

    fn visit_map<M: MapAccess<'de>>(self, mut map: M) -> Result<Self::Value, M::Error> {
        let (mut members, mut count) = (Vec::new(), 0);
        while let Some(Text(key)) = map.next_key()? {
            match count < MAX_MEMBERS {
                true => members.push((key, map.next_value()?)),
                false => drop(map.next_value::<IgnoredAny>()?),
            }
            count += 1;
        }
        Ok((Members(members), count))
    }
}

/// Reads an array and keeps so many elements; gives the number of all.
struct FirstElements<T> {
    limit: u64,
    element: PhantomData<T>,
}

impl<'de, T: Deserialize<'de>> DeserializeSeed<'de> for FirstElements<T> {
    type Value = (Vec<T>, u64);

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Self::Value, D::Error> {
        deserializer.deserialize_seq(self)
    }
}

impl<'de, T: Deserialize<'de>> Visitor<'de> for FirstElements<T> {
    type Value = (Vec<T>, u64);

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an array")
    }

    fn visit_seq<S: SeqAccess<'de>>(self, mut seq: S) -> Result<Self::Value, S::Error> {
        let (mut elements, mut count) = (Vec::new(), 0);
        while count < self.limit {
            match seq.next_element()? {
                Some(element) => elements.push(element),
                None => return Ok((elements, count)),
            }
            count += 1;
        }
        while seq.next_element::<IgnoredAny>()?.is_some() {
            count += 1;
        }
        Ok((elements, count))
    }
}

/// A string, borrowed from the input where it holds no escapes.
#[derive(serde::Deserialize)]
struct Text<'a>(#[serde(borrow)] Cow<'a, str>);

/// A raw value as a Rust value; the error says what it was and not where, since positions inside a
/// raw value mean nothing to a reader of the file.
pub(super) fn parse<'a, T: Deserialize<'a>>(what: &str, raw: &'a RawValue) -> Result<T, Problem> {
    parse_with(what, raw, PhantomData)
}

/// The same, by a seed.
pub(super) fn parse_with<'a, S: DeserializeSeed<'a>>(
    what: &str,
    raw: &'a RawValue,
    seed: S,
) -> Result<S::Value, Problem> {
    // A raw value is one value, so nothing can stand after it.
    let mut deserializer = serde_json::Deserializer::from_str(raw.get());
    seed.deserialize(&mut deserializer).map_err(|error| {
        let position = format!(" at line {} column {}", error.line(), error.column());
        let message = error.to_string();
        let message = shorten(message.strip_suffix(&position).unwrap_or(&message));
        Problem::Malformed {
            what: what.to_owned(),
            message,
        }
    })
}

/// A raw value that has to be an array of so many elements at most.
pub(super) fn list<'a, T: Deserialize<'a>>(
    what: &str,
    raw: &'a RawValue,
    elements: &'static str,
    limit: u64,
) -> Result<Vec<T>, Problem> {
    if !raw.get().starts_with('[') {
        return Err(invalid(what, raw, "an array"));
    }
    let element = PhantomData;
    let (list, count) = parse_with(what, raw, FirstElements { limit, element })?;
    check_count(elements, count, limit)?;
    Ok(list)
}

/// Refuses more than a limit.
pub(super) fn check_count(what: &'static str, found: u64, limit: u64) -> Result<(), Problem> {
    match found > limit {
        true => Err(Problem::Limit { what, found, limit }),
        false => Ok(()),
    }
}

/// A raw value that has to be a string.
pub(super) fn string<'a>(what: &str, raw: &'a RawValue) -> Result<Cow<'a, str>, Problem> {
    if !raw.get().starts_with('"') {
        return Err(invalid(what, raw, "a string"));
    }
    let Text(text) = parse(what, raw)?;
    Ok(text)
}

/// A raw value that has to be an array, its elements raw.
pub(super) fn array<'a>(what: &str, raw: &'a RawValue) -> Result<Vec<&'a RawValue>, Problem> {
    list(what, raw, "elements of an array", MAX_ELEMENTS)
}

/// A raw value that has to be an array of strings.
pub(super) fn strings<'a>(what: &str, raw: &'a RawValue) -> Result<Vec<Cow<'a, str>>, Problem> {
    array(what, raw)?
        .into_iter()
        .map(|element| string(what, element))
        .collect()
}

/// The problem that a value is not what it should be.
pub(super) fn invalid(what: &str, raw: &RawValue, expected: &'static str) -> Problem {
    Problem::Invalid {
        what: what.to_owned(),
        found: shorten(raw.get()),
        expected,
    }
}

/// Refuses valid JSON that is nested more deeply than any reader of the source would follow.
pub(super) fn check_nesting(text: &str) -> Result<(), Problem> {
    let (mut depth, mut deepest) = (0_u64, 0);
    let (mut in_string, mut escaped) = (false, false);
    for byte in text.bytes() {
        match byte {
            _ if escaped => escaped = false,
            b'\\' => escaped = true,
            b'"' => in_string = !in_string,
            b'[' | b'{' if !in_string => depth += 1,
            b']' | b'}' if !in_string => depth = depth.saturating_sub(1),
            _ => {}
        }
        deepest = deepest.max(depth);
    }
    if deepest > MAX_NESTING {
        let what = "levels of nesting";
        return Err(Problem::Limit {
            what,
            found: deepest,
            limit: MAX_NESTING,
        });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nesting_counts_brackets_outside_strings() {
        let nested = |levels| format!("{}{}", "[".repeat(levels), "]".repeat(levels));
        assert_eq!(check_nesting(&nested(100)), Ok(()));
        assert_eq!(
            check_nesting(&nested(101)).unwrap_err().to_string(),
            "101 levels of nesting exceed the limit of 100"
        );
        assert_eq!(check_nesting(&format!("[\"\\\"{}\"]", nested(101))), Ok(()));
        assert_eq!(check_nesting(&"[[],[]],".repeat(200)), Ok(()));
    }

    #[test]
    fn members_keep_order_and_raw_text() {
        let raw: &RawValue = serde_json::from_str(r#"{"b": [1,  2], "a\n": null}"#).unwrap();
        let members = Members::of("value", raw).unwrap();
        assert_eq!(members.get("b").unwrap().get(), "[1,  2]");
        assert!(members.get("a\n").is_none());
        let names: Vec<_> = members
            .into_vec()
            .into_iter()
            .map(|(name, _)| name)
            .collect();
        assert_eq!(names, ["b", "a\n"]);
    }

    #[test]
    fn duplicates_are_found_among_few_and_among_many() {
        for count in [2, 100] {
            let names: Vec<_> = (0..count)
                .map(|i| format!("\"n{}\":0", i % (count - 1)))
                .collect();
            let text = format!("{{{}}}", names.join(","));
            let raw: &RawValue = serde_json::from_str(&text).unwrap();
            let problem = Members::of("value", raw).unwrap_err();
            assert_eq!(problem.to_string(), "\"n0\" appears twice");
        }
    }
}
