//! Boundaries: nested arrays of vertex indices, and the surfaces that they describe.

use serde_json::value::RawValue;

use super::json::{invalid, parse, string};
use super::vertices::Vertices;
use crate::error::Problem;
use crate::scene::Surface;

/// A surface as rings of vertex indices, each checked against the list that it points into.
pub(super) type IndexSurface = Vec<Vec<u64>>;

/// The geometry types of the format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum GeometryType {
    /// Points: one level of nesting.
    MultiPoint,
    /// Lines: two levels.
    MultiLineString,
    /// `MultiSurface` and `CompositeSurface`: three levels.
    Surfaces,
    /// Shells of surfaces, the first outer: four levels.
    Solid,
    /// `MultiSolid` and `CompositeSolid`: five levels.
    Solids,
    /// A template, placed at one vertex.
    Instance,
}

impl GeometryType {
    /// Reads the member `type`.
    pub(super) fn parse(raw: &RawValue) -> Result<Self, Problem> {
        Ok(match string("geometry type", raw)?.as_ref() {
            "MultiPoint" => Self::MultiPoint,
            "MultiLineString" => Self::MultiLineString,
            "MultiSurface" | "CompositeSurface" => Self::Surfaces,
            "Solid" => Self::Solid,
            "MultiSolid" | "CompositeSolid" => Self::Solids,
            "GeometryInstance" => Self::Instance,
            _ => return Err(invalid("geometry type", raw, "a geometry type of cityjson")),
        })
    }
}

/// Reads boundaries as surfaces, all shells of all solids in one list; points and lines have none.
/// Every index is below `vertex_count`, and the nesting is that of the type.
pub(super) fn index_surfaces(
    kind: GeometryType,
    raw: &RawValue,
    vertex_count: usize,
) -> Result<Vec<IndexSurface>, Problem> {
    const WHAT: &str = "boundaries";
    let surfaces: Vec<IndexSurface> = match kind {
        GeometryType::MultiPoint | GeometryType::Instance => {
            check_indices(&parse::<Vec<u64>>(WHAT, raw)?, vertex_count)?;
            Vec::new()
        }
        GeometryType::MultiLineString => {
            for line in parse::<Vec<Vec<u64>>>(WHAT, raw)? {
                check_indices(&line, vertex_count)?;
            }
            Vec::new()
        }
        GeometryType::Surfaces => parse(WHAT, raw)?,
        GeometryType::Solid => flatten(parse(WHAT, raw)?),
        GeometryType::Solids => flatten(flatten(parse(WHAT, raw)?)),
    };
    for ring in surfaces.iter().flatten() {
        check_indices(ring, vertex_count)?;
    }
    Ok(surfaces)
}

fn flatten<T>(nested: Vec<Vec<T>>) -> Vec<T> {
    nested.into_iter().flatten().collect()
}

fn check_indices(indices: &[u64], vertex_count: usize) -> Result<(), Problem> {
    match indices.iter().find(|index| **index >= vertex_count as u64) {
        Some(&index) => Err(Problem::IndexOutOfRange {
            what: "vertex index",
            index,
            count: vertex_count,
        }),
        None => Ok(()),
    }
}

/// Surfaces in metres from surfaces of indices into a list of vertices.
pub(super) fn surfaces_at(
    index_surfaces: &[IndexSurface],
    vertices: &Vertices,
    degenerate_rings: &mut usize,
) -> Vec<Surface> {
    let positions = |ring: &Vec<u64>| {
        ring.iter()
            .map(|i| vertices.position(*i as usize))
            .collect()
    };
    surfaces_from(index_surfaces, positions, degenerate_rings)
}

/// Surfaces from surfaces of indices and the way from a ring to its positions. Rings are cleaned;
/// a degenerate hole is dropped, a degenerate outer ring takes its surface with it.
pub(super) fn surfaces_from(
    index_surfaces: &[IndexSurface],
    positions: impl Fn(&Vec<u64>) -> Vec<[f64; 3]>,
    degenerate_rings: &mut usize,
) -> Vec<Surface> {
    let mut surfaces = Vec::with_capacity(index_surfaces.len());
    for index_surface in index_surfaces {
        let mut rings = Vec::with_capacity(index_surface.len());
        for (number, index_ring) in index_surface.iter().enumerate() {
            let ring = clean(positions(index_ring));
            if ring.len() >= 3 {
                rings.push(ring);
                continue;
            }
            *degenerate_rings += 1;
            if number == 0 {
                break;
            }
        }
        if !rings.is_empty() {
            surfaces.push(Surface {
                rings,
                ..Surface::default()
            });
        }
    }
    surfaces
}

