//! Small solids for the tests.

use oracle::{Aabb, Mesh, Point};

/// The closed outward mesh of a box: 8 vertices, 12 triangles.
pub fn box_mesh(aabb: &Aabb) -> Mesh {
    let quads = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let triangles = quads
        .iter()
        .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]])
        .collect();
    Mesh {
        vertices: aabb.corners().to_vec(),
        triangles,
    }
}

/// Both meshes as one.
pub fn joined(a: &Mesh, b: &Mesh) -> Mesh {
    let shift = a.vertices.len() as u32;
    let moved = b
        .triangles
        .iter()
        .map(|triangle| triangle.map(|index| index + shift));
    Mesh {
        vertices: a.vertices.iter().chain(&b.vertices).copied().collect(),
        triangles: a.triangles.iter().copied().chain(moved).collect(),
    }
}

/// The mesh turned inside out.
pub fn inside_out(mesh: &Mesh) -> Mesh {
    let triangles = mesh.triangles.iter().map(|&[a, b, c]| [a, c, b]).collect();
    Mesh {
        vertices: mesh.vertices.clone(),
        triangles,
    }
}

/// The closed outward mesh of a vertical prism over an anticlockwise outline that its first corner
/// sees all of.
pub fn prism(outline: &[[f64; 2]], bottom: f64, top: f64) -> Mesh {
    let count = outline.len() as u32;
    let ring = |z: f64| outline.iter().map(move |&[x, y]| [x, y, z]);
    let vertices: Vec<Point> = ring(bottom).chain(ring(top)).collect();
    let caps = (1..count - 1).flat_map(|i| [[0, i + 1, i], [count, count + i, count + i + 1]]);
    let walls = (0..count).flat_map(|i| {
        let j = (i + 1) % count;
        [[i, j, count + j], [i, count + j, count + i]]
    });
    Mesh {
        vertices,
        triangles: caps.chain(walls).collect(),
    }
}
