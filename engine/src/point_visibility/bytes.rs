//! [`Tile`] as bytes: its arrays one after the other, little-endian, so that reading copies them and
//! computes nothing.

use std::ops::Range;

use glam::{DVec2, DVec3};
use thiserror::Error;

use super::tile::{Column, Feature, Tile, positions};
use super::tree::{FANOUT, Node, Tree};
use crate::Box3d;

/// First number of the form; another form gets another one.
const FORM: u32 = 2;

/// Bytes of a node, a feature, a column, a ring, a corner, and an edge and a corner of a roof.
const NODE: usize = 6 * 8 + 2 * 4;
const FEATURE: usize = 8 + 6 * 8 + 9 * 4;
const COLUMN: usize = 2 * 8 + 2 * 4;
const RING: usize = 2 * 4;
const CORNER: usize = 2 * 8 + 1;
const RIDGE: usize = 2 * 2;
const PEAK: usize = 3 * 8;

/// Bytes that are no tile.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum MalformedTile {
    /// They begin with another number.
    #[error("form {0} of a tile is not known")]
    Form(u32),
    /// There are more or fewer than the counts say.
    #[error("a tile of {found} bytes should have {expected}")]
    Length {
        /// Bytes there are.
        found: usize,
        /// Bytes there should be.
        expected: usize,
    },
    /// A range of an array that ends beyond it.
    #[error("{0} of a tile are out of range")]
    Range(&'static str),
    /// A number that is not finite, or boxes that are not in each other.
    #[error("{0} of a tile are not in order")]
    Disorder(&'static str),
}

impl Tile {
    /// The tile as bytes, for [`Tile::from_bytes`].
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = Bytes(Vec::with_capacity(self.counts().length()));
        bytes.number(FORM);
        for count in self.counts().0 {
            bytes.number(u32::try_from(count).expect("positions in a tile are 32 bits wide"));
        }
        for node in &self.tree.nodes {
            bytes.bounds(&node.bounds);
            bytes.number(node.first);
            bytes.number(u32::from(node.count) << 1 | u32::from(node.is_leaf));
        }
        for feature in &self.features {
            bytes.0.extend(feature.id.to_le_bytes());
            bytes.bounds(&feature.envelope);
            bytes.range(&feature.outline);
            bytes.range(&feature.columns);
            bytes.range(&feature.ridges);
            bytes.number(feature.crests);
            bytes.range(&feature.peaks);
        }
        for column in &self.columns {
            bytes.real(column.bottom);
            bytes.real(column.top);
            bytes.range(&column.rings);
        }
        for ring in &self.rings {
            bytes.range(ring);
        }
        for corner in &self.corners {
            bytes.real(corner.x);
            bytes.real(corner.y);
        }
        for end in self.ridges.as_flattened() {
            bytes.0.extend(end.to_le_bytes());
        }
        for peak in &self.peaks {
            bytes.point(*peak);
        }
        bytes.0.extend(self.buried.iter().map(|&is| u8::from(is)));
        bytes.0
    }

    /// The tile of bytes from [`Tile::to_bytes`].
    ///
    /// # Errors
    /// When they are no tile: whatever they are, a tile that is returned can be searched.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, MalformedTile> {
        let mut reader = Reader(bytes);
        let form = reader.checked_number().unwrap_or(0);
        if form != FORM {
            return Err(MalformedTile::Form(form));
        }
        let mut counts = Counts([0; 7]);
        for count in &mut counts.0 {
            *count = reader.checked_number().unwrap_or(0) as usize;
        }
        if bytes.len() != counts.length() {
            return Err(MalformedTile::Length {
                found: bytes.len(),
                expected: counts.length(),
            });
        }
        let tile = reader.tile(&counts);
        tile.check()?;
        Ok(tile)
    }

    /// Length of [`Tile::to_bytes`], which is also what it takes in memory, give or take a few.
    #[must_use]
    pub fn byte_length(&self) -> usize {
        self.counts().length()
    }

    fn counts(&self) -> Counts {
        Counts([
            self.tree.nodes.len(),
            self.features.len(),
            self.columns.len(),
            self.rings.len(),
            self.corners.len(),
            self.ridges.len(),
            self.peaks.len(),
        ])
    }

    /// That every position is one of the array it is of, and every number is finite.
    fn check(&self) -> Result<(), MalformedTile> {
        self.check_tree()?;
        let corners = self.corners.len();
        for feature in &self.features {
            within(&feature.outline, corners, "outlines")?;
            within(&feature.columns, self.columns.len(), "columns")?;
            within(&feature.ridges, self.ridges.len(), "roofs")?;
            within(&feature.peaks, self.peaks.len(), "corners of roofs")?;
            let ridges = self.ridges(feature);
            in_order(feature.crests as usize <= ridges.len(), "roofs")?;
            let peaks = feature.peaks.len();
            let are_its = ridges
                .as_flattened()
                .iter()
                .all(|&end| usize::from(end) < peaks);
            in_order(are_its, "roofs")?;
        }
        for column in &self.columns {
            within(&column.rings, self.rings.len(), "rings")?;
        }
        for ring in &self.rings {
            within(ring, corners, "corners")?;
        }
        let is_column = |column: &Column| column.top.is_finite() && column.bottom < f64::INFINITY;
        let are_finite = self.columns.iter().all(is_column)
            && self.corners.iter().all(|corner| corner.is_finite())
            && self.peaks.iter().all(|peak| peak.is_finite());
        in_order(are_finite, "coordinates")
    }

    /// That it is a tree with each feature in one leaf, and each box holds those below it.
    fn check_tree(&self) -> Result<(), MalformedTile> {
        let nodes = &self.tree.nodes;
        let mut children = 1;
        let mut has_leaf = vec![false; self.features.len()];
        for node in nodes {
            in_order(is_box(&node.bounds), "boxes")?;
            let count = usize::from(node.count);
            in_order((1..=FANOUT).contains(&count), "nodes")?;
            let below = positions(&node.children());
            let holds = if node.is_leaf {
                let features = self.features.get(below.clone());
                let features = features.ok_or(MalformedTile::Range("leaves"))?;
                let is_taken = has_leaf[below]
                    .iter_mut()
                    .any(|has| std::mem::replace(has, true));
                in_order(!is_taken, "leaves")?;
                let mut boxes = features.iter().map(|feature| &feature.envelope);
                boxes.all(|bounds| is_box(bounds) && node.bounds.contains(bounds))
            } else {
                // Nodes lie in the order of those that hold them, so that none is in two.
                in_order(below.start == children, "nodes")?;
                children = below.end;
                let nodes = nodes.get(below).ok_or(MalformedTile::Range("nodes"))?;
                let mut boxes = nodes.iter().map(|node| &node.bounds);
                boxes.all(|bounds| node.bounds.contains(bounds))
            };
            in_order(holds, "boxes")?;
        }
        let is_whole = nodes.is_empty() || children == nodes.len();
        in_order(is_whole && has_leaf.iter().all(|&has| has), "nodes")
    }
}

