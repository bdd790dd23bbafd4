//! Meshes to accessors and the bytes behind them.

use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

use engine::TriangleMesh;
use glam::DVec3;

use super::delivery::Delivery;
use super::materials::Materials;
use super::structure::{
    Accessor, Attributes, Buffer, BufferView, Mesh, Primitive, PrimitiveExtras,
};
use crate::scene::{Geometry, Shape, Surface};

const UNSIGNED_SHORT: u32 = 5123;
const UNSIGNED_INT: u32 = 5125;
const FLOAT: u32 = 5126;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// Most vertices whose numbers fit into 16 bits: the last number would restart a primitive.
const MAX_SHORT_VERTICES: usize = 65_535;

/// Bytes of a position.
const POSITION_BYTES: usize = 12;

/// The meshes of a file that is written, with what they refer to.
#[derive(Default)]
pub(super) struct Meshes<'a> {
    pub(super) meshes: Vec<Mesh<'a>>,
    pub(super) accessors: Vec<Accessor>,
    pub(super) materials: Materials,
    positions: Vec<u8>,
    indices: Vec<u8>,
    /// Meshes by shape and kind (see [`Delivery::mesh_kind`]).
    shared: HashMap<(*const Shape, bool), Option<usize>>,
}

impl<'a> Meshes<'a> {
    /// Number of a geometry's mesh, the same for all geometries of one shape; `None` where rounding
    /// leaves no triangle of it.
    pub(super) fn number(
        &mut self,
        geometry: &'a Geometry,
        delivery: &Delivery<'_>,
    ) -> serde_json::Result<Option<usize>> {
        let kind = delivery.mesh_kind();
        let key = kind.map(|kind| (Arc::as_ptr(&geometry.shape), kind));
        if let Some(&number) = key.and_then(|key| self.shared.get(&key)) {
            return Ok(number);
        }
        let primitives = self.primitives(&geometry.shape, delivery)?;
        let number = (!primitives.is_empty()).then(|| {
            self.meshes.push(Mesh { primitives });
            self.meshes.len() - 1
        });
        self.shared.extend(key.map(|key| (key, number)));
        Ok(number)
    }

    /// One primitive for each material and class of surface.
    fn primitives(
        &mut self,
        shape: &'a Shape,
        delivery: &Delivery<'_>,
    ) -> serde_json::Result<Vec<Primitive<'a>>> {
        let mut groups = BTreeMap::<_, Vec<&Surface>>::new();
        for surface in delivery.surfaces.iter() {
            let semantic = surface
                .semantic
                .and_then(|i| shape.semantics.get(i as usize));
            let class = semantic.map(|semantic| semantic.class.as_str());
            groups
                .entry((surface.material, class))
                .or_default()
                .push(surface);
        }
        let mut primitives = Vec::new();
        for ((material, class), surfaces) in groups {
            let Some((attributes, indices)) = self.triangles(&surfaces, delivery) else {
                continue;
            };
            let material = material.and_then(|i| shape.materials.get(i as usize));
            primitives.push(Primitive {
                attributes,
                indices,
                material: material.map(|m| self.materials.number(m)).transpose()?,
                extras: class.map(|semantic| PrimitiveExtras { semantic }),
            });
        }
        Ok(primitives)
    }

    /// Writes the triangles that cover surfaces. Each edge of a ring is an edge of one triangle
    /// before rounding; vertices that rounding brings together are one, and triangles that it
    /// makes a line are dropped, so a closed surface stays closed.
    fn triangles(
        &mut self,
        surfaces: &[&Surface],
        delivery: &Delivery<'_>,
    ) -> Option<(Attributes, usize)> {
        let mesh = TriangleMesh::from_polygons(surfaces.iter().map(|surface| vectors(surface)));
        let mut numbers = HashMap::new();
        let mut positions = Vec::new();
        let mut number = |vertex: &DVec3| {
            let position = delivery.relative(vertex.to_array());
            *numbers
                .entry(position.map(f32::to_bits))
                .or_insert_with(|| {
                    positions.push(in_gltf(position));
                    positions.len() as u32 - 1
                })
        };
        let rounded: Vec<u32> = mesh.vertices.iter().map(&mut number).collect();
        let triangles = mesh
            .triangles
            .iter()
            .map(|t| t.map(|i| rounded[i as usize]));
        let triangles: Vec<_> = triangles
            .filter(|[a, b, c]| a != b && b != c && c != a)
            .collect();
        if triangles.is_empty() {
            return None;
        }
        let position = self.write_positions(&positions);
        let indices = self.write_indices(triangles.as_flattened(), positions.len());
        Some((Attributes { position }, indices))
    }

    fn write_positions(&mut self, positions: &[[f32; 3]]) -> usize {
        let bound = |pick: fn(f32, f32) -> f32| {
            let bound = positions
                .iter()
                .copied()
                .reduce(|a, b| std::array::from_fn(|i| pick(a[i], b[i])));
            bound.map(|position| position.map(f64::from))
        };
        self.accessors.push(Accessor {
            buffer_view: 0,
            byte_offset: self.positions.len(),
            component_type: FLOAT,
            count: positions.len(),
            kind: "VEC3",
            min: bound(f32::min),
            max: bound(f32::max),
        });
        let bytes = positions
            .as_flattened()
            .iter()
            .flat_map(|c| c.to_le_bytes());
        self.positions.extend(bytes);
        self.accessors.len() - 1
    }

    fn write_indices(&mut self, indices: &[u32], vertices: usize) -> usize {
        let short = vertices <= MAX_SHORT_VERTICES;
        self.accessors.push(Accessor {
            buffer_view: 1,
            byte_offset: self.indices.len(),
            component_type: if short { UNSIGNED_SHORT } else { UNSIGNED_INT },
            count: indices.len(),
            kind: "SCALAR",
            min: None,
            max: None,
        });
        let bytes = if short { 2 } else { 4 };
        let numbers = indices
            .iter()
            .flat_map(|i| i.to_le_bytes().into_iter().take(bytes));
        self.indices.extend(numbers);
        self.indices
            .resize(self.indices.len().next_multiple_of(4), 0);
        self.accessors.len() - 1
    }

    /// The one buffer, its two views and its bytes; none where nothing was written.
    pub(super) fn buffer(&mut self) -> (Vec<Buffer>, Vec<BufferView>, Vec<u8>) {
        let mut bytes = std::mem::take(&mut self.positions);
        if bytes.is_empty() {
            return (Vec::new(), Vec::new(), bytes);
        }
        let view = |byte_offset, byte_length, byte_stride, target| BufferView {
            buffer: 0,
            byte_offset,
            byte_length,
            byte_stride,
            target,
        };
        let views = vec![
            view(0, bytes.len(), Some(POSITION_BYTES), ARRAY_BUFFER),
            view(bytes.len(), self.indices.len(), None, ELEMENT_ARRAY_BUFFER),
        ];
        bytes.append(&mut self.indices);
        let byte_length = bytes.len();
        (vec![Buffer { byte_length }], views, bytes)
    }
}

fn vectors(surface: &Surface) -> Vec<Vec<DVec3>> {
    let vectors = |ring: &Vec<[f64; 3]>| ring.iter().copied().map(DVec3::from_array).collect();
    surface.rings.iter().map(vectors).collect()
}

/// A position of a mesh, y up.
fn in_gltf([x, y, z]: [f32; 3]) -> [f32; 3] {
    [x, z, -y + 0.0]
}
