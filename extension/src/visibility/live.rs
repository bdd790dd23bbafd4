//! What can be seen, found by the solver while the query runs.

use super::tiles::Tiles;
use crate::error::{Refusal, or_raise};
use crate::field_of_view::FieldOfView;
use crate::types::shortest;
use engine::{PointQuery, PointSolver, Sighting};
use glam::DVec3;
use pgrx::PgSqlErrorCode;
use std::cell::RefCell;

/// Metres by which the box that preselects all round is larger than the range, so that its rounding
/// loses nothing in range.
const RANGE_MARGIN: f64 = 1e-3;

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
        let reach = DVec3::splat(self.range + RANGE_MARGIN);
        let most = DVec3::splat(f64::MAX);
        engine::Box3d {
            min: (self.eye - reach).max(-most),
            max: (self.eye + reach).min(most),
        }
    }

    /// The features of a scene that may be seen in it, and how they were found.
    pub fn look(&self, scene: &str) -> (Vec<Seen>, Account) {
        let mut tiles = Tiles::around(scene, &self.bounds());
        let sightings = or_raise(self.solve(&mut tiles));
        let mut account = Account {
            above: sightings.len(),
            cached: tiles.cached,
            edited: tiles.edited(),
            ..Account::default()
        };
        (account.tiles, account.read) = tiles.counts();
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
        (seen, account)
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
