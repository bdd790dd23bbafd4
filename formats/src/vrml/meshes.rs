//! Faces of `IndexedFaceSet` and `ElevationGrid`: clauses 6.23 and 6.17.

use super::faces::Faces;
use super::graph::{Graph, Node};
use crate::error::Problem;

/// The polygons of an `IndexedFaceSet`, convex or not: -1 ends one.
pub(super) fn add_face_set(
    graph: &Graph<'_>,
    node: &Node<'_>,
    faces: &mut Faces<'_>,
) -> Result<(), Problem> {
    let points = match graph.child(node, "coord", &["Coordinate"]) {
        Some(id) => graph.node(id).numbers("point"),
        None => &[],
    };
    let (points, _) = points.as_chunks::<3>();
    let position = |index: &f64| {
        let found = (*index >= 0.0)
            .then(|| points.get(*index as usize))
            .flatten();
        found
            .copied()
            .ok_or_else(|| index_problem(*index, points.len()))
    };
    for polygon in node.numbers("coordIndex").split(|index| *index == -1.0) {
        let ring: Result<Vec<_>, Problem> = polygon.iter().map(position).collect();
        let ring = ring?;
        if !ring.is_empty() {
            faces.add(ring)?;
        }
    }
    Ok(())
}

fn index_problem(index: f64, count: usize) -> Problem {
    if index >= 0.0 {
        return Problem::IndexOutOfRange {
            what: "coordIndex",
            index: index as u64,
            count,
        };
    }
    Problem::Invalid {
        what: "coordIndex".to_owned(),
        found: index.to_string(),
        expected: "an index, or -1 to end a face",
    }
}

/// The quadrangles between the heights of an `ElevationGrid`, seen from above.
pub(super) fn add_elevation_grid(node: &Node<'_>, faces: &mut Faces<'_>) -> Result<(), Problem> {
    let (heights, columns) = (node.numbers("height"), node.number("xDimension"));
    let rows = node.number("zDimension");
    let cells = columns.max(0.0) * rows.max(0.0);
    if cells > heights.len() as f64 {
        return Err(Problem::Invalid {
            what: "height".to_owned(),
            found: format!("{} numbers", heights.len()),
            expected: "xDimension times zDimension numbers",
        });
    }
    if columns < 2.0 || rows < 2.0 {
        return Ok(());
    }
    let (columns, rows) = (columns as usize, rows as usize);
    let spacing = [node.number("xSpacing"), node.number("zSpacing")];
    let position = |i: usize, j: usize| {
        let height = heights[j * columns + i];
        [i as f64 * spacing[0], height, j as f64 * spacing[1]]
    };
    for j in 1..rows {
        for i in 1..columns {
            let corners = [(i - 1, j - 1), (i - 1, j), (i, j), (i, j - 1)];
            faces.add_quadrangle(corners.map(|(i, j)| position(i, j)))?;
        }
    }
    Ok(())
}
