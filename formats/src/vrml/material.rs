//! The material of a shape: clauses 6.3 and 6.27.

use super::graph::{Graph, Node, NodeId};
use super::identifier::decode;
use crate::scene::Material;

/// The `Material` node of a shape.
pub(super) fn material_node(graph: &Graph<'_>, shape: &Node<'_>) -> Option<NodeId> {
    let appearance = graph.child(shape, "appearance", &["Appearance"])?;
    graph.child(graph.node(appearance), "material", &["Material"])
}

/// Whether a shape has a texture.
pub(super) fn has_texture(graph: &Graph<'_>, shape: &Node<'_>) -> bool {
    let appearance = graph.child(shape, "appearance", &["Appearance"]);
    appearance.is_some_and(|id| !graph.node(id).nodes("texture").is_empty())
}

/// What a `Material` node says.
pub(super) fn material(node: &Node<'_>) -> Material {
    let color = |field| node.vector(field).map(|c: f64| c.clamp(0.0, 1.0));
    let share = |field| node.number(field).clamp(0.0, 1.0);
    Material {
        name: node.name.map(decode),
        diffuse: color("diffuseColor"),
        emissive: color("emissiveColor"),
        specular: color("specularColor"),
        shininess: share("shininess"),
        ambient_intensity: share("ambientIntensity"),
        transparency: share("transparency"),
        metallic: None,
        roughness: None,
    }
}
