//! Meshes of glTF to shapes.

use std::borrow::Cow;
use std::collections::HashMap;

use serde::Deserialize;
use serde_json::value::RawValue;
use serde_json::{Map, Value};

use super::appearance::ReadMaterial;
use super::document::{Document, list};
use super::frame::position_in_scene;
use super::weight::{TRIANGLE_BYTES, Weight, check_name};
use crate::error::Problem;
use crate::limits::{Budget, MAX_COORDINATE, MAX_NAME_BYTES};
use crate::scene::{Material, Semantic, Shape, Surface};

#[derive(Deserialize)]
struct Mesh<'a> {
    #[serde(borrow)]
    primitives: Option<&'a RawValue>,
}

#[derive(Deserialize)]
struct Primitive<'a> {
    attributes: Attributes,
    indices: Option<u64>,
    material: Option<u64>,
    mode: Option<u64>,
    #[serde(borrow)]
    targets: Option<&'a RawValue>,
    #[serde(borrow)]
    extras: Option<&'a RawValue>,
}

#[derive(Deserialize)]
#[serde(rename_all = "UPPERCASE")]
struct Attributes {
    position: Option<u64>,
}

#[derive(Deserialize)]
struct PrimitiveExtras<'a> {
    #[serde(borrow)]
    semantic: Cow<'a, str>,
}

/// What of a mesh is not in its shape.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Losses {
    pub(super) lines: bool,
    pub(super) textures: bool,
    pub(super) targets: bool,
}

impl Losses {
    /// Adds those of another mesh.
    pub(super) fn add(&mut self, other: Self) {
        self.lines |= other.lines;
        self.textures |= other.textures;
        self.targets |= other.targets;
    }
}

/// A mesh as it was read.
pub(super) struct ReadShape {
    pub(super) shape: Shape,
    pub(super) losses: Losses,
    /// Triangles that were left out since two of their corners are the same.
    pub(super) degenerate: usize,
}

/// Reads a mesh into a shape, in the scene's frame but where its node puts it.
pub(super) fn read_shape<'a>(
    document: &Document<'a>,
    mesh: u64,
    budget: &mut Budget,
    weight: &mut Weight,
) -> Result<ReadShape, Problem> {
    let mesh: Mesh<'a> = document.element("mesh", &document.meshes, mesh)?;
    let primitives: Vec<&'a RawValue> = list("primitives", mesh.primitives)?;
    budget.objects(primitives.len())?;
    let mut builder = ShapeBuilder {
        document,
        budget,
        weight,
        read: ReadShape {
            shape: Shape::default(),
            losses: Losses::default(),
            degenerate: 0,
        },
        materials: HashMap::new(),
        semantics: HashMap::new(),
    };
    for i in 0..primitives.len() as u64 {
        builder.add(&document.element("primitive", &primitives, i)?)?;
    }
    Ok(builder.read)
}

/// A shape that grows by primitives.
struct ShapeBuilder<'b, 'a> {
    document: &'b Document<'a>,
    budget: &'b mut Budget,
    weight: &'b mut Weight,
    read: ReadShape,
    /// Materials of the shape by their number in the document.
    materials: HashMap<u64, u32>,
    semantics: HashMap<String, u32>,
}

impl ShapeBuilder<'_, '_> {
    fn add(&mut self, primitive: &Primitive<'_>) -> Result<(), Problem> {
        let Some(assembly) = Assembly::of(primitive.mode)? else {
            self.read.losses.lines = true;
            return Ok(());
        };
        let Some(positions) = primitive.attributes.position else {
            return Ok(());
        };
        let corners = self.corners(positions, primitive.indices)?;
        let count = assembly.triangles(corners.len());
        self.budget.surfaces(count)?;
        self.weight.add(count.saturating_mul(TRIANGLE_BYTES))?;
        let material = primitive.material.map(|m| self.material(m)).transpose()?;
        let semantic = self.semantic(primitive.extras)?;
        for i in 0..count {
            let triangle = assembly
                .triangle(i)
                .map(|corner| corners.get(corner).copied());
            let [Some(a), Some(b), Some(c)] = triangle else {
                break;
            };
            if a == b || b == c || c == a {
                self.read.degenerate += 1;
                continue;
            }
            self.read.shape.surfaces.push(Surface {
                rings: vec![vec![a, b, c]],
                material,
                semantic,
            });
        }
        self.read.losses.targets |= primitive.targets.is_some();
        Ok(())
    }

