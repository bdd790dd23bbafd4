//! Elements as features and streets.

use std::collections::{HashMap, HashSet};
use std::ops::ControlFlow;

use super::block::{Member, MemberKind};
use super::building::{self, Block};
use super::gather::{Elements, Relation, Way};
use super::kind::Kind;
use super::nodes::Nodes;
use super::owners::owners;
use super::plan::Plans;
use super::tags::Tags;
use super::{street, structure};
use crate::batch::Batch;
use crate::error::Problem;
use crate::extrusion::{Appearance, Ends, Footprint, Plan, strips};
use crate::scene::{Changed, Feature, Geometry, Skipped, Street, Surface};

/// The elements of a file, sorted by what becomes of them.
pub(super) struct City<'a> {
    plans: Plans<'a>,
    /// What is given as it comes.
    others: Vec<Element<'a>>,
    buildings: Vec<Block<'a>>,
    parts: Vec<Block<'a>>,
    /// For each part the building that it belongs to.
    owners: Vec<Option<usize>>,
    skipped: Vec<Skipped>,
}

/// A way or a relation that is something in the scene.
#[derive(Clone, Copy)]
struct Element<'a> {
    kind: Kind,
    id: i64,
    tags: &'a Tags,
    form: Form<'a>,
}

/// Where the positions of an element are.
#[derive(Clone, Copy)]
enum Form<'a> {
    Way(&'a [i64]),
    Relation(&'a [Member]),
}

impl<'a> Element<'a> {
    fn of_relation(relation: &'a Relation) -> Option<Self> {
        let is_area = relation.tags.is("type", &["multipolygon"]);
        Some(Self {
            kind: Kind::of(&relation.tags).filter(|_| is_area)?,
            id: relation.id,
            tags: &relation.tags,
            form: Form::Relation(&relation.members),
        })
    }

    fn of_way(way: &'a Way) -> Option<Self> {
        let tags = way.tags.as_ref()?;
        Some(Self {
            kind: Kind::of(tags)?,
            id: way.id,
            tags,
            form: Form::Way(&way.nodes),
        })
    }

    fn name(&self) -> String {
        match self.form {
            Form::Way(_) => format!("way/{}", self.id),
            Form::Relation(_) => format!("relation/{}", self.id),
        }
    }

    fn skipped(&self, why: &str) -> Skipped {
        Skipped {
            name: self.name(),
            class: self.kind.class().to_owned(),
            why: why.to_owned(),
        }
    }

    fn areas(&self, plans: &Plans<'_>) -> Result<Vec<Footprint>, &'static str> {
        match self.form {
            Form::Way(nodes) => plans.area_of_way(nodes),
            Form::Relation(members) => plans.area_of_relation(members),
        }
    }

    fn lines(&self, plans: &Plans<'_>) -> Result<Vec<Vec<Plan>>, &'static str> {
        match self.form {
            Form::Way(nodes) => plans.lines(nodes),
            Form::Relation(_) => Err("a relation of a kind that is no area"),
        }
    }

    /// Whether its outline encloses what it is, rather than running along its middle.
    fn is_area(&self) -> bool {
        matches!(self.form, Form::Relation(_)) || self.tags.is("area", &["yes"])
    }
}

impl<'a> City<'a> {
    /// Sorts elements whose nodes are at these places.
    pub(super) fn new(elements: &'a Elements, nodes: Nodes) -> Result<Self, Problem> {
        let mut city = City {
            plans: Plans::new(nodes, elements)?,
            others: Vec::new(),
            buildings: Vec::new(),
            parts: Vec::new(),
            owners: Vec::new(),
            skipped: Vec::new(),
        };
        let drawn_twice = outer_ways(&elements.relations);
        let relations = elements.relations.iter().filter_map(Element::of_relation);
        relations.for_each(|element| city.add(element));
        for element in elements.ways.iter().filter_map(Element::of_way) {
            if drawn_twice.contains(&(element.id, element.kind.class())) {
                city.skipped
                    .push(element.skipped("the outline of a relation of the same kind"));
            } else {
                city.add(element);
            }
        }
        let related = related_parts(&elements.relations);
        city.owners = owners(&city.buildings, &city.parts, &related)?;
        Ok(city)
    }

    fn add(&mut self, element: Element<'a>) {
        let blocks = match element.kind {
            Kind::Building => &mut self.buildings,
            Kind::Part => &mut self.parts,
            _ => return self.others.push(element),
        };
        match element.areas(&self.plans) {
            Ok(areas) => blocks.push(Block {
                name: element.name(),
                tags: element.tags,
                areas,
            }),
            Err(why) => self.skipped.push(element.skipped(why)),
        }
    }

    /// Gives everything to the batch.
    pub(super) fn give(self, batch: &mut Batch<'_, '_>) -> ControlFlow<()> {
        for skipped in &self.skipped {
            batch.skipped(skipped.clone())?;
        }
        self.give_buildings(batch)?;
        for element in &self.others {
            let given = match element.kind {
                Kind::Street | Kind::Square => {
                    self.street(element).map(|street| batch.street(street))
                }
                _ => self
                    .structure(element)
                    .map(|feature| batch.feature(feature)),
            };
            given.unwrap_or_else(|why| batch.skipped(element.skipped(why)))?;
        }
        ControlFlow::Continue(())
    }

    fn give_buildings(&self, batch: &mut Batch<'_, '_>) -> ControlFlow<()> {
        let mut parts = vec![Vec::new(); self.buildings.len()];
        for (part, owner) in self.parts.iter().zip(&self.owners) {
            match owner {
                Some(building) => parts[*building].push(part),
                None => {
                    let note = "a part without a building around it, made a building";
                    give_building(part, &[], Some(note), batch)?;
                }
            }
        }
        let mut buildings = self.buildings.iter().zip(parts);
        buildings.try_for_each(|(building, parts)| give_building(building, &parts, None, batch))
    }

    fn street(&self, element: &Element<'_>) -> Result<Street, &'static str> {
        if let Some(why) = street::hidden(element.tags) {
            return Err(why);
        }
        let areas = match element.kind {
            Kind::Square => element.areas(&self.plans)?,
            _ => street::area(element.tags, &element.lines(&self.plans)?)?,
        };
        let surface = |area: &Footprint| Surface {
            rings: area.at(0.0),
            ..Surface::default()
        };
        Ok(Street {
            name: element.name(),
            class: element.kind.class().to_owned(),
            surfaces: areas.iter().map(surface).collect(),
        })
    }

    fn structure(&self, element: &Element<'_>) -> Result<Feature, &'static str> {
        let areas = if element.kind == Kind::Bridge || element.is_area() {
            element.areas(&self.plans)?
        } else {
            let width = structure::wall_width(element.tags);
            let areas = strips(&element.lines(&self.plans)?, width, Ends::Square)?;
            areas.iter().try_for_each(Footprint::check)?;
            areas
        };
        let solids = structure::solids(element.kind, element.tags, &areas)?;
        Ok(Feature {
            name: element.name(),
            class: element.kind.class().to_owned(),
            attributes: element.tags.attributes(),
            parts: Vec::new(),
            geometries: vec![Geometry {
                level_of_detail: 1.0,
                part: None,
                shape: Appearance::default().shape(solids),
                placement: None,
            }],
        })
    }
}

fn give_building(
    outline: &Block<'_>,
    parts: &[&Block<'_>],
    note: Option<&str>,
    batch: &mut Batch<'_, '_>,
) -> ControlFlow<()> {
    let built = building::build(outline, parts);
    for (name, why) in built.skipped {
        batch.skipped(Skipped {
            name,
            class: Kind::Part.class().to_owned(),
            why: why.to_owned(),
        })?;
    }
    let (name, class) = (&outline.name, Kind::Building.class());
    let feature = match built.feature {
        Ok(feature) => feature,
        Err(why) => {
            return batch.skipped(Skipped {
                name: name.clone(),
                class: class.to_owned(),
                why: why.to_owned(),
            });
        }
    };
    for how in built.notes.into_iter().chain(note.map(str::to_owned)) {
        batch.changed(Changed {
            name: name.clone(),
            class: class.to_owned(),
            how,
        })?;
    }
    batch.feature(feature)
}

/// The ways that are outer rings of areas, with the class of the area: older data says twice what
/// they are.
fn outer_ways(relations: &[Relation]) -> HashSet<(i64, &'static str)> {
    let outer = |member: &&Member| member.kind == MemberKind::Way && member.role != "inner";
    let ways = relations.iter().flat_map(|relation| {
        let class = Element::of_relation(relation).map(|element| element.kind.class());
        let ways = relation.members.iter().filter(outer);
        ways.filter_map(move |member| Some((member.id, class?)))
    });
    ways.collect()
}

/// The outline for each part that a relation of type building names.
fn related_parts(relations: &[Relation]) -> HashMap<String, String> {
    let name = |member: &Member| match member.kind {
        MemberKind::Node => None,
        MemberKind::Way => Some(format!("way/{}", member.id)),
        MemberKind::Relation => Some(format!("relation/{}", member.id)),
    };
    let mut outlines = HashMap::new();
    for relation in relations {
        let members = || relation.members.iter();
        let outlines_of = members().filter(|member| member.role == "outline");
        let is_building = relation.tags.is("type", &["building"]);
        let Some(outline) = outlines_of.filter(|_| is_building).find_map(name) else {
            continue;
        };
        let parts = members().filter(|member| member.role == "part");
        let parts = parts.filter_map(name);
        outlines.extend(parts.map(|part| (part, outline.clone())));
    }
    outlines
}
