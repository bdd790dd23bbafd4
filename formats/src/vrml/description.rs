//! What `WorldInfo` nodes say of scenes and features, where our own writer has written them: each
//! string begins with one of the words below and a blank.

use serde_json::{Map, Value};

use super::graph::{Graph, Node, NodeId};
use crate::error::Problem;
use crate::limits::{MAX_ATTRIBUTE_BYTES, MAX_LEVEL_OF_DETAIL, MAX_NAME_BYTES};

pub(super) const SRID: &str = "srid";
pub(super) const ORIGIN: &str = "origin";
pub(super) const NAME: &str = "name";
pub(super) const ID: &str = "id";
pub(super) const CLASS: &str = "class";
pub(super) const LEVEL_OF_DETAIL: &str = "level_of_detail";
pub(super) const ATTRIBUTES: &str = "attributes";

/// Class of features that no `WorldInfo` describes.
pub(super) const GENERIC: &str = "Generic";

/// What a feature's group says of it.
#[derive(Debug)]
pub(super) struct Description {
    pub(super) name: Option<String>,
    pub(super) class: String,
    pub(super) level_of_detail: Option<f64>,
    pub(super) attributes: Value,
}

/// What follows a word in the strings of a `WorldInfo` node.
pub(super) fn said<'n>(info: &'n Node<'_>, word: &str) -> Option<&'n str> {
    let mut texts = info.texts("info").iter();
    texts.find_map(|text| text.strip_prefix(word)?.strip_prefix(' '))
}

/// The `WorldInfo` node that makes a group a feature: the one that names a class.
fn info(graph: &Graph<'_>, group: &Node<'_>) -> Option<NodeId> {
    let mut children = group.nodes("children").iter().copied();
    children.find(|id| {
        let node = graph.node(*id);
        node.node_type.name == "WorldInfo" && said(node, CLASS).is_some()
    })
}

/// Whether a group says itself that it is a feature.
pub(super) fn is_described(graph: &Graph<'_>, group: &Node<'_>) -> bool {
    info(graph, group).is_some()
}

/// What a group says of the feature that it is, if anything.
pub(super) fn describe(graph: &Graph<'_>, group: &Node<'_>) -> Result<Description, Problem> {
    let info = info(graph, group).map(|id| graph.node(id));
    let text = |word| info.and_then(|info| said(info, word));
    let name = text(NAME);
    let class = text(CLASS).unwrap_or(GENERIC);
    check_length("bytes of a name", name.unwrap_or_default(), MAX_NAME_BYTES)?;
    check_length("bytes of a class", class, MAX_NAME_BYTES)?;
    let level = text(LEVEL_OF_DETAIL).and_then(|text| text.parse().ok());
    Ok(Description {
        name: name.map(str::to_owned),
        class: class.to_owned(),
        level_of_detail: level.filter(|level| (0.0..=MAX_LEVEL_OF_DETAIL).contains(level)),
        attributes: text(ATTRIBUTES).map_or(Ok(Value::Object(Map::new())), attributes)?,
    })
}

fn attributes(text: &str) -> Result<Value, Problem> {
    check_length("bytes of attributes", text, MAX_ATTRIBUTE_BYTES)?;
    let parsed = serde_json::from_str::<Map<_, _>>(text);
    parsed
        .map(Value::Object)
        .map_err(|error| Problem::Malformed {
            what: ATTRIBUTES.to_owned(),
            message: error.to_string(),
        })
}

fn check_length(what: &'static str, text: &str, limit: usize) -> Result<(), Problem> {
    let (found, limit) = (text.len() as u64, limit as u64);
    match found > limit {
        true => Err(Problem::Limit { what, found, limit }),
        false => Ok(()),
    }
}
