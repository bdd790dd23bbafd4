//! A glTF document, its lists taken apart only as far as they are used, so that text does not grow
//! in memory; and the bytes behind its accessors.

use std::borrow::Cow;
use std::cell::Cell;
use std::fmt;

use serde::Deserialize;
use serde::de::{Deserializer, SeqAccess, Visitor};
use serde_json::value::RawValue;

use super::buffers;
use super::container;
use crate::error::{Problem, quote, shorten};
use crate::input::ReadOptions;

/// Most elements of one list of a document.
const MAX_ELEMENTS: usize = 2_000_000;

/// Most bytes of JSON that are parsed, those of an element counted each time that it is used.
const MAX_PARSED_BYTES: u64 = 2 << 30;

/// Extensions that change nothing but what surfaces look like, by how their names begin.
const APPEARANCE: [&str; 4] = [
    "KHR_materials_",
    "KHR_texture_",
    "EXT_texture_",
    "KHR_lights_",
];

/// Other extensions that may be required.
const KNOWN: [&str; 2] = ["KHR_mesh_quantization", "EXT_mesh_gpu_instancing"];

/// A list whose elements are raw text.
pub(super) type List<'a> = Vec<&'a RawValue>;

/// A document with its bytes.
pub(super) struct Document<'a> {
    pub(super) nodes: List<'a>,
    pub(super) meshes: List<'a>,
    pub(super) materials: List<'a>,
    pub(super) accessors: List<'a>,
    pub(super) views: List<'a>,
    pub(super) scenes: List<'a>,
    /// Number of the default scene.
    pub(super) scene: Option<u64>,
    pub(super) buffers: Vec<Cow<'a, [u8]>>,
    parsed: Cell<u64>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Root<'a> {
    #[serde(borrow)]
    asset: Option<Asset<'a>>,
    #[serde(borrow)]
    extensions_required: Option<&'a RawValue>,
    scene: Option<u64>,
    #[serde(borrow)]
    scenes: Option<&'a RawValue>,
    #[serde(borrow)]
    nodes: Option<&'a RawValue>,
    #[serde(borrow)]
    meshes: Option<&'a RawValue>,
    #[serde(borrow)]
    materials: Option<&'a RawValue>,
    #[serde(borrow)]
    accessors: Option<&'a RawValue>,
    #[serde(borrow)]
    buffer_views: Option<&'a RawValue>,
    #[serde(borrow)]
    buffers: Option<&'a RawValue>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Asset<'a> {
    #[serde(borrow)]
    version: Cow<'a, str>,
    #[serde(borrow)]
    min_version: Option<Cow<'a, str>>,
}

impl<'a> Document<'a> {
    /// Takes a file apart, GLB or JSON, and fetches its buffers.
    pub(super) fn parse(file: &'a [u8], options: &ReadOptions<'_>) -> Result<Self, Problem> {
        let (json, binary) = if file.starts_with(container::MAGIC) {
            container::unpack(file)?
        } else {
            (file, None)
        };
        let json = json.strip_prefix(b"\xef\xbb\xbf").unwrap_or(json);
        let root: Root<'a> = serde_json::from_slice(json).map_err(|error| Problem::Syntax {
            message: shorten(&error.to_string()),
        })?;
        check_version(root.asset)?;
        check_extensions(root.extensions_required)?;
        let buffers = list("buffers", root.buffers)?;
        Ok(Self {
            nodes: list("nodes", root.nodes)?,
            meshes: list("meshes", root.meshes)?,
            materials: list("materials", root.materials)?,
            accessors: list("accessors", root.accessors)?,
            views: list("buffer views", root.buffer_views)?,
            scenes: list("scenes", root.scenes)?,
            scene: root.scene,
            buffers: buffers::load(&buffers, binary, file.len(), options)?,
            parsed: Cell::new(0),
        })
    }

    /// An element of one of the lists.
    pub(super) fn element<T: Deserialize<'a>>(
        &self,
        what: &'static str,
        list: &[&'a RawValue],
        index: u64,
    ) -> Result<T, Problem> {
        let element = element_of(what, list, index)?;
        let parsed = self.parsed.get().saturating_add(element.get().len() as u64);
        if parsed > MAX_PARSED_BYTES {
            return Err(Problem::Limit {
                what: "bytes of json, counted as often as used,",
                found: parsed,
                limit: MAX_PARSED_BYTES,
            });
        }
        self.parsed.set(parsed);
        parse(&format!("{what} {index}"), element)
    }
}

