//! From subtrees of the graph to shapes of the scene.

use std::collections::{BTreeSet, HashMap};
use std::sync::Arc;

use super::extrusion::add_extrusion;
use super::faces::Faces;
use super::frame::{is_flat, placement_of, placement_to_scene};
use super::graph::{Graph, Node, NodeId};
use super::lexer::Fault;
use super::material::{has_texture, material, material_node};
use super::meshes::{add_elevation_grid, add_face_set};
use super::solids::{add_box, add_cone, add_cylinder, add_sphere};
use crate::error::Problem;
use crate::limits::Budget;
use crate::placement::Placement;
use crate::scene::Shape;
use crate::shape_builder::{ShapeBuilder, check_position};

/// What is left out of, or different in, a subtree.
pub(super) type Notes = BTreeSet<&'static str>;

/// Most vertices of all shapes with several uses together: they are held until the end.
pub(super) const MAX_SHARED_VERTICES: usize = 3_000_000;

pub(super) const LINES: &str = "lines and points left out";
pub(super) const TEXT: &str = "text left out";

/// Builds shapes, those of subtrees with several uses once.
pub(super) struct Shapes<'g, 'a> {
    graph: &'g Graph<'a>,
    pub(super) budget: Budget,
    shared: HashMap<(NodeId, usize), Arc<Built>>,
    /// Rings dropped so far because fewer than three distinct vertices were left of them.
    pub(super) degenerate_rings: usize,
}

/// A subtree at one level of detail.
#[derive(Debug)]
pub(super) struct Subtree {
    /// All that stands in one place only, in the frame of the scene.
    pub(super) own: Built,
    /// What stands in several places, and where.
    pub(super) instances: Vec<(Arc<Built>, Placement)>,
}

/// A finished shape.
#[derive(Debug)]
pub(super) struct Built {
    pub(super) shape: Arc<Shape>,
    pub(super) vertices: usize,
    pub(super) notes: Notes,
    /// Corners of the box around it.
    corners: [[f64; 3]; 8],
}

/// A subtree under way.
struct Walk {
    builder: ShapeBuilder,
    materials: HashMap<NodeId, u32>,
    notes: Notes,
    level: usize,
    /// `None` where what stands in several places is copied: within an instance.
    instances: Option<Vec<(Arc<Built>, Placement)>>,
}

impl<'g, 'a> Shapes<'g, 'a> {
    /// Shapes of a graph, within a budget.
    pub(super) fn new(graph: &'g Graph<'a>, budget: Budget) -> Self {
        Self {
            graph,
            budget,
            shared: HashMap::new(),
            degenerate_rings: 0,
        }
    }

    /// The shapes of a subtree at one of its levels of detail.
    pub(super) fn subtree(
        &mut self,
        root: NodeId,
        placement: &Placement,
        level: usize,
        max_vertices: usize,
    ) -> Result<Subtree, Fault> {
        let mut walk = Walk::new(level, max_vertices, Some(Vec::new()));
        self.visit(root, placement, &mut walk)?;
        let instances = walk.instances.take().unwrap_or_default();
        self.degenerate_rings += walk.builder.degenerate_rings;
        Ok(Subtree {
            own: walk.finish(),
            instances,
        })
    }

    fn visit(&mut self, id: NodeId, placement: &Placement, walk: &mut Walk) -> Result<(), Fault> {
        let node = self.graph.node(id);
        if !node.has_shape {
            return Ok(());
        }
        self.budget.objects(1).map_err(Fault::at(node.offset))?;
        // A shape that a placement flattens may have fewer vertices, so it is copied.
        if node.shared && walk.instances.is_some() && !is_flat(placement) {
            return self.add_instance(id, placement, walk);
        }
        if node.node_type.name == "Shape" {
            return self.add_shape(node, placement, walk);
        }
        let here = placement.after(&placement_of(node));
        let children = self.graph.children(node, Some(walk.level));
        children
            .iter()
            .try_for_each(|child| self.visit(*child, &here, walk))
    }

    fn add_instance(
        &mut self,
        id: NodeId,
        placement: &Placement,
        walk: &mut Walk,
    ) -> Result<(), Fault> {
        let built = self.shared(id, walk.level)?;
        walk.notes.extend(&built.notes);
        if built.shape.surfaces.is_empty() {
            return Ok(());
        }
        let placement = placement_to_scene(placement);
        let mut corners = built.corners.iter().map(|corner| placement.apply(*corner));
        let checked = corners.try_for_each(|corner| check_position(&corner));
        checked.map_err(Fault::at(self.graph.node(id).offset))?;
        if let Some(instances) = &mut walk.instances {
            instances.push((built, placement));
        }
        Ok(())
    }

