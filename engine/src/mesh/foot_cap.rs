//! Closing a mesh that lacks its bottom.

use std::collections::HashMap;

use glam::{DVec2, DVec3};

use super::net::Net;
use super::triangle_mesh::TriangleMesh;

impl TriangleMesh {
    /// The triangles that close the surface at its foot, where all that is missing is a bottom:
    /// each edge without an opposite lies at the height of the lowest vertex. They turn as seen
    /// from below, over the vertices that are there. `None` where that is not the case, or the
    /// edges bound no area.
    ///
    /// Coarse models of buildings often come without a bottom. Closing it there changes nothing
    /// that can be seen: a line that crosses the closed surface does so twice at least, and once at
    /// the most in the plane of the foot, so it meets a delivered face as well; unless one of its
    /// ends is inside the building, or under the ground that it stands on.
    #[must_use]
    pub fn foot_cap(&self) -> Option<Vec<[u32; 3]>> {
        let open = self.unpaired_edges();
        let foot = self.envelope()?.min.z;
        let at_foot = |&number: &u32| self.vertices[number as usize].z == foot;
        if self.untriangulable_faces > 0 || open.is_empty() || !open.iter().flatten().all(at_foot) {
            return None;
        }
        // Bounded by the opposites of the open edges.
        let rings = rings(open.iter().map(|&[from, to]| [to, from]))?;
        let corners: Vec<&DVec3> = rings
            .iter()
            .flatten()
            .map(|&i| &self.vertices[i as usize])
            .collect();
        let origin = *corners[0];
        let mut numbers = 0..corners.len();
        let local: Vec<Vec<usize>> = rings
            .iter()
            .map(|ring| numbers.by_ref().take(ring.len()).collect())
            .collect();
        // Seen from below, x and y change places.
        let flatten = |p: DVec3| DVec2::new(p.y - origin.y, p.x - origin.x);
        let triangles = Net::new(&local, &corners, flatten)
            .and_then(Net::triangles)
            .ok()?;
        let flat: Vec<u32> = rings.into_iter().flatten().collect();
        Some(triangles.iter().map(|t| t.map(|i| flat[i])).collect())
    }
}

/// Closed rings that use each edge once; `None` where the edges do not close.
fn rings(edges: impl Iterator<Item = [u32; 2]>) -> Option<Vec<Vec<u32>>> {
    let mut onward: HashMap<u32, Vec<u32>> = HashMap::new();
    let mut starts = Vec::new();
    for [from, to] in edges {
        onward.entry(from).or_default().push(to);
        starts.push(from);
    }
    let mut rings = Vec::new();
    for start in starts {
        let Some(mut next) = onward.get_mut(&start).and_then(Vec::pop) else {
            continue;
        };
        let mut ring = vec![start];
        while next != start {
            ring.push(next);
            next = onward.get_mut(&next)?.pop()?;
        }
        rings.push(ring);
    }
    Some(rings)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Box3d, Closedness, inner_envelope};

    /// A box from `min` with this size without the faces that `keeps` refuses; face 0 is the bottom,
    /// face 1 the top.
    fn open_box(min: DVec3, size: f64, keeps: impl Fn(usize) -> bool) -> Vec<Vec<Vec<DVec3>>> {
        let corners = Box3d::new(min, min + size).corners();
        let faces = [
            [0, 2, 3, 1],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 4, 6, 2],
            [1, 3, 7, 5],
        ];
        let kept = faces.iter().enumerate().filter(|(i, _)| keeps(*i));
        kept.map(|(_, face)| vec![face.map(|i: usize| corners[i]).to_vec()])
            .collect()
    }

    fn capped(faces: Vec<Vec<Vec<DVec3>>>) -> Option<TriangleMesh> {
        let mut mesh = TriangleMesh::from_polygons(faces);
        let cap = mesh.foot_cap()?;
        mesh.triangles.extend(cap);
        Some(mesh)
    }

    const FAR: DVec3 = DVec3::new(85_000.123, 447_000.456, -0.789);

    #[test]
    fn a_missing_bottom_is_closed() {
        let mesh = capped(open_box(FAR, 10.0, |face| face != 0)).unwrap();
        assert_eq!(mesh.closedness(), Closedness::Closed);
        assert!((mesh.signed_volume() - 1000.0).abs() < 1e-6);
        assert!(inner_envelope(&mesh).unwrap().grounded);
    }

    #[test]
    fn bottoms_with_holes_and_several_bottoms_are_closed() {
        // A block around a courtyard: a box, and a smaller one inside out.
        let mut faces = open_box(FAR, 30.0, |face| face > 1);
        let mut court = open_box(FAR + DVec3::new(10.0, 10.0, 0.0), 10.0, |face| face > 1);
        for face in &mut court {
            face[0].reverse();
            for corner in face[0].iter_mut().filter(|corner| corner.z > FAR.z) {
                corner.z = FAR.z + 30.0;
            }
        }
        faces.extend(court);
        let roof = |min: DVec3, size: f64| {
            let mut roof = open_box(min, size, |face| face == 1).remove(0).remove(0);
            roof.iter_mut().for_each(|corner| corner.z = FAR.z + 30.0);
            roof
        };
        let mut hole = roof(FAR + DVec3::new(10.0, 10.0, 0.0), 10.0);
        hole.reverse();
        faces.push(vec![roof(FAR, 30.0), hole]);
        faces.extend(open_box(FAR + DVec3::new(100.0, 0.0, 0.0), 10.0, |face| {
            face != 0
        }));
        let mesh = capped(faces).unwrap();
        assert_eq!(mesh.closedness(), Closedness::Closed);
        let volume = (900.0 - 100.0) * 30.0 + 1000.0;
        assert!(
            (mesh.signed_volume() - volume).abs() < 1e-4,
            "{}",
            mesh.signed_volume()
        );
    }

    #[test]
    fn other_openings_stay_open() {
        assert_eq!(capped(open_box(FAR, 10.0, |face| face != 1)), None);
        assert_eq!(capped(open_box(FAR, 10.0, |face| face > 1)), None);
        assert_eq!(capped(open_box(FAR, 10.0, |face| face != 2)), None);
        assert_eq!(capped(open_box(FAR, 10.0, |_| true)), None);
        assert_eq!(capped(Vec::new()), None);
        // One corner sunk by a nanometre.
        let mut uneven = open_box(FAR, 10.0, |face| face != 0);
        for corner in uneven.iter_mut().flatten().flatten() {
            if corner.x == FAR.x && corner.y == FAR.y && corner.z == FAR.z {
                corner.z -= 1e-9;
            }
        }
        assert_eq!(capped(uneven), None);
    }
}
