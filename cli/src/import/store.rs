//! Writing an import into its scene, all within one transaction.

use engine::{Box3d, Street};
use postgres::Transaction;

use super::model::Model;
use super::morton;
use super::solid::Solid;
use crate::database::{Copy, quoted};
use crate::failure::Failure;
use crate::scene::rings;
use crate::sql_types;

/// Makes sure that the scene is there and can take the features; returns the outer envelopes of
/// those that it holds already.
pub fn prepare(
    transaction: &mut Transaction<'_>,
    scene: &str,
    model: &Model,
    replace: bool,
) -> Result<Vec<Box3d>, Failure> {
    let exists = "SELECT EXISTS (SELECT FROM pg_catalog.pg_namespace WHERE nspname = $1)";
    let mut exists: bool = transaction.query_one(exists, &[&scene])?.get(0);
    if exists && replace {
        transaction.execute("SELECT occlusion.drop_scene($1)", &[&scene])?;
        exists = false;
    }
    if !exists {
        transaction.execute(
            "SELECT occlusion.create_scene($1, $2)",
            &[&scene, &model.srid],
        )?;
        return Ok(Vec::new());
    }
    transaction.execute("SELECT occlusion.require_scene($1)", &[&scene])?;
    refuse_other_frame(transaction, scene, model.srid)?;
    refuse_known_names(transaction, scene, model)?;
    let envelopes = format!("SELECT envelope FROM {}.feature", quoted(scene));
    let rows = transaction.query(&envelopes, &[])?;
    Ok(rows
        .iter()
        .map(|row| row.get::<_, sql_types::Box3d>(0).into())
        .collect())
}

/// Coordinates of two frames do not mix; an unknown frame goes with any.
fn refuse_other_frame(
    transaction: &mut Transaction<'_>,
    scene: &str,
    srid: i32,
) -> Result<(), Failure> {
    let statement = format!("SELECT srid FROM {}.scene_info", quoted(scene));
    let known: i32 = transaction.query_one(&statement, &[])?.get(0);
    if srid != known && srid != 0 {
        return Err(Failure::Input(format!(
            "scene \"{scene}\" has SRID {known}, not {srid}"
        )));
    }
    Ok(())
}

fn refuse_known_names(
    transaction: &mut Transaction<'_>,
    scene: &str,
    model: &Model,
) -> Result<(), Failure> {
    let names: Vec<&str> = model
        .features
        .iter()
        .map(|feature| feature.name.as_str())
        .collect();
    let statement = format!(
        "SELECT min(name), count(*) FROM {}.feature WHERE name = ANY ($1)",
        quoted(scene)
    );
    let row = transaction.query_one(&statement, &[&names])?;
    match row.get::<_, Option<&str>>(0) {
        None => Ok(()),
        Some(name) => Err(Failure::Input(format!(
            "scene \"{scene}\" holds {} of these features already, such as \"{name}\"\n  \
             hint: --replace drops the scene first",
            row.get::<_, i64>(1)
        ))),
    }
}

/// Writes the features; returns their numbers.
pub fn features(
    transaction: &mut Transaction<'_>,
    scene: &str,
    model: &Model,
    solids: &[Solid],
) -> Result<Vec<i64>, Failure> {
    let schema = quoted(scene);
    let next =
        "SELECT nextval(pg_get_serial_sequence($1, 'id')) FROM generate_series(1, $2::bigint)";
    let count = i64::try_from(solids.len()).unwrap_or(i64::MAX);
    let ids = transaction.query(next, &[&format!("{schema}.feature"), &count])?;
    let ids: Vec<i64> = ids.iter().map(|row| row.get(0)).collect();
    let last = format!("SELECT coalesce(max(slot) + 1, 0) FROM {schema}.feature");
    let first_slot: i32 = transaction.query_one(&last, &[])?.get(0);
    let envelopes: Vec<Box3d> = solids.iter().map(|solid| solid.envelope).collect();
    let slots = morton::ranks(&envelopes);
    let columns = "id, name, class, envelope, slot, attributes";
    let mut copy = Copy::begin(transaction, scene, "feature", columns)?;
    for (i, feature) in model.features.iter().enumerate() {
        let envelope = sql_types::Box3d::from(envelopes[i]);
        let slot = i32::try_from(slots[i])
            .ok()
            .and_then(|slot| slot.checked_add(first_slot));
        let attributes = &feature.attributes;
        copy.row(&[
            &ids[i],
            &feature.name,
            &feature.class,
            &envelope,
            &slot,
            attributes,
        ])?;
    }
    copy.finish()?;
    Ok(ids)
}

