//! What a file holds of the scene, in three passes: relations, then the ways that they or their own
//! tags ask for, then the nodes of those ways. So only what is needed is kept, whatever the order.

use std::collections::{HashMap, HashSet};

use super::blob::Blobs;
use super::block::{Block, Member, MemberKind};
use super::kind::{Kind, is_telling};
use super::tags::Tags;
use super::wire::Broken;
use crate::error::Problem;
use crate::input::Input;
use crate::limits::Limits;

/// Most nodes of ways and members of relations that are kept; 40 bytes each.
const MAX_REFERENCES: u64 = 10_000_000;

/// Most memory of the tags that are kept, bytes.
const MAX_TAG_BYTES: u64 = 256 << 20;

/// A line or ring.
#[derive(Debug)]
pub(super) struct Way {
    /// Its number.
    pub(super) id: i64,
    /// The numbers of its nodes.
    pub(super) nodes: Vec<i64>,
    /// Its tags, where it is more than a member of a relation.
    pub(super) tags: Option<Tags>,
}

/// A relation of interest.
#[derive(Debug)]
pub(super) struct Relation {
    /// Its number.
    pub(super) id: i64,
    /// Its tags.
    pub(super) tags: Tags,
    /// What it holds together.
    pub(super) members: Vec<Member>,
}

/// The elements that the scene is made of.
#[derive(Debug, Default)]
pub(super) struct Elements {
    /// The relations, in the order of the file.
    pub(super) relations: Vec<Relation>,
    /// The ways, in the order of the file.
    pub(super) ways: Vec<Way>,
    /// Longitude and latitude of each node that is there.
    pub(super) nodes: HashMap<i64, [f64; 2]>,
    references: u64,
    objects: u64,
    tag_bytes: u64,
}

impl Elements {
    /// Reads all that the scene needs.
    pub(super) fn gather(input: &mut dyn Input, limits: &Limits) -> Result<Self, Problem> {
        let mut elements = Self::default();
        each_block(input, limits, &mut |block| {
            elements.add_relations(block, limits)
        })?;
        let members = elements
            .relations
            .iter()
            .flat_map(|relation| &relation.members);
        let ways = members.filter(|member| member.kind == MemberKind::Way);
        let wanted: HashSet<i64> = ways.map(|member| member.id).collect();
        each_block(input, limits, &mut |block| {
            elements.add_ways(block, &wanted, limits)
        })?;
        drop(wanted);
        let mut nodes: HashMap<i64, [f64; 2]> = HashMap::new();
        for node in elements.ways.iter().flat_map(|way| &way.nodes) {
            nodes.insert(*node, [f64::NAN; 2]);
        }
        each_block(input, limits, &mut |block| {
            let mut visit = |id, position| {
                if let Some(place) = nodes.get_mut(&id) {
                    *place = position;
                }
            };
            block.each_node(&mut visit).map_err(Stop::Broken)
        })?;
        nodes.retain(|_, position| !position[0].is_nan());
        elements.nodes = nodes;
        Ok(elements)
    }

    fn add_relations(&mut self, block: &Block<'_>, limits: &Limits) -> Result<(), Stop> {
        for record in block.relations() {
            let record = record?;
            let Some(tags) = block.tags(&record, |key| key == b"type")? else {
                continue;
            };
            let area = tags.is("type", &["multipolygon"]) && Kind::of(&tags).is_some();
            if !area && !tags.is("type", &["building"]) {
                continue;
            }
            let members = block.members(&record)?;
            self.spend(members.len(), tags.bytes(), limits)?;
            self.relations.push(Relation {
                id: record.id,
                tags,
                members,
            });
        }
        Ok(())
    }

    fn add_ways(
        &mut self,
        block: &Block<'_>,
        wanted: &HashSet<i64>,
        limits: &Limits,
    ) -> Result<(), Stop> {
        for record in block.ways() {
            let record = record?;
            let tags = block.tags(&record, is_telling)?;
            let tags = tags.filter(|tags| Kind::of(tags).is_some());
            if tags.is_none() && !wanted.contains(&record.id) {
                continue;
            }
            let nodes = record.nodes().collect::<Result<Vec<_>, _>>()?;
            self.spend(nodes.len(), tags.as_ref().map_or(0, Tags::bytes), limits)?;
            self.ways.push(Way {
                id: record.id,
                nodes,
                tags,
            });
        }
        Ok(())
    }

    fn spend(&mut self, references: usize, tag_bytes: usize, limits: &Limits) -> Result<(), Stop> {
        self.objects += 1;
        self.references += references as u64;
        self.tag_bytes += tag_bytes as u64;
        within("objects", self.objects, limits.objects)?;
        within(
            "nodes of ways and members of relations",
            self.references,
            MAX_REFERENCES,
        )?;
        within("bytes of tags", self.tag_bytes, MAX_TAG_BYTES)
    }
}

/// Why the reading of a block stops.
enum Stop {
    Broken(Broken),
    Problem(Problem),
}

impl From<Broken> for Stop {
    fn from(broken: Broken) -> Self {
        Self::Broken(broken)
    }
}

fn within(what: &'static str, found: u64, limit: u64) -> Result<(), Stop> {
    match found > limit {
        true => Err(Stop::Problem(Problem::Limit { what, found, limit })),
        false => Ok(()),
    }
}

/// Reads a file from its start and shows each block.
fn each_block(
    input: &mut dyn Input,
    limits: &Limits,
    visit: &mut dyn FnMut(&Block<'_>) -> Result<(), Stop>,
) -> Result<(), Problem> {
    let mut blobs = Blobs::open(input, limits.input_bytes)?;
    while let Some((offset, bytes)) = blobs.next()? {
        let result = Block::parse(bytes)
            .map_err(Stop::Broken)
            .and_then(|block| visit(&block));
        result.map_err(|stop| match stop {
            Stop::Broken(broken) => broken.at("the block", offset),
            Stop::Problem(problem) => problem,
        })?;
    }
    Ok(())
}