/// Drops positions that repeat their predecessor, the last one's being the first.
fn clean(mut ring: Vec<[f64; 3]>) -> Vec<[f64; 3]> {
    ring.dedup();
    while ring.len() > 1 && ring.first() == ring.last() {
        ring.pop();
    }
    ring
}

#[cfg(test)]
mod tests {
    use super::super::vertices::Transform;
    use super::*;

    fn read(kind: &str, boundaries: &str) -> Result<Vec<IndexSurface>, String> {
        let kind = GeometryType::parse(serde_json::from_str(kind).unwrap()).unwrap();
        let raw = serde_json::from_str(boundaries).unwrap();
        index_surfaces(kind, raw, 8).map_err(|problem| problem.to_string())
    }

    #[test]
    fn every_type_has_its_own_depth() {
        let (a, b) = (vec![vec![0, 1, 2]], vec![vec![3, 4, 5], vec![5, 6, 7]]);
        let both = Ok(vec![a, b]);
        assert_eq!(read("\"MultiPoint\"", "[0,7]"), Ok(vec![]));
        assert_eq!(read("\"MultiLineString\"", "[[0,7],[1,2]]"), Ok(vec![]));
        for kind in ["\"MultiSurface\"", "\"CompositeSurface\""] {
            assert_eq!(read(kind, "[[[0,1,2]],[[3,4,5],[5,6,7]]]"), both);
        }
        assert_eq!(read("\"Solid\"", "[[[[0,1,2]]],[[[3,4,5],[5,6,7]]]]"), both);
        for kind in ["\"MultiSolid\"", "\"CompositeSolid\""] {
            assert_eq!(read(kind, "[[[[[0,1,2]]]],[[[[3,4,5],[5,6,7]]]]]"), both);
        }
    }

    #[test]
    fn wrong_indices_are_quoted() {
        let message = |boundaries| read("\"MultiSurface\"", boundaries).unwrap_err();
        assert_eq!(
            message("[[[0,1,8]]]"),
            "vertex index 8 is out of range, there are 8"
        );
        assert_eq!(
            message("[[[0,1,18446744073709551615]]]"),
            "vertex index 18446744073709551615 is out of range, there are 8"
        );
        let start = "boundaries is malformed: invalid";
        assert_eq!(
            message("[[[-1]]]"),
            format!("{start} value: integer `-1`, expected u64")
        );
        assert_eq!(
            message("[[[1.5]]]"),
            format!("{start} type: floating point `1.5`, expected u64")
        );
        assert_eq!(
            message("[[[[0]]]]"),
            format!("{start} type: sequence, expected u64")
        );
        assert_eq!(
            message("[[0]]"),
            format!("{start} type: integer `0`, expected a sequence")
        );
        assert_eq!(
            message("{}"),
            format!("{start} type: map, expected a sequence")
        );
        assert_eq!(
            message("[[[1e999]]]"),
            "boundaries is malformed: number out of range"
        );
        let too_far = read("\"MultiLineString\"", "[[9]]").unwrap_err();
        assert_eq!(too_far, "vertex index 9 is out of range, there are 8");
    }

    #[test]
    fn degenerate_rings_are_dropped_and_counted() {
        let list = serde_json::from_str("[[0,0,0],[9,0,0],[9,9,0],[0,9,0],[9,0,0]]").unwrap();
        let vertices = Vertices::parse("vertex", list, Transform::IDENTITY).unwrap();
        let rings = |surface: &[&[u64]]| {
            let surface = surface.iter().map(|ring| ring.to_vec()).collect();
            let mut dropped = 0;
            let surfaces = surfaces_at(&[surface], &vertices, &mut dropped);
            let lengths = surfaces.iter().flat_map(|s| s.rings.iter().map(Vec::len));
            (lengths.collect::<Vec<_>>(), dropped)
        };
        assert_eq!(rings(&[&[0, 1, 4, 2, 3, 3, 0, 0]]), (vec![4], 0));
        assert_eq!(rings(&[&[0, 1]]), (vec![], 1));
        assert_eq!(rings(&[&[]]), (vec![], 1));
        assert_eq!(rings(&[]), (vec![], 0));
        assert_eq!(rings(&[&[1, 4, 0]]), (vec![], 1));
        assert_eq!(
            rings(&[&[0, 1, 2, 3], &[0, 1], &[1, 2, 3]]),
            (vec![4, 3], 1)
        );
        assert_eq!(rings(&[&[0, 1], &[0, 1, 2]]), (vec![], 1));
    }
}