    /// The positions in the order in which triangles use them.
    fn corners(&mut self, positions: u64, indices: Option<u64>) -> Result<Vec<[f64; 3]>, Problem> {
        self.budget.vertices(self.document.count(positions)?)?;
        let mut positions = self.document.vectors::<3>(positions)?;
        for position in &mut positions {
            *position = position_in_scene(*position);
            check_position(*position)?;
        }
        let Some(indices) = indices else {
            return Ok(positions);
        };
        self.budget.vertices(self.document.count(indices)?)?;
        let corner = |[index]: [f64; 1]| {
            let corner = positions.get(index as usize).copied();
            corner.ok_or(Problem::IndexOutOfRange {
                what: "vertex",
                index: index as u64,
                count: positions.len(),
            })
        };
        let indices = self.document.vectors::<1>(indices)?;
        indices.into_iter().map(corner).collect()
    }

    fn material(&mut self, number: u64) -> Result<u32, Problem> {
        if let Some(&index) = self.materials.get(&number) {
            return Ok(index);
        }
        let list = &self.document.materials;
        let read: ReadMaterial<'_> = self.document.element("material", list, number)?;
        self.read.losses.textures |= read.has_textures();
        self.weight.add(size_of::<Material>() + MAX_NAME_BYTES)?;
        let index = self.read.shape.materials.len() as u32;
        self.read.shape.materials.push(read.material()?);
        self.materials.insert(number, index);
        Ok(index)
    }

    fn semantic(&mut self, extras: Option<&RawValue>) -> Result<Option<u32>, Problem> {
        let extras = extras.map(|extras| serde_json::from_str(extras.get()));
        let Some(Ok(PrimitiveExtras { semantic })) = extras else {
            return Ok(None);
        };
        check_name("the semantic of a primitive", &semantic)?;
        if let Some(&index) = self.semantics.get(&*semantic) {
            return Ok(Some(index));
        }
        self.weight
            .add(size_of::<Semantic>() + 2 * semantic.len())?;
        let index = self.read.shape.semantics.len() as u32;
        self.read.shape.semantics.push(Semantic {
            class: semantic.clone().into_owned(),
            attributes: Value::Object(Map::new()),
        });
        self.semantics.insert(semantic.into_owned(), index);
        Ok(Some(index))
    }
}

/// How vertices make triangles.
#[derive(Clone, Copy)]
enum Assembly {
    List,
    Strip,
    Fan,
}

impl Assembly {
    /// `None` for points and lines.
    fn of(mode: Option<u64>) -> Result<Option<Self>, Problem> {
        Ok(match mode {
            Some(0..=3) => None,
            None | Some(4) => Some(Self::List),
            Some(5) => Some(Self::Strip),
            Some(6) => Some(Self::Fan),
            Some(mode) => {
                return Err(Problem::Invalid {
                    what: "the mode of a primitive".to_owned(),
                    found: mode.to_string(),
                    expected: "0 to 6",
                });
            }
        })
    }

    /// How many triangles so many corners make.
    fn triangles(self, corners: usize) -> usize {
        match self {
            Self::List => corners / 3,
            Self::Strip | Self::Fan => corners.saturating_sub(2),
        }
    }

    /// The corners of a triangle.
    fn triangle(self, i: usize) -> [usize; 3] {
        match self {
            Self::List => [3 * i, 3 * i + 1, 3 * i + 2],
            Self::Strip => [i, i + 1 + i % 2, i + 2 - i % 2],
            Self::Fan => [i + 1, i + 2, 0],
        }
    }
}

/// Refuses coordinates that are not finite, or too large to compute with.
pub(super) fn check_position(position: [f64; 3]) -> Result<(), Problem> {
    // Not finite is not within, either.
    if position.iter().all(|c| c.abs() <= MAX_COORDINATE) {
        return Ok(());
    }
    Err(Problem::Invalid {
        what: "a position".to_owned(),
        found: format!("{position:?}"),
        expected: "coordinates of at most 1e9",
    })
}
