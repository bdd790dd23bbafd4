//! Elements in metres: areas and lines.

use std::collections::HashMap;

use super::block::{Member, MemberKind};
use super::gather::{Elements, Way};
use super::nodes::Nodes;
use super::rings::rings;
use crate::error::Problem;
use crate::extrusion::{Footprint, Plan, is_inside, line_string};

/// Most outer rings of one relation: each hole is compared with each.
const MAX_OUTER_RINGS: usize = 1000;

/// Most nodes of members of relations together: many relations can name one long way.
const MAX_MEMBER_NODES: u64 = 10_000_000;

/// Why an element at the edge of an extract has no form.
const MISSING_NODE: &str = "a node is missing";

/// Where nodes and ways are.
pub(super) struct Plans<'a> {
    nodes: Nodes,
    ways: HashMap<i64, &'a [i64]>,
}

impl<'a> Plans<'a> {
    /// Of nodes in metres and the ways of a file.
    pub(super) fn new(nodes: Nodes, elements: &'a Elements) -> Result<Self, Problem> {
        let way = |way: &'a Way| (way.id, way.nodes.as_slice());
        let ways: HashMap<_, _> = elements.ways.iter().map(way).collect();
        let members = elements
            .relations
            .iter()
            .flat_map(|relation| &relation.members);
        let lengths = members.filter_map(|member| Some(ways.get(&member.id)?.len() as u64));
        let found = lengths.sum();
        match found > MAX_MEMBER_NODES {
            true => Err(Problem::Limit {
                what: "nodes of members of relations",
                found,
                limit: MAX_MEMBER_NODES,
            }),
            false => Ok(Self { nodes, ways }),
        }
    }

    /// The area of a closed way.
    pub(super) fn area_of_way(&self, nodes: &[i64]) -> Result<Vec<Footprint>, &'static str> {
        if nodes.len() < 4 || nodes.first() != nodes.last() {
            return Err("the way is not closed");
        }
        Ok(vec![Footprint::new(self.ring(nodes)?, Vec::new())?])
    }

    /// The areas of a multipolygon.
    pub(super) fn area_of_relation(
        &self,
        members: &[Member],
    ) -> Result<Vec<Footprint>, &'static str> {
        let outer = self.rings_of(members, |role| role != "inner")?;
        let inner = self.rings_of(members, |role| role == "inner")?;
        if outer.len() > MAX_OUTER_RINGS {
            return Err("the relation has more than 1000 outer rings");
        }
        let area = |ring: &Vec<Plan>| geo::Polygon::new(line_string(ring), vec![]);
        let areas: Vec<_> = outer.iter().map(area).collect();
        let mut holes = vec![Vec::new(); outer.len()];
        for ring in inner {
            let around = areas.iter().position(|area| is_inside(&ring, area));
            let around = around.ok_or("a hole is not inside of the outline")?;
            holes[around].push(ring);
        }
        let areas = outer
            .into_iter()
            .zip(holes)
            .map(|(outer, holes)| Footprint::new(outer, holes));
        let areas = areas.collect::<Result<Vec<_>, _>>()?;
        match areas.is_empty() {
            true => Err("the relation has no outer ring"),
            false => Ok(areas),
        }
    }

    /// A way in pieces: nodes outside of an extract are missing.
    pub(super) fn lines(&self, nodes: &[i64]) -> Result<Vec<Vec<Plan>>, &'static str> {
        let places: Vec<_> = nodes.iter().map(|node| self.nodes.get(*node)).collect();
        let pieces = places.split(Option::is_none);
        let pieces = pieces.map(|piece| piece.iter().flatten().copied().collect::<Vec<_>>());
        let pieces: Vec<_> = pieces.filter(|piece| piece.len() >= 2).collect();
        match pieces.is_empty() && places.contains(&None) {
            true => Err(MISSING_NODE),
            false => Ok(pieces),
        }
    }

    fn ring(&self, nodes: &[i64]) -> Result<Vec<Plan>, &'static str> {
        let place = |node: &i64| self.nodes.get(*node).ok_or(MISSING_NODE);
        nodes.iter().map(place).collect()
    }

    fn rings_of(
        &self,
        members: &[Member],
        takes: impl Fn(&str) -> bool,
    ) -> Result<Vec<Vec<Plan>>, &'static str> {
        let ways = members
            .iter()
            .filter(|member| member.kind == MemberKind::Way);
        let ways = ways.filter(|member| takes(&member.role));
        let way = |member: &Member| self.ways.get(&member.id).copied().ok_or("a way is missing");
        let ways = ways.map(way).collect::<Result<Vec<_>, _>>()?;
        rings(&ways)?.iter().map(|ring| self.ring(ring)).collect()
    }
}
