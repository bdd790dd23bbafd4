//! [`CellSolver`], the visible set of a view cell.

use std::collections::{HashMap, HashSet};
use std::iter::successors;

use glam::DVec3;

use super::behind::{may_be_behind, widened};
use super::scene::{CellScene, Plain, Stage};
use crate::point_visibility::{Known, Sifting, Spot};
use crate::{Box3d, PointQuery, PointSolver};

/// Half edge in metres above which a cell is divided at once: less than half a building is left of a
/// larger erosion.
const LARGEST: f64 = 2.0;

/// Half edge in metres of the smallest cells from whose middle one looks what can be seen: from smaller
/// ones hardly anything is that was not from larger ones.
const LEAST_SAMPLED: f64 = 0.5;

/// What is asked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CellQuery {
    /// Where eyes may be, metres.
    pub bounds: Box3d,
    /// How far they see, metres (Euclidean); may be infinite.
    pub range: f64,
    /// Parts of the cell whose half edges are no longer than this, metres, are not divided further.
    /// Infinite: the cell is not divided at all.
    pub precision: f64,
}

impl CellQuery {
    /// Half edges of the squares by which what is around is eroded to answer it, metres, the longest first.
    pub fn erosions(&self) -> impl Iterator<Item = f64> + use<> {
        let precision = self.precision;
        let mut first = half(&self.bounds);
        while is_divided_at_once(first, precision) {
            first *= 0.5;
        }
        successors(Some(first), move |&half| {
            (half > precision).then_some(0.5 * half)
        })
    }
}

/// A feature that may be seen from somewhere in a view cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CellSighting {
    /// Positions of its tile and its own.
    pub feature: (usize, usize),
    /// An eye from which it is not known to be hidden, or the middle of a part of the cell.
    pub eye: DVec3,
}

/// Finds what can be seen from anywhere in a view cell.
///
/// Conservative: what it leaves out can be seen from no eye in the cell that is outside of all solids
/// (`docs/how-it-works.md`, "From a view cell"). Its memory is kept from one cell to the next.
#[derive(Debug, Default)]
pub struct CellSolver {
    pub(super) points: PointSolver,
    /// With an eye that sees each.
    seen: HashMap<Spot, DVec3>,
    /// How many problems of a point were solved.
    pub solves: usize,
}

/// What is not known to be hidden from all of a cell, nor seen from some of it.
struct Left {
    /// Features with their outer envelopes.
    features: Vec<(Spot, Box3d)>,
    /// Tiles of what may hide them.
    tiles: Vec<usize>,
}

impl CellSolver {
    /// The features that may be seen from somewhere in a cell, in the order of their positions; `None` as
    /// soon as `cancelled` says so. `is_open` says whether an eye may be anywhere in a box,
    /// which may be a single point; if in doubt, it may.
    pub fn solve(
        &mut self,
        scene: &CellScene,
        query: &CellQuery,
        is_open: &dyn Fn(&Box3d) -> bool,
        cancelled: &dyn Fn() -> bool,
    ) -> Option<Vec<CellSighting>> {
        self.search(scene, query, None, HashSet::new(), is_open, cancelled)
    }

    /// The features that may be seen from somewhere in a cell now that others are gone from their places, besides
    /// those that could be seen before; as [`Self::solve`] has them. `is_known` says of the number of a
    /// feature whether it could.
    ///
    /// What was hidden from the cell and is not behind the place of what is gone, as seen from there, is hidden by what is
    /// left. What is gone and could not be seen itself does not matter (`docs/how-it-works.md`, "When a cell counts").
    pub fn solve_behind(
        &mut self,
        scene: &CellScene,
        query: &CellQuery,
        gone: &[Box3d],
        is_known: &dyn Fn(i64) -> bool,
        is_open: &dyn Fn(&Box3d) -> bool,
        cancelled: &dyn Fn() -> bool,
    ) -> Option<Vec<CellSighting>> {
        let is_out = |feature: (usize, usize)| {
            let (id, bounds) = scene.feature(feature);
            let is_behind = |place| may_be_behind(&query.bounds, place, &bounds);
            is_known(id) || !gone.iter().any(is_behind)
        };
        let spot = |(tile, feature): (usize, usize)| Spot { tile, feature };
        let out = scene.features().filter(|&feature| is_out(feature));
        let out: HashSet<Spot> = out.map(spot).collect();
        self.search(scene, query, Some(gone), out, is_open, cancelled)
    }