    /// The shape of a subtree that stands in several places, in its own frame.
    fn shared(&mut self, id: NodeId, level: usize) -> Result<Arc<Built>, Fault> {
        let node = self.graph.node(id);
        let key = (id, level.min(node.levels - 1));
        if let Some(built) = self.shared.get(&key) {
            return Ok(built.clone());
        }
        let mut walk = Walk::new(key.1, MAX_SHARED_VERTICES, None);
        // Not shared within itself, so what comes is its content.
        match node.node_type.name {
            "Shape" => self.add_shape(node, &Placement::IDENTITY, &mut walk)?,
            _ => {
                let here = placement_of(node);
                for child in self.graph.children(node, Some(walk.level)) {
                    self.visit(*child, &here, &mut walk)?;
                }
            }
        }
        self.degenerate_rings += walk.builder.degenerate_rings;
        let vertices = walk.builder.vertices;
        let spent = self.budget.instance_vertices(vertices);
        spent.map_err(Fault::at(node.offset))?;
        let built = Arc::new(walk.finish());
        self.shared.insert(key, built.clone());
        Ok(built)
    }

    fn add_shape(
        &mut self,
        node: &Node<'a>,
        placement: &Placement,
        walk: &mut Walk,
    ) -> Result<(), Fault> {
        let Some(&geometry) = node.nodes("geometry").first() else {
            return Ok(());
        };
        let geometry = self.graph.node(geometry);
        if has_texture(self.graph, node) {
            walk.notes.insert("textures left out");
        }
        if !geometry.nodes("color").is_empty() {
            walk.notes.insert("colours of vertices and faces left out");
        }
        let material = self.material(node, walk);
        let mut faces = Faces {
            builder: &mut walk.builder,
            budget: &mut self.budget,
            placement: *placement,
            clockwise: geometry.node_type.field("ccw").is_some() && !geometry.is("ccw"),
            material,
        };
        let added = add_geometry(self.graph, geometry, &mut faces);
        walk.notes
            .extend(added.map_err(Fault::at(geometry.offset))?);
        Ok(())
    }

    /// The number of a shape's material among those of the walk.
    fn material(&self, shape: &Node<'a>, walk: &mut Walk) -> Option<u32> {
        let id = material_node(self.graph, shape)?;
        if let Some(number) = walk.materials.get(&id) {
            return Some(*number);
        }
        let materials = &mut walk.builder.shape.materials;
        let number = u32::try_from(materials.len()).ok()?;
        materials.push(material(self.graph.node(id)));
        walk.materials.insert(id, number);
        Some(number)
    }
}

impl Walk {
    fn new(
        level: usize,
        max_vertices: usize,
        instances: Option<Vec<(Arc<Built>, Placement)>>,
    ) -> Self {
        Self {
            builder: ShapeBuilder::new(max_vertices),
            materials: HashMap::new(),
            notes: Notes::new(),
            level,
            instances,
        }
    }

    fn finish(self) -> Built {
        Built {
            corners: corners(&self.builder.shape),
            shape: Arc::new(self.builder.shape),
            vertices: self.builder.vertices,
            notes: self.notes,
        }
    }
}

/// The corners of the box around a shape.
fn corners(shape: &Shape) -> [[f64; 3]; 8] {
    let rings = shape.surfaces.iter().flat_map(|surface| &surface.rings);
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for position in rings.flatten() {
        low = std::array::from_fn(|i| low[i].min(position[i]));
        high = std::array::from_fn(|i| high[i].max(position[i]));
    }
    std::array::from_fn(|bits| std::array::from_fn(|i| [low[i], high[i]][bits >> i & 1]))
}

/// Adds the faces of a geometry node, and says what is different in them.
fn add_geometry(
    graph: &Graph<'_>,
    node: &Node<'_>,
    faces: &mut Faces<'_>,
) -> Result<Option<&'static str>, Problem> {
    const FACETED: &str = "round surfaces made of flat facets inside them";
    match node.node_type.name {
        "IndexedFaceSet" => add_face_set(graph, node, faces).map(|()| None),
        "ElevationGrid" => add_elevation_grid(node, faces).map(|()| None),
        "Extrusion" => add_extrusion(node, faces).map(|()| None),
        "Box" => add_box(node, faces).map(|()| None),
        "Cone" => add_cone(node, faces).map(|()| Some(FACETED)),
        "Cylinder" => add_cylinder(node, faces).map(|()| Some(FACETED)),
        "Sphere" => add_sphere(node, faces).map(|()| Some(FACETED)),
        "IndexedLineSet" | "PointSet" => Ok(Some(LINES)),
        "Text" => Ok(Some(TEXT)),
        other => Err(Problem::Invalid {
            what: "the geometry of a Shape".to_owned(),
            found: other.to_owned(),
            expected: "a geometry node",
        }),
    }
}
