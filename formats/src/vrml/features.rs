//! From the graph of a file to the features of the scene.

use std::collections::HashMap;
use std::ops::ControlFlow;

use super::description::{Description, SRID, describe, is_described, said};
use super::frame::placement_of;
use super::graph::{Graph, NodeId};
use super::identifier::decode;
use super::lexer::Fault;
use super::shapes::{LINES, Notes, Shapes, Subtree, TEXT};
use crate::input::Sink;
use crate::limits::Budget;
use crate::placement::Placement;
use crate::scene::{Changed, Feature, Geometry, SceneDescription, Skipped};
use crate::shape_builder::MAX_FEATURE_VERTICES;

/// Level of detail of the best level of an `LOD` node, and of all that is in none; each further
/// level is one less, as many as a graph gives.
const BEST_LEVEL: f64 = 2.0;

/// About how many bytes a batch takes for a vertex of a surface.
const BYTES_A_VERTEX: usize = 60;

/// Hands over the features of a graph. `stem` names those that have no name.
pub(super) fn hand_over(
    graph: &Graph<'_>,
    budget: Budget,
    stem: &str,
    batch_bytes: usize,
    sink: &mut Sink<'_>,
) -> Result<(), Fault> {
    let mut features = Features {
        graph,
        shapes: Shapes::new(graph, budget),
        stem,
        names: HashMap::new(),
        batch: head(graph),
        batch_vertices: 0,
    };
    let (nodes, placement) = feature_nodes(graph);
    for (i, id) in nodes.into_iter().enumerate() {
        features.add(id, &placement, i + 1)?;
        if features.batch_vertices.saturating_mul(BYTES_A_VERTEX) >= batch_bytes {
            features.batch_vertices = 0;
            if let ControlFlow::Break(()) = sink(std::mem::take(&mut features.batch)) {
                return Ok(());
            }
        }
    }
    let _ = sink(features.batch);
    Ok(())
}

/// What the file says of itself.
fn head(graph: &Graph<'_>) -> SceneDescription {
    let mut nodes = graph.roots.iter().map(|id| graph.node(*id));
    let Some(info) = nodes.find(|node| node.node_type.name == "WorldInfo") else {
        return SceneDescription::default();
    };
    let title = info.texts("title").first().map(|title| title.to_string());
    SceneDescription {
        srid: said(info, SRID).and_then(|srid| srid.parse().ok()),
        title: title.filter(|title| !title.is_empty()),
        ..SceneDescription::default()
    }
}

/// The nodes that are a feature each, and where they are placed: those of the root with shapes in
/// them. While it is a single group that has no description, and its children are named or, where
/// it has no name itself, groups, its children take its place.
fn feature_nodes(graph: &Graph<'_>) -> (Vec<NodeId>, Placement) {
    let with_shapes = |ids: &[NodeId]| -> Vec<NodeId> {
        let ids = ids.iter().copied();
        ids.filter(|id| graph.node(*id).has_shape).collect()
    };
    let (mut nodes, mut placement) = (with_shapes(&graph.roots), Placement::IDENTITY);
    while let [only] = nodes[..] {
        let node = graph.node(only);
        let children = with_shapes(node.nodes("children"));
        let is_feature = |id: &NodeId| {
            let child = graph.node(*id);
            child.name.is_some() || (node.name.is_none() && child.node_type.name != "Shape")
        };
        if is_described(graph, node) || !children.iter().any(is_feature) {
            break;
        }
        placement = placement.after(&placement_of(node));
        nodes = children;
    }
    (nodes, placement)
}

struct Features<'g, 'a> {
    graph: &'g Graph<'a>,
    shapes: Shapes<'g, 'a>,
    stem: &'g str,
    /// How often each name has been asked for.
    names: HashMap<String, usize>,
    batch: SceneDescription,
    batch_vertices: usize,
}

impl Features<'_, '_> {
    /// Adds a node as a feature, the `number`-th of the file.
    fn add(&mut self, id: NodeId, placement: &Placement, number: usize) -> Result<(), Fault> {
        let node = self.graph.node(id);
        let description = describe(self.graph, node).map_err(Fault::at(node.offset))?;
        let name = match (&description.name, node.name) {
            (Some(name), _) => name.clone(),
            (None, Some(name)) => decode(name),
            (None, None) => format!("{}-{number}", self.stem),
        };
        let name = self.unused(name);
        let mut notes = Notes::new();
        let mut geometries = Vec::new();
        for level in 0..node.levels {
            let max_vertices = MAX_FEATURE_VERTICES / node.levels;
            let subtree = self.shapes.subtree(id, placement, level, max_vertices)?;
            notes.extend(&subtree.own.notes);
            self.batch_vertices += subtree.own.vertices + subtree.instances.len();
            let level = match description.level_of_detail {
                Some(described) if node.levels == 1 => described,
                _ => BEST_LEVEL - level as f64,
            };
            geometries.extend(geometries_of(subtree, level));
        }
        self.batch.degenerate_rings += std::mem::take(&mut self.shapes.degenerate_rings);
        self.push(name, description, geometries, &notes);
        Ok(())
    }

    fn push(
        &mut self,
        name: String,
        description: Description,
        geometries: Vec<Geometry>,
        notes: &Notes,
    ) {
        let class = description.class;
        if geometries.is_empty() {
            let why = why_none(notes).to_owned();
            return self.batch.skipped.push(Skipped { name, class, why });
        }
        self.batch.changed.extend(notes.iter().map(|how| Changed {
            name: name.clone(),
            class: class.clone(),
            how: (*how).to_owned(),
        }));
        self.batch.features.push(Feature {
            name,
            class,
            attributes: description.attributes,
            parts: Vec::new(),
            geometries,
        });
    }

    /// The name, with a number where another feature has it.
    fn unused(&mut self, name: String) -> String {
        let mut free = name.clone();
        while self.names.contains_key(&free) {
            let times = self.names.entry(name.clone()).or_insert(1);
            *times += 1;
            free = format!("{name}-{times}");
        }
        self.names.insert(free.clone(), 1);
        free
    }
}

fn geometries_of(subtree: Subtree, level_of_detail: f64) -> Vec<Geometry> {
    let own = (!subtree.own.shape.surfaces.is_empty()).then_some((subtree.own.shape, None));
    let instances = subtree.instances.into_iter();
    let instances = instances.map(|(built, placement)| {
        let placement = (placement != Placement::IDENTITY).then_some(placement);
        (built.shape.clone(), placement)
    });
    own.into_iter()
        .chain(instances)
        .map(|(shape, placement)| Geometry {
            level_of_detail,
            part: None,
            shape,
            placement,
        })
        .collect()
}

fn why_none(notes: &Notes) -> &'static str {
    match (notes.contains(LINES), notes.contains(TEXT)) {
        (true, _) => "only lines or points",
        (false, true) => "only text",
        (false, false) => "no surface with three distinct vertices",
    }
}
