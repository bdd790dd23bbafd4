//! Boundaries: nested arrays of vertex indices, and the surfaces that they describe.

use std::fmt;
use std::ops::Range;

use serde::de::{DeserializeSeed, Deserializer, SeqAccess, Visitor};
use serde_json::value::RawValue;

use super::json::{check_count, invalid, parse_with, string};
use super::vertices::Vertices;
use crate::error::Problem;
use crate::scene::Surface;

/// Most bytes of the boundaries of one geometry, or of the values that belong to its surfaces.
pub(super) const MAX_BOUNDARY_BYTES: u64 = 32 << 20;

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

    /// How often lists of indices are nested in further lists.
    fn nesting(self) -> usize {
        match self {
            Self::MultiPoint | Self::Instance => 0,
            Self::MultiLineString => 1,
            Self::Surfaces => 2,
            Self::Solid => 3,
            Self::Solids => 4,
        }
    }

    /// Whether it has surfaces at all, and no template's.
    pub(super) fn has_surfaces(self) -> bool {
        self.nesting() >= 2
    }
}

/// Boundaries in flat form: all indices in one list, and where the lists of each level end.
#[derive(Debug, Default)]
pub(super) struct Boundaries {
    indices: Vec<u64>,
    /// Ends of rings in the indices, of surfaces in the rings, of shells in the surfaces, of solids
    /// in the shells; the outermost list of a type ends a list of its own level.
    ends: [Vec<usize>; 5],
}

impl Boundaries {
    /// Reads boundaries; every index is below `vertex_count`, and the nesting is that of the type.
    pub(super) fn parse(
        kind: GeometryType,
        raw: &RawValue,
        vertex_count: usize,
    ) -> Result<Self, Problem> {
        let bytes = raw.get().len() as u64;
        check_count("bytes of boundaries", bytes, MAX_BOUNDARY_BYTES)?;
        let mut boundaries = Self::default();
        let nesting = kind.nesting();
        let into = &mut boundaries;
        parse_with("boundaries", raw, Nested { nesting, into })?;
        let wrong = |index: &&u64| **index >= vertex_count as u64;
        match boundaries.indices.iter().find(wrong) {
            Some(&index) => Err(Problem::IndexOutOfRange {
                what: "vertex index",
                index,
                count: vertex_count,
            }),
            None => Ok(boundaries),
        }
    }

    /// All indices.
    pub(super) fn indices(&self) -> &[u64] {
        &self.indices
    }

    /// Vertices and rings: what the surfaces cost.
    pub(super) fn size(&self) -> usize {
        self.indices.len() + self.ends[0].len() + self.ends[1].len()
    }

    /// Ranges of surfaces, one a shell.
    pub(super) fn shells(&self) -> impl Iterator<Item = Range<usize>> {
        ranges(&self.ends[2])
    }

    /// Ranges of shells, one a solid.
    pub(super) fn solids(&self) -> impl Iterator<Item = Range<usize>> {
        ranges(&self.ends[3])
    }

    /// Surfaces in metres, none where the outer ring is degenerate. Rings are cleaned; a degenerate
    /// hole is dropped, a degenerate outer ring takes its surface with it.
    pub(super) fn surfaces(
        &self,
        vertices: &Vertices,
        degenerate_rings: &mut usize,
    ) -> Vec<Option<Surface>> {
        let mut surface = |index_rings: Range<usize>| {
            let mut rings = Vec::with_capacity(index_rings.len());
            for ring in index_rings {
                let ring = self.ring(ring, vertices);
                if ring.len() >= 3 {
                    rings.push(ring);
                    continue;
                }
                *degenerate_rings += 1;
                if rings.is_empty() {
                    break;
                }
            }
            (!rings.is_empty()).then(|| Surface {
                rings,
                ..Surface::default()
            })
        };
        ranges(&self.ends[1]).map(&mut surface).collect()
    }

    /// A ring in metres, without positions that repeat their predecessor, the last one's being the
    /// first.
    fn ring(&self, number: usize, vertices: &Vertices) -> Vec<[f64; 3]> {
        let ends = &self.ends[0];
        let start = number.checked_sub(1).map_or(0, |before| ends[before]);
        let indices = &self.indices[start..ends[number]];
        let mut ring: Vec<_> = indices
            .iter()
            .map(|i| vertices.position(*i as usize))
            .collect();
        ring.dedup();
        while ring.len() > 1 && ring.first() == ring.last() {
            ring.pop();
        }
        ring
    }
}

/// The ranges between ends, the first from zero on.
fn ranges(ends: &[usize]) -> impl Iterator<Item = Range<usize>> {
    let starts = std::iter::once(0).chain(ends.iter().copied());
    starts.zip(ends).map(|(start, end)| start..*end)
}

/// Reads lists of indices that are nested so deeply.
struct Nested<'b> {
    nesting: usize,
    into: &'b mut Boundaries,
}

impl<'de> DeserializeSeed<'de> for Nested<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_seq(self)
    }
}

impl<'de> Visitor<'de> for Nested<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a sequence")
    }

    fn visit_seq<S: SeqAccess<'de>>(self, mut list: S) -> Result<(), S::Error> {
        let Self { nesting, into } = self;
        let Some(inner) = nesting.checked_sub(1) else {
            while let Some(index) = list.next_element()? {
                into.indices.push(index);
            }
            into.ends[0].push(into.indices.len());
            return Ok(());
        };
        loop {
            let nested = Nested {
                nesting: inner,
                into: &mut *into,
            };
            if list.next_element_seed(nested)?.is_none() {
                break;
            }
        }
        let end = into.ends[inner].len();
        into.ends[nesting].push(end);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::super::vertices::Transform;
    use super::*;

    /// The rings of each surface.
    type Rings = Vec<Vec<Vec<u64>>>;

    fn read(kind: &str, boundaries: &str) -> Result<Rings, String> {
        let kind = GeometryType::parse(serde_json::from_str(kind).unwrap()).unwrap();
        let raw = serde_json::from_str(boundaries).unwrap();
        let read = Boundaries::parse(kind, raw, 8).map_err(|problem| problem.to_string())?;
        let rings: Vec<_> = ranges(&read.ends[0])
            .map(|r| read.indices[r].to_vec())
            .collect();
        Ok(ranges(&read.ends[1]).map(|r| rings[r].to_vec()).collect())
    }

    #[test]
    fn every_type_has_its_own_depth() {
        let (a, b) = (vec![vec![0, 1, 2]], vec![vec![3, 4, 5], vec![5, 6, 7]]);
        let both = Ok(vec![a, b]);
        assert_eq!(read("\"MultiPoint\"", "[0,7]"), Ok(vec![]));
        assert_eq!(
            read("\"MultiLineString\"", "[[0,7],[1,2]]"),
            Ok(vec![vec![vec![0, 7], vec![1, 2]]]),
            "lines stand where the rings of one surface would"
        );
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
        let vertices = Vertices::parse("vertex", list, Transform::IDENTITY, 9).unwrap();
        let rings = |surface: &[&[u64]]| {
            let text = serde_json::value::to_raw_value(&[surface]).unwrap();
            let read = Boundaries::parse(GeometryType::Surfaces, &text, 5).unwrap();
            let mut dropped = 0;
            let surfaces = read.surfaces(&vertices, &mut dropped);
            let rings = surfaces.iter().flatten().flat_map(|s| &s.rings);
            (rings.map(Vec::len).collect::<Vec<_>>(), dropped)
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
