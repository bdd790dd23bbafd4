//! [`PointSolver`], what can be seen from one eye.

use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::convert::Infallible;
use std::ops::ControlFlow;

use glam::{DVec2, DVec3};

use super::horizon::Horizon;
use super::occluder::{Measure, Wall, WallFinder};
use super::projection::{Edge, Span, chebyshev};
use super::target::{edge_slopes, outline_slopes};
use super::tile::{Feature, Tile, TileFeature, positions};
use super::{EYE_MARGIN, SHALLOW, SLOPE_MARGIN};
use crate::{Box3d, PlanWedge, in_range};

/// Squared distances below this share of the squared range are in range whatever the roundings.
const PLAINLY_IN_RANGE: f64 = 0.999;

/// Where tiles come from: all their boxes are known, and what is in one only where it is asked for.
pub trait TileSource {
    /// Why a tile could not be had.
    type Error;

    /// A box that holds all of each tile.
    fn bounds(&self) -> &[Box3d];

    /// The tile at a position.
    ///
    /// # Errors
    /// As the source has them.
    fn tile(&mut self, position: usize) -> Result<&Tile, Self::Error>;

    /// Whether what a tile says of a feature is out of date: it is passed over then, as if it were not
    /// in the tile. The boxes around it may still hold it.
    fn is_outdated(&self, _tile: usize, _feature: i64) -> bool {
        false
    }
}

/// What is asked.
#[derive(Clone, Copy, Debug)]
pub struct PointQuery {
    /// The observer's eye, metres.
    pub eye: DVec3,
    /// How far the eye sees, metres (Euclidean); may be infinite.
    pub range: f64,
    /// Whether features whose outer prism or roof is hidden are left out, or only those whose outer
    /// envelope is.
    pub prisms: bool,
    /// In which directions the eye looks, if not in all. What can be seen only in others is not
    /// reported.
    pub wedge: Option<PlanWedge>,
}

/// A feature that may be seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sighting {
    /// Position of its tile.
    pub tile: usize,
    /// Its position in the tile.
    pub feature: usize,
    /// Distance of its outer envelope from the eye, metres.
    pub distance: f64,
}

/// Finds what can be seen from one point, by an occlusion horizon that is raised front to back.
///
/// Conservative: what it leaves out cannot be seen (`docs/how-it-works.md`, "From a point"). Its
/// memory is kept from one query to the next.
#[derive(Debug)]
pub struct PointSolver {
    pub(super) horizon: Horizon,
    /// The same with raised walls, once there are some.
    raised: Horizon,
    has_raised: bool,
    /// What is left to visit, nearest first.
    open: BinaryHeap<ByDepth<Visit>>,
    /// Walls that the walk has not passed yet, nearest far end first.
    pending: BinaryHeap<ByDepth<usize>>,
    /// All walls of this walk; `pending` has their positions.
    walls: Vec<Wall>,
    pub(super) finder: WallFinder,
    /// Corners of the prism in hand, relative to the eye.
    outline: Vec<DVec2>,
    /// The nearest walls all around, joined.
    pub(super) fronts: Vec<Span>,
}

impl Default for PointSolver {
    fn default() -> Self {
        Self {
            horizon: Horizon::new(),
            raised: Horizon::new(),
            has_raised: false,
            open: BinaryHeap::new(),
            pending: BinaryHeap::new(),
            walls: Vec::new(),
            finder: WallFinder::default(),
            outline: Vec::new(),
            fronts: Vec::new(),
        }
    }
}

impl PointSolver {
    /// Adds to `visible` all features in range that may be seen, nearest box in plan first.
    ///
    /// # Errors
    /// Those of the source.
    pub fn solve<S: TileSource>(
        &mut self,
        query: &PointQuery,
        source: &mut S,
        visible: &mut Vec<Sighting>,
    ) -> Result<(), S::Error> {
        self.begin();
        if let Some(wedge) = &query.wedge {
            self.horizon.shut_between(wedge.left, wedge.right);
        }
        self.walk(query, source, &mut Finder { visible })
    }

