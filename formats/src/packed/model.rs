//! The geometries and parts of a model.

use std::collections::HashMap;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::container::malformed;
use super::memory::Memory;
use super::shape::StoredShape;
use crate::error::Problem;
use crate::placement::Placement;
use crate::scene::{Geometry, Part, Shape};

/// A model as it is stored.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct StoredModel {
    /// As JSON, empty for none.
    parts: String,
    shapes: Vec<StoredShape>,
    geometries: Vec<StoredGeometry>,
}

#[derive(Debug, Serialize, Deserialize)]
struct StoredGeometry {
    level_of_detail: f64,
    part: Option<String>,
    shape: u32,
    placement: Option<Placement>,
}

impl StoredModel {
    /// A model in its stored form.
    pub(super) fn of(geometries: &[Geometry], parts: &[Part]) -> Result<Self, Problem> {
        let mut memory = Memory::default();
        memory.geometries(geometries.len())?;
        let mut shapes = Vec::new();
        let mut index_of = HashMap::new();
        let mut stored = Vec::with_capacity(geometries.len());
        for geometry in geometries {
            let next = shapes.len() as u32;
            let index = *index_of.entry(Arc::as_ptr(&geometry.shape)).or_insert(next);
            if index == next {
                shapes.push(StoredShape::of(&geometry.shape, &mut memory)?);
            }
            stored.push(StoredGeometry {
                level_of_detail: geometry.level_of_detail,
                part: geometry.part.clone(),
                shape: index,
                placement: geometry.placement,
            });
        }
        Ok(Self {
            parts: memory.encode(parts)?,
            shapes,
            geometries: stored,
        })
    }

    /// The model.
    pub(super) fn into_model(self) -> Result<(Vec<Part>, Vec<Geometry>), Problem> {
        let mut memory = Memory::default();
        memory.geometries(self.geometries.len())?;
        let shape = |stored: StoredShape| stored.into_shape(&mut memory).map(Arc::new);
        let shapes: Vec<_> = self
            .shapes
            .into_iter()
            .map(shape)
            .collect::<Result<_, _>>()?;
        let geometry = |stored: StoredGeometry| stored.into_geometry(&shapes);
        let geometries = self
            .geometries
            .into_iter()
            .map(geometry)
            .collect::<Result<_, _>>()?;
        Ok((memory.decode(&self.parts)?, geometries))
    }
}

impl StoredGeometry {
    fn into_geometry(self, shapes: &[Arc<Shape>]) -> Result<Geometry, Problem> {
        let shape = shapes.get(self.shape as usize);
        Ok(Geometry {
            level_of_detail: self.level_of_detail,
            part: self.part,
            shape: Arc::clone(shape.ok_or_else(|| malformed("a shape is missing"))?),
            placement: self.placement,
        })
    }
}
