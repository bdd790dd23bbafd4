//! [`Facets`], the triangles of a mesh as seen from above.

use glam::{DVec2, DVec3};
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

use crate::TriangleMesh;
use crate::predicates::turn;

/// A facet narrower than this in plan is a wall that rounding made lean: its slope is not cut at
/// levels, metres.
const NARROW: f64 = 0.02;

/// A triangle of the mesh.
pub struct Facet {
    pub corners: [DVec3; 3],
    /// Numbers of the corners in the mesh.
    pub vertices: [u32; 3],
    /// 1 where it faces up, -1 where it faces down, 0 where it is exactly vertical.
    pub faces: i32,
    /// Area in plan.
    pub area: f64,
    /// Whether it is wide enough in plan to bound a column from above or below.
    pub is_broad: bool,
}

impl Facet {
    fn new(vertices: [u32; 3], corners: [DVec3; 3]) -> Self {
        let [a, b, c] = corners.map(DVec3::truncate);
        let turn = turn(a, b, c);
        let longest = [b - a, c - b, a - c]
            .map(DVec2::length)
            .into_iter()
            .fold(0.0, f64::max);
        Self {
            corners,
            vertices,
            faces: i32::from(turn > 0.0) - i32::from(turn < 0.0),
            area: turn.abs() / 2.0,
            is_broad: turn.abs() > NARROW * longest,
        }
    }

    /// Lowest and greatest height.
    pub fn heights(&self) -> [f64; 2] {
        let [a, b, c] = self.corners.map(|corner| corner.z);
        [a.min(b).min(c), a.max(b).max(c)]
    }

    pub fn is_level(&self) -> bool {
        let [low, high] = self.heights();
        low == high
    }

    /// Whether a place is in the facet's projection. A place exactly on an edge counts as if moved
    /// by an infinitesimal step that is the same for all facets, so that of two facets that share
    /// an edge it is in one or, where they fold, in both or neither.
    pub fn covers(&self, place: DVec2) -> bool {
        let corners = self.corners.map(DVec3::truncate);
        let is_left = |from: DVec2, to: DVec2| {
            let side = turn(from, to, place);
            let run = to - from;
            side > 0.0 || side == 0.0 && (run.y < 0.0 || run.y == 0.0 && run.x > 0.0)
        };
        let lefts = [0, 1, 2].map(|i| is_left(corners[i], corners[(i + 1) % 3]));
        match self.faces {
            0 => false,
            1 => lefts == [true; 3],
            _ => lefts == [false; 3],
        }
    }

    /// The height of the facet's plane at a place of its projection; means nothing for a vertical
    /// facet. Exact at the corners.
    pub fn height(&self, place: DVec2) -> f64 {
        let [a, b, c] = self.corners;
        if let Some(corner) = self
            .corners
            .iter()
            .find(|corner| corner.truncate() == place)
        {
            return corner.z;
        }
        let normal = (b - a).cross(c - a);
        let [low, high] = self.heights();
        let height = a.z - normal.truncate().dot(place - a.truncate()) / normal.z;
        if height.is_nan() {
            return low;
        }
        height.clamp(low, high)
    }
}

/// All triangles of a mesh, found by place.
pub struct Facets {
    pub list: Vec<Facet>,
    tree: RTree<GeomWithData<Rectangle<[f64; 2]>, usize>>,
}

impl Facets {
    pub fn new(mesh: &TriangleMesh) -> Self {
        let list: Vec<Facet> = mesh
            .triangles
            .iter()
            .filter_map(|&vertices| {
                let corner = |number: u32| mesh.vertices.get(number as usize).copied();
                let [a, b, c] = vertices.map(corner);
                Some(Facet::new(vertices, [a?, b?, c?]))
            })
            .collect();
        let boxed = |(number, facet): (usize, &Facet)| {
            let [low, high] = bounds(&facet.corners.map(DVec3::truncate));
            GeomWithData::new(Rectangle::from_corners(low, high), number)
        };
        let tree = RTree::bulk_load(list.iter().enumerate().map(boxed).collect());
        Self { list, tree }
    }

    /// The facets whose box in plan meets the box of the places.
    pub fn near(&self, places: &[DVec2]) -> impl Iterator<Item = &Facet> + use<'_> {
        let [low, high] = bounds(places);
        let hits = self
            .tree
            .locate_in_envelope_intersecting(AABB::from_corners(low, high));
        hits.filter_map(|hit| self.list.get(hit.data))
    }
}

fn bounds(places: &[DVec2]) -> [[f64; 2]; 2] {
    let low = places.iter().copied().fold(DVec2::INFINITY, DVec2::min);
    let high = places.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max);
    [low.to_array(), high.to_array()]
}
