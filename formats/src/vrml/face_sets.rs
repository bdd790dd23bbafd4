//! Surfaces as the text of `Shape` nodes, one for each material.

use std::collections::{BTreeMap, HashMap};
use std::fmt::Write;

use super::bridge::{GridPoint, bridged};
use super::grid::{on_grid, write_point};
use super::identifier::encode;
use crate::scene::{Material, Surface};

/// Writes surfaces, their positions from an origin.
pub(super) fn write_shapes(
    text: &mut String,
    surfaces: &[Surface],
    materials: &[Material],
    origin: [f64; 3],
) {
    let mut by_material: BTreeMap<Option<u32>, Vec<&Surface>> = BTreeMap::new();
    for surface in surfaces {
        by_material
            .entry(surface.material)
            .or_default()
            .push(surface);
    }
    for (number, surfaces) in by_material {
        text.push_str("Shape { ");
        if let Some(material) = number.and_then(|number| materials.get(number as usize)) {
            write_material(text, material);
        }
        write_face_set(text, &surfaces, origin);
        text.push_str("}\n");
    }
}

fn write_material(text: &mut String, material: &Material) {
    text.push_str("appearance Appearance { material ");
    let name = material.name.as_deref().map(encode).unwrap_or_default();
    // Writing to a string cannot fail, here and below.
    if !name.is_empty() {
        let _ = write!(text, "DEF {name} ");
    }
    text.push_str("Material {");
    let colors = [
        ("diffuseColor", material.diffuse),
        ("emissiveColor", material.emissive),
        ("specularColor", material.specular),
    ];
    for (field, [red, green, blue]) in colors {
        let _ = write!(text, " {field} {red} {green} {blue}");
    }
    let shares = [
        ("shininess", material.shininess),
        ("ambientIntensity", material.ambient_intensity),
        ("transparency", material.transparency),
    ];
    for (field, share) in shares {
        let _ = write!(text, " {field} {share}");
    }
    text.push_str(" } }\n");
}

/// Writes the faces that are left after rounding, and each position once. Which side is inside is
/// not known of every surface, so both are shown.
fn write_face_set(text: &mut String, surfaces: &[&Surface], origin: [f64; 3]) {
    let mut points = Points::default();
    let mut faces = String::new();
    for surface in surfaces {
        let ring = one_ring(surface, origin);
        if ring.len() < 3 {
            continue;
        }
        for point in ring {
            let _ = write!(faces, "{} ", points.number(point));
        }
        faces.push_str("-1\n");
    }
    text.push_str(
        "geometry IndexedFaceSet { solid FALSE convex FALSE coord Coordinate { point [\n",
    );
    for point in points.all {
        write_point(text, point);
        text.push('\n');
    }
    text.push_str("] } coordIndex [\n");
    text.push_str(&faces);
    text.push_str("] } ");
}

/// The ring of a surface, its holes joined to it.
fn one_ring(surface: &Surface, origin: [f64; 3]) -> Vec<GridPoint> {
    let grid = |ring: &Vec<[f64; 3]>| {
        let points = ring.iter().map(|position| on_grid(*position, origin));
        without_repetitions(points.collect())
    };
    let mut rings = surface.rings.iter().map(grid);
    let outer = rings.next().unwrap_or_default();
    let holes: Vec<_> = rings.filter(|hole| hole.len() > 2).collect();
    match outer.len() < 3 || holes.is_empty() {
        true => outer,
        false => without_repetitions(bridged(outer, holes)),
    }
}

/// The points of a face set, each once.
#[derive(Default)]
struct Points {
    all: Vec<GridPoint>,
    numbers: HashMap<GridPoint, usize>,
}

impl Points {
    fn number(&mut self, point: GridPoint) -> usize {
        *self.numbers.entry(point).or_insert_with(|| {
            self.all.push(point);
            self.all.len() - 1
        })
    }
}

fn without_repetitions(mut ring: Vec<GridPoint>) -> Vec<GridPoint> {
    ring.dedup();
    while ring.len() > 1 && ring.first() == ring.last() {
        ring.pop();
    }
    ring
}
