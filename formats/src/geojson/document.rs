//! A document, taken apart into its features.

use std::borrow::Cow;
use std::fmt;

use serde::de::{Deserialize, Deserializer, Error, SeqAccess, Visitor};
use serde_json::value::RawValue;

use super::invalid;
use crate::error::{Problem, shorten};
use crate::limits::{Limits, MAX_NESTING};

/// The members of a document that matter; its features are still text.
pub(super) struct Document<'a> {
    /// What the data set is called.
    pub(super) name: Option<String>,
    /// The reference system, in the form of GeoJSON of 2008.
    pub(super) crs: Option<&'a RawValue>,
    /// The features, in their order.
    pub(super) features: Vec<&'a RawValue>,
}

/// The root object as it is written.
#[derive(serde::Deserialize)]
struct Root<'a> {
    #[serde(borrow, rename = "type")]
    kind: Option<Cow<'a, str>>,
    #[serde(borrow)]
    name: Option<&'a RawValue>,
    #[serde(borrow)]
    crs: Option<&'a RawValue>,
    #[serde(borrow)]
    features: Option<Features<'a>>,
}

impl<'a> Document<'a> {
    /// The document in these bytes.
    pub(super) fn parse(bytes: &'a [u8], limits: &Limits) -> Result<Self, Problem> {
        let text = std::str::from_utf8(bytes).map_err(|error| Problem::NotUtf8 {
            offset: error.valid_up_to(),
        })?;
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        if text.trim().is_empty() {
            return Err(Problem::Empty);
        }
        check_nesting(text)?;
        let syntax = |error: serde_json::Error| Problem::Syntax {
            message: shorten(&error.to_string()),
        };
        let root: Root<'_> = serde_json::from_str(text).map_err(syntax)?;
        let features = match root.kind.as_deref() {
            Some("FeatureCollection") => root.features.map(|Features(features)| features),
            Some("Feature") => Some(vec![serde_json::from_str(text).map_err(syntax)?]),
            Some(kind) => {
                return Err(Problem::DocumentType {
                    found: crate::error::quote(kind),
                    expected: "\"FeatureCollection\" or \"Feature\"",
                });
            }
            None => return Err(missing("type")),
        };
        let features = features.ok_or_else(|| missing("features"))?;
        let found = features.len() as u64;
        if found > limits.objects {
            return Err(Problem::Limit {
                what: "objects",
                found,
                limit: limits.objects,
            });
        }
        Ok(Self {
            name: root
                .name
                .and_then(|name| serde_json::from_str(name.get()).ok()),
            crs: root.crs,
            features,
        })
    }
}

fn missing(what: &str) -> Problem {
    Problem::Missing { what: what.into() }
}

/// Raw features. More than any limit allows are refused while they are read.
struct Features<'a>(Vec<&'a RawValue>);

impl<'de: 'a, 'a> Deserialize<'de> for Features<'a> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(FeaturesVisitor(std::marker::PhantomData))
    }
}

struct FeaturesVisitor<'a>(std::marker::PhantomData<&'a ()>);

impl<'de: 'a, 'a> Visitor<'de> for FeaturesVisitor<'a> {
    type Value = Features<'a>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an array of features")
    }

    fn visit_seq<S: SeqAccess<'de>>(self, mut seq: S) -> Result<Self::Value, S::Error> {
        let most = Limits::STANDARD.objects;
        let mut features = Vec::new();
        while let Some(feature) = seq.next_element()? {
            features.push(feature);
            if features.len() as u64 > most {
                return Err(S::Error::custom(format!("more than {most} features")));
            }
        }
        Ok(Features(features))
    }
}

/// Refuses nesting that would be too deep for whoever reads a feature later.
fn check_nesting(text: &str) -> Result<(), Problem> {
    let (mut depth, mut is_string, mut is_escaped) = (0_u64, false, false);
    for byte in text.bytes() {
        match byte {
            _ if is_escaped => is_escaped = false,
            b'\\' => is_escaped = is_string,
            b'"' => is_string = !is_string,
            b'[' | b'{' if !is_string => depth += 1,
            b']' | b'}' if !is_string => depth = depth.saturating_sub(1),
            _ => (),
        }
        if depth > MAX_NESTING {
            return Err(Problem::Limit {
                what: "levels of nesting",
                found: depth,
                limit: MAX_NESTING,
            });
        }
    }
    Ok(())
}

/// A raw value as a Rust value.
pub(super) fn parse<'a, T: Deserialize<'a>>(what: &str, raw: &'a RawValue) -> Result<T, Problem> {
    serde_json::from_str(raw.get()).map_err(|error| {
        let message = error.to_string();
        // Positions inside of a raw value mean nothing to a reader of the file.
        let words = message
            .rsplit_once(" at line ")
            .map_or(message.as_str(), |(words, _)| words);
        Problem::Malformed {
            what: what.to_owned(),
            message: shorten(words),
        }
    })
}

/// A raw value that has to be an object.
pub(super) fn object<'a, T: Deserialize<'a>>(what: &str, raw: &'a RawValue) -> Result<T, Problem> {
    if !raw.get().starts_with('{') {
        return Err(invalid(what, raw.get(), "an object"));
    }
    parse(what, raw)
}
