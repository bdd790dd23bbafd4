//! Objects with the vertices that they use, a whole document's or one line's, turned into features,
//! streets and what is skipped.

use std::collections::HashSet;
use std::hash::{BuildHasher, RandomState};
use std::ops::ControlFlow;

use super::appearance::Appearance;
use super::batches::Batches;
use super::budget::Budget;
use super::family::{Family, read_family};
use super::geometry::Lists;
use super::header::Header;
use super::hierarchy::Hierarchy;
use super::json::Members;
use super::object::CityObject;
use super::vertices::Vertices;
use crate::error::{FormatError, Location, Problem, quote};
use crate::scene::{Feature, Geometry, Skipped, Street, Surface};

/// A scene under way.
pub(super) struct Reader<'b> {
    header: &'b Header,
    budget: Budget<'b>,
    batches: Batches<'b>,
    names: Names,
}

impl<'b> Reader<'b> {
    /// A scene without objects yet.
    pub(super) fn new(header: &'b Header, budget: Budget<'b>, mut batches: Batches<'b>) -> Self {
        batches.batch.degenerate_rings += header.templates.degenerate_rings();
        Self {
            header,
            budget,
            batches,
            names: Names::default(),
        }
    }

    /// Hands over what is left.
    pub(super) fn finish(self) {
        self.batches.finish();
    }

    /// Adds the objects of a document or of a line, which is at `place`.
    pub(super) fn add(
        &mut self,
        members: &Members<'_>,
        place: &Location,
    ) -> Result<ControlFlow<()>, FormatError> {
        let here = |problem| place.error(problem);
        let list = members.require("vertices", "vertices").map_err(here)?;
        let limit = self.budget.limits.vertices;
        let transform = self.header.transform;
        let vertices = Vertices::parse("vertex", list, transform, limit).map_err(here)?;
        let objects = self.objects(members, place)?;
        let hierarchy = Hierarchy::of(&objects)
            .map_err(|(i, problem)| place.object(&objects[i].id).error(problem))?;
        let own = members.get("appearance").map(Appearance::parse);
        let lists = Lists {
            vertices: &vertices,
            appearance: own.as_ref().unwrap_or(&self.header.appearance),
        };
        for root in hierarchy.roots() {
            let family: Vec<_> = hierarchy
                .family(root)
                .iter()
                .map(|i| &objects[*i])
                .collect();
            if self.add_root(&family, &lists, place)?.is_break() {
                return Ok(ControlFlow::Break(()));
            }
        }
        Ok(ControlFlow::Continue(()))
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
            if !self.names.insert(&id) {
                return Err(at(Problem::Duplicate { name: quote(&id) }));
            }
            objects.push(CityObject::parse(id.clone(), raw).map_err(at)?);
        }
        Ok(objects)
    }

    /// Adds a root, the first of its family, as what it is.
    fn add_root(
        &mut self,
        family: &[&CityObject<'_>],
        lists: &Lists<'_>,
        place: &Location,
    ) -> Result<ControlFlow<()>, FormatError> {
        let [root, ..] = family else {
            return Ok(ControlFlow::Continue(()));
        };
        let (name, class) = (root.id.to_string(), root.class.to_string());
        if root.is_terrain() {
            return Ok(self.skip(name, class, "terrain"));
        }
        self.budget.start_feature();
        let templates = &self.header.templates;
        let read = read_family(family, templates, lists, &mut self.budget, place)?;
        let mut bytes = self.budget.feature_bytes();
        let batch = &mut self.batches.batch;
        batch.degenerate_rings += read.losses.degenerate_rings;
        if read.geometries.is_empty() {
            let why = if root.is_group() {
                "a group of other objects"
            } else {
                read.why_none
            };
            return Ok(self.skip(name, class, why));
        }
        batch.changed.extend(read.losses.changes(&name, &class));
        let Family {
            attributes,
            parts,
            geometries,
            ..
        } = read;
        if root.is_street() {
            let surfaces = finest_surfaces(geometries);
            bytes += self.budget.placed_bytes();
            batch.streets.push(Street {
                name,
                class,
                surfaces,
            });
        } else {
            batch.features.push(Feature {
                name,
                class,
                attributes,
                parts,
                geometries,
            });
        }
        Ok(self.batches.grow(bytes))
    }

    fn skip(&mut self, name: String, class: String, why: &str) -> ControlFlow<()> {
        let bytes = 100 + name.len() + class.len();
        let why = why.to_owned();
        self.batches
            .batch
            .skipped
            .push(Skipped { name, class, why });
        self.batches.grow(bytes)
    }
}

/// The identifiers of a file so far, since lines are read one by one. What is kept of each is two
/// keyed hashes: 128 bits that no file can make collide on purpose.
#[derive(Default)]
struct Names {
    seen: HashSet<(u64, u64)>,
    hashers: [RandomState; 2],
}

impl Names {
    /// False if the identifier was there already.
    fn insert(&mut self, id: &str) -> bool {
        let [a, b] = &self.hashers;
        self.seen.insert((a.hash_one(id), b.hash_one(id)))
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
        let bare = |surface: &Surface| Surface {
            rings: surface.rings.clone(),
            ..Surface::default()
        };
        for geometry in finest {
            surfaces.extend(geometry.surfaces().iter().map(bare));
        }
    }
    surfaces
}
