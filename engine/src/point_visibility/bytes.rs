//! [`Tile`] as bytes: its arrays one after the other, little-endian. Positions take two bytes where that is enough,
//! and coordinates that are multiples of a millimetre, or of another usual step, are counted in these from a corner of the tile:
//! they come back as the same numbers.

use std::ops::Range;

use glam::{DVec2, DVec3};
use thiserror::Error;

use super::tile::{Column, Feature, Tile, positions};
use super::tree::{FANOUT, Node, Tree};
use crate::Box3d;

/// First number of the form; another form gets another one.
const FORM: u32 = 2;

/// Bytes before the arrays.
const HEAD: usize = 4 + 7 * 4 + 3 + 3 * 8;

/// Steps in a metre that coordinates may be multiples of: those of decimal and of binary fractions, large steps first.
const STEPS: [f64; 6] = [1000.0, 1024.0, 1e4, 65_536.0, 1e5, 1e6];

/// Coordinates have fewer steps from the origin, so that a step more is another number.
const MOST_STEPS: f64 = (1_u64 << 52) as f64;

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
        let (counts, layout) = (self.counts(), Layout::of(self));
        let mut bytes = Bytes {
            bytes: Vec::with_capacity(layout.length(&counts)),
            layout,
        };
        bytes.head(&counts);
        for node in &self.tree.nodes {
            bytes.bounds(&node.bounds);
            bytes.position(node.first);
            bytes.position(u32::from(node.count) << 1 | u32::from(node.is_leaf));
        }
        for feature in &self.features {
            bytes.bytes.extend(feature.id.to_le_bytes());
            bytes.bounds(&feature.envelope);
            bytes.range(&feature.outline);
            bytes.range(&feature.columns);
            bytes.range(&feature.ridges);
            bytes.position(feature.crests);
            bytes.range(&feature.peaks);
        }
        for column in &self.columns {
            let bottom = Some(column.bottom).filter(|bottom| bottom.is_finite());
            bytes.flag(bottom.is_none());
            bytes.real(2, bottom.unwrap_or(column.top));
            bytes.real(2, column.top);
            bytes.range(&column.rings);
        }
        for ring in &self.rings {
            bytes.range(ring);
        }
        for corner in &self.corners {
            bytes.real(0, corner.x);
            bytes.real(1, corner.y);
        }
        for end in self.ridges.as_flattened() {
            bytes.bytes.extend(end.to_le_bytes());
        }
        for peak in &self.peaks {
            bytes.point(*peak);
        }
        self.buried.iter().for_each(|&is| bytes.flag(is));
        bytes.bytes
    }

    /// The tile of bytes from [`Tile::to_bytes`].
    ///
    /// # Errors
    /// When they are no tile: whatever they are, a tile that is returned can be searched.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, MalformedTile> {
        let form = bytes
            .first_chunk()
            .map_or(0, |form| u32::from_le_bytes(*form));
        if form != FORM {
            return Err(MalformedTile::Form(form));
        }
        if bytes.len() < HEAD {
            return Err(MalformedTile::Length {
                found: bytes.len(),
                expected: HEAD,
            });
        }
        let (counts, layout) = head(&bytes[4..HEAD])?;
        let expected = layout.length(&counts);
        if bytes.len() != expected {
            return Err(MalformedTile::Length {
                found: bytes.len(),
                expected,
            });
        }
        let mut reader = Reader {
            bytes: &bytes[HEAD..],
            layout,
        };
        let tile = reader.tile(&counts);
        tile.check()?;
        Ok(tile)
    }

    /// Bytes that it takes in memory, give or take a few.
    #[must_use]
    pub fn size(&self) -> usize {
        let sizes = [
            size_of::<Node>(),
            size_of::<Feature>(),
            size_of::<Column>(),
            size_of::<Range<u32>>(),
            size_of::<DVec2>() + size_of::<bool>(),
            size_of::<[u16; 2]>(),
            size_of::<DVec3>(),
        ];
        let items = self.counts().0.into_iter().zip(sizes);
        size_of::<Self>() + items.map(|(count, size)| count * size).sum::<usize>()
    }

    /// All its coordinates, each with its axis.
    fn coordinates(&self) -> impl Iterator<Item = (usize, f64)> {
        let boxes = self.tree.nodes.iter().map(|node| &node.bounds);
        let boxes = boxes.chain(self.features.iter().map(|feature| &feature.envelope));
        let corners = boxes.flat_map(|bounds| [bounds.min, bounds.max]);
        let points = corners.chain(self.peaks.iter().copied());
        let points = points.flat_map(|point| point.to_array().into_iter().enumerate());
        let plan = self
            .corners
            .iter()
            .flat_map(|corner| [(0, corner.x), (1, corner.y)]);
        let heights = self
            .columns
            .iter()
            .flat_map(|column| [column.bottom, column.top]);
        let heights = heights.filter(|height| height.is_finite());
        points.chain(plan).chain(heights.map(|height| (2, height)))
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

/// How the numbers of a tile are written.
#[derive(Clone, Copy)]
struct Layout {
    /// Bytes of a position in an array.
    position: usize,
    /// Bytes of a coordinate.
    real: usize,
    /// Where they are counted in steps: how many a metre has, by its place in [`STEPS`], and from where, in steps.
    grid: Option<(usize, [i64; 3])>,
}

impl Layout {
    fn of(tile: &Tile) -> Self {
        let most = tile.counts().0.into_iter().max().unwrap_or(0);
        let grid = (0..STEPS.len()).find_map(|steps| {
            let (mut least, mut most) = ([i64::MAX; 3], [i64::MIN; 3]);
            for (axis, coordinate) in tile.coordinates() {
                let at = (coordinate * STEPS[steps]).round();
                if at.abs() >= MOST_STEPS || at / STEPS[steps] != coordinate {
                    return None;
                }
                least[axis] = least[axis].min(at as i64);
                most[axis] = most[axis].max(at as i64);
            }
            let origin = least.map(|least| if least == i64::MAX { 0 } else { least });
            let extent = (0..3)
                .map(|axis| most[axis].saturating_sub(origin[axis]))
                .max()?;
            let real = (2..=4).find(|bytes| extent < 1 << (8 * bytes))?;
            Some((real, (steps, origin)))
        });
        Self {
            // One past the last, and twice a count of children.
            position: if most < 1 << 16 { 2 } else { 4 },
            real: grid.map_or(size_of::<f64>(), |(real, _)| real),
            grid: grid.map(|(_, grid)| grid),
        }
    }

    /// Bytes of a tile with so many.
    fn length(&self, counts: &Counts) -> usize {
        let Self { position, real, .. } = *self;
        let sizes = [
            6 * real + 2 * position,
            8 + 6 * real + 9 * position,
            1 + 2 * real + 2 * position,
            2 * position,
            2 * real + 1,
            2 * size_of::<u16>(),
            3 * real,
        ];
        let items = counts.0.iter().zip(sizes);
        // Counts are 32 bits wide.
        HEAD + items.map(|(count, size)| count * size).sum::<usize>()
    }
}

/// What stands before the arrays, but for the form.
fn head(bytes: &[u8]) -> Result<(Counts, Layout), MalformedTile> {
    let (counts, rest) = bytes.split_at(7 * 4);
    let counts = counts.as_chunks().0.iter();
    let counts = counts.map(|count| u32::from_le_bytes(*count) as usize);
    let (layout, origin) = rest.split_at(3);
    let mut origin = origin.as_chunks().0.iter();
    let origin = [(); 3].map(|()| origin.next().map_or(0, |at| i64::from_le_bytes(*at)));
    let layout = Layout {
        position: layout[0].into(),
        real: layout[1].into(),
        grid: usize::from(layout[2])
            .checked_sub(1)
            .map(|steps| (steps, origin)),
    };
    let is_known = matches!(layout.position, 2 | 4)
        && match layout.grid {
            Some((steps, origin)) => {
                let is_near = |at: i64| (at.unsigned_abs() as f64) < MOST_STEPS;
                steps < STEPS.len()
                    && (2..=4).contains(&layout.real)
                    && origin.into_iter().all(is_near)
            }
            None => layout.real == size_of::<f64>(),
        };
    in_order(is_known, "numbers")?;
    let mut all = Counts([0; 7]);
    all.0
        .iter_mut()
        .zip(counts)
        .for_each(|(count, read)| *count = read);
    Ok((all, layout))
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

struct Bytes {
    bytes: Vec<u8>,
    layout: Layout,
}

impl Bytes {
    fn head(&mut self, counts: &Counts) {
        let bytes = &mut self.bytes;
        bytes.extend(FORM.to_le_bytes());
        for &count in &counts.0 {
            let count = u32::try_from(count).expect("positions in a tile are 32 bits wide");
            bytes.extend(count.to_le_bytes());
        }
        let Layout {
            position,
            real,
            grid,
        } = self.layout;
        let steps = grid.map_or(0, |(steps, _)| steps + 1);
        let small =
            |number: usize| u8::try_from(number).expect("widths and kinds of steps are few");
        bytes.extend([position, real, steps].map(small));
        let origin = grid.map_or([0; 3], |(_, origin)| origin);
        bytes.extend(origin.iter().flat_map(|at| at.to_le_bytes()));
    }

    fn flag(&mut self, is: bool) {
        self.bytes.push(u8::from(is));
    }

    fn position(&mut self, position: u32) {
        let bytes = position.to_le_bytes();
        self.bytes.extend(&bytes[..self.layout.position]);
    }

    fn real(&mut self, axis: usize, real: f64) {
        let bytes = match self.layout.grid {
            Some((steps, origin)) => {
                ((real * STEPS[steps]).round() as i64 - origin[axis]).to_le_bytes()
            }
            None => real.to_le_bytes(),
        };
        self.bytes.extend(&bytes[..self.layout.real]);
    }

    fn bounds(&mut self, bounds: &Box3d) {
        self.point(bounds.min);
        self.point(bounds.max);
    }

    fn point(&mut self, point: DVec3) {
        for (axis, real) in point.to_array().into_iter().enumerate() {
            self.real(axis, real);
        }
    }

    fn range(&mut self, range: &Range<u32>) {
        self.position(range.start);
        self.position(range.end);
    }
}

/// Bytes that are left. There are as many as are asked for.
struct Reader<'a> {
    bytes: &'a [u8],
    layout: Layout,
}

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
            buried: self.bytes.iter().map(|&byte| byte != 0).collect(),
        }
    }

    fn node(&mut self) -> Node {
        let bounds = self.bounds();
        let (first, children) = (self.position(), self.position());
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
            crests: self.position(),
            peaks: self.range(),
        }
    }

    fn column(&mut self) -> Column {
        let [is_grounded] = self.array();
        let (bottom, top) = (self.real(2), self.real(2));
        Column {
            bottom: match is_grounded {
                0 => bottom,
                _ => f64::NEG_INFINITY,
            },
            top,
            rings: self.range(),
        }
    }

    fn corner(&mut self) -> DVec2 {
        DVec2::new(self.real(0), self.real(1))
    }

    fn bounds(&mut self) -> Box3d {
        Box3d {
            min: self.point(),
            max: self.point(),
        }
    }

    fn point(&mut self) -> DVec3 {
        DVec3::new(self.real(0), self.real(1), self.real(2))
    }

    fn range(&mut self) -> Range<u32> {
        self.position()..self.position()
    }

    fn position(&mut self) -> u32 {
        match self.layout.position {
            2 => u16::from_le_bytes(self.array()).into(),
            _ => u32::from_le_bytes(self.array()),
        }
    }

    fn real(&mut self, axis: usize) -> f64 {
        let Some((steps, origin)) = self.layout.grid else {
            return f64::from_le_bytes(self.array());
        };
        let at: u32 = match self.layout.real {
            2 => u16::from_le_bytes(self.array()).into(),
            3 => {
                let [low, middle, high] = self.array();
                u32::from_le_bytes([low, middle, high, 0])
            }
            _ => u32::from_le_bytes(self.array()),
        };
        (origin[axis] + i64::from(at)) as f64 / STEPS[steps]
    }

    fn array<const N: usize>(&mut self) -> [u8; N] {
        let (first, rest) = self.bytes.split_at(N);
        self.bytes = rest;
        first.try_into().expect("so many bytes were split off")
    }
}
