//! [`Batch`], which hands a scene over in pieces of bounded size.

use std::ops::ControlFlow;

use crate::input::{ReadOptions, Sink};
use crate::scene::{Changed, Feature, SceneDescription, Skipped, Street, Surface};

/// What a feature, street or note takes beside its positions and texts, bytes; roughly.
const OBJECT_BYTES: usize = 512;

/// What a surface takes beside its positions, bytes.
const SURFACE_BYTES: usize = 96;

/// Collects a scene and gives it to the sink whenever it has grown to the size that was asked for.
pub(crate) struct Batch<'a, 'b> {
    scene: SceneDescription,
    bytes: usize,
    batch_bytes: usize,
    sink: &'a mut Sink<'b>,
}

impl<'a, 'b> Batch<'a, 'b> {
    /// A batch that begins as the given scene, which says what holds of the whole file.
    pub(crate) fn new(
        scene: SceneDescription,
        options: &ReadOptions<'_>,
        sink: &'a mut Sink<'b>,
    ) -> Self {
        Self {
            scene,
            bytes: 0,
            batch_bytes: options.batch_bytes,
            sink,
        }
    }

    /// Adds a feature.
    pub(crate) fn feature(&mut self, feature: Feature) -> ControlFlow<()> {
        let shapes = feature.geometries.iter().map(|geometry| &geometry.shape);
        let surfaces: usize = shapes.map(|shape| surfaces_bytes(&shape.surfaces)).sum();
        // Attributes as values take several times the room of their text.
        let attributes = 4 * feature.attributes.to_string().len();
        self.scene.features.push(feature);
        self.grow(surfaces + attributes)
    }

    /// Adds a street.
    pub(crate) fn street(&mut self, street: Street) -> ControlFlow<()> {
        let bytes = surfaces_bytes(&street.surfaces);
        self.scene.streets.push(street);
        self.grow(bytes)
    }

    /// Adds an object that was left out.
    pub(crate) fn skipped(&mut self, skipped: Skipped) -> ControlFlow<()> {
        self.scene.skipped.push(skipped);
        self.grow(0)
    }

    /// Adds how an object differs from its source.
    pub(crate) fn changed(&mut self, changed: Changed) -> ControlFlow<()> {
        self.scene.changed.push(changed);
        self.grow(0)
    }

    /// Hands over what is left; the last call.
    pub(crate) fn finish(self) -> ControlFlow<()> {
        (self.sink)(self.scene)
    }

    fn grow(&mut self, bytes: usize) -> ControlFlow<()> {
        self.bytes += bytes + OBJECT_BYTES;
        if self.bytes < self.batch_bytes {
            return ControlFlow::Continue(());
        }
        self.bytes = 0;
        let srid = self.scene.srid;
        let scene = std::mem::take(&mut self.scene);
        self.scene.srid = srid;
        (self.sink)(scene)
    }
}

fn surfaces_bytes(surfaces: &[Surface]) -> usize {
    let positions = |surface: &Surface| surface.rings.iter().map(Vec::len).sum::<usize>();
    let bytes = |surface| SURFACE_BYTES + positions(surface) * size_of::<[f64; 3]>();
    surfaces.iter().map(bytes).sum()
}
