//! A shape in columns.

use std::collections::HashMap;

use serde::{Deserialize, Serialize};

use super::container::malformed;
use super::coordinates::Coordinates;
use super::memory::Memory;
use crate::error::Problem;
use crate::scene::{Material, Semantic, Shape, Surface};

/// A shape as it is stored.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct StoredShape {
    /// How many rings each surface has.
    surfaces: Vec<u32>,
    /// How many positions each ring has.
    rings: Vec<u32>,
    /// Positions of the rings, counted back from the number of distinct ones so far: zero for a
    /// new one.
    vertices: Vec<u32>,
    /// The distinct positions in the order of their first use.
    positions: Coordinates,
    /// One more than the material of each surface, zero for none. Empty where none has one.
    surface_materials: Vec<u32>,
    /// The same for semantics.
    surface_semantics: Vec<u32>,
    materials: Vec<Material>,
    /// As JSON, empty for none.
    semantics: String,
}

impl StoredShape {
    /// A shape in its stored form.
    pub(super) fn of(shape: &Shape, memory: &mut Memory) -> Result<Self, Problem> {
        let surfaces = &shape.surfaces;
        let rings = || surfaces.iter().flat_map(|surface| &surface.rings);
        memory.surfaces(surfaces.len())?;
        memory.rings(rings().count())?;
        memory.positions(rings().map(Vec::len).sum())?;
        let mut distinct = Distinct::default();
        let vertices = rings()
            .flatten()
            .map(|position| distinct.back(*position))
            .collect();
        let materials = surfaces.iter().map(|surface| surface.material);
        let semantics = surfaces.iter().map(|surface| surface.semantic);
        Ok(Self {
            surfaces: surfaces
                .iter()
                .map(|surface| surface.rings.len() as u32)
                .collect(),
            rings: rings().map(|ring| ring.len() as u32).collect(),
            vertices,
            positions: Coordinates::of(&distinct.positions),
            surface_materials: numbers("material", materials, shape.materials.len())?,
            surface_semantics: numbers("semantic", semantics, shape.semantics.len())?,
            materials: shape.materials.clone(),
            semantics: memory.encode(&shape.semantics)?,
        })
    }

    /// The shape.
    pub(super) fn into_shape(self, memory: &mut Memory) -> Result<Shape, Problem> {
        memory.surfaces(self.surfaces.len())?;
        memory.rings(self.rings.len())?;
        memory.positions(self.vertices.len())?;
        let semantics: Vec<Semantic> = memory.decode(&self.semantics)?;
        let positions = self.positions.positions()?;
        let mut rings = rings(&self.rings, &self.vertices, &positions)?.into_iter();
        let mut surfaces = Vec::with_capacity(self.surfaces.len());
        for (i, count) in self.surfaces.iter().enumerate() {
            let surface = Surface {
                rings: rings.by_ref().take(*count as usize).collect(),
                material: number(&self.surface_materials, i, self.materials.len())?,
                semantic: number(&self.surface_semantics, i, semantics.len())?,
            };
            if surface.rings.len() != *count as usize {
                return Err(malformed("rings are missing"));
            }
            surfaces.push(surface);
        }
        Ok(Shape {
            surfaces,
            materials: self.materials,
            semantics,
        })
    }
}

/// The distinct positions so far, by their bits.
#[derive(Default)]
struct Distinct {
    positions: Vec<[f64; 3]>,
    index_of: HashMap<[u64; 3], usize>,
}

impl Distinct {
    /// How far back a position is; zero for a new one.
    fn back(&mut self, position: [f64; 3]) -> u32 {
        let count = self.positions.len();
        let index = *self
            .index_of
            .entry(position.map(f64::to_bits))
            .or_insert(count);
        if index == count {
            self.positions.push(position);
        }
        (count - index) as u32
    }
}

/// The rings of all surfaces.
fn rings(
    lengths: &[u32],
    vertices: &[u32],
    positions: &[[f64; 3]],
) -> Result<Vec<Vec<[f64; 3]>>, Problem> {
    let mut vertices = vertices.iter();
    let mut count = 0;
    let mut rings = Vec::with_capacity(lengths.len());
    for length in lengths {
        let mut ring = Vec::new();
        for back in vertices.by_ref().take(*length as usize) {
            let index = usize::checked_sub(count, *back as usize);
            let position = index.and_then(|index| positions.get(index));
            ring.push(*position.ok_or_else(|| malformed("a position is missing"))?);
            count += usize::from(*back == 0);
        }
        if ring.len() != *length as usize {
            return Err(malformed("positions of a ring are missing"));
        }
        rings.push(ring);
    }
    Ok(rings)
}

