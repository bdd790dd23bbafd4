//! What a file holds of the scene, in three passes: relations, then the ways that they or their own
//! tags ask for, then the nodes of those ways. So only what is needed is kept, whatever the order.

use std::collections::HashSet;

use super::blob::Blobs;
use super::block::{Block, Member, MemberKind};
use super::kind::{Kind, is_telling};
use super::nodes::Nodes;
use super::tags::Tags;
use super::wire::Broken;
use crate::error::Problem;
use crate::input::Input;
use crate::limits::Limits;

/// Most ways and relations that are kept; up to 80 bytes each.
const MAX_ELEMENTS: u64 = 3_000_000;

/// Most nodes of ways and members of relations that are kept; up to 40 bytes each.
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
    pub(super) nodes: Nodes,
    references: u64,
    elements: u64,
    tag_bytes: u64,
}

impl Elements {
    /// Reads all that the scene needs.
    pub(super) fn gather(input: &mut dyn Input, limits: &Limits) -> Result<Self, Problem> {
        let mut elements = Self::default();
        each_block(input, limits, &mut |block| elements.add_relations(block))?;
        let members = elements
            .relations
            .iter()
            .flat_map(|relation| &relation.members);
        let ways = members.filter(|member| member.kind == MemberKind::Way);
        let wanted: HashSet<i64> = ways.map(|member| member.id).collect();
        each_block(input, limits, &mut |block| {
            elements.add_ways(block, &wanted)
        })?;
        drop(wanted);
        let ids = elements.ways.iter().flat_map(|way| &way.nodes).copied();
        let mut nodes = Nodes::wanted(ids.collect());
        each_block(input, limits, &mut |block| {
            let put = &mut |id, place| nodes.put(id, place);
            block.each_node(put).map_err(Stop::Broken)
        })?;
        elements.nodes = nodes;
        Ok(elements)
    }

    fn add_relations(&mut self, block: &Block<'_>) -> Result<(), Stop> {
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
            self.spend(members.len(), tags.bytes())?;
            self.relations.push(Relation {
                id: record.id,
                tags,
                members,
            });
        }
        Ok(())
    }

    fn add_ways(&mut self, block: &Block<'_>, wanted: &HashSet<i64>) -> Result<(), Stop> {
        for record in block.ways() {
            let record = record?;
            let tags = block.tags(&record, is_telling)?;
            let tags = tags.filter(|tags| Kind::of(tags).is_some());
            if tags.is_none() && !wanted.contains(&record.id) {
                continue;
            }
            let nodes = record.nodes().collect::<Result<Vec<_>, _>>()?;
            self.spend(nodes.len(), tags.as_ref().map_or(0, Tags::bytes))?;
            self.ways.push(Way {
                id: record.id,
                nodes,
                tags,
            });
        }
        Ok(())
    }

    fn spend(&mut self, references: usize, tag_bytes: usize) -> Result<(), Stop> {
        self.elements += 1;
        self.references += references as u64;
        self.tag_bytes += tag_bytes as u64;
        within("ways and relations", self.elements, MAX_ELEMENTS)?;
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