    /// Decides all features but some, or what of them is seen through some places.
    fn search(
        &mut self,
        scene: &CellScene,
        query: &CellQuery,
        through: Option<&[Box3d]>,
        out: HashSet<Spot>,
        is_open: &dyn Fn(&Box3d) -> bool,
        cancelled: &dyn Fn() -> bool,
    ) -> Option<Vec<CellSighting>> {
        self.seen.clear();
        self.seen
            .extend(out.iter().map(|spot| (*spot, DVec3::ZERO)));
        self.solves = 0;
        let mut search = Search {
            through,
            solver: self,
            scene,
            stages: HashMap::new(),
            range: query.range,
            precision: query.precision,
            is_open,
            cancelled,
        };
        search.divide(query.bounds);
        if cancelled() {
            return None;
        }
        let sighting = |(spot, eye): (&Spot, &DVec3)| CellSighting {
            feature: (spot.tile, spot.feature),
            eye: *eye,
        };
        let seen = self.seen.iter().filter(|(spot, _)| !out.contains(spot));
        let mut seen: Vec<CellSighting> = seen.map(sighting).collect();
        seen.sort_unstable_by_key(|sighting| sighting.feature);
        Some(seen)
    }

    /// Notes what is seen from a point.
    fn look_from(&mut self, scene: &CellScene, eye: DVec3, range: f64) {
        let query = PointQuery {
            eye,
            range,
            prisms: true,
            wedge: None,
        };
        let mut sightings = Vec::new();
        let Ok(()) = self.points.solve(&query, &mut Plain(scene), &mut sightings);
        self.solves += 1;
        let spots = sightings.iter().map(|seen| Spot {
            tile: seen.tile,
            feature: seen.feature,
        });
        self.note(spots, eye);
    }

    /// Notes what is seen from an eye.
    fn note(&mut self, spots: impl Iterator<Item = Spot>, eye: DVec3) {
        for spot in spots {
            self.seen.entry(spot).or_insert(eye);
        }
    }
}

struct Search<'a> {
    solver: &'a mut CellSolver,
    scene: &'a CellScene,
    /// By the bits of the size of erosion.
    stages: HashMap<Option<u64>, Stage<'a>>,
    range: f64,
    precision: f64,
    /// Only what is seen through these places is asked for; `None`: all is.
    through: Option<&'a [Box3d]>,
    is_open: &'a dyn Fn(&Box3d) -> bool,
    cancelled: &'a dyn Fn() -> bool,
}

impl Search<'_> {
    /// Divides a cell until its parts are small enough to be solved.
    fn divide(&mut self, cell: Box3d) {
        if !(self.is_open)(&cell) || (self.cancelled)() {
            return;
        }
        if is_divided_at_once(half(&cell), self.precision) {
            for part in parts(&cell) {
                self.divide(part);
            }
            return;
        }
        // A look from some points tells most of what can be seen at all, and nothing that is new since something went.
        if self.through.is_none() {
            self.look_around(&cell);
        }
        let left = self.sift(&cell, None);
        self.refine(&cell, left);
    }

    /// Finds out which of some features can be seen from somewhere in a cell, of which nothing hides them
    /// that hides from everywhere.
    fn refine(&mut self, cell: &Box3d, mut left: Left) {
        if left.features.is_empty() || (self.cancelled)() {
            return;
        }
        let half = half(cell);
        if half <= self.precision {
            let spots = left.features.iter().map(|(spot, _)| *spot);
            self.solver.note(spots, top(cell));
            return;
        }
        if half >= LEAST_SAMPLED {
            self.see(top(cell), &left);
        }
        for part in parts(cell) {
            left.features
                .retain(|(spot, _)| !self.solver.seen.contains_key(spot));
            if left.features.is_empty() {
                return;
            }
            if (self.is_open)(&part) {
                let still = self.sift(&part, Some(&left));
                self.refine(&part, still);
            }
        }
    }

    /// Notes what is seen from two points halfway between the middle of a cell and its corners.
    fn look_around(&mut self, cell: &Box3d) {
        let [first, .., last] = around(cell);
        for eye in [first, last] {
            if self.is_eye(eye) {
                self.solver.look_from(self.scene, eye, self.range);
            }
        }
    }

    fn is_eye(&self, place: DVec3) -> bool {
        (self.is_open)(&Box3d::new(place, place)) && !self.scene.holds(place)
    }

    /// Notes which of some features can be seen from a point, if an eye may be there.
    fn see(&mut self, eye: DVec3, left: &Left) {
        if self.is_eye(eye) {
            let near = Box3d::new(eye, eye);
            let seen = self.sift_from(eye, near, None, Some(left));
            let spots = seen.features.iter().map(|(spot, _)| *spot);
            self.solver.note(spots, eye);
        }
    }

    /// Finds which features are not hidden from all of a cell.
    fn sift(&mut self, cell: &Box3d, before: Option<&Left>) -> Left {
        self.sift_from(top(cell), *cell, Some(half(cell)), before)
    }

    fn sift_from(
        &mut self,
        eye: DVec3,
        near: Box3d,
        half: Option<f64>,
        before: Option<&Left>,
    ) -> Left {
        let through = self.through;
        let through = through.and_then(|places| widened(places, eye, half.unwrap_or(0.0)));
        let sifting = Sifting {
            eye,
            near,
            range: self.range,
            first_hiding: self.scene.len(),
            known: before.map(|left| Known {
                features: &left.features,
                tiles: &left.tiles,
            }),
            through: through.as_deref(),
        };
        let scene = self.scene;
        let stage = self
            .stages
            .entry(half.map(f64::to_bits))
            .or_insert_with(|| Stage::new(scene, half));
        let CellSolver {
            points,
            seen,
            solves,
        } = &mut *self.solver;
        *solves += 1;
        let mut features = Vec::new();
        let skip = |spot: Spot| seen.contains_key(&spot);
        let Ok(tiles) = points.sift(&sifting, stage, skip, |spot, envelope| {
            features.push((spot, envelope));
        });
        Left { features, tiles }
    }
}

