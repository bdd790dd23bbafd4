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

/// The closed outward mesh of a solid made of unit cells, scaled and moved: every face of a cell
/// that no other cell shares, so that it may have passages, courtyards and bridges.
pub fn cells_mesh(cells: &[[i32; 3]], place: impl Fn([i32; 3]) -> Point) -> Mesh {
    let mut triangles = Vec::new();
    for &cell in cells {
        for (axis, upper) in (0..3).flat_map(|axis| [(axis, 0), (axis, 1)]) {
            let mut neighbour = cell;
            neighbour[axis] += 2 * upper - 1;
            if cells.contains(&neighbour) {
                continue;
            }
            let corner = |s: i32, t: i32| {
                let mut corner = cell;
                corner[axis] += upper;
                corner[(axis + 1) % 3] += s;
                corner[(axis + 2) % 3] += t;
                place(corner)
            };
            let [a, b, c, d] = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
            triangles.extend(if upper == 1 {
                [[a, b, c], [a, c, d]]
            } else {
                [[a, c, b], [a, d, c]]
            });
        }
    }
    Mesh::from_triangles(&triangles)
}

/// A house of 10 x 8 m with eaves at 5 m and its ridge at 8 m, along y over x = 5.
pub fn gable_house(place: impl Fn(Point) -> Point) -> Mesh {
    let outline = [[0.0, 0.0], [10.0, 0.0], [10.0, 5.0], [5.0, 8.0], [0.0, 5.0]];
    let standing = prism(&outline, -8.0, 0.0);
    let vertices = standing.vertices.iter().map(|&[x, z, y]| place([x, -y, z]));
    Mesh {
        vertices: vertices.collect(),
        triangles: standing.triangles,
    }
}
