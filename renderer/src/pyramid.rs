//! Which triangles each face of the cube sees, in the face's own frame.
//!
//! A face looks through the pyramid `|u| <= w, |v| <= w` (u right, v up, w forward). Triangles
//! outside it are left out by exact comparisons; triangles that reach far out of it, behind the
//! eye above all, are clipped here in f64. The hardware is then never asked to clip a triangle
//! that spans the eye's plane, where f32 depth would lose its digits.

use crate::cube_map::Face;
use crate::scene_mesh::SceneMesh;
use bytemuck::{Pod, Zeroable};

/// A corner of a triangle for the item buffer's shader.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub(crate) struct ItemVertex {
    /// Right, up, forward, in metres from the eye.
    pub local: [f32; 3],
    /// Id of the triangle.
    pub id: u32,
}

/// Triangles are clipped to a pyramid this much wider than the face's: pixels at the face's border
/// must not see the clip's rounding, and most triangles that cross the border stay whole.
const CLIP_WIDTH: f64 = 2.0;

/// The triangles that meet a face's pyramid, for one eye at a time. Reused between eyes.
#[derive(Default)]
pub(crate) struct Pyramids {
    relative: Vec<[f32; 3]>,
    outside: Vec<u16>,
    faces: [Vec<u32>; 6],
    vertices: Vec<ItemVertex>,
}

/// Bits of the outcode that speak of each face, four of twelve: every plane bounds two faces.
const SIDES: [u16; 6] = [
    0b0000_0011_0011, // East
    0b0000_1100_1100, // West
    0b0011_0000_1010, // North
    0b1100_0000_0101, // South
    0b1010_1010_0000, // Up
    0b0101_0101_0000, // Down
];

/// The planes that a point lies strictly beyond, bit i for the i-th, and so outside of which faces.
fn outcode([x, y, z]: [f32; 3]) -> u16 {
    let beyond = [
        y > x,   // East, South
        -y > x,  // East, North
        y > -x,  // West, South
        -y > -x, // West, North
        z > x,   // East, Down
        -z > x,  // East, Up
        z > -x,  // West, Down
        -z > -x, // West, Up
        z > y,   // North, Down
        -z > y,  // North, Up
        z > -y,  // South, Down
        -z > -y, // South, Up
    ];
    beyond
        .iter()
        .enumerate()
        .fold(0, |code, (i, &out)| code | (u16::from(out) << i))
}

impl Pyramids {
    /// Sorts the triangles of `scene` to the faces that may see them from `eye`.
    pub(crate) fn look_from(&mut self, scene: &SceneMesh, eye: [f64; 3]) {
        self.relative.clear();
        self.relative.extend(
            scene
                .positions
                .iter()
                .map(|&p| relative(p, eye).map(|c| c as f32)),
        );
        self.outside.clear();
        self.outside
            .extend(self.relative.iter().map(|&p| outcode(p)));
        self.faces.iter_mut().for_each(Vec::clear);
        for (index, corners) in scene.triangles.iter().enumerate() {
            let [a, b, c] = corners.map(|corner| self.outside[corner as usize]);
            let all_beyond = a & b & c;
            for (face, sides) in self.faces.iter_mut().zip(SIDES) {
                if all_beyond & sides == 0 {
                    face.push(index as u32);
                }
            }
        }
    }

    /// The corners to draw for one face, three a triangle.
    pub(crate) fn vertices(
        &mut self,
        scene: &SceneMesh,
        eye: [f64; 3],
        face: Face,
    ) -> &[ItemVertex] {
        self.vertices.clear();
        for &index in &self.faces[face as usize] {
            let corners = scene.triangles[index as usize];
            let id = scene.ids[index as usize];
            let local = corners.map(|corner| face.local(self.relative[corner as usize]));
            if local.iter().all(|&p| is_in_clip_pyramid(p)) {
                self.vertices
                    .extend(local.map(|local| ItemVertex { local, id }));
                continue;
            }
            let exact =
                corners.map(|corner| face.local(relative(scene.positions[corner as usize], eye)));
            push_fan(&mut self.vertices, &clip(exact), id);
        }
        &self.vertices
    }
}

/// Eye-relative coordinates, subtracted in f64 so that large map coordinates cost nothing.
fn relative(point: [f64; 3], eye: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|axis| point[axis] - eye[axis])
}

fn is_in_clip_pyramid([u, v, w]: [f32; 3]) -> bool {
    u.abs().max(v.abs()) <= CLIP_WIDTH as f32 * w
}