/// Half of the longer edge in plan, metres.
pub(super) fn half(cell: &Box3d) -> f64 {
    0.5 * cell.size().truncate().max_element()
}

/// Whether a cell of this half edge, metres, is divided before anything is eroded.
fn is_divided_at_once(half: f64, precision: f64) -> bool {
    half > LARGEST.max(precision)
}

/// The middle of its upper face, from where nothing is hidden that is not from below it, too.
pub(super) fn top(cell: &Box3d) -> DVec3 {
    cell.center().with_z(cell.max.z)
}

/// Points halfway between the middle of its upper face and the corners of that.
fn around(cell: &Box3d) -> [DVec3; 4] {
    let corners = cell.corners();
    [4, 5, 6, 7].map(|at: usize| corners[at].midpoint(top(cell)))
}

/// A cell, divided in plan where it is longer than half of its longer edge.
pub(super) fn parts(cell: &Box3d) -> impl Iterator<Item = Box3d> + use<> {
    let size = cell.size().truncate();
    let is_long = size.to_array().map(|edge| 2.0 * edge > size.max_element());
    let (cell, middle) = (*cell, cell.center());
    (0..4_usize).filter_map(move |part| {
        let mut half = cell;
        for axis in 0..2 {
            match (is_long[axis], part >> axis & 1) {
                (true, 0) => half.max[axis] = middle[axis],
                (true, _) => half.min[axis] = middle[axis],
                (false, 0) => {}
                (false, _) => return None,
            }
        }
        Some(half)
    })
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use geo::{Rect, coord};

    use super::*;
    use crate::{CellTile, SolidColumn, Tile, TileFeature};

    /// Two rows of houses, one behind the other as seen from below.
    fn rows() -> Arc<CellTile> {
        let house = |at: i64| {
            let (x, y) = ((at % 6) as f64 * 8.0, 20.0 + (at / 6) as f64 * 30.0);
            let bounds = Box3d::new(DVec3::new(x, y, 0.0), DVec3::new(x + 8.0, y + 10.0, 9.0));
            let corners = (coord! { x: x, y: y }, coord! { x: x + 8.0, y: y + 10.0 });
            TileFeature {
                id: at,
                envelope: bounds,
                outline: Vec::new(),
                roof: None,
                columns: vec![SolidColumn {
                    footprint: Rect::new(corners.0, corners.1).to_polygon(),
                    bottom: 0.0,
                    top: 9.0,
                    grounded: true,
                }],
            }
        };
        let houses: Vec<TileFeature> = (0..12).map(house).collect();
        Arc::new(CellTile::new(Tile::new(&houses)))
    }

    fn query(edge: f64, precision: f64) -> CellQuery {
        let min = DVec3::new(20.0, 0.0, 1.5);
        CellQuery {
            bounds: Box3d::new(min, min + DVec3::new(edge, edge, 0.5)),
            range: 300.0,
            precision,
        }
    }

    #[test]
    fn the_erosions_of_a_query_are_known_ahead() {
        let erosions =
            |edge, precision| -> Vec<f64> { query(edge, precision).erosions().collect() };
        assert_eq!(erosions(16.0, 0.25), [2.0, 1.0, 0.5, 0.25]);
        assert_eq!(erosions(3.0, 0.5), [1.5, 0.75, 0.375]);
        assert_eq!(erosions(16.0, f64::INFINITY), [8.0]);
        for query in [query(16.0, 0.25), query(16.0, f64::INFINITY)] {
            let tile = rows();
            let scene = CellScene::new(vec![Arc::clone(&tile)]);
            query.erosions().for_each(|half| scene.erode(half));
            let made = tile.corner_count();
            CellSolver::default().solve(&scene, &query, &|_| true, &|| false);
            assert_eq!(tile.corner_count(), made);
        }
    }

    #[test]
    fn an_infinite_precision_divides_nothing() {
        let scene = CellScene::new(vec![rows()]);
        let mut solver = CellSolver::default();
        let mut set = |precision| {
            let set = solver.solve(&scene, &query(16.0, precision), &|_| true, &|| false);
            let set = set.unwrap_or_default().into_iter();
            let set: Vec<(usize, usize)> = set.map(|sighting| sighting.feature).collect();
            (set, solver.solves)
        };
        let ((divided, _), (whole, solves)) = (set(0.25), set(f64::INFINITY));
        // From two points, and once from everywhere.
        assert_eq!((solves, whole.len()), (3, 12));
        assert!(divided.len() < 12 && divided.iter().all(|spot| whole.contains(spot)));
    }
}
