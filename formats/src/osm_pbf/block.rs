//! A block of nodes, ways and relations.

use super::tags::Tags;
use super::wire::{Broken, Deltas, Fields, Packed, signed};

/// Most strings of one block: real ones have some thousands.
const MAX_STRINGS: usize = 1 << 20;

/// Kinds of elements, by the number of their field.
const NODE: u32 = 1;
const DENSE_NODES: u32 = 2;
const WAY: u32 = 3;
const RELATION: u32 = 4;

/// Degrees in a unit of the format.
const NANODEGREE: f64 = 1e-9;

/// A block, taken apart as far as all its elements need.
pub(super) struct Block<'a> {
    strings: Vec<&'a [u8]>,
    groups: Vec<&'a [u8]>,
    granularity: i64,
    latitude_offset: i64,
    longitude_offset: i64,
}

/// A way or a relation with its tags still packed.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Record<'a> {
    /// Its number.
    pub(super) id: i64,
    keys: &'a [u8],
    values: &'a [u8],
    /// A way's nodes, a relation's roles: the format gives both the same number.
    nodes_or_roles: &'a [u8],
    members: &'a [u8],
    kinds: &'a [u8],
}

/// A part of a relation.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Member {
    /// What it is.
    pub(super) kind: MemberKind,
    /// Its number.
    pub(super) id: i64,
    /// What it is there for, such as `outer`.
    pub(super) role: String,
}

/// What a member of a relation is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum MemberKind {
    /// A position.
    Node,
    /// A line or ring.
    Way,
    /// Another relation.
    Relation,
}

impl<'a> Block<'a> {
    /// The block in these bytes.
    pub(super) fn parse(bytes: &'a [u8]) -> Result<Self, Broken> {
        let mut block = Self {
            strings: Vec::new(),
            groups: Vec::new(),
            granularity: 100,
            latitude_offset: 0,
            longitude_offset: 0,
        };
        for field in Fields(bytes) {
            match field? {
                (1, table) => block.add_strings(table.bytes()?)?,
                (2, group) => block.groups.push(group.bytes()?),
                (17, value) => block.granularity = value.number()? as i64,
                (19, value) => block.latitude_offset = value.number()? as i64,
                (20, value) => block.longitude_offset = value.number()? as i64,
                _ => (),
            }
        }
        Ok(block)
    }

    fn add_strings(&mut self, table: &'a [u8]) -> Result<(), Broken> {
        for field in Fields(table) {
            if let (1, string) = field? {
                self.strings.push(string.bytes()?);
            }
            if self.strings.len() > MAX_STRINGS {
                return Err(Broken("it has more than 1048576 strings"));
            }
        }
        Ok(())
    }

    /// Gives each node with its longitude and latitude in degrees.
    pub(super) fn each_node(&self, visit: &mut dyn FnMut(i64, [f64; 2])) -> Result<(), Broken> {
        self.elements(NODE)
            .try_for_each(|node| self.node(node?, visit))?;
        self.elements(DENSE_NODES)
            .try_for_each(|nodes| self.dense_nodes(nodes?, visit))
    }

    /// The ways.
    pub(super) fn ways(&self) -> impl Iterator<Item = Result<Record<'a>, Broken>> + '_ {
        self.elements(WAY).map(|way| Record::parse(way?))
    }

    /// The relations.
    pub(super) fn relations(&self) -> impl Iterator<Item = Result<Record<'a>, Broken>> + '_ {
        self.elements(RELATION)
            .map(|relation| Record::parse(relation?))
    }

    /// The elements of a kind.
    fn elements(&self, kind: u32) -> impl Iterator<Item = Result<&'a [u8], Broken>> + '_ {
        let fields = self.groups.iter().flat_map(|group| Fields(group));
        fields.filter_map(move |field| match field {
            Ok((found, value)) => (found == kind).then(|| value.bytes()),
            Err(broken) => Some(Err(broken)),
        })
    }

    fn node(&self, bytes: &[u8], visit: &mut dyn FnMut(i64, [f64; 2])) -> Result<(), Broken> {
        let (mut id, mut latitude, mut longitude) = (None, None, None);
        for field in Fields(bytes) {
            match field? {
                (1, value) => id = Some(signed(value.number()?)),
                (8, value) => latitude = Some(signed(value.number()?)),
                (9, value) => longitude = Some(signed(value.number()?)),
                _ => (),
            }
        }
        match (id, latitude, longitude) {
            (Some(id), Some(latitude), Some(longitude)) => {
                visit(id, self.degrees(longitude, latitude)?);
                Ok(())
            }
            _ => Err(Broken("a node lacks number or position")),
        }
    }

