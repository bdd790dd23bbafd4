//! What can be seen, found by the solver while the query runs: of all that is in range, or of what may be
//! seen from the view cell of the eye.

use super::counters::count_answer;
use super::packed_tile::PackedTile;
use super::statements::Statements;
use super::tables::Tables;
use super::tiles::Tiles;
use super::view_cell::ViewCell;
use crate::error::{Refusal, or_raise};
use crate::field_of_view::FieldOfView;
use crate::settings;
use crate::types::shortest;
use engine::{PointQuery, PointSolver, Sighting};
use glam::DVec3;
use pgrx::PgSqlErrorCode;
use std::cell::RefCell;
use std::rc::Rc;

/// Metres by which the box that preselects all round is larger than the range, so that its rounding
/// loses nothing in range.
pub const RANGE_MARGIN: f64 = 1e-3;

thread_local! {
    /// Its memory is kept from one query to the next.
    static SOLVER: RefCell<PointSolver> = RefCell::new(PointSolver::default());
}

/// What an observer asks.
pub struct View {
    eye: DVec3,
    range: f64,
    /// `None` all round.
    field: Option<FieldOfView>,
}

/// A feature that may be seen.
pub struct Seen {
    pub id: i64,
    pub class: String,
    pub envelope: engine::Box3d,
    /// Metres from the eye.
    pub distance: f64,
}

/// How an answer came about.
#[derive(Default)]
pub struct Account {
    /// Id of the view cell that was used, and how many features may be seen from it.
    pub cell: Option<(i64, usize)>,
    pub tiles: usize,
    pub read: usize,
    pub cached: usize,
    pub edited: usize,
    /// Features within range above the horizon.
    pub above: usize,
    /// Of these, in the field of view.
    pub in_view: usize,
    /// Of these, hidden by occlusion volumes.
    pub hidden: usize,
}

impl View {
    /// All round.
    pub fn all_round(eye: DVec3, range: f64) -> Self {
        Self {
            eye,
            range,
            field: None,
        }
    }

    /// What a field of view holds.
    pub fn of(field: FieldOfView) -> Self {
        let (eye, range) = field.eye_and_range();
        Self {
            eye,
            range,
            field: Some(field),
        }
    }

    /// A box that holds all of it.
    pub fn bounds(&self) -> engine::Box3d {
        within_reach(&engine::Box3d::new(self.eye, self.eye), self.range)
    }

    /// The features of a scene that may be seen in it, and how they were found.
    pub fn look(&self, scene: &str) -> (Vec<Seen>, Account) {
        let tables = Tables::of(scene);
        let statements = Statements::of(scene, &tables);
        let mut account = Account::default();
        let known = or_raise(self.known(tables, &statements, &mut account));
        let is_live = known.is_none();
        let mut tiles = match known {
            Some(tile) => Tiles::only(tables, &statements, tile),
            None => Tiles::meeting(tables, &statements, &self.bounds()),
        };
        let sightings = or_raise(self.solve(&mut tiles));
        account.above = sightings.len();
        if is_live {
            account.count(&tiles);
        }
        let prepared = self.field.map(|field| field.prepared());
        let mut seen: Vec<Seen> = sightings
            .iter()
            .filter_map(|sighting| tiles.seen(sighting))
            .filter(|seen| prepared.is_none_or(|field| field.meets(&seen.envelope)))
            .collect();
        account.in_view = seen.len();
        if !seen.is_empty() {
            let hidden = tiles.hidden_by_volumes(self.eye);
            seen.retain(|seen| !hidden.contains_key(&seen.id));
        }
        account.hidden = account.in_view - seen.len();
        count_answer(tables.namespace(), !is_live, account.hidden > 0, seen.len());
        (seen, account)
    }

    /// All that may be seen in range from the view cell of the eye, if there is one that the current user may
    /// rely on.
    fn known(
        &self,
        tables: Tables,
        statements: &Rc<Statements>,
        account: &mut Account,
    ) -> Result<Option<Rc<PackedTile>>, Refusal> {
        let may_know = settings::uses_cells()
            && tables.has_cells()
            && tables.has_tiles()
            && tables.may_read_cells();
        if !may_know {
            return Ok(None);
        }
        let cell = ViewCell::around(self.eye, statements);
        let Some(cell) = cell.filter(|cell| self.range <= cell.range) else {
            return Ok(None);
        };
        let tile = cell.tile(tables, statements, account)?;
        account.cell = tile.as_ref().map(|tile| (cell.id, tile.tile.len()));
        Ok(tile)
    }

    fn solve(&self, tiles: &mut Tiles) -> Result<Vec<Sighting>, Refusal> {
        let mut sightings = Vec::new();
        with_solver(|solver| solver.solve(&self.query(), tiles, &mut sightings))?;
        Ok(sightings)
    }

    /// The question for the solver.
    pub fn query(&self) -> PointQuery {
        PointQuery {
            eye: self.eye,
            range: self.range,
            prisms: true,
            wedge: self.field.and_then(|field| field.prepared().plan_wedge()),
        }
    }
}

impl Account {
    /// Takes down which tiles were looked at.
    pub fn count(&mut self, tiles: &Tiles) {
        (self.tiles, self.read) = tiles.counts();
        self.cached = tiles.cached;
        self.edited = tiles.edited();
    }
}

/// A box that holds all that is within range of another.
pub fn within_reach(bounds: &engine::Box3d, range: f64) -> engine::Box3d {
    let reach = DVec3::splat(range + RANGE_MARGIN);
    let most = DVec3::splat(f64::MAX);
    engine::Box3d {
        min: (bounds.min - reach).max(-most),
        max: (bounds.max + reach).min(most),
    }
}

/// Runs `work` with the solver of this backend. It is taken out meanwhile: an error while tiles are read
/// unwinds, and leaves a new one.
pub fn with_solver<T>(work: impl FnOnce(&mut PointSolver) -> T) -> T {
    let mut solver = SOLVER.take();
    let result = work(&mut solver);
    SOLVER.set(solver);
    result
}

/// A range that is finite and not negative; others raise an error.
pub fn checked_range(range: f64) -> f64 {
    if (0.0..f64::INFINITY).contains(&range) {
        return range;
    }
    Refusal::new(
        PgSqlErrorCode::ERRCODE_INVALID_PARAMETER_VALUE,
        format!("range {} is out of bounds", shortest(range)),
    )
    .detail("A range is a finite number of metres, 0 or more.")
    .raise()
}
