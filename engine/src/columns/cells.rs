//! [`Cells`], an outline as triangles.

use std::collections::HashMap;

use glam::DVec3;

use super::certificate::Certificate;
use super::outline::{Corner, Outline};
use crate::mesh::Net;
use crate::predicates::turn;

/// Triangles that turn anticlockwise, exactly, and cover an outline once.
pub struct Cells {
    corners: Vec<Corner>,
    triangles: Vec<[usize; 3]>,
}

impl Cells {
    /// Triangles that do not cross the seams; `None` where rings or seams cross.
    pub fn new(outline: &Outline, seams: &[[Corner; 2]]) -> Option<Self> {
        // A seam is a ring there and back.
        let seams = seams.iter().map(|seam| seam.to_vec());
        let rings = outline.rings.iter().cloned().chain(seams);
        let mut corners: Vec<Corner> = Vec::new();
        let numbers = rings.map(|ring| {
            let first = corners.len();
            corners.extend(ring);
            (first..corners.len()).collect()
        });
        let numbers: Vec<Vec<usize>> = numbers.collect();
        let places: Vec<DVec3> = corners.iter().map(|c| c.place.extend(0.0)).collect();
        // At the places themselves: near some other origin a corner could change sides.
        let net = Net::new(
            &numbers,
            &places.iter().collect::<Vec<_>>(),
            DVec3::truncate,
        );
        let mut triangles = net.and_then(Net::triangles).ok()?;
        let turn = |t: &[usize; 3]| {
            let [a, b, c] = t.map(|i| corners[i].place);
            turn(a, b, c)
        };
        // They have the rings for boundary, so with none turned over they cover once.
        if triangles.iter().any(|t| turn(t) < 0.0) {
            return None;
        }
        triangles.retain(|t| turn(t) > 0.0);
        Some(Self { corners, triangles })
    }

    /// Leaves the cells that are proven between the heights; returns whether all are.
    pub fn prove(&mut self, [bottom, top]: [f64; 2], certificate: &mut Certificate) -> bool {
        let count = self.triangles.len();
        let place = |i: usize| self.corners[i].place;
        self.triangles
            .retain(|t| certificate.proves(t.map(place), bottom, top));
        self.triangles.len() == count
    }

    /// The outlines of cells that hang together by edges.
    pub fn outlines(&self) -> Vec<Outline> {
        let edges = |[a, b, c]: [usize; 3]| [[a, b], [b, c], [c, a]];
        let mut cell_at = HashMap::new();
        for (cell, &triangle) in self.triangles.iter().enumerate() {
            cell_at.extend(edges(triangle).map(|edge| (edge, cell)));
        }
        let mut is_taken = vec![false; self.triangles.len()];
        let mut outlines = Vec::new();
        for first in 0..self.triangles.len() {
            let mut piece = Vec::new();
            let mut left = vec![first];
            while let Some(cell) = left.pop() {
                if std::mem::replace(&mut is_taken[cell], true) {
                    continue;
                }
                piece.push(self.triangles[cell]);
                let beside = edges(self.triangles[cell]).map(|[a, b]| cell_at.get(&[b, a]));
                left.extend(beside.into_iter().flatten());
            }
            outlines.extend(Outline::around(piece, |i| self.corners[i]));
        }
        outlines
    }
}
