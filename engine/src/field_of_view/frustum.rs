//! [`Frustum`], the pyramid, cut off in front, that a [`Camera`] sees.

use super::{Camera, PlanWedge, RELATIVE_TOLERANCE, near_part};
use crate::Box3d;
use glam::DVec3;

/// The part of a ray's length below which its component along an axis is rounding: that ray and
/// the axis are at right angles.
const ROUNDING: f64 = 1e-14;

/// How many axes can separate a frustum from a box: the normals of 5 and of 3 kinds of faces, and those
/// to each of 6 kinds of edges with each of 3.
const AXES: usize = 5 + 3 + 6 * 3;

/// What a camera sees: the closed hexahedron between its near and far plane, ready for tests of
/// many boxes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frustum {
    eye: DVec3,
    plan_wedge: Option<PlanWedge>,
    /// Distance of the farthest corner from the eye.
    reach: f64,
    /// Slack by metre of a box's distance: wide images have rays whose rounding counts for more.
    tolerance: f64,
    /// The frustum along every axis that can separate it from a box.
    slabs: [Slab; AXES],
}

impl Frustum {
    /// The frustum of a camera. `None` when its direction or up vector is zero, or both are
    /// parallel.
    #[must_use]
    pub fn new(camera: &Camera) -> Option<Self> {
        let axes = camera.axes()?;
        let rays = camera.rays()?;
        let longest = rays.map(DVec3::length).into_iter().fold(1.0, f64::max);
        Some(Self {
            eye: camera.eye,
            plan_wedge: PlanWedge::holding(&rays.map(DVec3::truncate)),
            reach: camera.far * longest,
            tolerance: RELATIVE_TOLERANCE * longest,
            slabs: separating_axes(axes, &rays)
                .map(|axis| Slab::around(axis, &rays, camera.near, camera.far)),
        })
    }

    /// The directions in plan that it holds; `None` if these are all, or may be.
    #[must_use]
    pub fn plan_wedge(&self) -> Option<PlanWedge> {
        self.plan_wedge
    }

    /// Distance of the farthest corner from the eye, metres.
    #[must_use]
    pub fn reach(&self) -> f64 {
        self.reach
    }

    /// Whether frustum and box share a point.
    ///
    /// Two convex polyhedra are apart just when they are along some axis that is normal to a face of
    /// one or to an edge of each.
    #[must_use]
    pub fn meets(&self, target: &Box3d) -> bool {
        let Some(local) = near_part(self.eye, self.reach, target) else {
            return false;
        };
        let distance = local.min.abs().max(local.max.abs()).element_sum();
        let slack = self.tolerance * distance;
        !self.slabs.iter().any(|slab| slab.misses(&local, slack))
    }
}

/// The unit vectors that can separate a frustum from a box, those that mostly do first. Where an edge
/// is along an axis, there is a zero instead, which separates nothing.
fn separating_axes([right, up, forward]: [DVec3; 3], rays: &[DVec3; 4]) -> [DVec3; AXES] {
    let [a, b, c, d] = *rays;
    let sides = [a.cross(b), b.cross(c), c.cross(d), d.cross(a)];
    let edges = [right, up, a, b, c, d].map(DVec3::normalize_or_zero);
    let across = edges
        .into_iter()
        .flat_map(|edge| DVec3::AXES.map(|axis| edge.cross(axis)));
    let found = std::iter::once(forward)
        .chain(sides)
        .chain(DVec3::AXES)
        .chain(across);
    let mut axes = [DVec3::ZERO; AXES];
    for (axis, found) in axes.iter_mut().zip(found) {
        *axis = found.normalize_or_zero();
    }
    axes
}

/// The interval that a frustum takes along an axis through the eye.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Slab {
    axis: DVec3,
    low: f64,
    high: f64,
}

impl Slab {
    /// The interval of the points of the cone of `rays` whose depth is between near and far.
    fn around(axis: DVec3, rays: &[DVec3; 4], near: f64, far: f64) -> Self {
        let along = rays.map(|ray| {
            let along = axis.dot(ray);
            if along.abs() <= ROUNDING * ray.length() {
                0.0
            } else {
                along
            }
        });
        let least = along.into_iter().fold(f64::INFINITY, f64::min);
        let most = along.into_iter().fold(f64::NEG_INFINITY, f64::max);
        Self {
            axis,
            low: (near * least).min(far * least),
            high: (near * most).max(far * most),
        }
    }

    /// Whether the box, relative to the eye, is outside by more than the slack. Numbers that
    /// overflow say no.
    fn misses(&self, local: &Box3d, slack: f64) -> bool {
        let (a, b) = (self.axis * local.min, self.axis * local.max);
        a.min(b).element_sum() > self.high + slack || a.max(b).element_sum() < self.low - slack
    }
}
