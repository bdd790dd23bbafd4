//! The nodes of a file, and what they hold.

use std::borrow::Cow;

use super::node_types::NodeType;
use crate::error::Problem;
use crate::limits::MAX_NESTING;

/// Number of a node in its graph.
pub(super) type NodeId = usize;

/// Most levels of detail of an `LOD` node that are read, best first.
pub(super) const MAX_LEVELS: usize = 3;

/// The nodes of a file: children before their parents, so that none is its own descendant.
#[derive(Debug, Default)]
pub(super) struct Graph<'a> {
    nodes: Vec<Node<'a>>,
    /// The nodes that are in no other node.
    pub(super) roots: Vec<NodeId>,
}

/// A node.
#[derive(Debug)]
pub(super) struct Node<'a> {
    /// Its type.
    pub(super) node_type: &'static NodeType,
    /// The name that `DEF` gives it.
    pub(super) name: Option<&'a str>,
    /// Whether `USE` puts it in more than one place.
    pub(super) shared: bool,
    /// Where its type stands in the text.
    pub(super) offset: usize,
    /// Whether there is a shape in it.
    pub(super) has_shape: bool,
    /// How many levels of detail it has: those of the `LOD` in it that has the most.
    pub(super) levels: usize,
    /// How many levels of nodes it has, itself included.
    height: u64,
    /// Values by the number of their field.
    fields: Vec<(usize, Value<'a>)>,
}

/// The value of a field.
#[derive(Debug)]
pub(super) enum Value<'a> {
    /// Everything that is numbers; true is 1.
    Numbers(Vec<f64>),
    Texts(Vec<Cow<'a, str>>),
    Nodes(Vec<NodeId>),
}

impl<'a> Graph<'a> {
    /// The node of a number that the graph gave.
    pub(super) fn node(&self, id: NodeId) -> &Node<'a> {
        &self.nodes[id]
    }

    /// Notes that a node stands in one more place.
    pub(super) fn share(&mut self, id: NodeId) {
        self.nodes[id].shared = true;
    }

    /// Adds a node that is complete.
    pub(super) fn add(
        &mut self,
        node_type: &'static NodeType,
        name: Option<&'a str>,
        offset: usize,
        fields: Vec<(usize, Value<'a>)>,
    ) -> Result<NodeId, Problem> {
        let held = fields.iter().flat_map(|(_, value)| match value {
            Value::Nodes(nodes) => &nodes[..],
            _ => &[],
        });
        let height = 1 + held.map(|id| self.node(*id).height).max().unwrap_or(0);
        if height > MAX_NESTING {
            return Err(too_deep(height));
        }
        let mut node = Node {
            node_type,
            name,
            shared: false,
            offset,
            has_shape: node_type.name == "Shape",
            levels: 1,
            height,
            fields,
        };
        let children = self.children(&node, None);
        let has_shape = children.iter().any(|id| self.node(*id).has_shape);
        let own_levels = match node_type.name {
            "LOD" => children.len().min(MAX_LEVELS),
            _ => 1,
        };
        let levels = children.iter().map(|id| self.node(*id).levels);
        let levels = levels.chain([own_levels]).max();
        node.levels = levels.unwrap_or(1).max(1);
        node.has_shape |= has_shape;
        self.nodes.push(node);
        Ok(self.nodes.len() - 1)
    }

    /// The nodes placed within a node; of an `LOD` only one level where that is given, the last
    /// where there are fewer.
    pub(super) fn children<'n>(&self, node: &'n Node<'a>, level: Option<usize>) -> &'n [NodeId] {
        let one = |all: &'n [NodeId], i: usize| all.get(i..i + 1).unwrap_or_default();
        match (node.node_type.name, level) {
            ("Anchor" | "Billboard" | "Collision" | "Group" | "Transform", _) => {
                node.nodes("children")
            }
            ("Switch", _) => {
                let choice = node.number("whichChoice");
                match choice >= 0.0 {
                    true => one(node.nodes("choice"), choice as usize),
                    false => &[],
                }
            }
            ("LOD", None) => node.nodes("level"),
            ("LOD", Some(level)) => {
                let all = node.nodes("level");
                one(all, level.min(all.len().saturating_sub(1)))
            }
            _ => &[],
        }
    }

    /// The node that a field holds, if it is of one of these types.
    pub(super) fn child(&self, node: &Node<'a>, field: &str, types: &[&str]) -> Option<NodeId> {
        let id = *node.nodes(field).first()?;
        types.contains(&self.node(id).node_type.name).then_some(id)
    }
}

impl<'a> Node<'a> {
    /// The numbers of a field, or its default.
    pub(super) fn numbers(&self, field: &str) -> &[f64] {
        match self.value(field) {
            Some(Value::Numbers(numbers)) => numbers,
            _ => match self.node_type.field(field) {
                Some(i) => &self.node_type.fields[i].default,
                None => &[],
            },
        }
    }

    /// The numbers of a field that has so many, 0 where it has fewer.
    pub(super) fn vector<const N: usize>(&self, field: &str) -> [f64; N] {
        let numbers = self.numbers(field);
        std::array::from_fn(|i| numbers.get(i).copied().unwrap_or(0.0))
    }

    /// The number of a field that has one.
    pub(super) fn number(&self, field: &str) -> f64 {
        let [number] = self.vector(field);
        number
    }

    /// Whether a field is true.
    pub(super) fn is(&self, field: &str) -> bool {
        self.number(field) != 0.0
    }

    /// The strings of a field.
    pub(super) fn texts(&self, field: &str) -> &[Cow<'a, str>] {
        match self.value(field) {
            Some(Value::Texts(texts)) => texts,
            _ => &[],
        }
    }

    /// The nodes of a field.
    pub(super) fn nodes(&self, field: &str) -> &[NodeId] {
        match self.value(field) {
            Some(Value::Nodes(nodes)) => nodes,
            _ => &[],
        }
    }

    fn value(&self, field: &str) -> Option<&Value<'a>> {
        let number = self.node_type.field(field)?;
        let entry = self.fields.iter().find(|(i, _)| *i == number);
        entry.map(|(_, value)| value)
    }
}

/// The problem of so many levels of nodes.
pub(super) fn too_deep(found: u64) -> Problem {
    Problem::Limit {
        what: "levels of nested nodes",
        found,
        limit: MAX_NESTING,
    }
}
