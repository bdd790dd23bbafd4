//! [`Sampling`], item buffers from a grid of eyes in a cell.

use std::collections::HashSet;

use embree::Device;
use engine::Box3d;
use glam::DVec2;

use super::way::Way;
use super::window::Window;
use crate::bench::item_buffer::ItemBuffer;
use crate::bench::truth::Truth;
use crate::failure::Failure;
use crate::scene::Surfaces;

/// Steps along each side of a cell from eye to eye, and pixels along a side of each face.
const KINDS: [(usize, u32); 3] = [(2, 128), (4, 128), (4, 512)];

/// Of the eyes from which what is visible is known.
const KNOWN: (usize, u32) = (4, 512);

/// What can be seen in a window, and a device of Embree.
pub struct Scenery<'a> {
    window: &'a Window,
    surfaces: Surfaces,
    device: Device,
}

impl<'a> Scenery<'a> {
    /// That of a window.
    pub fn new(window: &'a Window) -> Self {
        let streets = window.region.streets().iter();
        let eyes = streets.map(|street| street.eye_low);
        Self {
            window,
            surfaces: Surfaces::seen_from(&window.around.features, eyes),
            device: Device::new(),
        }
    }

    /// The ways of sampling.
    pub fn ways(&self) -> impl Iterator<Item = Box<dyn Way + '_>> {
        KINDS.into_iter().map(|(steps, resolution)| {
            let eyes = (steps + 1) * (steps + 1);
            let way = Sampling {
                name: format!("Embree, {eyes} eyes, 6 × {resolution}²"),
                scenery: self,
                buffer: None,
                steps,
                resolution,
            };
            Box::new(way) as Box<dyn Way>
        })
    }

    /// What is known to be visible.
    pub fn known(&self) -> Result<Known<'_>, Failure> {
        Ok(Known {
            window: self.window,
            buffer: self.buffer(),
            truth: Truth::new(&self.window.around.features, &self.surfaces)?,
        })
    }

    /// A tree for all eyes of the window.
    fn buffer(&self) -> ItemBuffer<'_> {
        let middle = self.window.middle().to_array();
        ItemBuffer::new(&self.device, middle, &self.surfaces.triangles)
    }
}

/// Item buffers from a grid of eyes.
struct Sampling<'a> {
    name: String,
    scenery: &'a Scenery<'a>,
    buffer: Option<ItemBuffer<'a>>,
    steps: usize,
    resolution: u32,
}

impl Way for Sampling<'_> {
    fn name(&self) -> &str {
        &self.name
    }

    fn is_complete(&self) -> bool {
        false
    }

    fn prepare(&mut self) {
        self.buffer = Some(self.scenery.buffer());
    }

    fn answer(&mut self, cell: &Box3d) -> HashSet<i64> {
        let window = self.scenery.window;
        let buffer = self.buffer.get_or_insert_with(|| self.scenery.buffer());
        let mut seen = HashSet::new();
        for eye in window.eyes_in(cell, self.steps, DVec2::ZERO, &[cell.max.z]) {
            buffer.eye = eye.to_array();
            let sightings = buffer.look(self.resolution);
            seen.extend(window.around.shown(&sightings, buffer.eye));
        }
        seen
    }
}

/// What is known to be visible from somewhere in a cell, because an exact ray meets it.
pub struct Known<'a> {
    window: &'a Window,
    buffer: ItemBuffer<'a>,
    truth: Truth<'a>,
}

impl Known<'_> {
    /// The features that rays from a grid of eyes meet.
    pub fn visible(&mut self, cell: &Box3d) -> HashSet<i64> {
        let (steps, resolution) = KNOWN;
        let around = &self.window.around;
        let mut known = HashSet::new();
        for eye in self.window.eyes_in(cell, steps, DVec2::ZERO, &[cell.max.z]) {
            self.buffer.eye = eye.to_array();
            let sightings = self.buffer.look(resolution);
            let found = self.truth.visible(&self.buffer, &sightings, |feature| {
                !known.contains(&feature.id) && around.is_in_range(feature, self.buffer.eye)
            });
            known.extend(found);
        }
        known
    }
}
