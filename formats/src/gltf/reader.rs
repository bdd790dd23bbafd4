//! From the nodes of a document to features.

use std::collections::HashMap;
use std::io::Read;
use std::sync::{Arc, Weak};

use serde::Deserialize;
use serde_json::value::RawValue;

use super::buffers::{MAX_INPUT_BYTES, check_total};
use super::document::{Document, list};
use super::feature::FeatureBuilder;
use super::node::Node;
use super::record::NodeRecord;
use super::shapes::{Losses, check_position, read_shape};
use super::weight::check_name;
use crate::error::{FormatError, Location, Problem};
use crate::input::{Input, ReadOptions, Sink};
use crate::limits::{Budget, Limits, MAX_NESTING};
use crate::placement::Placement;
use crate::scene::{Geometry, SceneDescription, Shape};

/// Reads the default scene of a glTF document, else the first, else all nodes that are no one's
/// children.
///
/// The root nodes are the features. A root that is alone and has no mesh is the frame of the scene,
/// and its children are the features. A node with the record of our writer is a feature wherever it
/// is. A feature's geometry is that of its whole subtree. Meshes become shapes, in their own frame
/// but z up; nodes and instances of one mesh share the shape within a batch.
///
/// # Errors
/// Anything that the format does not allow in what is read, a required extension that is not known,
/// and more than the reader's limits.
pub(crate) fn read(
    name: &str,
    input: &mut dyn Input,
    options: &ReadOptions<'_>,
    sink: &mut Sink<'_>,
) -> Result<(), FormatError> {
    let file = Location::file(name);
    let bytes = read_all(input).map_err(|problem| file.error(problem))?;
    let document = Document::parse(&bytes, options).map_err(|problem| file.error(problem))?;
    let budget =
        Budget::new(&Limits::STANDARD, bytes.len()).map_err(|problem| file.error(problem))?;
    let mut reader = Reader {
        visited: vec![false; document.nodes.len()],
        document: &document,
        children: 0,
        budget,
        shapes: HashMap::new(),
        scene: SceneDescription::default(),
        bytes: 0,
        batch_bytes: options.batch_bytes,
        sink,
        stopped: false,
        object: None,
    };
    reader.read().map_err(|problem| match &reader.object {
        Some(object) => file.object(object).error(problem),
        None => file.error(problem),
    })
}

fn read_all(input: &mut dyn Input) -> Result<Vec<u8>, Problem> {
    let mut bytes = Vec::new();
    input
        .take(MAX_INPUT_BYTES as u64 + 1)
        .read_to_end(&mut bytes)?;
    check_total(bytes.len())?;
    Ok(bytes)
}

/// Where a node is.
struct Place {
    placement: Placement,
    /// How many nodes are above.
    depth: u64,
    /// The part of the feature that the node belongs to.
    part: Option<Arc<str>>,
}

struct Reader<'r, 'a> {
    document: &'r Document<'a>,
    budget: Budget,
    /// The shapes of meshes, as long as a batch or a feature holds them.
    shapes: HashMap<u64, (Weak<Shape>, Losses)>,
    visited: Vec<bool>,
    /// How many children the nodes had so far.
    children: usize,
    scene: SceneDescription,
    /// What the scene takes in memory.
    bytes: usize,
    batch_bytes: usize,
    sink: &'r mut Sink<'r>,
    stopped: bool,
    /// Name of the feature that is being read.
    object: Option<String>,
}

