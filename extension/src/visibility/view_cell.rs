//! [`ViewCell`], the view cell of an eye, and the tile of what may be seen from it.

use super::cache::{self, Key};
use super::live::{Account, View};
use super::packed_tile::PackedTile;
use super::statements::{Ask, Statements};
use super::tables::Tables;
use super::tiles::Tiles;
use crate::error::Refusal;
use crate::snapshot_read::{Moment, argument};
use crate::types::{Box3d, Point3d, StoredSet};
use engine::FeatureSet;
use glam::DVec3;
use pgrx::IntoDatum;
use pgrx::pg_sys::{self, Datum};
use std::collections::HashMap;
use std::rc::Rc;

/// A view cell that is right under the snapshot of the query.
pub struct ViewCell {
    pub id: i64,
    pub bounds: engine::Box3d,
    /// Metres.
    pub range: f64,
    visible: Vec<u8>,
    snapshot: Vec<u8>,
}

impl ViewCell {
    /// That of an eye of the view region.
    pub fn around(eye: DVec3, statements: &Statements) -> Option<Self> {
        let arguments = [Point3d(eye).into_datum(), cluster_identity().into_datum()];
        let arguments: Vec<Datum> = arguments.into_iter().flatten().collect();
        let mut cell = None;
        let asked = statements.get(Ask::ViewCell);
        asked.read(Moment::Query, &arguments, |row| {
            let visible = row.get::<StoredSet>(1);
            let place = row.get::<Box3d>(2).zip(row.get::<f64>(3));
            let known_by = row.get::<i64>(4).zip(row.get::<&[u8]>(5));
            if let (Some(visible), Some((bounds, range)), Some((id, snapshot))) =
                (visible, place, known_by)
            {
                cell = Some(Self {
                    id,
                    bounds: bounds.0,
                    range,
                    visible: visible.get().bytes().to_vec(),
                    snapshot: snapshot.to_vec(),
                });
            }
        });
        cell
    }

    /// Slots of the features that may be seen from it.
    pub fn visible(&self) -> FeatureSet<'_> {
        FeatureSet::trusted(&self.visible)
    }

    /// The features that may be seen from it, as one tile; `None` if not all of them can be had. `account`
    /// takes down from which tiles they were gathered.
    ///
    /// As long as a cell is right, nothing near it is different from what its snapshot shows. So the tile
    /// of a set and a snapshot is the same whenever it is gathered, and may be kept.
    pub fn tile(
        &self,
        tables: Tables,
        statements: &Rc<Statements>,
        account: &mut Account,
    ) -> Result<Option<Rc<PackedTile>>, Refusal> {
        let key = Key::Gathered {
            namespace: tables.namespace(),
            snapshot: self.snapshot.clone(),
            visible: self.visible.clone(),
        };
        if let Some(tile) = cache::find(&key) {
            return Ok(Some(tile));
        }
        let Some(features) = self.features(statements) else {
            return Ok(None);
        };
        let near = View::all_round(self.bounds.center(), self.reach()).bounds();
        let mut tiles = Tiles::meeting(tables, statements, &near);
        let gathered = tiles.gather(features)?.map(Rc::new);
        account.count(&tiles);
        if let Some(tile) = &gathered {
            cache::keep(key, tile);
        }
        Ok(gathered)
    }

    /// How far from its middle a feature of its set may be, metres.
    fn reach(&self) -> f64 {
        self.range + self.bounds.size().max_element()
    }

    /// Ids and outer envelopes of the features of its set; `None` unless each slot has one.
    fn features(&self, statements: &Statements) -> Option<HashMap<i64, engine::Box3d>> {
        let slots: Result<Vec<i32>, _> = self.visible().numbers().map(i32::try_from).collect();
        let slots = slots.ok()?;
        let mut features = HashMap::with_capacity(slots.len());
        let count = slots.len();
        let mut rows = 0;
        statements
            .get(Ask::Slotted)
            .read(Moment::Query, &argument(slots), |row| {
                let feature = row.get::<i64>(1).zip(row.get::<Box3d>(2));
                features.extend(feature.map(|(id, envelope)| (id, envelope.0)));
                rows += 1;
            });
        (rows == count && features.len() == count).then_some(features)
    }
}

/// The cluster whose transactions snapshots are about, as a number of SQL.
pub fn cluster_identity() -> i64 {
    // SAFETY: reads what the server knows from its start on.
    unsafe { pg_sys::GetSystemIdentifier() }.cast_signed()
}
