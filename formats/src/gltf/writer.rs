//! Features to one GLB.

use thiserror::Error;

use super::container;
use super::delivery::{Delivery, middle};
use super::frame::placement_in_gltf;
use super::meshes::Meshes;
use super::record::FeatureRecord;
use super::structure::{Asset, Document, GENERATOR, Node, RootRecord, Scene};
use crate::placement::Placement;
use crate::scene::{Geometry, Model};

/// Why features cannot be written as GLB.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum GlbError {
    /// A position that no file can hold.
    #[error("feature {feature} has a position that is not finite or too far from the others")]
    NotFinite {
        /// Number of the feature.
        feature: i64,
    },
    /// The format counts bytes with 32 bits.
    #[error("{bytes} bytes exceed the limit of 4294967295 of the format")]
    TooLarge {
        /// Size of the file, or of one of its chunks.
        bytes: usize,
    },
    /// A value that JSON cannot hold.
    #[error("cannot write json: {0}")]
    Json(#[from] serde_json::Error),
}

/// Writes features as one GLB 2.0.
///
/// The root node carries the file's local origin (whole metres, f64) as its translation; below it
/// is a node for each feature, named after it, with its number, name, class, level of detail,
/// attributes and parts in its `extras`. A feature with one geometry has its mesh there, one with
/// several has a node below for each. Geometries that share a shape share a mesh; one that is
/// placed by more than turning and scaling has a mesh of its own, since nodes of glTF cannot shear.
/// Normals are left out: without them, glTF prescribes flat shading.
///
/// Positions are rounded to f32 around the origin of each mesh, by the rule of
/// [`delivered_positions`](crate::delivered_positions). Equal models give equal bytes.
///
/// # Errors
/// [`GlbError`] when a position is not finite, or the file would exceed 4 GiB.
pub fn write_glb(models: &[Model], srid: Option<i32>) -> Result<Vec<u8>, GlbError> {
    let first = |model: &Model| Some(Delivery::of(model.feature.geometries.first()?).goes_to());
    let origin = middle(models.iter().filter_map(first));
    let mut nodes = Nodes {
        nodes: vec![root(origin, srid)],
        meshes: Meshes::default(),
    };
    for model in models {
        let number = nodes.feature(model, origin)?;
        nodes.nodes[0].children.push(number);
    }
    nodes.finish()
}

fn root<'a>(origin: [f64; 3], srid: Option<i32>) -> Node<'a> {
    let mut root = node_at(&Placement::moved_by(origin));
    root.extras.root = Some(RootRecord {
        generator: GENERATOR,
        srid,
        origin,
    });
    root
}

/// A node with a placement for its transformation.
fn node_at<'a>(placement: &Placement) -> Node<'a> {
    let [[a, b, c, x], [d, e, f, y], [g, h, i, z]] = placement_in_gltf(placement).rows;
    let columns = [a, d, g, 0.0, b, e, h, 0.0, c, f, i, 0.0, x, y, z, 1.0];
    let moves_only = placement.rows.map(|[a, b, c, _]| [a, b, c])
        == Placement::IDENTITY.rows.map(|[a, b, c, _]| [a, b, c]);
    Node {
        translation: (moves_only && [x, y, z] != [0.0; 3]).then_some([x, y, z]),
        matrix: (!moves_only).then_some(columns),
        ..Node::default()
    }
}

struct Nodes<'a> {
    nodes: Vec<Node<'a>>,
    meshes: Meshes<'a>,
}

impl<'a> Nodes<'a> {
    /// Adds a feature's node, which goes below one at `origin`, and those below it.
    fn feature(&mut self, model: &'a Model, origin: [f64; 3]) -> Result<usize, GlbError> {
        let number = self.nodes.len();
        self.nodes.push(Node::default());
        let node = match &model.feature.geometries[..] {
            [geometry] => self.geometry(geometry, origin)?,
            geometries => self.group(geometries, origin)?,
        };
        let mut node = node.ok_or(GlbError::NotFinite { feature: model.id })?;
        node.name = Some(&model.feature.name);
        node.extras.feature = Some(FeatureRecord::of(model));
        self.nodes[number] = node;
        Ok(number)
    }

    /// A node around several geometries, in whole metres near the first.
    fn group(
        &mut self,
        geometries: &'a [Geometry],
        origin: [f64; 3],
    ) -> Result<Option<Node<'a>>, GlbError> {
        let first = geometries
            .first()
            .map(|first| Delivery::of(first).goes_to());
        let base = first.unwrap_or(origin).map(|c| c.round() + 0.0);
        let mut group = node_at(&Placement::moved_by(minus(base, origin)));
        for geometry in geometries {
            let Some(node) = self.geometry(geometry, base)? else {
                return Ok(None);
            };
            group.children.push(self.nodes.len());
            self.nodes.push(node);
        }
        Ok(Some(group))
    }

    /// A node with a geometry's mesh; `None` where a number is not finite.
    fn geometry(
        &mut self,
        geometry: &'a Geometry,
        origin: [f64; 3],
    ) -> Result<Option<Node<'a>>, GlbError> {
        let delivery = Delivery::of(geometry);
        if !delivery.is_finite() {
            return Ok(None);
        }
        let mut placement = delivery.placement;
        for (row, coordinate) in placement.rows.iter_mut().zip(origin) {
            row[3] -= coordinate;
        }
        let mut node = node_at(&placement);
        node.mesh = self.meshes.number(geometry, &delivery)?;
        node.extras.part = geometry.part.as_deref();
        Ok(Some(node))
    }

    fn finish(mut self) -> Result<Vec<u8>, GlbError> {
        let (buffers, buffer_views, bytes) = self.meshes.buffer();
        let document = Document {
            asset: Asset {
                version: "2.0",
                generator: GENERATOR,
            },
            scene: 0,
            scenes: [Scene { nodes: [0] }],
            nodes: self.nodes,
            meshes: self.meshes.meshes,
            materials: self.meshes.materials.into_vec(),
            accessors: self.meshes.accessors,
            buffer_views,
            buffers,
        };
        let json = serde_json::to_vec(&document)?;
        container::pack(json, bytes).map_err(|bytes| GlbError::TooLarge { bytes })
    }
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| a[i] - b[i])
}
