//! [`Snapshot`], the features as they were when long work on them began.

use super::solids::Solids;
use super::{failed, quoted};
use crate::types::Box3d;
use engine::OcclusionVolume;
use pgrx::Spi;
use pgrx::datum::DatumWithOid;
use std::collections::{HashMap, HashSet};

/// A feature to be hidden: its number and outer envelope.
pub type Target = (i64, engine::Box3d);

/// What hides and what is hidden, as read.
pub struct Snapshot {
    /// What hides.
    pub solids: Solids,
    /// All features, those near each other in turn.
    pub targets: Vec<Target>,
    envelope_of: HashMap<i64, engine::Box3d>,
}

impl Snapshot {
    /// Reads a scene.
    pub fn read(scene: &str) -> Self {
        let scene = quoted(scene);
        let targets = targets(
            &format!("SELECT id, envelope FROM {scene}.feature ORDER BY slot NULLS LAST, id"),
            &[],
        );
        Self {
            solids: Solids::read(&scene, "true", &[]),
            envelope_of: targets.iter().copied().collect(),
            targets,
        }
    }

    /// Drops the volumes whose features have changed or gone meanwhile, or are being edited. The
    /// others' rows stay locked until the commit, after which triggers take care of their volumes.
    /// It never waits for an edit, which may wait for it.
    pub fn drop_changed(&self, scene: &str, batch: &[Target], volumes: &mut Vec<OcclusionVolume>) {
        let names: Vec<i64> = batch.iter().map(|(feature, _)| *feature).collect();
        let theirs = "OPERATOR(pg_catalog.=) ANY ($1) FOR SHARE SKIP LOCKED";
        let scene = quoted(scene);
        let envelopes: HashMap<i64, engine::Box3d> = targets(
            &format!("SELECT id, envelope FROM {scene}.feature WHERE id {theirs}"),
            &[names.into()],
        )
        .into_iter()
        .collect();
        let mut names: Vec<i64> = volumes.iter().map(|volume| volume.occluder).collect();
        names.sort_unstable();
        names.dedup();
        let solids = Solids::read(
            &scene,
            &format!("feature {theirs}"),
            &[names.clone().into()],
        );
        let same: HashSet<i64> = names
            .into_iter()
            .filter(|&feature| self.solids.same(&solids, feature))
            .collect();
        volumes.retain(|volume| {
            envelopes.get(&volume.occludee) == self.envelope_of.get(&volume.occludee)
                && same.contains(&volume.occluder)
        });
    }
}

/// The features that a query of id, envelope returns.
fn targets(query: &str, arguments: &[DatumWithOid]) -> Vec<Target> {
    // A read-only query may not lock rows.
    let rows = Spi::connect_mut(|client| {
        client
            .update(query, None, arguments)?
            .map(|row| Ok((row.get::<i64>(1)?, row.get::<Box3d>(2)?)))
            .collect::<Result<Vec<_>, pgrx::spi::Error>>()
    });
    rows.unwrap_or_else(|error| failed(&error))
        .into_iter()
        .filter_map(|(feature, bounds)| Some((feature?, bounds?.0)))
        .collect()
}
