//! Where the integers of the file are counted from, and lists of vertices.

use std::collections::HashMap;
use std::hash::Hash;

use super::stored::Transform;
use crate::placement::Placement;
use crate::scene::Model;

/// The step of stored positions, metres. It keeps positions well within 0.05 mm.
const SCALE: f64 = 1e-5;

/// The transform of a file.
#[derive(Debug)]
pub(super) struct Frame {
    translate: [f64; 3],
}

impl Frame {
    /// Counts from whole metres below all positions, so that numbers are short.
    pub(super) fn around(models: &[Model]) -> Self {
        let mut low = [f64::INFINITY; 3];
        let mut reach = |position: [f64; 3]| {
            for (low, coordinate) in low.iter_mut().zip(position) {
                *low = low.min(coordinate);
            }
        };
        for geometry in models.iter().flat_map(|model| &model.feature.geometries) {
            match &geometry.placement {
                Some(placement) => reach(anchor(placement)),
                None => {
                    let rings = geometry
                        .shape
                        .surfaces
                        .iter()
                        .flat_map(|surface| &surface.rings);
                    rings.flatten().for_each(|position| reach(*position));
                }
            }
        }
        Self {
            translate: low.map(|low| if low.is_finite() { low.floor() } else { 0.0 }),
        }
    }

    /// The transform as it is written.
    pub(super) fn transform(&self) -> Transform {
        Transform {
            scale: [SCALE; 3],
            translate: self.translate,
        }
    }

    /// A position as it is stored.
    pub(super) fn stored(&self, position: [f64; 3]) -> [i64; 3] {
        [0, 1, 2].map(|i| ((position[i] - self.translate[i]) / SCALE).round() as i64)
    }

    /// The position that a reader gets.
    pub(super) fn position(&self, stored: [i64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|i| stored[i] as f64 * SCALE + self.translate[i])
    }
}

/// Where a placement takes the origin.
pub(super) fn anchor(placement: &Placement) -> [f64; 3] {
    placement.rows.map(|[_, _, _, by]| by)
}

/// Vertices, each once.
#[derive(Debug)]
pub(super) struct VertexList<K, V> {
    list: Vec<V>,
    index_of: HashMap<K, usize>,
}

impl<K: Eq + Hash, V> VertexList<K, V> {
    /// No vertices yet.
    pub(super) fn new() -> Self {
        Self {
            list: Vec::new(),
            index_of: HashMap::new(),
        }
    }

    /// The index of a vertex, added if its key is new.
    pub(super) fn index(&mut self, key: K, vertex: V) -> usize {
        let next = self.list.len();
        let index = *self.index_of.entry(key).or_insert(next);
        if index == next {
            self.list.push(vertex);
        }
        index
    }

    /// The vertices.
    pub(super) fn into_list(self) -> Vec<V> {
        self.list
    }
}
