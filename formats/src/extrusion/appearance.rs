//! [`Appearance`]: what extruded solids look like and mean.

use std::sync::Arc;

use serde_json::{Map, Value};

use super::{Extruded, Rings};
use crate::scene::{Material, Semantic, Shape, Surface};

/// Colours of a building, sRGB from 0 to 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Appearance {
    /// Colour of the walls.
    pub(crate) wall: Option<[f64; 3]>,
    /// Colour of the roof.
    pub(crate) roof: Option<[f64; 3]>,
}

/// The meanings, in the order of their indices.
const CLASSES: [&str; 4] = [
    "WallSurface",
    "RoofSurface",
    "GroundSurface",
    "OuterCeilingSurface",
];
const WALL: u32 = 0;
const ROOF: u32 = 1;
const GROUND: u32 = 2;
const CEILING: u32 = 3;

impl Appearance {
    /// A shape of solids; those that are raised stand on air, so that their undersides are seen.
    pub(crate) fn shape(&self, solids: Vec<(Extruded, bool)>) -> Arc<Shape> {
        let colours = [("wall", self.wall), ("roof", self.roof)];
        let mut materials: Vec<Material> = Vec::new();
        let [wall, roof] = colours.map(|(name, colour)| {
            materials.push(Material {
                name: Some(name.to_owned()),
                diffuse: colour?,
                ..Material::default()
            });
            u32::try_from(materials.len() - 1).ok()
        });
        let mut surfaces = Vec::new();
        let mut add = |rings: Rings, material, class| {
            surfaces.push(Surface {
                rings,
                material,
                semantic: Some(class),
            });
        };
        for (solid, is_raised) in solids {
            add(solid.bottom, wall, if is_raised { CEILING } else { GROUND });
            solid
                .walls
                .into_iter()
                .for_each(|rings| add(rings, wall, WALL));
            solid
                .roofs
                .into_iter()
                .for_each(|rings| add(rings, roof, ROOF));
        }
        let semantic = |class: &str| Semantic {
            class: class.to_owned(),
            attributes: Value::Object(Map::new()),
        };
        Arc::new(Shape {
            surfaces,
            materials,
            semantics: CLASSES.map(semantic).into(),
        })
    }
}
