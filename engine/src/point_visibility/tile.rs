//! [`Tile`], the features of a neighbourhood as the solver reads them.

use std::collections::HashMap;
use std::ops::Range;

use geo::{BoundingRect, Coord, Distance, Euclidean, LineString, Polygon};
use glam::{DVec2, DVec3};

use super::EYE_MARGIN;
use super::occluder::holds;
use super::tree::Tree;
use crate::{Box3d, OuterPrism, Roof, SolidColumn};

/// An edge of a roof takes part in hiding where it is so much higher than the columns beside it, metres.
/// Each that does makes the horizon more intricate.
const CREST: f64 = 0.5;

/// Columns this near to an edge are beside it, metres: more than they are drawn in from a surface.
const BESIDE: f64 = 0.05;

/// A feature as it is given to a tile.
#[derive(Clone, Debug)]
pub struct TileFeature {
    /// Number of the feature.
    pub id: i64,
    /// Outer envelope, metres.
    pub envelope: Box3d,
    /// Corners of the outer prism; none where only the envelope is known. Their convex hull is taken.
    pub outline: Vec<DVec2>,
    /// Where it is seen highest; `None` if nothing more than the prism is known. It hides, too, if all
    /// columns do.
    pub roof: Option<Roof>,
    /// What hides. Only columns within the envelope do, from a point.
    pub columns: Vec<SolidColumn>,
}

/// The features of a neighbourhood with what hides in them, in a tree.
#[derive(Clone, Debug, Default)]
pub struct Tile {
    pub(super) tree: Tree,
    /// In the order of the leaves.
    pub(super) features: Vec<Feature>,
    pub(super) columns: Vec<Column>,
    pub(super) rings: Vec<Range<u32>>,
    /// Corners of rings, and of outlines that are no ring.
    pub(super) corners: Vec<DVec2>,
    /// Of each corner, whether the edge that it begins lies in the feature's own solid.
    pub(super) buried: Vec<bool>,
    /// Edges of roofs: two positions each among the peaks of the feature.
    pub(super) ridges: Vec<[u16; 2]>,
    /// Corners of roofs.
    pub(super) peaks: Vec<DVec3>,
}

/// A feature of a tile.
#[derive(Clone, Debug)]
pub struct Feature {
    pub id: i64,
    pub envelope: Box3d,
    pub outline: Range<u32>,
    pub columns: Range<u32>,
    /// Edges of its roof; none where nothing more than the prism is known.
    pub ridges: Range<u32>,
    /// How many of these, the first, hide, as a solid is below them. All, if they hide instead of the
    /// columns; otherwise those well above the columns beside them.
    pub crests: u32,
    pub peaks: Range<u32>,
}

impl Feature {
    /// Whether its roof hides all that its columns do, from beside it.
    pub fn hides_by_roof(&self) -> bool {
        self.crests > 0 && self.crests == self.ridges.end - self.ridges.start
    }
}

/// A column.
#[derive(Clone, Debug)]
pub struct Column {
    /// Negative infinity where it is grounded.
    pub bottom: f64,
    pub top: f64,
    /// Outer ring anticlockwise, then holes clockwise.
    pub rings: Range<u32>,
}

impl Tile {
    /// The tile of these features.
    #[must_use]
    pub fn new(features: &[TileFeature]) -> Self {
        let boxes: Vec<Box3d> = features.iter().map(|feature| feature.envelope).collect();
        let (tree, order) = Tree::new(&boxes);
        let mut tile = Self {
            tree,
            ..Self::default()
        };
        for at in order {
            tile.add(&features[at]);
        }
        tile
    }

    /// The tile of features that others hold, as those have them: given by tile and position.
    #[must_use]
    pub fn gathered(picks: &[(&Self, usize)]) -> Self {
        let boxes: Vec<Box3d> = picks.iter().map(|(tile, at)| tile.feature(*at).1).collect();
        let (tree, order) = Tree::new(&boxes);
        let mut gathered = Self {
            tree,
            ..Self::default()
        };
        for at in order {
            let (tile, position) = picks[at];
            gathered.copy(tile, position);
        }
        gathered
    }

    /// The smallest box that holds all of it; `None` when it is empty.
    #[must_use]
    pub fn bounds(&self) -> Option<Box3d> {
        self.tree.bounds()
    }

    /// How many features it holds.
    #[must_use]
    pub fn len(&self) -> usize {
        self.features.len()
    }