/// Cuts a triangle to the clip pyramid (Sutherland and Hodgman, "Reentrant polygon clipping",
/// CACM 1974), in f64.
///
/// Triangles that share an edge get the same new corners on it, so no crack opens: each cut runs
/// from the inner to the outer end whatever the winding, in a fixed order of planes.
fn clip(triangle: [[f64; 3]; 3]) -> Vec<[f64; 3]> {
    let inside: [fn([f64; 3]) -> f64; 4] = [
        |[u, _, w]| CLIP_WIDTH * w - u,
        |[u, _, w]| CLIP_WIDTH * w + u,
        |[_, v, w]| CLIP_WIDTH * w - v,
        |[_, v, w]| CLIP_WIDTH * w + v,
    ];
    let mut polygon = triangle.to_vec();
    for depth in inside {
        let mut kept = Vec::with_capacity(polygon.len() + 1);
        for (i, &from) in polygon.iter().enumerate() {
            let to = polygon[(i + 1) % polygon.len()];
            let (d_from, d_to) = (depth(from), depth(to));
            if d_from >= 0.0 {
                kept.push(from);
            }
            if d_from > 0.0 && d_to < 0.0 {
                kept.push(between(from, to, d_from / (d_from - d_to)));
            } else if d_from < 0.0 && d_to > 0.0 {
                kept.push(between(to, from, d_to / (d_to - d_from)));
            }
        }
        polygon = kept;
    }
    polygon
}

fn between(from: [f64; 3], to: [f64; 3], t: f64) -> [f64; 3] {
    std::array::from_fn(|axis| from[axis] + t * (to[axis] - from[axis]))
}

/// Splits a convex polygon into triangles around its first corner.
fn push_fan(vertices: &mut Vec<ItemVertex>, polygon: &[[f64; 3]], id: u32) {
    let corner = |i: usize| ItemVertex {
        local: polygon[i].map(|c| c as f32),
        id,
    };
    for i in 2..polygon.len() {
        vertices.extend([corner(0), corner(i - 1), corner(i)]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn outcode_agrees_with_the_pyramid(
            x in -3i8..=3, y in -3i8..=3, z in -3i8..=3,
        ) {
            let point = [x, y, z].map(f32::from);
            for face in Face::ALL {
                let [u, v, w] = face.local(point);
                let outside = u.abs().max(v.abs()) > w;
                prop_assert_eq!(outcode(point) & SIDES[face as usize] != 0, outside, "{:?}", face);
            }
        }

        #[test]
        fn clip_keeps_exactly_what_lies_inside(
            corners in prop::array::uniform3(prop::array::uniform3(-9.0..9.0f64)),
            weights in prop::array::uniform3(0.01..1.0f64),
        ) {
            let sum: f64 = weights.iter().sum();
            let point: [f64; 3] = std::array::from_fn(|axis| {
                (0..3).map(|i| corners[i][axis] * weights[i] / sum).sum()
            });
            let [u, v, w] = point;
            let slack = CLIP_WIDTH * w - u.abs().max(v.abs());
            prop_assume!(slack.abs() > 1e-9);
            let inside = fan(&clip(corners)).iter().any(|&piece| holds(piece, point));
            prop_assert_eq!(inside, slack > 0.0);
        }

        #[test]
        fn neighbours_get_the_same_corners(
            [a, b, c, d] in prop::array::uniform4(prop::array::uniform3(-9.0..9.0f64)),
        ) {
            let on_line = |p: &[f64; 3]| distance_to_line(*p, a, b) < 1e-9;
            let cut = |triangle| {
                let mut shared: Vec<_> = clip(triangle).into_iter().filter(on_line).collect();
                shared.sort_by(|p, q| p.partial_cmp(q).unwrap());
                shared
            };
            prop_assert_eq!(cut([a, b, c]), cut([b, a, d]));
        }
    }

    fn fan(polygon: &[[f64; 3]]) -> Vec<[[f64; 3]; 3]> {
        (2..polygon.len())
            .map(|i| [polygon[0], polygon[i - 1], polygon[i]])
            .collect()
    }

    /// Coplanar point in triangle, by areas.
    fn holds([a, b, c]: [[f64; 3]; 3], p: [f64; 3]) -> bool {
        let parts = area(a, b, p) + area(b, c, p) + area(c, a, p);
        parts - area(a, b, c) <= 1e-7 * (1.0 + parts)
    }

    fn area(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> f64 {
        distance_to_line(c, a, b) * length(relative(b, a)) / 2.0
    }

    fn length(v: [f64; 3]) -> f64 {
        v.iter().map(|c| c * c).sum::<f64>().sqrt()
    }

    fn distance_to_line(p: [f64; 3], a: [f64; 3], b: [f64; 3]) -> f64 {
        let (e, f) = (relative(b, a), relative(p, a));
        let base = length(e);
        let cross = [
            e[1] * f[2] - e[2] * f[1],
            e[2] * f[0] - e[0] * f[2],
            e[0] * f[1] - e[1] * f[0],
        ];
        if base == 0.0 {
            length(f)
        } else {
            length(cross) / base
        }
    }

    #[test]
    fn each_face_gets_its_own_triangles() {
        let scene = SceneMesh {
            positions: vec![[5.0, -1.0, -1.0], [5.0, 1.0, -1.0], [5.0, 0.0, 1.0]],
            triangles: vec![[0, 1, 2]],
            ids: vec![3],
        };
        let mut pyramids = Pyramids::default();
        for (eye, count) in [
            ([0.0; 3], [3, 0, 0, 0, 0, 0]),
            ([9.0, 0.0, 0.0], [0, 3, 0, 0, 0, 0]),
        ] {
            pyramids.look_from(&scene, eye);
            let drawn = Face::ALL.map(|face| pyramids.vertices(&scene, eye, face).len());
            assert_eq!(drawn, count);
        }
    }
}
