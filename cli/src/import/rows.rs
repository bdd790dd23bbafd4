//! Writing a batch of features.

use std::collections::HashMap;

use engine::{Box3d, SolidColumn};
use formats::{Changed, Feature, Skipped};
use geo::Polygon;
use postgres::Transaction;

use super::level::StoredModel;
use super::morton;
use super::solid::Solid;
use crate::database::{Copy, quoted};
use crate::failure::Failure;
use crate::scene::rings;
use crate::sql_types::{self, Ring};

/// Numbers of the features of a scene that have the names of others.
pub fn known(
    transaction: &mut Transaction<'_>,
    scene: &str,
    features: &[Feature],
) -> Result<HashMap<String, i64>, Failure> {
    let names: Vec<&str> = features
        .iter()
        .map(|feature| feature.name.as_str())
        .collect();
    let statement = format!(
        "SELECT name, id FROM {}.feature WHERE name = ANY ($1)",
        quoted(scene)
    );
    let rows = transaction.query(&statement, &[&names])?;
    Ok(rows.iter().map(|row| (row.get(0), row.get(1))).collect())
}

/// Numbers for new features.
pub fn new_ids(
    transaction: &mut Transaction<'_>,
    scene: &str,
    count: usize,
) -> Result<Vec<i64>, Failure> {
    let next =
        "SELECT nextval(pg_get_serial_sequence($1, 'id')) FROM generate_series(1, $2::bigint)";
    let table = format!("{}.feature", quoted(scene));
    let count = i64::try_from(count).unwrap_or(i64::MAX);
    let ids = transaction.query(next, &[&table, &count])?;
    Ok(ids.iter().map(|row| row.get(0)).collect())
}

/// The first slot that is free.
pub fn first_slot(transaction: &mut Transaction<'_>, scene: &str) -> Result<i32, Failure> {
    let last = format!(
        "SELECT coalesce(max(slot) + 1, 0) FROM {}.feature",
        quoted(scene)
    );
    Ok(transaction.query_one(&last, &[])?.get(0))
}

/// Writes the features, with these numbers and slots from the first one on.
pub fn features(
    transaction: &mut Transaction<'_>,
    scene: &str,
    ids: &[i64],
    first_slot: i32,
    features: &[Feature],
    solids: &[Solid],
) -> Result<(), Failure> {
    let envelopes: Vec<Box3d> = solids.iter().map(|solid| solid.envelope).collect();
    let slots = morton::ranks(&envelopes);
    let columns = "id, name, class, envelope, slot, outline, attributes";
    let mut copy = Copy::begin(transaction, scene, "feature", columns)?;
    for (i, feature) in features.iter().enumerate() {
        let envelope = sql_types::Box3d::from(envelopes[i]);
        let slot = i32::try_from(slots[i])
            .ok()
            .and_then(|slot| slot.checked_add(first_slot));
        let prism = solids[i].prism.as_ref();
        let outline = prism.map(|p| Ring(p.hull.iter().map(|p| p.to_array()).collect()));
        copy.row(&[
            &ids[i],
            &feature.name,
            &feature.class,
            &envelope,
            &slot,
            &outline,
            &feature.attributes,
        ])?;
    }
    copy.finish()
}

/// Writes meshes and what hides.
pub fn shapes(
    transaction: &mut Transaction<'_>,
    scene: &str,
    ids: &[i64],
    solids: &[Solid],
) -> Result<(), Failure> {
    meshes(transaction, scene, ids, solids)?;
    let hides = || {
        let numbered = ids.iter().zip(solids);
        numbered.filter_map(|(id, solid)| Some((id, solid.hides()?)))
    };
    let columns = "feature, box, grounded";
    let mut copy = Copy::begin(transaction, scene, "inner_envelope", columns)?;
    for (id, inner) in hides().filter_map(|(id, hides)| Some((id, hides.inner?))) {
        copy.row(&[id, &sql_types::Box3d::from(inner.bounds), &inner.grounded])?;
    }
    copy.finish()?;
    let columns = "feature, footprint, bottom, top, grounded";
    let mut copy = Copy::begin(transaction, scene, "solid_column", columns)?;
    for (id, hides) in hides() {
        for SolidColumn {
            footprint,
            bottom,
            top,
            grounded,
        } in &hides.columns.columns
        {
            copy.row(&[id, &rings(footprint), bottom, top, grounded])?;
        }
    }
    copy.finish()
}