/// The raw text or the bytes that an index selects.
pub(super) fn element_of<'l, T>(
    what: &'static str,
    list: &'l [T],
    index: u64,
) -> Result<&'l T, Problem> {
    let element = usize::try_from(index).ok().and_then(|i| list.get(i));
    element.ok_or(Problem::IndexOutOfRange {
        what,
        index,
        count: list.len(),
    })
}

/// Raw text as a value; positions within it mean nothing to a reader of the file.
pub(super) fn parse<'a, T: Deserialize<'a>>(what: &str, raw: &'a RawValue) -> Result<T, Problem> {
    serde_json::from_str(raw.get()).map_err(|error| malformed(what, &error))
}

fn malformed(what: &str, error: &serde_json::Error) -> Problem {
    let message = error.to_string();
    let position = message.rsplit_once(" at line ");
    Problem::Malformed {
        what: what.to_owned(),
        message: shorten(position.map_or(message.as_str(), |(words, _)| words)),
    }
}

/// A list that may be absent.
pub(super) fn list<'a, T: Deserialize<'a>>(
    what: &'static str,
    raw: Option<&'a RawValue>,
) -> Result<Vec<T>, Problem> {
    let Some(raw) = raw else {
        return Ok(Vec::new());
    };
    let mut elements = Elements(Vec::new());
    let mut text = serde_json::Deserializer::from_str(raw.get());
    match text.deserialize_seq(&mut elements) {
        Ok(()) => Ok(elements.0),
        Err(_) if elements.0.len() == MAX_ELEMENTS => Err(Problem::Limit {
            what,
            found: MAX_ELEMENTS as u64 + 1,
            limit: MAX_ELEMENTS as u64,
        }),
        Err(error) => Err(malformed(what, &error)),
    }
}

/// Takes elements until there are too many.
struct Elements<T>(Vec<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for &mut Elements<T> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an array")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut sequence: A) -> Result<(), A::Error> {
        while let Some(element) = sequence.next_element()? {
            if self.0.len() == MAX_ELEMENTS {
                return Err(serde::de::Error::custom("too many elements"));
            }
            self.0.push(element);
        }
        Ok(())
    }
}

fn check_version(asset: Option<Asset<'_>>) -> Result<(), Problem> {
    let asset = asset.ok_or_else(|| Problem::Missing {
        what: "asset".to_owned(),
    })?;
    let least = asset.min_version.unwrap_or(Cow::Borrowed("2.0"));
    if asset.version.starts_with("2.") && least == "2.0" {
        return Ok(());
    }
    Err(Problem::Invalid {
        what: "asset version".to_owned(),
        found: format!("{}, at least {}", quote(&asset.version), quote(&least)),
        expected: "\"2.0\"",
    })
}

fn check_extensions(required: Option<&RawValue>) -> Result<(), Problem> {
    let required: Vec<Cow<'_, str>> = list("extensionsRequired", required)?;
    let is_known = |name: &str| {
        KNOWN.contains(&name) || APPEARANCE.iter().any(|start| name.starts_with(start))
    };
    match required.iter().find(|name| !is_known(name)) {
        None => Ok(()),
        Some(name) => Err(Problem::Unsupported {
            what: format!("the required extension {}", quote(name)),
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_are_limited() {
        let text = |count: usize| format!("[{}0]", "0,".repeat(count - 1));
        let read = |count: usize| {
            let raw = RawValue::from_string(text(count)).unwrap();
            list::<u8>("nodes", Some(&raw)).map(|list| list.len())
        };
        assert_eq!(read(MAX_ELEMENTS), Ok(MAX_ELEMENTS));
        assert_eq!(
            read(MAX_ELEMENTS + 1).unwrap_err().to_string(),
            "2000001 nodes exceed the limit of 2000000"
        );
    }
}
