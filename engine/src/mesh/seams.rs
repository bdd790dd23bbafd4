//! Closing the seams of a mesh: cracks along an edge on which another face has a corner.

use std::collections::HashMap;

use glam::DVec3;

use super::triangle_mesh::TriangleMesh;

/// Greatest width of a seam, metres. City models come in whole millimetres, so a corner that is meant
/// to be on an edge lies up to 0.87 of one beside it.
const WIDTH: f64 = 1e-3;

impl TriangleMesh {
    /// Adds triangles along edges that lack an opposite because the faces beside them have more corners
    /// there, and returns how many. All of a seam is within [`WIDTH`] of its longest edge.
    ///
    /// To triangulate a face with all corners that lie on its edges, its own or not, would do the same,
    /// but for the roundings of those corners.
    pub(crate) fn close_seams(&mut self) -> usize {
        let before = self.triangles.len();
        for ring in loops(&self.unpaired_edges()) {
            if self.is_seam(&ring) {
                // The opposites of its edges, all from the first corner.
                let pairs = ring[1..].windows(2);
                let fan = pairs.map(|pair| [ring[0], pair[1], pair[0]]);
                self.triangles.extend(fan);
            }
        }
        self.triangles.len() - before
    }

    /// Whether all corners of a ring are next to its longest edge.
    fn is_seam(&self, ring: &[u32]) -> bool {
        let corner = |at: usize| self.vertices[ring[at % ring.len()] as usize];
        let edges = (0..ring.len()).map(|at| (corner(at), corner(at + 1)));
        let longest = edges.max_by(|a, b| a.0.distance(a.1).total_cmp(&b.0.distance(b.1)));
        longest.is_some_and(|(from, to)| {
            (0..ring.len()).all(|at| distance(corner(at), from, to) <= WIDTH)
        })
    }
}

/// Distance of a point from a straight edge.
fn distance(point: DVec3, from: DVec3, to: DVec3) -> f64 {
    let along = to - from;
    let length_2 = along.length_squared();
    let share = if length_2 > 0.0 {
        ((point - from).dot(along) / length_2).clamp(0.0, 1.0)
    } else {
        0.0
    };
    point.distance(from + along * share)
}

/// Rings of directed edges that pass each corner once; edges that are in none are left out.
fn loops(edges: &[[u32; 2]]) -> Vec<Vec<u32>> {
    let mut onward: HashMap<u32, Vec<u32>> = HashMap::new();
    for &[from, to] in edges {
        onward.entry(from).or_default().push(to);
    }
    let mut loops = Vec::new();
    for &[start, _] in edges {
        let mut path = vec![start];
        while let Some(next) = onward.get_mut(&path[path.len() - 1]).and_then(Vec::pop) {
            match path.iter().position(|&corner| corner == next) {
                Some(at) => {
                    loops.push(path.split_off(at));
                    path.push(next);
                }
                None => path.push(next),
            }
        }
    }
    loops
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Closedness;

    const FAR: DVec3 = DVec3::new(85_000.123, 447_000.456, -0.789);

    /// A box of 4 by 3 by 5 metres, with corners on the edges of its bottom that the walls alone have,
    /// `beside` metres within the box.
    fn seamed(beside: f64) -> TriangleMesh {
        let corner = |x: f64, y: f64, z: f64| FAR + DVec3::new(x, y, z);
        let low = [(0., 0.), (4., 0.), (4., 3.), (0., 3.)].map(|(x, y)| corner(x, y, 0.0));
        let high = low.map(|corner| corner + DVec3::Z * 5.0);
        let middle = [
            corner(1.0, beside, 0.0),
            corner(2.5, beside, 0.0),
            corner(4.0 - beside, 1.0, 0.0),
        ];
        let faces = [
            vec![low[0], low[3], low[2], low[1]],
            high.to_vec(),
            vec![low[0], middle[0], middle[1], low[1], high[1], high[0]],
            vec![low[1], middle[2], low[2], high[2], high[1]],
            vec![low[2], low[3], high[3], high[2]],
            vec![low[3], low[0], high[0], high[3]],
        ];
        TriangleMesh::from_polygons(faces.map(|ring| [ring]))
    }

    #[test]
    fn seams_are_closed() {
        for beside in [0.0, 0.0005, -0.0005] {
            let mut mesh = seamed(beside);
            assert_eq!(mesh.closedness(), Closedness::Open { unpaired: 7 });
            assert_eq!(mesh.close_seams(), 3);
            assert_eq!(mesh.closedness(), Closedness::Closed);
            assert!((mesh.signed_volume() - 60.0).abs() < 0.05);
            assert_eq!(mesh.close_seams(), 0);
        }
    }

    #[test]
    fn cracks_and_missing_faces_are_not() {
        let mut cracked = seamed(0.002);
        assert_eq!(cracked.close_seams(), 0);
        let mut roofless = seamed(0.0);
        roofless.triangles.retain(|triangle| {
            let is_high = |&corner: &u32| roofless.vertices[corner as usize].z > FAR.z;
            !triangle.iter().all(is_high)
        });
        assert_eq!(roofless.close_seams(), 3);
        assert_eq!(roofless.closedness(), Closedness::Open { unpaired: 4 });
    }
}
