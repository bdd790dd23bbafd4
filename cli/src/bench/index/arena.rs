//! [`Arena`], the tables in which contenders meet.

use std::time::Instant;

use postgres::Client;

use super::contender::Contender;
use super::data_set::DataSet;
use super::search::{Search, well_known_text};
use crate::database::{Copy, quoted};
use crate::failure::Failure;

/// The schema that is made for the tables, and dropped.
const SCHEMA: &str = "occlusion_bench_index";

/// Builds of one index at the most; the median counts.
const BUILDS: usize = 3;

/// Seconds after which an index is not built again.
const PATIENCE: f64 = 10.0;

/// What every contender gets: one core, and the plans of its index.
const SETTINGS: &str = "
    SET jit = off;
    SET enable_seqscan = off;
    SET max_parallel_workers_per_gather = 0;
    SET max_parallel_maintenance_workers = 0;
    SET maintenance_work_mem = '512MB';
    SET client_min_messages = warning";

/// An index that was built.
#[derive(Clone, Copy, Debug)]
pub struct Built {
    /// Seconds that it took.
    pub seconds: f64,
    /// Bytes of the index.
    pub index_bytes: i64,
    /// Bytes of the table.
    pub table_bytes: i64,
}

/// The tables in which contenders meet, in a schema of their own.
pub struct Arena<'a> {
    client: &'a mut Client,
}

impl<'a> Arena<'a> {
    /// Makes the schema, with the boxes and the searches in it.
    pub fn new(
        client: &'a mut Client,
        data: &DataSet,
        searches: &[Search],
    ) -> Result<Self, Failure> {
        client.batch_execute(SETTINGS)?;
        let mut arena = Self { client };
        let schemas = "SELECT DISTINCT n.nspname::text FROM pg_catalog.pg_extension AS e
            JOIN pg_catalog.pg_namespace AS n ON n.oid = e.extnamespace
            WHERE e.extname IN ('postgis', 'cube')";
        let mut path = vec![SCHEMA.to_owned()];
        let rows = arena.client.query(schemas, &[])?;
        path.extend(rows.iter().map(|row| quoted(row.get(0))));
        arena.client.batch_execute(&format!(
            "DROP SCHEMA IF EXISTS {SCHEMA} CASCADE;
             CREATE SCHEMA {SCHEMA};
             SET search_path = {};
             CREATE UNLOGGED TABLE box_given (id bigint, class text, key occlusion.box3d);
             CREATE VIEW box AS SELECT *,
                occlusion.x(occlusion.lower(key)) AS x, occlusion.x(occlusion.upper(key)) AS right,
                occlusion.y(occlusion.lower(key)) AS y, occlusion.y(occlusion.upper(key)) AS back,
                occlusion.z(occlusion.lower(key)) AS z, occlusion.z(occlusion.upper(key)) AS top
                FROM box_given;
             CREATE UNLOGGED TABLE search_given (id integer, box occlusion.box3d,
                point occlusion.point3d, eye occlusion.point3d, heading float8, range float8,
                sector text, around occlusion.box3d);
             CREATE VIEW search AS SELECT *,
                occlusion.x(occlusion.lower(box)) AS x, occlusion.x(occlusion.upper(box)) AS right,
                occlusion.y(occlusion.lower(box)) AS y, occlusion.y(occlusion.upper(box)) AS back,
                occlusion.z(occlusion.lower(box)) AS z, occlusion.z(occlusion.upper(box)) AS top,
                occlusion.x(point) AS px, occlusion.y(point) AS py, occlusion.z(point) AS pz,
                occlusion.x(eye) AS ex, occlusion.y(eye) AS ey, occlusion.z(eye) AS ez,
                occlusion.x(occlusion.lower(around)) AS west, occlusion.x(occlusion.upper(around)) AS east,
                occlusion.y(occlusion.lower(around)) AS south, occlusion.y(occlusion.upper(around)) AS north,
                occlusion.z(occlusion.lower(around)) AS lowest, occlusion.z(occlusion.upper(around)) AS highest
                FROM search_given",
            path.join(", ")
        ))?;
        arena.fill(data, searches)?;
        Ok(arena)
    }

    fn fill(&mut self, data: &DataSet, searches: &[Search]) -> Result<(), Failure> {
        let mut transaction = self.client.transaction()?;
        let mut boxes = Copy::begin(&mut transaction, SCHEMA, "box_given", "id, class, key")?;
        for (id, bounds) in data.boxes.iter().enumerate() {
            boxes.row(&[&(id as i64), &data.class, bounds])?;
        }
        boxes.finish()?;
        let columns = "id, box, point, eye, heading, range, sector, around";
        let mut copy = Copy::begin(&mut transaction, SCHEMA, "search_given", columns)?;
        for (id, search) in searches.iter().enumerate() {
            let outline = search.outline();
            copy.row(&[
                &(id as i32),
                &search.bounds,
                &search.point,
                &search.eye,
                &search.heading,
                &search.range,
                &well_known_text(&outline),
                &search.around(&outline),
            ])?;
        }
        copy.finish()?;
        Ok(transaction.commit()?)
    }

    /// The connection, for which the tables are in the search path.
    pub fn client(&mut self) -> &mut Client {
        self.client
    }

    /// Makes table, searches and index of a contender. All tables have their rows in the same order.
    pub fn enter(&mut self, contender: &Contender) -> Result<Built, Failure> {
        let Contender {
            table,
            columns,
            searches,
            ..
        } = contender;
        self.client
            .batch_execute(contender.preparation.unwrap_or_default())?;
        self.client.batch_execute(&format!(
            "CREATE UNLOGGED TABLE {table} AS
                SELECT box.id, box.class, {columns} FROM box ORDER BY box.id;
             CREATE UNLOGGED TABLE {table}_search AS
                SELECT search.id, {searches} FROM search ORDER BY search.id;
             CREATE UNIQUE INDEX ON {table}_search (id)"
        ))?;
        let seconds = self.build(contender)?;
        for table in [table.to_string(), format!("{table}_search")] {
            self.client
                .batch_execute(&format!("VACUUM ANALYZE {table}"))?;
        }
        let sizes =
            "SELECT pg_relation_size($1::text::regclass), pg_relation_size($2::text::regclass)";
        let row = self
            .client
            .query_one(sizes, &[&format!("{table}_key"), table])?;
        Ok(Built {
            seconds,
            index_bytes: row.get(0),
            table_bytes: row.get(1),
        })
    }

    /// Builds its index, some times over if that is quick; seconds.
    fn build(&mut self, contender: &Contender) -> Result<f64, Failure> {
        let Contender { table, index, .. } = contender;
        let mut seconds = Vec::new();
        while seconds.len() < BUILDS && seconds.iter().sum::<f64>() < PATIENCE {
            self.client
                .batch_execute(&format!("DROP INDEX IF EXISTS {table}_key"))?;
            let began = Instant::now();
            self.client.batch_execute(&format!(
                "CREATE INDEX {table}_key ON {table} USING {index}"
            ))?;
            seconds.push(began.elapsed().as_secs_f64());
        }
        Ok(crate::bench::quantile::quantile(&mut seconds, 0.5))
    }

    /// Drops the schema.
    pub fn close(self) -> Result<(), Failure> {
        Ok(self
            .client
            .batch_execute(&format!("RESET search_path; DROP SCHEMA {SCHEMA} CASCADE"))?)
    }
}