    /// Visits what is in range front to back.
    ///
    /// # Errors
    /// Those of the source.
    pub(super) fn walk<S: TileSource>(
        &mut self,
        query: &PointQuery,
        source: &mut S,
        walker: &mut impl Walker,
    ) -> Result<(), S::Error> {
        for (tile, bounds) in source.bounds().iter().enumerate() {
            if walker.wants(query, bounds) {
                self.open(query.eye, tile, What::Tile, bounds);
            }
        }
        self.visit(query, source, walker)
    }

    /// Visits what is open, and what is found there, front to back.
    ///
    /// # Errors
    /// Those of the source.
    pub(super) fn visit<S: TileSource>(
        &mut self,
        query: &PointQuery,
        source: &mut S,
        walker: &mut impl Walker,
    ) -> Result<(), S::Error> {
        while let Some(ByDepth { depth, item: visit }) = self.open.pop() {
            walker.advance(self, depth);
            let at = match visit.what {
                What::Tile => {
                    if !walker.skips(self, query.eye, &source.bounds()[visit.tile]) {
                        let root = source.tile(visit.tile)?.tree.nodes.first().copied();
                        if let Some(root) = root
                            && walker.wants(query, &root.bounds)
                        {
                            self.open(query.eye, visit.tile, What::Node(0), &root.bounds);
                        }
                    }
                    continue;
                }
                What::Node(at) => at,
                What::Feature(position) => {
                    let tile = source.tile(visit.tile)?;
                    let feature = &tile.features[position];
                    let (id, envelope) = (feature.id, feature.envelope);
                    if !walker.skips(self, query.eye, &envelope)
                        && !source.is_outdated(visit.tile, id)
                    {
                        let tile = source.tile(visit.tile)?;
                        walker.meet(self, query, visit.tile, tile, position);
                    }
                    walker.leave(self, visit.tile, position);
                    continue;
                }
            };
            let tile = source.tile(visit.tile)?;
            let node = &tile.tree.nodes[at as usize];
            if walker.skips(self, query.eye, &node.bounds) {
                continue;
            }
            for child in node.children() {
                let (what, bounds) = match node.is_leaf {
                    true => (
                        What::Feature(child as usize),
                        &tile.features[child as usize].envelope,
                    ),
                    false => (What::Node(child), &tile.tree.nodes[child as usize].bounds),
                };
                if walker.wants(query, bounds) {
                    self.open(query.eye, visit.tile, what, bounds);
                }
            }
        }
        Ok(())
    }

    /// Forgets the last query.
    pub(super) fn begin(&mut self) {
        self.horizon.clear();
        self.has_raised = false;
        self.open.clear();
        self.pending.clear();
        self.walls.clear();
    }

    /// Puts a box among those to visit.
    pub(super) fn open(&mut self, eye: DVec3, tile: usize, what: What, bounds: &Box3d) {
        self.open.push(ByDepth {
            depth: depth(eye, bounds),
            item: Visit { tile, what },
        });
    }

    /// Raises the horizon by all walls that are nearer than all that is still to be visited.
    pub(super) fn pass(&mut self, depth: f64) {
        while let Some(nearest) = self.pending.peek()
            && nearest.depth < depth
        {
            let wall = self.walls[nearest.item];
            self.pending.pop();
            self.raise(&wall);
        }
    }

    fn raise(&mut self, wall: &Wall) {
        if !wall.is_raised {
            self.horizon.raise(&wall.slopes);
        } else if !self.has_raised {
            self.raised.clone_from(&self.horizon);
            self.has_raised = true;
        }
        if self.has_raised {
            self.raised.raise(&wall.slopes);
        }
    }

    /// The horizon for what is in a box.
    fn horizon_for(&self, eye: DVec3, bounds: &Box3d) -> &Horizon {
        match self.has_raised && is_shallow(eye, bounds) {
            true => &self.raised,
            false => &self.horizon,
        }
    }

