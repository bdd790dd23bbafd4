//! Features that take the place of those of their name.
//!
//! A batch is written to temporary tables first, and compared there: what is as it was is not touched, so that nothing
//! that was computed of it goes out of use.

use std::collections::HashSet;

use formats::Feature;
use postgres::Transaction;

use super::rows;
use super::solid::Solid;
use crate::database::quoted;
use crate::failure::Failure;

/// Schema of the temporary tables.
const STAGE: &str = "pg_temp";

/// Tables of what features are made of, and their columns. Whether something is grounded depends on the neighbours.
const PARTS: [(&str, &str, &str); 4] = [
    (
        "mesh",
        "feature, level_of_detail, vertices, triangles, defect, repair, repair_triangles",
        "",
    ),
    ("inner_envelope", "feature, box", ", grounded"),
    (
        "solid_column",
        "feature, footprint, bottom, top",
        ", grounded",
    ),
    (
        "model",
        "feature, level_of_detail, format, content, shape, placement, geometric_error",
        "",
    ),
];

/// What a feature is apart from these.
const OWN: &str = "class, envelope, outline, attributes";

/// What became of the features of a batch.
#[derive(Debug, Default)]
pub struct Outcome {
    /// In the order of the batch.
    pub ids: Vec<i64>,
    /// How many were not there before.
    pub new: usize,
    /// Of these, what is as it was.
    pub same: HashSet<i64>,
}

/// The temporary tables.
fn staged() -> impl Iterator<Item = &'static str> {
    let parts = PARTS.map(|(table, ..)| table);
    ["feature", "shape"].into_iter().chain(parts)
}

/// Makes the temporary tables, which go away with the transaction.
pub fn prepare(transaction: &mut Transaction<'_>, scene: &str) -> Result<(), Failure> {
    let schema = quoted(scene);
    // Numbers are compared as text, which is exact unless somebody asks for fewer digits.
    transaction.batch_execute("SET LOCAL extra_float_digits = 1")?;
    for table in staged() {
        transaction.batch_execute(&format!(
            "CREATE TEMPORARY TABLE {table} (LIKE {schema}.{table} INCLUDING GENERATED INCLUDING INDEXES) \
             ON COMMIT DROP"
        ))?;
    }
    Ok(())
}

/// Writes a batch, new features and those that changed.
pub fn write(
    transaction: &mut Transaction<'_>,
    scene: &str,
    features: &[Feature],
    solids: &[Solid],
) -> Result<Outcome, Failure> {
    let known = rows::known(transaction, scene, features)?;
    let new = rows::new_ids(transaction, scene, features.len() - known.len())?;
    let mut next = new.iter();
    let number = |feature: &Feature| known.get(&feature.name).or_else(|| next.next()).copied();
    let ids: Vec<i64> = features.iter().filter_map(number).collect();
    for table in staged() {
        transaction.batch_execute(&format!("TRUNCATE {STAGE}.{table}"))?;
    }
    let first_slot = rows::first_slot(transaction, scene)?;
    rows::features(transaction, STAGE, &ids, first_slot, features, solids)?;
    rows::shapes(transaction, STAGE, &ids, solids)?;
    rows::models(transaction, STAGE, &ids, solids)?;
    let same = drop_same(transaction, scene)?;
    move_on(transaction, scene, &new)?;
    Ok(Outcome {
        ids,
        new: new.len(),
        same,
    })
}

/// Takes out of the temporary tables what is the same in the scene; returns which features that are.
fn drop_same(transaction: &mut Transaction<'_>, scene: &str) -> Result<HashSet<i64>, Failure> {
    let schema = quoted(scene);
    let content = |schema: &str, (table, columns, _): (&str, &str, &str)| {
        format!(
            "(SELECT array_agg(p::text ORDER BY p::text) \
              FROM (SELECT {columns} FROM {schema}.{table} WHERE feature = s.id) AS p)"
        )
    };
    let parts = PARTS.map(|part| {
        let [staged, stored] = [STAGE, &schema].map(|schema| content(schema, part));
        format!("AND {staged} IS NOT DISTINCT FROM {stored}")
    });
    let own = |alias: &str| {
        let columns: Vec<String> = OWN
            .split(", ")
            .map(|column| format!("{alias}.{column}"))
            .collect();
        format!("ROW({})::text", columns.join(", "))
    };
    let statement = format!(
        "DELETE FROM {STAGE}.feature AS s USING {schema}.feature AS f \
         WHERE f.id = s.id AND {} = {} {} RETURNING s.id",
        own("s"),
        own("f"),
        parts.join(" ")
    );
    let same = transaction.query(&statement, &[])?;
    Ok(same.iter().map(|row| row.get(0)).collect())
}

/// Moves what is left in the temporary tables to the scene.
fn move_on(transaction: &mut Transaction<'_>, scene: &str, new: &[i64]) -> Result<(), Failure> {
    let schema = quoted(scene);
    let staged: Vec<String> = OWN
        .split(", ")
        .map(|column| format!("s.{column}"))
        .collect();
    transaction.execute(
        &format!(
            "UPDATE {schema}.feature AS f SET ({OWN}) = ROW({}) FROM {STAGE}.feature AS s WHERE f.id = s.id",
            staged.join(", ")
        ),
        &[],
    )?;
    for (table, ..) in PARTS {
        transaction.execute(
            &format!(
                "DELETE FROM {schema}.{table} WHERE feature IN (SELECT id FROM {STAGE}.feature)"
            ),
            &[],
        )?;
    }
    let columns = format!("id, name, slot, {OWN}");
    transaction.execute(
        &format!(
            "INSERT INTO {schema}.feature ({columns}) SELECT {columns} FROM {STAGE}.feature WHERE id = ANY ($1)"
        ),
        &[&new],
    )?;
    transaction.execute(
        &format!("INSERT INTO {schema}.shape SELECT * FROM {STAGE}.shape ON CONFLICT DO NOTHING"),
        &[],
    )?;
    for (table, columns, more) in PARTS {
        transaction.execute(
            &format!(
                "INSERT INTO {schema}.{table} ({columns}{more}) SELECT {columns}{more} FROM {STAGE}.{table} \
                 WHERE feature IN (SELECT id FROM {STAGE}.feature)"
            ),
            &[],
        )?;
    }
    Ok(())
}
