//! Writes OpenStreetMap PBF for the tests.
// Each test binary uses its own part of this module.
#![allow(dead_code)]

use std::io::Write;

use flate2::Compression;
use flate2::write::ZlibEncoder;
use prost::encoding::{WireType, encode_key, encode_varint};

/// A corner that positions are measured from, degrees.
pub const ORIGIN: [f64; 2] = [24.94, 60.17];

/// Metres of a degree of longitude and of latitude there, in UTM zone 35.
const DEGREE: [f64; 2] = [55_526.0, 111_410.0];

/// Tags by key and value.
pub type Tags<'a> = &'a [(&'a str, &'a str)];

/// A member of a relation: 0 a node, 1 a way, 2 a relation; its number and role.
pub type Member<'a> = (u64, i64, &'a str);

/// A file in the making.
#[derive(Default)]
pub struct OsmFile {
    nodes: Vec<[f64; 2]>,
    group: Vec<u8>,
    strings: Vec<String>,
}

impl OsmFile {
    /// A file with nothing in it.
    pub fn new() -> Self {
        Self {
            strings: vec![String::new()],
            ..Self::default()
        }
    }

    /// Adds a node at an offset in metres and gives its number.
    pub fn node(&mut self, x: f64, y: f64) -> i64 {
        self.nodes
            .push([ORIGIN[0] + x / DEGREE[0], ORIGIN[1] + y / DEGREE[1]]);
        self.nodes.len() as i64
    }

    /// Adds a closed way around a rectangle and gives its nodes.
    pub fn rectangle(
        &mut self,
        id: i64,
        [x, y]: [f64; 2],
        [w, h]: [f64; 2],
        tags: Tags<'_>,
    ) -> Vec<i64> {
        let corners = [[x, y], [x + w, y], [x + w, y + h], [x, y + h]];
        let mut nodes: Vec<i64> = corners.iter().map(|[x, y]| self.node(*x, *y)).collect();
        nodes.push(nodes[0]);
        self.way(id, &nodes, tags);
        nodes
    }

    /// Adds a way through positions.
    pub fn line(&mut self, id: i64, positions: &[[f64; 2]], tags: Tags<'_>) {
        let nodes: Vec<i64> = positions.iter().map(|[x, y]| self.node(*x, *y)).collect();
        self.way(id, &nodes, tags);
    }

    /// Adds a way.
    pub fn way(&mut self, id: i64, nodes: &[i64], tags: Tags<'_>) {
        let mut way = self.element(id, tags);
        bytes(&mut way, 8, &deltas(nodes));
        bytes(&mut self.group, 3, &way);
    }