    /// A feature whose envelope is not hidden, unless its prism or its roof is.
    pub(super) fn meet(
        &mut self,
        query: &PointQuery,
        tile_position: usize,
        tile: &Tile,
        position: usize,
    ) -> Option<Sighting> {
        let feature = &tile.features[position];
        let outline = &tile.corners[positions(&feature.outline)];
        let is_beside = depth(query.eye, &feature.envelope) > EYE_MARGIN;
        if query.prisms && is_beside {
            let is_hidden = match (tile.ridges(feature), outline) {
                ([], []) => false,
                ([], _) => {
                    let eye = query.eye.truncate();
                    self.outline.clear();
                    self.outline
                        .extend(outline.iter().map(|&corner| corner - eye));
                    let horizon = self.horizon_for(query.eye, &feature.envelope);
                    is_below(horizon, &self.outline, feature.envelope.max.z - query.eye.z)
                }
                // Its roof is below its prism.
                _ => {
                    let horizon = self.horizon_for(query.eye, &feature.envelope);
                    is_roof_below(horizon, query.eye, tile, feature)
                }
            };
            if is_hidden {
                return None;
            }
        }
        Some(Sighting {
            tile: tile_position,
            feature: position,
            distance: feature.envelope.distance_to_point(query.eye),
        })
    }

    /// Takes the walls of a feature; each joins the horizon when the walk has passed it and the depth
    /// that is given for it.
    pub(super) fn take_walls(
        &mut self,
        eye: DVec3,
        tile: &Tile,
        position: usize,
        beyond: impl Fn(&Span) -> f64,
    ) {
        let (walls, pending, horizon) = (&mut self.walls, &mut self.pending, &self.horizon);
        let found = &mut |wall: Wall| {
            if horizon.covers(&wall.slopes) {
                return;
            }
            pending.push(ByDepth {
                depth: wall.depth.max(beyond(&wall.slopes)),
                item: walls.len(),
            });
            walls.push(wall);
        };
        let adds = |edge: &Edge, height: f64| !horizon.is_above(edge, height);
        let feature = &tile.features[position];
        self.finder
            .walls(tile, feature, eye, Measure::Slope, &adds, found);
    }

    /// Whether a box is below the horizon.
    pub(super) fn hides_box(&self, eye: DVec3, bounds: &Box3d) -> bool {
        depth(eye, bounds) > EYE_MARGIN
            && is_below(
                self.horizon_for(eye, bounds),
                &plan_corners(eye, bounds),
                bounds.max.z - eye.z,
            )
    }
}

/// Whether a prism is below a horizon: its corners in plan, relative to the eye, which is beside it, and
/// its top above the eye.
pub(super) fn is_below(horizon: &Horizon, corners: &[DVec2], top: f64) -> bool {
    outline_slopes(corners, top, |line| while_hidden(horizon, line)).is_continue()
}

/// Whether all edges of a roof are below a horizon. The eye is beside what it is the roof of.
fn is_roof_below(horizon: &Horizon, eye: DVec3, tile: &Tile, feature: &Feature) -> bool {
    tile.ridges(feature).iter().all(|&ridge| {
        let [from, to] = tile.ends(feature, ridge).map(|end| end - eye);
        edge_slopes(from, to, |line| while_hidden(horizon, line)).is_continue()
    })
}

fn while_hidden(horizon: &Horizon, line: &Span) -> ControlFlow<()> {
    if horizon.hides(line) {
        ControlFlow::Continue(())
    } else {
        ControlFlow::Break(())
    }
}

/// Whether all of a box is seen over slopes that are not lower than [`SHALLOW`].
pub(super) fn is_shallow(eye: DVec3, bounds: &Box3d) -> bool {
    let foot = bounds.min.z - eye.z;
    foot >= 0.0 || foot * (1.0 + SLOPE_MARGIN) >= SHALLOW * depth(eye, bounds)
}

/// As [`in_range`], with no root where the answer is plain.
fn is_in_range(query: &PointQuery, bounds: &Box3d) -> bool {
    let nearest = query.eye.clamp(bounds.min, bounds.max) - query.eye;
    let share = nearest.length_squared() / (query.range * query.range);
    if share < PLAINLY_IN_RANGE {
        true
    } else {
        in_range(query.eye, query.range, bounds)
    }
}

