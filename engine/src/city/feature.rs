//! [`CityFeature`], one building of a generated city.

use crate::{Box3d, SolidColumn, TriangleMesh};

/// A building with all that is known of it by construction.
#[derive(Clone, Debug, PartialEq)]
pub struct CityFeature {
    /// What it is called: a box, a house, a building, a tower.
    pub kind: &'static str,
    /// Class of city object.
    pub class: &'static str,
    /// Outer envelope.
    pub envelope: Box3d,
    /// Closed surface, oriented outwards.
    pub mesh: TriangleMesh,
    /// The whole footprint up to the eaves, grounded.
    pub column: SolidColumn,
    /// A box inside the column: the whole of an upright box, else the largest found.
    pub inner_envelope: Box3d,
}

impl CityFeature {
    pub(super) fn new(
        kind: &'static str,
        mesh: TriangleMesh,
        column: SolidColumn,
        inner_envelope: Box3d,
    ) -> Self {
        Self {
            kind,
            class: "Building",
            envelope: mesh.envelope().unwrap_or(inner_envelope),
            mesh,
            column,
            inner_envelope,
        }
    }
}
