//! [`Faces`], where the polygons of a geometry node go.

use super::frame::to_scene;
use crate::error::Problem;
use crate::limits::Budget;
use crate::placement::Placement;
use crate::shape_builder::ShapeBuilder;

/// How far from a common plane, in metres, the corners of a quadrangle may be: well below what
/// surveys give, well above what rounding does to coordinates of 10^6 m.
const FLATNESS: f64 = 1e-6;

/// Takes polygons in the frame of a node, and adds them to a shape, placed.
pub(super) struct Faces<'b> {
    /// The shape.
    pub(super) builder: &'b mut ShapeBuilder,
    /// What counts vertices and surfaces.
    pub(super) budget: &'b mut Budget,
    /// From the node to the shape, both in the frame of files.
    pub(super) placement: Placement,
    /// Whether polygons are given clockwise as seen from outside.
    pub(super) clockwise: bool,
    /// Material of the shape.
    pub(super) material: Option<u32>,
}

impl Faces<'_> {
    /// Adds a polygon.
    pub(super) fn add(&mut self, mut ring: Vec<[f64; 3]>) -> Result<(), Problem> {
        self.budget.vertices(ring.len())?;
        for position in &mut ring {
            *position = to_scene(self.placement.apply(*position));
        }
        if self.clockwise != self.placement.mirrors() {
            ring.reverse();
        }
        self.builder.add(ring, self.material, self.budget)
    }

    /// Adds a quadrangle, as two triangles where it is not flat.
    pub(super) fn add_quadrangle(&mut self, corners: [[f64; 3]; 4]) -> Result<(), Problem> {
        if is_flat(corners) {
            return self.add(corners.to_vec());
        }
        let [a, b, c, d] = corners;
        self.add(vec![a, b, c])?;
        self.add(vec![a, c, d])
    }
}

/// Whether the fourth corner is in the plane of the others.
fn is_flat([a, b, c, d]: [[f64; 3]; 4]) -> bool {
    let normal = cross(minus(b, a), minus(c, a));
    let length = dot(normal, normal).sqrt();
    dot(normal, minus(d, a)).abs() <= FLATNESS * length
}

pub(super) fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| a[i] - b[i])
}

pub(super) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}
