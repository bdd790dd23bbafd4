//! Placed shapes that several geometries share, written once.

use std::collections::HashMap;
use std::sync::Arc;

use super::frame::VertexList;
use super::geometry::stored_geometry;
use super::materials::Materials;
use super::stored::{GeometryTemplates, StoredGeometry};
use crate::scene::{Geometry, Model, Shape};

/// The templates of a file.
pub(super) struct Templates<'a> {
    index_of: HashMap<Key, usize>,
    stored: Vec<StoredGeometry>,
    vertices: Vec<[f64; 3]>,
    materials: Materials<'a>,
}

/// A shape at a level of detail, which a template has and its instances have not.
type Key = (*const Shape, u64);

fn key(geometry: &Geometry) -> Key {
    let level = geometry.level_of_detail.to_bits();
    (Arc::as_ptr(&geometry.shape), level)
}

impl<'a> Templates<'a> {
    /// The templates that models have in common.
    pub(super) fn of(models: &'a [Model]) -> Self {
        let geometries = models.iter().flat_map(|model| &model.feature.geometries);
        let placed = geometries.filter(|geometry| geometry.placement.is_some());
        let mut uses: HashMap<Key, usize> = HashMap::new();
        for geometry in placed.clone() {
            *uses.entry(key(geometry)).or_default() += 1;
        }
        let mut index_of = HashMap::new();
        let mut stored = Vec::new();
        let mut vertices = VertexList::new();
        let mut materials = Materials::default();
        for geometry in placed.filter(|geometry| uses[&key(geometry)] > 1) {
            let next = stored.len();
            if *index_of.entry(key(geometry)).or_insert(next) < next {
                continue;
            }
            let shape = &geometry.shape;
            let mut vertex = |p: [f64; 3]| vertices.index(p.map(f64::to_bits), p);
            let level = geometry.level_of_detail;
            let surfaces = &shape.surfaces;
            stored.push(stored_geometry(
                level,
                shape,
                surfaces,
                &mut vertex,
                &mut materials,
            ));
        }
        Self {
            index_of,
            stored,
            vertices: vertices.into_list(),
            materials,
        }
    }

    /// The template that a placed geometry is an instance of.
    pub(super) fn index(&self, geometry: &Geometry) -> Option<usize> {
        self.index_of.get(&key(geometry)).copied()
    }

    /// The materials that templates refer to, to be the first of the header's.
    pub(super) fn materials(&self) -> Materials<'a> {
        self.materials.clone()
    }

    /// What is written, nothing if there are none.
    pub(super) fn stored(&self) -> Option<GeometryTemplates<'_>> {
        (!self.stored.is_empty()).then_some(GeometryTemplates {
            templates: &self.stored,
            vertices: &self.vertices,
        })
    }
}