    /// Whether it holds none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.features.is_empty()
    }

    /// Number and outer envelope of the feature at a position.
    #[must_use]
    pub fn feature(&self, position: usize) -> (i64, Box3d) {
        let feature = &self.features[position];
        (feature.id, feature.envelope)
    }

    /// The edges of the roof of a feature.
    pub(super) fn ridges(&self, feature: &Feature) -> &[[u16; 2]] {
        &self.ridges[positions(&feature.ridges)]
    }

    /// Those of them that hide.
    pub(super) fn crests(&self, feature: &Feature) -> &[[u16; 2]] {
        &self.ridges(feature)[..feature.crests as usize]
    }

    /// The ends of an edge of the roof of a feature.
    pub(super) fn ends(&self, feature: &Feature, ridge: [u16; 2]) -> [DVec3; 2] {
        ridge.map(|end| self.peaks[feature.peaks.start as usize + usize::from(end)])
    }

    /// Whether a column or its margin holds an eye: it hides nothing from there.
    pub(crate) fn holds(&self, eye: DVec3) -> bool {
        let plan = |bounds: &Box3d| {
            let nearest = eye.clamp(bounds.min, bounds.max) - eye;
            nearest.truncate().abs().max_element() <= EYE_MARGIN
        };
        let mut open: Vec<u32> = if self.is_empty() { Vec::new() } else { vec![0] };
        while let Some(at) = open.pop() {
            let node = &self.tree.nodes[at as usize];
            if !plan(&node.bounds) {
                continue;
            }
            if !node.is_leaf {
                open.extend(node.children());
                continue;
            }
            let features = self.features[positions(&node.children())].iter();
            let mut columns = features
                .filter(|feature| plan(&feature.envelope))
                .flat_map(|feature| &self.columns[positions(&feature.columns)]);
            if columns.any(|column| holds(self, column, eye)) {
                return true;
            }
        }
        false
    }

    /// How many corners rings and outlines have.
    pub(crate) fn corner_count(&self) -> usize {
        self.corners.len()
    }

    /// The outer envelopes of its features, and the columns of each.
    pub(crate) fn solids(&self) -> impl Iterator<Item = (Box3d, Vec<SolidColumn>)> {
        self.features.iter().map(|feature| {
            let columns = self.columns[positions(&feature.columns)].iter();
            let columns = columns.map(|column| self.solid_column(column, &feature.envelope));
            (feature.envelope, columns.collect())
        })
    }

    /// A tile of what hides alone: features without numbers that are seen nowhere.
    pub(crate) fn of_columns(columns: Vec<SolidColumn>) -> Self {
        let feature = |column: SolidColumn| {
            Some(TileFeature {
                id: 0,
                envelope: around(&column)?,
                outline: Vec::new(),
                roof: None,
                columns: vec![column],
            })
        };
        let features: Vec<TileFeature> = columns.into_iter().filter_map(feature).collect();
        Self::new(&features)
    }

    /// A column as it was given, but for how far down it goes if it is grounded.
    fn solid_column(&self, column: &Column, envelope: &Box3d) -> SolidColumn {
        let mut rings = self.rings[positions(&column.rings)].iter().map(|ring| {
            let corners = self.corners[positions(ring)].iter();
            corners.map(|corner| (corner.x, corner.y)).collect()
        });
        let outer = rings.next().unwrap_or_else(|| LineString::new(Vec::new()));
        let grounded = column.bottom == f64::NEG_INFINITY;
        SolidColumn {
            footprint: Polygon::new(outer, rings.collect()),
            bottom: if grounded {
                envelope.min.z
            } else {
                column.bottom
            },
            top: column.top,
            grounded,
        }
    }

    fn add(&mut self, feature: &TileFeature) {
        // A polygon that turned clockwise would be hidden by what only its far side is below.
        let prism = OuterPrism::around(feature.outline.iter().map(|corner| corner.extend(0.0)));
        let hull = prism.map_or(Vec::new(), |prism| prism.hull);
        let hiding: Vec<&SolidColumn> = feature
            .columns
            .iter()
            .filter(|column| lies_within(column, &feature.envelope))
            .collect();
        let grounded = hiding.iter().copied().filter(|column| column.grounded);
        // A roof hides as the columns do that it was made with: not where they are gone, nor where a
        // part of them has air below it.
        let has_all = grounded.clone().count() == feature.columns.len() && !hiding.is_empty();
        let may_hide = feature.roof.as_ref().filter(|roof| has_all && roof.hides);
        let walls = Walls::of(grounded);
        let (first, first_ring) = (index(self.columns.len()), self.rings.len());
        for column in &hiding {
            self.add_column(column, &walls);
        }
        let outline = self.add_outline(&hull, first_ring);
        let walls = self.wall_count(first);
        let crests = may_hide.map_or(Vec::new(), |roof| match 3 * roof.edges.len() <= 2 * walls {
            true => roof.edges.clone(),
            false => crests(roof, &hiding),
        });
        let first_of_roof = [index(self.ridges.len()), index(self.peaks.len())];
        if let Some(roof) = &feature.roof {
            self.add_roof(roof, &crests);
        }
        self.features.push(Feature {
            id: feature.id,
            envelope: feature.envelope,
            outline,
            columns: first..index(self.columns.len()),
            ridges: first_of_roof[0]..index(self.ridges.len()),
            crests: index(crests.len()),
            peaks: first_of_roof[1]..index(self.peaks.len()),
        });
    }

    /// Adds a feature of another tile.
    fn copy(&mut self, tile: &Self, position: usize) {
        let feature = &tile.features[position];
        let (first, first_ring) = (index(self.columns.len()), self.rings.len());
        for column in &tile.columns[positions(&feature.columns)] {
            self.copy_column(tile, column);
        }
        let outline: Vec<DVec2> = tile.corners[positions(&feature.outline)].to_vec();
        let outline = self.add_outline(&outline, first_ring);
        let first_of_roof = [index(self.ridges.len()), index(self.peaks.len())];
        self.ridges.extend(tile.ridges(feature));
        self.peaks.extend(&tile.peaks[positions(&feature.peaks)]);
        self.features.push(Feature {
            outline,
            columns: first..index(self.columns.len()),
            ridges: first_of_roof[0]..index(self.ridges.len()),
            peaks: first_of_roof[1]..index(self.peaks.len()),
            ..*feature
        });
    }

    fn copy_column(&mut self, tile: &Self, column: &Column) {
        let first = index(self.rings.len());
        for ring in &tile.rings[positions(&column.rings)] {
            let ring = self.copy_corners(tile, ring);
            self.rings.push(ring);
        }
        self.columns.push(Column {
            rings: first..index(self.rings.len()),
            ..*column
        });
    }

    fn copy_corners(&mut self, tile: &Self, range: &Range<u32>) -> Range<u32> {
        let range = positions(range);
        let buried = tile.buried[range.clone()].iter().copied();
        self.add_corners(tile.corners[range].iter().copied().zip(buried))
    }

    /// How many edges of columns from a position on may hide something.
    fn wall_count(&self, first: u32) -> usize {
        let columns = &self.columns[first as usize..];
        let rings = columns
            .iter()
            .flat_map(|column| &self.rings[positions(&column.rings)]);
        let buried = rings.flat_map(|ring| &self.buried[positions(ring)]);
        buried.filter(|&&is_buried| !is_buried).count()
    }

    /// Adds the edges of a roof, the crests among them first.
    fn add_roof(&mut self, roof: &Roof, crests: &[[u32; 2]]) {
        self.peaks.extend(&roof.corners);
        let others = roof.edges.iter().filter(|edge| !crests.contains(edge));
        let place = |end: u32| u16::try_from(end).expect("a roof has few corners");
        let ridges = crests.iter().chain(others);
        self.ridges.extend(ridges.map(|edge| edge.map(place)));
    }

    fn add_column(&mut self, column: &SolidColumn, walls: &Walls) {
        let first = index(self.rings.len());
        for ring in rings(column) {
            let corners = corners(ring);
            let edges = (0..corners.len()).map(|i| {
                let next = corners[(i + 1) % corners.len()];
                let is_buried = column.grounded && walls.bury(corners[i], next, column.top);
                (corners[i], is_buried)
            });
            let range = self.add_corners(edges);
            self.rings.push(range);
        }
        self.columns.push(Column {
            bottom: if column.grounded {
                f64::NEG_INFINITY
            } else {
                column.bottom
            },
            top: column.top,
            rings: first..index(self.rings.len()),
        });
    }

    /// Adds the outline of a feature, whose rings are there from a position on; where it is one of these, it
    /// takes no room.
    fn add_outline(&mut self, outline: &[DVec2], first_ring: usize) -> Range<u32> {
        let is_it = |ring: &&Range<u32>| is_rotated(&self.corners[positions(ring)], outline);
        match self.rings[first_ring..].iter().find(is_it) {
            Some(ring) => ring.clone(),
            None => self.add_corners(outline.iter().map(|&corner| (corner, false))),
        }
    }

    fn add_corners(&mut self, corners: impl Iterator<Item = (DVec2, bool)>) -> Range<u32> {
        let first = index(self.corners.len());
        for (corner, buried) in corners {
            self.corners.push(corner);
            self.buried.push(buried);
        }
        first..index(self.corners.len())
    }
}

