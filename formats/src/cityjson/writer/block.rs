//! Objects with the vertices and materials that they use: a whole document's or one line's.

use std::collections::HashSet;

use super::classes::{part_class, root_class};
use super::frame::{Frame, VertexList, anchor};
use super::geometry::stored_geometry;
use super::materials::Materials;
use super::stored::{CityObject, Instance, StoredGeometry};
use super::templates::Templates;
use crate::placement::Placement;
use crate::scene::{Geometry, Model};

/// Objects under way.
pub(super) struct Block<'a> {
    frame: &'a Frame,
    pub(super) objects: Vec<(String, CityObject<'a>)>,
    pub(super) vertices: VertexList<[i64; 3], [i64; 3]>,
    pub(super) materials: Materials<'a>,
}

impl<'a> Block<'a> {
    /// No objects yet.
    pub(super) fn new(frame: &'a Frame, materials: Materials<'a>) -> Self {
        Self {
            frame,
            objects: Vec::new(),
            vertices: VertexList::new(),
            materials,
        }
    }

    /// Adds a feature, its root first, and gives the identifier of the root.
    pub(super) fn add(
        &mut self,
        model: &'a Model,
        templates: &Templates<'a>,
        names: &mut Names,
    ) -> String {
        let feature = &model.feature;
        let root = names.take(&feature.name, model.id);
        let parts = feature.parts.iter();
        let parts: Vec<_> = parts
            .map(|part| (part, names.take(&part.name, model.id)))
            .collect();
        let is_of_a_part = |geometry: &&Geometry| {
            let name = geometry.part.as_ref();
            name.is_some_and(|name| feature.parts.iter().any(|part| part.name == *name))
        };
        let of_root = feature
            .geometries
            .iter()
            .filter(|geometry| !is_of_a_part(geometry));
        let object = CityObject {
            class: root_class(&feature.class),
            attributes: non_empty(&feature.attributes),
            children: parts.iter().map(|(_, name)| name.clone()).collect(),
            parents: Vec::new(),
            geometry: of_root
                .map(|geometry| self.geometry(geometry, templates))
                .collect(),
        };
        self.objects.push((root.clone(), object));
        for (part, name) in parts {
            let of_part = feature.geometries.iter();
            let of_part = of_part.filter(|geometry| geometry.part.as_ref() == Some(&part.name));
            let object = CityObject {
                class: part_class(&part.class, &feature.class),
                attributes: non_empty(&part.attributes),
                children: Vec::new(),
                parents: vec![root.clone()],
                geometry: of_part
                    .map(|geometry| self.geometry(geometry, templates))
                    .collect(),
            };
            self.objects.push((name, object));
        }
        root
    }

    fn geometry(&mut self, geometry: &'a Geometry, templates: &Templates<'a>) -> StoredGeometry {
        if let Some(placement) = &geometry.placement
            && let Some(template) = templates.index(geometry)
        {
            return StoredGeometry::Instance(self.instance(template, placement));
        }
        let (frame, vertices) = (self.frame, &mut self.vertices);
        let mut vertex = |position| {
            let stored = frame.stored(position);
            vertices.index(stored, stored)
        };
        stored_geometry(
            geometry.level_of_detail,
            &geometry.shape,
            &geometry.surfaces(),
            &mut vertex,
            &mut self.materials,
        )
    }

    /// The anchor takes the whole way, the matrix what rounding it leaves.
    fn instance(&mut self, template: usize, placement: &Placement) -> Instance {
        let stored = self.frame.stored(anchor(placement));
        let rounded = self.frame.position(stored);
        let [x, y, z] = [0, 1, 2].map(|i| {
            let [a, b, c, by] = placement.rows[i];
            [a, b, c, by - rounded[i]]
        });
        let rows = [x, y, z, [0.0, 0.0, 0.0, 1.0]];
        Instance {
            kind: "GeometryInstance",
            template,
            boundaries: [self.vertices.index(stored, stored)],
            transformation_matrix: std::array::from_fn(|i| rows[i / 4][i % 4]),
        }
    }
}

fn non_empty(attributes: &serde_json::Value) -> Option<&serde_json::Value> {
    let is_empty = attributes.as_object().is_none_or(serde_json::Map::is_empty);
    (!is_empty).then_some(attributes)
}

/// Identifiers of a file so far.
#[derive(Default)]
pub(super) struct Names {
    taken: HashSet<String>,
}

impl Names {
    /// The name, or where it is taken the name with the model's number, and further numbers as long
    /// as that is taken too.
    fn take(&mut self, name: &str, model: i64) -> String {
        let mut free = name.to_owned();
        while !self.taken.insert(free.clone()) {
            free = format!("{free}-{model}");
        }
        free
    }
}
