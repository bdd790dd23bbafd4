//! What is said of an element.

use super::wire::Broken;
use crate::extrusion::length;
use crate::limits::MAX_ATTRIBUTE_BYTES;

/// Longest role that is kept, characters: those that matter are short.
const MAX_ROLE: usize = 16;

/// The tags of an element, in their order.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Tags {
    tags: Vec<(String, String)>,
    bytes: usize,
}

impl Tags {
    /// Adds a tag.
    pub(super) fn add(
        &mut self,
        key: impl AsRef<str>,
        value: impl AsRef<str>,
    ) -> Result<(), Broken> {
        let (key, value) = (key.as_ref(), value.as_ref());
        self.bytes += key.len() + value.len() + size_of::<(String, String)>();
        if self.bytes > MAX_ATTRIBUTE_BYTES {
            return Err(Broken(
                "the tags of an element take more than 1048576 bytes",
            ));
        }
        self.tags.push((key.to_owned(), value.to_owned()));
        Ok(())
    }

    /// Memory that they take, about.
    pub(super) fn bytes(&self) -> usize {
        self.bytes
    }

    /// The value of a tag; the first, where a file repeats one.
    pub(super) fn get(&self, key: &str) -> Option<&str> {
        let tag = self.tags.iter().find(|(found, _)| found == key)?;
        Some(&tag.1)
    }

    /// Whether a tag has one of these values.
    pub(super) fn is(&self, key: &str, values: &[&str]) -> bool {
        self.get(key).is_some_and(|value| values.contains(&value))
    }

    /// Whether a tag is there and not denied.
    pub(super) fn has(&self, key: &str) -> bool {
        self.get(key).is_some_and(|value| value != "no")
    }

    /// The length that a tag says, metres, not negative.
    pub(super) fn length(&self, key: &str) -> Option<f64> {
        self.get(key)
            .and_then(length)
            .filter(|length| *length >= 0.0)
    }

    /// All of them as attributes.
    pub(super) fn attributes(&self) -> serde_json::Value {
        let mut attributes = serde_json::Map::new();
        for (key, value) in &self.tags {
            attributes
                .entry(key)
                .or_insert_with(|| value.as_str().into());
        }
        attributes.into()
    }

    /// A role, as long as roles that matter are.
    pub(super) fn shortened(role: &str) -> String {
        role.chars().take(MAX_ROLE).collect()
    }
}
