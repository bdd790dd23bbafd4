//! [`SurfaceTile`], the surfaces of the features of a neighbourhood, and what a sight line meets of them.

use std::collections::HashMap;
use std::ops::{ControlFlow, Range};

use glam::DVec3;

use crate::Box3d;
use crate::point_visibility::Tree;
use crate::predicates::side;

/// Metres by which boxes are larger than what they hold, so that no rounding loses a triangle in them.
const BOX_MARGIN: f64 = 1e-6;

/// In place of a component of a direction that is zero: its reciprocal is finite, and no distance in a
/// city times it is not.
const LEAST_COMPONENT: f64 = 1e-200;

/// The real surface of a feature.
#[derive(Clone, Debug, Default)]
pub struct Surface {
    /// Number of the feature.
    pub id: i64,
    /// Its triangles, metres.
    pub triangles: Vec<[DVec3; 3]>,
}

/// The surfaces of some features, in a tree. It may be shared by threads.
#[derive(Clone, Debug, Default)]
pub struct SurfaceTile {
    tree: Tree,
    /// Of each leaf, which triangle it is.
    leaves: Vec<u32>,
    /// Feature by feature.
    triangles: Vec<[DVec3; 3]>,
    /// Of each triangle.
    owners: Vec<i64>,
    features: HashMap<i64, Range<usize>>,
}

/// How a sight line meets a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Contact {
    /// Its ends are on different sides, and it passes through the inside.
    Crossing,
    /// It meets an edge or a corner, begins or ends there, or lies in the plane of the triangle, near it.
    Touch,
}

/// An open line from an eye to some place.
#[derive(Clone, Copy, Debug)]
pub struct Line {
    pub eye: DVec3,
    pub end: DVec3,
    reciprocal: DVec3,
}

impl SurfaceTile {
    /// The tile of some surfaces; no two of one feature.
    #[must_use]
    pub fn new(surfaces: impl IntoIterator<Item = Surface>) -> Self {
        let mut tile = Self::default();
        for surface in surfaces {
            let first = tile.triangles.len();
            tile.triangles.extend(surface.triangles);
            tile.owners.resize(tile.triangles.len(), surface.id);
            tile.features
                .insert(surface.id, first..tile.triangles.len());
        }
        let boxes: Vec<Box3d> = tile.triangles.iter().map(around).collect();
        let (tree, order) = Tree::new(&boxes);
        let number = |at| u32::try_from(at).expect("a tile holds fewer than 4 billion triangles");
        tile.leaves = order.into_iter().map(number).collect();
        tile.tree = tree;
        tile
    }

    /// The smallest box that holds all of it; `None` when it is empty.
    #[must_use]
    pub fn bounds(&self) -> Option<Box3d> {
        self.tree.bounds()
    }

    /// How many triangles it has, some 120 bytes each.
    #[must_use]
    pub fn len(&self) -> usize {
        self.triangles.len()
    }

    /// Whether it has none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }

    /// The features in it.
    pub(super) fn features(&self) -> impl Iterator<Item = i64> {
        self.features.keys().copied()
    }

    /// The triangles of a feature.
    pub(super) fn of(&self, feature: i64) -> &[[DVec3; 3]] {
        self.features
            .get(&feature)
            .map_or(&[], |range| &self.triangles[range.clone()])
    }

    /// Gives `met` the triangles of other features that a line meets, until it breaks.
    pub(super) fn obstacles<'a>(
        &'a self,
        line: &Line,
        feature: i64,
        mut met: impl FnMut(&'a [DVec3; 3]) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let nodes = &self.tree.nodes;
        let mut open = [0_u32; STACK];
        let mut left = usize::from(!nodes.is_empty());
        while left > 0 {
            left -= 1;
            let node = &nodes[open[left] as usize];
            if !line.may_meet(&node.bounds) {
                continue;
            }
            for child in node.children() {
                if !node.is_leaf {
                    open[left] = child;
                    left += 1;
                    continue;
                }
                let at = self.leaves[child as usize] as usize;
                let triangle = &self.triangles[at];
                let meets = self.owners[at] != feature
                    && line.may_meet(&around(triangle))
                    && line.contact(triangle).is_some();
                if meets {
                    met(triangle)?;
                }
            }
        }
        ControlFlow::Continue(())
    }
}

/// Nodes that wait: three a level, and no tree of 4 billion leaves has more levels.
const STACK: usize = 64;

impl Line {
    pub fn new(eye: DVec3, end: DVec3) -> Self {
        let usable = |component: f64| match component.abs() < LEAST_COMPONENT {
            true => LEAST_COMPONENT,
            false => component,
        };
        let way = (end - eye).to_array().map(usable);
        Self {
            eye,
            end,
            reciprocal: DVec3::from(way).recip(),
        }
    }

    /// Whether it comes near a box.
    pub fn may_meet(&self, bounds: &Box3d) -> bool {
        let first = (bounds.min - BOX_MARGIN - self.eye) * self.reciprocal;
        let second = (bounds.max + BOX_MARGIN - self.eye) * self.reciprocal;
        let enters = first.min(second).max_element().max(0.0);
        let leaves = first.max(second).min_element().min(1.0);
        enters <= leaves
    }

    /// How it meets a triangle. By exact signs; if it lies in the plane it is taken to meet.
    pub fn contact(&self, triangle: &[DVec3; 3]) -> Option<Contact> {
        let ends = [self.eye, self.end].map(|end| side(triangle, end));
        if ends.iter().all(|&side| side > 0.0) || ends.iter().all(|&side| side < 0.0) {
            return None;
        }
        let [a, b, c] = *triangle;
        let turns = [(a, b), (b, c), (c, a)].map(|(u, v)| side(&[self.eye, self.end, u], v));
        let is_left = turns.iter().any(|&turn| turn > 0.0);
        let is_right = turns.iter().any(|&turn| turn < 0.0);
        if is_left && is_right {
            return None;
        }
        let is_inside = !ends.contains(&0.0) && !turns.contains(&0.0);
        Some(match is_inside {
            true => Contact::Crossing,
            false => Contact::Touch,
        })
    }
}

fn around([a, b, c]: &[DVec3; 3]) -> Box3d {
    Box3d {
        min: a.min(*b).min(*c),
        max: a.max(*b).max(*c),
    }
}
