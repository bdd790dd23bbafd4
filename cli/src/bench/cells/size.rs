//! What view cells and their squares take on disk, beside a plain table of cell and feature.

use postgres::Client;

use crate::bench::table::Table;
use crate::database::quoted;
use crate::failure::Failure;

/// Schema of all that the benchmark makes.
pub const SCHEMA: &str = "occlusion_bench_cells";

/// Measures the tables of view cells with their indexes, and makes the plain one for as long as that takes.
pub fn compare(client: &mut Client, scene: &str) -> Result<Table, Failure> {
    let drop = format!("DROP SCHEMA IF EXISTS {SCHEMA} CASCADE");
    let (schema, plain) = (quoted(scene), format!("{SCHEMA}.visible"));
    client.batch_execute(&format!(
        "{drop}; CREATE SCHEMA {SCHEMA};
         CREATE TABLE {plain} AS
         SELECT c.cell, s.slot::integer AS feature
         FROM (SELECT row_number() OVER (ORDER BY id)::integer AS cell, visible FROM {schema}.view_cell) AS c
         CROSS JOIN LATERAL occlusion.unnest(c.visible) AS s (slot) ORDER BY 1, 2;
         CREATE INDEX visible_cell ON {plain} (cell);
         CREATE INDEX visible_feature ON {plain} (feature)"
    ))?;
    let mut ours = relations(client, &format!("{schema}.view_cell"))?;
    ours.extend(relations(client, &format!("{schema}.view_cell_block"))?);
    let theirs = relations(client, &plain)?;
    let count = format!("SELECT count(*) FROM {plain}");
    let pairs: i64 = client.query_one(&count, &[])?.get(0);
    client.batch_execute(&drop)?;
    let total = |relations: &[(String, i64)]| relations.iter().map(|(_, size)| size).sum::<i64>();
    let whole = total(&ours);
    let row = |name: String, bytes: i64| {
        vec![
            name,
            format!("{:.2}", bytes as f64 / 1e6),
            format!("{:.2}", bytes as f64 / whole as f64),
        ]
    };
    let group = |name: &str, relations: Vec<(String, i64)>| {
        let all = row(format!("{name}, with indexes"), total(&relations));
        let each = relations.into_iter().map(|(name, bytes)| row(name, bytes));
        each.chain([all]).collect::<Vec<_>>()
    };
    let ours = group("view cells", ours);
    Ok(Table {
        heading: vec!["on disk", "MB", "ratio"],
        rows: ours
            .into_iter()
            .chain(group("plain table", theirs))
            .collect(),
        remarks: vec![format!(
            "The plain table has {} pairs of cell and feature, two integers each.",
            crate::terminal::grouped(usize::try_from(pairs).unwrap_or_default())
        )],
    })
}

/// Name and bytes of a table, what is stored beside it included, and of each of its indexes.
fn relations(client: &mut Client, table: &str) -> Result<Vec<(String, i64)>, Failure> {
    let statement = "SELECT c.relname::text, pg_table_size(c.oid) \
                     FROM pg_catalog.pg_class AS c LEFT JOIN pg_catalog.pg_index AS i ON i.indexrelid = c.oid \
                     WHERE c.oid = to_regclass($1) OR i.indrelid = to_regclass($1) \
                     ORDER BY i.indexrelid IS NOT NULL, 1";
    let rows = client.query(statement, &[&table])?;
    Ok(rows.iter().map(|row| (row.get(0), row.get(1))).collect())
}
