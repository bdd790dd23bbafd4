//! Observers at different places of the streets of a scene.

use postgres::Client;

use crate::database::quoted;
use crate::failure::Failure;
use crate::sql_types::Point3d;

/// Makes a schema with a table of observers anew: points of street polygons that a seed chooses.
pub fn place(
    client: &mut Client,
    schema: &str,
    scene: &str,
    count: usize,
    seed: i64,
) -> Result<(), Failure> {
    let streets = format!("{}.street", quoted(scene));
    client.batch_execute(&format!(
        "DROP SCHEMA IF EXISTS {schema} CASCADE;
         CREATE SCHEMA {schema};
         CREATE UNLOGGED TABLE {schema}.observer AS
         WITH street AS (
             SELECT id, area, (eye_low + eye_high) / 2 AS z, box(area[1]) AS b FROM {streets}
             ORDER BY hashint8extended(id, {seed}) LIMIT {count} * 2
         ), candidate AS (
             SELECT DISTINCT ON (street.id) street.id, p, z
             FROM street CROSS JOIN generate_series(1, 64) AS i
             CROSS JOIN LATERAL (
                 SELECT hashint8extended(street.id * 64 + i, {seed} + 1)::float8 / 2 ^ 64 + 0.5 AS u,
                        hashint8extended(street.id * 64 + i, {seed} + 2)::float8 / 2 ^ 64 + 0.5 AS v) AS r
             CROSS JOIN LATERAL (
                 SELECT point((b[1])[0] + u * ((b[0])[0] - (b[1])[0]),
                              (b[1])[1] + v * ((b[0])[1] - (b[1])[1])) AS p) AS q
             WHERE area[1] @> p AND NOT EXISTS (SELECT FROM unnest(area[2:]) AS hole WHERE hole @> p)
             ORDER BY street.id, i
         )
         SELECT (row_number() OVER (ORDER BY hashint8extended(id, {seed} + 3)) - 1)::integer AS id,
                p[0] AS x, p[1] AS y, z, occlusion.point3d(p[0], p[1], z) AS eye
         FROM candidate ORDER BY 1 LIMIT {count};
         ALTER TABLE {schema}.observer ADD PRIMARY KEY (id);
         ANALYZE {schema}.observer"
    ))?;
    let found: i64 = client
        .query_one(&format!("SELECT count(*) FROM {schema}.observer"), &[])?
        .get(0);
    if found == 0 {
        return Err(Failure::Unready(format!(
            "scene \"{scene}\" has no streets in which observers can stand"
        )));
    }
    Ok(())
}

/// The eyes of those that were placed.
pub fn eyes(client: &mut Client, schema: &str) -> Result<Vec<Point3d>, Failure> {
    let all = format!("SELECT eye FROM {schema}.observer ORDER BY id");
    let rows = client.query(&all, &[])?;
    Ok(rows.iter().map(|row| row.get(0)).collect())
}
