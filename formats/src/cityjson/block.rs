//! Objects with the vertices that they use, a whole document's or one line's, turned into features,
//! streets and what is skipped.

use std::collections::HashSet;
use std::sync::Arc;

use super::geometry::read_geometry;
use super::header::Header;
use super::hierarchy::Hierarchy;
use super::json::Members;
use super::object::CityObject;
use super::vertices::Vertices;
use crate::error::{FormatError, Location, Problem, quote};
use crate::limits::Budget;
use crate::scene::{Feature, Geometry, SceneDescription, Shape, Skipped, Street, Surface};

/// A scene under way.
#[derive(Debug)]
pub(super) struct SceneBuilder<'b> {
    header: &'b Header,
    budget: Budget,
    scene: SceneDescription,
    /// Identifiers so far, since lines are read one by one.
    ids: HashSet<String>,
}

/// Objects with what their geometries refer to.
struct Objects<'a, 'b> {
    objects: &'b [CityObject<'a>],
    hierarchy: &'b Hierarchy,
    vertices: &'b Vertices,
}

/// The surfaces of a root and its descendants.
#[derive(Debug)]
struct FamilyGeometry {
    geometries: Vec<Geometry>,
    /// Why there is no geometry, where there is none.
    why_none: &'static str,
}

impl<'b> SceneBuilder<'b> {
    /// A scene without objects yet.
    pub(super) fn new(header: &'b Header, budget: Budget) -> Self {
        let scene = SceneDescription {
            srid: header.srid,
            title: header.title.clone(),
            attribution: header.attribution.clone(),
            ..SceneDescription::default()
        };
        Self {
            header,
            budget,
            scene,
            ids: HashSet::new(),
        }
    }

    /// The finished scene.
    pub(super) fn finish(self) -> SceneDescription {
        self.scene
    }

    /// Adds the objects of a document or of a line, which is at `place`.
    pub(super) fn add<'a>(
        &mut self,
        members: &Members<'a>,
        place: &Location,
    ) -> Result<(), FormatError> {
        let here = |problem| place.error(problem);
        let list = members.require("vertices", "vertices").map_err(here)?;
        let vertices = Vertices::parse("vertex", list, self.header.transform).map_err(here)?;
        self.budget.vertices(vertices.len()).map_err(here)?;
        let objects = self.objects(members, place)?;
        let hierarchy = Hierarchy::of(&objects)
            .map_err(|(i, problem)| place.object(&objects[i].id).error(problem))?;
        let excerpt = Objects {
            objects: &objects,
            hierarchy: &hierarchy,
            vertices: &vertices,
        };
        hierarchy
            .roots()
            .try_for_each(|root| self.add_root(root, &excerpt, place))
    }

    /// Takes the member `CityObjects` apart.
    fn objects<'a>(
        &mut self,
        members: &Members<'a>,
        place: &Location,
    ) -> Result<Vec<CityObject<'a>>, FormatError> {
        let here = |problem| place.error(problem);
        let raw = members
            .require("CityObjects", "CityObjects")
            .map_err(here)?;
        let members = Members::of("CityObjects", raw).map_err(here)?.into_vec();
        self.budget.objects(members.len()).map_err(here)?;
        let mut objects = Vec::with_capacity(members.len());
        for (id, raw) in members {
            let at = |problem| place.object(&id).error(problem);
            if !self.ids.insert(id.to_string()) {
                return Err(at(Problem::Duplicate { name: quote(&id) }));
            }
            objects.push(CityObject::parse(id.clone(), raw).map_err(at)?);
        }
        Ok(objects)
    }

    /// Adds one root with its descendants as what it is.
    fn add_root<'a>(
        &mut self,
        root: usize,
        excerpt: &Objects<'a, '_>,
        place: &Location,
    ) -> Result<(), FormatError> {
        let object = &excerpt.objects[root];
        let (name, class) = (object.id.to_string(), object.class.to_string());
        if object.is_terrain() {
            self.scene.skipped.push(Skipped {
                name,
                class,
                why: "terrain".to_owned(),
            });
            return Ok(());
        }
        let family = excerpt.hierarchy.family(root);
        let FamilyGeometry {
            geometries,
            why_none,
        } = self.geometries(&family, excerpt, place)?;
        if geometries.is_empty() {
            let why = if object.is_group() {
                "a group of other objects"
            } else {
                why_none
            };
            self.scene.skipped.push(Skipped {
                name,
                class,
                why: why.to_owned(),
            });
        } else if object.is_street() {
            let surfaces = finest_surfaces(geometries);
            self.scene.streets.push(Street {
                name,
                class,
                surfaces,
            });
        } else {
            let at = |problem| place.object(&name).error(problem);
            let attributes = object.attributes().map_err(at)?;
            self.scene.features.push(Feature {
                name,
                class,
                attributes,
                parts: Vec::new(),
                geometries,
            });
        }
        Ok(())
    }

    /// Reads all geometries of a root and its descendants.
    fn geometries<'a>(
        &mut self,
        family: &[usize],
        excerpt: &Objects<'a, '_>,
        place: &Location,
    ) -> Result<FamilyGeometry, FormatError> {
        let mut all = FamilyGeometry {
            geometries: Vec::new(),
            why_none: "no geometry",
        };
        let root = &excerpt.objects[family[0]];
        for object in family.iter().map(|i| &excerpt.objects[*i]) {
            for (number, raw) in object.geometries.iter().enumerate() {
                let read = Members::of("geometry", raw).and_then(|members| {
                    let dropped = &mut self.scene.degenerate_rings;
                    read_geometry(
                        &members,
                        self.header,
                        excerpt.vertices,
                        &mut self.budget,
                        dropped,
                    )
                });
                let at = |problem| place.object(&object.id).geometry(number).error(problem);
                let read = read.map_err(at)?;
                if read.is_surface {
                    all.why_none = "no surface with three distinct vertices";
                } else if all.why_none == "no geometry" {
                    all.why_none = "only points or lines";
                }
                if !read.surfaces.is_empty() {
                    all.geometries.push(Geometry {
                        level_of_detail: read.level_of_detail,
                        part: (object.id != root.id).then(|| object.id.to_string()),
                        shape: Arc::new(Shape {
                            surfaces: read.surfaces,
                            ..Shape::default()
                        }),
                        placement: None,
                    });
                }
            }
        }
        Ok(all)
    }
}

/// The surfaces of each part's highest level of detail; a part's geometries stand together.
fn finest_surfaces(geometries: Vec<Geometry>) -> Vec<Surface> {
    let mut surfaces = Vec::new();
    for part in geometries.chunk_by(|a, b| a.part == b.part) {
        let levels = part.iter().map(|geometry| geometry.level_of_detail);
        let finest = levels.fold(0.0, f64::max);
        let finest = part
            .iter()
            .filter(|geometry| geometry.level_of_detail == finest);
        surfaces.extend(finest.flat_map(|geometry| geometry.surfaces().into_owned()));
    }
    surfaces
}
