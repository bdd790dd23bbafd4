//! [`Features`], those of a file that are not complete yet, and the batch of those that are.

use std::collections::{BTreeSet, HashMap};
use std::ops::ControlFlow;
use std::sync::Arc;

use super::materials::{Library, unknown};
use crate::error::Problem;
use crate::input::Sink;
use crate::limits::Budget;
use crate::scene::{Changed, Feature, Geometry, SceneDescription, Skipped};
use crate::shape_builder::{MAX_FEATURE_VERTICES, ShapeBuilder};

/// Level of detail of everything, since the format knows none.
const LEVEL_OF_DETAIL: f64 = 2.0;

const CLASS: &str = "Generic";

/// About how many bytes a batch takes for a vertex of a surface.
const BYTES_A_VERTEX: usize = 60;

/// The features under way.
pub(super) struct Features<'s, 'f> {
    sink: &'s mut Sink<'f>,
    batch_bytes: usize,
    /// How many sections of each name are still to come, and what is there of it.
    sections: HashMap<String, usize>,
    open: HashMap<String, Open>,
    /// Vertices of the features that are open.
    open_vertices: usize,
    batch: SceneDescription,
    batch_vertices: usize,
}

/// A feature that more sections may add to.
struct Open {
    builder: ShapeBuilder,
    materials: HashMap<String, u32>,
    notes: BTreeSet<&'static str>,
}

impl<'s, 'f> Features<'s, 'f> {
    /// No features yet, but so many sections of each name to come.
    pub(super) fn new(
        sections: HashMap<String, usize>,
        batch_bytes: usize,
        sink: &'s mut Sink<'f>,
    ) -> Self {
        Self {
            sink,
            batch_bytes,
            sections,
            open: HashMap::new(),
            open_vertices: 0,
            batch: SceneDescription::default(),
            batch_vertices: 0,
        }
    }

    /// Adds a face to a feature.
    pub(super) fn add_face(
        &mut self,
        name: &str,
        ring: Vec<[f64; 3]>,
        material: Option<(&str, &Library)>,
        budget: &mut Budget,
    ) -> Result<(), Problem> {
        let feature = self.open(name);
        let material = material.and_then(|(name, library)| feature.material(name, library));
        let before = feature.builder.vertices;
        feature.builder.add(ring, material, budget)?;
        let added = feature.builder.vertices - before;
        self.open_vertices += added;
        if self.open_vertices > MAX_FEATURE_VERTICES {
            return Err(Problem::Limit {
                what: "vertices of features that are not complete",
                found: self.open_vertices as u64,
                limit: MAX_FEATURE_VERTICES as u64,
            });
        }
        Ok(())
    }

    fn open(&mut self, name: &str) -> &mut Open {
        self.open.entry(name.to_owned()).or_insert_with(|| Open {
            builder: ShapeBuilder::new(MAX_FEATURE_VERTICES),
            materials: HashMap::new(),
            notes: BTreeSet::new(),
        })
    }

    /// Notes what is left out of a feature.
    pub(super) fn note(&mut self, name: &str, note: &'static str) {
        self.open(name).notes.insert(note);
    }

    /// Ends a section of a feature, and the feature if it is the last one. Tells whether to go on.
    pub(super) fn end_section(&mut self, name: &str) -> ControlFlow<()> {
        if let Some(left) = self.sections.get_mut(name) {
            *left = left.saturating_sub(1);
            if *left > 0 {
                return ControlFlow::Continue(());
            }
        }
        if let Some(feature) = self.open.remove(name) {
            self.open_vertices -= feature.builder.vertices;
            self.batch_vertices += feature.builder.vertices;
            feature.finish(name, &mut self.batch);
        }
        if self.batch_vertices.saturating_mul(BYTES_A_VERTEX) < self.batch_bytes {
            return ControlFlow::Continue(());
        }
        self.batch_vertices = 0;
        (self.sink)(std::mem::take(&mut self.batch))
    }

    /// Hands over what is left.
    pub(super) fn finish(self) {
        let _ = (self.sink)(self.batch);
    }
}

impl Open {
    /// The number of a material in the shape.
    fn material(&mut self, name: &str, library: &Library) -> Option<u32> {
        if let Some(number) = self.materials.get(name) {
            return Some(*number);
        }
        let entry = library.get(name).cloned().unwrap_or_else(|| unknown(name));
        if entry.has_texture {
            self.notes.insert("textures left out");
        }
        let materials = &mut self.builder.shape.materials;
        let number = u32::try_from(materials.len()).ok()?;
        materials.push(entry.material);
        self.materials.insert(name.to_owned(), number);
        Some(number)
    }

    fn finish(self, name: &str, scene: &mut SceneDescription) {
        let (name, class) = (name.to_owned(), CLASS.to_owned());
        scene.degenerate_rings += self.builder.degenerate_rings;
        if self.builder.shape.surfaces.is_empty() {
            let why = match self.notes.first() {
                Some(_) => "only lines, points or free-form surfaces",
                None => "no surface with three distinct vertices",
            };
            let why = why.to_owned();
            return scene.skipped.push(Skipped { name, class, why });
        }
        scene.changed.extend(self.notes.iter().map(|how| Changed {
            name: name.clone(),
            class: class.clone(),
            how: (*how).to_owned(),
        }));
        scene.features.push(Feature {
            name,
            class,
            attributes: serde_json::Value::Object(serde_json::Map::new()),
            parts: Vec::new(),
            geometries: vec![Geometry {
                level_of_detail: LEVEL_OF_DETAIL,
                part: None,
                shape: Arc::new(self.builder.shape),
                placement: None,
            }],
        });
    }
}