    fn dense_nodes(
        &self,
        bytes: &[u8],
        visit: &mut dyn FnMut(i64, [f64; 2]),
    ) -> Result<(), Broken> {
        let [mut ids, mut latitudes, mut longitudes] = [[].as_slice(); 3];
        for field in Fields(bytes) {
            match field? {
                (1, value) => ids = value.bytes()?,
                (8, value) => latitudes = value.bytes()?,
                (9, value) => longitudes = value.bytes()?,
                _ => (),
            }
        }
        let (mut latitudes, mut longitudes) = (Deltas::new(latitudes), Deltas::new(longitudes));
        for id in Deltas::new(ids) {
            let (Some(latitude), Some(longitude)) = (latitudes.next(), longitudes.next()) else {
                return Err(Broken("a node has no position"));
            };
            visit(id?, self.degrees(longitude?, latitude?)?);
        }
        Ok(())
    }

    fn degrees(&self, longitude: i64, latitude: i64) -> Result<[f64; 2], Broken> {
        let degrees = |value: i64, offset: i64| {
            let scaled = value.checked_mul(self.granularity);
            scaled
                .and_then(|scaled| scaled.checked_add(offset))
                .map(|nano| nano as f64 * NANODEGREE)
        };
        let longitude = degrees(longitude, self.longitude_offset);
        let latitude = degrees(latitude, self.latitude_offset);
        match (longitude, latitude) {
            (Some(longitude), Some(latitude)) => Ok([longitude, latitude]),
            _ => Err(Broken("a position is out of range")),
        }
    }

    /// The tags of a record, or none where `wanted` is true of none of its keys.
    pub(super) fn tags(
        &self,
        record: &Record<'_>,
        wanted: impl Fn(&[u8]) -> bool,
    ) -> Result<Option<Tags>, Broken> {
        let keys = || Packed(record.keys).map(|key| self.string(key?));
        let mut any = false;
        for key in keys() {
            any |= wanted(key?);
        }
        if !any {
            return Ok(None);
        }
        let mut values = Packed(record.values);
        let mut tags = Tags::default();
        for key in keys() {
            let value = values.next().ok_or(Broken("a key has no value"))?;
            tags.add(text(key?), text(self.string(value?)?))?;
        }
        Ok(Some(tags))
    }

    /// The members of a relation.
    pub(super) fn members(&self, record: &Record<'_>) -> Result<Vec<Member>, Broken> {
        let (mut kinds, mut roles) = (Packed(record.kinds), Packed(record.nodes_or_roles));
        let mut members = Vec::new();
        for id in Deltas::new(record.members) {
            let (Some(kind), Some(role)) = (kinds.next(), roles.next()) else {
                return Err(Broken("a member has no type or role"));
            };
            let kind = match kind? {
                0 => MemberKind::Node,
                1 => MemberKind::Way,
                2 => MemberKind::Relation,
                _ => return Err(Broken("a member has an unknown type")),
            };
            members.push(Member {
                kind,
                id: id?,
                role: Tags::shortened(&text(self.string(role?)?)),
            });
        }
        Ok(members)
    }

    fn string(&self, index: u64) -> Result<&'a [u8], Broken> {
        let string = usize::try_from(index)
            .ok()
            .and_then(|index| self.strings.get(index));
        string
            .copied()
            .ok_or(Broken("the index of a string is out of range"))
    }
}

impl<'a> Record<'a> {
    fn parse(bytes: &'a [u8]) -> Result<Self, Broken> {
        let mut record = Self::default();
        let mut id = None;
        for field in Fields(bytes) {
            match field? {
                (1, value) => id = Some(value.number()? as i64),
                (2, value) => record.keys = value.bytes()?,
                (3, value) => record.values = value.bytes()?,
                (8, value) => record.nodes_or_roles = value.bytes()?,
                (9, value) => record.members = value.bytes()?,
                (10, value) => record.kinds = value.bytes()?,
                _ => (),
            }
        }
        record.id = id.ok_or(Broken("a way or relation lacks its number"))?;
        Ok(record)
    }

    /// The numbers of a way's nodes.
    pub(super) fn nodes(&self) -> Deltas<'a> {
        Deltas::new(self.nodes_or_roles)
    }
}

fn text(bytes: &[u8]) -> std::borrow::Cow<'_, str> {
    String::from_utf8_lossy(bytes)
}