fn meshes(
    transaction: &mut Transaction<'_>,
    scene: &str,
    ids: &[i64],
    solids: &[Solid],
) -> Result<(), Failure> {
    let columns = "feature, level_of_detail, vertices, triangles, defect, repair, repair_triangles";
    let mut copy = Copy::begin(transaction, scene, "mesh", columns)?;
    for (id, solid) in ids.iter().zip(solids) {
        let level_of_detail = solid.level_of_detail;
        let solid = &solid.solid;
        let vertices = solid.mesh.vertices.iter().flat_map(|v| v.to_array());
        let numbers = solid.mesh.triangles.as_flattened().iter();
        let added = solid.repair.map_or(0, |repair| repair.triangles);
        let added = i32::try_from(added).unwrap_or(i32::MAX);
        copy.row(&[
            id,
            &level_of_detail,
            &vertices.collect::<Vec<f64>>(),
            &numbers
                .map(|&number| number.cast_signed())
                .collect::<Vec<i32>>(),
            &solid.hides.as_ref().err().map(ToString::to_string),
            &solid.repair.map(|repair| repair.to_string()),
            &added,
        ])?;
    }
    copy.finish()
}

/// Writes the models of all levels of detail, shapes that several are instances of once.
pub fn models(
    transaction: &mut Transaction<'_>,
    scene: &str,
    ids: &[i64],
    solids: &[Solid],
) -> Result<(), Failure> {
    let insert = format!(
        "INSERT INTO {}.shape (digest, content) VALUES ($1, $2) ON CONFLICT DO NOTHING",
        quoted(scene)
    );
    let insert = transaction.prepare(&insert)?;
    for level in solids.iter().flat_map(|solid| &solid.levels) {
        if let StoredModel::Instance(shape, _) = &level.model {
            transaction.execute(&insert, &[&shape.digest.as_slice(), &shape.content])?;
        }
    }
    let columns = "feature, level_of_detail, format, content, shape, placement, geometric_error";
    let mut copy = Copy::begin(transaction, scene, "model", columns)?;
    for (id, solid) in ids.iter().zip(solids) {
        for level in &solid.levels {
            let (content, shape, placement) = match &level.model {
                StoredModel::Own(content) => (Some(content), None, None),
                StoredModel::Instance(shape, placement) => (
                    None,
                    Some(shape.digest.to_vec()),
                    Some(placement.rows.as_flattened().to_vec()),
                ),
            };
            copy.row(&[
                id,
                &level.level_of_detail,
                &"packed",
                &content,
                &shape,
                &placement,
                &level.geometric_error,
            ])?;
        }
    }
    copy.finish()
}

/// Writes which objects were left out or changed.
pub fn remarks(
    transaction: &mut Transaction<'_>,
    scene: &str,
    source: &str,
    skipped: &[Skipped],
    changed: &[Changed],
) -> Result<(), Failure> {
    let columns = "source, name, class, skipped, remark";
    let mut copy = Copy::begin(transaction, scene, "import_remark", columns)?;
    for Skipped { name, class, why } in skipped {
        copy.row(&[&source, name, class, &true, why])?;
    }
    for Changed { name, class, how } in changed {
        copy.row(&[&source, name, class, &false, how])?;
    }
    copy.finish()
}

/// Writes the streets.
pub fn streets(
    transaction: &mut Transaction<'_>,
    scene: &str,
    streets: &[(&str, Polygon<f64>, [f64; 2])],
) -> Result<(), Failure> {
    let columns = "name, area, eye_low, eye_high";
    let mut copy = Copy::begin(transaction, scene, "street", columns)?;
    for (name, area, [low, high]) in streets {
        copy.row(&[name, &rings(area), low, high])?;
    }
    copy.finish()
}