/// How many nodes, features, columns, rings and corners there are, and of roofs, edges and corners.
struct Counts([usize; 7]);

impl Counts {
    /// Bytes of a tile with so many.
    fn length(&self) -> usize {
        let sizes = [NODE, FEATURE, COLUMN, RING, CORNER, RIDGE, PEAK];
        let items = self.0.iter().zip(sizes);
        // Counts are 32 bits wide.
        4 + 4 * self.0.len() + items.map(|(count, size)| count * size).sum::<usize>()
    }
}

fn within(range: &Range<u32>, count: usize, what: &'static str) -> Result<(), MalformedTile> {
    if range.start <= range.end && range.end as usize <= count {
        Ok(())
    } else {
        Err(MalformedTile::Range(what))
    }
}

fn in_order(is: bool, what: &'static str) -> Result<(), MalformedTile> {
    if is {
        Ok(())
    } else {
        Err(MalformedTile::Disorder(what))
    }
}

fn is_box(bounds: &Box3d) -> bool {
    bounds.min.is_finite() && bounds.max.is_finite() && bounds.min.cmple(bounds.max).all()
}

struct Bytes(Vec<u8>);

impl Bytes {
    fn number(&mut self, number: u32) {
        self.0.extend(number.to_le_bytes());
    }

    fn real(&mut self, real: f64) {
        self.0.extend(real.to_le_bytes());
    }

    fn bounds(&mut self, bounds: &Box3d) {
        self.point(bounds.min);
        self.point(bounds.max);
    }

    fn point(&mut self, point: DVec3) {
        for real in point.to_array() {
            self.real(real);
        }
    }

    fn range(&mut self, range: &Range<u32>) {
        self.number(range.start);
        self.number(range.end);
    }
}

/// Bytes that are left. There are as many as are asked for, but for `checked_number`.
struct Reader<'a>(&'a [u8]);

impl Reader<'_> {
    fn tile(&mut self, counts: &Counts) -> Tile {
        let [nodes, features, columns, rings, corners, ridges, peaks] = counts.0;
        let nodes = (0..nodes).map(|_| self.node()).collect();
        Tile {
            tree: Tree { nodes },
            features: (0..features).map(|_| self.feature()).collect(),
            columns: (0..columns).map(|_| self.column()).collect(),
            rings: (0..rings).map(|_| self.range()).collect(),
            corners: (0..corners).map(|_| self.corner()).collect(),
            ridges: (0..ridges)
                .map(|_| [self.array(), self.array()].map(u16::from_le_bytes))
                .collect(),
            peaks: (0..peaks).map(|_| self.point()).collect(),
            buried: self.0.iter().map(|&byte| byte != 0).collect(),
        }
    }

    fn node(&mut self) -> Node {
        let bounds = self.bounds();
        let (first, children) = (self.number(), self.number());
        Node {
            bounds,
            first,
            // Too many are refused later.
            count: u16::try_from(children >> 1).unwrap_or(u16::MAX),
            is_leaf: children & 1 == 1,
        }
    }

    fn feature(&mut self) -> Feature {
        Feature {
            id: i64::from_le_bytes(self.array()),
            envelope: self.bounds(),
            outline: self.range(),
            columns: self.range(),
            ridges: self.range(),
            crests: self.number(),
            peaks: self.range(),
        }
    }

    fn column(&mut self) -> Column {
        Column {
            bottom: self.real(),
            top: self.real(),
            rings: self.range(),
        }
    }

    fn corner(&mut self) -> DVec2 {
        DVec2::new(self.real(), self.real())
    }

    fn bounds(&mut self) -> Box3d {
        Box3d {
            min: self.point(),
            max: self.point(),
        }
    }

    fn point(&mut self) -> DVec3 {
        DVec3::new(self.real(), self.real(), self.real())
    }

    fn range(&mut self) -> Range<u32> {
        self.number()..self.number()
    }

    fn number(&mut self) -> u32 {
        u32::from_le_bytes(self.array())
    }

    fn real(&mut self) -> f64 {
        f64::from_le_bytes(self.array())
    }

    fn checked_number(&mut self) -> Option<u32> {
        (self.0.len() >= 4).then(|| self.number())
    }

    fn array<const N: usize>(&mut self) -> [u8; N] {
        let (first, rest) = self.0.split_at(N);
        self.0 = rest;
        first.try_into().expect("so many bytes were split off")
    }
}