/// The edges of a roof that are all well above the columns beside their middle.
fn crests(roof: &Roof, columns: &[&SolidColumn]) -> Vec<[u32; 2]> {
    let is_crest = |edge: &&[u32; 2]| {
        let [from, to] = edge.map(|end| roof.corners[end as usize]);
        let middle = from.midpoint(to);
        let place = geo::Point::new(middle.x, middle.y);
        let beside = columns
            .iter()
            .filter(|column| Euclidean.distance(&place, &column.footprint) < BESIDE);
        let top = beside.map(|column| column.top).reduce(f64::max);
        top.is_some_and(|top| from.z.min(to.z) - top > CREST)
    };
    roof.edges.iter().filter(is_crest).copied().collect()
}

/// Greatest height of the grounded columns of one feature behind each edge, by the places of its ends.
struct Walls(HashMap<[u64; 4], f64>);

impl Walls {
    fn of<'a>(columns: impl Iterator<Item = &'a SolidColumn>) -> Self {
        let mut walls = HashMap::new();
        for column in columns {
            for ring in rings(column) {
                let corners = corners(ring);
                for (i, &from) in corners.iter().enumerate() {
                    let key = key(from, corners[(i + 1) % corners.len()]);
                    let top = walls.entry(key).or_insert(f64::NEG_INFINITY);
                    *top = column.top.max(*top);
                }
            }
        }
        Self(walls)
    }

    /// Whether an edge of a column lies in a column at least as high on its other side: what passes
    /// it has met that one, or will.
    fn bury(&self, from: DVec2, to: DVec2, top: f64) -> bool {
        self.0
            .get(&key(to, from))
            .is_some_and(|&behind| behind >= top)
            || self.0.get(&key(from, to)).is_some_and(|&here| here > top)
    }
}

