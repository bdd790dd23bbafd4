//! What all solid columns together hide from a point.

use crate::aabb::{Aabb, Point};
use crate::bvh::{Bvh, Probe};
use crate::column::Column;
use crate::determinant::subtract;
use crate::occluder::searched;
use crate::ray_caster::is_usable;

/// The solid columns of many features, searched along lines of sight.
#[derive(Clone, Debug)]
pub struct ColumnIndex {
    bvh: Bvh,
    /// In the order of the leaves, each with its feature.
    columns: Vec<(u32, Column)>,
}

impl ColumnIndex {
    /// An index over columns, each with the id of its feature.
    #[must_use]
    pub fn new(columns: &[(u32, Column)]) -> Self {
        let boxes: Vec<Aabb> = columns
            .iter()
            .map(|(_, column)| searched(&column.solid_bounds()))
            .collect();
        let bvh = Bvh::new(&boxes);
        let columns = bvh
            .items()
            .iter()
            .map(|&item| columns[item as usize].clone())
            .collect();
        Self { bvh, columns }
    }

    /// A feature other than `feature` that hides `target`, a point of it, from `eye`: the open
    /// segment between them meets the interior of one of its columns or the ground below. Columns
    /// that hold the eye inside hide nothing. `None` too if an end is not usable. Exact.
    #[must_use]
    pub fn hiding(&self, eye: Point, target: Point, feature: u32) -> Option<u32> {
        if !is_usable(eye) || !is_usable(target) {
            return None;
        }
        let probe = Probe::new(eye, subtract(target, eye));
        let mut found = None;
        self.bvh.walk(&probe, 1.0, |places| {
            let hides = |(id, column): &&(u32, Column)| {
                *id != feature
                    && column.meets_segment(eye, target)
                    && !column.interior_contains(eye)
            };
            found = self.columns[places].iter().find(hides).map(|(id, _)| *id);
            if found.is_some() { None } else { Some(1.0) }
        });
        found
    }
}