/// The corners of a box in plan, anticlockwise and relative to the eye.
pub(super) fn plan_corners(eye: DVec3, bounds: &Box3d) -> [DVec2; 4] {
    let (min, max) = ((bounds.min - eye).truncate(), (bounds.max - eye).truncate());
    [min, DVec2::new(max.x, min.y), max, DVec2::new(min.x, max.y)]
}

/// How near a box is in plan, by the greater of both offsets: the least depth of all its points.
pub(super) fn depth(eye: DVec3, bounds: &Box3d) -> f64 {
    let nearest = DVec2::ZERO.clamp((bounds.min - eye).truncate(), (bounds.max - eye).truncate());
    chebyshev(nearest)
}

/// What a walk does on its way.
pub(super) trait Walker {
    /// Whether a box is to be visited.
    fn wants(&self, query: &PointQuery, bounds: &Box3d) -> bool {
        is_in_range(query, bounds)
    }

    /// Nothing nearer than this will be met any more.
    fn advance(&mut self, solver: &mut PointSolver, depth: f64) {
        solver.pass(depth);
    }

    /// Whether what is in a box is passed by.
    fn skips(&self, solver: &PointSolver, eye: DVec3, bounds: &Box3d) -> bool {
        solver.hides_box(eye, bounds)
    }

    /// A feature that was visited: it was met, or passed by.
    fn leave(&mut self, _solver: &mut PointSolver, _tile: usize, _position: usize) {}

    /// A feature that is not passed by.
    fn meet(
        &mut self,
        solver: &mut PointSolver,
        query: &PointQuery,
        tile_position: usize,
        tile: &Tile,
        position: usize,
    );
}

/// Finds what can be seen.
struct Finder<'a> {
    visible: &'a mut Vec<Sighting>,
}

impl Walker for Finder<'_> {
    fn meet(
        &mut self,
        solver: &mut PointSolver,
        query: &PointQuery,
        tile_position: usize,
        tile: &Tile,
        position: usize,
    ) {
        if let Some(sighting) = solver.meet(query, tile_position, tile, position) {
            self.visible.push(sighting);
            solver.take_walls(query.eye, tile, position, |_| 0.0);
        }
    }
}

/// Something to visit.
#[derive(Clone, Copy, Debug)]
struct Visit {
    tile: usize,
    what: What,
}

/// What of a tile.
#[derive(Clone, Copy, Debug)]
pub(super) enum What {
    /// All of it, while only its box is known.
    Tile,
    /// A node of its tree.
    Node(u32),
    /// A feature.
    Feature(usize),
}

/// Something in a heap that has the least depth on top.
#[derive(Clone, Copy, Debug)]
pub(super) struct ByDepth<T> {
    pub depth: f64,
    pub item: T,
}

impl<T> Ord for ByDepth<T> {
    fn cmp(&self, other: &Self) -> Ordering {
        other.depth.total_cmp(&self.depth)
    }
}

impl<T> PartialOrd for ByDepth<T> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<T> PartialEq for ByDepth<T> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl<T> Eq for ByDepth<T> {}

/// One tile, in memory.
struct Single<'a> {
    tile: &'a Tile,
    bounds: Vec<Box3d>,
}

impl TileSource for Single<'_> {
    type Error = Infallible;

    fn bounds(&self) -> &[Box3d] {
        &self.bounds
    }

    fn tile(&mut self, _: usize) -> Result<&Tile, Infallible> {
        Ok(self.tile)
    }
}

/// The numbers of those features that may be seen, of a scene that is given whole.
#[must_use]
pub fn visible_from_point(features: &[TileFeature], query: &PointQuery) -> Vec<i64> {
    let tile = Tile::new(features);
    let bounds = tile.bounds().into_iter().collect();
    let mut source = Single {
        tile: &tile,
        bounds,
    };
    let mut visible = Vec::new();
    let Ok(()) = PointSolver::default().solve(query, &mut source, &mut visible);
    visible
        .iter()
        .map(|seen| tile.feature(seen.feature).0)
        .collect()
}
