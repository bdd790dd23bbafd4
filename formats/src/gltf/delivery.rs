//! Where the positions of a delivered feature are, after their rounding to single precision.
//!
//! glTF stores positions as f32, whose spacing is 3 cm at 447,000 m. So every mesh has an origin of
//! its own, the middle of its box in whole metres, and its node's translation, which JSON keeps as
//! f64, brings it back. Positions that are those of the scene are first rounded to a grid that f32
//! holds exactly up to 256 m from the origin: a vertex that two meshes share stays the same vertex,
//! whatever their origins are. All of it depends on one geometry alone, not on what else is
//! written.

use std::borrow::Cow;

use crate::placement::Placement;
use crate::scene::{Geometry, Surface};

/// Grid of positions, metres: rounding to it moves them by less than 0.01 mm. Within 2048 m of the
/// origin f32 adds at most 0.06 mm, so that features up to 4 km wide are within 0.1 mm.
const POSITION_GRID: f64 = 1.0 / 65_536.0;

/// Grid of the translations of instances, metres. Sums of them and of whole metres are exact in f64
/// below 2^32 m, so that it does not matter over how many nodes a translation is spread.
const TRANSLATION_GRID: f64 = 1.0 / 1_048_576.0;

/// Largest cosine between the axes of an instance that a node of glTF can have: it may turn and
/// scale, not shear. The validator takes a matrix that is off by 5e-5.
const MAX_COSINE: f64 = 1e-7;

/// Positions at which the geometries of a feature are delivered by
/// [`write_glb`](crate::write_glb), to the bit: those of all vertices, whatever their level of
/// detail. The outer envelope has to hold them.
pub fn delivered_positions(geometries: &[Geometry]) -> impl Iterator<Item = [f64; 3]> {
    geometries.iter().flat_map(|geometry| {
        let delivery = Delivery::of(geometry);
        let positions = delivery.surfaces.iter().flat_map(|s| &s.rings).flatten();
        let delivered = |p: &[f64; 3]| {
            let relative = delivery.relative(*p).map(f64::from);
            delivery.placement.apply(relative)
        };
        positions.map(delivered).collect::<Vec<_>>()
    })
}

/// A geometry as it is written: a mesh around an origin, and where that goes.
pub(super) struct Delivery<'a> {
    /// The surfaces of the mesh; borrowed where they are those of the shape.
    pub(super) surfaces: Cow<'a, [Surface]>,
    /// Where the mesh goes in the scene.
    pub(super) placement: Placement,
    /// What positions of the mesh are relative to, in the frame of its surfaces.
    origin: [f64; 3],
    /// Whether positions are those of the scene, so that they go onto the grid.
    on_grid: bool,
}

impl<'a> Delivery<'a> {
    pub(super) fn of(geometry: &'a Geometry) -> Self {
        match &geometry.placement {
            Some(placement) if only_turns_and_scales(placement) => {
                let surfaces = Cow::Borrowed(&*geometry.shape.surfaces);
                let origin = origin(&surfaces);
                let goes_to = placement.apply(origin).map(|c| round(c, TRANSLATION_GRID));
                let mut placement = *placement;
                for (row, coordinate) in placement.rows.iter_mut().zip(goes_to) {
                    row[3] = coordinate;
                }
                Self {
                    surfaces,
                    placement,
                    origin,
                    on_grid: false,
                }
            }
            _ => {
                let surfaces = geometry.surfaces();
                let origin = origin(&surfaces);
                Self {
                    surfaces,
                    placement: Placement::moved_by(origin),
                    origin,
                    on_grid: true,
                }
            }
        }
    }

    /// A position of the surfaces as it is in the mesh, z up.
    pub(super) fn relative(&self, position: [f64; 3]) -> [f32; 3] {
        std::array::from_fn(|i| {
            let coordinate = if self.on_grid {
                round(position[i], POSITION_GRID)
            } else {
                position[i]
            };
            // Never a negative zero: positions are compared by their bits.
            (coordinate - self.origin[i]) as f32 + 0.0
        })
    }

    /// Where the mesh's own origin goes.
    pub(super) fn goes_to(&self) -> [f64; 3] {
        self.placement.rows.map(|row| row[3])
    }

    /// Whether all of it can be written.
    pub(super) fn is_finite(&self) -> bool {
        let mut positions = self.surfaces.iter().flat_map(|s| &s.rings).flatten();
        self.placement
            .rows
            .as_flattened()
            .iter()
            .all(|x| x.is_finite())
            && positions.all(|p| self.relative(*p).iter().all(|x| x.is_finite()))
    }

    /// What two geometries of one shape have to agree on to share a mesh; `None` where the mesh is
    /// not the shape's.
    pub(super) fn mesh_kind(&self) -> Option<bool> {
        matches!(self.surfaces, Cow::Borrowed(_)).then_some(self.on_grid)
    }
}

fn round(coordinate: f64, grid: f64) -> f64 {
    (coordinate / grid).round() * grid
}

/// The middle of the box of all positions, in whole metres.
fn origin(surfaces: &[Surface]) -> [f64; 3] {
    let positions = || surfaces.iter().flat_map(|s| &s.rings).flatten();
    middle(positions().copied())
}

/// The middle of the box of positions, in whole metres; the origin where there is none.
pub(super) fn middle(positions: impl Iterator<Item = [f64; 3]>) -> [f64; 3] {
    let mut bounds = [[f64::INFINITY, f64::NEG_INFINITY]; 3];
    for position in positions {
        for ([low, high], coordinate) in bounds.iter_mut().zip(position) {
            (*low, *high) = (low.min(coordinate), high.max(coordinate));
        }
    }
    bounds.map(|[low, high]| {
        let middle = (low + (high - low) / 2.0).round() + 0.0;
        if middle.is_finite() { middle } else { 0.0 }
    })
}

/// Whether a node of glTF can have this transformation: the three axes stay at right angles and
/// none of them vanishes.
fn only_turns_and_scales(placement: &Placement) -> bool {
    let column = |j: usize| placement.rows.map(|row| row[j]);
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let [x, y, z] = [column(0), column(1), column(2)];
    let right_angle = |a, b| dot(a, b).abs() <= MAX_COSINE * (dot(a, a) * dot(b, b)).sqrt();
    let long = |a| dot(a, a).is_normal();
    long(x) && long(y) && long(z) && right_angle(x, y) && right_angle(y, z) && right_angle(z, x)
}