/// Numbers with zero for none, or nothing where there are none at all.
fn numbers(
    what: &'static str,
    values: impl Iterator<Item = Option<u32>>,
    count: usize,
) -> Result<Vec<u32>, Problem> {
    let number = |value: Option<u32>| match value {
        Some(value) if value as usize >= count => Err(Problem::IndexOutOfRange {
            what,
            index: value.into(),
            count,
        }),
        value => Ok(value.map_or(0, |value| value + 1)),
    };
    let numbers: Vec<_> = values.map(number).collect::<Result<_, _>>()?;
    match numbers.iter().all(|number| *number == 0) {
        true => Ok(Vec::new()),
        false => Ok(numbers),
    }
}

/// The value of a surface from its number.
fn number(numbers: &[u32], surface: usize, count: usize) -> Result<Option<u32>, Problem> {
    let value = numbers
        .get(surface)
        .and_then(|number| number.checked_sub(1));
    match value {
        Some(value) if value as usize >= count => Err(malformed("a value is out of range")),
        value => Ok(value),
    }
}

#[cfg(test)]
mod tests {
    use super::super::container;
    use super::super::{pack_shape, unpack_shape};
    use super::*;

    fn stored() -> StoredShape {
        let shape = Shape {
            surfaces: vec![Surface {
                rings: vec![vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]],
                material: Some(0),
                semantic: None,
            }],
            materials: vec![Material::default()],
            semantics: Vec::new(),
        };
        StoredShape::of(&shape, &mut Memory::default()).unwrap()
    }

    fn message(change: impl Fn(&mut StoredShape)) -> String {
        let mut stored = stored();
        change(&mut stored);
        let content = container::seal(&container::payload(&stored).unwrap()).unwrap();
        match unpack_shape(&content) {
            Ok(shape) => format!("{} surfaces", shape.surfaces.len()),
            Err(problem) => problem.to_string(),
        }
    }

    #[test]
    fn columns_that_do_not_fit_together_are_refused() {
        let malformed = |what: &str| format!("packed model is malformed: {what}");
        assert_eq!(message(|_| {}), "1 surfaces");
        assert_eq!(
            message(|s| s.surfaces[0] = 2),
            malformed("rings are missing")
        );
        let short = malformed("positions of a ring are missing");
        assert_eq!(message(|s| s.rings[0] = u32::MAX), short);
        let missing = malformed("a position is missing");
        assert_eq!(message(|s| s.vertices[0] = 1), missing);
        assert_eq!(message(|s| s.vertices.push(0)), "1 surfaces");
        let five = |s: &mut StoredShape| {
            s.rings[0] = 4;
            s.vertices.push(0);
        };
        assert_eq!(message(five), missing);
        let range = malformed("a value is out of range");
        assert_eq!(message(|s| s.surface_materials[0] = 2), range);
        assert_eq!(message(|s| s.surface_semantics = vec![1]), range);
        let text = message(|s| s.semantics = "[7]".to_owned());
        assert!(
            text.starts_with(&malformed("invalid type: integer `7`")),
            "{text}"
        );
    }

    #[test]
    fn small_content_cannot_unpack_to_much_memory() {
        let message = |change: fn(&mut StoredShape)| {
            let mut stored = stored();
            change(&mut stored);
            let shape = stored.into_shape(&mut Memory::default());
            shape.unwrap_err().to_string()
        };
        let limit = "bytes of an unpacked model exceed the limit of 268435456";
        let surfaces = message(|s| s.surfaces = vec![0; 10_000_000]);
        assert!(surfaces.ends_with(limit), "{surfaces}");
        let rings = message(|s| s.rings = vec![0; 20_000_000]);
        assert!(rings.ends_with(limit), "{rings}");
        let positions = message(|s| s.vertices = vec![1; 20_000_000]);
        assert!(positions.ends_with(limit), "{positions}");
        let text = message(|s| s.semantics = " ".repeat(7_000_000));
        assert!(text.ends_with(limit), "{text}");
    }

    #[test]
    fn what_could_not_be_unpacked_is_not_packed() {
        let mut shape = Shape {
            surfaces: vec![Surface::default(); 7_000_000],
            ..Shape::default()
        };
        let message = pack_shape(&shape).unwrap_err().to_string();
        assert!(
            message.starts_with("280000000 bytes of an unpacked model exceed"),
            "{message}"
        );
        shape.surfaces.truncate(1);
        shape.surfaces[0].semantic = Some(u32::MAX);
        assert_eq!(
            pack_shape(&shape).unwrap_err().to_string(),
            "semantic 4294967295 is out of range, there are 0"
        );
    }
}
