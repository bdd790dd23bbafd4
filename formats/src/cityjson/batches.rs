//! What was read, handed over batch by batch.

use std::mem;
use std::ops::ControlFlow;

use crate::input::Sink;
use crate::scene::SceneDescription;

/// A batch under way and where it goes.
pub(super) struct Batches<'s> {
    /// What every batch says of its file.
    description: SceneDescription,
    /// The batch.
    pub(super) batch: SceneDescription,
    /// About how many bytes it holds.
    bytes: usize,
    /// How many are enough.
    enough: usize,
    any_handed_over: bool,
    sink: &'s mut Sink<'s>,
}

impl<'s> Batches<'s> {
    /// The first batch, with nothing in it.
    pub(super) fn new(
        description: SceneDescription,
        enough: usize,
        sink: &'s mut Sink<'s>,
    ) -> Self {
        Self {
            batch: description.clone(),
            description,
            bytes: 0,
            enough,
            any_handed_over: false,
            sink,
        }
    }

    /// Counts what was put into the batch, about so many bytes, and hands it over when it is full.
    pub(super) fn grow(&mut self, bytes: usize) -> ControlFlow<()> {
        self.bytes = self.bytes.saturating_add(bytes);
        if self.bytes < self.enough {
            return ControlFlow::Continue(());
        }
        self.bytes = 0;
        self.any_handed_over = true;
        (self.sink)(mem::replace(&mut self.batch, self.description.clone()))
    }

    /// Hands over the last batch. A file without objects gives one that is empty.
    pub(super) fn finish(self) {
        if !self.any_handed_over || self.batch != self.description {
            // Nothing is left to stop.
            let _ = (self.sink)(self.batch);
        }
    }
}
