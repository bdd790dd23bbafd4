//! Surfaces as a solid where they enclose one, else as they are.

use std::collections::HashMap;

use serde_json::{Map, Value};

use super::materials::Materials;
use super::stored::{IndexSurface, Semantics, Shell, StoredGeometry, Surfaces, Theme, Themes};
use crate::scene::{Semantic, Shape, Surface};

/// Fewest surfaces that enclose a volume.
const FEWEST_OF_A_SOLID: usize = 4;

/// A shape as it is written. `surfaces` are its own or placed ones, `vertex` gives the index of a
/// position.
pub(super) fn stored_geometry<'a>(
    level_of_detail: f64,
    shape: &'a Shape,
    surfaces: &[Surface],
    vertex: &mut impl FnMut([f64; 3]) -> usize,
    materials: &mut Materials<'a>,
) -> StoredGeometry {
    let mut ring = |ring: &Vec<[f64; 3]>| ring.iter().map(|position| vertex(*position)).collect();
    let mut surface = |surface: &Surface| surface.rings.iter().map(&mut ring).collect();
    let boundaries: Vec<IndexSurface> = surfaces.iter().map(&mut surface).collect();
    let is_solid = is_closed(&boundaries);
    let semantics = (!shape.semantics.is_empty()).then(|| Semantics {
        surfaces: shape.semantics.iter().map(stored_semantic).collect(),
        values: nested(
            is_solid,
            surfaces.iter().map(|surface| surface.semantic).collect(),
        ),
    });
    let indices: Vec<_> = shape
        .materials
        .iter()
        .map(|material| materials.index(material))
        .collect();
    let material = |surface: &Surface| indices.get(surface.material? as usize).copied();
    let values: Vec<_> = surfaces.iter().map(material).collect();
    let has_materials = values.iter().any(Option::is_some);
    StoredGeometry::Surfaces(Surfaces {
        kind: if is_solid { "Solid" } else { "MultiSurface" },
        lod: level_of_detail.to_string(),
        boundaries: nested(is_solid, boundaries),
        semantics,
        material: has_materials.then(|| Themes {
            default: Theme {
                values: nested(is_solid, values),
            },
        }),
    })
}

fn nested<T>(is_solid: bool, list: Vec<T>) -> Shell<T> {
    match is_solid {
        true => Shell::Solid([list]),
        false => Shell::Open(list),
    }
}

/// The class is the type; an attribute of that name has no place beside it.
fn stored_semantic(semantic: &Semantic) -> Map<String, Value> {
    let class = ("type".to_owned(), semantic.class.clone().into());
    let attributes = semantic.attributes.as_object().into_iter().flatten();
    let attributes = attributes.filter(|(name, _)| *name != "type");
    let attributes = attributes.map(|(name, value)| (name.clone(), value.clone()));
    std::iter::once(class).chain(attributes).collect()
}

/// Whether each edge is passed as often one way as the other.
fn is_closed(surfaces: &[IndexSurface]) -> bool {
    let mut passes: HashMap<(usize, usize), i64> = HashMap::new();
    for ring in surfaces.iter().flatten() {
        let ends = ring.iter().cycle().skip(1);
        for (start, end) in ring.iter().zip(ends) {
            let (edge, way) = match start < end {
                true => ((*start, *end), 1),
                false => ((*end, *start), -1),
            };
            *passes.entry(edge).or_default() += way;
        }
    }
    surfaces.len() >= FEWEST_OF_A_SOLID && passes.values().all(|passes| *passes == 0)
}