    /// Adds a relation.
    pub fn relation(&mut self, id: i64, members: &[Member<'_>], tags: Tags<'_>) {
        let mut relation = self.element(id, tags);
        let roles: Vec<u64> = members
            .iter()
            .map(|(_, _, role)| self.string(role))
            .collect();
        let ids: Vec<i64> = members.iter().map(|(_, id, _)| *id).collect();
        let kinds: Vec<u64> = members.iter().map(|(kind, _, _)| *kind).collect();
        bytes(&mut relation, 8, &packed(&roles));
        bytes(&mut relation, 9, &deltas(&ids));
        bytes(&mut relation, 10, &packed(&kinds));
        bytes(&mut self.group, 4, &relation);
    }

    /// The bytes of the file, not packed, so that mutations reach everything.
    pub fn raw(&self) -> Vec<u8> {
        [
            blob(
                "OSMHeader",
                &raw(&header(&["OsmSchema-V0.6", "DenseNodes"])),
            ),
            blob("OSMData", &raw(&self.block())),
        ]
        .concat()
    }

    /// The bytes of the file, packed as usual.
    pub fn zlib(&self) -> Vec<u8> {
        let header = header(&["OsmSchema-V0.6", "DenseNodes"]);
        [
            blob("OSMHeader", &zlib(&header)),
            blob("OSMData", &zlib(&self.block())),
        ]
        .concat()
    }

    fn block(&self) -> Vec<u8> {
        let mut table = Vec::new();
        self.strings
            .iter()
            .for_each(|string| bytes(&mut table, 1, string.as_bytes()));
        let units = |axis: usize| -> Vec<i64> {
            self.nodes
                .iter()
                .map(|node| (node[axis] * 1e9).round() as i64)
                .collect()
        };
        let ids: Vec<i64> = (1..=self.nodes.len() as i64).collect();
        let mut dense = Vec::new();
        bytes(&mut dense, 1, &deltas(&ids));
        bytes(&mut dense, 8, &deltas(&units(1)));
        bytes(&mut dense, 9, &deltas(&units(0)));
        let mut nodes = Vec::new();
        bytes(&mut nodes, 2, &dense);
        let mut block = Vec::new();
        // Ways before nodes: a reader may not count on an order.
        bytes(&mut block, 2, &self.group);
        bytes(&mut block, 2, &nodes);
        bytes(&mut block, 1, &table);
        number(&mut block, 17, 1);
        block
    }

    fn element(&mut self, id: i64, tags: Tags<'_>) -> Vec<u8> {
        let keys: Vec<u64> = tags.iter().map(|(key, _)| self.string(key)).collect();
        let values: Vec<u64> = tags.iter().map(|(_, value)| self.string(value)).collect();
        let mut element = Vec::new();
        number(&mut element, 1, id as u64);
        bytes(&mut element, 2, &packed(&keys));
        bytes(&mut element, 3, &packed(&values));
        element
    }

    fn string(&mut self, text: &str) -> u64 {
        let known = self.strings.iter().position(|string| string == text);
        let index = known.unwrap_or_else(|| {
            self.strings.push(text.to_owned());
            self.strings.len() - 1
        });
        index as u64
    }
}

/// A header block that requires these features.
pub fn header(features: &[&str]) -> Vec<u8> {
    let mut header = Vec::new();
    features
        .iter()
        .for_each(|feature| bytes(&mut header, 4, feature.as_bytes()));
    header
}

/// A blob's content, not packed.
pub fn raw(block: &[u8]) -> Vec<u8> {
    let mut content = Vec::new();
    bytes(&mut content, 1, block);
    content
}

/// A blob's content, packed.
pub fn zlib(block: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
    encoder.write_all(block).unwrap();
    let mut content = Vec::new();
    number(&mut content, 2, block.len() as u64);
    bytes(&mut content, 3, &encoder.finish().unwrap());
    content
}

/// A blob with its header.
pub fn blob(kind: &str, content: &[u8]) -> Vec<u8> {
    let mut header = Vec::new();
    bytes(&mut header, 1, kind.as_bytes());
    number(&mut header, 3, content.len() as u64);
    let length = u32::try_from(header.len()).unwrap().to_be_bytes();
    [&length, header.as_slice(), content].concat()
}

/// Appends a field of bytes.
pub fn bytes(to: &mut Vec<u8>, tag: u32, value: &[u8]) {
    encode_key(tag, WireType::LengthDelimited, to);
    encode_varint(value.len() as u64, to);
    to.extend(value);
}

/// Appends a field with a number.
pub fn number(to: &mut Vec<u8>, tag: u32, value: u64) {
    encode_key(tag, WireType::Varint, to);
    encode_varint(value, to);
}

fn packed(numbers: &[u64]) -> Vec<u8> {
    let mut bytes = Vec::new();
    numbers
        .iter()
        .for_each(|number| encode_varint(*number, &mut bytes));
    bytes
}

fn deltas(numbers: &[i64]) -> Vec<u8> {
    let mut last = 0;
    let zigzag = |number: &i64| {
        let step = number - std::mem::replace(&mut last, *number);
        ((step << 1) ^ (step >> 63)) as u64
    };
    packed(&numbers.iter().map(zigzag).collect::<Vec<_>>())
}
