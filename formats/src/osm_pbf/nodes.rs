//! The nodes that a scene needs.

use crate::projection::{Bounds, Projection};

/// Places by node, in columns: of a large city there are millions.
#[derive(Debug, Default)]
pub(super) struct Nodes {
    /// Numbers, ascending.
    ids: Vec<i64>,
    /// Longitude and latitude, then metres; not a number where there is none.
    places: Vec<[f64; 2]>,
}

impl Nodes {
    /// These nodes, at no place yet.
    pub(super) fn wanted(mut ids: Vec<i64>) -> Self {
        ids.sort_unstable();
        ids.dedup();
        let places = vec![[f64::NAN; 2]; ids.len()];
        Self { ids, places }
    }

    /// Puts a node at its place, if it is wanted.
    pub(super) fn put(&mut self, id: i64, place: [f64; 2]) {
        if let Ok(index) = self.ids.binary_search(&id) {
            self.places[index] = place;
        }
    }

    /// The place of a node.
    pub(super) fn get(&self, id: i64) -> Option<[f64; 2]> {
        let place = self.places[self.ids.binary_search(&id).ok()?];
        (!place[0].is_nan()).then_some(place)
    }

    /// The middle of all places.
    pub(super) fn centre(&self) -> Option<[f64; 2]> {
        let mut bounds = Bounds::default();
        let places = self.places.iter().filter(|place| !place[0].is_nan());
        places.for_each(|place| bounds.add(*place));
        bounds.centre()
    }

    /// Brings all places into metres; those that the projection does not reach are lost.
    pub(super) fn project(&mut self, projection: &Projection) {
        for place in &mut self.places {
            *place = projection.project(*place).unwrap_or([f64::NAN; 2]);
        }
    }
}