impl<'a> Reader<'_, 'a> {
    fn read(&mut self) -> Result<(), Problem> {
        let mut roots = self.roots()?;
        let mut place = Place {
            placement: Placement::IDENTITY,
            depth: 0,
            part: None,
        };
        while let [frame] = roots[..] {
            let node = self.node(frame)?;
            let record = NodeRecord::of(node.extras);
            if node.mesh.is_some() || record.feature.is_some() {
                break;
            }
            self.scene.srid = self.scene.srid.or(record.srid);
            place = self.enter(frame, &node, &place)?;
            roots = self.children(&node)?;
        }
        for root in roots {
            let node = self.node(root)?;
            self.feature(root, &node, &place, 0)?;
        }
        self.hand_over();
        Ok(())
    }

    /// The root nodes of the scene.
    fn roots(&self) -> Result<Vec<u64>, Problem> {
        let scenes = &self.document.scenes;
        if let Some(number) = self.document.scene.or((!scenes.is_empty()).then_some(0)) {
            let scene: Scene<'_> = self.document.element("scene", scenes, number)?;
            return list("nodes of a scene", scene.nodes);
        }
        let mut is_child = vec![false; self.visited.len()];
        for number in 0..is_child.len() as u64 {
            let children: Vec<u64> = list("children", self.node(number)?.children)?;
            for child in children {
                if let Some(is_child) = is_child.get_mut(child as usize) {
                    *is_child = true;
                }
            }
        }
        let numbers = (0..).zip(is_child);
        Ok(numbers
            .filter(|(_, is)| !is)
            .map(|(number, _)| number)
            .collect())
    }

    fn node(&self, number: u64) -> Result<Node<'a>, Problem> {
        self.document.element("node", &self.document.nodes, number)
    }

    /// The numbers of a node's children. Each node is the child of one other at most.
    fn children(&mut self, node: &Node<'_>) -> Result<Vec<u64>, Problem> {
        let children: Vec<u64> = list("children", node.children)?;
        self.children += children.len();
        let (found, limit) = (self.children as u64, self.visited.len() as u64);
        if found > limit {
            return Err(Problem::Limit {
                what: "children of nodes",
                found,
                limit,
            });
        }
        Ok(children)
    }

    /// Goes down to a node. Each node is somewhere once, so the walk ends.
    fn enter(&mut self, number: u64, node: &Node<'_>, above: &Place) -> Result<Place, Problem> {
        let visited = usize::try_from(number)
            .ok()
            .and_then(|i| self.visited.get_mut(i));
        if visited.is_none_or(|visited| std::mem::replace(visited, true)) {
            return Err(Problem::Duplicate {
                name: format!("node {number}"),
            });
        }
        let depth = above.depth + 1;
        if depth > MAX_NESTING {
            return Err(Problem::Limit {
                what: "levels of nodes",
                found: depth,
                limit: MAX_NESTING,
            });
        }
        Ok(Place {
            placement: above.placement.after(&node.placement()?),
            depth,
            part: above.part.clone(),
        })
    }

    /// Reads the feature that a node begins, below others of so many bytes.
    fn feature(
        &mut self,
        number: u64,
        node: &Node<'a>,
        above: &Place,
        outer_bytes: usize,
    ) -> Result<(), Problem> {
        if self.stopped {
            return Ok(());
        }
        self.budget.objects(1)?;
        let record = NodeRecord::of(node.extras);
        let mut builder = FeatureBuilder::new(number, node, &record, outer_bytes)?;
        let outer = self.object.replace(builder.feature.name.clone());
        self.collect(number, node, above, &mut builder)?;
        self.object = outer;
        self.bytes += builder.finish(&mut self.scene);
        if self.bytes >= self.batch_bytes {
            self.hand_over();
        }
        Ok(())
    }

    /// Adds the geometry of a node and of those below it.
    fn collect(
        &mut self,
        number: u64,
        node: &Node<'a>,
        above: &Place,
        builder: &mut FeatureBuilder,
    ) -> Result<(), Problem> {
        let mut place = self.enter(number, node, above)?;
        let part = NodeRecord::of(node.extras).part;
        if let Some(part) = part.filter(|_| builder.recorded) {
            check_name("the name of a part", &part)?;
            place.part = Some(part.into());
        }
        if let Some(mesh) = node.mesh {
            builder.skinned |= node.skin.is_some();
            self.add(mesh, node, &place, builder)?;
        }
        for child in self.children(node)? {
            let node = self.node(child)?;
            if NodeRecord::of(node.extras).feature.is_some() {
                self.feature(child, &node, &place, builder.weight.total())?;
            } else {
                self.collect(child, &node, &place, builder)?;
            }
        }
        Ok(())
    }

    /// Adds a mesh wherever its node puts it.
    fn add(
        &mut self,
        mesh: u64,
        node: &Node<'_>,
        place: &Place,
        builder: &mut FeatureBuilder,
    ) -> Result<(), Problem> {
        let shape = self.shape(mesh, builder)?;
        if shape.surfaces.is_empty() {
            return Ok(());
        }
        let corners = box_corners(&shape);
        for instance in node.instances(self.document, &mut builder.weight)? {
            self.budget.objects(1)?;
            let placement = place.placement.after(&instance);
            for corner in corners {
                check_position(placement.apply(corner))?;
            }
            if flattens(&placement) {
                builder.flattened = true;
                continue;
            }
            builder.add(Geometry {
                level_of_detail: builder.level_of_detail,
                part: place.part.as_deref().map(str::to_owned),
                shape: Arc::clone(&shape),
                placement: Some(placement),
            })?;
        }
        Ok(())
    }

    /// The shape of a mesh, the one that is there if anything still holds it.
    fn shape(&mut self, mesh: u64, builder: &mut FeatureBuilder) -> Result<Arc<Shape>, Problem> {
        let known = self.shapes.get(&mesh);
        let known = known.and_then(|(shape, losses)| Some((shape.upgrade()?, *losses)));
        let (shape, losses) = match known {
            Some(known) => known,
            None => {
                let weight = &mut builder.weight;
                let read = read_shape(self.document, mesh, &mut self.budget, weight)?;
                self.scene.degenerate_rings += read.degenerate;
                let shape = Arc::new(read.shape);
                self.shapes
                    .insert(mesh, (Arc::downgrade(&shape), read.losses));
                (shape, read.losses)
            }
        };
        builder.losses.add(losses);
        Ok(shape)
    }

    /// Hands the features over that are complete.
    fn hand_over(&mut self) {
        if !self.stopped {
            self.stopped = (self.sink)(std::mem::take(&mut self.scene)).is_break();
        }
        self.bytes = 0;
        self.shapes.retain(|_, (shape, _)| shape.strong_count() > 0);
    }
}

/// The corners of the box around a shape.
fn box_corners(shape: &Shape) -> [[f64; 3]; 8] {
    let positions = shape.surfaces.iter().flat_map(|s| &s.rings).flatten();
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for position in positions {
        low = std::array::from_fn(|i| low[i].min(position[i]));
        high = std::array::from_fn(|i| high[i].max(position[i]));
    }
    std::array::from_fn(|corner| {
        std::array::from_fn(|axis| {
            if corner >> axis & 1 == 1 {
                high[axis]
            } else {
                low[axis]
            }
        })
    })
}

/// Whether a placement leaves nothing of a volume.
fn flattens(placement: &Placement) -> bool {
    let [[a, b, c, _], [d, e, f, _], [g, h, i, _]] = placement.rows;
    let volume = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g);
    !volume.is_normal()
}

/// A scene as it is read.
#[derive(Deserialize)]
struct Scene<'a> {
    #[serde(borrow)]
    nodes: Option<&'a RawValue>,
}