fn key(from: DVec2, to: DVec2) -> [u64; 4] {
    [from.x, from.y, to.x, to.y].map(f64::to_bits)
}

fn rings(column: &SolidColumn) -> impl Iterator<Item = &LineString<f64>> {
    std::iter::once(column.footprint.exterior()).chain(column.footprint.interiors())
}

/// The corners of a closed ring, the first not repeated.
fn corners(ring: &LineString<f64>) -> Vec<DVec2> {
    let mut corners: Vec<DVec2> = ring.coords().map(|c| DVec2::new(c.x, c.y)).collect();
    if corners.len() > 1 && corners.first() == corners.last() {
        corners.pop();
    }
    corners
}

/// Whether two rings are the same from some corner of one on.
fn is_rotated(ring: &[DVec2], other: &[DVec2]) -> bool {
    let Some(first) = other.first().filter(|_| ring.len() == other.len()) else {
        return false;
    };
    ring.iter()
        .position(|corner| corner == first)
        .is_some_and(|at| {
            let (end, start) = ring.split_at(at);
            start.iter().chain(end).eq(other)
        })
}

/// Whether a column lies in its feature's envelope. One that does not is no part of the feature, and
/// an edit of it would not be seen to concern this tile.
fn lies_within(column: &SolidColumn, envelope: &Box3d) -> bool {
    column.top <= envelope.max.z
        && rings(column).flat_map(LineString::coords).all(|c| {
            (envelope.min.x..=envelope.max.x).contains(&c.x)
                && (envelope.min.y..=envelope.max.y).contains(&c.y)
        })
}

/// The box around a column.
fn around(column: &SolidColumn) -> Option<Box3d> {
    let plan = column.footprint.bounding_rect()?;
    let corner = |corner: Coord, z: f64| DVec3::new(corner.x, corner.y, z);
    Some(Box3d::new(
        corner(plan.min(), column.bottom),
        corner(plan.max(), column.top),
    ))
}

/// A position as it is stored.
fn index(position: usize) -> u32 {
    u32::try_from(position).expect("a tile holds fewer than 4 billion corners")
}

/// A stored range as positions.
pub fn positions(range: &Range<u32>) -> Range<usize> {
    range.start as usize..range.end as usize
}