/// Writes models, meshes and inner envelopes.
pub fn shapes(
    transaction: &mut Transaction<'_>,
    scene: &str,
    model: &Model,
    solids: &[Solid],
    ids: &[i64],
) -> Result<(), Failure> {
    let columns = "feature, level_of_detail, format, content";
    let mut copy = Copy::begin(transaction, scene, "model", columns)?;
    for (id, feature) in ids.iter().zip(&model.features) {
        copy.row(&[id, &"all", &"cityjson", &feature.source.as_bytes()])?;
    }
    copy.finish()?;
    let columns = "feature, level_of_detail, vertices, triangles, defect";
    let mut copy = Copy::begin(transaction, scene, "mesh", columns)?;
    for (id, solid) in ids.iter().zip(solids) {
        let vertices: Vec<f64> = solid
            .mesh
            .vertices
            .iter()
            .flat_map(|v| v.to_array())
            .collect();
        let numbers = solid.mesh.triangles.as_flattened().iter();
        let triangles: Vec<i32> = numbers.map(|&number| number.cast_signed()).collect();
        let defect = solid.inner.as_ref().err().map(ToString::to_string);
        copy.row(&[
            id,
            &solid.level_of_detail.to_string(),
            &vertices,
            &triangles,
            &defect,
        ])?;
    }
    copy.finish()?;
    let mut copy = Copy::begin(
        transaction,
        scene,
        "inner_envelope",
        "feature, box, grounded",
    )?;
    for (id, solid) in ids.iter().zip(solids) {
        if let Ok(inner) = solid.inner {
            copy.row(&[id, &sql_types::Box3d::from(inner.bounds), &inner.grounded])?;
        }
    }
    copy.finish()
}

/// Writes the streets.
pub fn streets(
    transaction: &mut Transaction<'_>,
    scene: &str,
    streets: &[Street],
) -> Result<(), Failure> {
    let mut copy = Copy::begin(
        transaction,
        scene,
        "street",
        "name, area, eye_low, eye_high",
    )?;
    for street in streets {
        copy.row(&[
            &"road",
            &rings(&street.area),
            &street.eye_low,
            &street.eye_high,
        ])?;
    }
    copy.finish()
}

/// Makes a view region from the open space of a scene that has no streets; returns its size.
pub fn view_region(
    transaction: &mut Transaction<'_>,
    scene: &str,
) -> Result<Option<usize>, Failure> {
    let statement = format!("SELECT EXISTS (SELECT FROM {}.street)", quoted(scene));
    if transaction.query_one(&statement, &[])?.get(0) {
        return Ok(None);
    }
    let statement = "SELECT occlusion.generate_view_region($1)";
    let made: i64 = transaction.query_one(statement, &[&scene])?.get(0);
    Ok(usize::try_from(made).ok())
}

/// Tells the planner what is there now.
pub fn analyze(transaction: &mut Transaction<'_>, scene: &str) -> Result<(), Failure> {
    let schema = quoted(scene);
    let tables = ["feature", "mesh", "inner_envelope", "street"];
    let tables = tables.map(|table| format!("{schema}.{table}")).join(", ");
    Ok(transaction.batch_execute(&format!("ANALYZE {tables}"))?)
}
