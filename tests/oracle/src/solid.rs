//! A closed mesh, prepared for many points.

use crate::aabb::Aabb;
use crate::bvh::{Bvh, Probe};
use crate::mesh::{Mesh, Triangle};
use crate::ray_caster::is_usable;
use crate::test_point::TestPoint;
use crate::winding::winding_number;

/// The triangles of a closed mesh, searched along vertical lines.
pub(crate) struct Solid {
    bvh: Bvh,
    /// In the order of the leaves.
    triangles: Vec<Triangle>,
}

impl Solid {
    /// The solid that a mesh bounds; `None` if it is not closed or a coordinate is beyond
    /// [`MAX_COORDINATE`](crate::MAX_COORDINATE).
    pub(crate) fn new(mesh: &Mesh) -> Option<Self> {
        let triangles = mesh.corners().filter(|_| mesh.is_closed())?;
        if !triangles
            .as_flattened()
            .iter()
            .all(|corner| is_usable(*corner))
        {
            return None;
        }
        let boxes: Vec<Aabb> = triangles
            .iter()
            .map(|corners| Aabb::around(corners))
            .collect();
        let bvh = Bvh::new(&boxes);
        let ordered = bvh.items().iter().map(|&item| triangles[item as usize]);
        Some(Self {
            triangles: ordered.collect(),
            bvh,
        })
    }

    /// The box around it.
    pub(crate) fn bounds(&self) -> Aabb {
        Mesh::bounds(&self.triangles)
    }

    /// How often the surface winds around a point, `None` if the point lies on it. Exact.
    pub(crate) fn winding(&self, point: &impl TestPoint) -> Option<i32> {
        // The nearest f64 point is in every box that holds the point itself.
        let upward = Probe::new(point.nearest(), [0.0, 0.0, 1.0]);
        let mut winding = Some(0);
        self.bvh.walk(&upward, f64::INFINITY, |places| {
            let more = winding_number(&self.triangles[places], point);
            winding = winding.zip(more).map(|(sum, more)| sum + more);
            winding.map(|_| f64::INFINITY)
        });
        winding
    }
}
